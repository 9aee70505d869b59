// Sums of square roots of integers, and roots of quadratic polynomials with such coefficients: signs and orders, exactly.
//
// A sign is that of a double if it is certain, else it is found by squaring. Nothing rests on the roots being independent.
#pragma once
#include <algorithm>
#include <bit>
#include <concepts>
#include <optional>
#include <vector>

#include "cfree/exact/polynomial.hpp"
#include "cfree/exact/ratio.hpp"

namespace cfree {

// True if sqrt(m) is a rational multiple of sqrt(n): then both are integer multiples of the root of their common divisor.
inline bool is_multiple_of_root(const Int& m, const Int& n) { return m == n || is_square(Int(m * n)); }
// The numbers of both lists, in order; in place of those with such roots their common divisor.
std::vector<Int> joined(const std::vector<Int>& x, const std::vector<Int>& y);

// The sum of c[k] times the square roots whose bits are set in k. C is a ring that has the integers: `Int` or `LongPoly`.
template <class C>
struct Surds {
    std::vector<Int> roots;  // no squares, in order
    std::vector<C> c;        // 2^(number of roots)

    template <class V = int>
        requires(!std::same_as<V, Surds> && std::convertible_to<V, C>)
    Surds(const V& value = 0) : c{C(value)} {}
    static Surds root(const Int& n) {  // sqrt(n), n >= 0
        const Int whole = root_below(n);
        return whole * whole == n ? Surds(whole) : Surds({n}, {C(0), C(1)});
    }
    Surds(std::vector<Int> r, std::vector<C> coefficients) : roots(std::move(r)), c(std::move(coefficients)) {}

    bool is_rational() const { return roots.empty(); }
    // With integers only. The sign is exact, the value rounded, and within the range of doubles.
    int sign() const;
    double value() const;

    Surds operator-() const {
        Surds result = *this;
        for (C& x : result.c) x = -x;
        return result;
    }
    friend Surds operator+(const Surds& x, const Surds& y) {
        const std::vector<Int> all = joined(x.roots, y.roots);
        Surds result = x.over(all);
        const Surds other = y.over(all);
        for (std::size_t k = 0; k < result.c.size(); ++k) result.c[k] += other.c[k];
        return result;
    }
    friend Surds operator-(const Surds& x, const Surds& y) { return x + -y; }
    friend Surds operator*(const Surds& x, const Surds& y) {
        if (x.is_rational() && y.is_rational()) return Surds(x.c[0] * y.c[0]);
        if ((x.is_rational() && x.c[0].is_zero()) || (y.is_rational() && y.c[0].is_zero())) return Surds();
        const std::vector<Int> all = joined(x.roots, y.roots);
        const Surds p = x.over(all), q = y.over(all);
        Surds result(all, std::vector<C>(p.c.size(), C(0)));
        for (std::size_t i = 0; i < p.c.size(); ++i) {
            if (p.c[i].is_zero()) continue;
            for (std::size_t j = 0; j < q.c.size(); ++j) {
                if (q.c[j].is_zero()) continue;
                C term = p.c[i] * q.c[j];
                for (std::size_t k = 0; k < all.size(); ++k)
                    if ((i & j) >> k & 1) term *= all[k];
                result.c[i ^ j] += term;
            }
        }
        return result;
    }

    // The same sum with these roots, joined from its own and others.
    Surds over(const std::vector<Int>& more) const {
        if (more == roots) return *this;
        Surds result(more, std::vector<C>(std::size_t(1) << more.size(), C(0)));
        std::vector<std::size_t> place;
        std::vector<Int> factor;  // sqrt(roots[i]) = factor[i] sqrt(more[place[i]])
        for (const Int& n : roots) {
            const auto same = std::find_if(more.begin(), more.end(), [&](const Int& m) { return is_multiple_of_root(m, n); });
            place.push_back(static_cast<std::size_t>(same - more.begin()));
            factor.push_back(*same == n ? Int(1) : root_below(Int(n / *same)));
        }
        for (std::size_t k = 0; k < c.size(); ++k) {
            std::size_t to = 0;
            C term = c[k];
            for (std::size_t i = 0; i < roots.size(); ++i)
                if (k >> i & 1) {
                    to |= std::size_t(1) << place[i];
                    if (factor[i] != 1) term *= factor[i];
                }
            result.c[to] += term;
        }
        return result;
    }
    // a and b with a + b sqrt(roots[h]) for this sum.
    std::array<Surds, 2> split(std::size_t h) const {
        std::vector<Int> others = roots;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(h));
        std::array<Surds, 2> parts{Surds(others, {}), Surds(others, {})};
        for (std::size_t k = 0; k < c.size(); ++k) parts[k >> h & 1].c.push_back(c[k]);
        return parts;
    }
    std::array<Surds, 2> split() const { return split(roots.size() - 1); }
    // A positive multiple with roots of which no product is a square: it is zero only if all its c are.
    Surds independent() const {
        for (std::size_t k = 1; k < c.size(); ++k) {
            if (std::has_single_bit(k)) continue;
            const auto h = static_cast<std::size_t>(std::bit_width(k)) - 1;
            Int others = 1;
            Surds rest(1);
            for (std::size_t i = 0; i < h; ++i)
                if (k >> i & 1) others *= roots[i], rest = rest * root(roots[i]);
            const Int square = others * roots[h];
            if (!is_square(square)) continue;
            const auto [a, b] = split(h);  // sqrt(roots[h]) is sqrt(square) / others times the other roots
            return (Surds(others) * a + Surds(root_below(square)) * b * rest).independent();
        }
        return *this;
    }
};

using RootSum = Surds<Int>;
template <>
int RootSum::sign() const;
template <>
double RootSum::value() const;

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
