// Rounded shapes, as src/cfree/scene/rounded.py has them: a polygon, segment or point, some of whose sides are arcs, grown by a
// radius; docs/theory/rounded-shapes.md.
#pragma once
#include "rounds.hpp"

namespace cfree {

struct RoundedShape {
    std::shared_ptr<const Polygon> core;
    Rounding rounding;
};
// The same as in Python, also for paths of lines alone; nothing for other shapes.
std::optional<RoundedShape> rounded(const GivenShape& shape);

bool has_concave(const RoundedShape& shape);
// True if a disc of one side fits exactly between a convex and a concave arc of the other one about one centre. Boundaries do not
// take such shapes.
bool fills_channel(const std::vector<std::optional<RoundedShape>>& robot, const std::vector<std::optional<RoundedShape>>& obstacles);

// A frame around a workspace with arcs and all obstacles, thicker than the robot, then the holes; nothing if there is none.
std::vector<GivenShape> complement(const GivenScene& scene);

}  // namespace cfree
