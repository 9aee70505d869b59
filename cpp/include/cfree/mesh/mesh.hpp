// Triangles within a stated distance of the boundary; docs/theory/meshes.md has the proof of the bounds.
//
// Edges of the cell complex are sampled once, for all faces at them; each face is then triangulated by itself, with points
// inside where the bounds ask for them.
#pragma once
#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/mesh/contact_curve.hpp"

namespace cfree {

struct MeshInput {
    Places places;
    const Patches& patches;
    // of each trapezoid: patch, chart, curves
    const Index* patch;
    const std::uint8_t* chart;
    const std::uint64_t *lower, *upper;
    // the cell complex
    Index faces, coedges, edges, vertices;
    const Index *first, *face, *twin, *edge, *vertex;
    const std::uint8_t* side;
    const double *x, *y, *theta;
    double error, angle_scale;
};

struct MeshArrays {
    std::vector<double> xyz;      // x, y and theta of each vertex
    std::vector<Index> corners;   // three vertices of each triangle, counter-clockwise as seen from the free side
    std::vector<Index> face;      // of each triangle
    std::vector<Index> seam;      // pairs of vertices: at theta = -pi/2 and the same at 3 pi/2
    double least = 0;             // triangles of the best known density on the e-v surfaces
};

// About how many triangles there will be, first without any demand for accuracy.
struct MeshEstimate {
    double coarsest, triangles;
};
MeshEstimate estimate_mesh(const MeshInput& input);

// A face whose bounds cannot be met, which is a fault, is thrown as std::logic_error.
MeshArrays mesh(const MeshInput& input);

}  // namespace cfree
