// Isolation of the roots of a polynomial of degree 2, 4 or 6 by certain signs of its Bernstein coefficients.
//
// A `Form` has degree, signs(lo, hi, out), sign(t), may_touch() and extremum(lo, hi); a function refine(form, lo, hi) shrinks an
// interval with one root.
#pragma once
#include "predicates/form.hpp"

namespace cfree {

// None of these constants decides anything: signs at the ends of an interval decide, and open cases go to the next rung.
inline constexpr double margin = 0x1p-40;           // search for roots so far beyond the ends, in case one is there
inline constexpr double narrow = 0x1p-20;           // roots closer than this are left to balls
inline constexpr double narrow_in_balls = 0x1p-46;  // and closer than this to exact integers
inline constexpr double closest = 0x1p-51;  // false position stops here: two units in the last place of 1
inline constexpr double nearby = 0x1p-30;   // the slope at a root is taken over this distance

enum class Found { none, one, unclear, hopeless };

// Number of roots inside, by the variations of certain signs; uncertain signs are allowed only if they cannot add any.
inline Found roots_inside(const int* sign, int degree) {
    int changes = 0, last = 0, gap = 0;
    bool is_certain = true;
    for (int i = 0; i <= degree; ++i) {
        if (sign[i] == 0) {
            if (i == 0 || i == degree) is_certain = false;
            ++gap;
            continue;
        }
        if (last != 0) {
            if (sign[i] != last) ++changes;
            if (gap > (sign[i] != last ? 1 : 0)) is_certain = false;  // two unknown signs between different ones may hide two changes
        }
        last = sign[i], gap = 0;
    }
    if (last == 0) return Found::hopeless;
    if (!is_certain) return Found::unclear;
    return changes == 0 ? Found::none : changes == 1 ? Found::one : Found::unclear;
}

// Shrink an interval with certain, opposite signs at its ends and one root inside around t: widen until the signs are
// certain again.
template <class Form>
std::array<double, 2> around(const Form& form, double t, double delta, double lo, double hi) {
    const int below = form.sign(lo), above = form.sign(hi);
    if (!(delta < hi - lo)) delta = hi - lo;
    for (int k = 0; k < 64; ++k, delta *= 2) {
        const double x = std::max(lo, t - delta), y = std::min(hi, t + delta);
        if ((x == lo || form.sign(x) == below) && (y == hi || form.sign(y) == above)) return {x, y};
    }
    return {lo, hi};
}

// Illinois method: false position that halves the value of an end that stays twice.
template <class Form>
double false_position(const Form& form, double a, double b, double fa, double fb) {
    double t = a;
    int stayed = 0;
    for (int k = 0; k < 60 && b - a > closest; ++k) {
        t = (a * fb - b * fa) / (fb - fa);
        if (!(t > a && t < b)) t = 0.5 * (a + b);
        const auto value = form.at(t);
        if (std::abs(value.v) <= value.err) break;
        if ((value.v > 0) == (fb > 0)) {
            b = t, fb = value.v;
            if (stayed == 1) fa *= 0.5;
            stayed = 1;
        } else {
            a = t, fa = value.v;
            if (stayed == 2) fb *= 0.5;
            stayed = 2;
        }
    }
    return t;
}

template <class Form>
std::array<double, 2> refine(const Form& form, double lo, double hi) {
    double t = lo, width;
    if (form.degree == 2) {  // (a - b) tau^2 + 2 c tau + (a + b)
        const double A = form.p.a - form.p.b, B = form.p.c, C = form.p.a + form.p.b;
        const double s = std::sqrt(std::max(0.0, B * B - A * C)), q = B > 0 ? -(B + s) : s - B;
        t = q / A;
        if (!(t >= lo && t <= hi)) t = C / q;
        if (!(t >= lo && t <= hi)) t = 0.5 * (lo + hi);
        width = form.p.err / s;
    } else {
        t = false_position(form, lo, hi, form.at(lo).v, form.at(hi).v);
        const double l = std::max(lo, t - nearby), r = std::min(hi, t + nearby);
        width = 2 * form.at(t).err * (r - l) / std::abs(form.at(r).v - form.at(l).v);
    }
    return around(form, t, width + 2 * u, lo, hi);
}

// The same polynomial in balls.
struct Balls {
    Coefficients<Ball> p;
    int degree;

    explicit Balls(const Coefficients<Ball>& c) : p(c), degree(c.count - 1) {}
    explicit Balls(const Poly& exact) : p(scaled(exact)), degree(exact.size() <= 3 ? 2 : exact.size() <= 5 ? 4 : 6) {
        p.count = degree + 1;
    }
    bool may_touch() const { return false; }
    int sign(double t) const { return sign_at(p, t).value_or(0); }
    // Place that separates two close roots, if possible: an extremum, by Newton's method.
    std::optional<double> extremum(double lo, double hi) const {
        double t = 0.5 * (lo + hi);
        for (int k = 0; k < 8; ++k) {
            double slope = 0, bend = 0;
            for (int i = degree; i > 0; --i) bend = bend * t + slope, slope = slope * t + i * p.c[i].hi;
            const double next = t - slope / bend;
            if (!(next > lo && next < hi)) return {};
            if (std::abs(next - t) <= 4 * u) return next;
            t = next;
        }
        return {};
    }
    // Bernstein coefficients, times 2, 12 or 60: sums of coefficients a_k of powers of (t - lo) / (hi - lo), by their
    // binomial coefficients C(i, k) / C(degree, k).
    void signs(double lo, double hi, int* sign) const {
        constexpr double weight[3][7] = {{2, 1, 2}, {12, 3, 2, 3, 12}, {60, 10, 4, 3, 4, 10, 60}};  // over C(degree, k)
        const Ball width = Ball(hi) - Ball(lo);
        Coefficients<Ball> a = p;
        Ball scale = 1.0;
        for (int k = 0; k <= degree; ++k) {
            for (int i = degree; i-- > k;) a.c[i] = a.c[i + 1] * Ball(lo) + a.c[i];
            a.c[k] = Ball(weight[degree / 2 - 1][k]) * (a.c[k] * scale), scale = scale * width;
        }
        for (int i = 0; i <= degree; ++i) {
            Ball sum = a.c[0];
            double choose = 1;
            for (int k = 1; k <= i; ++k) choose = choose * (i - k + 1) / k, sum = sum + Ball(choose) * a.c[k];
            sign[i] = certain_sign(sum).value_or(0);
        }
    }
};

inline std::array<double, 2> refine(const Balls& form, double lo, double hi) {
    double t = 0.5 * (lo + hi);
    for (int k = 0; k < 8; ++k) {  // Newton's method; if it fails, halving
        double value = form.p.c[form.degree].hi, slope = 0;
        for (int i = form.degree; i-- > 0;) slope = slope * t + value, value = value * t + form.p.c[i].hi;
        const double next = t - value / slope;
        if (!(next > lo && next < hi) || next == t) break;
        t = next;
    }
    const auto close = around(form, t, 2 * u, lo, hi);
    if (close[1] - close[0] < narrow_in_balls) return close;
    const int below = form.sign(lo);
    for (;;) {
        const double mid = 0.5 * (lo + hi);
        if (!(lo < mid && mid < hi)) return {lo, hi};
        const int s = form.sign(mid);
        if (s == 0) return around(form, mid, (hi - lo) * 0x1p-40, lo, hi);
        (s == below ? lo : hi) = mid;
    }
}

inline constexpr int enough = 8;
using Brackets = Few<std::array<double, 2>, enough>;

// Find brackets of the roots in [lo, hi], in order; false if certain signs do not suffice.
template <class Form>
bool isolate_by_signs(const Form& form, double lo, double hi, double least, Brackets& found) {
    struct Span {
        double lo, hi;
    };
    Span stack[64];
    int top = 0;
    stack[top++] = {lo, hi};
    int budget = 60;
    found = {};
    while (top > 0) {
        const Span s = stack[--top];
        int sign[7];
        form.signs(s.lo, s.hi, sign);
        const Found inside = roots_inside(sign, form.degree);
        if (inside == Found::none) continue;
        if (inside == Found::hopeless) return false;
        if (inside == Found::one) {
            found.push_back(refine(form, s.lo, s.hi));
            if (found.size() == enough) return false;
            continue;
        }
        if (--budget == 0 || s.hi - s.lo < least || top > 60 || form.may_touch()) return false;
        const auto extremum = form.extremum(s.lo, s.hi);
        double mid = extremum.value_or(0.5 * (s.lo + s.hi));
        if (form.sign(mid) == 0) {
            if (extremum) return false;
            mid = s.lo + 0.4375 * (s.hi - s.lo);
        }
        stack[top++] = {mid, s.hi};
        stack[top++] = {s.lo, mid};
    }
    return true;
}

// True if brackets tell their roots to ten digits and more. Places are computed from the middle of one: near ties, where one rung
// leaves wide ones, the next isolates.
inline bool are_narrow(const Brackets& found) {
    return std::all_of(found.begin(), found.end(), [](const auto& root) { return root[1] - root[0] < 0x1p-36; });
}

// Find brackets a little beyond the two ends, as a root may be one of them.
template <class Form>
bool isolate_around(const Form& form, double lo, double hi, Brackets& found) {
    return isolate_by_signs(form, lo - margin, hi + margin, narrow, found);
}
inline bool isolate_around(const Balls& form, double lo, double hi, Brackets& found) {
    return isolate_by_signs(form, lo - margin, hi + margin, narrow_in_balls, found);
}

// Roots in the interval and a little beyond it.
struct Predicates::Candidates {
    Few<Event, enough> at;
    bool all_zero = false;
};

}  // namespace cfree
