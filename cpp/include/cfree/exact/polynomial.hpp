// Exact polynomials in tau with integer coefficients: signs at doubles, common divisors, root counts.
#pragma once
#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>
#include <vector>

#include "cfree/exact/ball.hpp"

namespace cfree {

// A dyadic rational n / 2^k.
struct Dyadic {
    Int n;
    unsigned k = 0;
    static Dyadic from(double value);
    static Dyadic from(const Ball& middle);
    static Dyadic middle(const Dyadic& p, const Dyadic& q);
    double rounded_down() const;
    double rounded_up() const;
};
int compare(const Dyadic& p, const Dyadic& q);

// Three, five or seven coefficients from the constant up, of any number type; leading ones may vanish.
template <class T>
struct Coefficients {
    T c[7];
    int count;
};
inline Ball value_at(const Coefficients<Ball>& p, const Ball& tau) {
    Ball r = p.c[p.count - 1];
    for (int i = p.count - 1; i-- > 0;) r = r * tau + p.c[i];
    return r;
}
std::optional<int> sign_at(const Coefficients<Ball>& p, const Ball& tau);

// Coefficients from the constant up; no leading zeros; degree at most 6; empty is zero.
class Poly {
public:
    Poly() = default;
    Poly(std::initializer_list<Int> coefficients) {
        for (const Int& x : coefficients) push_back(x);
        trim();
    }
    explicit Poly(const Coefficients<Int>& p) {
        for (int i = 0; i < p.count; ++i) push_back(p.c[i]);
        trim();
    }
    int size() const { return count; }
    bool empty() const { return count == 0; }
    Int& operator[](int i) { return c[i]; }
    const Int& operator[](int i) const { return c[i]; }
    const Int& back() const { return c[count - 1]; }
    void push_back(const Int& x) { c[count++] = x; }
    void resize(int n) {
        for (; count < n; ++count) c[count] = 0;
        count = n;
    }
    void trim() {
        while (count > 0 && c[count - 1].is_zero()) --count;
    }
    Int* begin() { return c; }
    Int* end() { return c + count; }
    const Int* begin() const { return c; }
    const Int* end() const { return c + count; }

private:
    Int c[7];
    int count = 0;
};

Poly product(const Poly& p, const Poly& q);
Poly sum(const Poly& p, const Poly& q);
Poly difference(const Poly& p, const Poly& q);
Poly derivative(const Poly& p);
Int value_at(const Poly& p, const Dyadic& tau);  // times 2^(k d), d the degree
int sign_at(const Poly& p, const Dyadic& tau);
// Place of the highest bit of any coefficient.
template <class P>
int largest_bit(const P& p) {
    int most = 0;
    for (const Int& c : p)
        if (!c.is_zero()) most = std::max(most, static_cast<int>(msb(abs(c))));
    return most;
}
Coefficients<Ball> scaled(const Poly& p);  // in balls, times a power of two
int sign_on(const Poly& p, const Dyadic& lo, const Dyadic& hi);  // sign on the whole closed interval, 0 if not certain
Poly greatest_common_divisor(Poly p, Poly q);
Poly squarefree(const Poly& p);
Poly primitive(Poly p);  // without a common factor of its coefficients
// Divide polynomials, not all zero, by their common factors, numbers included.
void cancel(std::span<Poly> parts);

// Sturm's chain of a squarefree polynomial.
class Sturm {
public:
    explicit Sturm(const Poly& squarefree);
    // Number of sign changes along the chain: it falls by one at each root.
    int variations(const Dyadic& tau) const;
    int roots_in(const Dyadic& lo, const Dyadic& hi) const { return variations(lo) - variations(hi); }  // in (lo, hi]
    const Poly& polynomial() const { return chain[0].exact; }

private:
    struct Link {
        Poly exact;
        Coefficients<Ball> scaled;
    };
    std::vector<Link> chain;
};

// Isolating intervals (lo, hi] of the roots in (lo, hi], in order, each narrower than 2^-bits.
std::vector<std::array<Dyadic, 2>> isolate(const Sturm& sturm, const Dyadic& lo, const Dyadic& hi, unsigned bits);

}  // namespace cfree
