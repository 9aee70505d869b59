// The commonest of critical angles: three surfaces meet in one point, and the sides there need no order.
#pragma once
#include <span>

#include "cfree/predicates/junction.hpp"
#include "forbidden/parts.hpp"
#include "forbidden/side_at_angle.hpp"

namespace cfree {

// Match the sides at an angle if three surfaces meet there in one point, and nothing else happens. Otherwise return false, and
// leave parts as they are.
bool glue_meeting_of_three(const Scene& scene, const Whole& whole, std::span<const SideAtAngle> sides, Junction& at, Parts& parts);

}  // namespace cfree
