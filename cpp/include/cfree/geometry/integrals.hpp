// Integrals over trapezoids and along their sides, by quadrature over theta: of area, of K, of geodesic curvature.
#pragma once
#include <array>
#include <vector>

#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/forbidden/limits.hpp"
#include "cfree/geometry/quadrature.hpp"

namespace cfree {

// Limits of t on a trapezoid's line at an orientation, and the sines of the angles between it and its two curves' lines.
struct TrapezoidLine {
    Index trapezoid;
    double theta, lower, upper, lower_sine, upper_sine;
};
TrapezoidLine trapezoid_line(const Limits& limits, Index trapezoid, double theta);

// First and last orientation.
std::array<double, 2> angles_of(const Boundary& boundary, Index trapezoid);

// One for each trapezoid; halving may change them by a share of the mean of all.
std::vector<Integral> trapezoid_areas(const Boundary& boundary, double angle_scale);
std::vector<Integral> trapezoid_curvatures(const Boundary& boundary, double angle_scale);  // integrals of K

// The other two terms of Gauss and Bonnet's theorem: the turns of faces along their sides, and at their corners.
struct SideCurvatures {
    std::vector<double> total, error;  // each half-edge's geodesic curvature, integrated in the direction of its loop
    std::vector<double> turn;          // the angle by which the loop turns at its start
    std::vector<double> start;         // x, y from `Scene::frame`, angle_scale * theta, by the face's equations; NaN in walls
};
SideCurvatures side_curvatures(const CellComplex& cells, double angle_scale);

}  // namespace cfree
