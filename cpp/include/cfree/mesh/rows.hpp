// Rows of points across a twisted face, from curve to curve along the rulings; theory, "How few triangles".
#pragma once
#include <vector>

#include "cfree/mesh/mesh_face.hpp"

namespace cfree {

// Every second row ends on both curves, at points that rims are to have; those between have one point fewer, half-way.
struct Rows {
    struct Row {
        double angle;
        int parts;  // of the row, or of those before and after it
    };
    std::vector<Row> rows;  // an odd number, from the first side to the last; none if there is no good choice
    double stretch = 1;     // coordinates (u / stretch, stretch * phi) in which triangles are about equilateral
};

// The greatest step on the face's curves at which chords take no more than their share of the error.
double rim_step(const MeshFace& face, double error, double phi);

Rows rows_across(const MeshFace& face, double error);

}  // namespace cfree
