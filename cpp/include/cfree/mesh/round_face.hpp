// Faces of the boundary among grown shapes, lines and circles, for meshes; theory, "Meshes among rounded shapes".
//
// A point of a face has a position s along its line or, on a circle, s = psi, the angle from the beginning of its quadrant. Points
// of a triangle are compared with the face's point at the means of s and phi of the corners.
#pragma once
#include <array>
#include <optional>

#include "cfree/contact/round_curve.hpp"
#include "cfree/mesh/mesh_face.hpp"

namespace cfree {

// Shares of the error that the rim may take: its chords in the plane of (s, phi), and the sheet over one of its chords.
inline constexpr double on_rim = 0.25, over_chord = 0.35;

class RoundFace {
public:
    RoundFace(const Places& places, const Feature& on, const Feature& lower, const Feature& upper, double from, double to,
              double error, double angle_scale);

    MeshPoint point(double s, double phi) const { return {s, phi, {0, 0}}; }
    double position(Complex x, double phi) const;
    Complex at(double s, double phi) const;
    // Proved bound: at most 1 if every point of the triangle is within `error` of the face, as far as its rim is.
    double excess(const Corners& corners) const;
    // True if a chord between two points of a curve, and the sheet over it, take no more than their shares of the error.
    bool is_close(const MeshPoint& p, const MeshPoint& q, bool upper) const;
    double side_step() const;  // greatest step along a side
    double bow(double from, double to, bool upper) const;  // in the scene's unit
    double estimate() const;   // number of triangles
    double least() const;      // number of e-v triangles at the best known density

    // Coordinates in which triangles are about equilateral.
    double u(double s) const { return s / unit; }
    double s(double u) const { return unit * u; }

    bool is_thin() const { return to - from < 1e-9; }

    bool is_circle, is_saddle;  // `is_saddle`: u and phi are the net's coordinates
    double from, to, shear = 0;
    std::array<RoundCurve, 2> curves;

private:
    double within(const Corners& corners) const;  // bound of the distance from the sheet's point at the means

    double eps, w, unit = 1;
    std::optional<MeshSheet> line;
    Complex a = 0, b = 0;
    double radius = 0, begin = 0, side = 1;  // of a circle; -1 if s counts clockwise
};

}  // namespace cfree
