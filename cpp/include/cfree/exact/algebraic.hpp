// Real algebraic numbers of degree at most 6, compared exactly.
#pragma once
#include "cfree/exact/polynomial.hpp"
#include "cfree/exact/ratio.hpp"

namespace cfree {

// A root of p, its only one in [lo, hi]; p changes sign there, or lo = hi is the root.
struct RealRoot {
    Poly p;
    Dyadic lo, hi;
    bool is_dyadic() const { return cfree::compare(lo, hi) == 0; }
    unsigned digits() const;  // d if the interval is narrower than 2^-d, or 0
    void halve();
    void narrow();  // faster and faster once the polynomial is nearly straight in the interval
};

// Value of p times the denominator to the power of the degree.
Int value_at(const Poly& p, const Ratio& x);
inline Ratio ratio_of(const Dyadic& x) { return reduced(x.n, Int(1) << x.k); }
// Value of a root, if it is rational.
std::optional<Ratio> rational_value(RealRoot x);
// Sign of q at the root; narrows its interval.
int sign_at(const Poly& q, RealRoot& x);
// Order of two roots; narrows their intervals.
int compare(RealRoot& x, RealRoot& y);
// Sign of q just after the root, and just before; q is not zero.
int sign_after(const Poly& q, RealRoot& x);
int sign_before(const Poly& q, RealRoot& x);

}  // namespace cfree
