// Places of curves on lines and circles, in intervals, balls and exactly; theory, "Rounded shapes".
#include "predicates/round_orders.hpp"

#include <limits>

#include "predicates/isolation.hpp"

namespace cfree {

namespace {

// Interval of doubles, rounded outwards.
struct Bounds {
    double lo, hi;
};
Bounds outwards(double lo, double hi) {
    return {lo - (4 * u * std::abs(lo) + tiny), hi + (4 * u * std::abs(hi) + tiny)};
}
Bounds operator+(const Bounds& x, const Bounds& y) { return outwards(x.lo + y.lo, x.hi + y.hi); }
Bounds operator-(const Bounds& x, const Bounds& y) { return outwards(x.lo - y.hi, x.hi - y.lo); }
Bounds operator*(const Bounds& x, const Bounds& y) {
    const auto [lo, hi] = std::minmax({x.lo * y.lo, x.lo * y.hi, x.hi * y.lo, x.hi * y.hi});
    return outwards(lo, hi);
}
Bounds sqrt(const Bounds& x) { return outwards(std::sqrt(std::max(0.0, x.lo)), std::sqrt(std::max(0.0, x.hi))); }
Bounds bounds(const Ball& x) {
    const double err = std::abs(x.lo) + x.radius;
    return outwards(x.hi - err, x.hi + err);
}

// Ring of intervals that hold the values at all angles between two.
struct Between {
    double lo, hi, kappa;
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

// Ring of polynomials in tau with balls as coefficients.
struct BallPoly : Coefficients<Ball> {};
BallPoly combined(const BallPoly& p, const BallPoly& q, double sign) {
    BallPoly result{{{}, std::max(p.count, q.count)}};
    for (int i = 0; i < result.count; ++i) {
        if (i < p.count) result.c[i] = p.c[i];
        if (i < q.count) result.c[i] = sign > 0 ? result.c[i] + q.c[i] : result.c[i] - q.c[i];
    }
    return result;
}
BallPoly operator+(const BallPoly& p, const BallPoly& q) { return combined(p, q, 1); }
BallPoly operator-(const BallPoly& p, const BallPoly& q) { return combined(p, q, -1); }
BallPoly operator*(const BallPoly& p, const BallPoly& q) {
    BallPoly result{{{}, p.count + q.count - 1}};
    for (int i = 0; i < p.count; ++i)
        for (int j = 0; j < q.count; ++j) result.c[i + j] = result.c[i + j] + p.c[i] * q.c[j];
    return result;
}

struct AsBallPoly {
    double kappa;
    BallPoly operator()(const Trig<Ball>& f) const {
        const auto c = quadratic(f, kappa);
        return {{{c[0], c[1], c[2]}, 3}};
    }
};
struct AsSurdPoly {
    double kappa;
    SurdPoly number(const RootSum& k) const { return surd_polynomial({&k, 1}); }
    SurdPoly operator()(const Trig<RootSum>& f) const { return surd_polynomial(quadratic(f, kappa)); }
};

// Sign of (A + b sqrt(d)) - (...), in balls, if certain: p - q of two places.
std::optional<int> sign_of_difference(const Ball& a, const Ball& b, const Ball& d, const Ball& c, const Ball& e) {
    Ball sum = a;
    if (certain_sign(b) != 0) sum = sum + b * sqrt(d);
    if (certain_sign(c) != 0) sum = sum + c * sqrt(e);
    return certain_sign(sum);
}

}  // namespace

// Place of a curve on the surface; on a circle a coordinate of u that grows counter-clockwise over the quadrant: along the
// axis at its end (axis 0), or against that at its beginning (1).
template <class K, class Ring>
auto RoundOrders::place(const Feature& f, int axis, const Ring& in) const {
    const RoundSurfaces<K> of(scene);
    const auto constant = [&](const K& k) { return in(RoundSurfaces<K>::constant(k)); };
    using V = decltype(constant(K(1)));
    const V zero = in.number(K(0)), w = constant(K(1));
    const Feature& x = surface.contact;
    if (is_line(x)) {
        const auto U = of.along(x);
        const K square = of.square_of_length(x);
        if (is_smooth(scene, x, f)) {
            const bool at_end = x.kind == Kind::vertex_edge
                                    ? scene.obstacles.point[f.obstacle] == scene.obstacles.point[scene.obstacles.w[x.obstacle]]
                                    : scene.robot.point[f.robot] == scene.robot.point[scene.robot.w[x.robot]];
            return Place<V>{constant(K(at_end ? 1 : 0)), zero, zero, w, false};
        }
        if (is_line(f)) {
            const auto V_ = of.along(f);
            const auto N = of.rho(x) * of.length(x) * dot(V_, U) - square * of.offset(f, x);
            return Place<V>{in(N), zero, zero, in(square * cross(V_, U)), false};
        }
        const K sigma = of.rho(f);
        const V M = in(of.offset(x, f));
        return Place<V>{in(dot(of.between(f, x), U)), in.number(K(f.branch)), constant(sigma * sigma * square) * w - M * M,
                        constant(square), true};
    }
    const MovingVector<K> e = axis == 0 ? of.axis(x.branch + 1) : of.axis(x.branch + 2);
    if (f.kind == Kind::seam) return Place<V>{in(dot(of.axis(f.branch), e)), zero, zero, w, false};
    if (is_smooth(scene, f, x))
        return Place<V>{in(-dot(quarter_turn(of.along(f)), e)), zero, zero, constant(of.length(f)), false};
    const auto seen = of.seen(x, f);
    const K r = of.rho(x);
    const V delta = in(seen.delta), square = in(seen.square);
    return Place<V>{delta * in(dot(seen.n, e)), in.number(K(f.branch)) * in(dot(quarter_turn(seen.n), e)),
                    constant(r * r) * square - delta * delta, constant(r) * square, true};
}

// Range of a place, if its denominator is certain.
template <class Place>
static std::optional<Bounds> range_of(Place x) {
    if (x.has_root) x.a = x.a + x.b * sqrt(x.d);
    if (x.c.hi < 0) x.a = Bounds{0, 0} - x.a, x.c = Bounds{0, 0} - x.c;
    if (!(x.c.lo > 0)) return {};
    return outwards(std::min(x.a.lo / x.c.lo, x.a.lo / x.c.hi), std::max(x.a.hi / x.c.lo, x.a.hi / x.c.hi));
}

int RoundOrders::compare_radius(const Feature& circle) const {
    const RoundSurfaces<RootSum> of(scene);
    return (of.rho(surface.contact) - of.rho(circle)).sign();
}

std::array<double, 2> RoundOrders::range(const Feature& f, double lo, double hi) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto found = range_of(place<Ball>(f, 0, Between{lo, hi, kappa}));
    return found ? std::array{found->lo, found->hi} : std::array{-infinity, infinity};
}

int RoundOrders::order_on(const Feature& p, const Feature& q, double lo, double hi) const {
    const Between in{lo, hi, kappa};
    for (int axis = 0; axis < (is_line(surface.contact) ? 1 : 2); ++axis) {
        const auto first = range_of(place<Ball>(p, axis, in)), second = range_of(place<Ball>(q, axis, in));
        if (first && second && first->hi < second->lo) return -1;
        if (first && second && second->hi < first->lo) return 1;
    }
    return 0;
}

std::optional<int> RoundOrders::order_in_balls(const Feature& p, const Feature& q, const Ball& tau) const {
    const InBalls in(tau, kappa);
    for (int axis = 0; axis < (is_line(surface.contact) ? 1 : 2); ++axis) {
        const auto x = place<Ball>(p, axis, in), y = place<Ball>(q, axis, in);
        const auto first = certain_sign(x.c), second = certain_sign(y.c);
        if (!first || !second) continue;
        const auto sign = sign_of_difference(x.a * y.c - y.a * x.c, x.b * y.c, x.d, -(y.b * x.c), y.d);
        if (sign) return *sign * *first * *second;
    }
    return {};
}

RoundOrders::Difference RoundOrders::difference(const Feature& p, const Feature& q) const {
    const AsSurdPoly in{kappa};
    const auto x = place<RootSum>(p, 0, in), y = place<RootSum>(q, 0, in);
    return {{x.a * y.c - y.a * x.c, x.b * y.c, x.d, -(y.b * x.c), y.d, {}}, x.c, y.c};
}

int RoundOrders::order_at(const Feature& p, const Feature& q, const Dyadic& tau) const {
    const Difference d = difference(p, q);
    return sign_at(d.value, tau) * sign_at(d.first, tau) * sign_at(d.second, tau);
}

int RoundOrders::order_at(const Feature& p, const Feature& q, LongRoot& root) const {
    const Difference d = difference(p, q);
    return sign_at(d.value, root) * sign_at(d.first, root) * sign_at(d.second, root);
}

int RoundOrders::turn(const Feature& f, const Feature& g, const Dyadic& tau) const {
    const RoundSurfaces<RootSum> of(scene);
    const auto direction = [&](const Feature& to) { return to.kind == Kind::seam ? quarter_turn(of.axis(to.branch)) : of.along(to); };
    return sign_at(AsSurdPoly{kappa}(cross(direction(f), direction(g))), tau);  // both a quarter turn on
}

int RoundOrders::coordinate_sign(const Feature& curve, int axis, const Dyadic& tau) const {
    const auto in_balls = place<Ball>(curve, axis, InBalls(Ball(tau.rounded_down()), kappa));
    const bool is_double = compare(Dyadic::from(tau.rounded_down()), tau) == 0;
    const auto sign = sign_of_difference(in_balls.a, in_balls.b, in_balls.d, {}, {}), below = certain_sign(in_balls.c);
    if (is_double && sign && below) return *sign * *below;
    const auto x = place<RootSum>(curve, axis, AsSurdPoly{kappa});
    return sign_at(Radicals{x.a, x.b, x.d, {}, {}, {}}, tau) * sign_at(x.c, tau);
}

bool RoundOrders::meet_at(const Feature& p, const Feature& q, LongRoot& root) const {
    return sign_at(difference(p, q).value, root) == 0;
}

// On a line the circle is entered at its joint where nu . U < 0, nu the outward normal of the other line; on a circle where that
// of the circle turns into it.
template <class K>
Trig<K> RoundOrders::joint_direction(const Feature& line, const Feature& circle) const {
    const RoundSurfaces<K> of(scene);
    const Feature& x = surface.contact;
    return is_line(x) ? cross(of.along(x), of.along(line)) : -dot(of.between(circle, x), of.along(line));
}
std::optional<int> RoundOrders::joint_branch(const Feature& line, const Feature& circle, double lo, double hi) const {
    const Bounds range = Between{lo, hi, kappa}(joint_direction<Ball>(line, circle));
    return range.lo > 0 ? std::optional(1) : range.hi < 0 ? std::optional(-1) : std::nullopt;
}
int RoundOrders::joint_branch(const Feature& line, const Feature& circle, LongRoot& root) const {
    return sign_at(AsSurdPoly{kappa}(joint_direction<RootSum>(line, circle)), root);
}

template <class K, class Ring>
auto RoundOrders::event(const Feature& first, const Feature& second, const Ring& in) const {
    const RoundSurfaces<K> of(scene);
    if (first.kind == Kind::edge_edge)
        return in(Predicates::parallel_trig(edge<K>(scene.robot, first.robot), edge<K>(scene.obstacles, first.obstacle)));
    if (second.kind == Kind::none) return in(of.tangency(surface.contact, first, first.branch));
    if (second.branch == 2 && is_circle(second)) return in(dot(of.along(first), of.between(surface.contact, second)));  // see Event
    if (second.kind == Kind::seam) return in(of.end_of_quadrant(surface.contact, second.branch, first));
    return meeting(of, scene, surface.contact, first, second, in);
}

Coefficients<Ball> RoundOrders::in_balls(const Feature& first, const Feature& second) const {
    return event<Ball>(first, second, AsBallPoly{kappa});
}
SurdPoly RoundOrders::exactly(const Feature& first, const Feature& second) const {
    return event<RootSum>(first, second, AsSurdPoly{kappa});
}

}  // namespace cfree
