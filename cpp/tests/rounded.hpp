// Random grown scenes, and their surfaces in long doubles, from coordinates alone.
#pragma once
#include <cmath>
#include <memory>
#include <random>

#include "cfree/scene/features.hpp"
#include "check.hpp"
#include "predicates/round_orders.hpp"

using namespace cfree;
using Real = long double;

inline std::mt19937 random_numbers(45);
inline long random_between(long lo, long hi) { return std::uniform_int_distribution<long>(lo, hi)(random_numbers); }

// Of whole coordinates, or of such with many bits after the point.
inline Polygon polygon(const std::vector<std::pair<long, long>>& points, unsigned bits = 0) {
    const auto coordinate = [&](long whole) {
        const Int one = Int(1) << bits;
        return Ratio{bits == 0 ? Int(whole) : whole * one + random_between(1, 1000), one};
    };
    RatioRing ring;
    for (const auto& [x, y] : points) ring.push_back({coordinate(x), coordinate(y)});
    return points.size() < 3 ? Polygon::thin(ring) : Polygon(std::vector<RatioRing>{ring});
}
inline std::shared_ptr<const Polygon> shared(Polygon p) { return std::make_shared<Polygon>(std::move(p)); }

struct Point {
    Real x, y;
};
inline Point operator-(const Point& p, const Point& q) { return {p.x - q.x, p.y - q.y}; }
inline Real dot(const Point& p, const Point& q) { return p.x * q.x + p.y * q.y; }
inline Real cross(const Point& p, const Point& q) { return p.x * q.y - p.y * q.x; }

// A surface at an angle, in long doubles, from the coordinates alone.
struct Place {
    bool is_line;
    Point at, along;
    Real rho;
};
inline Place placed(const Scene& s, const Feature& f, Real theta) {
    const Shape &A = s.robot, &O = s.obstacles;
    const auto vertex = [](const Shape& shape, Index v) { return Point{Real(shape.X[v]), Real(shape.Y[v])}; };
    const auto turned = [&](const Point& p) {
        return Point{std::cos(theta) * p.x - std::sin(theta) * p.y, std::sin(theta) * p.x + std::cos(theta) * p.y};
    };
    const Index i = f.kind == Kind::edge_vertex ? A.v[f.robot] : f.robot, j = f.kind == Kind::vertex_edge ? O.v[f.obstacle] : f.obstacle;
    Place p{f.kind != Kind::vertex_vertex, vertex(O, j) - turned(vertex(A, i)), {0, 0}, 0};
    p.rho = Real(A.radii[A.vertex_radius[i]].exact) + Real(O.radii[O.vertex_radius[j]].exact);
    if (f.kind == Kind::vertex_edge) p.along = vertex(O, O.w[f.obstacle]) - vertex(O, j);
    if (f.kind == Kind::edge_vertex) p.along = Point{0, 0} - turned(vertex(A, A.w[f.robot]) - vertex(A, i));
    if (!p.is_line) return p;
    const Real length = std::sqrt(dot(p.along, p.along));
    p.at = {p.at.x + p.rho * p.along.y / length, p.at.y - p.rho * p.along.x / length};
    return p;
}
// Place of a curve on a surface: t on a line, the angle from the quadrant's beginning on a circle; NaN if there is none.
inline Real value(const Scene& s, const Feature& x, const Feature& f, Real theta) {
    const Place on = placed(s, x, theta);
    const Real quarter = std::acos(Real(-1)) / 2, none = std::nan("");
    const auto from_start = [&](Real psi) { return std::remainder(psi - (x.branch + 0.5L) * quarter, 4 * quarter) + 0.5L * quarter; };
    if (f.kind == Kind::seam) return from_start(f.branch * quarter);
    const Place other = placed(s, f, theta);
    const Point d = other.at - on.at;
    if (on.is_line && other.is_line) return cross(other.along, d) / cross(other.along, on.along);
    if (on.is_line) {
        const Real square = dot(on.along, on.along), middle = dot(d, on.along) / square, height = cross(on.along, d);
        const Real half = std::sqrt(other.rho * other.rho * square - height * height) / square;
        return is_smooth(s, x, f) ? middle : middle + f.branch * half;
    }
    if (other.is_line) {
        const Real length = std::sqrt(dot(other.along, other.along)), normal = std::atan2(other.along.x, -other.along.y);
        if (is_smooth(s, f, x)) return from_start(normal + 2 * quarter);
        const Real inside = cross(other.along, on.at - other.at) / length;  // inside: inside + rho cos(psi - normal) > 0
        return std::abs(inside) > on.rho ? none : from_start(normal + f.branch * std::acos(-inside / on.rho));
    }
    const Real distance = std::sqrt(dot(d, d));
    const Real cosine = (distance * distance + on.rho * on.rho - other.rho * other.rho) / (2 * distance * on.rho);
    return std::abs(cosine) > 1 ? none : from_start(std::atan2(d.y, d.x) + f.branch * std::acos(cosine));
}

// With different radii of the obstacles, or one.
inline SceneFeatures random_scene(bool with_one_radius = false, unsigned bits = 0) {
    const auto shape = [bits](long size) {
        const long x = random_between(-size, size), y = random_between(-size, size);
        switch (random_between(0, 3)) {
            case 0: return polygon({{x, y}}, bits);
            case 1: return polygon({{x, y}, {x + random_between(1, size), y + random_between(-size, size)}}, bits);
            case 2: return polygon({{x, y}, {x + 3, y}, {x + 3, y + 4}, {x, y + 4}}, bits);
            default: return polygon({{x, y}, {x + random_between(1, size), y}, {x + random_between(-2, 2), y + random_between(1, size)}}, bits);
        }
    };
    SceneShapes shapes;
    shapes.robot.push_back(shared(shape(6)));
    shapes.robot_rounding.assign(shapes.robot.size(), {{random_between(1, 12), 4}, {}});
    for (int k = 0; k < 3; ++k) {
        shapes.obstacles.push_back(shared(shape(9)));
        shapes.obstacle_rounding.push_back(with_one_radius && k > 0 ? shapes.obstacle_rounding[0] : Rounding{{random_between(1, 12), random_between(1, 3)}, {}});
    }
    return scene_features(shapes);
}

inline Feature random_feature(const Scene& s, bool with_lines = true) {
    const auto i = static_cast<Index>(random_between(0, s.robot.ring_vertices - 1));
    const auto j = static_cast<Index>(random_between(0, s.obstacles.ring_vertices - 1));
    const int branch = random_between(0, 1) ? 1 : -1;
    switch (with_lines ? random_between(0, 2) : 2) {
        case 0: if (s.obstacles.has_extent(j)) return {Kind::vertex_edge, i, j, branch}; [[fallthrough]];
        case 1: if (s.robot.has_extent(i)) return {Kind::edge_vertex, i, j, branch}; [[fallthrough]];
        default: return {Kind::vertex_vertex, i, j, branch};
    }
}

inline std::vector<Rounding> roundings(const std::vector<Ratio>& radii) {
    std::vector<Rounding> result;
    for (const Ratio& radius : radii) result.push_back({radius, {}});
    return result;
}

inline SceneFeatures scene_of(Polygon robot, const Ratio& r, std::vector<Polygon> obstacles, std::vector<Ratio> radii) {
    SceneShapes shapes;
    shapes.robot.push_back(shared(std::move(robot)));
    for (Polygon& o : obstacles) shapes.obstacles.push_back(shared(std::move(o)));
    shapes.robot_rounding = roundings({r}), shapes.obstacle_rounding = roundings(radii);
    return scene_features(shapes);
}
