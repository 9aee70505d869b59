// The search for paths, flat: poses are (hx, hy, x, y, unit), integers; see configuration.hpp.
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "cfree/search/rrt_connect.hpp"
#include "integers.hpp"

namespace nb = nanobind;
using namespace nb::literals;

using PoseIntegers = std::array<nb::int_, 5>;

static cfree::Configuration configuration(const PoseIntegers& n, const std::array<double, 3>& place) {
    return {integer(n[0]), integer(n[1]), integer(n[2]), integer(n[3]), integer(n[4]), place[0], place[1], place[2]};
}

using PoseTuple = std::tuple<nb::int_, nb::int_, nb::int_, nb::int_, nb::int_>;

static std::vector<PoseTuple> list_of(const cfree::Route& route) {
    std::vector<PoseTuple> poses;
    for (const auto& q : route) poses.emplace_back(integer(q.hx), integer(q.hy), integer(q.x), integer(q.y), integer(q.unit));
    return poses;
}

void bind_search(nb::module_& m) {
    using Numbers = std::array<double, 3>;
    nb::class_<cfree::RrtConnect>(m, "RrtConnect")
        .def("__init__", [](cfree::RrtConnect* search, const cfree::MotionChecker& checker, std::array<int, 3> grid,
                            std::array<double, 4> area, double weight, const PoseIntegers& start, const Numbers& start_at,
                            const PoseIntegers& goal, const Numbers& goal_at, std::uint64_t seed) {
            new (search) cfree::RrtConnect(checker, {grid[0], grid[1], grid[2]}, {area[0], area[1], area[2], area[3]},
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
    nb::class_<cfree::Shortcut>(m, "Shortcut")
        .def("__init__", [](cfree::Shortcut* s, const cfree::MotionChecker& checker, std::array<int, 3> grid, double weight,
                            const std::vector<PoseIntegers>& poses, const std::vector<Numbers>& places, std::uint64_t seed) {
            cfree::Route route;
            for (std::size_t k = 0; k < poses.size(); ++k) route.push_back(configuration(poses[k], places.at(k)));
            new (s) cfree::Shortcut(checker, {grid[0], grid[1], grid[2]}, weight, std::move(route), seed);
        }, "checker"_a, "grid"_a, "weight"_a, "poses"_a, "places"_a, "seed"_a, nb::keep_alive<1, 2>())
        .def("run", &cfree::Shortcut::run, "checks"_a, nb::call_guard<nb::gil_scoped_release>())
        .def("length", &cfree::Shortcut::length)
        .def("path", [](const cfree::Shortcut& s) { return list_of(s.path()); });
}
