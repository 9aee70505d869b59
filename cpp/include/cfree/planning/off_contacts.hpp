// A way of a slightly smaller robot, along its contacts, as one of the robot.
#pragma once
#include "cfree/planning/free_motions.hpp"

namespace cfree {

// Where the smaller robot touches something the robot overlaps it: these poses are left out, or replaced by some a little towards
// their neighbours. Poses of a way whose motions are free; nothing if that is not enough, as where there is hardly any room.
std::optional<Poses> off_contacts(const Poses& way, const FreeMotions& motions);

}  // namespace cfree
