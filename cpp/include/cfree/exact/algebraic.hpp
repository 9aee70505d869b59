// Real algebraic numbers, compared exactly.
#pragma once
#include "cfree/exact/long_polynomial.hpp"
#include "cfree/exact/polynomial.hpp"
#include "cfree/exact/ratio.hpp"

namespace cfree {

// A root of p, its only one in [lo, hi]; p changes sign there, or lo = hi is the root.
template <class P>
struct RootOf {
    P p;
    Dyadic lo, hi;
    bool is_dyadic() const { return cfree::compare(lo, hi) == 0; }
    unsigned digits() const;  // d if the interval is narrower than 2^-d, or 0
    void halve();
    bool step(unsigned right);  // by Newton's method; false if halving is as good
    void narrow();  // faster and faster once the polynomial is nearly straight in the interval
};
using RealRoot = RootOf<Poly>;      // of degree at most 6
using LongRoot = RootOf<LongPoly>;  // of any degree

// Value of p times the denominator to the power of the degree.
Int value_at(const Poly& p, const Ratio& x);
inline Ratio ratio_of(const Dyadic& x) { return reduced(x.n, Int(1) << x.k); }
// Value of a root, if it is rational.
std::optional<Ratio> rational_value(RealRoot x);
// Sign of q at the root; narrows its interval.
template <class P>
int sign_at(const P& q, RootOf<P>& x);
// Order of two roots; narrows their intervals.
template <class P>
int compare(RootOf<P>& x, RootOf<P>& y);
// Order of a root and a number.
template <class P>
int compare(const RootOf<P>& x, const Dyadic& y);

// Sign of q just after the root, and just before; q is not zero.
template <class Q, class P>
int sign_after(Q q, RootOf<P>& x) {
    for (;; q = derivative(q))
        if (const int s = sign_at(q, x); s != 0) return s;
}
template <class Q, class P>
int sign_before(Q q, RootOf<P>& x) {
    for (int flip = 1;; flip = -flip, q = derivative(q))
        if (const int s = sign_at(q, x); s != 0) return flip * s;
}

}  // namespace cfree
