// Contact lines at one critical angle: the same line, the order along it and around it; theory, "Closed surfaces".
#include "cfree/predicates/junction.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "predicates/form.hpp"

namespace cfree {

namespace {

bool is_on_edge(const Feature& x) { return x.kind == Kind::vertex_edge; }

template <class T>
Trig<T> times(const T& k, const Trig<T>& f) { return {k * f.a, k * f.b, k * f.c}; }
template <class T>
Trig<T> sum(const Trig<T>& f, const Trig<T>& g) { return {f.a + g.a, f.b + g.b, f.c + g.c}; }

}  // namespace

Junction::Junction(const Scene& s, int in, double from, double to, std::function<RealRoot()> number)
    : scene(s), chart(in), lo(from), hi(to), exact(std::move(number)) {}

Poly Junction::polynomial(const Trig<Int>& f) const { return on({}).polynomial(f); }
Filtered Junction::filtered(const Trig<Approx>& f) const { return on({}).filtered(f); }

// Sign at the angle of a trigonometric form given for every number type.
template <class F>
int Junction::sign(const F& trig) const {
    if (const int s = Predicates::sign_on(filtered(trig(Approx{})), lo, hi); s != 0) return s;
    return sign_at(polynomial(trig(Int{})), here());
}

RealRoot& Junction::here() const {
    if (!root) root = exact();
    return *root;
}

// The surface's line is P + t U, U = E_j or -R E_i.
template <class T>
Trig<T> Junction::along(const Feature& x, Index a, Index b) const {
    const auto [kind, a0, b0] = end_helix(scene, x, 0);
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

int Junction::parallel(const Feature& x, const Feature& y) {
    if (x.kind == y.kind) {
        const bool same = is_on_edge(x) ? scene.obstacles.direction[x.obstacle] == scene.obstacles.direction[y.obstacle]
                                        : scene.robot.direction[x.robot] == scene.robot.direction[y.robot];
        if (!same) return 0;
    } else if (sign([&](auto T) { return directions_cross<decltype(T)>(x, y); }) != 0) {
        return 0;
    }
    return sign([&](auto T) { return directions_dot<decltype(T)>(x, y); });
}

int Junction::side(const Feature& x, const Feature& y) {
    if (code(scene, x) == code(scene, y)) return 0;
    const auto [kind, a, b] = end_helix(scene, y, 0);
    return side(x, a, b);
}

int Junction::side(const Feature& x, Index a, Index b) {
    return sign([&](auto T) { return on(x).offset_trig<decltype(T)>(a, b); });
}

Spot Junction::spot(const Feature& surface, const Feature& curve) const {
    Spot result{curve, code(scene, curve), false, surface, 0, 1};
    if (curve.kind == Kind::vertex_vertex) return result;
    if (sign([&](auto T) { return on(surface).curve_trig<decltype(T)>(curve)[1]; }) != 0) return result;
    // t = N / D, both zero here: either t is constant, or their common root is rational and t = N' / D' there
    result.is_given = true;
    const auto [N, D] = on(surface).curve_trig<Int>(curve);
    const Poly p = polynomial(N), q = polynomial(D);
    const auto at = [](const Poly& f, int k) { return k < f.size() ? f[k] : Int(0); };
    const auto minor = [&](int k, int l) -> Int { return at(p, k) * at(q, l) - at(p, l) * at(q, k); };
    if (minor(0, 1).is_zero() && minor(0, 2).is_zero() && minor(1, 2).is_zero()) {
        if (q.empty()) throw std::logic_error("a curve on a surface parallel to it");
        result.n = at(p, q.size() - 1), result.d = q.back();
    } else {
        const Int c0 = minor(0, 2), c1 = minor(1, 2);  // (p q2 - q p2) is linear
        // without it p and q are linear, with the one root of either
        const Poly& linear = q.size() == 2 ? q : p;
        const Int r0 = c1.is_zero() ? at(linear, 0) : c0, r1 = c1.is_zero() ? at(linear, 1) : c1;
        result.n = at(p, 1) * r1 - 2 * at(p, 2) * r0, result.d = at(q, 1) * r1 - 2 * at(q, 2) * r0;
    }
    if (result.d.is_zero()) throw std::logic_error("a curve has no end");
    return result;
}

template <class T>
std::array<Trig<T>, 2> Junction::position(const Feature& line, const Spot& p) const {
    if constexpr (std::is_same_v<T, Int>) {
        if (p.is_given) {
            const auto [kind, a, b] = end_helix(scene, p.on, 0);
            const Trig<Int> N = sum(times(p.d, along<Int>(line, a, b)), times(p.n, directions_dot<Int>(line, p.on)));
            return {N, times(p.d, directions_dot<Int>(line, line))};
        }
    }
    if (p.curve.kind != Kind::vertex_vertex) return on(line).curve_trig<T>(p.curve);
    return {along<T>(line, p.curve.robot, p.curve.obstacle), directions_dot<T>(line, line)};
}

double Junction::value(const Feature& line, const Spot& p) const {
    if (!p.is_given) {
        const auto [N, D] = position<Approx>(line, p);
        const double tau = 0.5 * (lo + hi), d = filtered(D).polar(tau, tau), t = filtered(N).polar(tau, tau) / d;
        if (filtered(N).err + std::abs(t) * filtered(D).err < 0x1p-32 * std::abs(d)) return t;
    }
    // as a ratio of integers at an end of an interval, once it is nearly that on all of it: equal ends are not enough
    const auto [N, D] = position<Int>(line, p);
    const Poly n = polynomial(N), d = polynomial(D);
    const auto at = [](const Poly& f, const Dyadic& tau) {
        Int value = 0;
        for (int k = f.size(); k-- > 0;) value = value * tau.n + (f[k] << (tau.k * static_cast<unsigned>(2 - k)));
        return value;
    };
    for (RealRoot near = here();; near.narrow()) {
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

// Whether what is known to meet here says that two places are one: the two curves and the line's surface, or a helix that both
// curves pass through and that surface.
bool Junction::is_known(const Feature& line, const Spot& p, const Spot& q) const {
    const auto knows = [&](Code x, Code y, Code z) {
        std::array<Code, 3> name{x, y, z};
        std::sort(name.begin(), name.end());
        return known.contains(name);
    };
    const Code own = code(scene, line);
    if (knows(own, p.code, q.code) || knows(p.code, q.code, 0)) return true;
    const auto helices = [&](const Feature& f) -> std::array<Code, 2> {
        if (f.kind == Kind::vertex_vertex) return {code(scene, f), code(scene, f)};
        return {code(scene, end_helix(scene, f, 0)), code(scene, end_helix(scene, f, 1))};
    };
    for (const Code x : helices(p.curve))
        for (const Code y : helices(q.curve))
            if (x == y && knows(own, x, 0)) return true;
    return false;
}

int Junction::order(const Feature& line, const Spot& p, const Spot& q) {
    if (!p.is_given && !q.is_given) {
        if (p.code == q.code) return 0;
        const auto [Np, Dp] = position<Approx>(line, p);
        const auto [Nq, Dq] = position<Approx>(line, q);
        const Predicates::Form form{{4, filtered(Np), filtered(Dq), filtered(Nq), filtered(Dp)}};
        const int signs = Predicates::sign_on(form.q, lo, hi) * Predicates::sign_on(form.s, lo, hi);
        if (const int s = form.sign_on(lo, hi); signs * s != 0) return signs * s;
        if (is_known(line, p, q)) return 0;
    }
    const auto [Np, Dp] = position<Int>(line, p);
    const auto [Nq, Dq] = position<Int>(line, q);
    const Poly np = polynomial(Np), dp = polynomial(Dp), nq = polynomial(Nq), dq = polynomial(Dq);
    return sign_at(difference(product(np, dq), product(nq, dp)), here()) * sign_at(dp, here()) * sign_at(dq, here());
}

int Junction::side(const Feature& x, const Feature& line, const Spot& p) {
    // U_x x (P + t U - P_x) = offset of the line's start + t U_x x U, with t = N / D
    const auto [kind, a, b] = end_helix(scene, line, 0);
    if (!p.is_given) {
        const auto [N, D] = position<Approx>(line, p);
        const Predicates::Form form{{4, filtered(on(x).offset_trig<Approx>(a, b)), filtered(D), filtered(N),
                                    -filtered(directions_cross<Approx>(x, line))}};
        if (const int s = form.sign_on(lo, hi) * Predicates::sign_on(form.q, lo, hi); s != 0) return s;
    }
    const auto [N, D] = position<Int>(line, p);
    const Poly d = polynomial(D), offset = product(polynomial(on(x).offset_trig<Int>(a, b)), d);
    const Poly along_it = product(polynomial(N), polynomial(times(Int(-1), directions_cross<Int>(x, line))));
    return sign_at(difference(offset, along_it), here()) * sign_at(d, here());
}

int Junction::across(const Feature& x, const Feature& y, const Spot& p, const Spot& q, bool after) {
    // a rational place on x between the two
    const bool upwards = order(x, p, q) < 0;
    const Spot &first = upwards ? p : q, &last = upwards ? q : p;
    Spot at{x, 0, true, x, 0, 1};
    for (Int low = 0, high = 1;;) {  // over the denominator at.d
        at.n = low + high, at.d *= 2, low *= 2, high *= 2;
        const bool above = order(x, first, at) < 0, below = order(x, at, last) < 0;
        if (above && below) break;
        (above ? high : low) = at.n;
    }
    const auto [kind, a, b] = end_helix(scene, x, 0);
    const Trig<Int> g = sum(times(at.d, on(y).offset_trig<Int>(a, b)), times(at.n, directions_cross<Int>(y, x)));
    const Poly offset = polynomial(g);
    if (offset.empty()) return 0;
    return after ? sign_after(offset, here()) : sign_before(offset, here());
}

}  // namespace cfree
