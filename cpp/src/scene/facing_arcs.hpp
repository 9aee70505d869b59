// What convex arcs of one shape need where the other shape has concave arcs; theory, "Convex arcs in fillets".
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "cfree/scene/features.hpp"

namespace cfree {

// Radii in one shape, for the arcs of the other one. All are in order, each once.
struct FacingArcs {
    explicit FacingArcs(const std::vector<Rounding>& other);
    // Add another rounding of that shape; false if this changes nothing.
    bool add(const Rounding& rounding);
    bool has_concave() const { return !hollows.empty(); }

    std::vector<Ratio> discs;    // by which its parts are grown, and 0
    std::vector<Ratio> arcs;     // of its convex arcs
    std::vector<Ratio> hollows;  // of its concave arcs: the largest radii of discs that fit in
    // The greatest tangent of half the angle between two probes on a convex arc of the other shape; with concave arcs.
    Ratio step{1, 1};
    Ratio farthest{0, 1};  // at least the distance of a point beyond a concave arc from its centre, in radii of the arc
};

// The quadrangle of a concave arc's centre, its ends and the point beyond it; for convex arcs shrunk about the centre.
struct Quadrangle {
    Ratio radius;  // of the vertices for which it is meant
    bool is_for_arcs;
    std::array<RatioPoint, 4> corners;
};
std::vector<Quadrangle> quadrangles(const Arc& arc, const Ratio& grown, const FacingArcs& other);

// A triangle at a convex arc's centre, opposite of the arc: all directions of the arc, for places that a fillet can reach.
struct Wedge {
    Ratio hollow;  // radius of the concave arcs for which it is meant
    std::array<RatioPoint, 3> corners;
};
std::vector<Wedge> wedges(const Arc& arc, const Ratio& grown, const FacingArcs& other);

// Points of a convex arc between its ends: neighbours, and ends, are a step apart at most. None if no larger arc is concave.
std::vector<RatioPoint> probes(const Arc& arc, const Ratio& grown, const FacingArcs& other);

// All of these points of a rounding's arcs.
template <class Use>
void for_each_point(const Rounding& rounding, const FacingArcs& other, Use use) {
    const auto use_all = [&](const auto& figures) {
        for (const auto& figure : figures)
            for (const RatioPoint& p : figure.corners) use(p);
    };
    for (const Arc& arc : rounding.arcs) {
        if (arc.beyond) {
            use_all(quadrangles(arc, rounding.radius, other));
            continue;
        }
        use_all(wedges(arc, rounding.radius, other));
        for (const RatioPoint& p : probes(arc, rounding.radius, other)) use(p);
    }
}

}  // namespace cfree
