// Limits of trapezoids: the points of their curves on their line, or circle, at an orientation, in doubles, from the scene's frame.
#pragma once
#include <array>

#include "cfree/contact/contact_line.hpp"
#include "cfree/forbidden/boundary.hpp"

namespace cfree {

class Limits {
public:
    explicit Limits(const Boundary& of) : boundary(of), scene(of.scene->near()), unit(scene.is_round ? scene.unit() : 0) {}

    // Limits of t of a trapezoid, lower and upper, at an orientation in its chart.
    std::array<double, 2> of(Index trapezoid, double tau) const;

    // P + t U, moved outwards where shapes are grown; or a quadrant of a circle about P, where t is the tangent of half the angle
    // from its beginning.
    struct Line {
        Vec<double> p, u;
        double radius = 0;
        int quadrant = -1;
        bool is_circle() const { return quadrant >= 0; }
        Vec<double> at(double t) const;
    };
    Line line(const Feature& contact, const Rotation<double>& r) const;
    struct Meeting {
        double t, sine;  // absolute sine of the angle between the two lines; 1 at joints
    };
    std::array<Meeting, 2> meetings(Index trapezoid, double theta) const;  // the same, with sines
    Meeting meets(const Feature& contact, const Line& l, std::uint64_t curve, const Rotation<double>& r) const;
    // Orientation a little inside a trapezoid: curves may have no value at its ends.
    static double inside(double tau, double from, double to);

private:
    std::array<Meeting, 2> crossings(Index trapezoid, double tau) const;
    double helix_at(const Feature& contact, const Feature& helix) const;
    Line round_line(const Feature& contact, const Rotation<double>& r) const;
    Meeting meets_round(const Feature& contact, const Line& l, const Feature& curve, const Rotation<double>& r) const;

    const Boundary& boundary;
    const Scene& scene;
    double unit;  // of radii, in the user's units
};

}  // namespace cfree
