#include "cfree/collision/motion_checker.hpp"

#include "check.hpp"
#include "shapes.hpp"

using namespace cfree;

// A square between a floor and two corners: corridors as wide as it meet, less by `missing` of 1000.
static std::shared_ptr<const Scene> junction(int missing) {
    const int top = 2000 - missing;
    return scene_of({{{-1000, -1000}, {1000, -1000}, {1000, 1000}, {-1000, 1000}}},
                    {{{-9000, -100}, {9000, -100}, {9000, 0}, {-9000, 0}},
                     {{-9000, top}, {-1000, top}, {-1000, 9000}, {-9000, 9000}},
                     {{1000, top}, {9000, top}, {9000, 9000}, {1000, 9000}}});
}

static Motion translation(int x, int y, int dx, int dy) { return {1, 0, 1, x, y, 1, false, dx, dy, 1, 1, 0}; }
static Motion turn(int x, int y, int q, int p) { return {1, 0, 1, x, y, 1, true, x, y, 1, q, p}; }

static void touching_is_free() {
    const MotionChecker checker(junction(0));
    CHECK(checker.is_free(translation(-5000, 1000, 10000, 0)));
    CHECK(!checker.is_free(translation(-5000, 1001, 4000, 0)));
    CHECK(!checker.is_free(turn(0, 1000, 1000000, 1)));
    const auto stopped = checker.first_collision(translation(0, 2000, 0, -2000));
    CHECK(stopped && stopped->at.hi.rounded_up() >= 0.5 && stopped->at.lo.rounded_down() <= 0.5);
}

// A quarter turn: (x, y) = (2 t - 4 t^2 + 2 t^3, 2 t - 2 t^3) / (1 + t + t^2 + t^3), t = u, from (0, 1). One vertex stays on
// the floor, and one edge on the right corner.
static void two_contacts_slide() {
    const Slide slide{1, 0, 1, 1, 1, {0, 2000, -4000, 2000, 0}, {1000, 3000, 1000, -1000, 0}, {1, 1, 1, 1, 0}};
    CHECK(MotionChecker(junction(0)).is_free(slide));
    CHECK(!MotionChecker(junction(1)).is_free(slide));
    Slide lower = slide;
    for (int k = 0; k < 4; ++k) lower.x[k] *= 1000000, lower.d[k] *= 1000000, lower.y[k] = lower.y[k] * 1000000 - 1;
    CHECK(!MotionChecker(junction(-10)).is_free(lower));
}

static void translations_end_at_their_first_collision() {
    const MotionChecker checker(scene_of({{{-7, -5}, {9, -6}, {3, 8}}}, {{{-90, -60}, {80, -70}, {85, -50}, {-80, -40}},
                                                                         {{30, 30}, {60, 35}, {40, 70}}, {{-70, 10}, {-30, 0}, {-40, 60}}}));
    unsigned state = 1;
    const auto number = [&](int size) {
        state = state * 1664525u + 1013904223u;
        return static_cast<int>((state >> 16) % static_cast<unsigned>(2 * size + 1)) - size;
    };
    int stopped = 0, at_once = 0;
    for (int k = 0; k < 2000; ++k) {
        const int q = number(9), p = 1 + abs(number(9));
        const Motion move{q * q - p * p, 2 * q * p, q * q + p * p, number(100), number(100), 1, false, number(150), number(150), 1, 1, 0};
        const auto found = checker.first_collision(move);
        const auto share = checker.free_share(move);
        CHECK(found.has_value() == share.has_value());
        if (!found || !share) continue;
        ++(share->n.is_zero() ? at_once : stopped);
        if (found->kind == 0) CHECK(share->n.is_zero());
        else CHECK(found->at.p[0] * share->d + found->at.p[1] * share->n == 0);
    }
    CHECK(stopped > 100 && at_once > 100);
}

int main() {
    translations_end_at_their_first_collision();
    touching_is_free();
    two_contacts_slide();
    return failures != 0;
}
