// Integrals over the trapezoids of a boundary: along t in closed form, over theta by Gauss-Legendre quadrature on intervals that
// are halved until halving changes less than 1e-12 of the value, or of the mean of all: a measured error, no proved one.
#pragma once
#include <functional>
#include <vector>

#include "cfree/forbidden/boundary.hpp"

namespace cfree {

struct QuadratureRule {
    std::vector<double> nodes, weights;  // on [-1, 1]
};
const QuadratureRule& gauss_legendre();  // of eight nodes

// Lines of trapezoids at orientations, and the limits of t there.
struct QuadratureLines {
    std::vector<Index> trapezoid;
    std::vector<double> lower, upper, theta;
};
using AlongT = std::function<std::vector<double>(const QuadratureLines& lines)>;

std::vector<double> trapezoid_integrals(const Boundary& boundary, const QuadratureRule& rule, const AlongT& along_t);

}  // namespace cfree
