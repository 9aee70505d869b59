// Signs of the quadratics: offsets, parallels, curves; theory, "Degrees".
#include "predicates/close_angles.hpp"
#include "predicates/form.hpp"
#include "predicates/round_orders.hpp"

namespace cfree {

// --- the quadratics, one formula for every number type ---------------------------------------------------------------

// The half-plane of a pillar's edge, with direction V and point Q, cuts the surface's line P + t U, P = b_j - R a_i. There
// V x (P - Q) + t (V x U) = 0. So t = N / D with N = -V x (P - Q) and D = V x U.
template <class T>
std::array<Trig<T>, 2> Predicates::curve_trig(const Scene& scene, const Feature& contact, const Feature& f) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const bool on_edge = contact.kind == Kind::vertex_edge;
    const Index i = contact.robot, j = contact.obstacle;
    const Index a0 = on_edge ? i : A.v[i], b0 = on_edge ? O.v[j] : j;
    const auto E = on_edge ? edge<T>(O, j) : edge<T>(A, i);
    if (f.kind == Kind::vertex_vertex) {  // t is the place of the vertex on the edge
        const auto w = on_edge ? difference<T>(O, f.obstacle, b0) : difference<T>(A, f.robot, a0);
        return {Trig<T>{dot(w, E), T{}, T{}}, Trig<T>{dot(E, E), T{}, T{}}};
    }
    if (f.kind == Kind::vertex_edge) {  // V = F, Q = b_f - R a_s
        const auto F = edge<T>(O, f.obstacle), w = difference<T>(O, O.v[f.obstacle], b0), d = difference<T>(A, a0, f.robot);
        const Trig<T> N{cross(F, w), cross(F, d), dot(F, d)};
        if (on_edge) return {N, Trig<T>{cross(F, E), T{}, T{}}};
        return {N, Trig<T>{T{}, -cross(F, E), -dot(F, E)}};
    }
    // V = -R G, Q = b_v - R a_g
    const auto G = edge<T>(A, f.robot), w = difference<T>(O, b0, f.obstacle), d = difference<T>(A, A.v[f.robot], a0);
    const Trig<T> N{cross(G, d), cross(G, w), -dot(G, w)};
    if (on_edge) return {N, Trig<T>{T{}, -cross(G, E), dot(G, E)}};
    return {N, Trig<T>{cross(G, E), T{}, T{}}};
}

Curve Predicates::curve(const Feature& f) const {
    if (scene.is_round) return {f, code(scene, f), false, false, false, {}, {}};
    const auto [N, D] = curve_trig<Approx>(scene, surface.contact, f);
    const bool constant = f.kind == Kind::vertex_vertex;
    return {f, code(scene, f), constant, constant || f.kind == surface.contact.kind, false, filtered(N), filtered(D)};
}

template Trig<Ball> Predicates::offset_trig(const Scene&, const Feature&, Index, Index);
template Trig<Int> Predicates::offset_trig(const Scene&, const Feature&, Index, Index);
template std::array<Trig<Ball>, 2> Predicates::curve_trig(const Scene&, const Feature&, const Feature&);
template std::array<Trig<Int>, 2> Predicates::curve_trig(const Scene&, const Feature&, const Feature&);
template std::array<Trig<Approx>, 2> Predicates::curve_trig(const Scene&, const Feature&, const Feature&);

Predicates::Form Predicates::form(const Curve& p, const Curve& q) const {
    return {terms<Filtered>({p.constant, p.constant_D}, p.N, p.D, {q.constant, q.constant_D}, q.N, q.D)};
}

Predicates::Form Predicates::form(const Event& x) const {
    if (x.second.kind != Kind::none) return form(curve(x.first), curve(x.second));
    if (x.first.kind == Kind::edge_edge) return {{2, parallel(x.first.robot, x.first.obstacle), {}, {}, {}}};
    return {{2, offset(x.first.robot, x.first.obstacle), {}, {}, {}}};
}

bool Predicates::turns_parallel(bool robot, Index v, Index w, Index e, double lo, double hi) const {
    const auto chord = difference<Approx>(robot ? scene.robot : scene.obstacles, w, v);
    const auto along = edge<Approx>(robot ? scene.obstacles : scene.robot, e);
    const Form f{{2, filtered(robot ? parallel_trig(chord, along) : parallel_trig(along, chord)), {}, {}, {}}};
    return f.sign(lo) * f.sign(hi) < 0;
}

// --- signs -----------------------------------------------------------------------------------------------------------

template <class T>
Coefficients<T> Predicates::coefficients(const Trig<T>& f) const {
    const auto [x, y, z] = quadratic(f, kappa);
    return {{x, y, z}, 3};
}

template <class T>
Coefficients<T> Predicates::coefficients(const Feature& first, const Feature& second) const {
    if constexpr (!std::is_same_v<T, Ball>) return computed<T>(first, second);
    else {
        constexpr std::size_t most = 512;  // most surfaces ask for few
        const auto place = [&] { return spread(mixed(first) * 3 + mixed(second)) & (polynomials.size() - 1); };
        if (polynomials.empty()) polynomials.resize(1);
        if (const Known& at = polynomials[place()]; at.first == first && at.second == second) return at.p;
        if (++unknown > 4 * polynomials.size() && polynomials.size() < most) polynomials.assign(8 * polynomials.size(), {}), unknown = 0;
        const auto p = scene.is_round ? round_orders().in_balls(first, second) : computed<Ball>(first, second);
        polynomials[place()] = {first, second, p};
        return p;
    }
}

template <class T>
Coefficients<T> Predicates::computed(const Feature& first, const Feature& second) const {
    if (second.kind == Kind::none) {
        if (first.kind == Kind::edge_edge) return coefficients(parallel_trig<T>(first.robot, first.obstacle));
        return coefficients(offset_trig<T>(scene, surface.contact, first.robot, first.obstacle));
    }
    const auto constants = [&](const Feature& f) {
        const bool constant = f.kind == Kind::vertex_vertex;
        return Constants{constant, constant || f.kind == surface.contact.kind};
    };
    const auto [N1, D1] = curve_trig<T>(scene, surface.contact, first);
    const auto [N2, D2] = curve_trig<T>(scene, surface.contact, second);
    const auto all = terms<Trig<T>>(constants(first), N1, D1, constants(second), N2, D2);
    if (all.degree == 2) return coefficients(all.p);
    const auto p = coefficients(all.p), q = coefficients(all.q), r = coefficients(all.r), s = coefficients(all.s);
    Coefficients<T> result{{}, 5};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result.c[i + j] = result.c[i + j] + (p.c[i] * q.c[j] - r.c[i] * s.c[j]);
    return result;
}
template Coefficients<Int> Predicates::coefficients(const Trig<Int>&) const;
template Coefficients<Ball> Predicates::coefficients(const Trig<Ball>&) const;
template Coefficients<Ball> Predicates::coefficients(const Feature&, const Feature&) const;
template Coefficients<Int> Predicates::coefficients(const Feature&, const Feature&) const;

Poly Predicates::polynomial(const Feature& first, const Feature& second) const {
    return Poly(coefficients<Int>(first, second));
}

int Predicates::sign_at(double value, double err, const Feature& first, const Feature& second, const Sample& at) {
    if (double_only || (!at.fine && std::abs(value) > err)) return ++counters.filter, (value > 0) - (value < 0);
    return settled(counters, [&]<class T>() -> std::optional<int> {
        const auto p = coefficients<T>(first, second);
        if constexpr (std::is_same_v<T, Ball>) return cfree::sign_at(p, at.ball());
        else return cfree::sign_at(Poly(p), at.exact());
    });
}
int Predicates::offset_sign(Index s, Index v, const Filtered& f, const Sample& at) {
    return sign_at(f.polar(at.tau, at.tau), f.err, {Kind::vertex_vertex, s, v}, {}, at);
}
int Predicates::parallel_sign(Index g, Index f, const Filtered& value, const Sample& at) {
    return sign_at(value.polar(at.tau, at.tau), value.err, {Kind::edge_edge, g, f}, {}, at);
}

// Let f have the Bernstein coefficients c_0, c_1, c_2 on the interval, and c_1, c_2 > 0: f has at most one root there, and only if
// c_0 <= 0. So a root that is known at the lower end is the only one. With roots at both ends, c_1 > 0 is enough.
int Predicates::sign_between(const Filtered& f, double lo, double hi, bool root_at_lo, bool root_at_hi) {
    const auto has = [&](int sign, double c) { return sign * c > f.err; };
    const double middle = f.polar(lo, hi);
    for (const int sign : {1, -1})
        if (has(sign, middle) && (root_at_lo || has(sign, f.polar(lo, lo))) && (root_at_hi || has(sign, f.polar(hi, hi)))) return sign;
    return 0;
}

int Predicates::order_on(const Curve& p, const Curve& q, double lo, double hi) const {
    const int signs = sign_on(p.D, lo, hi) * sign_on(q.D, lo, hi);
    return signs == 0 ? 0 : signs * form(p, q).sign_on(lo, hi);
}

int Predicates::order_at(const Feature& p, const Feature& q, const Sample& at) const {
    if (!double_only && !at.fine) {
        const Curve x = curve(p), y = curve(q);
        const int sign = form(x, y).sign(at.tau), first = sign_on(x.D, at.tau, at.tau), second = sign_on(y.D, at.tau, at.tau);
        if (sign * first * second != 0) return sign * first * second;
    }
    return cfree::sign_at(polynomial(p, q), at.exact()) * denominator_sign(p, at) * denominator_sign(q, at);
}

int Predicates::denominator_sign(const Feature& f, const Sample& at) const {
    return cfree::sign_at(polynomial(curve_trig<Int>(scene, surface.contact, f)[1]), at.exact());
}

int Predicates::cross_sign(const Shape& shape, Index e, Index f) {
    if (shape.direction[e] == shape.direction[f]) return ++counters.identity, 0;
    const Approx value = cross(edge<Approx>(shape, e), edge<Approx>(shape, f));
    if (double_only || std::abs(value.v) > coefficient_error * value.m + tiny)
        return ++counters.filter, (value.v > 0) - (value.v < 0);
    return settled(counters, [&]<class T>() { return certain_sign(cross(edge<T>(shape, e), edge<T>(shape, f))); });
}

}  // namespace cfree
