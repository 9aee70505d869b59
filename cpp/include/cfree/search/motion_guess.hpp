// Whether a motion seems to be free: some poses of it are looked at, and none is certainly forbidden. What a search grows by.
#pragma once
#include "cfree/collision/pose_checker.hpp"
#include "cfree/search/configuration.hpp"

namespace cfree {

class MotionGuess {
public:
    // radius: of the robot, and unit: what lengths of the user are multiplied by, in the doubles of shapes. For one thread.
    MotionGuess(std::shared_ptr<const PoseChecker> checker, double radius, double unit);
    bool operator()(const Place& a, const Place& b) const;

private:
    bool is_forbidden(const Place& q) const;
    std::shared_ptr<PoseChecker::Looks> looks;
    double radius, unit;
};

}  // namespace cfree
