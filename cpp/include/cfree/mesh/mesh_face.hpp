// Face of the boundary for meshes: the contact surface, the two curves, and the bounds of a triangle's distance.
//
// At each angle the surface is a line; s is the position along it. On an e-v surface it counts from the foot of the
// perpendicular from the reference point, on a v-e surface from the origin. Letters are those of docs/theory/meshes.md.
#pragma once
#include <array>
#include <utility>

#include "cfree/contact/contact_curve.hpp"

namespace cfree {

struct MeshPoint {
    double s, phi;
    std::array<double, 2> inward;  // distance inside the lower and the upper curve
    Index vertex = -1;             // number in the mesh
    double off = 0;                // distance off the line, along its normal
};
// Share of the error that chords of the curves may take: strips need it below sqrt(1/2).
inline constexpr double on_curves = 0.7;

using Corners = std::array<const MeshPoint*, 3>;

class MeshFace {
public:
    MeshFace(const Places& places, const Feature& on, const Feature& lower, const Feature& upper, double from, double to,
          double error, double angle_scale);

    MeshPoint point(double s, double phi) const;         // a point of the face, up to rounding
    MeshPoint point_inside(double s, double phi) const;  // nearest to s between the curves
    double position(Complex x, double phi) const;
    Complex at(double s, double phi, double off = 0) const;
    double gradient(double s) const;  // distance off the line per distance from an e-v surface
    // Proved bound: at most 1 if every point of the triangle is within `error` of the face.
    double excess(const Corners& corners) const;
    // Proved bound for an e-v triangle far from the face's sides.
    double excess_inside(const Corners& corners) const;

    // Coordinates in which an e-v edge (dx, dy) is off by w |dx dy| / 4, about: u = arsinh(s / w) + shear * phi, and phi.
    double u(double s) const { return std::asinh(s / w); }
    double s(double u) const { return w * std::sinh(u); }
    double scale() const { return w; }
    double width_u(double phi) const;  // width of the face at an angle
    double most_width_u() const { return most_width; }
    double height() const { return h; }
    // Four times the approximate distance of an edge from its e-v face.
    double form(const MeshPoint& p, const MeshPoint& q) const;

    // True if its angles are too close for doubles. Then only its corners are known.
    bool is_thin() const { return to - from < 1e-9; }

    bool is_saddle;
    double from, to;      // angles
    double shear = 0;
    std::array<ContactCurve, 2> curves;

private:
    struct Spread;  // spread of a triangle's corners
    double most_form(const Corners& corners) const;
    double third_order(const Spread& d) const;
    double slice_distance(const Corners& corners, const Spread& d) const;
    double beyond(const Corners& corners, const Spread& d) const;
    double slice_distance_near_sides(const Corners& corners, const Spread& d) const;
    struct Wave;  // bounds along an edge
    Wave wave(const MeshPoint& p, const MeshPoint& q) const;
    double peak(const MeshPoint& p, const MeshPoint& q) const;

    double eps, w;
    Complex fixed, direction;  // e-v: b and the robot's edge; v-e: a and the obstacle's edge
    double h = 0;              // e-v: signed length of the perpendicular
    double offset = 0;         // v-e: n.b
    double most_width = 0;
};

}  // namespace cfree
