// Products and inverses modulo a prime, without divisions; theory, "Closed surfaces".
#include "cfree/exact/residues.hpp"

#include <bit>
#include <deque>

namespace cfree {

Residues::Residues(Word prime) : p(prime), inverse_of_p(prime) {
    for (int k = 0; k < 5; ++k) inverse_of_p *= 2 - p * inverse_of_p;  // Newton's method: 3 bits are right, 6, 12, ...
    one = static_cast<Word>((Wide(1) << 64) % p), square = static_cast<Word>(static_cast<Wide>(one) * one % p);
}

Residues::Word Residues::of(const Int& n) const {
    const Int r = n % Int(p);
    return times(static_cast<Word>(r.sign() < 0 ? Int(r + p) : r), square);
}

Residues::Word Residues::power(Word x, Word exponent) const {
    Word result = one;
    for (; exponent != 0; exponent >>= 1, x = times(x, x))
        if (exponent & 1) result = times(result, x);
    return result;
}

// Miller and Rabin's test: with the first twelve primes as bases it errs for no number below 2^64.
bool Residues::is_prime() const {
    const int twos = std::countr_zero(p - 1);
    for (const int base : {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37}) {
        Word x = power(of(base), (p - 1) >> twos);
        bool passes = x == one;
        for (int k = 0; k < twos && !passes; ++k, x = times(x, x)) passes = x == minus(0, one);
        if (!passes) return false;
    }
    return true;
}

const Residues& large_field(std::size_t k) {
    thread_local std::deque<Residues> fields;
    while (fields.size() <= k) {
        Residues next((fields.empty() ? Residues::Word(1) << 62 | 1 : fields.back().modulus()) - 2);
        while (!next.is_prime()) next = Residues(next.modulus() - 2);
        fields.push_back(next);
    }
    return fields[k];
}

}  // namespace cfree
