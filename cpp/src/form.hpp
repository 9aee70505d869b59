// Inside the core: what signs, roots and angles share. Error constants, and the polynomials whose roots are sought.
#pragma once
#include <algorithm>

#include "cfree/predicates.hpp"

namespace cfree {

inline constexpr double u = 0x1p-53;
// Coefficients are one cross or dot product of differences: at most 6 roundings in a row. The polar form adds 5 and at
// most doubles the magnitude: 22 u would do.
inline constexpr double coefficient_error = 32 * u;
inline constexpr double product_error = 8 * u;
// More than any underflow loses: coefficients are far above it or zero.
inline constexpr double tiny = 0x1p-1000;

// A quadratic p, or the quartic p q - r s.
struct Predicates::Form {
    int degree;
    Filtered p, q, r, s;

    struct Value {
        double v, err;
    };
    Value at(double t) const {
        const double x = p.polar(t, t);
        if (degree == 2) return {x, p.err};
        const double y = q.polar(t, t), z = r.polar(t, t), w = s.polar(t, t);
        return {x * y - z * w, std::abs(x) * q.err + std::abs(y) * p.err + std::abs(z) * s.err + std::abs(w) * r.err +
                                   p.err * q.err + r.err * s.err + product_error * (std::abs(x * y) + std::abs(z * w)) + tiny};
    }
    // Bernstein coefficients on [lo, hi], all within the error returned
    double bernstein(double lo, double hi, double* c) const {
        const double p0 = p.polar(lo, lo), p1 = p.polar(lo, hi), p2 = p.polar(hi, hi);
        if (degree == 2) {
            c[0] = p0, c[1] = p1, c[2] = p2;
            return p.err;
        }
        const double q0 = q.polar(lo, lo), q1 = q.polar(lo, hi), q2 = q.polar(hi, hi);
        const double r0 = r.polar(lo, lo), r1 = r.polar(lo, hi), r2 = r.polar(hi, hi);
        const double s0 = s.polar(lo, lo), s1 = s.polar(lo, hi), s2 = s.polar(hi, hi);
        c[0] = p0 * q0 - r0 * s0;
        c[1] = 0.5 * ((p0 * q1 + p1 * q0) - (r0 * s1 + r1 * s0));
        c[2] = ((p0 * q2 + 4 * (p1 * q1) + p2 * q0) - (r0 * s2 + 4 * (r1 * s1) + r2 * s0)) / 6;
        c[3] = 0.5 * ((p1 * q2 + p2 * q1) - (r1 * s2 + r2 * s1));
        c[4] = p2 * q2 - r2 * s2;
        const auto largest = [](double x, double y, double z) { return std::max({std::abs(x), std::abs(y), std::abs(z)}); };
        const double P = largest(p0, p1, p2), Q = largest(q0, q1, q2), R = largest(r0, r1, r2), S = largest(s0, s1, s2);
        return P * q.err + Q * p.err + R * s.err + S * r.err + p.err * q.err + r.err * s.err +
               2 * product_error * (P * Q + R * S) + tiny;
    }
};

}  // namespace cfree
