// Interval arithmetic in twice the precision of doubles: the second rung of every decision.
//
// A ball holds its middle as an unevaluated sum hi + lo of two doubles, and a radius. Error-free transformations (Knuth's
// sum, the product with a fused multiply-add) give the exact rounding of an operation, and the radius grows by just that.
// If nothing is lost it stays zero: the value is exact, and even a zero is certain. This settles ties between small
// integers; ties between long ones are left to exact integers.
#pragma once
#include <limits>
#include <optional>

#include "cfree/exact/number.hpp"

namespace cfree {

// |hi + lo - truth| <= radius; hi is hi + lo rounded. Overflow leaves a NaN, which is never certain.
struct Ball {
    double hi = 0, lo = 0, radius = 0;
    Ball() = default;
    Ball(double value) : hi(value) {}
    Ball(double h, double l, double r) : hi(h), lo(l), radius(r) {}
};

// s + e = x + y exactly, s rounded. Sums have no underflow.
struct TwoDoubles {
    double s, e;
};
inline TwoDoubles two_sum(double x, double y) {
    const double s = x + y, part = s - x;
    return {s, (x - (s - part)) + (y - part)};
}
// s + e = x y, up to an error that is added to `lost`: below 2^-960 the rest e may round to a multiple of 2^-1074.
inline TwoDoubles two_product(double x, double y, double& lost) {
    const double p = x * y;
    if (!(std::abs(p) >= 0x1p-960) && x != 0 && y != 0) lost += 0x1p-1074;
    return {p, std::fma(x, y, -p)};
}

// Radii are sums of a dozen rounded terms: a relative 2^-48 covers their own rounding. Sums of subnormal numbers are exact;
// underflow of the products loses less than `least_radius`.
inline constexpr double radius_growth = 1 + 0x1p-48;
inline constexpr double least_radius = 0x1p-1070;

inline Ball operator-(const Ball& x) { return {-x.hi, -x.lo, x.radius}; }

inline Ball operator+(const Ball& x, const Ball& y) {
    const auto [s, e] = two_sum(x.hi, y.hi);
    if (x.lo == 0 && y.lo == 0) return {s, e, (x.radius + y.radius) * radius_growth};
    const auto [t, f] = two_sum(x.lo, y.lo);
    const auto [c, g] = two_sum(e, t);
    const auto [h, l] = two_sum(s, c);  // h + l + f + g
    const auto [m, d] = two_sum(l, f);
    const auto [n, k] = two_sum(m, g);
    const auto [hi, lo] = two_sum(h, n);
    return {hi, lo, (x.radius + y.radius + std::abs(d) + std::abs(k)) * radius_growth};
}
inline Ball operator-(const Ball& x, const Ball& y) { return x + -y; }

inline Ball operator*(const Ball& x, const Ball& y) {
    if (x.lo == 0 && y.lo != 0) return y * x;
    double lost = 0;
    auto [hi, lo] = two_product(x.hi, y.hi, lost);
    if (x.lo != 0 && y.lo == 0) {
        const auto [r, g] = two_product(x.lo, y.hi, lost);
        const auto [b, d] = two_sum(lo, r);
        const auto [n, k1] = two_sum(g, d);
        const auto [p, l] = two_sum(hi, b);
        const auto [m, k2] = two_sum(l, n);
        lost += std::abs(k1) + std::abs(k2);
        const auto [s, e] = two_sum(p, m);
        hi = s, lo = e;
    } else if (x.lo != 0) {
        const auto [q, f] = two_product(x.hi, y.lo, lost);
        const auto [r, g] = two_product(x.lo, y.hi, lost);
        const auto [z, h] = two_product(x.lo, y.lo, lost);
        const auto [a, d1] = two_sum(q, r);  // order of magnitude 2^-53
        const auto [b, d2] = two_sum(lo, a);
        const auto [v, k1] = two_sum(f, g);  // order of magnitude 2^-106
        const auto [w, k2] = two_sum(v, z);
        const auto [d, k3] = two_sum(d1, d2);
        const auto [n, k4] = two_sum(w, d);
        const auto [p, l] = two_sum(hi, b);
        const auto [m, k5] = two_sum(l, n);
        lost += std::abs(h) + std::abs(k1) + std::abs(k2) + std::abs(k3) + std::abs(k4) + std::abs(k5);
        const auto [s, e] = two_sum(p, m);
        hi = s, lo = e;
    }
    if (x.radius != 0 || y.radius != 0)
        lost += std::abs(x.hi) * y.radius + std::abs(y.hi) * x.radius + x.radius * y.radius + least_radius;
    return {hi, lo, lost * radius_growth};
}

// Square root of a number in the ball that is not negative; NaN if there is none. The residual x - y^2 bounds the error of
// the root y: |sqrt(x) - y| <= |x - y^2| / y. Exact roots stay exact.
inline Ball sqrt(const Ball& x) {
    const double most = (std::abs(x.hi) + x.radius) * radius_growth;
    if (most == 0) return {};
    if (!(x.hi > 2 * x.radius)) {  // from zero to a bound
        const double half = x.hi >= -x.radius ? std::sqrt(most) * radius_growth / 2 : std::numeric_limits<double>::quiet_NaN();
        return {half, 0, half};
    }
    const double guess = std::sqrt(x.hi), correction = (std::fma(-guess, guess, x.hi) + x.lo) / (2 * guess);
    const auto [hi, lo] = two_sum(guess, correction);
    const Ball y(hi, lo, 0), residual = x - y * y;
    const double rest = std::abs(residual.hi) + residual.radius;
    return {hi, lo, rest == 0 ? 0 : rest / hi * radius_growth + least_radius};
}

// Sign of a ball, if it is certain.
inline std::optional<int> certain_sign(const Ball& x) {
    const double value = x.hi + x.lo;
    if (value > 2 * x.radius) return 1;
    if (value < -2 * x.radius) return -1;
    if (value == 0 && x.radius == 0) return 0;
    return {};
}

// True if one exact middle is below another.
inline bool is_below(const Ball& x, const Ball& y) { return x.hi < y.hi || (x.hi == y.hi && x.lo < y.lo); }

// Bound of the loss when a longer number becomes a sum of two doubles: cut after 106 digits, or subnormal.
inline double ball_error(double hi) { return std::abs(hi) * 0x1p-104 + least_radius; }

// n / 2^k
inline Ball ball(const Int& n, int k) {
    if (n.is_zero()) return {};
    const Int m = abs(n);
    const int bits = static_cast<int>(msb(m)) + 1, first = bits > 53 ? bits - 53 : 0, second = first > 53 ? first - 53 : 0;
    const Int top = m >> static_cast<unsigned>(first), rest = m - (top << static_cast<unsigned>(first));
    const Int low = rest >> static_cast<unsigned>(second);
    const bool exact = second - k >= -1074 && (low << static_cast<unsigned>(second)) == rest;
    const auto [hi, lo] = two_sum(std::ldexp(static_cast<double>(static_cast<std::int64_t>(top)), first - k),
                                  std::ldexp(static_cast<double>(static_cast<std::int64_t>(low)), second - k));
    const double sign = n.sign();
    return {sign * hi, sign * lo, exact ? 0 : ball_error(hi)};
}

}  // namespace cfree
