// A scene, and what is computed of it once.
#include "world.hpp"

#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

double radius_of(const SceneShapes& shapes) {
    double most = 0;
    for (const auto& part : shapes.robot)
        for (Index k = 0; k < part->vertices.size(); ++k)
            most = std::max(most, norm(nearest(part->vertices.X[k], part->denominator), nearest(part->vertices.Y[k], part->denominator)));
    return most;
}

// In the bounds, and no further outside the workspace than the robot reaches.
std::optional<std::array<Ratio, 4>> limits_of(const SceneShapes& shapes) {
    auto limits = shapes.bounds;
    if (!shapes.workspace) return limits;
    Ratio reach;
    for (const auto& part : shapes.robot)
        for (Index k = 0; k < part->vertices.size(); ++k)
            reach = std::max(reach, reduced(abs(part->vertices.X[k]) + abs(part->vertices.Y[k]), part->denominator));
    const Polygon& room = *shapes.workspace;
    const auto [x0, x1] = std::minmax_element(room.vertices.X.begin(), room.vertices.X.end());
    const auto [y0, y1] = std::minmax_element(room.vertices.Y.begin(), room.vertices.Y.end());
    const auto at = [&](const Int& n) { return reduced(n, room.denominator); };
    const std::array<Ratio, 4> box{at(*x0) - reach, at(*y0) - reach, at(*x1) + reach, at(*y1) + reach};
    if (!limits) return box;
    for (std::size_t k = 0; k < 4; ++k) (*limits)[k] = k < 2 ? std::max((*limits)[k], box[k]) : std::min((*limits)[k], box[k]);
    return limits;
}

}  // namespace

World::World(SceneShapes given)
    : shapes(std::move(given)), known(KnownScene::of(shapes)), features(*known->features), scene(features.scene), checker(known->checker),
      radius(radius_of(shapes)), limits(limits_of(shapes)), planner(std::make_unique<Planner>(known, radius)) {}

void World::compute(const std::function<void(double)>& share) {
    boundary = compute_boundary(scene, {1, false, [&](double done) { return share(0.5 * done), Wish::go_on; }});
    share(0.5);
    cells = glue(boundary);
    share(0.9);
    space = FreeSpace::of(*cells);
    slicer = std::make_unique<const Slicer>(boundary);
}

void World::need_space() const {
    if (!space) throw std::invalid_argument("the boundary is not computed yet");
}

}  // namespace cfree
