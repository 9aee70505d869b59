// Guess that a motion is free, for searches: none of some sampled poses is certainly forbidden.
#pragma once
#include "cfree/arcs/pose_checker.hpp"
#include "cfree/search/configuration.hpp"

namespace cfree {

class MotionGuess {
public:
    // radius: the robot's, in the doubles of shapes; unit: factor from the user's lengths to these. For one thread.
    MotionGuess(std::shared_ptr<const PoseChecker> checker, double radius, double unit);
    // The same among segments and arcs.
    MotionGuess(std::shared_ptr<const ArcPoseChecker> checker, double radius, double unit);
    bool operator()(const Place& a, const Place& b) const;

private:
    bool is_forbidden(const Place& q) const;
    std::shared_ptr<PoseChecker::Looks> looks;
    std::shared_ptr<const ArcPoseChecker> arcs;  // instead of it
    double radius, unit;
};

}  // namespace cfree
