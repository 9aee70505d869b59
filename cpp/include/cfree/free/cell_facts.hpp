// Facts of cells: their volume, and whether obstacles alone enclose them.
#pragma once
#include "cfree/free/free_space.hpp"

namespace cfree {

// Volumes in length^2 radians, by the divergence theorem, infinite if unbounded; and estimates of their errors, to first
// order in rounding.
struct Volumes {
    std::vector<double> values, errors;
};
Volumes volumes(const FreeSpace& space);

// A side of a trapezoid, the free one or the inner, forbidden one, with the closed surface of such sides that contains it and
// the cell that this surface bounds. The volumes of all cells are sums over such sides.
struct Facing {
    Index trapezoid, surface, cell;
    bool is_inner;
};
Volumes enclosed(const Boundary& boundary, const std::vector<Facing>& facing, Index cells);

// Contribution of each trapezoid of a boundary to the volume inside its closed surface, free side inside, from given origins.
Volumes fluxes(const Boundary& boundary, const std::vector<Vec<double>>& origins);

// True for each cell that is bounded and has no boundary face of the bounds or workspace, whose owners are negative.
std::vector<std::uint8_t> caged(const FreeSpace& space, const std::vector<Index>& owner);

}  // namespace cfree
