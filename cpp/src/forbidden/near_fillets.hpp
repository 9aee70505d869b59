// Fillets of concave arcs, each with a vertex of the other shape: what they cover is no pillar.
#pragma once
#include <vector>

#include "cfree/predicates/predicates.hpp"

namespace cfree {

// A fillet, of the robot or else of the obstacles, and a vertex of the other shape. If that is a convex arc, with its directions.
struct NearFillet {
    const Shape::Fillet* fillet;
    bool of_robot;
    Index vertex;
    const Shape::Wedge* directions;
};
// All that may cover something of a contact's patches; `reach` bounds the distance of two points of the robot.
std::vector<NearFillet> fillets_near(const Scene& scene, const Feature& contact, double reach);

}  // namespace cfree
