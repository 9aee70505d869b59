// A path beside another one, as far from obstacles as it can be up to some distance; and what that asks of shorter ones.
#pragma once
#include <array>

#include "cfree/search/way.hpp"

namespace cfree {

// Across a direction (x, y, and angle times the robot's radius) as far from everything as it can be, or as is enough.
// Returns the distance.
double climb(const Way& way, Place& q, const std::array<double, 3>& direction, double enough);

struct Ridge {
    Marked path;                   // marked by its length
    std::vector<double> distance;  // of each pose, and of the motions beside it
};
Ridge ridge(const Way& way, const Route& route, double enough);

// A share of the least distance of the part that a pose is in. Parts are what is left after cutting out a radius of way around
// the narrowest place, and so on; of the first, around start and goal as well. What is cut out is asked for what is asked
// beside it, as far as the ridge has it.
constexpr int all_parts = 100;
std::vector<double> distances_asked(const Ridge& ridge, double radius, double share, int most_depth);

}  // namespace cfree
