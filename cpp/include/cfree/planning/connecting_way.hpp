// Path between two poses of one cell, over the surfaces between them.
#pragma once
#include "cfree/planning/boundary_walk.hpp"
#include "cfree/planning/surroundings.hpp"

namespace cfree {

// Poses from the start to the goal; the motions between them are free. Throws std::logic_error if no path is found along a
// surface.
Poses connecting_way(const Surroundings& around, const Connection& joined, double angle_scale,
                     const std::shared_ptr<FoundSlides>& slides);

}  // namespace cfree
