// Smaller robots and the surfaces around poses; theory, "Separations".
#include "cfree/planning/insets.hpp"

#include <algorithm>
#include <cmath>

#include "cfree/polygons/inset.hpp"
#include "cfree/scene/coordinate_range.hpp"

namespace cfree {

namespace {

constexpr int coarsest = 20, enough = 160;  // insets are 2^-20 of the robot's size and smaller

int size_of(const SceneShapes& shapes) {
    double size = 0;
    for (const std::size_t axis : {0, 1}) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const auto& part : shapes.robot) {
            const auto box = part->vertices.box();
            low = std::min(low, nearest(box[axis], part->denominator)), high = std::max(high, nearest(box[axis + 2], part->denominator));
        }
        size = std::max(size, high - low);
    }
    int exponent = 0;
    std::frexp(size, &exponent);
    return exponent;
}

std::vector<int> powers_of(const SceneShapes& shapes) {
    Int scale = 1;
    const auto include = [&](const Int& denominator) {
        if (scale % denominator != 0) scale = lcm(scale, denominator);
    };
    for (const auto* polygons : {&shapes.robot, &shapes.obstacles})
        for (const auto& polygon : *polygons) include(polygon->denominator);
    if (shapes.workspace) include(shapes.workspace->denominator);
    if (shapes.bounds)
        for (const Ratio& bound : *shapes.bounds) include(bound.d);
    const int deepest = enough + 4 * (static_cast<int>(msb(scale)) + 1);
    std::vector<int> result;
    for (int digits = coarsest; digits <= deepest; digits *= 2) result.push_back(-digits);
    return result;
}

}  // namespace

void enlarge_bounds(SceneShapes& shapes, const Ratio& by) {
    if (!shapes.bounds) return;
    auto& [x0, y0, x1, y1] = *shapes.bounds;
    x0 = x0 - by, y0 = y0 - by, x1 = x1 + by, y1 = y1 + by;
}

Insets::Insets(const SceneShapes& scene) : powers(powers_of(scene)), size(size_of(scene)), shapes(scene) {}

const Insets::Inner& Insets::at(int power) {
    const auto [it, is_new] = scenes.try_emplace(power);
    Inner& inner = it->second;
    if (!is_new) return inner;
    const Ratio by = power_of_two(size + power);
    SceneShapes smaller = shapes;
    smaller.robot.clear();
    for (const auto& part : shapes.robot)
        if (auto found = inset(*part, by)) smaller.robot.push_back(std::move(found));
    inner.is_whole = smaller.robot.size() == shapes.robot.size();
    enlarge_bounds(smaller, by);
    if (!smaller.robot.empty() && !range_fault(smaller)) inner.scene = KnownScene::of(std::move(smaller));
    return inner;
}

int Insets::first() {
    const std::lock_guard guard(lock);
    const auto found = std::find_if(powers.begin(), powers.end(), [&](int power) { return at(power).is_whole; });
    return found == powers.end() ? powers.front() : *found;
}

std::shared_ptr<KnownScene> Insets::scene(int power) {
    const std::lock_guard guard(lock);
    return at(power).scene;
}

void Insets::take(Insets& other) {
    const std::scoped_lock guard(lock, other.lock);
    for (const auto& [power, inner] : other.scenes) {
        const bool is_power = std::find(powers.begin(), powers.end(), power) != powers.end();
        if (size != other.size || !is_power || !inner.scene || !inner.scene->has_results()) continue;
        if (const auto& own = at(power).scene) own->take(*inner.scene);
    }
}

std::optional<Separation> Insets::closed(const RationalPose& start, const RationalPose& goal, int power, const Listener& listener) {
    const std::lock_guard guard(lock);
    const auto& inner = at(power).scene;
    if (!inner) return {};
    auto found = inner->barrier(start, goal, listener);
    if (!found) return {};
    return Separation{std::move(*found), inner, true};
}

Separation separation(const std::shared_ptr<const KnownScene>& scene, const Built& built, Insets& insets, const RationalPose& start,
                      const RationalPose& goal, const std::vector<int>& powers, const Listener& listener) {
    for (const int power : powers)
        if (auto found = insets.closed(start, goal, power, listener)) return std::move(*found);
    const auto cell = [&](const RationalPose& pose) { return built.space->locate(pose.exact(scene->scene())); };
    return {barrier_between(built, cell(start), cell(goal)), scene, false};
}

}  // namespace cfree
