// Triangles within a stated distance of the boundary; docs/theory/meshes.md has the proof of the bounds.
//
// Edges of the cell complex are sampled once, for all faces at them; each face is then triangulated by itself, with points
// inside where the bounds ask for them.
#pragma once
#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/contact/contact_curve.hpp"

namespace cfree {

struct Mesh {
    std::vector<double> xyz;      // x, y and theta times the angle scale of each vertex
    std::vector<Index> corners;   // three vertices of each triangle, counter-clockwise as seen from the free side
    std::vector<Index> face;      // of each triangle
    std::vector<Index> seam;      // pairs of vertices: at theta = -pi/2 and the same at 3 pi/2
    double least = 0;             // triangles of the best known density on the e-v surfaces
};

// About how many triangles there will be, first without any demand for accuracy.
struct MeshEstimate {
    double coarsest, triangles;
};
MeshEstimate estimate_mesh(const CellComplex& cells, double error, double angle_scale);

// Inner points may be off the surface if that makes triangles fewer, and is wished. A face whose bounds cannot be met, which is a
// fault, is thrown as std::logic_error.
Mesh mesh(const CellComplex& cells, double error, double angle_scale, bool off_surface = false);

}  // namespace cfree
