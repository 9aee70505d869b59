// Values and signs of polynomials with integer coefficients at dyadic numbers, for `Poly` and `LongPoly`.
#pragma once
#include <algorithm>

#include "cfree/exact/polynomial.hpp"

namespace cfree {

// Value times 2^(k d), d the degree.
template <class P>
Int exact_value(const P& p, const Dyadic& tau) {
    if (p.empty()) return 0;
    Int r = p.back();
    for (int i = p.size() - 1; i-- > 0;) {
        r *= tau.n;
        r += p[i] << (tau.k * static_cast<unsigned>(p.size() - 1 - i));
    }
    return r;
}

// Sign on the whole closed interval, 0 if not certain.
template <class P>
int certain_sign_on(const P& p, const Dyadic& lo, const Dyadic& hi) {
    if (p.empty()) return 0;
    const unsigned k = std::max(lo.k, hi.k);
    const Int from = lo.n << (k - lo.k), to = hi.n << (k - hi.k);
    // |p'| is at most the sum of i |p_i| 2^((i - 1) m) if |tau| is at most 2^m
    const Int largest = std::max(Int(abs(from)), Int(abs(to)));
    const unsigned bits = largest.is_zero() ? 0 : static_cast<unsigned>(msb(largest)) + 1, m = bits > k ? bits - k : 0;
    Int slope = 0;
    for (int i = 1; i < p.size(); ++i) slope += abs(p[i]) * i << (m * static_cast<unsigned>(i - 1));
    const Int value = exact_value(p, Dyadic{from, k});  // over 2^(k d), and so is its greatest change
    const Int change = p.size() < 2 ? Int(0) : Int(((to - from) * slope) << (k * static_cast<unsigned>(p.size() - 2)));
    return abs(value) > change ? value.sign() : 0;
}

}  // namespace cfree
