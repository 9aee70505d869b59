// Match sides along curves: at every angle between two critical ones, segments of a slice end in a point of the curve.
#pragma once
#include "forbidden/parts.hpp"

namespace cfree {

// Match one list after another, by any number of threads; only for whole trapezoids.
std::vector<Parts> glue_curves(const Boundary& boundary, const Whole& whole, Around around, int threads);
// The same where shapes are grown.
Parts glue_round_curves(const Boundary& boundary, const Whole& whole, Around around);

}  // namespace cfree
