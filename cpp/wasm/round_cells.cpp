// Boundaries of rounded shapes, computed when they are needed; theory, "Rounded shapes", has the proofs.
#include "round_cells.hpp"

#include <algorithm>

namespace cfree {

namespace {

constexpr int smaller = 100;        // power of 1/2 by which discs are smaller
constexpr Index most_pairs = 4000;  // of corners: some seconds

Index corners(const std::vector<std::shared_ptr<const Polygon>>& cores) {
    Index count = 0;
    for (const auto& core : cores) count += core->vertices.size();
    return count;
}

std::shared_ptr<const Built> built(const SceneFeatures& features) {
    const auto boundary = compute_boundary(features.scene, {1, false, [](double) { return Wish::go_on; }});
    const auto surfaces = glue(boundary);
    return std::make_shared<const Built>(Built{boundary, surfaces, FreeSpace::of(*surfaces)});
}

}  // namespace

std::unique_ptr<RoundCells> RoundCells::of(const Rounds& rounds) {
    NearShapes exact = rounds.drawn(1);
    const SceneShapes& shapes = exact.shapes;
    if (!exact.inexact.empty() || corners(shapes.robot) * corners(shapes.obstacles) > most_pairs) return {};
    return std::unique_ptr<RoundCells>(new RoundCells(std::move(exact)));
}

const RoundCells::Known& RoundCells::smaller_by(const Ratio& part) {
    if (const auto found = known.find(part); found != known.end()) return found->second;
    NearShapes less = near;
    const Ratio left = Ratio{1, 1} - part;
    for (Rounding& rounding : near.shapes.robot_radius().n > 0 ? less.shapes.robot_rounding : less.shapes.obstacle_rounding)
        rounding.radius = left * rounding.radius;
    auto scene = KnownScene::of(less.shapes);
    scene->keep(built(*scene->features));
    return known.emplace(part, Known{std::move(less), std::move(scene)}).first->second;
}

bool RoundCells::are_joined(const RationalPose& start, const RationalPose& goal) {
    return smaller_by({}).scene->built()->common_cell(start, goal) >= 0;
}

std::optional<RoundCells::Proof> RoundCells::proof(const RationalPose& start, const RationalPose& goal) {
    const SceneShapes& shapes = near.shapes;
    const auto& others = shapes.obstacle_rounding;
    const bool are_all = std::all_of(others.begin(), others.end(), [](const Rounding& rounding) { return rounding.radius.n > 0; });
    if (shapes.bounds || (shapes.robot_radius().n == 0 && (shapes.workspace || others.empty() || !are_all))) return {};
    const Known& less = smaller_by(power_of_two(-smaller));
    const auto cells = less.scene->built();
    if (cells->common_cell(start, goal) >= 0) return {};
    const Scene& scene = less.scene->scene();
    const Index first = cells->space->locate(start.exact(scene)), second = cells->space->locate(goal.exact(scene));
    Barrier surface = barrier_between(*cells, first, second);
    if (surface.faces.empty()) return {};
    return Proof{{std::move(surface), less.scene, true}, less.near};
}

}  // namespace cfree
