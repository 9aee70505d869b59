// Loops of matched sides around trapezoids, and their starts.
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

// Start of a half-edge of a trapezoid, in doubles, in the near frame.
struct PlacedPose {
    Vec<double> xy;
    double theta;
};
// Point of a surface's line at t, or of a quadrant at its t: the tangent of half the angle from its beginning.
Vec<double> place_on(const Scene& scene, const Surface& surface, double tau, double t);
PlacedPose place_of(const Boundary& boundary, Index trapezoid, Side side, double start);

}  // namespace cfree
