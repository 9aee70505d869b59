// What is told of cells: how large they are, and whether obstacles alone enclose them.
#pragma once
#include "cfree/free/free_space.hpp"

namespace cfree {

// In length^2 radians, by the divergence theorem, and estimates of their errors, in the part of rounding to first order; infinite if unbounded.
struct Volumes {
    std::vector<double> values, errors;
};
Volumes volumes(const FreeSpace& space);

// A side of a trapezoid, the free one or the inner, forbidden one: the closed surface of such sides that it is in, and the cell
// that this bounds. By such sides the volumes of all cells.
struct Facing {
    Index trapezoid, surface, cell;
    bool is_inner;
};
Volumes enclosed(const Boundary& boundary, const std::vector<Facing>& facing, Index cells);

// What each trapezoid of a boundary gives to the volume enclosed by its closed surface, the free side inside, seen from points.
Volumes fluxes(const Boundary& boundary, const std::vector<Vec<double>>& origins);

// Whether each cell is bounded and no face of its boundary belongs to bounds or workspace, whose owners are negative.
std::vector<std::uint8_t> caged(const FreeSpace& space, const std::vector<Index>& owner);

}  // namespace cfree
