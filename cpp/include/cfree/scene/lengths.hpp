// Radii of shapes and lengths of edges, in scenes with a radius, as each rung of a decision takes them.
//
// T is Approx or Ball, times 2^-shift; Int, in the scene's integers, for lengths that are rational; or RootSum, alike for all.
#pragma once
#include <cmath>

#include "cfree/exact/surd.hpp"
#include "cfree/scene/scene.hpp"

namespace cfree {

// Vertex p minus vertex q, and an edge. Doubles take the remainders of coordinates too: they are within 2 u of the difference, and u^2 of
// the coordinates, so that shapes far from the origin lose no digits.
template <class T>
Vec<T> close_difference(const Shape& s, Index p, Index q) { return difference<T>(s, p, q); }
template <>
inline Vec<Approx> close_difference(const Shape& s, Index p, Index q) {
    if (!(s.rounded[p] | s.rounded[q])) return difference<Approx>(s, p, q);
    const auto coordinate = [&](double high_p, double low_p, double high_q, double low_q) -> Approx {
        const double d = (high_p - high_q) + (low_p - low_q);
        return {d, std::abs(d) + 0x1p-50 * (std::abs(high_p) + std::abs(high_q))};
    };
    return {coordinate(s.x[p], s.x_low[p], s.x[q], s.x_low[q]), coordinate(s.y[p], s.y_low[p], s.y[q], s.y_low[q])};
}
template <class T>
Vec<T> close_edge(const Shape& s, Index e) { return close_difference<T>(s, s.w[e], s.v[e]); }

template <class T>
T radius(const Shape& s, Index radius_class);

template <>
inline Approx radius(const Shape& s, Index radius_class) {
    const double r = s.radii[radius_class].about.hi;
    return {r, std::abs(r)};
}
template <>
inline Ball radius(const Shape& s, Index radius_class) { return s.radii[radius_class].about; }
template <>
inline Int radius(const Shape& s, Index radius_class) { return s.radii[radius_class].exact; }
template <>
inline RootSum radius(const Shape& s, Index radius_class) { return s.radii[radius_class].exact; }

// Sum of a radius of the robot and one of the obstacles, by their classes; negative if it is that of a concave arc's surface.
template <class T>
T rho(const Scene& scene, Index robot_class, Index obstacle_class) {
    return radius<T>(scene.robot, robot_class) + radius<T>(scene.obstacles, obstacle_class);
}

template <class T>
T length(const Shape& s, Index e);  // |E|

template <>
inline Approx length(const Shape& s, Index e) {
    const double l = s.lengths[e].about.hi;
    return {l, l};
}
template <>
inline Ball length(const Shape& s, Index e) { return s.lengths[e].about; }
template <>
inline Int length(const Shape& s, Index e) { return s.lengths[e].factor; }  // rational ones only
template <>
inline RootSum length(const Shape& s, Index e) { return RootSum(s.lengths[e].factor) * RootSum::root(s.lengths[e].radicand); }

}  // namespace cfree
