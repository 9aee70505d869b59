// Polynomials of any degree with integer coefficients: arithmetic, common divisors, real roots.
#pragma once
#include <algorithm>
#include <concepts>
#include <optional>
#include <utility>
#include <vector>

#include "cfree/exact/polynomial.hpp"

namespace cfree {

// Coefficients from the constant up; no leading zeros; empty is zero. `Poly` is the same up to degree 6, and faster.
class LongPoly {
public:
    LongPoly() = default;
    LongPoly(const Int& constant) : c{constant} { trim(); }
    LongPoly(std::integral auto constant) : LongPoly(Int(constant)) {}
    LongPoly(std::initializer_list<Int> coefficients) : c(coefficients) { trim(); }
    explicit LongPoly(std::vector<Int> coefficients) : c(std::move(coefficients)) { trim(); }
    explicit LongPoly(const Poly& p) : c(p.begin(), p.end()) {}
    int size() const { return static_cast<int>(c.size()); }
    int degree() const { return std::max(size() - 1, 0); }  // 0 for zero
    bool empty() const { return c.empty(); }
    bool is_zero() const { return c.empty(); }
    Int& operator[](int i) { return c[static_cast<std::size_t>(i)]; }
    const Int& operator[](int i) const { return c[static_cast<std::size_t>(i)]; }
    const Int& back() const { return c.back(); }
    void resize(int n) { c.resize(static_cast<std::size_t>(n)); }
    void trim() {
        while (!c.empty() && c.back().is_zero()) c.pop_back();
    }
    auto begin() { return c.begin(); }
    auto end() { return c.end(); }
    auto begin() const { return c.begin(); }
    auto end() const { return c.end(); }

    LongPoly& operator+=(const LongPoly& q);
    LongPoly& operator*=(const Int& factor);
    LongPoly operator-() const;
    friend bool operator==(const LongPoly&, const LongPoly&) = default;

private:
    std::vector<Int> c;
};

LongPoly operator+(LongPoly p, const LongPoly& q);
LongPoly operator-(const LongPoly& p, const LongPoly& q);
LongPoly operator*(const LongPoly& p, const LongPoly& q);
LongPoly derivative(const LongPoly& p);
LongPoly primitive(LongPoly p);                                          // without a common factor of its coefficients
std::optional<LongPoly> quotient(LongPoly p, const LongPoly& q);         // if it has integer coefficients; q is not zero
Int value_at(const LongPoly& p, const Dyadic& tau);                      // times 2^(k d), d the degree
int sign_at(const LongPoly& p, const Dyadic& tau);
int sign_on(const LongPoly& p, const Dyadic& lo, const Dyadic& hi);      // on the whole closed interval, 0 if not certain
LongPoly greatest_common_divisor(const LongPoly& p, const LongPoly& q);  // primitive
LongPoly squarefree(const LongPoly& p);

// The roots of a squarefree polynomial strictly between lo and hi, in order: open intervals, each with one root and without
// roots at its ends, or lo = hi, the root.
std::vector<std::array<Dyadic, 2>> isolate(const LongPoly& squarefree, const Dyadic& lo, const Dyadic& hi);
// Number of roots of a squarefree polynomial in (lo, hi].
int roots_in(const LongPoly& squarefree, const Dyadic& lo, const Dyadic& hi);

}  // namespace cfree
