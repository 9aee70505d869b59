// Line of a contact surface at one orientation: P + t U, t in [0, 1], in any number type.
//
//   v-e:  P = b_v - R a_i,  U = E_j = b_w - b_v          (robot vertex i on the obstacle edge j = (v, w))
//   e-v:  P = b_j - R a_v,  U = -R E_i = -R (a_w - a_v)  (robot edge i = (v, w) on the obstacle vertex j)
#pragma once
#include <numbers>
#include <type_traits>

#include "cfree/predicates/predicates.hpp"
#include "cfree/support/elementary.hpp"

namespace cfree {

// A rotation, times w: the one by tau is (1 - tau^2, 2 tau) with w = 1 + tau^2.
template <class T>
struct Rotation {
    T c, s, w;
    Vec<T> operator()(const Vec<T>& v) const { return {c * v.x - s * v.y, s * v.x + c * v.y}; }
    Vec<T> back(const Vec<T>& v) const { return {c * v.x + s * v.y, c * v.y - s * v.x}; }  // R^-1 v
};
inline double theta_of(int chart, double tau) { return 2 * arc_tangent(tau) + chart * std::numbers::pi; }
inline Rotation<double> rotation_by(int chart, double tau) {
    const double m = (chart ? -1 : 1) / (1 + tau * tau);
    return {(1 - tau * tau) * m, 2 * tau * m, 1};
}
// Rotation by tau = p / r, times r^2 + p^2.
inline Rotation<Int> rotation_by(int chart, const Int& p, const Int& r) {
    const Int c = r * r - p * p, s = 2 * p * r;
    return {chart ? Int(-c) : c, chart ? Int(-s) : s, r * r + p * p};
}

// Vectors of a contact line, with the robot at rest: a of the robot, b of the obstacles, and the edge E of one of them.
template <class T>
struct ContactLine {
    bool on_edge;  // v-e
    Vec<T> a, b, E;

    // `of` has vertex(shape, v) and edge(shape, e), as below.
    template <class Coordinates>
    ContactLine(const Scene& scene, const Feature& contact, const Coordinates& of) {
        const Shape &A = scene.robot, &O = scene.obstacles;
        on_edge = contact.kind == Kind::vertex_edge;
        a = of.vertex(A, on_edge ? contact.robot : A.v[contact.robot]);
        b = of.vertex(O, on_edge ? O.v[contact.obstacle] : contact.obstacle);
        E = on_edge ? of.edge(O, contact.obstacle) : of.edge(A, contact.robot);
    }
    // P and U, both times w.
    Vec<T> start(const Rotation<T>& R) const { return Vec<T>{R.w * b.x, R.w * b.y} - R(a); }
    Vec<T> direction(const Rotation<T>& R) const { return on_edge ? Vec<T>{R.w * E.x, R.w * E.y} : -R(E); }
};

// Sources of coordinates: doubles in the user's units, or the core's own numbers.
struct UserUnits {
    Vec<double> vertex(const Shape& s, Index v) const { return {s.xy[2 * v], s.xy[2 * v + 1]}; }
    Vec<double> edge(const Shape& s, Index e) const {
        return vertex(s, s.w[e]) - vertex(s, s.v[e]);
    }
};
template <class T>
struct CoreUnits {
    Vec<T> vertex(const Shape& s, Index v) const {
        if constexpr (std::is_same_v<T, Int>) return {s.X[v], s.Y[v]};
        else return {{s.x[v], std::abs(s.x[v])}, {s.y[v], std::abs(s.y[v])}};
    }
    Vec<T> edge(const Shape& s, Index e) const { return cfree::edge<T>(s, e); }
};

// Sum of the radii of a contact's two features, in the scene's doubles; 0 among polygons.
inline double sum_of_radii(const Scene& scene, const Feature& contact) {
    if (!scene.is_round) return 0;
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index a = contact.kind == Kind::edge_vertex ? A.v[contact.robot] : contact.robot;
    const Index b = contact.kind == Kind::vertex_edge ? O.v[contact.obstacle] : contact.obstacle;
    return A.radius_of(a).about.hi + O.radius_of(b).about.hi;
}

// Move a line outwards, to its right.
inline void move_outwards(ContactLine<double>& line, double by) {
    const double scale = by / norm(line.E.x, line.E.y);
    Vec<double>& at = line.on_edge ? line.b : line.a;
    at = at - Vec<double>{-scale * line.E.y, scale * line.E.x};
}

// The tangent of half the angle from the other end of a quadrant.
inline double from_other_end(double t) { return (1 - t) / (1 + t); }

// Direction of u on a circle of radius rho at t, the tangent of half the angle from the beginning of a quadrant: if rho is negative,
// from its end.
inline Vec<double> on_quadrant(int quadrant, double rho, double t) {
    if (rho < 0) t = from_other_end(t);
    Vec<double> u{(1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)};
    for (int k = 0; k < quadrant; ++k) u = {-u.y, u.x};
    return u;
}

}  // namespace cfree
