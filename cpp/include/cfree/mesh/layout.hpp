// Layouts of points over a twisted face that waste none at its curves; theory, "How few triangles".
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
    std::array<int, 2> parts{};                // parts of the first and the last side; 0: set by `ends`
    std::array<std::vector<Point>, 2> ends;    // points next to these sides
    double stretch = 1, lean = 0;              // coordinates in which triangles are about equilateral
    double triangles = 0;                      // approximate number, 0 if nothing is laid out
    bool is_empty() const { return triangles == 0; }
};

// Largest number of triangles that are not laid out.
inline constexpr double few_triangles = 4;
// Stretch without a layout, and for large h, where the shear varies less.
inline constexpr double usual_stretch = 1.6;
inline constexpr double best_density = 0.21650635094610965;  // sqrt(3) / 8: triangles per unit of w du dphi / error
// Cost, in triangles of neighbours, of a point that they do not need.
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
// Points between two places on a side that all faces there need.
std::vector<double> wall_points(const std::vector<Wall>& walls, double error, double from, double to);

// Greatest step on one of the face's curves, or on both, at which chords take at most their share of the error.
double rim_step(const MeshFace& face, double error, double phi, int which);
double rim_step(const MeshFace& face, double error, double phi);

// Layout in rows: every second row goes from curve to curve along a ruling; rows between have one point fewer, half-way.
Layout rows_across(const MeshFace& face, double error);
// Layout in columns from side to side along curves like the face's, each shifted against the one before.
Layout columns_along(const MeshFace& face, double error);
// Layout in columns with the points wanted on a curve; empty if that is not possible.
Layout columns_along(const MeshFace& face, double error, const Wanted& wanted);
// Layout in a lattice of best triangles, with losses at the rim; off the surface to make them larger, if `free` is set.
Layout lattice_over(const MeshFace& face, double error, bool free);
// Better layout of rows and columns, or an empty one if a lattice is better; with a neighbour's points if they cost little.
Layout best_layout(const MeshFace& face, double error, const std::optional<Wanted>& wanted);

// Measured number of triangles that a lattice needs.
double triangles_of_lattice(const MeshFace& face, double error);
// Number of triangles of the best known density on a face, 0 without twist.
double least_triangles(const MeshFace& face, double error);

}  // namespace cfree
