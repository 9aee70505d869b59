// How much is missing where no motion exists, as in src/cfree/analysis/margins.py.
#pragma once
#include <memory>
#include <optional>

#include "world.hpp"

namespace cfree {

// A world like one with a robot smaller by an inset; null if nothing is left of it.
std::unique_ptr<World> smaller(const World& world, const Ratio& by);

// With an inset of `lo` no motion is found, with one of `hi` there is one.
struct Missing {
    Ratio lo, hi;
    bool is_proved;  // that there is none at `lo`
};
enum class Joined { no, yes, unclear };
// By decisions about worlds; nothing if no inset that leaves something of the robot joins the poses.
std::optional<Missing> missing(const World& world, const std::function<Joined(World&)>& joined);

}  // namespace cfree
