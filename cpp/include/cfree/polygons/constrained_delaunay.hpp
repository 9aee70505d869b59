// Exact constrained Delaunay triangulation of the region that rings bound.
//
// Circles are those of the frame in which the points' bounding box is a square of side 1, so that flat polygons get as good
// triangles as square ones. If more than three points lie on one circle, their indices decide: the triangles meet at the
// least of the points. So the result depends on nothing but the rings.
#pragma once
#include <array>
#include <vector>

#include "cfree/polygons/points.hpp"

namespace cfree {

using Triangles = std::vector<std::array<Index, 3>>;  // counter-clockwise

// Triangles that cover a region, each point once. Edge 3 t + k runs from corner k of triangle t to its next corner; its twin
// is the same edge backwards, -1 if it is one of the rings.
struct Cover {
    Triangles triangles;
    std::vector<Index> twin;
};

// Rings of indices of points, the interior on the left. They do not cross; where they touch, that point is a vertex of both,
// by the same index.
Cover constrained_delaunay(const Points& points, const std::vector<std::vector<Index>>& rings);

// Triangulation of the region by a sweep from left to right.
Triangles swept_triangles(const Points& points, const std::vector<std::vector<Index>>& rings);

// Twins of triangles' edges; nothing if triangles and rings do not fit together: edges that occur twice, or not at all, or
// triangles that are not upright. If they fit, the triangles' indicators add up to the winding number of the rings.
std::vector<Index> twins(const Points& points, const std::vector<std::vector<Index>>& rings, const Triangles& triangles);

}  // namespace cfree
