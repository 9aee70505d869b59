// Corners of pieces that are one point, though no edge connects them: surfaces that only touch there.
#pragma once
#include "cfree/forbidden/boundary.hpp"

namespace cfree {

// A corner of a trapezoid: at its first or last angle, on its lower or upper curve.
struct PieceCorner {
    Index trapezoid;
    bool is_last, is_upper;
};

// Of several corners the ones that are in one place; lists of at least two, by their numbers.
std::vector<std::vector<Index>> touching_points(const Boundary& boundary, const std::vector<PieceCorner>& corners, int threads);

}  // namespace cfree
