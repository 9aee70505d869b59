// Guess that a motion is free, for searches: none of some sampled poses is certainly forbidden.
#pragma once
#include <functional>

#include "cfree/search/configuration.hpp"

namespace cfree {

class MotionGuess {
public:
    // True if a pose is certainly forbidden, in the user's units, theta in [0, 2 pi]. For one thread.
    using IsForbidden = std::function<bool(double x, double y, double theta)>;
    // radius: the robot's, in the doubles of shapes; unit: factor from the user's lengths to these.
    MotionGuess(IsForbidden poses, double radius, double unit);
    bool operator()(const Place& a, const Place& b) const;

private:
    IsForbidden is_forbidden;
    double radius, unit;
};

}  // namespace cfree
