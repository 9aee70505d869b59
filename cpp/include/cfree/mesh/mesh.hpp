// Triangles within a stated distance of the boundary; docs/theory/meshes.md has the proof of the bounds.
//
// Edges of the cell complex are sampled once, for all faces at them; each face is then triangulated by itself, with inner
// points if the bounds need them.
#pragma once
#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/contact/contact_curve.hpp"

namespace cfree {

struct Mesh {
    std::vector<double> xyz;      // x, y and theta times the angle scale of each vertex
    std::vector<Index> corners;   // three vertices of each triangle, counter-clockwise as seen from the free side
    std::vector<Index> face;      // each triangle's face
    std::vector<Index> seam;      // pairs of vertices: at theta = -pi/2 and the same at 3 pi/2
    double least = 0;             // number of triangles of the best known density on e-v surfaces
};

// Estimated numbers of triangles, first without any accuracy requirement.
struct MeshEstimate {
    double coarsest, triangles;
};
MeshEstimate estimate_mesh(const CellComplex& cells, double error, double angle_scale);

// Mesh of all faces; with `off_surface`, inner points may be off the surface if that makes triangles fewer. Throws
// std::logic_error if the bounds of a face cannot be met, which is a bug.
Mesh mesh(const CellComplex& cells, double error, double angle_scale, bool off_surface = false);

}  // namespace cfree
