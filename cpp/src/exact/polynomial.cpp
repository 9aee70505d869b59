// Polynomials with exact coefficients: division, divisors, isolation of roots; theory, "Degrees".
#include "cfree/exact/polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

// Divide by the content if coefficients have outgrown their 512 bits.
void keep_small(Poly& p) {
    const auto bits = [](const Int& c) { return c.is_zero() ? 0u : static_cast<unsigned>(msb(abs(c))); };
    unsigned most = 0;
    for (const Int& c : p) most = std::max(most, bits(c));
    if (most >= 200) p = primitive(std::move(p));
}

// True if two polynomials have no common root modulo a prime, and so none at all: the leading coefficient of a common divisor
// divides theirs, so it keeps its degree modulo the prime if one of theirs is not zero there.
bool are_coprime_modulo_prime(const Poly& p, const Poly& q) {
    using Word = std::uint64_t;
    constexpr Word prime = (Word(1) << 61) - 1;
    const auto times = [](Word x, Word y) { return static_cast<Word>(static_cast<Wide>(x) * y % prime); };
    struct Small {
        Word c[7];
        int size = 0;
    };
    const auto reduced = [&](const Poly& f) {
        Small r;
        for (const Int& c : f) {
            const Int rest = c % Int(prime);
            r.c[r.size++] = static_cast<Word>(rest.sign() < 0 ? Int(rest + prime) : rest);
        }
        return r;
    };
    Small a = reduced(p), b = reduced(q);
    if (a.size == 0 || b.size == 0 || (a.c[a.size - 1] == 0 && b.c[b.size - 1] == 0)) return false;
    const auto trim = [](Small& f) {
        while (f.size > 0 && f.c[f.size - 1] == 0) --f.size;
    };
    trim(a), trim(b);
    while (b.size > 0) {
        while (a.size >= b.size) {  // lead(b) a - lead(a) t^k b
            const Word top = a.c[a.size - 1], lead = b.c[b.size - 1];
            for (int i = 0; i < a.size; ++i) a.c[i] = times(a.c[i], lead);
            for (int i = 0; i < b.size; ++i) {
                Word& c = a.c[i + a.size - b.size];
                const Word less = times(top, b.c[i]);
                c = c >= less ? c - less : c + prime - less;
            }
            trim(a);
        }
        std::swap(a, b);
    }
    return a.size == 1;
}

// Positive multiple of the remainder of p by q.
Poly remainder(Poly p, const Poly& q) {
    const Int lead = abs(q.back());
    while (p.size() >= q.size()) {
        const Int top = q.back().sign() > 0 ? p.back() : Int(-p.back());
        const int shift = p.size() - q.size();
        for (Int& c : p) c *= lead;
        for (int i = 0; i < q.size(); ++i) p[i + shift] -= top * q[i];
        p.trim();
        keep_small(p);
    }
    return p;
}

// Exact quotient of two polynomials, up to a positive constant.
Poly quotient(Poly p, const Poly& q) {
    Poly result;
    result.resize(p.size() - q.size() + 1);
    const Int lead = abs(q.back());
    for (int k = result.size(); k-- > 0;) {
        for (Int& c : p) c *= lead;
        for (Int& c : result) c *= lead;
        result[k] = p[k + q.size() - 1] / q.back();
        for (int i = 0; i < q.size(); ++i) p[i + k] -= result[k] * q[i];
    }
    keep_small(result);
    return result;
}

}  // namespace

Dyadic Dyadic::from(double value) {
    int exponent;
    const double mantissa = std::frexp(value, &exponent);
    auto n = static_cast<std::int64_t>(std::ldexp(mantissa, 53));
    int k = 53 - exponent;
    while (n != 0 && k > 0 && n % 2 == 0) n /= 2, --k;
    if (n == 0) k = 0;
    Dyadic d{Int(n), static_cast<unsigned>(k > 0 ? k : 0)};
    if (k < 0) d.n <<= static_cast<unsigned>(-k);
    return d;
}

Dyadic Dyadic::from(const Ball& x) {
    const Dyadic hi = from(x.hi), lo = from(x.lo);
    const unsigned k = hi.k > lo.k ? hi.k : lo.k;
    return {(hi.n << (k - hi.k)) + (lo.n << (k - lo.k)), k};
}

Dyadic Dyadic::middle(const Dyadic& p, const Dyadic& q) {
    const unsigned k = p.k > q.k ? p.k : q.k;
    return {(p.n << (k - p.k)) + (q.n << (k - q.k)), k + 1};
}

double Dyadic::rounded_down() const {
    // scaled to 53 bits, floor
    if (n.is_zero()) return 0.0;
    const int bits = static_cast<int>(boost::multiprecision::msb(abs(n))) + 1;
    const int shift = bits - 53;
    Int m = abs(n);
    bool inexact = false;
    if (shift > 0) {
        const Int kept = m >> static_cast<unsigned>(shift);
        inexact = (kept << static_cast<unsigned>(shift)) != m;
        m = kept;
    }
    if (inexact && n.sign() < 0) m += 1;
    const double value = std::ldexp(m.convert_to<double>(), (shift > 0 ? shift : 0) - static_cast<int>(k));
    return n.sign() < 0 ? -value : value;
}
double Dyadic::rounded_up() const { return -Dyadic{-n, k}.rounded_down(); }

int compare(const Dyadic& p, const Dyadic& q) {
    const unsigned k = p.k > q.k ? p.k : q.k;
    return (p.n << (k - p.k)).compare(q.n << (k - q.k));
}

Poly product(const Poly& p, const Poly& q) {
    if (p.empty() || q.empty()) return {};
    Poly r;
    r.resize(p.size() + q.size() - 1);
    for (int i = 0; i < p.size(); ++i)
        for (int j = 0; j < q.size(); ++j) r[i + j] += p[i] * q[j];
    r.trim();
    return r;
}

Poly sum(const Poly& p, const Poly& q) {
    Poly r = p;
    if (r.size() < q.size()) r.resize(q.size());
    for (int i = 0; i < q.size(); ++i) r[i] += q[i];
    r.trim();
    return r;
}

Poly difference(const Poly& p, const Poly& q) {
    Poly r = p;
    if (r.size() < q.size()) r.resize(q.size());
    for (int i = 0; i < q.size(); ++i) r[i] -= q[i];
    r.trim();
    return r;
}

Poly derivative(const Poly& p) {
    Poly d;
    for (int i = 1; i < p.size(); ++i) d.push_back(p[i] * i);
    return d;
}

// The sign that balls are certain of, in sums of two doubles without radii; nothing if it is not clear that they are.
//
// A step of Horner's scheme is one product without the product of the rests, and one sum (Joldes, Muller and Popescu 2017), and
// loses at most 9 v^2 of the magnitudes m, v = 2^-53; four steps lose 2^-100 m. Balls lose less than 2^-98 m beside the radii of
// the coefficients, which are multiplied as here. A value beyond 2^-96 m and three times these radii is certain in both.
// 2^-900 is more than underflow loses.
static std::optional<int> clear_sign(const Coefficients<Ball>& p, const Ball& tau) {
    const double size = std::abs(tau.hi);
    const Ball& last = p.c[p.count - 1];
    double hi = last.hi, lo = last.lo, m = std::abs(hi), radius = last.radius;
    for (int i = p.count - 1; i-- > 0;) {
        const double q = hi * tau.hi, rest = std::fma(hi, tau.hi, -q) + (hi * tau.lo + lo * tau.hi);
        const double h = q + rest, l = rest - (h - q);
        const Ball& c = p.c[i];
        const auto [s, e] = two_sum(h, c.hi);
        const auto [t, f] = two_sum(l, c.lo);
        const double x = e + t, v = s + x, w = x - (v - s), y = f + w;
        hi = v + y, lo = y - (hi - v);
        m = m * size + std::abs(c.hi), radius = radius * size + c.radius;
    }
    const double bound = m * 0x1p-96 + 3 * radius + 0x1p-900;
    if (hi > bound) return 1;
    if (hi < -bound) return -1;
    return {};
}

std::optional<int> sign_at(const Coefficients<Ball>& p, const Ball& tau) {
    if (tau.radius == 0 && std::abs(tau.hi) <= 1)
        if (const auto sign = clear_sign(p, tau)) return sign;
    return certain_sign(value_at(p, tau));
}

Int value_at(const Poly& p, const Dyadic& tau) {
    if (p.empty()) return 0;
    Int r = p.back();
    for (int i = p.size() - 1; i-- > 0;) {
        r *= tau.n;
        r += p[i] << (tau.k * static_cast<unsigned>(p.size() - 1 - i));
    }
    return r;
}
int sign_at(const Poly& p, const Dyadic& tau) { return value_at(p, tau).sign(); }

int sign_on(const Poly& p, const Dyadic& lo, const Dyadic& hi) {
    if (p.empty()) return 0;
    const unsigned k = std::max(lo.k, hi.k);
    const Int from = lo.n << (k - lo.k), to = hi.n << (k - hi.k);
    // |p'| is at most the sum of i |p_i| 2^((i - 1) m) if |tau| is at most 2^m
    const Int largest = std::max(Int(abs(from)), Int(abs(to)));
    const unsigned bits = largest.is_zero() ? 0 : static_cast<unsigned>(msb(largest)) + 1, m = bits > k ? bits - k : 0;
    Int slope = 0;
    for (int i = 1; i < p.size(); ++i) slope += abs(p[i]) * i << (m * static_cast<unsigned>(i - 1));
    const Int value = value_at(p, Dyadic{from, k});  // over 2^(k d), and so is its greatest change
    const Int change = p.size() < 2 ? Int(0) : Int(((to - from) * slope) << (k * static_cast<unsigned>(p.size() - 2)));
    return abs(value) > change ? value.sign() : 0;
}

Poly greatest_common_divisor(Poly p, Poly q) {
    if (are_coprime_modulo_prime(p, q)) return {1};
    while (!q.empty()) {
        Poly r = p.size() >= q.size() ? remainder(p, q) : p;
        p = q;
        q = r;
    }
    return p;
}

Poly primitive(Poly p) {
    Int content = 0;
    for (const Int& c : p)
        if (content = gcd(content, c); content == 1) return p;
    if (content > 1)
        for (Int& c : p) c /= content;
    return p;
}

Poly squarefree(const Poly& p) {
    if (p.size() <= 2) return p;
    const Poly g = greatest_common_divisor(p, derivative(p));
    return g.size() > 1 ? quotient(p, g) : p;
}

void cancel(std::span<Poly> parts) {
    const auto content = [](const Int& so_far, const Poly& f) {
        Int g = so_far;
        for (const Int& c : f) g = gcd(g, c);
        return g;
    };
    Poly common;
    for (const Poly& f : parts) common = greatest_common_divisor(common, f);
    const Int number = content(0, common);
    for (Int& c : common) c /= number;
    Int rest = 0;
    for (Poly& f : parts) {
        if (f.empty()) continue;
        Poly divided;  // its coefficients are integers: the divisor's have no common factor
        divided.resize(f.size() - common.size() + 1);
        for (int k = divided.size(); k-- > 0;) {
            divided[k] = f[k + common.size() - 1] / common.back();
            for (int i = 0; i < common.size(); ++i) f[i + k] -= divided[k] * common[i];
        }
        f = divided;
        rest = content(rest, f);
    }
    for (Poly& f : parts)
        for (Int& c : f) c /= rest;
}

Coefficients<Ball> scaled(const Poly& p) {
    Coefficients<Ball> result{{}, p.size()};
    for (int i = 0, size = largest_bit(p); i < p.size(); ++i) result.c[i] = ball(p[i], size);
    return result;
}

Sturm::Sturm(const Poly& p) {
    const auto add = [this](const Poly& f) { chain.push_back({f, scaled(f)}); };
    add(p);
    if (p.size() > 1) add(derivative(p));
    while (chain.back().exact.size() > 1) {
        Poly r = remainder(chain[chain.size() - 2].exact, chain.back().exact);
        if (r.empty()) break;
        for (Int& c : r) c = -c;
        add(r);
    }
}

int Sturm::variations(const Dyadic& tau) const {
    heed_stop();
    const Ball at = ball(tau.n, static_cast<int>(tau.k));
    int count = 0, last = 0;
    for (const Link& f : chain) {
        const auto by_balls = f.exact.empty() ? std::nullopt : sign_at(f.scaled, at);
        const int s = by_balls ? *by_balls : sign_at(f.exact, tau);
        if (s != 0 && last != 0 && s != last) ++count;
        if (s != 0) last = s;
    }
    return count;
}

// The numbers of variations at both ends are known.
static void isolate(const Sturm& sturm, const Dyadic& lo, int at_lo, const Dyadic& hi, int at_hi, unsigned bits,
                    std::vector<std::array<Dyadic, 2>>& found) {
    if (at_lo == at_hi) return;
    const unsigned k = lo.k > hi.k ? lo.k : hi.k;
    const Int width = (hi.n << (k - hi.k)) - (lo.n << (k - lo.k));  // over 2^k
    const bool narrow = k >= bits ? width <= (Int(1) << (k - bits)) : false;
    if (at_lo - at_hi == 1 && narrow) {
        found.push_back({lo, hi});
        return;
    }
    const Dyadic mid = Dyadic::middle(lo, hi);
    const int at_mid = sturm.variations(mid);
    isolate(sturm, lo, at_lo, mid, at_mid, bits, found);
    isolate(sturm, mid, at_mid, hi, at_hi, bits, found);
}

std::vector<std::array<Dyadic, 2>> isolate(const Sturm& sturm, const Dyadic& lo, const Dyadic& hi, unsigned bits) {
    std::vector<std::array<Dyadic, 2>> found;
    isolate(sturm, lo, sturm.variations(lo), hi, sturm.variations(hi), bits, found);
    return found;
}

}  // namespace cfree
