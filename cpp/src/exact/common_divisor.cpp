// Common divisors of long polynomials, found modulo primes, put together by the Chinese remainder theorem, and tested.
//
// Modulo a prime that does not divide both leading coefficients, a common divisor has at least the true one's degree. So 1 is
// certain at once, and a common divisor of the least degree that a prime gave is the greatest.
#include <utility>

#include "cfree/exact/long_polynomial.hpp"
#include "cfree/exact/residues.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

// Coefficients modulo a prime, from the constant up; no leading zeros.
using Words = std::vector<Residues::Word>;

void drop_zeros(Words& p) {
    while (!p.empty() && p.back() == 0) p.pop_back();
}

Words words(const LongPoly& p, const Residues& field) {
    Words result;
    for (const Int& x : p) result.push_back(field.of(x));
    drop_zeros(result);
    return result;
}

// The divisor whose leading coefficient is 1.
Words common_divisor(Words p, Words q, const Residues& field) {
    while (!q.empty()) {
        const auto inverse = field.inverse(q.back());
        while (p.size() >= q.size()) {
            const auto times = field.times(p.back(), inverse);
            const std::size_t shift = p.size() - q.size();
            for (std::size_t i = 0; i < q.size(); ++i) p[i + shift] = field.minus(p[i + shift], field.times(times, q[i]));
            drop_zeros(p);
        }
        std::swap(p, q);
    }
    const auto inverse = field.inverse(p.back());
    for (auto& x : p) x = field.times(x, inverse);
    return p;
}

// A polynomial modulo a product of primes, with coefficients of least absolute values.
struct Lifted {
    LongPoly p;
    Int modulus = 1;

    // Make it agree with another one modulo the next prime; true if it does already.
    bool agree(const Words& next, const Residues& field) {
        const auto inverse = field.inverse(field.of(modulus));
        const Int prime = field.modulus();
        bool agreed = true;
        for (std::size_t k = 0; k < next.size(); ++k) {
            Int& x = p[static_cast<int>(k)];
            const auto digit = field.times(field.minus(next[k], field.of(x)), inverse);
            if (digit == 0) continue;
            const Int value = field.value(digit);
            x += modulus * (2 * value > prime ? Int(value - prime) : value);
            agreed = false;
        }
        modulus *= prime;
        return agreed;
    }
};

}  // namespace

LongPoly greatest_common_divisor(const LongPoly& p, const LongPoly& q) {
    if (p.empty() || q.empty()) return primitive(p.empty() ? q : p);
    const Int lead = gcd(p.back(), q.back());  // a multiple of the divisor's
    Lifted divisor;
    for (std::size_t k = 0;; ++k) {
        heed_stop();
        const Residues& field = large_field(k);
        const auto factor = field.of(lead);
        if (factor == 0) continue;
        Words next = common_divisor(words(p, field), words(q, field), field);
        if (next.size() == 1) return 1;
        const int size = static_cast<int>(next.size());
        if (!divisor.p.empty() && size > divisor.p.size()) continue;  // not a divisor modulo this prime only
        if (size != divisor.p.size()) divisor = {}, divisor.p.resize(size);
        for (auto& x : next) x = field.times(x, factor);
        if (!divisor.agree(next, field)) continue;
        LongPoly candidate = divisor.p;
        candidate.trim();
        if (candidate.size() != size) continue;
        candidate = primitive(std::move(candidate));
        if (quotient(p, candidate) && quotient(q, candidate)) return candidate;
    }
}

}  // namespace cfree
