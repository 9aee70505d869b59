// Convert a path of a slightly smaller robot, along its contacts, to a path of the robot.
#pragma once
#include <functional>

#include "cfree/planning/free_motions.hpp"

namespace cfree {

// If the smaller robot touches something, the robot overlaps it: these poses are left out, or replaced by poses a little
// towards their neighbours. Where that is not free, `search` may lead from one free pose to a later one. Returns a path whose
// motions are free; nothing if all of that fails, as with hardly any room.
using LocalSearch = std::function<std::optional<Poses>(const RationalPose& from, const RationalPose& to)>;
std::optional<Poses> off_contacts(const Poses& way, const FreeMotions& motions, const LocalSearch& search = {});

}  // namespace cfree
