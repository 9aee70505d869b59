// A built boundary at one orientation: a look-up, then the contact segments; chained, the outline of the forbidden region.
// Doubles throughout: what is where was decided before. At a critical angle the slice is that of the orientations just after.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "cfree/forbidden/columns.hpp"
#include "cfree/forbidden/tau_index.hpp"

namespace cfree {

class Slicer {
public:
    // Coordinates in the user's units, from places near by: what comes out is moved by shift[0..1] - R shift[2..3]. Limits of tau
    // are the middles of the isolating intervals.
    Slicer(std::shared_ptr<const Scene> scene, std::vector<double> robot_xy, std::vector<double> obstacle_xy,
           Patches patches, std::vector<Index> patch, std::vector<std::uint8_t> chart, std::vector<std::uint64_t> lower,
           std::vector<std::uint64_t> upper, std::vector<double> tau_from, std::vector<double> tau_to,
           std::array<double, 4> shift);

    struct Segments {
        std::vector<double> xy;         // x0, y0, x1, y1: forbidden on the left
        std::vector<Index> trapezoid;
    };
    Segments segments(int chart, double tau) const;

    // Closed outlines, forbidden on the left: counter-clockwise around a part, clockwise around a hole in it.
    struct Rings {
        std::vector<double> xy;
        std::vector<Index> start;  // of each ring in points, and the end
        std::vector<Index> shell;  // a hole's ring around it, -1 if none; a part's own number
    };
    Rings rings(int chart, double tau) const;

    // Limits of t for trapezoids at orientations, one each.
    void limits(const Index* trapezoid, const int* chart, const double* tau, std::size_t count, double* lower,
                double* upper) const;

private:
    struct Turn {
        double c, s;
    };
    struct Line {
        double px, py, ux, uy;
    };
    static Turn turn(int chart, double tau);
    Segments near(int chart, double tau) const;
    void move(std::vector<double>& xy, Turn r) const;
    Line line(Index patch, Turn r) const;
    struct Meeting {
        double t, sine;  // of the angle between the two lines, at least in size
    };
    Meeting meets(Index patch, const Line& l, std::uint64_t curve, Turn r) const;
    std::uint64_t name(std::uint64_t packed_feature) const;

    std::shared_ptr<const Scene> scene;
    std::vector<double> a, b;
    Patches patches;
    std::vector<Index> patch;
    std::vector<std::uint8_t> chart;
    std::vector<std::uint64_t> lower, upper;
    std::vector<double> tau_from, tau_to;
    TauIndex index;
    std::array<double, 4> shift;
    void step_off_events(int& chart, double& tau) const;
};

}  // namespace cfree
