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

    const RationalPose before = at(Ratio{0}, Ratio{0}), beyond = at(Ratio{7}, Ratio{4}), last = at(Ratio{8}, Ratio{4});
    CHECK(!off_contacts({before, at(Ratio{3}, Ratio{0}), beyond}, motions));  // through the step
    // a search leads around it, to the pose after it or to a later one
    const Poses around{before, at(Ratio{0}, Ratio{4}), beyond};
    const auto to_the_next = [&](const RationalPose&, const RationalPose& to) { return to == beyond ? std::optional(around) : std::nullopt; };
    CHECK(off_contacts({before, at(Ratio{3}, Ratio{0}), beyond, last}, motions, to_the_next) == std::optional(Poses{before, around[1], beyond, last}));
    const auto to_the_last = [&](const RationalPose& from, const RationalPose& to) {
        return to == last ? std::optional(Poses{from, around[1], last}) : std::nullopt;
    };
    CHECK(off_contacts({before, at(Ratio{3}, Ratio{0}), beyond, last}, motions, to_the_last) == std::optional(Poses{before, around[1], last}));
    CHECK(!off_contacts({before, at(Ratio{3}, Ratio{0}), beyond}, motions, to_the_last));  // no search leads to the end
    return failures != 0;
}
