// Shrink polygons by moving edges inwards; exact tests confirm strict inclusion; theory, "Separations".
#pragma once
#include <memory>

#include "cfree/polygons/polygon.hpp"

namespace cfree {

// Return a polygon strictly inside one: every edge moves inwards and keeps its direction; null if an edge is too short for
// that. Numbers are short if a grid much finer than the inset leaves it inside.
std::shared_ptr<const Polygon> inset(const Polygon& polygon, const Ratio& by);

}  // namespace cfree
