#include "cfree/planning/off_contacts.hpp"

#include "check.hpp"
#include "shapes.hpp"

using namespace cfree;

// A bar of 2 x 1 above a floor with a step: ways of one that is smaller by less than a hundredth.
int main() {
    const auto scene = scene_of({{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, {{{-9, -2}, {9, -2}, {9, 0}, {-9, 0}}, {{4, 0}, {9, 0}, {9, 3}, {4, 3}}});
    const MotionChecker checker(scene);
    FoundSlides slides;
    const FreeMotions motions(*scene, checker, slides);
    const auto at = [](const Ratio& x, const Ratio& y) { return RationalPose{x, y, {}}; };
    const Ratio low{-1, 100}, in{201, 100};
    const RationalPose start = at(Ratio{0}, Ratio{1}), goal = at(Ratio{1}, Ratio{4});

    const Poses free{start, at(Ratio{1}, Ratio{0}), start};
    CHECK(off_contacts(free, motions) == std::optional(free));  // touching is free

    const auto found = off_contacts({start, at(Ratio{0}, low), at(in, low), at(in, Ratio{4}), goal}, motions);
    CHECK(found && motions.join(*found) && found->front() == start && found->back() == goal);

    CHECK(!off_contacts({at(Ratio{0}, Ratio{0}), at(Ratio{3}, Ratio{0}), at(Ratio{7}, Ratio{4})}, motions));  // through the step
    return failures != 0;
}
