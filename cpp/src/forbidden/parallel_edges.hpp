// Angles at which an edge of the robot is parallel to one of the obstacles, and slides along it: no place needs to be found.
#pragma once
#include <span>

#include "cfree/predicates/junction.hpp"
#include "forbidden/parts.hpp"
#include "forbidden/side_at_angle.hpp"

namespace cfree {

// Match the sides at an angle if they are the whole lines of two edges that are parallel there, and nothing else happens.
// Otherwise return false, and leave parts as they are.
bool glue_parallel_edges(const Scene& scene, const Whole& whole, std::span<const SideAtAngle> sides, Junction& at, Parts& parts);

}  // namespace cfree
