// Sums of square roots of integers, and roots of quadratic polynomials with such coefficients: signs and orders, exactly.
//
// A sign is that of a double if it is certain, else it is found by squaring: A + B sqrt(n) has the sign that A and B share, or
// that of A times the sign of A^2 - B^2 n, in which sqrt(n) is no more. Nothing rests on the roots being independent.
#pragma once
#include <optional>
#include <vector>

#include "cfree/exact/polynomial.hpp"
#include "cfree/exact/ratio.hpp"

namespace cfree {

// The sum of c[k] times the roots whose bits are set in k.
class RootSum {
public:
    RootSum(Int value = 0) : c{std::move(value)} {}
    static RootSum root(const Int& n);  // sqrt(n), n >= 0
    int sign() const;
    double value() const;  // rounded, within the range of doubles
    bool is_rational() const { return roots.empty(); }

    friend RootSum operator+(const RootSum& x, const RootSum& y);
    friend RootSum operator-(const RootSum& x, const RootSum& y);
    friend RootSum operator*(const RootSum& x, const RootSum& y);
    RootSum operator-() const;

private:
    RootSum over(const std::vector<Int>& more) const;  // the same with these roots
    std::vector<Int> roots, c;
};

// A real root of a u^2 + b u + c: the one at which the polynomial grows if `rises`, else the one at which it falls. A straight
// line has one of the two.
class QuadraticRoot {
public:
    using Terms = std::array<RootSum, 3>;  // c, b, a
    QuadraticRoot(Terms terms, bool at_rise);
    // Sign of the root minus n / d, d > 0.
    int against(const Ratio& x) const;
    int against(const QuadraticRoot& other) const;
    // Bounds of the root, which are dyadic: at most 2^-50 of its size apart, if the search ends; they serve for speed.
    Ratio low, high;

private:
    Terms f;
    bool rises;
};

// The real roots of a quadratic polynomial that are strictly between two rationals.
void add_roots(const QuadraticRoot::Terms& f, const Ratio& from, const Ratio& to, std::vector<QuadraticRoot>& roots);

// A rational strictly between each two neighbours of `from`, the roots, in order, and `to`.
std::vector<Ratio> samples_between(std::vector<QuadraticRoot>& roots, const Ratio& from, const Ratio& to);

}  // namespace cfree
