// Compute boundary, surfaces and cells when needed; theory, "Cells" and "Separations".
#include "cfree/planning/known_scene.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "cfree/support/phase.hpp"

namespace cfree {

namespace {

std::int64_t count_of(const std::vector<char>& flags) { return std::count_if(flags.begin(), flags.end(), [](char c) { return c != 0; }); }

// Closed surfaces around a cell.
std::set<Index> around_cell(const Built& built, Index cell) {
    const FreeSpace& space = *built.space;
    const Surfaces& surfaces = space.surfaces;
    std::set<Index> found;
    for (std::size_t k = 0; k < space.cell_of.size(); ++k) {
        if (space.cell_of[k] != cell || !surfaces.free_inside[k]) continue;
        for (Index next = static_cast<Index>(k); next >= 0; next = surfaces.parent[next]) found.insert(next);
        break;
    }
    return found;
}

// Compute a boundary, and report the share done; throws if time is up.
SharedBoundary computed(const std::shared_ptr<const Scene>& scene, bool regularized, const Listener& listener,
                        const std::shared_ptr<const Built>& former = {}) {
    const Deadline deadline(listener);
    const auto* flag = stop_flag;
    const auto watch = [&](double share) {
        if ((listener.go_on && !listener.go_on(share)) || (flag && *flag)) return Wish::cancel;
        return deadline.is_over() ? Wish::finish : Wish::go_on;
    };
    auto found = compute_boundary(scene, {listener.threads, regularized, watch, {}, former ? former->boundary : nullptr});
    if (!found->is_complete()) deadline.heed();
    if (listener.go_on && !listener.go_on(1)) throw Stopped();
    return found;
}

}  // namespace

Barrier barrier_of(const CellComplex& surface) {
    std::vector<Index> all(surface.component.size());
    std::iota(all.begin(), all.end(), 0);
    return {surface.boundary, std::move(all)};
}

Index Built::common_cell(const RationalPose& start, const RationalPose& goal) const {
    const auto first = space->cells_at(start.exact(*boundary->scene)), second = space->cells_at(goal.exact(*boundary->scene));
    Index found = -1;
    for (const Index cell : first)
        if (cell >= 0 && (found < 0 || cell < found) && std::find(second.begin(), second.end(), cell) != second.end()) found = cell;
    return found;
}

KnownScene::KnownScene(std::shared_ptr<const SceneFeatures> made, std::shared_ptr<const MotionChecker> by, double most_off,
                       std::shared_ptr<const ArcPoseChecker> true_shapes)
    : features(std::move(made)), checker(std::move(by)), slack(most_off), round(std::move(true_shapes)) {
    if (!shapes().workspace) return;
    const Shape& O = scene().obstacles;
    for (Index k = 0; k < O.ring_vertices; ++k) {
        const Int &x = O.X[k], &y = O.Y[k];
        if (O.layer[k] != body_layer) continue;
        if (!frame) frame = {x, y, x, y};
        auto& [x0, y0, x1, y1] = *frame;
        x0 = std::min(x0, x), y0 = std::min(y0, y), x1 = std::max(x1, x), y1 = std::max(y1, y);
    }
}

std::shared_ptr<KnownScene> KnownScene::of(const SceneShapes& shapes) {
    auto features = std::make_shared<const SceneFeatures>(scene_features(shapes));
    auto checker = std::make_shared<const MotionChecker>(features->scene);
    return std::make_shared<KnownScene>(std::move(features), std::move(checker));
}

// True if a pose is within the bounds, and not beyond the frame around the workspace.
bool KnownScene::is_within_limits(const RationalPose& pose) const {
    if (shapes().bounds) {
        const auto& [x0, y0, x1, y1] = *shapes().bounds;
        if (pose.x < x0 || pose.x > x1 || pose.y < y0 || pose.y > y1) return false;
    }
    if (!frame) return true;
    const auto& [x0, y0, x1, y1] = *frame;
    const auto R = pose.half.rotation();
    const ExactPose at = pose.exact(scene());
    const Int unit = at.W * R.w;
    for (const auto& part : shapes().robot) {
        const Int factor = scene().scale / part->denominator;
        const Int u = part->vertices.X(0) * factor, v = part->vertices.Y(0) * factor;
        const Int x = at.X * R.w + (R.c * u - R.s * v) * at.W, y = at.Y * R.w + (R.s * u + R.c * v) * at.W;
        if (x <= x0 * unit || x >= x1 * unit || y <= y0 * unit || y >= y1 * unit) return false;
    }
    return true;
}

bool KnownScene::is_free(const RationalPose& pose) const {
    const Configuration at = pose.configuration(scene());
    return is_within_limits(pose) && checker->is_free(motion_between(at, at));
}

std::int64_t KnownScene::patches() const {
    const Shape &A = scene().robot, &O = scene().obstacles;
    const auto size = [](const auto& column) { return static_cast<std::int64_t>(column.size()); };
    return count_of(A.convex) * size(O.convex) + size(A.convex) * count_of(O.convex);
}

const Nearness& KnownScene::nearness() const {
    const std::lock_guard guard(lock);
    if (!near) near = std::make_unique<const Nearness>(scene(), slack * nearest(scene().scale, power_of_two(scene().shift).n));
    return *near;
}

MotionGuess::IsForbidden KnownScene::looks() const {
    if (round) return [true_shapes = round](double x, double y, double theta) { return true_shapes->look(x, y, theta) == Verdict::forbidden; };
    return [looks = std::make_shared<PoseChecker::Looks>(poses())](double x, double y, double theta) { return looks->is_forbidden(x, y, theta); };
}

std::shared_ptr<const PoseChecker> KnownScene::poses() const {
    const std::lock_guard guard(lock);
    if (pose_checker) return pose_checker;
    constexpr double inf = std::numeric_limits<double>::infinity();
    std::array limits{-inf, -inf, inf, inf};
    if (shapes().bounds)
        for (std::size_t k = 0; k < 4; ++k) limits[k] = nearest((*shapes().bounds)[k].n, (*shapes().bounds)[k].d);
    return pose_checker = std::make_shared<const PoseChecker>(features->scene, limits);
}

const Area& KnownScene::box() const {
    const std::lock_guard guard(lock);
    if (around_all) return *around_all;
    constexpr double inf = std::numeric_limits<double>::infinity();
    around_all = {inf, inf, -inf, -inf};
    Area& all = *around_all;
    const auto add = [&](const Polygon& polygon) {
        for (Index k = 0; k < polygon.vertices.size(); ++k) {
            const double x = nearest(polygon.vertices.X(k), polygon.denominator), y = nearest(polygon.vertices.Y(k), polygon.denominator);
            all.x0 = std::min(all.x0, x), all.y0 = std::min(all.y0, y), all.x1 = std::max(all.x1, x), all.y1 = std::max(all.y1, y);
        }
    };
    if (shapes().workspace) add(*shapes().workspace);
    else
        for (const auto& obstacle : shapes().obstacles) add(*obstacle);
    return *around_all;
}

Connecting KnownScene::connecting(const RationalPose& start, const RationalPose& goal) {
    if (!around) around = std::make_shared<Surroundings>(features->scene, checker, may_have_slits(scene()));
    return {around, start, goal};
}

std::optional<Barrier> KnownScene::barrier(const RationalPose& start, const RationalPose& goal, const Listener& listener) {
    if (!built()) {
        const Deadline deadline(listener);
        Connecting found = connecting(start, goal);
        std::size_t trimmed = found.around->trimmed_patches();
        const auto verdict = found.decide([&](Index) {
            deadline.heed();
            const std::size_t before = std::exchange(trimmed, found.around->trimmed_patches());
            if (listener.spend) listener.spend(static_cast<std::int64_t>(trimmed - before));
            return true;
        });
        if (verdict == Connection::Verdict::joined) return {};
        if (verdict == Connection::Verdict::apart) return barrier_of(*found.found().surface);
    }
    const auto all = build(listener);
    if (all->common_cell(start, goal) >= 0) return {};
    const Index first = all->space->locate(start.exact(scene())), second = all->space->locate(goal.exact(scene()));
    if (first < 0 || second < 0) throw std::logic_error("poses that touch nothing are in no cell");
    return barrier_between(*all, first, second);
}

void KnownScene::take(const KnownScene& other) {
    former = other.built();
    if (!former) former = other.former;
    if (!other.around) return;
    around = std::make_shared<Surroundings>(features->scene, checker, may_have_slits(scene()));
    around->take(*other.around);
}

std::shared_ptr<const Built> KnownScene::built() const {
    const std::lock_guard guard(lock);
    return space;
}

void KnownScene::keep(std::shared_ptr<const Built> found) {
    const std::lock_guard guard(lock);
    space = std::move(found);
}

std::shared_ptr<const Built> KnownScene::build(const Listener& listener) {
    if (auto found = built()) return found;
    Built result;
    {
        const Phase phase(listener, "free space");
        if (listener.spend) listener.spend(patches());
        result.boundary = computed(features->scene, false, listener, former);
    }
    {
        const Phase phase(listener, "cells");
        const bool has_slits = may_have_slits(scene());
        if (has_slits) result.surfaces = glue(computed(features->scene, true, listener), listener.threads);
        else if (former) result.surfaces = glue(result.boundary, *former->surfaces, listener.threads);
        else result.surfaces = glue(result.boundary, listener.threads);
        result.space = FreeSpace::of(*result.surfaces);
    }
    former = nullptr;
    keep(std::make_shared<const Built>(std::move(result)));
    return built();
}

Barrier barrier_between(const Built& built, Index first, Index second) {
    const auto one = around_cell(built, first), other = around_cell(built, second);
    std::vector<Index> candidates;
    std::set_symmetric_difference(one.begin(), one.end(), other.begin(), other.end(), std::back_inserter(candidates));
    Barrier result{built.space->boundary, {}};
    if (candidates.empty()) return result;
    const auto& component = built.space->surfaces.component;
    const auto size = [&](Index k) { return std::count(component.begin(), component.end(), k); };
    Index chosen = candidates.front();
    auto least = size(chosen);
    for (const Index k : candidates)
        if (const auto n = size(k); n < least) least = n, chosen = k;
    for (std::size_t k = 0; k < component.size(); ++k)
        if (component[k] == chosen) result.faces.push_back(static_cast<Index>(k));
    return result;
}

}  // namespace cfree
