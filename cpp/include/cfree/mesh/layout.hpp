// Points laid out over a twisted face so that none are wasted at its curves; theory, "How few triangles".
#pragma once
#include <optional>
#include <vector>

#include "cfree/mesh/mesh_face.hpp"

namespace cfree {

struct Layout {
    struct Point {
        double u, phi, off = 0;
    };
    std::vector<Point> inside;                 // the face's curves and sides
    std::array<std::vector<double>, 2> stops;  // angles of points on the lower and on the upper curve
    std::array<int, 2> parts{};                // of the first and of the last side, 0 if they follow from
    std::array<std::vector<Point>, 2> ends;    // points next to these sides
    double stretch = 1, lean = 0;              // of coordinates in which triangles are about equilateral
    double triangles = 0;                      // about, 0 if nothing is laid out
    bool is_empty() const { return triangles == 0; }
};

// Triangles, for no more of which nothing is laid out.
inline constexpr double few_triangles = 4;
// Where a layout says nothing, and where h is large and the shear varies less.
inline constexpr double usual_stretch = 1.6;
// Triangles of neighbours for a point that they do not need.
inline constexpr double spare_point_cost = 1;

// Points on one of the face's curves that a neighbour wants there, at equal steps.
struct Wanted {
    int curve;
    double first, step, points;
};

// A side of a face: an angle and the points next to it.
struct Wall {
    const MeshFace* face;
    double phi;
    const std::vector<Layout::Point>* ends;
};
// Between two places on a side, those that all faces at it need.
std::vector<double> wall_points(const std::vector<Wall>& walls, double error, double from, double to);

// The greatest step on one of the face's curves, or on both, at which chords take no more than their share of the error.
double rim_step(const MeshFace& face, double error, double phi, int which);
double rim_step(const MeshFace& face, double error, double phi);

// Every second row goes from curve to curve along a ruling, those between have one point fewer, half-way.
Layout rows_across(const MeshFace& face, double error);
// From side to side along curves like the face's, each shifted against the one before.
Layout columns_along(const MeshFace& face, double error);
// With the points wanted on a curve; empty if that is not possible.
Layout columns_along(const MeshFace& face, double error, const Wanted& wanted);
// Best triangles, that lose at the rim; off the surface where that makes them larger, if `free` says so.
Layout lattice_over(const MeshFace& face, double error, bool free);
// The better of rows and columns, or an empty one if a lattice is better; as a neighbour wants it where that costs little.
Layout best_layout(const MeshFace& face, double error, const std::optional<Wanted>& wanted);

// Triangles that a lattice needs, as measured.
double triangles_of_lattice(const MeshFace& face, double error);
// Triangles that the best known density asks for on a face, 0 without twist.
double least_triangles(const MeshFace& face, double error);

}  // namespace cfree
