// Common parts of signs, roots and angles, inside the core: error constants, the rungs, and the polynomials with their roots.
#pragma once
#include <algorithm>
#include <chrono>

#include "cfree/predicates/predicates.hpp"

namespace cfree {

inline constexpr double u = 0x1p-53;
inline constexpr double product_error = 8 * u;

inline std::optional<int> certain_sign(const Int& n) { return n.sign(); }

// True if two polynomials are equal, up to a factor.
template <class T>
std::optional<bool> are_proportional(const Coefficients<T>& p, const Coefficients<T>& q) {
    const int count = std::max(p.count, q.count);
    const auto is_zero = [](const T& x) { return certain_sign(x) == 0; };
    bool are_equal = true;  // balls of two equal numbers are equal, but their products with others may be too long
    for (int i = 0; i < count && are_equal; ++i) are_equal = is_zero(p.c[i] - q.c[i]);
    if (are_equal) return true;
    for (int i = 0; i + 1 < count; ++i)
        for (int j = i + 1; j < count; ++j) {
            const auto sign = certain_sign(p.c[i] * q.c[j] - p.c[j] * q.c[i]);
            if (!sign || *sign != 0) return sign ? std::optional(false) : std::nullopt;
        }
    return true;
}

// Decide cases that the filter leaves open, with one formula for both number types: balls, then exact integers.
template <class Question>
auto settled(Counters& counters, Question&& question) {
    const auto by_balls = question.template operator()<Ball>();
    if (by_balls) return ++counters.interval, *by_balls;
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto exactly = question.template operator()<Int>();
    counters.exact_seconds += std::chrono::duration<double>(Clock::now() - start).count();
    return ++counters.exact, *exactly;
}

// k f - l g for constants k and l.
template <class T>
Trig<T> combination(const Trig<T>& k, const Trig<T>& f, const Trig<T>& l, const Trig<T>& g) {
    return {k.a * f.a - l.a * g.a, k.a * f.b - l.a * g.b, k.a * f.c - l.a * g.c};
}
inline Filtered combination(const Filtered& k, const Filtered& f, const Filtered& l, const Filtered& g) {
    const double a = k.a * f.a - l.a * g.a, b = k.a * f.b - l.a * g.b, c = k.a * f.c - l.a * g.c;
    if constexpr (double_only) return {a, b, c, 0};
    const double mf = 2 * (std::abs(f.a) + std::abs(f.b) + std::abs(f.c));
    const double mg = 2 * (std::abs(g.a) + std::abs(g.b) + std::abs(g.c));
    const double err = (std::abs(k.a) + k.err) * f.err + (std::abs(l.a) + l.err) * g.err +
                       mf * (k.err + product_error * std::abs(k.a)) + mg * (l.err + product_error * std::abs(l.a));
    return {a, b, c, err * (1 + 8 * u) + tiny};
}

// Order of two curves, N1 D2 - N2 D1: a quadratic p if constants allow, without the then common factor 1 + tau^2, or the
// quartic p q - r s.
template <class Q>
struct Terms {
    int degree;
    Q p, q, r, s;
};
struct Constants {
    bool curve, denominator;  // see Curve
};
template <class Q>
Terms<Q> terms(Constants first, const Q& N1, const Q& D1, Constants second, const Q& N2, const Q& D2) {
    if (first.denominator && second.denominator) return {2, combination(D2, N1, D1, N2), {}, {}, {}};
    if (first.curve) return {2, combination(N1, D2, D1, N2), {}, {}, {}};
    if (second.curve) return {2, combination(D2, N1, N2, D1), {}, {}, {}};
    return {4, N1, D2, N2, D1};
}

// Coefficients of a + b cos + c sin in tau, times 1 + tau^2.
template <class T>
std::array<T, 3> quadratic(const Trig<T>& f, double kappa) {
    if (kappa > 0) return {f.a + f.b, f.c + f.c, f.a - f.b};
    return {f.a - f.b, -(f.c + f.c), f.a + f.b};
}

// Coefficients of a quadratic.
template <class T>
Coefficients<T> derivative(const Coefficients<T>& p) {
    return {{p.c[1], p.c[2] + p.c[2]}, 3};
}

// True if the two roots of a quadratic may be equal, so that halving would not separate them.
inline bool may_touch(const Filtered& p) {
    const double A = p.a - p.b, B = p.c, C = p.a + p.b;
    return std::abs(B * B - A * C) <= 4 * p.err * (std::abs(A) + std::abs(B) + std::abs(C));
}

// A quadratic p, or the quartic p q - r s, in doubles.
struct Predicates::Form : Terms<Filtered> {
    struct Value {
        double v, err;
    };
    Value at(double t) const {
        const double x = p.polar(t, t);
        if (degree == 2) return {x, p.err};
        const double y = q.polar(t, t), z = r.polar(t, t), w = s.polar(t, t);
        if constexpr (double_only) return {x * y - z * w, 0};
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
        if constexpr (double_only) return 0;
        const auto largest = [](double x, double y, double z) { return std::max({std::abs(x), std::abs(y), std::abs(z)}); };
        const double P = largest(p0, p1, p2), Q = largest(q0, q1, q2), R = largest(r0, r1, r2), S = largest(s0, s1, s2);
        return P * q.err + Q * p.err + R * s.err + S * r.err + p.err * q.err + r.err * s.err +
               2 * product_error * (P * Q + R * S) + tiny;
    }
    // Their signs, 0 if not certain
    void signs(double lo, double hi, int* sign) const {
        double c[5];
        const double err = bernstein(lo, hi, c);
        for (int i = 0; i <= degree; ++i) sign[i] = c[i] > err ? 1 : c[i] < -err ? -1 : 0;
    }
    // Its sign on the whole closed interval, 0 if not certain
    int sign_on(double lo, double hi) const {
        int each[5], sum = 0;
        signs(lo, hi, each);
        for (int i = 0; i <= degree; ++i) sum += each[i];
        return std::abs(sum) < degree + 1 ? 0 : sum > 0 ? 1 : -1;
    }
    // Place between two close roots: left to halving.
    std::optional<double> extremum(double, double) const { return {}; }
    bool may_touch() const { return degree == 2 && cfree::may_touch(p); }
    int sign(double t) const {
        const Value value = at(t);
        return value.v > value.err ? 1 : value.v < -value.err ? -1 : 0;
    }
};

}  // namespace cfree
