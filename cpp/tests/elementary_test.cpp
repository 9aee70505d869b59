// Against the machine's own functions, which are within one unit of the last place.
#include <limits>
#include <numbers>
#include <random>

#include "cfree/exact/radians.hpp"
#include "cfree/support/elementary.hpp"
#include "check.hpp"

namespace {

constexpr double unit = std::numeric_limits<double>::epsilon(), pi = std::numbers::pi;
constexpr double none_of_them = std::numeric_limits<double>::quiet_NaN();

bool close(double a, double b, double units = 2) { return std::abs(a - b) <= units * unit * std::abs(b); }

}  // namespace

int main() {
    std::mt19937_64 random(1);
    const auto between = [&](double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(random() >> 11) * 0x1p-53); };
    for (int k = 0; k < 200000; ++k) {
        const double x = between(-1, 1) * std::ldexp(1.0, static_cast<int>(random() % 24) - 20);
        const auto [c, s] = cfree::cosine_sine(x);
        // near a zero the rounding of x itself is larger than one of the value
        CHECK(std::abs(c - std::cos(x)) <= unit && std::abs(s - std::sin(x)) <= unit);
        if (std::abs(x) < 3) CHECK(close(s, std::sin(x)));
        const double y = between(-1, 1) * std::ldexp(1.0, static_cast<int>(random() % 100) - 50);
        CHECK(close(cfree::arc_tangent(y), std::atan(y)));
        CHECK(close(cfree::arc_tangent(y, x), std::atan2(y, x)));
        CHECK(close(cfree::norm(x, y), std::hypot(x, y)));
        if (std::abs(c) > 1e-3) CHECK(close(cfree::tangent(x), std::tan(x), 6));
    }
    for (int k = 0; k < 20000; ++k) {
        const double x = between(-1, 1) * std::ldexp(1.0, static_cast<int>(random() % 30) - 10), turned = cfree::in_a_turn(x);
        CHECK(0 <= turned && turned <= 2 * pi);
        CHECK(std::abs(std::cos(turned) - std::cos(x)) <= 8 * unit && std::abs(std::sin(turned) - std::sin(x)) <= 8 * unit);
        const auto read = cfree::read_radians(x);
        CHECK(read && std::abs(read->theta - turned) <= 8 * unit && gcd(read->q, read->p) == 1 && read->q >= 0);
        const double half = 2 * std::atan2(static_cast<double>(read->p), static_cast<double>(read->q));
        CHECK(std::abs(std::remainder(half - turned, 2 * pi)) <= 8 * unit);
    }
    CHECK(std::isnan(cfree::in_a_turn(1e300)) && !cfree::read_radians(0x1p63) && !cfree::read_radians(none_of_them));
    for (const double x : {pi, -pi, 3 * pi}) CHECK(cfree::read_radians(x)->q == 0 && cfree::read_radians(x)->p == 1);
    for (const double x : {0.0, pi, -pi, pi / 2, -pi / 2, 2 * pi, 1000 * pi})
        CHECK(close(cfree::sine(x), std::sin(x)) && close(cfree::cosine(x), std::cos(x)));
    for (const double size : {0.0, 1e-300, 1e-160, 1e160, 1e300}) CHECK(close(cfree::norm(3 * size, 4 * size), 5 * size));
    const double infinite = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
    CHECK(cfree::arc_tangent(infinite) == pi / 2 && cfree::arc_tangent(-infinite) == -pi / 2);
    CHECK(cfree::norm(infinite, 1) == infinite && std::isnan(cfree::norm(none, 1)) && std::isnan(cfree::norm(1, none)));
    CHECK(std::isnan(cfree::arc_tangent(none)) && std::isnan(cfree::sine(none)));
    for (const double y : {0.0, -0.0, 1.0, -1.0})
        for (const double x : {0.0, -0.0, 1.0, -1.0, -5.0}) {
            CHECK(cfree::arc_tangent(y, x) == std::atan2(y, x));
            CHECK(std::signbit(cfree::arc_tangent(y, x)) == std::signbit(std::atan2(y, x)));
        }
    return failures > 0;
}
