// Boundaries of smaller rounded shapes, computed when they are needed; theory, "Rounded shapes", has the proofs.
#include "round_cells.hpp"

#include <algorithm>

namespace cfree {

namespace {

constexpr int least_digits = 100;          // least power of 1/2 by which discs are smaller; or twice the digits of the scene's numbers
constexpr std::int64_t most_work = 15'000;  // pairs of a patch and a pillar near it: some seconds
constexpr int patches_of_two = 6;          // vertices, about: an edge of each on the other one, and four quadrants

int bits(const Int& x) { return x.is_zero() ? 0 : static_cast<int>(msb(x)) + 1; }

// The most bits of a denominator among the numbers of a scene.
int digits(const SceneShapes& shapes) {
    int most = 0;
    const auto use = [&](const Int& denominator) { most = std::max(most, bits(denominator)); };
    for (const auto* polygons : {&shapes.robot, &shapes.obstacles})
        for (const auto& polygon : *polygons) use(polygon->denominator);
    for (const auto* all : {&shapes.robot_rounding, &shapes.obstacle_rounding})
        for (const Rounding& rounding : *all) use(rounding.radius.d);
    if (shapes.workspace) use(shapes.workspace->denominator);
    if (shapes.bounds)
        for (const Ratio& x : *shapes.bounds) use(x.d);
    return most;
}

// True if shapes are smaller everywhere once the discs of the robot, or of all obstacles, are. Among arcs as sides, and of
// several radii of the robot, the package checks no proof yet.
bool may_prove(const SceneShapes& shapes) {
    const auto has_arcs = [](const Rounding& rounding) { return !rounding.arcs.empty(); };
    const auto &robot = shapes.robot_rounding, &others = shapes.obstacle_rounding;
    if (std::any_of(robot.begin(), robot.end(), has_arcs) || std::any_of(others.begin(), others.end(), has_arcs)) return false;
    const Ratio& radius = robot.front().radius;
    if (std::any_of(robot.begin(), robot.end(), [&](const Rounding& part) { return part.radius != radius; })) return false;
    if (radius.n > 0) return true;
    return !shapes.workspace && !others.empty() && std::all_of(others.begin(), others.end(), [](const Rounding& other) { return other.radius.n > 0; });
}

// Shrink discs, and enlarge bounds, by a part of the least radius.
void shrink(SceneShapes& shapes) {
    auto& discs = shapes.robot_rounding.front().radius.n > 0 ? shapes.robot_rounding : shapes.obstacle_rounding;
    const Ratio by = power_of_two(-std::max(least_digits, 2 * digits(shapes))), left = Ratio{1, 1} - by;
    Ratio least = discs.front().radius;
    for (Rounding& rounding : discs) least = std::min(least, rounding.radius), rounding.radius = left * rounding.radius;
    if (!shapes.bounds) return;
    auto& [x0, y0, x1, y1] = *shapes.bounds;
    const Ratio more = by * least;
    x0 = x0 - more, y0 = y0 - more, x1 = x1 + more, y1 = y1 + more;
}

struct Box {
    double x0 = HUGE_VAL, y0 = HUGE_VAL, x1 = -HUGE_VAL, y1 = -HUGE_VAL;
    void add(const Shape& shape, Index v) {
        const double r = shape.radius_of(v).about.hi;
        x0 = std::min(x0, shape.x[v] - r), x1 = std::max(x1, shape.x[v] + r);
        y0 = std::min(y0, shape.y[v] - r), y1 = std::max(y1, shape.y[v] + r);
    }
};

// True if there are more pairs of a patch and a pillar near it, about, than cells are computed for.
bool is_too_much(const Scene& scene) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    Box robot;
    for (Index v = 0; v < A.ring_vertices; ++v) robot.add(A, v);
    std::vector<Box> pieces(static_cast<std::size_t>(O.pieces()));
    for (std::size_t k = 0; k < pieces.size(); ++k)
        for (Index v = O.piece[k]; v < O.piece[k + 1]; ++v) pieces[k].add(O, O.piece_vertex[static_cast<std::size_t>(v)]);
    const std::int64_t of_each = std::int64_t{patches_of_two} * A.ring_vertices * A.pieces();
    std::int64_t near = 0;
    for (Index e = 0; e < O.ring_vertices; ++e) {
        Box edge;
        edge.add(O, O.v[e]), edge.add(O, O.w[e]);
        for (const Box& piece : pieces) {
            const bool is_near = edge.x0 <= piece.x1 + robot.x1 - robot.x0 && piece.x0 <= edge.x1 + robot.x1 - robot.x0 &&
                                 edge.y0 <= piece.y1 + robot.y1 - robot.y0 && piece.y0 <= edge.y1 + robot.y1 - robot.y0;
            if (is_near && ++near * of_each > most_work) return true;
        }
    }
    return false;
}

std::shared_ptr<const Built> built(const SceneFeatures& features) {
    const auto boundary = compute_boundary(features.scene, {1, may_have_slits(*features.scene), [](double) { return Wish::go_on; }});
    const auto surfaces = glue(boundary);
    return std::make_shared<const Built>(Built{boundary, surfaces, FreeSpace::of(*surfaces)});
}

}  // namespace

std::optional<bool> joined_by_cells(const Rounds& rounds, const RationalPose& start, const RationalPose& goal) {
    const NearShapes exact = rounds.drawn(1);
    if (!exact.inexact.empty()) return {};
    const SceneFeatures features = scene_features(exact.shapes);
    if (is_too_much(*features.scene)) return {};
    return built(features)->common_cell(start, goal) >= 0;
}

std::unique_ptr<RoundCells> RoundCells::of(const Rounds& rounds) {
    NearShapes shapes = rounds.drawn(1);
    if (!shapes.inexact.empty() || !may_prove(shapes.shapes)) return {};
    shrink(shapes.shapes);
    auto known = KnownScene::of(shapes.shapes);
    if (is_too_much(known->scene())) return {};
    return std::unique_ptr<RoundCells>(new RoundCells(std::move(shapes), std::move(known)));
}

std::optional<Separation> RoundCells::proof(const RationalPose& start, const RationalPose& goal) const {
    if (!scene->built()) scene->keep(built(*scene->features));
    const auto cells = scene->built();
    if (cells->common_cell(start, goal) >= 0) return {};
    const Index first = cells->space->locate(start.exact(scene->scene())), second = cells->space->locate(goal.exact(scene->scene()));
    Barrier surface = barrier_between(*cells, first, second);
    if (surface.faces.empty()) return {};
    return Separation{std::move(surface), scene, true};
}

}  // namespace cfree
