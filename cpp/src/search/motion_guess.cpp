// Sample poses of a motion, coarse to fine: most forbidden motions are forbidden at one of the first.
#include "cfree/search/motion_guess.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"

namespace cfree {

constexpr double looks_in_radius = 16, most_looks = 4096;

MotionGuess::MotionGuess(std::shared_ptr<const PoseChecker> checker, double r, double u)
    : looks(std::make_shared<PoseChecker::Looks>(std::move(checker))), radius(r), unit(u) {}

MotionGuess::MotionGuess(std::shared_ptr<const ArcPoseChecker> checker, double r, double u) : arcs(std::move(checker)), radius(r), unit(u) {}

bool MotionGuess::operator()(const Place& a, const Place& b) const {
    const double turn = std::abs(wrapped(b.theta - a.theta));
    const double length = norm(b.x - a.x, b.y - a.y) * (1 + turn * turn / 16) + radius * turn;  // approximate length of an arc
    const double parts = length / radius * looks_in_radius;
    const int count = parts < most_looks ? static_cast<int>(parts) + 1 : static_cast<int>(most_looks);
    return all_along(a, b, count, [this](const Place& q) { return !is_forbidden(q); });
}

bool MotionGuess::is_forbidden(const Place& q) const {
    const double theta = wrapped(q.theta);
    const double x = q.x / unit, y = q.y / unit, turned = theta < 0 ? theta + 2 * std::numbers::pi : theta;
    return arcs ? arcs->is_certainly_forbidden(x, y, turned) : looks->is_forbidden(x, y, turned);
}

}  // namespace cfree
