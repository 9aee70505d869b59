// Places of curves on lines and circles, in any ring of numbers or polynomials; theory, "Rounded shapes".
#pragma once
#include <algorithm>
#include <cmath>

#include "cfree/exact/surd_polynomial.hpp"
#include "predicates/round_form.hpp"
#include "predicates/round_surfaces.hpp"

namespace cfree {

// Interval of doubles, rounded outwards.
struct Bounds {
    double lo, hi;
};
inline Bounds outwards(double lo, double hi) {
    return {lo - (4 * u * std::abs(lo) + tiny), hi + (4 * u * std::abs(hi) + tiny)};
}
inline Bounds operator+(const Bounds& x, const Bounds& y) { return outwards(x.lo + y.lo, x.hi + y.hi); }
inline Bounds operator-(const Bounds& x, const Bounds& y) { return outwards(x.lo - y.hi, x.hi - y.lo); }
inline Bounds operator*(const Bounds& x, const Bounds& y) {
    const double a = x.lo * y.lo, b = x.lo * y.hi, c = x.hi * y.lo, d = x.hi * y.hi;
    return outwards(std::min(std::min(a, b), std::min(c, d)), std::max(std::max(a, b), std::max(c, d)));
}
inline Bounds sqrt(const Bounds& x) { return outwards(std::sqrt(std::max(0.0, x.lo)), std::sqrt(std::max(0.0, x.hi))); }
inline Bounds bounds(const Ball& x) {
    const double err = std::abs(x.lo) + x.radius;
    return outwards(x.hi - err, x.hi + err);
}

// Ring of intervals that hold the values at all angles between two.
struct Between {
    double lo, hi, kappa;
    Bounds number(const Approx& k) const { return outwards(k.v - round_error * k.m, k.v + round_error * k.m); }
    Bounds operator()(const Trig<Approx>& x) const { return (*this)(filtered_round(x, kappa)); }
    Bounds operator()(const Filtered& f) const {
        const double p = f.polar(lo, lo), q = f.polar(lo, hi), r = f.polar(hi, hi);
        return {std::min(std::min(p, q), r) - f.err, std::max(std::max(p, q), r) + f.err};
    }
    Bounds number(const Ball& k) const { return bounds(k); }
    Bounds operator()(const Trig<Ball>& f) const {
        // Bernstein coefficients, by the polar form
        const Bounds a = bounds(f.a), b = bounds(f.b * Ball(kappa)), c = bounds(f.c * Ball(kappa));
        const auto polar = [&](double p, double q) {
            const Bounds one{1, 1}, x{p, p}, y{q, q}, product = x * y;
            return a * (one + product) + b * (one - product) + c * (x + y);
        };
        const Bounds x = polar(lo, lo), y = polar(lo, hi), z = polar(hi, hi);
        return {std::min({x.lo, y.lo, z.lo}), std::max({x.hi, y.hi, z.hi})};
    }
};

// Ring of balls at an angle.
struct InBalls {
    Ball w, c, s;
    InBalls(const Ball& tau, double kappa) {
        const Ball square = tau * tau;
        w = Ball(1.0) + square, c = Ball(kappa) * (Ball(1.0) - square), s = Ball(2 * kappa) * tau;
    }
    Ball number(const Ball& k) const { return k; }
    Ball operator()(const Trig<Ball>& f) const { return f.a * w + f.b * c + f.c * s; }
};

// Ring of polynomials in tau.
struct AsSurdPoly {
    double kappa;
    SurdPoly number(const RootSum& k) const { return surd_polynomial({&k, 1}); }
    SurdPoly operator()(const Trig<RootSum>& f) const { return surd_polynomial(quadratic(f, kappa)); }
};

// Ring of exact numbers at an angle, times powers of (1 + tau^2) 2^2k.
struct Exactly {
    RootSum w, c, s;
    Exactly(const Dyadic& tau, double kappa) {
        const Int square = tau.n * tau.n, unit = Int(1) << (2 * tau.k), turn = kappa > 0 ? 1 : -1;
        w = RootSum(Int(unit + square)), c = RootSum(Int(turn * (unit - square))), s = RootSum(Int(turn * ((2 * tau.n) << tau.k)));
    }
    RootSum number(const RootSum& k) const { return k; }
    RootSum operator()(const Trig<RootSum>& f) const { return f.a * w + f.b * c + f.c * s; }
};

// (a + b sqrt(d)) / c
template <class V>
struct CurvePlace {
    V a, b, d, c;
    bool has_root;
};

// t = N / D at which one line meets another.
template <class K>
std::array<Trig<K>, 2> place_of_line(const RoundSurfaces<K>& of, const Feature& x, const Feature& f) {
    const auto U = of.along(x), V = of.along(f);
    const K square = of.square_of_length(x);
    return {of.rho(x) * of.length(x) * dot(V, U) - square * of.offset(f, x), square * cross(V, U)};
}

// The same where the two lines are one, as a limit: N and D are zero there.
template <class K, class Ring>
auto limit_of_line(const Scene& scene, const Feature& x, const Feature& f, const Ring& in) {
    using V = decltype(in.number(whole<K>(0)));
    const V zero = in.number(whole<K>(0));
    const auto slope = [&](const Trig<K>& g) { return in(Trig<K>{whole<K>(0), g.c, -g.b}); };
    const auto [N, D] = place_of_line(RoundSurfaces<K>(scene), x, f);
    return CurvePlace<V>{slope(N), zero, zero, slope(D), false};
}

// Functions of the angle of which the place of a curve is made: N / D; on a line (B + b sqrt(S - M^2)) / C; on a circle
// (delta n + b m sqrt(R s - delta^2)) / (r s), n and m of the normal along an axis and a quarter turn on, s its square, R = r^2.
enum class PlaceForm { quotient, circle_on_line, on_circle };
template <class Q>
struct PlaceParts {
    PlaceForm form;
    std::array<Q, 6> f;  // N, D; B, M, S, C; delta, n, m, s, R, r
};
template <class K>
PlaceParts<Trig<K>> parts_of_place(const Scene& scene, const Feature& x, const Feature& f, int axis) {
    const RoundSurfaces<K> of(scene);
    const auto constant = [](const K& k) { return RoundSurfaces<K>::constant(k); };
    const auto one = [&] { return constant(whole<K>(1)); };
    if (is_line(x)) {
        if (const int end = smooth_end(scene, x, f); end >= 0) return {PlaceForm::quotient, {constant(whole<K>(end)), one()}};
        if (is_line(f)) {
            const auto [N, D] = place_of_line(of, x, f);
            return {PlaceForm::quotient, {N, D}};
        }
        const K sigma = of.rho(f), square = of.square_of_length(x);
        return {PlaceForm::circle_on_line, {dot(of.between(f, x), of.along(x)), of.offset(x, f), constant(sigma * sigma * square), constant(square)}};
    }
    const Quadrant ends = quadrant_of(scene, x);
    const MovingVector<K> e = axis == 0 ? of.axis(ends.end) : of.axis(ends.begin + 2);
    if (f.kind == Kind::seam) return {PlaceForm::quotient, {dot(of.axis(f.branch), e), one()}};
    if (is_smooth(scene, f, x)) return {PlaceForm::quotient, {-dot(quarter_turn(of.along(f)), e), constant(of.length(f))}};
    const auto seen = of.seen(x, f);
    const K r = of.rho(x);
    return {PlaceForm::on_circle, {seen.delta, dot(seen.n, e), dot(quarter_turn(seen.n), e), seen.square, constant(r * r), constant(r)}};
}

template <class K, class Q, class Ring>
auto place_of_parts(const PlaceParts<Q>& parts, int branch, const Ring& in) {
    using V = decltype(in(parts.f[0]));
    const auto& f = parts.f;
    const auto number = [&](int k) { return in.number(whole<K>(k)); };
    if (parts.form == PlaceForm::quotient) {
        const V zero = number(0);
        return CurvePlace<V>{in(f[0]), zero, zero, in(f[1]), false};
    }
    if (parts.form == PlaceForm::circle_on_line) {
        const V M = in(f[1]);
        return CurvePlace<V>{in(f[0]), number(branch), in(f[2]) * in(RoundSurfaces<K>::constant(whole<K>(1))) - M * M, in(f[3]), true};
    }
    const V delta = in(f[0]), square = in(f[3]);
    return CurvePlace<V>{delta * in(f[1]), number(branch) * in(f[2]), in(f[4]) * square - delta * delta, in(f[5]) * square, true};
}

// Place of a curve f on a surface x: t on a line; on a circle a coordinate of u that grows with t over the quadrant, along the axis
// at its end (axis 0), or against that at its beginning (1).
template <class K, class Ring>
auto place_of_curve(const Scene& scene, const Feature& x, const Feature& f, int axis, const Ring& in) {
    return place_of_parts<K>(parts_of_place<K>(scene, x, f, axis), f.branch, in);
}

// Point ((x.a + x.b sqrt(d)) / c, (y.a + y.b sqrt(d)) / c) of the plane.
template <class V>
struct PlanePoint {
    struct Coordinate {
        V a, b;
    } x, y;
    V d, c;
    bool has_root;
};

template <class K>
MovingVector<K> position(const Scene& scene, const Site& at) {
    const auto vertex = [](const Shape& s, Index v) -> Vec<K> {
        if constexpr (std::is_same_v<K, Approx>) return {{s.x[v], std::abs(s.x[v])}, {s.y[v], std::abs(s.y[v])}};
        else if constexpr (std::is_same_v<K, Ball>) return {Ball(s.x[v], s.x_low[v], ball_error(s.x[v])), Ball(s.y[v], s.y_low[v], ball_error(s.y[v]))};
        else return {K(s.X[v]), K(s.Y[v])};
    };
    return {vertex(scene.obstacles, at.obstacle), vertex(scene.robot, at.robot)};
}

// Point of a surface at a place: t on a line; both coordinates of u on a circle, which have one root and one denominator.
template <class K, class V, class Ring>
PlanePoint<V> plane_point(const Scene& scene, const Feature& x, const CurvePlace<V>& t, const CurvePlace<V>& from_start, const Ring& in) {
    const RoundSurfaces<K> of(scene);
    const auto constant = [&](const K& k) { return in(RoundSurfaces<K>::constant(k)); };
    const MovingVector<K> start = position<K>(scene, of.site(x));
    if (is_line(x)) {
        const MovingVector<K> U = of.along(x), left = quarter_turn(U);
        const V length = constant(of.length(x)), rho = constant(of.rho(x));
        const auto coordinate = [&](int axis) -> typename PlanePoint<V>::Coordinate {
            const auto e = of.axis(axis);
            const V step = length * in(dot(U, e));
            return {(length * in(dot(start, e)) - rho * in(dot(left, e))) * t.c + step * t.a, step * t.b};
        };
        return {coordinate(0), coordinate(1), t.d, length * constant(whole<K>(1)) * t.c, t.has_root};
    }
    const V rho = constant(of.rho(x));
    const Quadrant ends = quadrant_of(scene, x);
    const auto coordinate = [&](int axis) -> typename PlanePoint<V>::Coordinate {
        const int turns = (ends.end > ends.begin ? axis - ends.end : ends.end - axis) & 3;  // from the axis at the quadrant's end
        const CurvePlace<V>& place = turns % 2 == 0 ? t : from_start;
        const V a = rho * place.a, b = rho * place.b, centre = in(dot(start, of.axis(axis))) * t.c;
        if (turns < 2) return {centre + a, b};
        return {centre - a, in.number(whole<K>(0)) - b};
    };
    return {coordinate(0), coordinate(1), t.d, constant(whole<K>(1)) * t.c, t.has_root};
}

// Order of two places, if it is certain.
inline std::optional<int> certain_order(const CurvePlace<Ball>& x, const CurvePlace<Ball>& y) {
    const auto first = certain_sign(x.c), second = certain_sign(y.c);
    if (!first || !second) return {};
    const Ball b = x.b * y.c, c = y.b * x.c;
    Ball difference = x.a * y.c - y.a * x.c;
    if (certain_sign(b) != 0) difference = difference + b * sqrt(x.d);
    if (certain_sign(c) != 0) difference = difference - c * sqrt(y.d);
    const auto sign = certain_sign(difference);
    return sign ? std::optional(*sign * *first * *second) : std::nullopt;
}

// Ball around an angle.
inline Ball ball_around(const Predicates::Bracket& bracket) {
    const auto& [below, above] = bracket;
    Ball middle = (below + above) * Ball(0.5);
    middle.radius = (std::abs(((above - below) * Ball(0.5)).hi) + middle.radius) * (1 + 0x1p-40) + least_radius;
    return middle;
}

// Range of a place, if its denominator is certain.
template <class Place>
std::optional<Bounds> range_of(Place x) {
    if (x.has_root) x.a = x.a + x.b * sqrt(x.d);
    if (x.c.hi < 0) x.a = Bounds{0, 0} - x.a, x.c = Bounds{0, 0} - x.c;
    if (!(x.c.lo > 0)) return {};
    return outwards(std::min(x.a.lo / x.c.lo, x.a.lo / x.c.hi), std::max(x.a.hi / x.c.lo, x.a.hi / x.c.hi));
}

}  // namespace cfree
