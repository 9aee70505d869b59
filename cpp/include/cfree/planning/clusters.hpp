// Clusters of points that doubles cannot distinguish.
#pragma once
#include <array>
#include <vector>

#include "cfree/exact/number.hpp"

namespace cfree {

// Groups of points: any two points that differ by at most `near` in every coordinate are in one group. Gaps in one sorted
// coordinate after another separate groups, so a group may be longer.
std::vector<std::vector<Index>> clusters(const std::vector<std::array<double, 4>>& points, double near);

}  // namespace cfree
