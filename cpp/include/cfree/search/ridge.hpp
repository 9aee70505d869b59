// Ridge: a path beside another one, as far from obstacles as possible up to some distance; and its requirements on shorter
// paths.
#pragma once
#include <array>

#include "cfree/search/way.hpp"

namespace cfree {

// Move a place across a direction (x, y, and angle times the robot's radius) as far from everything as possible, or by
// `enough`. Returns the distance.
double climb(const Way& way, Place& q, const std::array<double, 3>& direction, double enough);

struct Ridge {
    Marked path;                   // marks are lengths
    std::vector<double> distance;  // each pose's, motions beside it included
};
Ridge ridge(const Way& way, const Route& route, double enough);

// Required distance of a pose: a share of the least distance of its part. Parts remain after cutting out a radius of way
// around the narrowest place, and so on; for the first part, also around start and goal. Cut-out places require the distance
// of the places beside them, as far as the ridge has it.
constexpr int all_parts = 100;
std::vector<double> distances_asked(const Ridge& ridge, double radius, double share, int most_depth);

}  // namespace cfree
