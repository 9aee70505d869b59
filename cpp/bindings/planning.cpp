// Ways along the boundary of a cell. A pose is (x, y, p / q) as (numerator, denominator) of x and of y, and q, p: integers.
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "cfree/planning/connecting_way.hpp"
#include "integers.hpp"
#include "watched.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using cfree::BoundaryWalker, cfree::Connecting, cfree::Connection, cfree::Feature, cfree::Surroundings, cfree::RationalPose, cfree::Poses;

using PoseTuple = std::tuple<nb::int_, nb::int_, nb::int_, nb::int_, nb::int_, nb::int_>;

static RationalPose pose(const std::array<nb::int_, 6>& n) {
    const auto at = [&](std::size_t k) { return integer(n[k]); };
    return {{at(0), at(1)}, {at(2), at(3)}, {at(4), at(5)}};
}
static PoseTuple tuple_of(const RationalPose& q) {
    return {integer(q.x.n), integer(q.x.d), integer(q.y.n), integer(q.y.d), integer(q.half.q), integer(q.half.p)};
}
static std::vector<PoseTuple> list_of(const Poses& way) {
    std::vector<PoseTuple> poses;
    for (const auto& q : way) poses.push_back(tuple_of(q));
    return poses;
}

// A pose and (x, y, theta), the same rounded.
using End = std::pair<std::array<nb::int_, 6>, std::array<double, 3>>;
static BoundaryWalker::End end(const End& given) {
    const auto [x, y, theta] = given.second;
    return {pose(given.first), {x, y, theta}};
}

// slide(from, to, contact, curve) tells whether one leads there.
using Slide = nb::typed<nb::callable, bool(PoseTuple, PoseTuple, std::array<int, 3>, std::uint64_t)>;

// Poses of a way that asks Python for slides.
template <class Find>
static std::vector<PoseTuple> with_slides(const Slide& slide, Find&& find) {
    Raised raised;
    const cfree::Slides slides = [&](const RationalPose& from, const RationalPose& to, const Feature& contact, std::uint64_t curve) {
        const nb::gil_scoped_acquire lock;
        try {
            const std::array<int, 3> on{static_cast<int>(contact.kind), contact.robot, contact.obstacle};
            return nb::cast<bool>(slide(tuple_of(from), tuple_of(to), on, curve));
        } catch (nb::python_error& error) {
            raised.keep(std::move(error));
            throw cfree::Stopped();
        }
    };
    try {
        return list_of(watched([&] { return find(slides); }));
    } catch (const cfree::Stopped&) {
        raised.rethrow();
        throw;
    }
}

static std::vector<PoseTuple> walk(const BoundaryWalker& walker, const End& start, const End& goal, int cell, const Slide& slide) {
    const auto first = end(start), last = end(goal);
    return with_slides(slide, [&](const cfree::Slides& slides) { return walker.walk(first, last, cell, slides); });
}

// A face, and whether its last angle is meant or its first.
using EndOfFace = std::pair<int, bool>;
static std::optional<std::vector<PoseTuple>> turn(const BoundaryWalker& walker, const EndOfFace& from, const EndOfFace& to, int attempts) {
    const auto found = watched([&] { return walker.turn({from.first, from.second}, {to.first, to.second}, attempts); });
    if (!found) return {};
    return list_of(*found);
}

static void bind_surroundings(nb::module_& m) {
    nb::enum_<Connection::Verdict>(m, "Verdict")
        .value("OPEN", Connection::Verdict::open)
        .value("UNCLEAR", Connection::Verdict::unclear)
        .value("APART", Connection::Verdict::apart)
        .value("JOINED", Connection::Verdict::joined);
    nb::class_<Surroundings>(m, "Surroundings")
        .def(nb::init<std::shared_ptr<const cfree::Scene>, std::shared_ptr<const cfree::MotionChecker>, bool>(), "scene"_a,
             "checker"_a, "regularized"_a)
        .def_prop_ro("trimmed_patches", &Surroundings::trimmed_patches);
    nb::class_<Connecting>(m, "Connecting")
        .def("__init__", [](Connecting* of, std::shared_ptr<Surroundings> around, const std::array<nb::int_, 6>& start,
                            const std::array<nb::int_, 6>& goal) {
            new (of) Connecting(std::move(around), pose(start), pose(goal));
        }, "around"_a, "start"_a, "goal"_a)
        .def("run", [](Connecting& of, int most) { watched([&] { return of.run(most), 0; }); }, "most"_a)
        .def("run_around", [](Connecting& of, int end) { watched([&] { return of.run_around(end), 0; }); }, "end"_a)
        .def_prop_ro("verdict", [](const Connecting& of) { return of.found().verdict; })
        .def_prop_ro("inside", [](const Connecting& of) { return of.found().inside; })
        .def_prop_ro("surface", [](const Connecting& of) { return of.found().surface; })
        .def("way", [](const Connecting& of, double angle_scale, const Slide& slide) {
            return with_slides(slide, [&](const cfree::Slides& slides) {
                return cfree::connecting_way(*of.around, of.found(), angle_scale, slides);
            });
        }, "angle_scale"_a, "slide"_a);
}

void bind_planning(nb::module_& m) {
    bind_surroundings(m);
    nb::class_<BoundaryWalker>(m, "BoundaryWalker")
        .def(nb::init<std::shared_ptr<const cfree::FreeSpace>, std::shared_ptr<const cfree::CellComplex>,
                      std::shared_ptr<const cfree::MotionChecker>, double>(),
             "space"_a, "cells"_a, "checker"_a, "angle_scale"_a)
        .def("walk", &walk, "start"_a, "goal"_a, "cell"_a, "slide"_a)
        .def("turn", &turn, "start"_a, "goal"_a, "attempts"_a);
}
