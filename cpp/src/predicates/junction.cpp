// Contact lines at one critical angle: the same line, the order along it and around it; theory, "Closed surfaces".
#include "cfree/predicates/junction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "predicates/form.hpp"

namespace cfree {

namespace {

bool is_on_edge(const Feature& x) { return x.kind == Kind::vertex_edge; }

template <class T>
T number(const Int& n) {
    if constexpr (std::is_same_v<T, Ball>) return ball(n, 0);
    else return n;
}

// Ends that were rounded once.
Interval widened(double lo, double hi) { return {lo - 4 * u * std::abs(lo) - tiny, hi + 4 * u * std::abs(hi) + tiny}; }

template <class T>
Trig<T> times(const T& k, const Trig<T>& f) { return {k * f.a, k * f.b, k * f.c}; }
template <class T>
Trig<T> sum(const Trig<T>& f, const Trig<T>& g) { return {f.a + g.a, f.b + g.b, f.c + g.c}; }

}  // namespace

Junction::Junction(const Scene& s, int in, double from, double to, std::function<RealRoot()> number,
                   std::function<std::optional<Predicates::Bracket>()> narrower)
    : scene(s), on_any(s, {{}, in}), lo(from), hi(to), exact(std::move(number)), bracket(std::move(narrower)) {}

Poly Junction::polynomial(const Trig<Int>& f) const { return on_any.polynomial(f); }
Filtered Junction::filtered(const Trig<Approx>& f) const { return on_any.filtered(f); }

// Sign at the angle of a trigonometric form, available in every number type.
template <class F>
int Junction::sign(const F& trig) const {
    if (const int s = Predicates::sign_on(filtered(trig(Approx{})), lo, hi); s != 0) return s;
    const auto p = on_any.coefficients(trig(Ball{}));
    if (const auto s = by_balls([&](const Ball& tau) { return certain_sign(value_at(p, tau)); })) return *s;
    if (zero_here && are_proportional(*zero_here, p) == true) return 0;
    const int s = sign_at(polynomial(trig(Int{})), here());
    if (s == 0 && std::any_of(p.c, p.c + p.count, [](const Ball& c) { return certain_sign(c).value_or(0) != 0; })) zero_here = p;
    return s;
}

// Sign in a ball around the angle, which mostly suffices if doubles do not; then at the angle, if it has few digits.
template <class Question>
std::optional<int> Junction::by_balls(const Question& question) const {
    if (const Ball* tau = narrow())
        if (const auto s = question(*tau)) return s;
    const Ball* tau = dyadic();
    return tau ? question(*tau) : std::nullopt;
}

const Ball* Junction::narrow() const {
    if (bracket) {
        if (const auto found = bracket()) {
            const auto& [below, above] = *found;
            const Ball width = above - below, middle = Ball(0.5) * (below + above);
            narrowed = Ball{middle.hi, middle.lo, middle.radius + 0.75 * (width.hi + width.radius)};
        }
        bracket = nullptr;
    }
    return narrowed ? &*narrowed : nullptr;
}

// The angle, if it is a number of few digits: then balls often decide, even ties.
const Ball* Junction::dyadic() const {
    if (here().is_dyadic() && !few_digits) few_digits = ball(root->lo.n, static_cast<int>(root->lo.k));
    return few_digits && few_digits->radius == 0 ? &*few_digits : nullptr;
}

// Range of f times 1 + tau^2: between its Bernstein coefficients, each within err.
Interval Junction::range(const Filtered& f) const {
    const double p = f.polar(lo, lo), q = f.polar(lo, hi), r = f.polar(hi, hi);
    return widened(std::min({p, q, r}) - f.err, std::max({p, q, r}) + f.err);
}

RealRoot& Junction::here() const {
    if (!root) root = exact();
    return *root;
}

// The surface's line is P + t U, U = E_j or -R E_i.
template <class T>
Trig<T> Junction::along(const Feature& x, Index a, Index b) const {
    const Feature start = end_helix(scene, x, 0);
    const Index a0 = start.robot, b0 = start.obstacle;
    const auto w = difference<T>(scene.obstacles, b, b0), d = difference<T>(scene.robot, a, a0);
    if (is_on_edge(x)) {
        const auto E = edge<T>(scene.obstacles, x.obstacle);
        return {dot(w, E), -dot(d, E), -cross(d, E)};
    }
    const auto G = edge<T>(scene.robot, x.robot);
    return {dot(G, d), -dot(G, w), -cross(G, w)};
}

template <class T>
Vec<T> Junction::direction(const Feature& x) const {
    return is_on_edge(x) ? edge<T>(scene.obstacles, x.obstacle) : edge<T>(scene.robot, x.robot);
}

template <class T>
Trig<T> Junction::directions_dot(const Feature& x, const Feature& y) const {
    const auto E = direction<T>(x), F = direction<T>(y);
    if (x.kind == y.kind) return {dot(E, F), T{}, T{}};
    if (is_on_edge(x)) return {T{}, -dot(E, F), cross(E, F)};  // E . -R F
    return {T{}, -dot(E, F), -cross(E, F)};                    // -R E . F
}

template <class T>
Trig<T> Junction::directions_cross(const Feature& x, const Feature& y) const {
    const auto E = direction<T>(x), F = direction<T>(y);
    if (x.kind == y.kind) return {cross(E, F), T{}, T{}};
    if (is_on_edge(x)) return {T{}, -cross(E, F), -dot(E, F)};  // E x -R F
    return {T{}, -cross(E, F), dot(E, F)};                      // -R E x F
}

int Junction::turn(const Feature& x, const Feature& y) {
    if (x.kind == y.kind) return turn_of_kind(x, y);
    const auto name = is_on_edge(x) ? parallels(y.robot, x.obstacle) : parallels(x.robot, y.obstacle);
    if (known.contains(name)) return 0;
    const int found = sign([&](auto T) { return directions_cross<decltype(T)>(x, y); });
    if (found == 0) know(name);
    return found;
}

int Junction::turn_of_kind(const Feature& x, const Feature& y) {
    const bool of_obstacles = is_on_edge(x);
    const Shape& shape = of_obstacles ? scene.obstacles : scene.robot;
    const Index e = of_obstacles ? x.obstacle : x.robot, f = of_obstacles ? y.obstacle : y.robot;
    return shape.direction[e] == shape.direction[f] ? 0 : on_any.cross_sign(shape, e, f);
}

int Junction::parallel(const Feature& x, const Feature& y) {
    if (turn(x, y) != 0) return 0;
    return sign([&](auto T) { return directions_dot<decltype(T)>(x, y); });
}

int Junction::side(const Feature& x, const Feature& y) {
    if (code(scene, x) == code(scene, y)) return 0;
    if (are_one_line(x, y)) return 0;
    const Feature start = end_helix(scene, y, 0);
    const Index a = start.robot, b = start.obstacle;
    const int found = side(x, a, b);
    if (found != 0) return found;
    const auto on_x = helices(x), on_y = helices(y);
    for (const int k : {0, 1}) know_meeting(x, on_y[k]), know_meeting(y, on_x[k]);
    return 0;
}

void Junction::know_meeting(const Feature& surface, Code helix) {
    const Code own = code(scene, surface);
    know({0, std::min(own, helix), std::max(own, helix)});
}

std::array<Code, 2> Junction::helices(const Feature& f) const {
    if (f.kind == Kind::vertex_vertex) return {code(scene, f), code(scene, f)};
    return {code(scene, end_helix(scene, f, 0)), code(scene, end_helix(scene, f, 1))};
}

// True if a helix is known to be on a surface here.
bool Junction::meets(const Feature& surface, Code helix) const {
    const auto ends = helices(surface);
    if (helix == ends[0] || helix == ends[1]) return true;
    const Code own = code(scene, surface);
    return known.contains({0, std::min(own, helix), std::max(own, helix)});
}

// True if two surfaces are known to have one line here.
bool Junction::are_one_line(const Feature& x, const Feature& y) {
    const Feature &on_edge = is_on_edge(x) ? x : y, &of_edge = is_on_edge(x) ? y : x;
    if (x.kind == y.kind ? turn_of_kind(x, y) != 0 : !known.contains(parallels(of_edge.robot, on_edge.obstacle))) return false;
    const auto on_x = helices(x), on_y = helices(y);
    return meets(x, on_y[0]) || meets(x, on_y[1]) || meets(y, on_x[0]) || meets(y, on_x[1]);
}

std::array<Code, 3> Junction::parallels(Index g, Index f) const { return {0, 0, code(scene, {Kind::edge_edge, g, f})}; }

// Surfaces of the ends of two parallel edges have one line, and all helices of these ends are on it.
void Junction::know_parallel(Index g, Index f) {
    constexpr Code pair_of_edges = 1;  // no feature has it
    if (!known.insert({pair_of_edges, static_cast<Code>(g), static_cast<Code>(f)})) return;
    know(parallels(g, f));
    const Shape &A = scene.robot, &O = scene.obstacles;
    const auto [a, b] = std::array{A.v[g], A.w[g]};
    const auto [v, w] = std::array{O.v[f], O.w[f]};
    const auto helix = [&](Index of_robot, Index of_obstacles) { return code(scene, {Kind::vertex_vertex, of_robot, of_obstacles}); };
    for (const Index end : {v, w}) {
        know_meeting({Kind::vertex_edge, a, f}, helix(b, end)), know_meeting({Kind::vertex_edge, b, f}, helix(a, end));
    }
    for (const Index end : {a, b}) {
        know_meeting({Kind::edge_vertex, g, v}, helix(end, w)), know_meeting({Kind::edge_vertex, g, w}, helix(end, v));
    }
}

Interval Junction::offset(const Feature& x, const Feature& y) const {
    const Feature start = end_helix(scene, y, 0);
    const Index a = start.robot, b = start.obstacle;
    return range(filtered(Predicates::offset_trig<Approx>(scene, x, a, b)));
}

int Junction::side(const Feature& x, Index a, Index b) {
    return sign([&](auto T) { return Predicates::offset_trig<decltype(T)>(scene, x, a, b); });
}

Spot Junction::spot(const Feature& surface, const Feature& curve) const {
    Spot result{curve, code(scene, curve), surface};
    if (curve.kind == Kind::vertex_vertex) return result;
    if (sign([&](auto T) { return Predicates::curve_trig<decltype(T)>(scene, surface, curve)[1]; }) != 0) return result;
    // t = N / D, both zero here: either t is constant, or their common root is rational and t = N' / D' there
    Int n, d;
    const auto [N, D] = Predicates::curve_trig<Int>(scene, surface, curve);
    const Poly p = polynomial(N), q = polynomial(D);
    const auto at = [](const Poly& f, int k) { return k < f.size() ? f[k] : Int(0); };
    const auto minor = [&](int k, int l) -> Int { return at(p, k) * at(q, l) - at(p, l) * at(q, k); };
    if (minor(0, 1).is_zero() && minor(0, 2).is_zero() && minor(1, 2).is_zero()) {
        if (q.empty()) throw std::logic_error("a curve on a surface parallel to it");
        n = at(p, q.size() - 1), d = q.back();
    } else {
        const Int c0 = minor(0, 2), c1 = minor(1, 2);  // (p q2 - q p2) is linear
        // p and q without it are linear, with the one root of either
        const Poly& linear = q.size() == 2 ? q : p;
        const Int r0 = c1.is_zero() ? at(linear, 0) : c0, r1 = c1.is_zero() ? at(linear, 1) : c1;
        n = at(p, 1) * r1 - 2 * at(p, 2) * r0, d = at(q, 1) * r1 - 2 * at(q, 2) * r0;
    }
    if (d.is_zero()) throw std::logic_error("a curve has no end");
    result.given = std::make_shared<const Spot::Place>(Spot::Place{n, d});
    return result;
}

template <class T>
std::array<Trig<T>, 2> Junction::position(const Feature& line, const Spot& p) const {
    if constexpr (!std::is_same_v<T, Approx>) {
        if (p.given) {
            const T n = number<T>(p.given->n), d = number<T>(p.given->d);
            const Feature start = end_helix(scene, p.on, 0);
            const Index a = start.robot, b = start.obstacle;
            const Trig<T> N = sum(times(d, along<T>(line, a, b)), times(n, directions_dot<T>(line, p.on)));
            return {N, times(d, directions_dot<T>(line, line))};
        }
    }
    if (p.curve.kind != Kind::vertex_vertex) return Predicates::curve_trig<T>(scene, line, p.curve);
    return {along<T>(line, p.curve.robot, p.curve.obstacle), directions_dot<T>(line, line)};
}

// Range of N / D over the ranges of both.
Junction::Reading Junction::reading(const Feature& line, const Spot& p) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Reading result{{-infinity, infinity}, {}};
    if (p.given) return result;
    const auto [N, D] = position<Approx>(line, p);
    const Filtered in_n = filtered(N), in_d = filtered(D);
    const Interval n = range(in_n), d = range(in_d);
    if ((d.lo > 0 || d.hi < 0) && std::isfinite(n.hi - n.lo + d.hi - d.lo)) {
        const double a = n.lo / d.lo, b = n.lo / d.hi, c = n.hi / d.lo, e = n.hi / d.hi;
        result.t = widened(std::min({a, b, c, e}), std::max({a, b, c, e}));
    }
    const double tau = 0.5 * (lo + hi), at = in_d.polar(tau, tau), t = in_n.polar(tau, tau) / at;
    if (in_n.err + std::abs(t) * in_d.err < 0x1p-32 * std::abs(at)) result.near = t;
    return result;
}

double Junction::value(const Feature& line, const Spot& p) const {
    if (const auto near = reading(line, p).near) return *near;
    // a ratio of integers at an end of an interval, once it is nearly that on all of it: equal ends are not enough
    const auto [N, D] = position<Int>(line, p);
    const Poly n = polynomial(N), d = polynomial(D);
    const auto at = [](const Poly& f, const Dyadic& tau) {
        Int value = 0;
        for (int k = f.size(); k-- > 0;) value = value * tau.n + (f[k] << (tau.k * static_cast<unsigned>(2 - k)));
        return value;
    };
    for (RealRoot near = exact();; near.narrow()) {  // a fresh root: the same double each time
        const int sign = sign_on(d, near.lo, near.hi);
        const double t = sign == 0 ? 0 : ratio(at(n, near.lo), at(d, near.lo)), most = 0x1p-40 * (1 + std::abs(t));
        const auto side_of = [&](double bound) {
            const Dyadic x = Dyadic::from(bound);
            return sign * sign_on(difference(product({Int(1) << x.k}, n), product({x.n}, d)), near.lo, near.hi);
        };
        if (sign != 0 && std::isfinite(t) && side_of(t - most) > 0 && side_of(t + most) < 0) return t;
        if (near.is_dyadic() || near.digits() >> 15 != 0) throw std::logic_error("a place is at infinity");
    }
}

// True if the features known to meet here prove two places equal: the two curves and the line's surface, a helix and the
// other curve, or a helix through which both curves pass and that surface.
bool Junction::is_known(const Feature& line, const Spot& p, const Spot& q) {
    std::array<Code, 3> name{code(scene, line), p.code, q.code};
    std::sort(name.begin(), name.end());
    if (known.contains(name)) return true;
    const bool p_is_helix = p.curve.kind == Kind::vertex_vertex, q_is_helix = q.curve.kind == Kind::vertex_vertex;
    if (p_is_helix != q_is_helix) return p_is_helix ? meets(q.curve, p.code) : meets(p.curve, q.code);
    if (!p_is_helix && are_one_line(p.curve, q.curve)) return true;
    for (const Code x : helices(p.curve))
        for (const Code y : helices(q.curve))
            if (x == y && meets(line, x)) return true;
    return false;
}

// A tie is stored by the features that meet in that point: the line's surface and the two curves, each a surface or a helix.
// Neither surface's line is parallel to this one, so all three meet there and nowhere else, in later queries for any of them.
int Junction::order(const Feature& line, const Spot& p, const Spot& q) {
    if (!p.given && !q.given) {
        if (p.code == q.code) return 0;
        const auto [Np, Dp] = position<Approx>(line, p);
        const auto [Nq, Dq] = position<Approx>(line, q);
        const Predicates::Form form{{4, filtered(Np), filtered(Dq), filtered(Nq), filtered(Dp)}};
        const int signs = Predicates::sign_on(form.q, lo, hi) * Predicates::sign_on(form.s, lo, hi);
        if (const int s = form.sign_on(lo, hi); signs * s != 0) return signs * s;
        if (is_known(line, p, q)) return 0;
    }
    const int found = order_exactly(line, p, q);
    if (found == 0 && !p.given && !q.given && p.code != 0 && q.code != 0) {
        std::array<Code, 3> name{code(scene, line), p.code, q.code};
        std::sort(name.begin(), name.end());
        know(name);
    }
    return found;
}

int Junction::order_exactly(const Feature& line, const Spot& p, const Spot& q) {
    const auto found = by_balls([&](const Ball& tau) -> std::optional<int> {
        const auto [Np, Dp] = position<Ball>(line, p);
        const auto [Nq, Dq] = position<Ball>(line, q);
        const auto at = [&](const Trig<Ball>& f) { return value_at(on_any.coefficients(f), tau); };
        const Ball dp = at(Dp), dq = at(Dq);
        const auto s = certain_sign(at(Np) * dq - at(Nq) * dp), of_p = certain_sign(dp), of_q = certain_sign(dq);
        if (s && of_p && of_q) return *s * *of_p * *of_q;
        return {};
    });
    if (found) return *found;
    const auto [Np, Dp] = position<Int>(line, p);
    const auto [Nq, Dq] = position<Int>(line, q);
    const Poly np = polynomial(Np), dp = polynomial(Dp), nq = polynomial(Nq), dq = polynomial(Dq);
    return sign_at(difference(product(np, dq), product(nq, dp)), here()) * sign_at(dp, here()) * sign_at(dq, here());
}

int Junction::side(const Feature& x, const Feature& line, const Spot& p) {
    // U_x x (P + t U - P_x) = offset of the line's start + t U_x x U, with t = N / D
    const Feature start = end_helix(scene, line, 0);
    const Index a = start.robot, b = start.obstacle;
    if (!p.given) {
        const auto [N, D] = position<Approx>(line, p);
        const Predicates::Form form{{4, filtered(Predicates::offset_trig<Approx>(scene, x, a, b)), filtered(D), filtered(N),
                                    -filtered(directions_cross<Approx>(x, line))}};
        if (const int s = form.sign_on(lo, hi) * Predicates::sign_on(form.q, lo, hi); s != 0) return s;
    }
    const auto found = by_balls([&](const Ball& tau) -> std::optional<int> {
        const auto [N, D] = position<Ball>(line, p);
        const auto at = [&](const Trig<Ball>& f) { return value_at(on_any.coefficients(f), tau); };
        const Ball d = at(D), offset = at(Predicates::offset_trig<Ball>(scene, x, a, b)) * d;
        const auto s = certain_sign(offset + at(N) * at(directions_cross<Ball>(x, line))), of_d = certain_sign(d);
        if (s && of_d) return *s * *of_d;
        return {};
    });
    if (found) return *found;
    const auto [N, D] = position<Int>(line, p);
    const Poly d = polynomial(D), offset = product(polynomial(Predicates::offset_trig<Int>(scene, x, a, b)), d);
    const Poly along_it = product(polynomial(N), polynomial(times(Int(-1), directions_cross<Int>(x, line))));
    return sign_at(difference(offset, along_it), here()) * sign_at(d, here());
}

// A double on the line of a surface between two places, if doubles distinguish them.
std::optional<double> Junction::between(const Feature& line, const Spot& p, const Spot& q) const {
    const Interval first = reading(line, p).t, last = reading(line, q).t;
    const double low = std::min(first.hi, last.hi), high = std::max(first.lo, last.lo), middle = 0.5 * (low + high);
    return low < middle && middle < high ? std::optional(middle) : std::nullopt;
}

int Junction::across(const Feature& x, const Feature& y, const Spot& p, const Spot& q, bool after) {
    const Feature start = end_helix(scene, x, 0);
    const Index a = start.robot, b = start.obstacle;
    if (const auto t = between(x, p, q)) {  // the side of y on which that place of x is, from its slope: here it is zero
        const auto turned = times(Approx{*t, std::abs(*t)}, directions_cross<Approx>(y, x));
        const Filtered g = filtered(sum(Predicates::offset_trig<Approx>(scene, y, a, b), turned));
        const double from = (g.a - g.b) * lo + g.c, to = (g.a - g.b) * hi + g.c;  // half of it, by tau
        if (std::min(from, to) > g.err) return after ? 1 : -1;
        if (std::max(from, to) < -g.err) return after ? -1 : 1;
    }
    // a rational place on x between the two
    const bool upwards = order(x, p, q) < 0;
    const Spot &first = upwards ? p : q, &last = upwards ? q : p;
    Int n, d = 1;
    for (Int low = 0, high = 1;;) {  // over d
        n = low + high, d *= 2, low *= 2, high *= 2;
        const Spot at{x, 0, x, std::make_shared<const Spot::Place>(Spot::Place{n, d})};
        const bool above = order(x, first, at) < 0, below = order(x, at, last) < 0;
        if (above && below) break;
        (above ? high : low) = n;
    }
    const Trig<Int> g = sum(times(d, Predicates::offset_trig<Int>(scene, y, a, b)), times(n, directions_cross<Int>(y, x)));
    const Poly offset = polynomial(g);
    if (offset.empty()) return 0;
    return after ? sign_after(offset, here()) : sign_before(offset, here());
}

}  // namespace cfree
