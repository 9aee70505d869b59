// Isolated parts of a boundary as ways: segments and points at one orientation, curves along two contacts.
#pragma once
#include "cfree/planning/face_graph.hpp"
#include "cfree/planning/free_motions.hpp"

namespace cfree {

struct Box;

// The first or last angle of a trapezoid, in its chart, if it is rational.
std::optional<Ratio> rational_angle(const Boundary& boundary, Index trapezoid, bool last);

class ThinPart {
public:
    ThinPart(const Boundary& boundary, Index k);

    const Index number;
    const bool is_curve;  // else it is at one orientation
    const Sheet sheet;
    std::array<std::optional<Ratio>, 2> tau;          // its first and last orientation, where they are rational
    std::array<std::optional<RationalPose>, 2> ends;  // where they are rational
    std::array<Place, 2> rounded;                     // in doubles

    // Around its positions, and a margin; of a curve by samples, to look near.
    Box box(double margin) const;
    // Is a pose on it?
    bool holds(const RationalPose& pose) const;
    // Where a segment or point meets another part at its orientation, if that is not a piece of both.
    std::optional<RationalPose> crossing(const ThinPart& other) const;
    // Along it, from one pose on it to another.
    std::optional<Poses> way(const RationalPose& start, const RationalPose& goal, const FreeMotions& motions) const;

private:
    RationalPose at(const Ratio& there) const { return sheet.pose(sheet.limits(there).first, there); }
    std::optional<Ratio> local(const RationalPose& pose) const;  // tau in its chart
};

}  // namespace cfree
