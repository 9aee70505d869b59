// Lines and circles at one critical angle: which are one, and the order along and around them; theory, "Rounded shapes".
#include "predicates/round_junction.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "cfree/exact/radicals.hpp"
#include "predicates/round_orders.hpp"

namespace cfree {

RoundJunction::RoundJunction(const Scene& s, int in, double from, double to, std::function<LongRoot()> number,
                             std::function<std::optional<Predicates::Bracket>()> closely)
    : scene(s), chart(in), lo(from), hi(to), kappa(in ? -1 : 1), exact(std::move(number)), narrow(std::move(closely)) {}

void RoundJunction::know_parallel(Index g, Index f) { known.insert({0, 0, code(scene, {Kind::edge_edge, g, f})}); }

// Names in which branches, and quadrants of circles, do not matter.
static Code bare_code(const Scene& scene, Feature f) {
    if (f.kind != Kind::seam) f.branch = 0;
    return code(scene, f);
}
static MeetingNames::Name bare_name(const Scene& scene, const std::array<Feature, 3>& features) {
    MeetingNames::Name name;
    for (std::size_t k = 0; k < 3; ++k) name[k] = bare_code(scene, features[k]);
    std::sort(name.begin(), name.end());
    return name;
}
static std::array<Code, 2> touch_name(const Scene& scene, const Feature& x, const Feature& y) {
    const Code first = bare_code(scene, x), second = bare_code(scene, y);
    return {std::min(first, second), std::max(first, second)};
}

void RoundJunction::know_touch(const Feature& on, const Feature& other) { touching.push_back(touch_name(scene, on, other)); }

// Name of the meeting of two curves on a surface. Three lines meet in one point of each; a circle's branch is that on this surface
// alone, so no two of the three may change places.
static MeetingNames::Name name_on(const Scene& scene, const Feature& on, const Feature& first, const Feature& second) {
    const bool are_lines = is_line(on) && is_line(first) && is_line(second);
    MeetingNames::Name name{are_lines ? code(scene, on) : ~code(scene, on), code(scene, first), code(scene, second)};
    std::sort(name.begin(), name.end());
    return name;
}

void RoundJunction::know_meeting(const Feature& on, const Feature& first, const Feature& second, double from, double to) {
    known.insert(name_on(scene, on, first, second));
    if (!is_center(second)) meetings.push_back({bare_name(scene, {on, first, second}), from, to});
}

// True if t is the same on both.
static bool have_one_edge(const Feature& x, const Feature& y) {
    return x.kind == y.kind && x.robot == y.robot && x.obstacle == y.obstacle;
}

// True if three surfaces are known to meet here, and so do these two curves: between two angles they meet, which they can do only
// where the three do.
bool RoundJunction::do_cross(const Spot& p, const Spot& q) const {
    const Feature& on = p.on;
    if (!have_one_edge(on, q.on) || on.branch != q.on.branch || p.is_limit || q.is_limit) return false;
    const auto name = bare_name(scene, {on, p.curve, q.curve});
    const auto meeting = std::find_if(meetings.begin(), meetings.end(), [&](const Meeting& m) { return m.name == name; });
    return meeting != meetings.end() && RoundOrders(scene, {on, chart}).do_meet(p.curve, q.curve, meeting->lo, meeting->hi);
}

// A v-e and an e-v line.
static std::array<Feature, 2> by_kind(const Feature& x, const Feature& y) {
    return x.kind == Kind::vertex_edge ? std::array{x, y} : std::array{y, x};
}

// Circle with which two lines of different kinds are smooth, if they are one here: then they meet in their joint with it.
std::optional<Feature> RoundJunction::common_circle(const Feature& x, const Feature& y) {
    const auto [ve, ev] = by_kind(x, y);
    const Feature circle{Kind::vertex_vertex, ve.robot, ev.obstacle};
    const bool is_common = is_smooth(scene, ve, circle) && is_smooth(scene, ev, circle) && parallel(x, y) > 0;
    return is_common ? std::optional(circle) : std::nullopt;
}

// True if two lines are one here, because edges known to be parallel join their contacts.
bool RoundJunction::are_one_line(const Feature& x, const Feature& y) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const auto are_parallel = [&](Index g, Index f) { return known.contains({0, 0, code(scene, {Kind::edge_edge, g, f})}); };
    const auto joins = [](const Shape& s, Index e, Index v, Index w) {
        return (s.point[s.v[e]] == s.point[v] && s.point[s.w[e]] == s.point[w]) || (s.point[s.v[e]] == s.point[w] && s.point[s.w[e]] == s.point[v]);
    };
    if (x.kind != y.kind) {
        const auto [ve, ev] = by_kind(x, y);
        return are_parallel(ev.robot, ve.obstacle) && common_circle(x, y);
    }
    const bool of_vertex = x.kind == Kind::vertex_edge;
    const Shape& turning = of_vertex ? A : O;
    const Index v = of_vertex ? x.robot : x.obstacle, w = of_vertex ? y.robot : y.obstacle;
    if (of_vertex ? O.line[x.obstacle] != O.line[y.obstacle] : A.line[x.robot] != A.line[y.robot]) return false;
    if (turning.vertex_radius[v] != turning.vertex_radius[w]) return false;
    const auto is_joint = [&](Index e) { return joins(turning, e, v, w) && (of_vertex ? are_parallel(e, x.obstacle) : are_parallel(x.robot, e)); };
    for (const Index u : {v, w})
        if (u < turning.ring_vertices) return is_joint(u) || is_joint(turning.previous[u]);
    for (Index e = 0; e < turning.ring_vertices; ++e)  // both are ends of arcs
        if (is_joint(e)) return true;
    return false;
}

// True if two places are of one curve here, by names: one surface, or two lines that are one; both branches where it touches.
bool RoundJunction::are_one_curve(const Spot& p, const Spot& q) {
    const bool is_one_surface = have_one_edge(p.on, q.on);
    if (p.is_limit || q.is_limit || (is_circle(p.on) && !is_one_surface)) return false;
    const auto is_joint = [&](const Spot& s) { return is_smooth(scene, s.on, s.curve) || is_smooth(scene, s.curve, s.on); };
    const auto have_one_branch = [&] {
        if (is_joint(p) || is_joint(q) || (is_line(p.on) && is_line(p.curve))) return true;
        return p.curve.branch == q.curve.branch && (is_one_surface || parallel(p.on, q.on) > 0);
    };
    if (p.curve.kind == Kind::seam || q.curve.kind == Kind::seam) return false;
    if (bare_code(scene, p.curve) != bare_code(scene, q.curve))
        return is_line(p.curve) && is_line(q.curve) && are_one_line(p.curve, q.curve) && have_one_branch();
    const auto touches = [&](const Spot& s) {
        const auto name = touch_name(scene, s.on, s.curve);
        return std::find(touching.begin(), touching.end(), name) != touching.end();
    };
    return have_one_branch() || touches(p) || touches(q);
}

// True if features that meet here prove two places equal: two curves; joints of a circle with parallel lines, in one quadrant.
bool RoundJunction::is_known(const Feature& surface, const Spot& p, const Spot& q) const {
    const bool are_on_it = (is_line(p.curve) && is_line(q.curve) && is_line(surface)) || (have_one_edge(p.on, surface) && have_one_edge(q.on, surface));
    if ((are_on_it && known.contains(name_on(scene, surface, p.curve, q.curve))) || do_cross(p, q)) return true;
    if (!is_circle(surface) || !is_smooth(scene, p.curve, surface) || !is_smooth(scene, q.curve, surface)) return false;
    if (p.curve.kind == q.curve.kind) return false;
    const auto [ve, ev] = by_kind(p.curve, q.curve);
    return known.contains({0, 0, code(scene, {Kind::edge_edge, ev.robot, ve.obstacle})});
}

// A ball around this angle, unless only the exact number gives it.
std::optional<Ball> RoundJunction::near_ball() {
    if (lo == hi) return Ball(lo);
    if (!narrow) return {};
    if (!bracket) bracket = narrow();
    return *bracket ? std::optional(ball_around(**bracket)) : std::nullopt;
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
    if (is_quick) return 0;
    return sign_at(AsSurdPoly{kappa}(form.template operator()<RootSum>(RoundSurfaces<RootSum>(scene))), here());
}

int RoundJunction::turn(const Feature& x, const Feature& y) {
    if (x.kind != y.kind) {
        const auto [ve, ev] = by_kind(x, y);
        const Code name = code(scene, {Kind::edge_edge, ev.robot, ve.obstacle});
        if (known.contains({0, 0, name})) return 0;
        const int found = sign([&]<class K>(const RoundSurfaces<K>& of) { return cross(of.along(x), of.along(y)); });
        if (found == 0 && !is_quick) known.insert({0, 0, name});
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

bool RoundJunction::have_one_sense(const Feature& x, const Feature& y) const { return is_concave(scene, x) == is_concave(scene, y); }

// Points of one circle that is that of a concave arc are in the opposite quadrant of another one.
bool RoundJunction::are_one_circle(const Feature& x, const Feature& y) {
    const bool is_same = have_one_sense(x, y);
    if (x.branch != ((y.branch + (is_same ? 0 : 2)) & 3)) return false;
    if (is_same && code(scene, x) == code(scene, y)) return true;
    const RootSum first = RoundSurfaces<RootSum>(scene).rho(x), second = RoundSurfaces<RootSum>(scene).rho(y);
    if ((is_same ? first - second : first + second).sign() != 0) return false;
    const auto is_zero_along = [&](int axis) {
        return sign([&]<class K>(const RoundSurfaces<K>& of) { return dot(of.between(x, y), of.axis(axis)); }) == 0;
    };
    return is_zero_along(0) && is_zero_along(1);
}

RoundSpot RoundJunction::spot(const Feature& on, const Feature& curve, bool is_after) {
    Spot result{on, curve, code(scene, curve), false, is_after, false, {}};
    if (is_circle(on) && is_circle(curve)) {
        Feature circle = curve;
        circle.branch = static_cast<std::int8_t>((on.branch + (have_one_sense(on, curve) ? 0 : 2)) & 3);
        result.jumps = are_one_circle(on, circle);
    }
    if (is_line(on) && is_line(curve)) result.is_limit = turn(on, curve) == 0;
    if (result.is_limit && on.kind != curve.kind)
        if (const auto circle = common_circle(on, curve)) result.curve = *circle, result.code = code(scene, *circle), result.is_limit = false;
    return result;
}

// A coordinate n / d of u, and the other one, minus the root of 1 - (n / d)^2.
template <class K, class Constant, class Ring>
static auto given_on_circle(const Ratio& given, int axis, const Constant& constant, const Ring& in) {
    using V = decltype(constant(whole<K>(1)));
    const V zero = in.number(whole<K>(0));
    const auto at = [&](const K& n, const K& square, const K& d) -> CurvePlace<V> {
        if (axis == 0) return {constant(n), zero, in.number(square), constant(d), true};
        return {zero, constant(whole<K>(-1)), in.number(square), constant(d), true};
    };
    const Int square = given.d * given.d - given.n * given.n;
    if constexpr (std::is_same_v<K, Approx>) {
        const double t = ratio(given.n, given.d);
        return at({t, std::abs(t)}, {(1 - t) * (1 + t), 1 + t * t}, whole<K>(1));
    } else if constexpr (std::is_same_v<K, Ball>) return at(ball(given.n, 0), ball(square, 0), ball(given.d, 0));
    else return at(K(given.n), K(square), K(given.d));
}

// The place on its own surface; t on another line that is the same here. On a circle of the other sense u is opposite, and the axes
// change places.
template <class K, class Ring>
auto RoundJunction::place(const Feature& surface, const Spot& p, int axis, const Ring& in) const {
    const bool is_turned = is_circle(surface) && is_circle(p.on) && !have_one_sense(surface, p.on);
    if (is_turned) axis = 1 - axis;
    const RoundSurfaces<K> of(scene);
    const auto constant = [&](const K& k) { return in(RoundSurfaces<K>::constant(k)); };
    using V = decltype(constant(whole<K>(1)));
    const auto own = [&]() -> CurvePlace<V> {
        if (p.is_limit) return limit_of_line<K>(scene, p.on, p.curve, in);
        if (!p.given) return place_of_curve<K>(scene, p.on, p.curve, axis, in);
        const V zero = in.number(whole<K>(0));
        if (is_circle(p.on)) return given_on_circle<K>(*p.given, axis, constant, in);
        if constexpr (std::is_same_v<K, Approx>) {
            const double t = ratio(p.given->n, p.given->d);
            return {constant(Approx{t, std::abs(t)}), zero, zero, constant(whole<K>(1)), false};
        } else if constexpr (std::is_same_v<K, Ball>) return {constant(ball(p.given->n, 0)), zero, zero, constant(ball(p.given->d, 0)), false};
        else return {constant(K(p.given->n)), zero, zero, constant(K(p.given->d)), false};
    };
    CurvePlace<V> result = own();
    if (is_turned) result.a = in.number(whole<K>(0)) - result.a, result.b = in.number(whole<K>(0)) - result.b;
    if (is_circle(p.on) || have_one_edge(p.on, surface)) return result;
    const auto U = of.along(surface);
    const V start = in(dot(of.between(p.on, surface), U)), step = in(dot(of.along(p.on), U));
    result.a = start * result.c + step * result.a, result.b = step * result.b;
    result.c = result.c * constant(of.square_of_length(surface));
    return result;
}

// The same, also where the curve's two surfaces are one circle here.
CurvePlace<SurdPoly> RoundJunction::place_exactly(const Feature& surface, const Spot& p, int axis) const {
    const AsSurdPoly in{kappa};
    if (p.jumps) {
        const bool is_turned = is_circle(surface) && !have_one_sense(surface, p.on);
        if (is_turned) axis = 1 - axis;
        // the centres part in the direction d', and the circles meet in the two directions +-J d'
        const RoundSurfaces<RootSum> of(scene);
        const Vec<RootSum> d = of.between(p.curve, p.on).p;
        const Quadrant ends = quadrant_of(scene, p.on);
        const MovingVector<RootSum> e = axis == 0 ? of.axis(ends.end) : of.axis(ends.begin + 2);
        const RootSum along = is_turned ? -dot(d, e.p) : dot(d, e.p), square = dot(d, d);
        const RootSum signed_along = (p.is_after ? 1 : -1) * p.curve.branch * of.rho(p.on).sign() > 0 ? along : -along;
        const SurdPoly zero = in.number(RootSum(0));
        return {in.number(signed_along), zero, zero, in.number(RootSum::root(square.c[0])), false};
    }
    return place<RootSum>(surface, p, axis, in);
}

Interval RoundJunction::range(const Feature& surface, const Spot& p) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (p.jumps) return {-infinity, infinity};
    const auto found = range_of(place<Approx>(surface, p, 0, Between{lo, hi, kappa}));
    return found ? Interval{found->lo, found->hi} : Interval{-infinity, infinity};
}

double RoundJunction::value(const Feature& surface, const Spot& p) {
    const auto near = near_ball();
    const Ball tau = near ? *near : narrow_ball(here());
    const auto coordinate = [&](int axis) {
        if (p.jumps) {
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
    if (!p.jumps && !q.jumps && !p.given && !q.given && are_one_curve(p, q)) return 0;
    if (!p.jumps && !q.jumps)
        for (int axis = 0; axis < (is_circle(surface) && !p.given && !q.given ? 2 : 1); ++axis) {
            const auto first = range_of(place<Approx>(surface, p, axis, Between{lo, hi, kappa}));
            const auto second = range_of(place<Approx>(surface, q, axis, Between{lo, hi, kappa}));
            if (first && second && first->hi < second->lo) return -1;
            if (first && second && second->hi < first->lo) return 1;
        }
    // where two lines are one, a joint of theirs is on both, but their curve may come to another place
    const bool is_of_crossing = !p.jumps && !q.jumps && !p.is_limit && !q.is_limit;
    if (is_of_crossing && !p.given && !q.given && is_known(surface, p, q)) return 0;
    if (!p.jumps && !q.jumps)
        if (const auto tau = near_ball()) {
            const InBalls in(*tau, kappa);
            if (const auto sign = certain_order(place<Ball>(surface, p, 0, in), place<Ball>(surface, q, 0, in))) return *sign;
        }
    const auto x = place_exactly(surface, p, 0), y = place_exactly(surface, q, 0);
    const Radicals difference{x.a * y.c - y.a * x.c, x.b * y.c, x.d, -(y.b * x.c), y.d, {}};
    return sign_at(difference, here()) * sign_at(x.c, here()) * sign_at(y.c, here());
}

RoundSpot RoundJunction::between(const Feature& x, const Spot& low, const Spot& high) {
    Spot at{x, {}, 0, false, false, false, Ratio{}};
    Int n, d = 1;
    for (Int first = 0, last = 1;;) {  // over d
        n = first + last, d *= 2, first *= 2, last *= 2;
        at.given = Ratio{n, d};
        const bool is_above = order(x, low, at) < 0;
        if (is_above && order(x, at, high) < 0) return at;
        (is_above ? last : first) = n;
    }
}

int RoundJunction::across(const Feature& x, const Feature& y, const Spot& p, const Spot& q, bool after) {
    const bool upwards = order(x, p, q) < 0;
    const auto [n, d] = *between(x, upwards ? p : q, upwards ? q : p).given;
    // left of y's line, times |U| of x and d
    const RoundSurfaces<RootSum> of(scene);
    const RootSum length = of.length(x), shift = of.rho(x) * RootSum(d);
    const Trig<RootSum> offset = RootSum(d) * length * of.offset(y, x) + RootSum(n) * length * cross(of.along(y), of.along(x)) -
                                 shift * dot(of.along(y), of.along(x));
    const SurdPoly form = AsSurdPoly{kappa}(offset);
    if (is_zero(form)) return 0;
    return after ? sign_after(form, here()) : sign_before(form, here());
}

// --- a place against other surfaces ----------------------------------------------------------------------------------

template <class K, class Ring>
auto RoundJunction::point(const Spot& p, const Ring& in) const {
    const auto t = place<K>(p.on, p, 0, in);
    return plane_point<K>(scene, p.on, t, is_line(p.on) ? t : place<K>(p.on, p, 1, in), in);
}

namespace {

// Products of a point of the plane, in a ring; all over p.c, and those of vectors over 1 + tau^2.
template <class K, class Ring>
class PointForms {
public:
    using V = decltype(std::declval<Ring>().number(whole<K>(0)));
    PointForms(const Scene& s, const PlanePoint<V>& at, const Ring& ring) : scene(s), of(s), p(at), in(ring) {}

    // Distance to the right of a line, times its length; or the square of the distance from a circle's centre, less that of its radius.
    CurvePlace<V> outside(const Feature& x) const {
        if (is_line(x)) {
            const auto U = of.along(x);
            const V ux = in(dot(U, of.axis(0))), uy = in(dot(U, of.axis(1))), offset = in(cross(U, start(x)));
            return {uy * p.x.a - ux * p.y.a + offset * p.c - constant(of.rho(x) * of.length(x)) * p.c, uy * p.x.b - ux * p.y.b, p.d, p.c, p.has_root};
        }
        const auto dx = from_centre(x, 0), dy = from_centre(x, 1);
        const V radius = constant(of.rho(x)) * p.c, two = in.number(whole<K>(2)), one = in.number(whole<K>(1));
        V square = dx.a * dx.a + dy.a * dy.a - radius * radius;
        if (p.has_root) square = square + (dx.b * dx.b + dy.b * dy.b) * p.d;
        return {square, two * (dx.a * dx.b + dy.a * dy.b), p.d, one, p.has_root};
    }
    // As place_of_curve, of a point on the surface.
    CurvePlace<V> place(const Feature& x, int axis) const {
        if (is_line(x)) {
            const auto [a, b] = along(of.along(x), x);
            return {a, b, p.d, p.c * constant(of.square_of_length(x)), p.has_root};
        }
        const Quadrant ends = quadrant_of(scene, x);
        const auto e = from_centre(x, axis == 0 ? ends.end : ends.begin + 2);
        return {e.a, e.b, p.d, p.c * constant(of.rho(x)), p.has_root};
    }
    CurvePlace<V> ahead(const Feature& line, const Feature& circle) const {
        const auto [a, b] = along(of.along(line), circle);
        return {a, b, p.d, p.c, p.has_root};
    }

private:
    struct Value {
        V a, b;
    };
    MovingVector<K> start(const Feature& x) const { return position<K>(scene, of.site(x)); }
    V constant(const K& k) const { return in(RoundSurfaces<K>::constant(k)); }
    // Vector from a surface's site along an axis, by a number of quarter turns.
    Value from_centre(const Feature& x, int turns) const {
        const V w = constant(whole<K>(1)), centre = in(dot(start(x), of.axis(turns))) * p.c;
        const auto& coordinate = turns % 2 == 0 ? p.x : p.y;
        const V factor = (turns & 3) < 2 ? w : in.number(whole<K>(0)) - w;
        return {factor * coordinate.a - centre, factor * coordinate.b};
    }
    Value along(const MovingVector<K>& U, const Feature& x) const {
        const V ux = in(dot(U, of.axis(0))), uy = in(dot(U, of.axis(1)));
        return {ux * p.x.a + uy * p.y.a - in(dot(start(x), U)) * p.c, ux * p.x.b + uy * p.y.b};
    }

    const Scene& scene;
    const RoundSurfaces<K> of;
    const PlanePoint<V>& p;
    const Ring& in;
};

template <class V>
V value_of(const CurvePlace<V>& x) {
    return x.has_root ? x.a + x.b * sqrt(x.d) : x.a;
}

}  // namespace

template <class F>
int RoundJunction::sign_of_place(const F& place_in) {
    const CurvePlace<Bounds> about = place_in.template operator()<Approx>(Between{lo, hi, kappa});
    const auto sign_of = [](const Bounds& b) { return b.lo > 0 ? 1 : b.hi < 0 ? -1 : 0; };
    if (const int sign = sign_of(value_of(about)) * sign_of(about.c); sign != 0 || is_quick) return sign;
    if (const auto tau = near_ball()) {
        const CurvePlace<Ball> near = place_in.template operator()<Ball>(InBalls(*tau, kappa));
        const auto value = certain_sign(value_of(near)), below = certain_sign(near.c);
        if (value && below) return *value * *below;
    }
    const CurvePlace<SurdPoly> x = place_in.template operator()<RootSum>(AsSurdPoly{kappa});
    return sign_at(Radicals{x.a, x.b, x.d, {}, {}, {}}, here()) * sign_at(x.c, here());
}

// Order of two places on one surface; exactly at once if a place is available only so.
template <class F, class G>
int RoundJunction::order_of_places(const F& first, const G& second, bool is_exact) {
    if (!is_exact) {
        const auto p = range_of(first.template operator()<Approx>(Between{lo, hi, kappa}));
        const auto q = range_of(second.template operator()<Approx>(Between{lo, hi, kappa}));
        if (p && q && p->hi < q->lo) return -1;
        if (p && q && q->hi < p->lo) return 1;
        if (const auto tau = near_ball()) {
            const InBalls in(*tau, kappa);
            if (const auto sign = certain_order(first.template operator()<Ball>(in), second.template operator()<Ball>(in))) return *sign;
        }
    }
    const AsSurdPoly in{kappa};
    const CurvePlace<SurdPoly> x = first.template operator()<RootSum>(in), y = second.template operator()<RootSum>(in);
    const Radicals difference{x.a * y.c - y.a * x.c, x.b * y.c, x.d, -(y.b * x.c), y.d, {}};
    return sign_at(difference, here()) * sign_at(x.c, here()) * sign_at(y.c, here());
}

int RoundJunction::outside(const Feature& x, const Spot& p) {
    const Code name = bare_code(scene, x);
    if (name == bare_code(scene, p.on) || (p.curve.kind != Kind::seam && !p.is_limit && name == bare_code(scene, p.curve))) return 0;
    return sign_of_place([&]<class K>(const auto& in) {
        const auto at = point<K>(p, in);
        return PointForms<K, std::remove_cvref_t<decltype(in)>>(scene, at, in).outside(x);
    });
}

int RoundJunction::ahead(const Feature& line, const Feature& circle, const Spot& p) {
    return sign_of_place([&]<class K>(const auto& in) {
        const auto at = point<K>(p, in);
        return PointForms<K, std::remove_cvref_t<decltype(in)>>(scene, at, in).ahead(line, circle);
    });
}

bool RoundJunction::is_between(const Feature& x, const Spot& low, const Spot& high, const Spot& p) {
    const auto place_of = [&](int axis) {
        return [this, &x, &p, axis]<class K>(const auto& in) {
            const auto at = point<K>(p, in);
            return PointForms<K, std::remove_cvref_t<decltype(in)>>(scene, at, in).place(x, axis);
        };
    };
    // both coordinates in a quadrant, from its beginning and towards its end, are positive
    if (is_circle(x) && (sign_of_place(place_of(0)) < 0 || sign_of_place(place_of(1)) > 0)) return false;
    const auto order_to = [&](const Spot& end) {
        return order_of_places(place_of(0), [&]<class K>(const auto& in) {
            if constexpr (std::is_same_v<K, RootSum>) return place_exactly(x, end, 0);
            else return place<K>(x, end, 0, in);
        }, end.jumps);
    };
    return order_to(low) >= 0 && order_to(high) <= 0;
}

bool RoundJunction::are_one_place(const Spot& p, const Spot& q) {
    if (p.code == q.code && code(scene, p.on) == code(scene, q.on)) return true;
    const auto coordinate = [&](const Spot& of, int axis) {
        return [this, &of, axis]<class K>(const auto& in) {
            const auto at = point<K>(of, in);
            const auto& x = axis == 0 ? at.x : at.y;
            return CurvePlace<std::remove_cvref_t<decltype(at.c)>>{x.a, x.b, at.d, at.c, at.has_root};
        };
    };
    return order_of_places(coordinate(p, 0), coordinate(q, 0), false) == 0 && order_of_places(coordinate(p, 1), coordinate(q, 1), false) == 0;
}

}  // namespace cfree
