// Grids with few bits for random poses, and more for those on paths; theory, "Paths".
#include "cfree/planning/searcher.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cfree/search/balance.hpp"
#include "cfree/search/motion_guess.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

constexpr int place_bits = 24, angle_bits = 20;            // bits of random poses: few, for short integers
constexpr double beyond_slack = 4;                         // least factor of a meaningful distance to push a path to
constexpr int fine_place_bits = 40, fine_angle_bits = 36;  // bits of poses on paths

Area scaled(const Area& area, double by) { return {area.x0 * by, area.y0 * by, area.x1 * by, area.y1 * by}; }

Area area_of(const std::array<Ratio, 4>& bounds) {
    const auto at = [&](std::size_t k) { return nearest(bounds[k].n, bounds[k].d); };
    return {at(0), at(1), at(2), at(3)};
}

int extent_of(const Area& area) {
    const double size = std::max(area.x1 - area.x0, area.y1 - area.y0);
    int exponent = 0;
    std::frexp(size != 0 ? size : 1, &exponent);
    return exponent;
}

}  // namespace

Area search_area(const KnownScene& scene, std::span<const Place> poses, double radius) {
    const SceneShapes& shapes = scene.shapes();
    if (shapes.bounds) return area_of(*shapes.bounds);
    Area around = scene.box();
    for (const auto& [x, y, theta] : poses)
        around = {std::min(around.x0, x), std::min(around.y0, y), std::max(around.x1, x), std::max(around.y1, y)};
    const double margin = shapes.workspace ? 0 : 2 * radius;
    return {around.x0 - margin, around.y0 - margin, around.x1 + margin, around.y1 + margin};
}

Searcher::Searcher(std::shared_ptr<const KnownScene> of, std::span<const Place> poses, const Costs& given,
                   const std::optional<Place>& middle)
    : unit(nearest(of->scene().scale, power_of_two(of->scene().shift).n)), scene(std::move(of)),
      costs{given.weight * unit, given.sideways, given.backward, given.turning, {given.axle.x * unit, given.axle.y * unit, given.axle.theta}},
      area(scaled(search_area(*scene, poses, given.weight), unit)), extent(extent_of(area)) {
    if (middle) center = {middle->x * unit, middle->y * unit, 0};
}

Grid Searcher::grid(int of_places, int of_angles) const { return {scene->scene().shift, of_places - extent, of_angles}; }

Configuration Searcher::configuration(const End& end) const {
    Configuration found = end.pose.configuration(scene->scene());
    found.px = end.place.x * unit, found.py = end.place.y * unit;
    found.theta = std::remainder(end.place.theta, 2 * std::numbers::pi);
    return found;
}

Route Searcher::route(std::span<const End> way) const {
    Route result;
    for (const End& end : way) result.push_back(configuration(end));
    return result;
}

RrtConnect Searcher::search(const End& start, const End& goal, std::uint64_t seed, const Growth& growth) const {
    return search_in(area, start, goal, seed, growth);
}

RrtConnect Searcher::search_near(const End& start, const End& goal, double room) const {
    const Configuration a = configuration(start), b = configuration(goal);
    const double more = room * unit;
    return search_in({std::max(area.x0, std::min(a.px, b.px) - more), std::max(area.y0, std::min(a.py, b.py) - more),
                      std::min(area.x1, std::max(a.px, b.px) + more), std::min(area.y1, std::max(a.py, b.py) + more)},
                     start, goal, 0, {});
}

RrtConnect Searcher::search_in(const Area& within, const End& start, const End& goal, std::uint64_t seed, const Growth& growth) const {
    auto certainly = [checker = scene->checker](const Configuration& a, const Configuration& b) {
        heed_stop();
        return checker->is_free(motion_between(a, b));
    };
    const MotionGuess seems(scene->looks(), costs.weight, unit);
    return {{seems, std::move(certainly)}, grid(place_bits, angle_bits), within, costs.weight, configuration(start), configuration(goal), seed, growth};
}

Shortcut Searcher::shortener(std::span<const End> way, std::uint64_t seed) const {
    Way free{*scene->checker, nullptr, grid(fine_place_bits, fine_angle_bits), {}, costs, 0, center};
    return {std::move(free), {route(way), std::vector<double>(way.size())}, seed};
}

Shortcut Searcher::balanced(std::span<const End> way, std::uint64_t seed, double radii) const {
    constexpr double inf = std::numeric_limits<double>::infinity();
    const Area limits = scene->shapes().bounds ? scaled(area_of(*scene->shapes().bounds), unit) : Area{-inf, -inf, inf, inf};
    const Way start{*scene->checker, &scene->nearness(), grid(fine_place_bits, fine_angle_bits), limits, costs, 0, center};
    const double up_to = std::max(radii * costs.weight, beyond_slack * start.nearness->least());
    auto [asking, path] = cfree::balanced(start, route(way), up_to);
    return {std::move(asking), std::move(path), seed};
}

Poses Searcher::poses(const Route& found) const {
    Poses result;
    for (const Configuration& q : found) {
        const Int whole = q.unit * scene->scene().scale;
        result.push_back({reduced(q.x, whole), reduced(q.y, whole), HalfAngle::along(q.hx, q.hy)});
    }
    return result;
}

}  // namespace cfree
