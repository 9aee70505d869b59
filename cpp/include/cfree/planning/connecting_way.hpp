// The way that joins two poses of one cell, over the surfaces found on the way.
#pragma once
#include "cfree/planning/boundary_walk.hpp"
#include "cfree/planning/surroundings.hpp"

namespace cfree {

// Poses from the start to the goal; the motions between them are free. Throws std::logic_error if no way is found along a surface.
Poses connecting_way(const Surroundings& around, const Connection& joined, double angle_scale,
                     const std::shared_ptr<FoundSlides>& slides);

}  // namespace cfree
