// Convex pieces of a polygon, with its own vertices only.
//
// 1. Triangulate: constrained Delaunay, exactly.
// 2. Remove diagonals while both sides stay convex (Hertel and Mehlhorn: at most 4 times the least number).
//
// A piece may run along several true edges and diagonals that lie on one line; their common vertices are not listed.
// Vertices of different rings that coincide are identified by the least of their indices.
#pragma once
#include "cfree/polygons/polygon.hpp"

namespace cfree {

// Vertices of each piece, counter-clockwise, strictly convex, least index first; the pieces are sorted.
Pieces convex_pieces(const Polygon& polygon);

}  // namespace cfree
