// Isolated parts of a boundary as paths: segments and points at one orientation, curves along two contacts.
#pragma once
#include "cfree/planning/face_graph.hpp"
#include "cfree/planning/free_motions.hpp"

namespace cfree {

struct Box;

// First or last angle of a trapezoid, in its chart, if it is rational.
std::optional<Ratio> rational_angle(const Boundary& boundary, Index trapezoid, bool last);

class ThinPart {
public:
    ThinPart(const Boundary& boundary, Index k);

    const Index number;
    const bool is_curve;  // else it is at one orientation
    const Sheet sheet;
    std::array<std::optional<Ratio>, 2> tau;          // its first and last orientation, if rational
    std::array<std::optional<RationalPose>, 2> ends;  // if rational
    std::array<Place, 2> rounded;                     // in doubles

    // Box around its positions, with a margin; for a curve from samples, only for proposals.
    Box box(double margin) const;
    // True if a pose is on it.
    bool holds(const RationalPose& pose) const;
    // Pose at which a segment or point meets another part at its orientation, unless they share a segment.
    std::optional<RationalPose> crossing(const ThinPart& other) const;
    // Path along it, from one pose on it to another.
    std::optional<Poses> way(const RationalPose& start, const RationalPose& goal, const FreeMotions& motions) const;

private:
    RationalPose at(const Ratio& there) const { return sheet.pose(sheet.limits(there).first, there); }
    std::optional<Ratio> local(const RationalPose& pose) const;  // tau in its chart
};

}  // namespace cfree
