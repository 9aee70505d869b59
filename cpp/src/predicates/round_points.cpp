// Points of curves of grown shapes, in intervals, balls and exactly; theory, "Rounded shapes".
#include "predicates/round_points.hpp"

#include "cfree/exact/radicals.hpp"

namespace cfree {

template <class K, class Ring>
static auto point(const Scene& scene, const CurveOf& c, const Ring& in) {
    const auto t = place_of_curve<K>(scene, c.on, c.curve, 0, in);
    return plane_point<K>(scene, c.on, t, is_line(c.on) ? t : place_of_curve<K>(scene, c.on, c.curve, 1, in), in);
}

Reach RoundPoints::reach(const CurveOf& c, double lo, double hi) const {
    const RoundSurfaces<Approx> of(scene);
    const auto t = c.curve.kind == Kind::none ? std::nullopt : range_of(place_of_curve<Approx>(scene, c.on, c.curve, 0, Between{lo, hi, kappa}));
    const Bounds along = t ? Bounds{std::max(t->lo, 0.0), std::min(t->hi, 1.0)} : Bounds{0, 1};
    // a + b cos + c sin is between its values at both ends, or beyond them by at most the sagitta
    const double cosine = (1 + lo * hi) / std::sqrt((1 + lo * lo) * (1 + hi * hi)), sagitta = std::max(0.0, 1 - cosine) + 4 * u;
    const auto range = [&](const Trig<Approx>& f) {
        const auto at = [&](double tau) {
            const Between in{tau, tau, kappa};
            const Bounds value = in(f), w = in(RoundSurfaces<Approx>::constant(whole<Approx>(1)));
            return outwards(std::min(value.lo / w.lo, value.lo / w.hi), std::max(value.hi / w.lo, value.hi / w.hi));
        };
        const Bounds first = at(lo), last = at(hi);
        const double slack = sagitta * (f.b.m + f.c.m) * (1 + 4 * u);
        return outwards(std::min(first.lo, last.lo) - slack, std::max(first.hi, last.hi) + slack);
    };
    const MovingVector<Approx> start = position<Approx>(scene, of.site(c.on));
    const Bounds rho = Between{lo, hi, kappa}.number(of.size(c.on)), round{-rho.hi, rho.hi};
    const auto coordinate = [&](int axis) {
        Bounds x = range(dot(start, of.axis(axis))) + round;
        if (is_line(c.on)) x = x + along * range(dot(of.along(c.on), of.axis(axis)));
        return x;
    };
    const Bounds x = coordinate(0), y = coordinate(1);
    return {x.lo, x.hi, y.lo, y.hi};
}

// Quotient, about twice as precise as doubles.
static Ball quotient(const Ball& x, const Ball& y) {
    const double first = x.hi / y.hi;
    const Ball rest = x - y * Ball(first);
    const auto [hi, lo] = two_sum(first, rest.hi / y.hi);
    return {hi, lo, 0};
}

Vec<Ball> RoundPoints::near(const CurveOf& c, const Dyadic& tau) const {
    const auto p = point<Ball>(scene, c, InBalls(ball(tau.n, static_cast<int>(tau.k)), kappa));
    const auto value = [&](const auto& x) { return quotient(p.has_root ? x.a + x.b * sqrt(p.d) : x.a, p.c); };
    return {value(p.x), value(p.y)};
}

Ball RoundPoints::crossing(const Feature& f, const Vec<Ball>& low, const Vec<Ball>& high, const Ball& y, const Dyadic& tau) const {
    if (is_line(f)) return low.x + quotient(y - low.y, high.y - low.y) * (high.x - low.x);
    const InBalls in(ball(tau.n, static_cast<int>(tau.k)), kappa);
    const RoundSurfaces<Ball> of(scene);
    const MovingVector<Ball> centre = position<Ball>(scene, of.site(f));
    const auto coordinate = [&](int axis) { return quotient(in(dot(centre, of.axis(axis))), in.w); };
    const Ball rho = of.rho(f), rise = y - coordinate(1), run = sqrt((rho - rise) * (rho + rise));
    return (f.branch == 0 || f.branch == 3) != is_concave(scene, f) ? coordinate(0) + run : coordinate(0) - run;
}

bool RoundPoints::may_be_one(const CurveOf& c, const CurveOf& d, const Dyadic& tau) const {
    const Between at{tau.rounded_down(), tau.rounded_up(), kappa};
    const auto near = [&](const CurveOf& curve) { return point<Approx>(scene, curve, at); };
    const auto p_near = near(c), q_near = near(d);
    const auto are_apart = [&](const auto& x, const auto& y) {
        const auto first = range_of(CurvePlace<Bounds>{x.a, x.b, p_near.d, p_near.c, p_near.has_root});
        const auto second = range_of(CurvePlace<Bounds>{y.a, y.b, q_near.d, q_near.c, q_near.has_root});
        return first && second && (first->hi < second->lo || second->hi < first->lo);
    };
    if (are_apart(p_near.x, q_near.x) || are_apart(p_near.y, q_near.y)) return false;
    const InBalls in(ball(tau.n, static_cast<int>(tau.k)), kappa);
    const auto p = point<Ball>(scene, c, in), q = point<Ball>(scene, d, in);
    const auto differ = [&](const auto& x, const auto& y) {
        const Ball first = p.has_root ? x.a + x.b * sqrt(p.d) : x.a, second = q.has_root ? y.a + y.b * sqrt(q.d) : y.a;
        const auto sign = certain_sign(first * q.c - second * p.c);
        return sign && *sign != 0;
    };
    return !differ(p.x, q.x) && !differ(p.y, q.y);
}

bool RoundPoints::are_one(const CurveOf& c, const CurveOf& d, const Dyadic& tau) const {
    const AsSurdPoly in{kappa};
    const auto p = point<RootSum>(scene, c, in), q = point<RootSum>(scene, d, in);
    const auto differ = [&](const auto& x, const auto& y) {
        return sign_at(Radicals{x.a * q.c - y.a * p.c, x.b * q.c, p.d, -(y.b * p.c), q.d, {}}, tau) != 0;
    };
    return !differ(p.x, q.x) && !differ(p.y, q.y);
}

std::array<int, 2> RoundPoints::turn(const CurveOf& at, const Feature& x, const Feature& y, const Dyadic& tau) const {
    const std::array<int, 2> signs = counter_clockwise_turn(at, x, y, tau);
    if (is_concave(scene, x) == is_concave(scene, y)) return signs;
    return {-signs[0], -signs[1]};
}

// Directions are U on a line, and J (P - C) at the point P of a circle: products of two are linear in P.
std::array<int, 2> RoundPoints::counter_clockwise_turn(const CurveOf& at, const Feature& x, const Feature& y, const Dyadic& tau) const {
    const AsSurdPoly in{kappa};
    const RoundSurfaces<RootSum> of(scene);
    const auto sign_of = [&](const Trig<RootSum>& f) { return sign_at(in(f), tau); };
    if (is_line(x) && is_line(y)) return {sign_of(cross(of.along(x), of.along(y))), sign_of(dot(of.along(x), of.along(y)))};
    if (is_line(x)) {
        const auto [cross_of, dot_of] = counter_clockwise_turn(at, y, x, tau);
        return {-cross_of, dot_of};
    }
    const auto p = point<RootSum>(scene, at, in);
    // sign of v . (P - C) and of v x (P - C), C the centre of x
    const MovingVector<RootSum> centre = position<RootSum>(scene, of.site(x));
    const auto product = [&](const MovingVector<RootSum>& v, bool is_cross) {
        const SurdPoly vx = in(dot(v, of.axis(0))), vy = in(dot(v, of.axis(1)));
        const SurdPoly& first = is_cross ? -vy : vx;
        const SurdPoly& second = is_cross ? vx : vy;
        const SurdPoly constant = in(is_cross ? cross(v, centre) : dot(v, centre));
        const Radicals value{first * p.x.a + second * p.y.a - constant * p.c, first * p.x.b + second * p.y.b, p.d, {}, {}, {}};
        return sign_at(value, tau) * sign_at(p.c, tau);
    };
    if (is_line(y)) {  // J A x U = -U . A and J A . U = -U x A
        const auto U = of.along(y);
        return {-product(U, false), -product(U, true)};
    }
    const MovingVector<RootSum> between = of.between(x, y);  // from the centre of y
    const RootSum r = of.rho(x), s = of.rho(y);
    const Trig<RootSum> dots = RoundSurfaces<RootSum>::constant(r * r + s * s) - dot(between, between);
    return {-product(between, true), sign_of(dots)};
}

}  // namespace cfree
