// A scene, and what is computed of it once.
#include "world.hpp"

#include <cmath>

#include "cfree/support/elementary.hpp"
#include "reading.hpp"

namespace cfree {

namespace {

// How far a core reaches from the origin, with its arcs, about.
double reach_of(const Polygon& core, const Rounding& rounding) {
    double most = 0;
    for (Index k = 0; k < core.vertices.size(); ++k)
        most = std::max(most, norm(nearest(core.vertices.X(k), core.denominator), nearest(core.vertices.Y(k), core.denominator)));
    const auto about = [](const RatioPoint& p) { return Vec<double>{nearest(p.x.n, p.x.d), nearest(p.y.n, p.y.d)}; };
    for (const Arc& arc : rounding.arcs) {
        const Vec<double> from = about(arc.from), to = about(arc.to), centre = about(arc.centre);
        const bool is_farthest_on_arc = cross(from - centre, centre) >= 0 && cross(centre, to - centre) >= 0;
        if (is_farthest_on_arc) most = std::max(most, norm(centre.x, centre.y) + nearest(arc.radius.n, arc.radius.d));
    }
    return most + nearest(rounding.radius.n, rounding.radius.d);
}

double radius_of(const SceneShapes& shapes) {
    double most = 0;
    for (std::size_t k = 0; k < shapes.robot.size(); ++k) most = std::max(most, reach_of(*shapes.robot[k], rounding_of(shapes.robot_rounding, k)));
    return most;
}

// The scene of shapes whose features are those of the user's shapes.
std::shared_ptr<KnownScene> drawn(const NearShapes& near) {
    auto features = std::make_shared<SceneFeatures>(scene_features(near.shapes));
    for (const auto& [owners, numbers] : {std::pair{&features->robot, &near.part_of}, {&features->obstacles, &near.obstacle_of}})
        for (Index& polygon : owners->polygon)
            if (polygon >= 0) polygon = (*numbers)[static_cast<std::size_t>(polygon)];
    auto checker = std::make_shared<const MotionChecker>(features->scene);
    return std::make_shared<KnownScene>(std::move(features), std::move(checker));
}

// The scene of polygons inside of shapes that decide themselves.
std::shared_ptr<KnownScene> decided(const Rounds& rounds, const NearShapes& near) {
    auto features = std::make_shared<const SceneFeatures>(scene_features(near.shapes));
    auto checker = std::make_shared<const MotionChecker>(features->scene, rounds.motions);
    return std::make_shared<KnownScene>(std::move(features), std::move(checker), near.off);
}

}  // namespace

World::World(std::shared_ptr<const Rounds> given, NearShapes made, bool is_drawn)
    : shapes(made.shapes), rounds(std::move(given)), near(std::move(made)), known(is_drawn ? drawn(*near) : decided(*rounds, *near)),
      features(*known->features), scene(features.scene), checker(known->checker), radius(radius_of(shapes)),
      planner(std::make_unique<Planner>(known, radius)) {}

World::World(SceneShapes given)
    : shapes(std::move(given)), known(KnownScene::of(shapes)), features(*known->features), scene(features.scene), checker(known->checker),
      radius(radius_of(shapes)), planner(std::make_unique<Planner>(known, radius)) {}

void World::trim(const std::function<void(double)>& share, const SharedBoundary& reuse) {
    if (boundary) return;
    boundary = compute_boundary(scene, {1, false, [&](double done) { return share(0.5 * done), Wish::go_on; }, {}, reuse});
    slicer = std::make_unique<const Slicer>(boundary);
    share(0.5);
}

void World::compute_cells(const std::function<void(double)>& share) {
    if (space) return;
    cells = glue(boundary);
    share(0.9);
    space = FreeSpace::of(*cells);
}

double World::clearance(const Place& at) const {
    if (rounds) {
        const HalfAngle half = half_angle_of(at.theta, false);
        const double distance = rounds->poses.distance({ratio_of(at.x), ratio_of(at.y), half.q, half.p, at.theta}, 1e300).low;
        return distance + nearest(rounds->asked.clearance.n, rounds->asked.clearance.d);
    }
    const double unit = scene->unit();
    return std::max(0.0, known->nearness().distance({at.x / unit, at.y / unit, at.theta}, HUGE_VAL)) * unit;
}

void World::need_boundary() const {
    if (!boundary) throw std::invalid_argument("the boundary is not computed yet");
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
