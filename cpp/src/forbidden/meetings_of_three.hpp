// The commonest critical angles: three surfaces meet in a point, and the sides there need no order.
#pragma once
#include <span>

#include "cfree/predicates/junction.hpp"
#include "forbidden/parts.hpp"
#include "forbidden/side_at_angle.hpp"

namespace cfree {

// Match the sides at an angle if three surfaces meet there in a point, or a few times three, and nothing else happens. Otherwise
// return false, and leave parts as they are.
bool glue_meetings_of_three(const Scene& scene, const Whole& whole, std::span<const SideAtAngle> sides, Junction& at, Parts& parts);

}  // namespace cfree
