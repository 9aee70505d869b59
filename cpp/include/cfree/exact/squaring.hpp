// Signs of sums with square roots, by squaring.
//
// a + b sqrt(d) has the sign that its two summands share, or that of a times the sign of a^2 - b^2 d, in which the root is no
// more. T is a number, or a function of which `sign` takes the sign at one place; d and e are not negative there.
#pragma once

namespace cfree {

// a + b sqrt(d)
template <class T, class Sign>
int sign_by_squaring(const T& a, const T& b, const T& d, const Sign& sign) {
    const int first = sign(a), factor = sign(b), second = factor == 0 ? 0 : factor * sign(d);
    if (first * second >= 0) return first != 0 ? first : second;
    return first * sign(a * a - b * b * d);
}

// a + b sqrt(d) + (c + f sqrt(d)) sqrt(e)
template <class T, class Sign>
int sign_by_squaring(const T& a, const T& b, const T& d, const T& c, const T& f, const T& e, const Sign& sign) {
    const int first = sign_by_squaring(a, b, d, sign), root = sign(e);
    const int second = root == 0 ? 0 : root * sign_by_squaring(c, f, d, sign);
    if (first * second >= 0) return first != 0 ? first : second;
    const T twice = a * b - c * f * e;
    return first * sign_by_squaring(a * a + b * b * d - (c * c + f * f * d) * e, twice + twice, d, sign);
}

}  // namespace cfree
