// Fits of concave arcs that trimming leaves on no patch: a convex vertex in a concave arc of its own radius, whose circle is a point
// and whose contacts are a helix; and a circle of a concave arc, free inside, that another surface covers but for one point at all
// angles, or touches at one, with the opposite normal. Theory, "Exact fits".
#pragma once
#include "cfree/forbidden/columns.hpp"

namespace cfree {

// True if of vertex i of the robot and vertex j of the obstacles one is a concave arc, and the other one convex with its radius.
bool have_equal_radii(const Scene& scene, Index i, Index j);

// Add all free parts of such curves along which the arcs touch, as parts without width.
void add_fits_of_arcs(const Scene& scene, const Patches& patches, int threads, Trapezoids& thin);

}  // namespace cfree
