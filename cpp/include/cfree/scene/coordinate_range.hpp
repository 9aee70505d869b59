// Documented range of a scene's coordinates, checked once, when a scene is made.
//
// Coordinates become integers over one common denominator. If they have at most `most_bits` the core's doubles neither
// overflow nor underflow, and its exact integers stay fast: lengths from 1e-150 to 1e150 may meet in one scene. Radii are
// lengths; none is below 0, and a point or a segment has one above 0.
#pragma once
#include <optional>
#include <string>

#include "cfree/scene/features.hpp"

namespace cfree {

inline constexpr unsigned most_bits = 1110;  // including the frame and `largest_bits`, no double is below 2^-1022

// Shape outside the range: "robot", "obstacles" or "bounds" with an index, or "workspace", and the reason.
struct RangeFault {
    std::string kind;
    Index index;  // -1 for the workspace
    std::string message;
};
std::optional<RangeFault> range_fault(const SceneShapes& shapes);

}  // namespace cfree
