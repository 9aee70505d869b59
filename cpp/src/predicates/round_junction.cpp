// Lines and circles at one critical angle: which are one, and the order along and around them; theory, "Rounded shapes".
#include "predicates/round_junction.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "cfree/exact/radicals.hpp"

namespace cfree {

RoundJunction::RoundJunction(const Scene& s, int in, double from, double to, std::function<LongRoot()> number)
    : scene(s), chart(in), lo(from), hi(to), kappa(in ? -1 : 1), exact(std::move(number)) {}

void RoundJunction::know_parallel(Index g, Index f) { known.insert({0, 0, code(scene, {Kind::edge_edge, g, f})}); }

void RoundJunction::know_meeting(const Feature& on, const Feature& first, const Feature& second) {
    MeetingNames::Name name{code(scene, on), code(scene, first), code(scene, second)};
    std::sort(name.begin(), name.end());
    known.insert(name);
}

// True if features that meet here prove two places equal: two curves; joints of a circle with parallel lines, in one quadrant.
bool RoundJunction::is_known(const Feature& surface, const Spot& p, const Spot& q) const {
    MeetingNames::Name name{code(scene, surface), p.code, q.code};
    std::sort(name.begin(), name.end());
    if (known.contains(name)) return true;
    if (!is_circle(surface) || !is_smooth(scene, p.curve, surface) || !is_smooth(scene, q.curve, surface)) return false;
    if (p.curve.kind == q.curve.kind) return false;
    const Feature &ve = p.curve.kind == Kind::vertex_edge ? p.curve : q.curve, &ev = p.curve.kind == Kind::vertex_edge ? q.curve : p.curve;
    return known.contains({0, 0, code(scene, {Kind::edge_edge, ev.robot, ve.obstacle})});
}

LongRoot& RoundJunction::here() {
    if (!root) root = exact();
    return *root;
}

template <class F>
int RoundJunction::sign(const F& form) {
    const Bounds near = Between{lo, hi, kappa}(form.template operator()<Approx>(RoundSurfaces<Approx>(scene)));
    if (near.lo > 0) return 1;
    if (near.hi < 0) return -1;
    return sign_at(AsSurdPoly{kappa}(form.template operator()<RootSum>(RoundSurfaces<RootSum>(scene))), here());
}

int RoundJunction::turn(const Feature& x, const Feature& y) {
    if (x.kind != y.kind) {
        const Feature &ve = x.kind == Kind::vertex_edge ? x : y, &ev = x.kind == Kind::vertex_edge ? y : x;
        const Code name = code(scene, {Kind::edge_edge, ev.robot, ve.obstacle});
        if (known.contains({0, 0, name})) return 0;
        const int found = sign([&]<class K>(const RoundSurfaces<K>& of) { return cross(of.along(x), of.along(y)); });
        if (found == 0) known.insert({0, 0, name});
        return found;
    }
    return sign([&]<class K>(const RoundSurfaces<K>& of) { return cross(of.along(x), of.along(y)); });
}

int RoundJunction::parallel(const Feature& x, const Feature& y) {
    if (turn(x, y) != 0) return 0;
    return sign([&]<class K>(const RoundSurfaces<K>& of) { return dot(of.along(x), of.along(y)); });
}

// Left of x's line, |U| times the distance of y's: the outward normals are equal, or opposite.
template <class K>
static Trig<K> offset_of_parallel(const RoundSurfaces<K>& of, const Feature& x, const Feature& y, int along) {
    return of.offset(x, y) - whole<K>(along) * of.rho(y) * of.length(x);
}

int RoundJunction::side(const Feature& x, const Feature& y) {
    if (code(scene, x) == code(scene, y)) return 0;
    const int along = parallel(x, y);
    return sign([&]<class K>(const RoundSurfaces<K>& of) { return offset_of_parallel(of, x, y, along); });
}

Interval RoundJunction::offset(const Feature& x, const Feature& y) const {
    const RoundSurfaces<Approx> of(scene);
    const Bounds dot_of = Between{lo, hi, kappa}(dot(of.along(x), of.along(y)));
    if (!(dot_of.lo > 0 || dot_of.hi < 0)) return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    const Bounds found = Between{lo, hi, kappa}(offset_of_parallel(of, x, y, dot_of.lo > 0 ? 1 : -1));
    return {found.lo, found.hi};
}

bool RoundJunction::are_one_circle(const Feature& x, const Feature& y) {
    if (x.branch != y.branch) return false;
    if (code(scene, x) == code(scene, y)) return true;
    if ((RoundSurfaces<RootSum>(scene).rho(x) - RoundSurfaces<RootSum>(scene).rho(y)).sign() != 0) return false;
    const auto is_zero_along = [&](int axis) {
        return sign([&]<class K>(const RoundSurfaces<K>& of) { return dot(of.between(x, y), of.axis(axis)); }) == 0;
    };
    return is_zero_along(0) && is_zero_along(1);
}

RoundSpot RoundJunction::spot(const Feature& on, const Feature& curve, bool is_after) {
    Spot result{on, curve, code(scene, curve), false, is_after, false, {}};
    if (is_circle(on) && is_circle(curve)) {
        Feature circle = curve;
        circle.branch = on.branch;
        result.jumps = are_one_circle(on, circle);
    }
    if (is_line(on) && is_line(curve)) result.is_limit = turn(on, curve) == 0;
    return result;
}

// True if t is the same on both.
static bool have_one_edge(const Feature& x, const Feature& y) {
    return x.kind == y.kind && x.robot == y.robot && x.obstacle == y.obstacle;
}

// The place on its own surface; t on another line that is the same here.
template <class K, class Ring>
auto RoundJunction::place(const Feature& surface, const Spot& p, int axis, const Ring& in) const {
    const RoundSurfaces<K> of(scene);
    const auto constant = [&](const K& k) { return in(RoundSurfaces<K>::constant(k)); };
    using V = decltype(constant(whole<K>(1)));
    const auto own = [&]() -> CurvePlace<V> {
        if (!p.given) return place_of_curve<K>(scene, p.on, p.curve, axis, in);
        const V zero = in.number(whole<K>(0));
        if constexpr (std::is_same_v<K, Approx>) {
            const double t = ratio(p.given->n, p.given->d);
            return {constant(Approx{t, std::abs(t)}), zero, zero, constant(whole<K>(1)), false};
        } else if constexpr (std::is_same_v<K, Ball>) return {constant(ball(p.given->n, 0)), zero, zero, constant(ball(p.given->d, 0)), false};
        else return {constant(K(p.given->n)), zero, zero, constant(K(p.given->d)), false};
    };
    CurvePlace<V> result = own();
    if (is_circle(p.on) || have_one_edge(p.on, surface)) return result;
    const auto U = of.along(surface);
    const V start = in(dot(of.between(p.on, surface), U)), step = in(dot(of.along(p.on), U));
    result.a = start * result.c + step * result.a, result.b = step * result.b;
    result.c = result.c * constant(of.square_of_length(surface));
    return result;
}

// The same where the curve's two surfaces are one circle, or parallel lines, here.
CurvePlace<SurdPoly> RoundJunction::place_exactly(const Feature& surface, const Spot& p, int axis) const {
    const AsSurdPoly in{kappa};
    if (p.jumps) {
        // the centres part in the direction d', and the circles meet in the two directions +-J d'
        const RoundSurfaces<RootSum> of(scene);
        const Vec<RootSum> d = of.between(p.curve, p.on).p;
        const MovingVector<RootSum> e = axis == 0 ? of.axis(p.on.branch + 1) : of.axis(p.on.branch + 2);
        const RootSum along = dot(d, e.p), square = dot(d, d);
        const RootSum signed_along = (p.is_after ? 1 : -1) * p.curve.branch > 0 ? along : -along;
        const SurdPoly zero = in.number(RootSum(0));
        return {in.number(signed_along), zero, zero, in.number(RootSum::root(square.c[0])), false};
    }
    if (!p.is_limit) return place<RootSum>(surface, p, axis, in);
    auto own = place_of_curve<RootSum>(scene, p.on, p.curve, axis, in);
    own.a = derivative(own.a), own.c = derivative(own.c);
    if (have_one_edge(p.on, surface)) return own;
    const RoundSurfaces<RootSum> of(scene);
    const auto U = of.along(surface);
    own.a = in(dot(of.between(p.on, surface), U)) * own.c + in(dot(of.along(p.on), U)) * own.a;
    own.c = own.c * in(RoundSurfaces<RootSum>::constant(of.square_of_length(surface)));
    return own;
}

Interval RoundJunction::range(const Feature& surface, const Spot& p) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (p.jumps || p.is_limit) return {-infinity, infinity};
    const auto found = range_of(place<Approx>(surface, p, 0, Between{lo, hi, kappa}));
    return found ? Interval{found->lo, found->hi} : Interval{-infinity, infinity};
}

double RoundJunction::value(const Feature& surface, const Spot& p) {
    const Ball tau = narrow_ball(here());
    const auto coordinate = [&](int axis) {
        if (p.jumps || p.is_limit) {
            const auto x = place_exactly(surface, p, axis);
            const int most = std::max(size(x.a), size(x.c));
            return value_at(x.a, tau, most).hi / value_at(x.c, tau, most).hi;
        }
        const auto x = place<Ball>(surface, p, axis, InBalls(tau, kappa));
        return (x.has_root ? x.a + x.b * sqrt(x.d) : x.a).hi / x.c.hi;
    };
    if (is_line(p.on)) return coordinate(0);
    const double along_end = coordinate(0), along_start = -coordinate(1);
    return std::clamp(along_end / (1 + along_start), 0.0, 1.0);
}

int RoundJunction::order(const Feature& surface, const Spot& p, const Spot& q) {
    if (p.code == q.code && !p.given && !q.given && !p.jumps && code(scene, p.on) == code(scene, q.on)) return 0;
    if (!p.jumps && !p.is_limit && !q.jumps && !q.is_limit)
        for (int axis = 0; axis < (is_circle(surface) && !p.given && !q.given ? 2 : 1); ++axis) {
            const auto first = range_of(place<Approx>(surface, p, axis, Between{lo, hi, kappa}));
            const auto second = range_of(place<Approx>(surface, q, axis, Between{lo, hi, kappa}));
            if (first && second && first->hi < second->lo) return -1;
            if (first && second && second->hi < first->lo) return 1;
        }
    if (!p.jumps && !q.jumps && !p.given && !q.given && is_known(surface, p, q)) return 0;
    const auto x = place_exactly(surface, p, 0), y = place_exactly(surface, q, 0);
    const Radicals difference{x.a * y.c - y.a * x.c, x.b * y.c, x.d, -(y.b * x.c), y.d, {}};
    return sign_at(difference, here()) * sign_at(x.c, here()) * sign_at(y.c, here());
}

int RoundJunction::across(const Feature& x, const Feature& y, const Spot& p, const Spot& q, bool after) {
    const bool upwards = order(x, p, q) < 0;
    const Spot &first = upwards ? p : q, &last = upwards ? q : p;
    Spot at{x, {}, 0, false, false, false, Ratio{}};
    Int n, d = 1;
    for (Int low = 0, high = 1;;) {  // over d
        n = low + high, d *= 2, low *= 2, high *= 2;
        at.given = Ratio{n, d};
        const bool above = order(x, first, at) < 0, below = order(x, at, last) < 0;
        if (above && below) break;
        (above ? high : low) = n;
    }
    // left of y's line, times |U| of x and d
    const RoundSurfaces<RootSum> of(scene);
    const RootSum length = of.length(x), shift = of.rho(x) * RootSum(d);
    const Trig<RootSum> offset = RootSum(d) * length * of.offset(y, x) + RootSum(n) * length * cross(of.along(y), of.along(x)) -
                                 shift * dot(of.along(y), of.along(x));
    const SurdPoly form = AsSurdPoly{kappa}(offset);
    if (is_zero(form)) return 0;
    return after ? sign_after(form, here()) : sign_before(form, here());
}

}  // namespace cfree
