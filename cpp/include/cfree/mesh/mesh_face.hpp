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

// Spread of a triangle's corners.
struct Spread {
    explicit Spread(const Corners& corners);
    double low, high, angle, reach, off;
    double slip() const { return off * angle / 2; }  // along the line, as normals turn
    double turn() const;                             // at most the angle's cosine
};

// Line of a contact at each angle, and bounds of distances within its slice.
class MeshSheet {
public:
    MeshSheet(const Places& places, const Feature& on, double first, double last, double error, double angle_scale);

    double position(Complex x, double phi) const;
    Complex at(double s, double phi, double off = 0) const;
    double gradient(double s) const;  // distance off the line per distance from an e-v surface
    double scale() const { return w; }
    // Four times the approximate distance of an edge from its e-v face.
    double form(const MeshPoint& p, const MeshPoint& q) const;
    // Bound of the distance off the line within a slice, over a triangle.
    double slice_distance(const Corners& corners, const Spread& d) const;
    // Bound of the difference between the position of a triangle's point and the mean of its corners' positions.
    double drift(const Spread& d) const;

    // True if its angles are too close for doubles. Then only its corners are known.
    bool is_thin() const { return to - from < 1e-9; }

    bool is_saddle;
    double from, to;  // angles
    double shear = 0;

protected:
    struct Wave;  // bounds along an edge
    Wave wave(const MeshPoint& p, const MeshPoint& q) const;
    double peak(const MeshPoint& p, const MeshPoint& q) const;

    double eps, w;
    Complex fixed, direction;  // e-v: b and the robot's edge; v-e: a and the obstacle's edge
    double h = 0;              // e-v: signed length of the perpendicular
    double offset = 0;         // v-e: n.b
};

// Sheet between two curves, among polygons.
class MeshFace : public MeshSheet {
public:
    MeshFace(const Places& places, const Feature& on, const Feature& lower, const Feature& upper, double from, double to,
          double error, double angle_scale);

    MeshPoint point(double s, double phi) const;         // a point of the face, up to rounding
    MeshPoint point_inside(double s, double phi) const;  // nearest to s between the curves
    // Proved bound: at most 1 if every point of the triangle is within `error` of the face.
    double excess(const Corners& corners) const;
    // Proved bound for an e-v triangle far from the face's sides.
    double excess_inside(const Corners& corners) const;

    // Coordinates in which an e-v edge (dx, dy) is off by w |dx dy| / 4, about: u = arsinh(s / w) + shear * phi, and phi.
    double u(double s) const { return std::asinh(s / w); }
    double s(double u) const { return w * std::sinh(u); }
    double width_u(double phi) const;  // width of the face at an angle
    double most_width_u() const { return most_width; }
    double height() const { return h; }

    std::array<ContactCurve, 2> curves;

private:
    double most_form(const Corners& corners) const;
    double third_order(const Spread& d) const;
    double beyond(const Corners& corners, const Spread& d) const;
    double slice_distance_near_sides(const Corners& corners, const Spread& d) const;

    double most_width = 0;
};

}  // namespace cfree
