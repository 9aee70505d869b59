// A scene, and what is computed of it once.
#include "world.hpp"

#include <cmath>

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

}  // namespace

World::World(SceneShapes given)
    : shapes(std::move(given)), known(KnownScene::of(shapes)), features(*known->features), scene(features.scene), checker(known->checker),
      radius(radius_of(shapes)), planner(std::make_unique<Planner>(known, radius)) {}

void World::compute(const std::function<void(double)>& share) {
    boundary = compute_boundary(scene, {1, false, [&](double done) { return share(0.5 * done), Wish::go_on; }});
    share(0.5);
    cells = glue(boundary);
    share(0.9);
    space = FreeSpace::of(*cells);
    slicer = std::make_unique<const Slicer>(boundary);
}

double World::clearance(const Place& at) const {
    const double unit = scene->unit();
    return std::max(0.0, known->nearness().distance({at.x / unit, at.y / unit, at.theta}, HUGE_VAL)) * unit;
}

void World::need_space() const {
    if (!space) throw std::invalid_argument("the boundary is not computed yet");
}

std::pair<const ContactSlide*, bool> slide_between(const std::vector<ContactSlide>& slides, const RationalPose& a, const RationalPose& b) {
    for (const auto& slide : slides) {
        if (slide.from == a && slide.to == b) return {&slide, false};
        if (slide.from == b && slide.to == a) return {&slide, true};
    }
    return {nullptr, false};
}

}  // namespace cfree
