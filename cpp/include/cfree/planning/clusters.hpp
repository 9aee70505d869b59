// Points that doubles do not tell apart.
#pragma once
#include <array>
#include <vector>

#include "cfree/exact/number.hpp"

namespace cfree {

// In groups; any two points that differ by at most `near` in every coordinate are in one group. By gaps in one
// sorted coordinate after another: a group may be longer than that.
std::vector<std::vector<Index>> clusters(const std::vector<std::array<double, 4>>& points, double near);

}  // namespace cfree
