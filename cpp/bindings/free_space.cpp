// Cells, and where poses are among them. A pose is (X, Y, W, p, r), integers: the position over W, tau = p / r.
#include "cfree/free/cell_facts.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "cfree/planning/rational_pose.hpp"
#include "given_poses.hpp"
#include "watched.hpp"

using namespace nb::literals;
using cfree::FreeSpace, cfree::Surfaces;
using PoseIntegers = std::array<nb::int_, 5>;
constexpr int forbidden = -1, no_cell = -2;

static cfree::ExactPose pose_of(const PoseIntegers& n, int chart) {
    return {integer(n[0]), integer(n[1]), integer(n[2]), chart, integer(n[3]), integer(n[4])};
}

static std::tuple<nb::int_, unsigned, nb::int_, unsigned> angle(const FreeSpace& space, int trapezoid, bool last, unsigned bits) {
    const auto [lo, hi] = space.points().angle(trapezoid, last, bits);
    return {integer(lo.n), lo.k, integer(hi.n), hi.k};
}

static std::tuple<std::vector<int>, std::vector<std::int8_t>, std::vector<int>, bool> numbers_of(cfree::PointLocation::Nearby x) {
    return {std::move(x.on), std::move(x.end), std::move(x.crossed), x.generic};
}

static Made<int> locate(const FreeSpace& space, const In<double, 2>& xy, const Column<int>& chart, const Column<double>& tau,
                        int threads) {
    const std::size_t n = tau.shape(0);
    require(xy.shape(0) == n && xy.shape(1) == 2 && chart.shape(0) == n, "xy, chart and tau differ in length");
    std::vector<int> found(n);
    watched([&] { space.locate(xy.data(), chart.data(), tau.data(), n, threads, found.data()); });
    return array_of(std::move(found));
}

// The cell of one pose, in doubles or as a `Pose`; -1 if it is forbidden, -2 if it is in the closure of none. None where
// Python has to decide whether it is within the limits, and for other poses.
static std::optional<int> locate_one(const FreeSpace& space, const cfree::PoseChecker& checker, nb::handle pose) {
    const auto numbers = doubles_of(pose);
    if (!numbers && length(pose) >= 0) return {};
    if (numbers && checker.is_free((*numbers)[0], (*numbers)[1], (*numbers)[2]) == false) return forbidden;
    const auto given = numbers ? given_pose(*numbers) : given_pose(pose);
    if (!given) return {};
    if (!numbers) {
        const auto is_free = checker.is_free(*given, false);
        if (!is_free) return {};
        if (!*is_free) return forbidden;
    }
    const cfree::RationalPose exact{given->x, given->y, {given->q, given->p}};
    const int cell = space.locate(exact.exact(*space.boundary->scene));
    return cell == forbidden ? no_cell : cell;
}

static void bind_surfaces(nb::module_& m) {
    nb::class_<Surfaces> surfaces(m, "Surfaces");
    surfaces.def("__init__", [](Surfaces* s, Column<int> component, Column<int> parent, Column<std::uint8_t> free_inside) {
        new (s) Surfaces{vector_of(component), vector_of(parent), vector_of(free_inside)};
    }, "component"_a, "parent"_a, "free_inside"_a);
    column(surfaces, "component", &Surfaces::component);
    column(surfaces, "parent", &Surfaces::parent);
    column(surfaces, "free_inside", &Surfaces::free_inside);
}

static void bind_location(nb::module_& m) {
    using cfree::PointLocation;
    using Found = std::tuple<int, nb::int_, nb::int_, bool>;
    nb::class_<PointLocation>(m, "PointLocation")
        .def("__init__", [](PointLocation* x, const cfree::SharedBoundary& boundary) {
            new (x) PointLocation(boundary, std::vector<cfree::Index>(boundary->trapezoids.size(), 0));
        }, "boundary"_a)
        .def("beside", [](const PointLocation& x, int trapezoid, int attempt, int closer) {
            using Integers = std::tuple<nb::int_, nb::int_, nb::int_, nb::int_, nb::int_>;
            using Answer = std::optional<std::tuple<Integers, Integers, int, bool>>;
            const auto found = x.beside(trapezoid, attempt, closer);
            if (!found) return Answer();
            const auto numbers = [](const cfree::ExactPose& q) {
                return Integers{integer(q.X), integer(q.Y), integer(q.W), integer(q.p), integer(q.r)};
            };
            const auto& [ray, beyond] = *found;
            return Answer({numbers(ray.pose), numbers(beyond), ray.pose.chart, ray.is_on_left});
        }, "trapezoid"_a, "attempt"_a, "closer"_a)
        .def("nearby", [](const PointLocation& x, const PoseIntegers& pose, int chart) {
            return numbers_of(x.nearby(pose_of(pose, chart)));
        }, "pose"_a, "chart"_a)
        .def("pose_on", [](const PointLocation& x, int trapezoid, int attempt) {
            using Answer = std::optional<std::tuple<std::tuple<nb::int_, nb::int_, nb::int_, nb::int_, nb::int_>, int, bool>>;
            const auto found = x.pose_on(trapezoid, attempt);
            if (!found) return Answer();
            const auto& q = found->first;
            return Answer({{integer(q.X), integer(q.Y), integer(q.W), integer(q.p), integer(q.r)}, q.chart, found->second});
        }, "trapezoid"_a, "attempt"_a)
        .def("passages", [](const PointLocation& x, const PoseIntegers& pose, int chart, int own) -> std::optional<std::vector<Found>> {
            const auto found = x.passages(pose_of(pose, chart), own);
            if (!found) return {};
            std::vector<Found> all;
            for (const auto& c : *found) all.emplace_back(c.trapezoid, integer(c.n), integer(c.d), c.is_free_before);
            return all;
        }, "pose"_a, "chart"_a, "own"_a);
}

void bind_free_space(nb::module_& m) {
    bind_surfaces(m);
    bind_location(m);
    const auto ints = [](const std::vector<int>& values) { return Made<const int>(values.data(), {values.size()}); };
    nb::class_<FreeSpace>(m, "FreeSpace")
        .def("__init__", [](FreeSpace* space, cfree::SharedBoundary boundary, const Surfaces& surfaces) {
            new (space) FreeSpace(std::move(boundary), surfaces);
        }, "boundary"_a, "surfaces"_a)
        .def_ro("surfaces", &FreeSpace::surfaces)
        .def_prop_ro("cell_of", [ints](const FreeSpace& space) { return ints(space.cell_of); })
        .def_prop_ro("depth", [ints](const FreeSpace& space) { return ints(space.depth); })
        .def("volumes", [](const FreeSpace& space) {
            auto found = cfree::volumes(space);
            return std::tuple{array_of(std::move(found.values)), array_of(std::move(found.errors))};
        })
        .def("caged", [](const FreeSpace& space, const Column<int>& owner) { return array_of(cfree::caged(space, vector_of(owner))); }, "owner"_a)
        .def("angle", &angle, "trapezoid"_a, "last"_a, "bits"_a)
        .def("nearby", [](const FreeSpace& space, const PoseIntegers& pose, int chart) {
            return numbers_of(space.points().nearby(pose_of(pose, chart)));
        }, "pose"_a, "chart"_a)
        .def("cells_at", [](const FreeSpace& space, const PoseIntegers& pose, int chart) {
            return space.cells_at(pose_of(pose, chart));
        }, "pose"_a, "chart"_a)
        .def("locate_exactly", [](const FreeSpace& space, const PoseIntegers& pose, int chart) {
            return space.locate(pose_of(pose, chart));
        }, "pose"_a, "chart"_a)
        .def("locate_one", &locate_one, "checker"_a, "pose"_a)
        .def("locate", &locate, "xy"_a, "chart"_a, "tau"_a, "threads"_a);
    m.def("fluxes", [](const cfree::SharedBoundary& boundary, const In<double, 2>& origins) {
        require(origins.shape(0) == boundary->trapezoids.size() && origins.shape(1) == 2, "a point for each trapezoid");
        std::vector<cfree::Vec<double>> points;
        for (std::size_t k = 0; k < origins.shape(0); ++k) points.push_back({origins.data()[2 * k], origins.data()[2 * k + 1]});
        auto found = watched([&] { return cfree::fluxes(*boundary, points); });
        return std::tuple(array_of(std::move(found.values)), array_of(std::move(found.errors)));
    }, "boundary"_a, "origins"_a);
    m.def("turns_of", [](const cfree::CellComplex& cells) {
        auto found = watched([&] { return cfree::turns_of(cells); });
        return std::tuple(array_of(std::move(found.turns)), array_of(std::move(found.lift)));
    }, "cells"_a);
    m.def("free_space", [](const cfree::CellComplex& cells) { return watched([&] { return FreeSpace::of(cells); }); }, "cells"_a);
}
