// Match sides at critical angles: at one angle, sides on one line that overlap there.
#pragma once
#include "forbidden/parts.hpp"

namespace cfree {

// Match one list after another, by any number of threads; only for whole trapezoids.
std::vector<Parts> glue_levels(const Boundary& boundary, const Whole& whole, Around around, int threads);

}  // namespace cfree
