// Reduce arguments to near 0, and use Taylor's series there.
#include "cfree/support/elementary.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numbers>

namespace cfree {

namespace {

template <std::size_t N>
double horner(const std::array<double, N>& coefficients, double x) {  // the first is the highest
    double sum = 0;
    for (const double c : coefficients) sum = sum * x + c;
    return sum;
}

// Series for |x| up to pi / 4: the first omitted term is below 2^-65 of the sum.
constexpr std::array sine_series{1.0 / 355687428096000, -1.0 / 1307674368000, 1.0 / 6227020800, -1.0 / 39916800,
                                 1.0 / 362880,          -1.0 / 5040,          1.0 / 120,        -1.0 / 6};
constexpr std::array cosine_series{-1.0 / 6402373705728000, 1.0 / 20922789888000, -1.0 / 87178291200, 1.0 / 479001600,
                                   -1.0 / 3628800,          1.0 / 40320,          -1.0 / 720,         1.0 / 24};
// Series for |x| up to 1 / 16.
constexpr std::array arc_series{-1.0 / 15, 1.0 / 13, -1.0 / 11, 1.0 / 9, -1.0 / 7, 1.0 / 5, -1.0 / 3};

// A quarter of a turn: 33 bits, 33 bits, and the rest.
constexpr double quarter = 0x1.921fb544p+0, quarter_next = 0x1.0b4611a6p-34, quarter_last = 0x1.3198a2e037073p-69;

// Arc tangents of 0, 1/8, .. 1, and their rounding errors.
constexpr std::array arcs{0.0,
                          0.12435499454676144,
                          0.24497866312686414,
                          0.35877067027057225,
                          0.4636476090008061,
                          0.5585993153435624,
                          0.6435011087932844,
                          0.7188299996216245,
                          0.7853981633974483};
constexpr std::array arcs_rounding{0.0,
                                   -3.1253241424539383e-18,
                                   1.0698755618734451e-17,
                                   -2.4623815582638635e-17,
                                   2.2698777452961687e-17,
                                   -5.4556305485916264e-18,
                                   1.5834785051444286e-17,
                                   -2.1478388444456983e-17,
                                   3.061616997868383e-17};
constexpr double most_quarters = 0x1p+20;  // up to this many quarters, products with 33 bits are exact doubles
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double pi_rounding = 1.2246467991473532e-16, half_pi_rounding = pi_rounding / 2;

}  // namespace

// The nearest number of quarters, and the rest, within 2^-53.
struct Quarters {
    double count, rest;
    explicit Quarters(double x)
        : count(std::nearbyint(x * (2 / std::numbers::pi))),
          rest(((x - count * quarter) - count * quarter_next) - count * quarter_last) {}
    bool are_too_many() const { return !(std::abs(count) < most_quarters); }
    int in_a_turn() const { return static_cast<int>(static_cast<long long>(count) & 3); }
};

CosineSine cosine_sine(double x) {
    const Quarters q(x);
    if (q.are_too_many()) return {none, none};
    const double r = q.rest, z = r * r;
    const double s = r + r * z * horner(sine_series, z), most = 1 - 0.5 * z;
    const double c = most + (((1 - most) - 0.5 * z) + z * z * horner(cosine_series, z));
    switch (q.in_a_turn()) {
    case 0: return {c, s};
    case 1: return {-s, c};
    case 2: return {-c, -s};
    default: return {s, -c};
    }
}

double in_a_turn(double x) {
    const Quarters q(x);
    if (q.are_too_many()) return none;
    const int count = q.in_a_turn();
    return (count == 0 && q.rest < 0 ? 4 : count) * (std::numbers::pi / 2) + q.rest;
}

double norm_of_extremes(double x, double y) {
    const double most = std::max(std::abs(x), std::abs(y));
    if (most == 0 || !(std::isfinite(x) && std::isfinite(y))) return std::abs(x) + std::abs(y);
    const int exponent = std::ilogb(most);
    return std::ldexp(norm(std::ldexp(x, -exponent), std::ldexp(y, -exponent)), exponent);
}

double tangent(double x) {
    const auto [c, s] = cosine_sine(x);
    return s / c;
}

double arc_tangent(double x) {
    if (std::isnan(x)) return x;
    const double size = std::abs(x);
    if (size > 1) return std::copysign(std::numbers::pi / 2 - (arc_tangent(1 / size) - half_pi_rounding), x);
    const double nearest = std::nearbyint(8 * size);
    const double r = (size - nearest / 8) / (1 + size * (nearest / 8)), z = r * r;
    const auto k = static_cast<std::size_t>(nearest);
    return std::copysign(arcs[k] + (arcs_rounding[k] + (r + r * z * horner(arc_series, z))), x);
}

double arc_tangent(double y, double x) {
    if (x > 0) return arc_tangent(y / x);
    if (x == 0 && y == 0) return std::signbit(x) ? std::copysign(std::numbers::pi, y) : y;
    if (std::abs(y) >= -x) return std::copysign(std::numbers::pi / 2, y) + (std::copysign(half_pi_rounding, y) - arc_tangent(x / y));
    return std::copysign(std::numbers::pi, y) + (std::copysign(pi_rounding, y) + arc_tangent(y / x));
}

}  // namespace cfree
