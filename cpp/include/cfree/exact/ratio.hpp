// Rationals: read from decimals, "p/q" and doubles, rounded to the nearest double; sums, products and orders of them.
#pragma once
#include <compare>
#include <optional>
#include <string>
#include <string_view>

#include "cfree/exact/number.hpp"

namespace cfree {

// In lowest terms, d > 0.
struct Ratio {
    Int n = 0, d = 1;
    friend bool operator==(const Ratio&, const Ratio&) = default;
    friend std::strong_ordering operator<=>(const Ratio& x, const Ratio& y) {
        return Int(x.n * y.d).compare(Int(y.n * x.d)) <=> 0;
    }
};

inline constexpr int most_digits = 4000;  // longer numbers are refused: no coordinate needs them

// Read a text like "0.1", "-2e3" or "1/3", in ASCII; nothing if it is no number, divides by zero, or is too long.
std::optional<Ratio> ratio_of(std::string_view text);
Ratio ratio_of(double value);  // finite
Ratio reduced(Int n, Int d);   // d is not zero
Ratio power_of_two(int exponent);

inline Ratio operator-(const Ratio& x) { return {-x.n, x.d}; }
inline Ratio operator+(const Ratio& x, const Ratio& y) { return reduced(x.n * y.d + y.n * x.d, x.d * y.d); }
inline Ratio operator-(const Ratio& x, const Ratio& y) { return reduced(x.n * y.d - y.n * x.d, x.d * y.d); }
inline Ratio operator*(const Ratio& x, const Ratio& y) { return reduced(x.n * y.n, x.d * y.d); }
inline Ratio operator/(const Ratio& x, const Ratio& y) { return reduced(x.n * y.d, x.d * y.n); }  // y is not zero

// Fraction of least denominator in [low, high], the nearest to 0 of those.
Ratio simplest_between(const Ratio& low, const Ratio& high);
// A simple fraction in the middle half of an interval.
Ratio simple_middle(const Ratio& low, const Ratio& high);

double nearest(const Int& n, const Int& d);  // n / d rounded once, to even; d > 0, the quotient below 2^1023

// "-1/3", "2".
std::string text_of(const Ratio& value);
// Shortest decimal that reads back as this double, as Python writes it: "0.1", "1e-05", "2.0".
std::string text_of(double value);

}  // namespace cfree
