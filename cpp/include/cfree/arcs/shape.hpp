// Shapes bounded by segments and circular arcs, in exact integers and in doubles; theory, "Segments and arcs".
//
// All ends and centers are rational, so that squares of radii are. A shape may be grown: all points closer than its radius
// belong to its inside. A shape that is `outside` is the complement of what its rings bound.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "cfree/exact/ratio.hpp"
#include "cfree/support/index.hpp"

namespace cfree {

// A segment (turn 0), or an arc of at most a quarter turn about its center: counter-clockwise (1) or clockwise (-1).
struct RoundEdge {
    Vec<Int> start, end, center;
    int turn = 0;
};
RoundEdge reversed(const RoundEdge& curve);

struct ArcShape {
    std::vector<RoundEdge> curves;  // the inside is on the left
    std::vector<Index> ring;    // ring k has the curves from ring[k] up to ring[k + 1]
    Int radius = 0;
    Int scale = 1;  // integers in a unit
    bool is_outside = false;
    Index rings() const { return static_cast<Index>(ring.size()) - 1; }
};

// Make a shape from closed rings in any direction, the outer one first.
ArcShape arc_shape(std::vector<std::vector<RoundEdge>> rings, Int radius, Int scale, bool is_outside);

// Shapes, each in integers of its own.
struct ArcScene {
    std::vector<ArcShape> robot, obstacles;
    std::optional<std::array<Ratio, 4>> bounds;  // of the reference point, in units: x0, y0, x1, y1
};

}  // namespace cfree
