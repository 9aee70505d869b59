// The other two terms of Gauss and Bonnet's theorem: how faces turn along their sides, and at their corners.
#pragma once
#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/geometry/quadrature.hpp"

namespace cfree {

struct SideCurvatures {
    std::vector<double> total, error;  // of each half-edge: the geodesic curvature, integrated as its loop runs
    std::vector<double> turn;          // the angle by which the loop turns where it starts
    std::vector<double> start;         // x, y from `Scene::frame`, and angle_scale * theta, by the face's own equations; not a number within walls
};
SideCurvatures side_curvatures(const CellComplex& cells, double angle_scale);

}  // namespace cfree
