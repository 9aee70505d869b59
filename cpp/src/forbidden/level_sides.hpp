// Sides at critical angles matched: at one angle, sides on one line that overlap there.
#pragma once
#include "forbidden/parts.hpp"

namespace cfree {

// One list after another, by any number of threads; for trapezoids that are whole.
std::vector<Parts> glue_levels(const Boundary& boundary, const Whole& whole, Around around, int threads);

}  // namespace cfree
