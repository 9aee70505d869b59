// Slice of a built boundary at one orientation: a look-up yields the contact segments; a chain of them is the outline of the
// forbidden region. All is in doubles, as the boundary has the exact decisions. At a critical angle it is the slice of the
// orientations just after.
#pragma once
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

    // Closed outlines, forbidden on the left: counter-clockwise around a part, clockwise around a hole in it. Arcs have chords over
    // at most this angle, in radians.
    static constexpr double chord = 0.02;
    struct Rings {
        std::vector<double> xy;
        std::vector<Index> start;  // first point of each ring, and the end
        std::vector<Index> shell;  // a hole's ring around it, -1 if none; a part's own number
        // Radius of the arc from each point to the next that is no point of a chord; 0: a segment, `in_arc`: a point of a chord.
        std::vector<double> bend;
        static constexpr double in_arc = -1;
    };
    Rings rings(int chart, double tau) const;

    const Limits& limits() const { return lines; }
    // t along the curve of an isolated part, on the patch that names it.
    void isolated_curve(Index part, const double* tau, std::size_t count, double* t) const;

private:
    using Turn = Rotation<double>;
    using Line = Limits::Line;
    Segments near(int chart, double tau) const;
    void move(std::vector<double>& xy, const Turn& r) const;
    void step_off_events(int& chart, double& tau) const;

    struct Name {  // name of a point of the outline: its helix, or the two surfaces that meet there
        Code first, second;
        int branch = 0;
        bool operator==(const Name& o) const { return first == o.first && second == o.second && branch == o.branch; }
    };
    struct Hash {
        std::size_t operator()(const Name& x) const {
            return (x.first * 0x9e3779b97f4a7c15u) ^ ((x.second + 0x7f4a7c15u) * 0xc2b2ae3d27d4eb4fu) ^ static_cast<std::size_t>(x.branch);
        }
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
