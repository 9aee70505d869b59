// Contact surfaces of grown shapes as a pose has them at its orientation: sides, heights of ends, places on a surface.
#pragma once
#include "cfree/free/point_location.hpp"
#include "predicates/round_junction.hpp"

namespace cfree {

class RoundView {
public:
    // tau_lo, tau_hi: doubles around the orientation.
    RoundView(const Scene& scene, const ExactPose& pose, double tau_lo, double tau_hi);

    // 1 left of a line or inside a circle, where space is forbidden; 0 on it.
    int side(const Feature& contact);
    // Sign of the height of a curve's end on a surface minus the pose's.
    int height(const Feature& contact, const Feature& curve, bool is_after);
    // True if the pose is right of a point of a quadrant that is as high.
    bool is_right_of(const Feature& circle);
    // True if the pose, which is on the line or the circle, is between two curves of a surface, ends included.
    bool is_between(const Feature& contact, const Feature& lower, const Feature& upper, bool is_after);
    // Sign of an angle minus the pose's.
    int order(LongRoot angle) const;

private:
    template <class K>
    MovingVector<K> from(const Feature& contact) const;  // W times the vector from its site to the pose
    template <class F>
    int sign(const F& form);
    // Value of a form of integers at the orientation, times the rotation's denominator.
    Int value(const Trig<RootSum>& form) const;

    const Scene& scene;
    const ExactPose& pose;
    Between near;
    Vec<Ball> place;
    RoundJunction at;
};

}  // namespace cfree
