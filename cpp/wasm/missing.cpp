// Bisection over the insets of a robot.
#include "missing.hpp"

#include <algorithm>
#include <cmath>

#include "cfree/polygons/inset.hpp"
#include "cfree/scene/coordinate_range.hpp"
#include "points.hpp"

namespace cfree {

using namespace rational;

namespace {

constexpr double guides = 0x1p-6;   // error of the polygons inside of round shapes, in parts of the robot's size
constexpr double tolerance = 0.01;  // of the interval, relative to its upper end
constexpr int halvings = 12, deeper = 6;  // to an inset that leaves something; steps from there to one that leaves nothing
constexpr int least = 24;           // halvings of the robot's size: the least inset that is tried

// A part whose arcs keep their centres. Nothing is left of a thin one; of shapes whose sides are arcs no inset is made.
std::optional<GivenShape> inset_of(const GivenShape& part, const Ratio& by) {
    GivenShape less = part;
    if (part.polygon) {
        less.grown = std::max(zero, part.grown - by);
        if (const Ratio rest = by - part.grown; rest > zero) {
            less.polygon = inset(*part.polygon, rest);
            if (!less.polygon) return {};
            less.rings.clear();
        }
        return less;
    }
    const auto circle = circle_of(part);
    if (!circle || circle->radius <= by) return {};
    less.rings.front() = circle_about(circle->center, circle->radius - by);
    return less;
}

}  // namespace

std::unique_ptr<World> smaller(const World& world, const Ratio& by) {
    if (!world.rounds) {
        SceneShapes shapes = world.shapes;
        for (auto& part : shapes.robot)
            if (part = inset(*part, by); !part) return {};
        if (range_fault(shapes)) return {};
        return std::make_unique<World>(std::move(shapes));
    }
    GivenScene scene = world.rounds->scene;
    scene.clearance = zero;
    for (GivenShape& part : scene.robot) {
        auto less = inset_of(part, by);
        if (!less) return {};
        part = std::move(*less);
    }
    const auto rounds = std::make_shared<const Rounds>(std::move(scene));
    return std::make_unique<World>(rounds, rounds->polygons(guides, false), false);
}

std::optional<Missing> missing(const World& world, const std::function<Joined(World&)>& joined) {
    const Ratio half{1, 2};
    enum class Tried { no, yes, unclear, too_deep };
    const auto tried = [&](const Ratio& by) {
        const auto robot = smaller(world, by);
        if (!robot) return Tried::too_deep;
        const Joined answer = joined(*robot);
        return answer == Joined::yes ? Tried::yes : answer == Joined::no ? Tried::no : Tried::unclear;
    };
    Missing found{zero, power_of_two(std::ilogb(world.radius)), true};
    Tried answer = Tried::too_deep;
    for (int k = 0; k < halvings && (answer = tried(found.hi)) == Tried::too_deep; ++k) found.hi = half * found.hi;
    // between an inset that is not enough, and one that leaves nothing
    Ratio top = found.hi + found.hi;
    for (int k = 0; k < deeper && answer != Tried::yes; ++k) {
        if (answer == Tried::no) found.lo = found.hi;
        else top = found.hi;
        found.hi = half * (found.lo + top);
        answer = tried(found.hi);
    }
    if (answer != Tried::yes) return {};
    while (near(found.hi - found.lo) > tolerance * near(found.hi) && near(found.hi) > std::ldexp(world.radius, -least)) {
        const Ratio middle = half * (found.lo + found.hi);
        const Tried there = tried(middle);
        found.is_proved = there != Tried::unclear;
        if (!found.is_proved) break;
        (there == Tried::yes ? found.hi : found.lo) = middle;
    }
    return found;
}

}  // namespace cfree
