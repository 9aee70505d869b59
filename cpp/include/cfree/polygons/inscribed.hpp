// Convex polygons of few vertices inside polygons, found in doubles; an exact test confirms strict inclusion.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "cfree/exact/ball.hpp"
#include "cfree/polygons/polygon.hpp"

namespace cfree {

struct Inscribed {
    std::shared_ptr<const Polygon> polygon;
    Vec<double> middle;  // a point of it
    double width;        // least distance of two parallel lines around it, nearly
};

// Return a convex polygon strictly inside one of some polygons, about as wide as that one is at its widest place; none if there is
// no room for it at a distance `by` from the edges.
std::optional<Inscribed> inscribed(const std::vector<std::shared_ptr<const Polygon>>& polygons, const Ratio& by);

}  // namespace cfree
