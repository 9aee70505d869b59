// Sample poses of a motion, coarse to fine: most forbidden motions are forbidden at one of the first.
#include "cfree/search/motion_guess.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"

namespace cfree {

constexpr double looks_in_radius = 16, most_looks = 4096;

MotionGuess::MotionGuess(IsForbidden poses, double r, double u) : is_forbidden(std::move(poses)), radius(r), unit(u) {}

bool MotionGuess::operator()(const Place& a, const Place& b) const {
    const double turn = std::abs(wrapped(b.theta - a.theta));
    const double length = norm(b.x - a.x, b.y - a.y) * (1 + turn * turn / 16) + radius * turn;  // approximate length of an arc
    const double parts = length / radius * looks_in_radius;
    const int count = parts < most_looks ? static_cast<int>(parts) + 1 : static_cast<int>(most_looks);
    return all_along(a, b, count, [this](const Place& q) {
        const double theta = wrapped(q.theta);
        return !is_forbidden(q.x / unit, q.y / unit, theta < 0 ? theta + 2 * std::numbers::pi : theta);
    });
}

}  // namespace cfree
