// Contact surfaces of grown shapes at one orientation, which are lines and circles of the plane, and the polynomials of their
// meetings; theory, "Rounded shapes".
//
// Features of radii r and s touch, with rho = r + s, where the robot's position x satisfies
//     v-e, e-v:  V x (x - Q) + rho |V| = 0,    V an edge F of the obstacles or -R G, Q = b - R a at its start,
//     v-v:       |x - C| = rho,                C = b - R a.
// Inside of the pillar is left of the line and inside the circle.
//
// From the centre of a circle of radius rho, u a unit vector, C + rho u is inside another surface where rho n . u > delta. They
// meet at
//     rho |n|^2 u = delta n + b sqrt(rho^2 |n|^2 - delta^2) J n,     b = -1 where the circle enters, b = 1 where it leaves,
// counter-clockwise. Along the line P + t U + rho nu, nu the outward normal, a line is met at t = N / D and a circle at
//     t |U|^2 = B + b sqrt(sigma^2 |U|^2 - M^2),      b = -1 where the line enters, b = 1 where it leaves.
// A line is smooth with a circle if they are contacts of an edge and of its end: they touch at every orientation, in a joint. At
// the end of an arc two circles have one joint with a line: that about the arc's centre, and that about its end.
//
// A concave arc has a negative radius, and so has its circle with a vertex, if that is not as large: u is the outward normal of the
// shapes, and points from C + rho u to the centre. All of the above holds; inside of the circle is free.
#pragma once
#include <optional>

#include "cfree/scene/lengths.hpp"
#include "predicates/moving_vector.hpp"

namespace cfree {

// Point b - R a for vertices of the two shapes.
struct Site {
    Index robot, obstacle;
};

inline bool is_line(const Feature& f) { return f.kind == Kind::vertex_edge || f.kind == Kind::edge_vertex; }
inline bool is_circle(const Feature& f) { return f.kind == Kind::vertex_vertex; }
inline bool is_center(const Feature& f) { return is_circle(f) && f.branch == 2; }  // as the second feature of an event

// End of an edge, 0 or 1, where its line touches a vertex's circle; -1 if that is at none.
inline int end_at(const Shape& s, Index e, Index vertex) {
    const Index p = s.point[vertex];
    if (p == s.point[s.v[e]]) return 0;
    if (s.first.empty()) return p == s.point[s.w[e]] ? 1 : -1;
    if (p == s.point[s.first[e]]) return 0;
    if (s.stub[e]) return p == s.point[s.last[e]] ? 0 : -1;
    return p == s.point[s.w[e]] || p == s.point[s.last[e]] ? 1 : -1;
}

// End of a line, 0 or 1, at which a circle is smooth with it; -1 if it is not.
inline int smooth_end(const Scene& scene, const Feature& line, const Feature& circle) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    if (!is_line(line) || !is_circle(circle)) return -1;
    if (line.kind == Kind::vertex_edge)
        return A.point[line.robot] == A.point[circle.robot] ? end_at(O, line.obstacle, circle.obstacle) : -1;
    return O.point[line.obstacle] == O.point[circle.obstacle] ? end_at(A, line.robot, circle.robot) : -1;
}
inline bool is_smooth(const Scene& scene, const Feature& line, const Feature& circle) { return smooth_end(scene, line, circle) >= 0; }

// The line whose joint two curves have in common at every orientation: one of them, or that of a stub if they are circles.
inline std::optional<Feature> line_of_joint(const Scene& scene, const Feature& x, const Feature& y) {
    if (is_smooth(scene, x, y)) return x;
    if (is_smooth(scene, y, x)) return y;
    if (!is_circle(x) || !is_circle(y)) return {};
    const Shape &A = scene.robot, &O = scene.obstacles;
    if (O.has_arcs() && A.point[x.robot] == A.point[y.robot])
        if (const Index e = O.stub_between(x.obstacle, y.obstacle); e >= 0) return Feature{Kind::vertex_edge, x.robot, e};
    if (A.has_arcs() && O.point[x.obstacle] == O.point[y.obstacle])
        if (const Index g = A.stub_between(x.robot, y.robot); g >= 0) return Feature{Kind::edge_vertex, g, x.obstacle};
    return {};
}

// The circle about the end of a line's edge, of all that have a joint there.
inline Feature circle_at_end(const Scene& scene, const Feature& line, int end) {
    const Shape& s = line.kind == Kind::vertex_edge ? scene.obstacles : scene.robot;
    const Index e = line.kind == Kind::vertex_edge ? line.obstacle : line.robot, vertex = end == 0 ? s.v[e] : s.w[e];
    if (line.kind == Kind::vertex_edge) return {Kind::vertex_vertex, line.robot, vertex};
    return {Kind::vertex_vertex, vertex, line.obstacle};
}

template <>
inline Vec<RootSum> difference(const Shape& s, Index p, Index q) { return {RootSum(s.X[p] - s.X[q]), RootSum(s.Y[p] - s.Y[q])}; }

// A whole number in a number type.
template <class K>
K whole(int n) {
    if constexpr (std::is_same_v<K, Approx>) return {static_cast<double>(n), std::abs(static_cast<double>(n))};
    else return K(n);
}

// Quarter turns from the x axis to where t is 0 and 1 on a quadrant of a circle: t rises counter-clockwise, on that of a concave
// arc clockwise, so that forbidden is on the left.
struct Quadrant {
    int begin, end;
};
inline Quadrant quadrant_of(const Scene& scene, const Feature& circle) {
    return is_concave(scene, circle) ? Quadrant{circle.branch + 1, circle.branch} : Quadrant{circle.branch, circle.branch + 1};
}

// True if a sum of two radii is below 0; it is rational, and doubles are certain.
inline bool is_below_zero(const Approx& x) { return x.v < 0; }
inline bool is_below_zero(const Ball& x) { return x.hi < 0; }
inline bool is_below_zero(const RootSum& x) { return x.sign() < 0; }
inline bool is_below_zero(const Int& x) { return x.sign() < 0; }

// The surfaces' data in a number type.
template <class K>
class RoundSurfaces {
public:
    explicit RoundSurfaces(const Scene& s) : scene(s) {}

    Site site(const Feature& f) const {
        if (f.kind == Kind::vertex_edge) return {f.robot, scene.obstacles.v[f.obstacle]};
        if (f.kind == Kind::edge_vertex) return {scene.robot.v[f.robot], f.obstacle};
        return {f.robot, f.obstacle};
    }
    K rho(const Feature& f) const {
        const Site at = site(f);
        return cfree::rho<K>(scene, scene.robot.vertex_radius[at.robot], scene.obstacles.vertex_radius[at.obstacle]);
    }
    // The radius of a circle, that of a concave arc as well.
    K size(const Feature& circle) const {
        const K r = rho(circle);
        return is_below_zero(r) ? -r : r;
    }
    // Vector V of a line, and its length.
    MovingVector<K> along(const Feature& f) const {
        if (f.kind == Kind::vertex_edge) return {close_edge<K>(scene.obstacles, f.obstacle), zero()};
        return {zero(), close_edge<K>(scene.robot, f.robot)};
    }
    K length(const Feature& f) const {
        return f.kind == Kind::vertex_edge ? cfree::length<K>(scene.obstacles, f.obstacle) : cfree::length<K>(scene.robot, f.robot);
    }
    K square_of_length(const Feature& f) const {
        const auto V = f.kind == Kind::vertex_edge ? close_edge<K>(scene.obstacles, f.obstacle) : close_edge<K>(scene.robot, f.robot);
        return dot(V, V);
    }
    // Vector from the second feature's site to the first one's.
    MovingVector<K> between(const Feature& f, const Feature& g) const {
        const Site to = site(f), from = site(g);
        return {close_difference<K>(scene.obstacles, to.obstacle, from.obstacle), close_difference<K>(scene.robot, to.robot, from.robot)};
    }
    // Offset of a feature's site from a line, times |V|, positive on its left.
    Trig<K> offset(const Feature& line, const Feature& from) const {
        return cross(along(line), between(from, line)) + rho(line) * length(line);
    }

    // Another surface seen from a circle.
    struct Seen {
        MovingVector<K> n;
        Trig<K> delta, square;  // |n|^2
    };
    Seen seen(const Feature& circle, const Feature& other) const {
        if (is_line(other)) return {quarter_turn(along(other)), -offset(other, circle), constant(square_of_length(other))};
        const MovingVector<K> d = between(other, circle);
        const Trig<K> square = dot(d, d);
        const K two = whole<K>(2), r = rho(circle), s = rho(other);
        return {{{two * d.p.x, two * d.p.y}, {two * d.q.x, two * d.q.y}}, square + (r * r - s * s), whole<K>(4) * square};
    }

    // Quadratic of the angles at which two surfaces touch: on the left (1) or right (-1) of the first line; two circles, of which
    // none is a line, touch from outside (1) or inside (-1).
    Trig<K> tangency(const Feature& f, const Feature& g, int side) const {
        if (is_line(f)) return offset(f, g) + whole<K>(side) * size(g) * length(f);
        if (is_line(g)) return tangency(g, f, side);
        const MovingVector<K> d = between(g, f);
        const K sum = size(f) + whole<K>(side) * size(g);
        return dot(d, d) - sum * sum;
    }
    // Quadratic of the angles at which the joint of a line and a circle is on another surface, positive on a line's left and
    // outside a circle.
    Trig<K> joint(const Feature& line, const Feature& circle, const Feature& on) const {
        const K length_of_line = length(line), r = rho(circle);
        if (is_line(on)) return length_of_line * offset(on, circle) - r * dot(along(on), along(line));
        const MovingVector<K> d = between(circle, on);
        const K s = rho(on);
        return length_of_line * (dot(d, d) + (r * r - s * s)) - whole<K>(2) * r * cross(along(line), d);
    }
    // Quadratic of the angles at which the end C + rho e of a quadrant is on another surface; positive on a line's left and
    // outside a circle. The joint of a line that is smooth with the circle is in the end where V . e = 0.
    Trig<K> end_of_quadrant(const Feature& circle, int quadrant, const Feature& on) const {
        const MovingVector<K> e = axis(quadrant);
        if (is_smooth(scene, on, circle)) return dot(along(on), e);
        if (is_line(on)) return offset(on, circle) + rho(circle) * cross(along(on), e);
        const MovingVector<K> d = between(on, circle);
        const K r = rho(circle), s = rho(on);
        return dot(d, d) + (r * r - s * s) - whole<K>(2) * r * dot(d, e);
    }
    // Unit vector, a number of quarter turns from the x axis.
    static MovingVector<K> axis(int turns) {
        constexpr int x[4] = {1, 0, -1, 0};
        return {{whole<K>(x[turns & 3]), whole<K>(x[(turns + 3) & 3])}, zero()};
    }
    static Trig<K> constant(const K& k) { return {k, whole<K>(0), whole<K>(0)}; }

private:
    static Vec<K> zero() { return {whole<K>(0), whole<K>(0)}; }
    const Scene& scene;
};

// Quadratic of the angles at which a joint that two of three surfaces have in common is on the third one.
template <class K>
std::optional<Trig<K>> joint_of_three(const RoundSurfaces<K>& of, const Scene& scene, const Feature& x, const Feature& y, const Feature& z) {
    const std::array<std::array<const Feature*, 3>, 3> pairs{{{&x, &y, &z}, {&x, &z, &y}, {&y, &z, &x}}};
    for (const bool are_circles : {false, true})  // an event may name a joint of a line with a circle that touches the surface
        for (const auto& [first, second, on] : pairs) {
            if ((is_circle(*first) && is_circle(*second)) != are_circles) continue;
            if (const auto line = line_of_joint(scene, *first, *second)) return of.joint(*line, is_circle(*first) ? *first : *second, *on);
        }
    return {};
}

// A polynomial as a sum of products of two or three quadratics, by their places in a list.
template <class K>
struct Products {
    struct Term {
        int sign;
        std::array<int, 3> factors;
    };
    int degree, factor_count, term_count;
    std::array<Trig<K>, 7> factors;
    std::array<Term, 4> terms;
};

// Polynomial of the angles at which three surfaces without a joint meet in a point. All its terms are homogeneous in 1, cos and
// sin, so it is the true one times a power of 1 + tau^2.
template <class K>
Products<K> meeting(const RoundSurfaces<K>& of, const Feature& x, const Feature& y, const Feature& z) {
    if (is_line(x) && is_line(y) && is_line(z)) {
        const auto U = of.along(x), V = of.along(y), W = of.along(z);
        const auto from_x = RoundSurfaces<K>::constant(of.rho(x) * of.length(x));
        return {4, 6, 3, {from_x, cross(V, W), of.offset(y, x), cross(W, U), of.offset(z, x), cross(U, V)},
                {{{1, {0, 1}}, {1, {2, 3}}, {1, {4, 5}}}}};
    }
    const Feature &circle = is_circle(x) ? x : is_circle(y) ? y : z, &first = is_circle(x) ? y : x;
    const Feature& second = is_circle(x) || is_circle(y) ? z : y;
    const auto p = of.seen(circle, first), q = of.seen(circle, second);
    const K r = of.rho(circle);
    return {6, 7, 4,
            {p.delta, q.delta, cross(p.n, q.n), p.square, q.square, whole<K>(2) * dot(p.n, q.n), RoundSurfaces<K>::constant(r * r)},
            {{{1, {0, 0, 4}}, {1, {1, 1, 3}}, {-1, {0, 1, 5}}, {-1, {2, 2, 6}}}}};
}

// The same in the ring of `in`: numbers at an angle, or polynomials.
template <class K, class Ring>
auto sum_of(const Products<K>& p, const Ring& in) {
    using V = decltype(in(p.factors[0]));
    std::vector<V> factors;
    for (int i = 0; i < p.factor_count; ++i) factors.push_back(in(p.factors[static_cast<std::size_t>(i)]));
    std::optional<V> sum;
    for (int t = 0; t < p.term_count; ++t) {
        const auto& term = p.terms[static_cast<std::size_t>(t)];
        const auto factor = [&](int i) -> const V& { return factors[static_cast<std::size_t>(term.factors[static_cast<std::size_t>(i)])]; };
        V product = factor(0) * factor(1);
        if (p.degree == 6) product = product * factor(2);
        sum = !sum ? product : term.sign > 0 ? *sum + product : *sum - product;
    }
    return *sum;
}

}  // namespace cfree
