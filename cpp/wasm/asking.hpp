// Questions of a page: is a pose free, is there a path, where does a straight motion end.
#pragma once
#include "reading.hpp"
#include "reply.hpp"
#include "world.hpp"

namespace cfree {

// Free or not; if free the cells and the contacts that touch, as the drawn boundary has them, else what overlaps.
void ask_pose(const World& world, const World& drawn, const RationalPose& pose, Reply& reply);
// A path, or the closed surface that separates the two. Without a vehicle the robot moves in any direction, and its path obeys
// the wishes; the path of a vehicle is shortened by so many attempts.
void ask_way(World& world, const RationalPose& start, const RationalPose& goal, const std::optional<GivenVehicle>& vehicle, int attempts,
             const Wishes& wishes, Reply& reply);
// `lo`, `hi`: the robot gets there if it is smaller by an inset of `hi`, and not by `lo`; nothing if no inset helps.
void ask_missing(const World& world, const RationalPose& start, const RationalPose& goal, Reply& reply);
// `joined`: 1 if the closure of one cell of the drawn boundary has both poses, else 0; nothing if that has polygons for shapes.
void ask_joined(const World& drawn, const RationalPose& start, const RationalPose& goal, Reply& reply);
// A path given by its poses, a line each; every motion is checked.
void ask_walk(World& world, std::string_view lines, const std::optional<GivenVehicle>& vehicle, Reply& reply);
// Length of the free part of a translation.
void ask_stop(const World& world, const RationalPose& from, const RationalPose& to, Reply& reply);

}  // namespace cfree
