// Polygons strictly inside others, by exact tests: edges moved inwards; theory, "Separations".
#pragma once
#include <memory>

#include "cfree/polygons/polygon.hpp"

namespace cfree {

// A polygon strictly inside one, every edge of which has moved inwards and kept its direction; none if an edge is too short for
// that. Numbers are short if a grid much finer than the inset leaves it inside.
std::shared_ptr<const Polygon> inset(const Polygon& polygon, const Ratio& by);

}  // namespace cfree
