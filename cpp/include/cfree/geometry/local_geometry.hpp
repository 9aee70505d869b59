// Fundamental forms, curvatures and frames of contact surfaces; section 4, Lemma 2. src/cfree/geometry/local.py has the formulas.
#pragma once
#include <array>

#include "cfree/contact/surface.hpp"

namespace cfree {

struct LocalGeometry {
    double E, F, G, e, f, g, v;  // v: the area element, sqrt(E G - F^2)
    std::array<double, 9> frame; // rows in x, y, angle_scale * theta: along the ruling, across it, the normal towards the free side
    double K, H;                 // Gaussian and mean curvature
};

LocalGeometry local_geometry(const Ruled& surface, double t, double phi, double angle_scale);

}  // namespace cfree
