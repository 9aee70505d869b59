// The search for paths, flat: poses are (hx, hy, x, y, unit), integers; see configuration.hpp.
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include "cfree/search/balance.hpp"
#include "cfree/search/rrt_connect.hpp"
#include "cfree/search/shortcut.hpp"
#include "integers.hpp"
#include "watched.hpp"

namespace nb = nanobind;
using namespace nb::literals;

using PoseIntegers = std::array<nb::int_, 5>;
using Numbers = std::array<double, 3>;

static cfree::Costs costs_of(const std::array<double, 4>& c) { return {c[0], c[1], c[2], c[3]}; }

static cfree::Configuration configuration(const PoseIntegers& n, const Numbers& place) {
    return {integer(n[0]), integer(n[1]), integer(n[2]), integer(n[3]), integer(n[4]), place[0], place[1], place[2]};
}

static cfree::Route route_of(const std::vector<PoseIntegers>& poses, const std::vector<Numbers>& places) {
    cfree::Route route;
    for (std::size_t k = 0; k < poses.size(); ++k) route.push_back(configuration(poses[k], places.at(k)));
    return route;
}

using PoseTuple = std::tuple<nb::int_, nb::int_, nb::int_, nb::int_, nb::int_>;

static std::vector<PoseTuple> list_of(const cfree::Route& route) {
    std::vector<PoseTuple> poses;
    for (const auto& q : route) poses.emplace_back(integer(q.hx), integer(q.hy), integer(q.x), integer(q.y), integer(q.unit));
    return poses;
}

void bind_search(nb::module_& m) {
    nb::class_<cfree::RrtConnect>(m, "RrtConnect")
        .def("__init__", [](cfree::RrtConnect* search, const cfree::MotionChecker& checker, std::array<int, 3> grid,
                            std::array<double, 4> area, double weight, const PoseIntegers& start, const Numbers& start_at,
                            const PoseIntegers& goal, const Numbers& goal_at, std::uint64_t seed) {
            const auto joins = [&checker](const auto& a, const auto& b) { return checker.is_free(cfree::motion_between(a, b)); };
            new (search) cfree::RrtConnect(joins, {grid[0], grid[1], grid[2]}, {area[0], area[1], area[2], area[3]},
                                           weight, configuration(start, start_at), configuration(goal, goal_at), seed);
        }, "checker"_a, "grid"_a, "area"_a, "weight"_a, "start"_a, "start_at"_a, "goal"_a, "goal_at"_a, "seed"_a,
           nb::keep_alive<1, 2>())
        .def("run", [](cfree::RrtConnect& search, int checks) {
            cfree::Route route;
            {
                nb::gil_scoped_release release;
                route = search.run(checks);
            }
            return list_of(route);
        }, "checks"_a);
    nb::class_<cfree::Nearness>(m, "Nearness")
        .def("__init__", [](cfree::Nearness* n, std::shared_ptr<const cfree::Scene> scene) { new (n) cfree::Nearness(*scene); }, "scene"_a);
    nb::class_<cfree::Shortcut>(m, "Shortcut")
        .def("__init__", [](cfree::Shortcut* s, const cfree::MotionChecker& checker, std::array<int, 3> grid, std::array<double, 4> costs,
                            const std::vector<PoseIntegers>& poses, const std::vector<Numbers>& places, std::uint64_t seed) {
            cfree::Way way{checker, nullptr, {grid[0], grid[1], grid[2]}, {}, costs_of(costs)};
            new (s) cfree::Shortcut(std::move(way), {route_of(poses, places), std::vector<double>(poses.size())}, seed);
        }, "checker"_a, "grid"_a, "costs"_a, "poses"_a, "places"_a, "seed"_a, nb::keep_alive<1, 2>())
        .def("run", &cfree::Shortcut::run, "checks"_a, nb::call_guard<nb::gil_scoped_release>())
        .def("length", &cfree::Shortcut::length)
        .def("path", [](const cfree::Shortcut& s) { return list_of(s.path()); });
    m.def("balanced", [](const cfree::MotionChecker& checker, const cfree::Nearness& nearness, std::array<int, 3> grid,
                         std::array<double, 4> limits, std::array<double, 4> costs, const std::vector<PoseIntegers>& poses,
                         const std::vector<Numbers>& places, std::uint64_t seed) {
        const cfree::Route route = route_of(poses, places);
        const cfree::Way start{checker, &nearness, {grid[0], grid[1], grid[2]}, {limits[0], limits[1], limits[2], limits[3]}, costs_of(costs)};
        return watched([&] {
            auto [way, path] = cfree::balanced(start, route);
            return std::make_unique<cfree::Shortcut>(std::move(way), std::move(path), seed);
        });
    }, "checker"_a, "nearness"_a, "grid"_a, "limits"_a, "costs"_a, "poses"_a, "places"_a, "seed"_a,
       nb::keep_alive<0, 1>(), nb::keep_alive<0, 2>());
}
