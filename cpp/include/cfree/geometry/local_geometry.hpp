// Fundamental forms, curvatures and frames of contact surfaces; section 4, Lemma 2. src/cfree/geometry/local.py has the formulas.
#pragma once
#include <array>

#include "cfree/contact/surface.hpp"

namespace cfree {

// Data at a point: the length L of the ruling, its unit vector u, and the parts of V = dx / dphi, s across it and k along it.
struct RulingPoint {
    bool turns;  // e-v
    double L, ux, uy, s, k;
};
RulingPoint ruling_point(const Ruled& surface, double t, double phi);

struct LocalGeometry {
    double E, F, G, e, f, g, v;  // v: the area element, sqrt(E G - F^2)
    std::array<double, 9> frame; // rows in x, y, angle_scale * theta: along the ruling, across it, normal to the free side
    double K, H;                 // Gaussian and mean curvature
};

LocalGeometry local_geometry(const Ruled& surface, double t, double phi, double angle_scale);

// Integrals over t of v, and of K v.
double ruling_area(const Ruled& surface, double lower, double upper, double phi, double angle_scale);
double ruling_curvature(const Ruled& surface, double lower, double upper, double phi, double angle_scale);

}  // namespace cfree
