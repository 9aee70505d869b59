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

// A frame around a workspace with arcs and all obstacles, thicker than the robot, then the holes; nothing if there is none.
std::vector<GivenShape> complement(const GivenScene& scene);

}  // namespace cfree
