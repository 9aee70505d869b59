// Boxes of a grid of poses: its cells times the sectors of a turn.
#pragma once
#include <cstddef>
#include <limits>
#include <numbers>

namespace cfree {

inline constexpr std::size_t sectors = 64, outside = std::numeric_limits<std::size_t>::max();  // outside: slot of no box
inline constexpr double two_pi = 2 * std::numbers::pi;

}  // namespace cfree
