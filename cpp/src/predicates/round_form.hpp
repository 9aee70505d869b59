// Polynomials of the events among grown shapes in doubles: a quadratic, or a sum of products of two or three of them.
//
// A coefficient is within `round_error` of the truth, relative to its magnitude: at most 20 roundings in a row, of which the polar
// form makes 25 and doubles the magnitude.
#pragma once
#include "predicates/form.hpp"
#include "predicates/round_surfaces.hpp"

namespace cfree {

inline constexpr double round_error = 0x1p-46;  // 128 u

// Common sign of Bernstein coefficients, if there is one.
inline int common_sign(const int* sign, int degree) {
    return std::all_of(sign, sign + degree + 1, [&](int s) { return s == sign[0]; }) ? sign[0] : 0;
}

inline Filtered filtered_round(const Trig<Approx>& f, double kappa) {
    return {f.a.v, kappa * f.b.v, kappa * f.c.v, round_error * (f.a.m + f.b.m + f.c.m) + tiny};
}

// As Predicates::Form; the polynomial is p, or a sum of products of two or three factors; see Products.
struct RoundForm {
    using Term = Products<Approx>::Term;
    int degree = 2;
    Filtered p;
    Few<Filtered, 7> factors;
    Few<Term, 4> terms;

    struct Value {
        double v, err;
    };
    Value at(double t) const {
        if (degree == 2) return {p.polar(t, t), p.err};
        double value[7];
        for (int i = 0; i < factors.size(); ++i) value[i] = factors[i].polar(t, t);
        Value sum{0, tiny};
        for (const Term& term : terms) {
            double v = term.sign, most = 1, err = 0;  // the product, its magnitude and its error, so far
            for (std::size_t i = 0; i < static_cast<std::size_t>(degree / 2); ++i) {
                const double x = value[term.factors[i]], e = factors[term.factors[i]].err;
                v *= x, err = err * (std::abs(x) + e) + most * e, most *= std::abs(x);
            }
            sum.v += v, sum.err += err + product_error * most;
        }
        sum.err *= 1 + 16 * u;
        return sum;
    }
    int sign(double t) const {
        const Value value = at(t);
        return value.v > value.err ? 1 : value.v < -value.err ? -1 : 0;
    }
    // Of Bernstein coefficients times binomial ones, which products convolve.
    void signs(double lo, double hi, int* sign) const {
        double sum[7] = {}, err = tiny;
        if (degree == 2) {
            sum[0] = p.polar(lo, lo), sum[1] = p.polar(lo, hi), sum[2] = p.polar(hi, hi), err = p.err;
        } else {
            double c[7][3], size[7];
            for (int i = 0; i < factors.size(); ++i) {
                c[i][0] = factors[i].polar(lo, lo), c[i][1] = 2 * factors[i].polar(lo, hi), c[i][2] = factors[i].polar(hi, hi);
                size[i] = std::abs(c[i][0]) + std::abs(c[i][1]) + std::abs(c[i][2]);
            }
            for (const Term& term : terms) {
                const double *x = c[term.factors[0]], *y = c[term.factors[1]];
                double product[7] = {x[0] * y[0], x[0] * y[1] + x[1] * y[0], x[0] * y[2] + x[1] * y[1] + x[2] * y[0],
                                     x[1] * y[2] + x[2] * y[1], x[2] * y[2], 0, 0};
                if (degree == 6) {
                    const double* z = c[term.factors[2]];
                    for (int n = 6; n >= 0; --n) {
                        const double below = n > 0 ? product[n - 1] : 0, lowest = n > 1 ? product[n - 2] : 0;
                        product[n] = product[n] * z[0] + below * z[1] + lowest * z[2];
                    }
                }
                for (int n = 0; n <= degree; ++n) sum[n] += term.sign * product[n];
                double most = 1, loss = 0;
                for (std::size_t i = 0; i < static_cast<std::size_t>(degree / 2); ++i) {
                    const double e = 4 * factors[term.factors[i]].err, s = size[term.factors[i]];
                    loss = loss * (s + e) + most * e, most *= s;
                }
                err += loss + 16 * u * most;
            }
            err *= 1 + 16 * u;
        }
        for (int n = 0; n <= degree; ++n) sign[n] = sum[n] > err ? 1 : sum[n] < -err ? -1 : 0;
    }
    std::optional<double> extremum(double, double) const { return {}; }
    bool may_touch() const { return degree == 2 && cfree::may_touch(p); }
};

}  // namespace cfree
