// Slice of a built boundary at one orientation: a look-up yields the contact segments; a chain of them is the outline of the
// forbidden region. All is in doubles, as the boundary has the exact decisions. At a critical angle it is the slice of the
// orientations just after.
#pragma once
#include <compare>
#include <span>
#include <vector>

#include "cfree/forbidden/limits.hpp"
#include "cfree/forbidden/tau_index.hpp"

namespace cfree {

class Slicer {
public:
    explicit Slicer(SharedBoundary boundary);

    struct Segments {
        std::vector<double> xy;         // x0, y0, x1, y1: forbidden on the left
        std::vector<Index> trapezoid;
        struct Arc {
            Vec<double> centre;
            double radius = 0, from = 0, to = 0;  // angles; a radius of 0 is a straight segment
        };
        std::vector<Arc> arcs;          // empty among polygons
    };
    Segments segments(int chart, double tau) const;

    // Closed outlines at many orientations, forbidden on the left: counter-clockwise around a part, clockwise around a hole in it. Arcs have chords over
    // at most this angle, in radians.
    static constexpr double chord = 0.02;
    struct Rings {
        std::vector<double> xy;
        std::vector<Index> start{0};  // first point of each ring, and the end
        std::vector<Index> shell;  // a hole's ring around it, -1 if none; a part's own number
        std::vector<Index> first{0};  // first ring of each orientation, and the end
        // Radius of the arc from each point to the next that is no point of a chord; 0: a segment, `in_arc`: a point of a chord.
        std::vector<double> bend;
        static constexpr double in_arc = -1e300;  // no radius
    };
    Rings rings(std::span<const int> chart, std::span<const double> tau) const;

    const Limits& limits() const { return lines; }
    // t along the curve of an isolated part, on the patch that names it.
    void isolated_curve(Index part, const double* tau, std::size_t count, double* t) const;

private:
    using Turn = Rotation<double>;
    using Line = Limits::Line;
    Segments near(int chart, double tau) const;
    void move(std::vector<double>& xy, std::size_t from, const Turn& r) const;
    void step_off_events(int& chart, double& tau) const;

    struct Name {  // name of a point of the outline: its helix, or the two surfaces that meet there
        Code first, second;
        int branch = 0;
        auto operator<=>(const Name&) const = default;
    };
    Name end_name(Index trapezoid, std::uint64_t curve) const;
    std::vector<Index> chained(const Segments& s) const;
    static std::vector<double> trace(const Segments& s, const std::vector<Index>& next, Rings& result);
    static void nest(Rings& rings, const std::vector<double>& area);

    SharedBoundary boundary;
    const Scene& scene;  // near
    const Limits lines;
    std::vector<double> tau_from, tau_to;  // middles of the isolating intervals
    TauIndex index;
};

}  // namespace cfree
