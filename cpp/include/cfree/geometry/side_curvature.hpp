// The other two terms of Gauss and Bonnet's theorem: the turns of faces along their sides, and at their corners.
#pragma once
#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/geometry/quadrature.hpp"

namespace cfree {

struct SideCurvatures {
    std::vector<double> total, error;  // each half-edge's geodesic curvature, integrated in the direction of its loop
    std::vector<double> turn;          // the angle by which the loop turns at its start
    std::vector<double> start;         // x, y from `Scene::frame`, angle_scale * theta, by the face's equations; NaN in walls
};
SideCurvatures side_curvatures(const CellComplex& cells, double angle_scale);

}  // namespace cfree
