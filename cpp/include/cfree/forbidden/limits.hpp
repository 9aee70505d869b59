// Limits of trapezoids: the points of their curves on their line at an orientation, in doubles, from the scene's frame.
#pragma once
#include <array>

#include "cfree/contact/contact_line.hpp"
#include "cfree/forbidden/boundary.hpp"

namespace cfree {

class Limits {
public:
    explicit Limits(const Boundary& of) : boundary(of), scene(of.scene->near()) {}

    // Limits of t of a trapezoid, lower and upper, at an orientation in its chart.
    std::array<double, 2> of(Index trapezoid, double tau) const;

    struct Line {
        Vec<double> p, u;
        Vec<double> at(double t) const { return {p.x + t * u.x, p.y + t * u.y}; }
    };
    Line line(const Feature& contact, const Rotation<double>& r) const;
    struct Meeting {
        double t, sine;  // absolute sine of the angle between the two lines
    };
    std::array<Meeting, 2> meetings(Index trapezoid, double theta) const;  // the same, with sines
    Meeting meets(const Feature& contact, const Line& l, std::uint64_t curve, const Rotation<double>& r) const;
    // Orientation a little inside a trapezoid: curves may have no value at its ends.
    static double inside(double tau, double from, double to);

private:
    std::array<Meeting, 2> crossings(Index trapezoid, double tau) const;
    double helix_at(const Feature& contact, const Feature& helix) const;

    const Boundary& boundary;
    const Scene& scene;
};

}  // namespace cfree
