// Matched sides put into loops around trapezoids, and where they start.
#pragma once
#include "forbidden/parts.hpp"

namespace cfree {

// Half-edges, trapezoid after trapezoid in the order of their loops; see CellComplex.
struct Loops {
    std::vector<Index> first, face, twin, edge;
    std::vector<std::uint8_t> kind;  // twice its side, 1 more if it runs against its edge
    std::vector<double> start;       // see Parts
    Index edges = 0;
};
Loops loops_of(std::size_t faces, std::vector<Parts>&& lists);

// Where a half-edge of a trapezoid starts, in doubles, from the near frame.
struct PlacedPose {
    Vec<double> xy;
    double theta;
};
PlacedPose place_of(const Boundary& boundary, Index trapezoid, Side side, double start);

}  // namespace cfree
