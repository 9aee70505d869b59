// Input of the core: two shapes, the robot at rest and the obstacles, as flat arrays.
//
// Coordinates are integers (the user's rationals times one common denominator). Vertices that coincide share a
// `point`, directed edges on one line with one direction share a `line`, and parallel edges (either way) share a
// `direction`: equality of features is decided once, before any predicate.
//
// A shape may be rounded: each of its polygons, which is then called a core, and may be a point or a segment, is grown by a
// radius of its own. In such a scene vertices share a point only with one radius, and edges share a line only if these lines,
// moved outwards by their radii, are one.
//
// Sides of a polygon may be convex arcs. The ring then has the arc's centre as a vertex, with the arc's radius; a vertex where an
// arc meets its neighbour smoothly is none of the ring's. The edge between an arc and a corner, or another arc, is a stub: it has
// no length, and the arc's direction at its end.
//
// An arc may be concave: its radius is negative, and its vertex is not convex. The pieces leave out the fillet at it, the part of
// the shape between the arc and two edges of pieces; theory, "Concave arcs".
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <memory>
#include <optional>
#include <vector>

#include "cfree/exact/ball.hpp"

namespace cfree {

// A radius: exactly, in the scene's integers, and in doubles, times 2^-shift.
struct Radius {
    Int exact = 0;
    Ball about;  // of radius 0 and without a lower part if its double is exact
};

// Length of an edge, factor sqrt(radicand) in the scene's integers. The radicand is 1 if the length is rational; else all
// parallel edges share it, and it is no square.
struct Length {
    Int factor = 0, radicand = 1;
    Ball about;  // times 2^-shift; its upper part is the length rounded once
    bool is_rational() const { return radicand == 1; }
};

struct Shape {
    std::vector<Int> X, Y;         // exact coordinates
    std::vector<double> x, y;      // the same times 2^-shift, rounded
    std::vector<double> x_low, y_low;  // the remainder, rounded
    std::vector<char> rounded;     // of each vertex: 0, its coordinates are these doubles; 1, sums of the two; 2, not even sums
    std::vector<Index> point;      // class of coincident vertices
    // Directed edges v -> w. Those of rings come first: edge e of a ring starts at vertex e. Then the pieces' diagonals.
    std::vector<Index> v, w, line, direction;
    // Rings: closed chains of the first ring_vertices vertices, interior on the left.
    Index ring_vertices = 0;
    std::vector<Index> previous;   // previous vertex in the ring
    std::vector<char> convex;      // interior angle below pi
    std::vector<char> emit;        // true if the ring of this vertex makes surfaces (outer rims of frames do not)
    std::vector<Index> layer;      // vertices and pieces meet only those of the same layer of the other shape
    std::vector<Index> vertex_rank, edge_rank;  // order among coincident ring features: the lowest owns
    // Convex pieces, counter-clockwise; piece k has vertices piece_vertex[piece[k] .. piece[k + 1]) and as many edges,
    // none when it is a single point.
    std::vector<Index> piece, piece_vertex, piece_edge, piece_layer;
    // Only in scenes with a radius, else empty: different radii by class, which rise from 0, the radius of class 0, and then those
    // below 0; class of the radius of each vertex; lengths of edges. An edge has the radius of its ends.
    std::vector<Radius> radii;
    std::vector<Index> vertex_radius;
    std::vector<Length> lengths;

    const Radius& radius_of(Index vertex) const { return radii[vertex_radius[vertex]]; }
    Index pieces() const { return static_cast<Index>(piece.size()) - 1; }
    // Vertices at the ends of each edge whose circles it touches there, beside v and w: those of arcs. Only with arcs, else empty.
    std::vector<Index> first, last;
    std::vector<char> stub;   // of each edge: true if it is one; its line touches the circles of v and of these two in one place
    std::vector<char> is_arc;  // of each vertex: true if it is an arc's centre
    // Pairs of points whose circles touch in the joint of a stub, the lower first, in order: arcs and their ends.
    struct Touch {
        Index first, second, stub;
        auto operator<=>(const Touch&) const = default;
    };
    std::vector<Touch> touches;
    // The convex quadrangle of a concave arc's centre, its ends and a point beyond it, counter-clockwise. Its radius is that of the
    // other shape's vertices for which it is meant, times -1: the two have the sum 0. It is meant for corners, or for convex arcs;
    // for these it is smaller.
    struct Fillet {
        Index arc;  // vertex of a ring
        std::array<Index, 4> vertex, edge;
        bool is_for_arcs = false;
    };
    std::vector<Fillet> fillets;
    // Where the other shape has concave arcs. A triangle at a convex arc's centre, opposite of the arc's directions; its radius and
    // that of the concave arcs for which it is meant have the sum 0. And points of convex arcs.
    struct Wedge {
        Index arc;  // vertex of a ring
        std::array<Index, 3> vertex, edge;
    };
    struct Probe {
        Index vertex, arc;
    };
    std::vector<Wedge> wedges;
    std::vector<Probe> probes;
    std::vector<Index> fillet_ends;  // vertices at the ends of concave arcs
    std::vector<char> concave;       // of each vertex of a ring: true if it is a concave arc's; empty if there is none
    bool is_concave(Index vertex) const {
        const auto k = static_cast<std::size_t>(vertex);
        return k < concave.size() && concave[k] != 0;
    }
    bool has_concave() const { return !concave.empty(); }
    // A bound of all radii, in doubles: that of the last class where none is below 0.
    double largest_radius() const {
        double most = 0;
        for (const Radius& radius : radii) most = std::max(most, std::abs(radius.about.hi));
        return most;
    }
    // Stub in whose joint the circles of two vertices touch; -1 if there is none.
    Index stub_between(Index vertex, Index other) const;

    bool has_arcs() const { return !is_arc.empty(); }
    Index first_of(Index e) const { return first.empty() ? v[e] : first[e]; }
    Index last_of(Index e) const { return last.empty() ? w[e] : last[e]; }
    bool is_stub(Index e) const { return !stub.empty() && stub[e] != 0; }
    bool has_extent(Index e) const { return v[e] != w[e]; }  // or is the ring a single point
    bool makes_surfaces(Index e) const { return has_extent(e) && !is_stub(e); }
    // Vertices in the user's units, correctly rounded: x0, y0, x1, ...
    std::vector<double> xy;
    // Set X and Y and the doubles, also those of radii and lengths. Both shapes of a scene have the same scale, integers in a
    // unit, and shift: 0, or enough to keep products of four doubles finite.
    void set_coordinates(std::vector<Int> exact_x, std::vector<Int> exact_y, int shift = 0, const Int& scale = 1);
};

// Two shapes, and the origins of their coordinates.
struct Scene {
    Shape robot, obstacles;
    Int scale = 1;            // integers in a unit of the user: their common denominator
    Int short_part = 1;       // the odd part of what many obstacles share, and the robot, workspace and bounds
    int shift = 0;            // doubles are integers times 2^-shift
    bool is_bounded = false;  // true if there is no free space far away
    // The same scene from an origin near each shape: far away from it doubles would have no digits left. Differences of
    // vertices are the same; positions of the robot move by `frame`: obstacles' origin - R robot's origin.
    std::array<double, 4> frame{};      // the two origins in the user's units: x and y of the obstacles', of the robot's
    std::shared_ptr<const Scene> moved; // null if it is the same
    bool is_round = false;              // true if a radius is above 0
    const Scene& near() const { return moved ? *moved : *this; }
    double unit() const { return ratio(Int(1) << static_cast<unsigned>(shift), scale); }  // the doubles' unit, in the user's units
};

// Representatives of all features at one point, or on one line: those of lowest layer and rank in a ring.
class Representatives {
public:
    explicit Representatives(const Scene& scene);
    Index vertex(bool of_robot, Index v) const { return vertices[of_robot][v]; }
    Index edge(bool of_robot, Index e) const { return edges[of_robot][e]; }

private:
    std::array<std::vector<Index>, 2> vertices, edges;  // obstacles first, then the robot
};

// Scene with a copy measured from the two origins, in the scene's integers, with a shift for coordinates from there.
std::shared_ptr<const Scene> scene_around(Scene scene, const Vec<Int>& robot_origin, const Vec<Int>& obstacle_origin, int near_shift);

// The scene with doubles that are coordinates times `short_part` and a power of two: they do not depend on long denominators
// of other shapes. None if its doubles are such already. Radii stay.
std::optional<Scene> with_short_doubles(const Scene& scene);
int short_shift(const Scene& scene);  // its shift

template <class T>
Vec<T> difference(const Shape& s, Index p, Index q);  // vertex p minus vertex q

template <>
[[gnu::always_inline]] inline Vec<Approx> difference(const Shape& s, Index p, Index q) {
    const double dx = s.x[p] - s.x[q], dy = s.y[p] - s.y[q];
    if (!(s.rounded[p] | s.rounded[q])) return {{dx, std::abs(dx)}, {dy, std::abs(dy)}};
    return {{dx, std::abs(s.x[p]) + std::abs(s.x[q])}, {dy, std::abs(s.y[p]) + std::abs(s.y[q])}};
}
template <>
inline Vec<Int> difference(const Shape& s, Index p, Index q) {
    return {s.X[p] - s.X[q], s.Y[p] - s.Y[q]};
}
template <>
inline Vec<Ball> difference(const Shape& s, Index p, Index q) {
    if (!(s.rounded[p] | s.rounded[q])) {
        const auto dx = two_sum(s.x[p], -s.x[q]), dy = two_sum(s.y[p], -s.y[q]);
        return {{dx.s, dx.e, 0}, {dy.s, dy.e, 0}};
    }
    const auto coordinate = [&](Index v, double high, double low) {
        return Ball{high, low, s.rounded[v] == 2 ? ball_error(high) : 0};
    };
    return {coordinate(p, s.x[p], s.x_low[p]) - coordinate(q, s.x[q], s.x_low[q]),
            coordinate(p, s.y[p], s.y_low[p]) - coordinate(q, s.y[q], s.y_low[q])};
}
template <class T>
Vec<T> edge(const Shape& s, Index e) { return difference<T>(s, s.w[e], s.v[e]); }

}  // namespace cfree
