#include "cfree/search/motion_guess.hpp"

#include <limits>
#include <numbers>

#include "cfree/collision/pose_checker.hpp"
#include "check.hpp"
#include "shapes.hpp"

using namespace cfree;
using std::numbers::pi;

static MotionGuess guess_past(const std::vector<Ring>& obstacles) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    const auto scene = scene_of({{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, obstacles);
    const auto looks = std::make_shared<PoseChecker::Looks>(std::make_shared<const PoseChecker>(scene, std::array{-inf, -inf, inf, inf}));
    return {[looks](double x, double y, double theta) { return looks->is_forbidden(x, y, theta); }, 2.5, 1};
}

int main() {
    const MotionGuess seems_free = guess_past({{{5, -1}, {6, -1}, {6, 0}, {5, 0}}});
    CHECK(seems_free({0, 0, 0}, {9, 0, 0}));        // it touches
    CHECK(!seems_free({0, -0.1, 0}, {9, -0.1, 0}));
    CHECK(!seems_free({0, 5, 0}, {4, -0.5, 0}));    // the end
    CHECK(!seems_free({2, 0, 0}, {9, 0, pi / 2}));  // turning about a pole it comes lower than on the straight way
    CHECK(seems_free({2, 2, 0}, {9, 2, -pi / 2}));
    return failures != 0;
}
