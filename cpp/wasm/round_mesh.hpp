// Mesh of a boundary of grown shapes for the eye: within an error, about, which is not proved.
#pragma once
#include <optional>

#include "cfree/mesh/mesh.hpp"

namespace cfree {

// Closed, as `mesh` makes it, without `seam` and `least`; nothing if there are more triangles than `most`.
std::optional<Mesh> round_mesh(const CellComplex& cells, double error, double angle_scale, double most);

}  // namespace cfree
