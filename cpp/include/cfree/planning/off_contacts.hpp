// Convert a path of a slightly smaller robot, along its contacts, to a path of the robot.
#pragma once
#include "cfree/planning/free_motions.hpp"

namespace cfree {

// If the smaller robot touches something, the robot overlaps it: these poses are left out, or replaced by poses a little
// towards their neighbours. Returns a path whose motions are free; nothing if that fails, as with hardly any room.
std::optional<Poses> off_contacts(const Poses& way, const FreeMotions& motions);

}  // namespace cfree
