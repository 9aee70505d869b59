// Orders of curves on lines and circles, in intervals, balls and exactly; theory, "Rounded shapes".
#include "predicates/round_orders.hpp"

#include <atomic>
#include <limits>
#include <memory>
#include <stdexcept>

#include "cfree/exact/squaring.hpp"
#include "predicates/round_places.hpp"

namespace cfree {

namespace {

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

// Place of a number in a table of 2^bits.
std::size_t place_in_table(std::uint64_t number, int bits) { return number * 0x9e3779b97f4a7c15u >> (64 - bits); }

// Entry for a number in the thread's table, which all orders share: there are too many of them to set up one for each.
template <class Kept, int bits>
Kept& shared_entry(std::uint64_t number) {
    static thread_local const std::unique_ptr<Kept[]> table(new Kept[std::size_t(1) << bits]);
    return table[place_in_table(number, bits)];
}

std::atomic<std::uint64_t> orders_made{0};

}  // namespace

RoundOrders::RoundOrders(const Scene& s, const Surface& on) : scene(s), surface(on), kappa(on.chart ? -1 : 1), number(++orders_made) {}

int RoundOrders::compare_radius(const Feature& circle) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index own[] = {A.vertex_radius[surface.contact.robot], O.vertex_radius[surface.contact.obstacle]};
    const Index other[] = {A.vertex_radius[circle.robot], O.vertex_radius[circle.obstacle]};
    if (A.has_concave() || O.has_concave())
        return Int(abs(rho<Int>(scene, own[0], own[1])) - abs(rho<Int>(scene, other[0], other[1]))).sign();
    if (own[0] == other[0] || own[1] == other[1]) {  // classes rise
        const Index difference = own[0] - other[0] + own[1] - other[1];
        return (difference > 0) - (difference < 0);
    }
    return (rho<Int>(scene, own[0], own[1]) - rho<Int>(scene, other[0], other[1])).sign();
}

std::array<double, 2> RoundOrders::range(const Feature& f, double lo, double hi) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto found = kept_range(f, 0, {lo, hi, kappa});
    return found ? std::array{found->lo, found->hi} : std::array{-infinity, infinity};
}

RoundOrders::KeptPlace& RoundOrders::kept_place(const Feature& f, int axis) const {
    const Name curve = name(f);
    KeptPlace& here = shared_entry<KeptPlace, 7>(2 * curve + static_cast<Name>(axis) + 5 * number);
    if (here.owner == number && here.curve == curve && here.axis == axis) return here;
    const PlaceParts<Trig<Approx>> parts = parts_of_place<Approx>(scene, surface.contact, f, axis);
    here.owner = number, here.curve = curve, here.axis = axis, here.parts.form = parts.form, here.lo = 1, here.hi = 0;
    for (std::size_t k = 0; k < parts.f.size(); ++k) here.parts.f[k] = filtered_round(parts.f[k], kappa);
    return here;
}

std::optional<Bounds> RoundOrders::kept_range(const Feature& f, int axis, const Between& in) const {
    KeptPlace& here = kept_place(f, axis);
    if (here.lo != in.lo || here.hi != in.hi) {
        here.range = range_of(place_of_parts<Approx>(here.parts, f.branch, in));
        here.lo = in.lo, here.hi = in.hi;
    }
    return here.range;
}

int RoundOrders::order_on(const Feature& p, const Feature& q, double lo, double hi) const {
    const Between in{lo, hi, kappa};
    for (int axis = 0; axis < (is_line(surface.contact) ? 1 : 2); ++axis) {
        const auto first = kept_range(p, axis, in), second = kept_range(q, axis, in);
        if (first && second && first->hi < second->lo) return -1;
        if (first && second && second->hi < first->lo) return 1;
    }
    return 0;
}

std::optional<int> RoundOrders::order_in_balls(const Feature& p, const Feature& q, const Ball& tau) const {
    const InBalls in(tau, kappa);
    for (int axis = 0; axis < (is_line(surface.contact) ? 1 : 2); ++axis) {
        const auto sign = certain_order(place<Ball>(p, axis, in), place<Ball>(q, axis, in));
        if (sign) return sign;
    }
    return {};
}

RoundOrders::Difference RoundOrders::difference(const Feature& p, const Feature& q) const {
    const AsSurdPoly in{kappa};
    const auto x = place<RootSum>(p, 0, in), y = place<RootSum>(q, 0, in);
    return {{x.a * y.c - y.a * x.c, x.b * y.c, x.d, -(y.b * x.c), y.d, {}}, x.c, y.c};
}

int RoundOrders::order_at(const Feature& p, const Feature& q, const Sample& at) const {
    const Between near = around(at);
    if (const int sign = order_on(p, q, near.lo, near.hi); sign != 0) return sign;
    if (const auto sign = order_in_balls(p, q, at.ball())) return *sign;
    return order_exactly(p, q, at);
}

int RoundOrders::order_exactly(const Feature& p, const Feature& q, const Sample& at) const {
    const Exactly in(at.exact(), kappa);
    const auto x = place<RootSum>(p, 0, in), y = place<RootSum>(q, 0, in);
    const int difference = sign_by_squaring(x.a * y.c - y.a * x.c, x.b * y.c, x.d, -(y.b * x.c), RootSum(), y.d,
                                            [](const RootSum& k) { return k.sign(); });
    return difference * x.c.sign() * y.c.sign();
}

int RoundOrders::order_at(const Feature& p, const Feature& q, LongRoot& root) const {
    const Difference d = difference(p, q);
    return sign_at(d.value, root) * sign_at(d.first, root) * sign_at(d.second, root);
}

RoundOrders::Direction RoundOrders::direction(const Feature& to, const Sample& at) const {
    constexpr double unit[] = {1, 0, -1, 0};
    if (to.kind == Kind::seam) return {to, -unit[(to.branch + 3) & 3], unit[to.branch & 3], 1};
    if (to.kind == Kind::vertex_edge) {
        const auto E = close_edge<Approx>(scene.obstacles, to.obstacle);
        return {to, E.x.v, E.y.v, E.x.m + E.y.m};
    }
    const double cosine = kappa * (1 - at.tau * at.tau), sine = 2 * kappa * at.tau;  // times 1 + tau^2 <= 2
    const auto E = close_edge<Approx>(scene.robot, to.robot);
    return {to, sine * E.y.v - cosine * E.x.v, -sine * E.x.v - cosine * E.y.v, 4 * (E.x.m + E.y.m)};
}

int RoundOrders::turn(const Direction& d, const Direction& e, const Sample& at) const {
    const Feature &f = d.to, &g = e.to;
    if (f.kind == Kind::seam && g.kind == Kind::seam) {
        const int quarters = (g.branch - f.branch) & 3;
        return quarters % 2 == 0 ? 0 : 2 - quarters;
    }
    if (f.kind == g.kind && (f.kind == Kind::vertex_edge ? f.obstacle == g.obstacle : f.kind == Kind::edge_vertex && f.robot == g.robot))
        return 0;
    if (const double value = d.x * e.y - d.y * e.x; std::abs(value) > 0x1p-46 * (d.m * e.m) + tiny) return value > 0 ? 1 : -1;
    const auto form = [&]<class K>(const RoundSurfaces<K>& of) {  // of both, a quarter turn on
        const auto along = [&](const Feature& to) { return to.kind == Kind::seam ? quarter_turn(of.axis(to.branch)) : of.along(to); };
        return cross(along(f), along(g));
    };
    if (const auto sign = certain_sign(InBalls(at.ball(), kappa)(form(RoundSurfaces<Ball>(scene))))) return *sign;
    return sign_at(AsSurdPoly{kappa}(form(RoundSurfaces<RootSum>(scene))), at.exact());
}

int RoundOrders::coordinate_sign(const Feature& curve, int axis, const Sample& at) const {
    if (const auto range = kept_range(curve, axis, around(at)))
        if (range->lo > 0 || range->hi < 0) return range->lo > 0 ? 1 : -1;
    const Ball zero = 0.0, one = 1.0;
    if (const auto sign = certain_order(place<Ball>(curve, axis, InBalls(at.ball(), kappa)), {zero, zero, zero, one, false})) return *sign;
    const auto x = place<RootSum>(curve, axis, AsSurdPoly{kappa});
    const Dyadic tau = at.exact();
    return sign_at(Radicals{x.a, x.b, x.d, {}, {}, {}}, tau) * sign_at(x.c, tau);
}

bool RoundOrders::do_meet(const Feature& p, const Feature& q, double lo, double hi) const {
    if (const auto line = line_of_joint(scene, p, q)) {
        const auto branch = joint_branch(*line, is_circle(p) ? p : q, lo, hi);
        return branch && are_on(*branch, p, q);
    }
    for (const Feature* f : {&p, &q}) {
        const auto x = place(*f, 0, Between{lo, hi, kappa});
        if (!(x.c.lo > 0 || x.c.hi < 0) || (x.has_root && !(x.d.lo > 0))) return false;
    }
    const auto order = [&](double tau) {
        const int sign = order_on(p, q, tau, tau);
        return sign != 0 ? sign : order_in_balls(p, q, tau).value_or(0);
    };
    return order(lo) * order(hi) < 0;
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
    const Bounds range = Between{lo, hi, kappa}(joint_direction<Approx>(line, circle));
    return range.lo > 0 ? std::optional(1) : range.hi < 0 ? std::optional(-1) : std::nullopt;
}
int RoundOrders::joint_branch(const Feature& line, const Feature& circle, LongRoot& root) const {
    return sign_at(AsSurdPoly{kappa}(joint_direction<RootSum>(line, circle)), root);
}

template <class K>
std::optional<Trig<K>> RoundOrders::quadratic(const Feature& first, const Feature& second) const {
    const RoundSurfaces<K> of(scene);
    if (first.kind == Kind::edge_edge)
        return Predicates::parallel_trig(close_edge<K>(scene.robot, first.robot), close_edge<K>(scene.obstacles, first.obstacle));
    if (second.kind == Kind::none) return of.tangency(surface.contact, first, first.branch);
    if (is_center(second)) {
        if (is_line(first)) return dot(of.along(first), of.between(surface.contact, second));
        if (is_line(surface.contact)) return dot(of.along(surface.contact), of.between(first, second));
        return cross(of.between(first, surface.contact), of.between(second, surface.contact));
    }
    if (second.kind == Kind::seam) return of.end_of_quadrant(surface.contact, second.branch, first);
    if (first.kind == Kind::seam) return of.end_of_quadrant(surface.contact, first.branch, second);
    return joint_of_three(of, scene, surface.contact, first, second);
}

bool RoundOrders::are_proportional(const Event& x, const Event& y) const {
    // true if all minors are zero; nothing if that is not certain
    const auto answer = [&]<class K>(const auto& sign) -> std::optional<bool> {
        const auto of = [&](const Event& e) {
            if constexpr (std::is_same_v<K, RootSum>) return kept_exactly(e.first, e.second).quadratic;
            else return quadratic<K>(e.first, e.second);
        };
        const auto f = of(x), g = of(y);
        if (!f || !g) return false;
        bool is_certain = true;
        for (const K& minor : {f->a * g->b - f->b * g->a, f->a * g->c - f->c * g->a, f->b * g->c - f->c * g->b}) {
            const std::optional<int> found = sign(minor);
            if (found && *found != 0) return false;
            is_certain &= found.has_value();
        }
        return is_certain ? std::optional(true) : std::nullopt;
    };
    const auto by_doubles = answer.template operator()<Approx>(
        [](const Approx& v) { return std::abs(v.v) > 2 * round_error * v.m + tiny ? std::optional(1) : std::nullopt; });
    if (by_doubles) return *by_doubles;
    if (const auto by_balls = answer.template operator()<Ball>([](const Ball& v) { return certain_sign(v); })) return *by_balls;
    const SurdPoly p = exactly(x.first, x.second).p, &q = exactly(y.first, y.second).p;
    if (p.roots == q.roots && (p.c == q.c || p.c == (-q).c)) return true;
    if (p.is_rational() && q.is_rational()) return false;
    return *answer.template operator()<RootSum>([](const RootSum& v) { return std::optional(v.sign()); });
}

RoundOrders::Turned RoundOrders::turned_to(double tau) const {
    const double w = 1 + tau * tau;
    return {kappa * (1 - tau * tau) / w, kappa * 2 * tau / w};
}
RoundOrders::Vector RoundOrders::turned(const Vec<Approx>& v, const Turned& at) const {
    return {at.cosine * v.x.v - at.sine * v.y.v, at.sine * v.x.v + at.cosine * v.y.v, 2 * (v.x.m + v.y.m)};
}
RoundOrders::Vector RoundOrders::along(const Feature& line, const Turned& at) const {
    if (line.kind == Kind::vertex_edge) {
        const auto E = close_edge<Approx>(scene.obstacles, line.obstacle);
        return {E.x.v, E.y.v, E.x.m + E.y.m};
    }
    const Vector E = turned(close_edge<Approx>(scene.robot, line.robot), at);
    return {-E.x, -E.y, E.m};
}
RoundOrders::Vector RoundOrders::to_centre(const Feature& circle, const Turned& at) const {
    const RoundSurfaces<Approx> of(scene);
    const Site to = of.site(circle), from = of.site(surface.contact);
    const auto fixed = close_difference<Approx>(scene.obstacles, to.obstacle, from.obstacle);
    const Vector turning = turned(close_difference<Approx>(scene.robot, to.robot, from.robot), at);
    return {fixed.x.v - turning.x, fixed.y.v - turning.y, fixed.x.m + fixed.y.m + turning.m};
}

// The joint is d + r nu from the surface's site: less than 30 roundings in a row, and magnitudes of vectors as sums of coordinates.
int RoundOrders::joint_sign(const Feature& line, const Vector& V, const Feature& circle, const Vector& d, const Vector& U) const {
    const Feature& x = surface.contact;
    const RoundSurfaces<Approx> of(scene);
    const double r = of.rho(circle).v / of.length(line).v, rho = of.rho(x).v;
    const Vector joint{d.x + r * V.y, d.y - r * V.x, d.m + std::abs(r) * V.m};
    double value, most;
    if (is_line(x)) {
        const double offset = rho * of.length(x).v;
        value = U.x * joint.y - U.y * joint.x + offset, most = U.m * joint.m + std::abs(offset);
    } else {
        value = joint.x * joint.x + joint.y * joint.y - rho * rho, most = joint.m * joint.m + rho * rho;
    }
    const double err = round_error * most + tiny;
    return value > err ? 1 : value < -err ? -1 : 0;
}

RoundOrders::KeptQuadratic* RoundOrders::kept_quadratic(const Feature& first, const Feature& second) const {
    const Name first_name = name(first), second_name = name(second);
    KeptQuadratic& here = shared_entry<KeptQuadratic, 8>(first_name + 7 * second_name + 5 * number);
    if (here.owner != number || here.first != first_name || here.second != second_name) {
        const auto f = quadratic<Approx>(first, second);
        here = {number, first_name, second_name, f.has_value(), f ? filtered_round(*f, kappa) : Filtered{}};
    }
    return here.is_quadratic ? &here : nullptr;
}

int RoundOrders::sign(const Feature& first, const Feature& second, double tau) const {
    const KeptQuadratic* kept = kept_quadratic(first, second);
    if (!kept) return form(first, second).sign(tau);
    const double value = kept->p.polar(tau, tau);
    return value > kept->p.err ? 1 : value < -kept->p.err ? -1 : 0;
}
int RoundOrders::sign_on(const Feature& first, const Feature& second, double lo, double hi) const {
    if (const KeptQuadratic* kept = kept_quadratic(first, second)) return Predicates::sign_on(kept->p, lo, hi);
    const RoundForm all = form(first, second);
    int sign[7];
    all.signs(lo, hi, sign);
    return common_sign(sign, all.degree);
}

bool RoundOrders::isolate(const Feature& first, const Feature& second, double lo, double hi, Brackets& found) const {
    KeptQuadratic* kept = kept_quadratic(first, second);
    if (!kept) return isolate_around(form(first, second), lo, hi, found) && are_narrow(found);
    if (!kept->is_isolated) {
        kept->is_isolated = isolate_around(form(first, second), -1, 1, found) && are_narrow(found);
        kept->roots = {};
        for (int k = 0; *kept->is_isolated && k < found.size(); ++k) kept->roots.push_back(found[k]);
    }
    found = {};
    for (const auto& root : kept->roots) found.push_back(root);
    return *kept->is_isolated;
}

RoundForm RoundOrders::form(const Feature& first, const Feature& second) const {
    RoundForm result;
    if (const KeptQuadratic* kept = kept_quadratic(first, second)) {
        result.p = kept->p;
        return result;
    }
    const Products<Approx> all = meeting(RoundSurfaces<Approx>(scene), surface.contact, first, second);
    result.degree = all.degree;
    for (int i = 0; i < all.factor_count; ++i) result.factors.push_back(filtered_round(all.factors[static_cast<std::size_t>(i)], kappa));
    for (int t = 0; t < all.term_count; ++t) result.terms.push_back(all.terms[static_cast<std::size_t>(t)]);
    return result;
}

Coefficients<Ball> RoundOrders::in_balls(const Feature& first, const Feature& second) const {
    const AsBallPoly in{kappa};
    if (const auto trig = quadratic<Ball>(first, second)) return in(*trig);
    return sum_of(meeting(RoundSurfaces<Ball>(scene), surface.contact, first, second), in);
}

RoundOrders::KeptExactly& RoundOrders::kept_exactly(const Feature& first, const Feature& second) const {
    const Name first_name = name(first), second_name = name(second);
    constexpr int bits = 6;
    if (exact.empty()) exact.resize(std::size_t(1) << bits);
    KeptExactly& here = exact[place_in_table(first_name + 7 * second_name, bits)];
    if (here.first != first_name || here.second != second_name)
        here = {first_name, second_name, quadratic<RootSum>(first, second), {}, 1, 0, {}};
    return here;
}
const NormedPoly& RoundOrders::exactly(const Feature& first, const Feature& second) const {
    KeptExactly& here = kept_exactly(first, second);
    if (!here.polynomial) {
        const AsSurdPoly in{kappa};
        here.polynomial = here.quadratic ? in(*here.quadratic)
                                         : sum_of(meeting(RoundSurfaces<RootSum>(scene), surface.contact, first, second), in);
    }
    return *here.polynomial;
}
LongRoot RoundOrders::root_between(const Feature& first, const Feature& second, double lo, double hi) const {
    const NormedPoly& p = exactly(first, second);
    KeptExactly& here = kept_exactly(first, second);
    if (!here.root || here.lo != lo || here.hi != hi) {
        auto roots = roots_between(p, Dyadic::from(lo), Dyadic::from(hi));
        if (roots.size() != 1) throw std::logic_error("an angle is not the only root in its interval");
        here.root = std::move(roots[0].at), here.lo = lo, here.hi = hi;
    }
    return *here.root;
}

}  // namespace cfree
