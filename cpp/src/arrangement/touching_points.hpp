// Corners of pieces at one point without a connecting edge: surfaces only touch there.
#pragma once
#include "cfree/forbidden/boundary.hpp"

namespace cfree {

// A corner of a trapezoid: at its first or last angle, on its lower or upper curve.
struct PieceCorner {
    Index trapezoid;
    bool is_last, is_upper;
};

// Groups of corners in one place: lists of at least two numbers.
std::vector<std::vector<Index>> touching_points(const Boundary& boundary, const std::vector<PieceCorner>& corners, int threads);

}  // namespace cfree
