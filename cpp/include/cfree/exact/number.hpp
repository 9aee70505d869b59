// Number types of the decisions: exact integers of any size, and doubles with their magnitude.
#pragma once
#include <boost/multiprecision/cpp_int.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "cfree/support/bit_cast.hpp"
#include "cfree/support/index.hpp"

namespace cfree {

// Mode for the benchmark of the cost of exactness, and for nothing else: every sign is that of the double, even if uncertain.
#ifdef CFREE_DOUBLE_ONLY
inline constexpr bool double_only = true;
#else
inline constexpr bool double_only = false;
#endif

// Exact integers; up to 512 bits they need no heap.
using Int = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<512, 0, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, std::allocator<boost::multiprecision::limb_type>>,
    boost::multiprecision::et_off>;

// n / d, correctly rounded; d is not zero.
inline double ratio(const Int& n, const Int& d) {
    if (n.is_zero()) return 0;
    // 62 or 63 bits of the quotient, fewer of a subnormal one; the last is set if there is a remainder
    const Int p = abs(n), r = abs(d);
    const int up = std::min(62 + static_cast<int>(msb(r)) - static_cast<int>(msb(p)), 1076);
    Int quotient, rest;
    if (up >= 0) divide_qr(Int(p << static_cast<unsigned>(up)), r, quotient, rest);
    else divide_qr(p, Int(r << static_cast<unsigned>(-up)), quotient, rest);
    const auto bits = static_cast<std::uint64_t>(quotient) | (rest.is_zero() ? 0u : 1u);
    return n.sign() * d.sign() * std::ldexp(static_cast<double>(bits), -up);
}

// The least common multiple of positive integers of which one mostly divides the other.
inline Int common_multiple(const Int& a, const Int& b) {
    if (a == b || b == 1) return a;
    if (a == 1) return b;
    if (a > b ? Int(a % b).is_zero() : Int(b % a).is_zero()) return a > b ? a : b;
    return lcm(a, b);
}

// The largest integer whose square is at most n, which is not negative.
inline Int root_below(const Int& n) {
    if (n.is_zero() || msb(n) > 100) return sqrt(n);
    Int root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(n)));
    while (root * root > n) root -= 1;
    while ((root + 1) * (root + 1) <= n) root += 1;
    return root;
}

// True if n is the square of an integer; most others are known by their last six bits.
inline bool is_square(const Int& n) {
    if (n.sign() < 0 || (0x202021202030213u >> static_cast<unsigned>(n % 64u) & 1) == 0) return false;
    const Int root = root_below(n);
    return root * root == n;
}

// Only for numbers known to be wide enough.
__extension__ typedef __int128 Wide;

// A double v and the magnitude m of its summands. An expression of d roundings in a row, inputs included, satisfies
// |v - exact| <= d u m (1 + O(u)), u = 2^-53, except for underflow, which bounds allow for. Overflow makes m infinite, and
// then no comparison against a multiple of m succeeds.
struct Approx {
    double v, m;
};
inline Approx operator+(Approx p, Approx q) { return {p.v + q.v, p.m + q.m}; }
inline Approx operator-(Approx p, Approx q) { return {p.v - q.v, p.m + q.m}; }
inline Approx operator-(Approx p) { return {-p.v, p.m}; }
inline Approx operator*(Approx p, Approx q) { return {p.v * q.v, p.m * q.m}; }

// 2^-e for a positive x in [2^(e-1), 2^e); frexp without the call.
inline double power_below(double x) {
    const auto exponent = bit_cast<std::uint64_t>(x) >> 52;
    return bit_cast<double>((2045 - exponent) << 52);
}

template <class T>
struct Vec {
    T x, y;
};
template <class T>
Vec<T> operator-(const Vec<T>& p) { return {-p.x, -p.y}; }
template <class T>
Vec<T> operator+(const Vec<T>& p, const Vec<T>& q) { return {p.x + q.x, p.y + q.y}; }
template <class T>
Vec<T> operator-(const Vec<T>& p, const Vec<T>& q) { return {p.x - q.x, p.y - q.y}; }
template <class T>
T cross(const Vec<T>& p, const Vec<T>& q) { return p.x * q.y - p.y * q.x; }
template <class T>
T dot(const Vec<T>& p, const Vec<T>& q) { return p.x * q.x + p.y * q.y; }

}  // namespace cfree
