// Ways along the boundary of a cell. A pose is (x, y, p / q) as (numerator, denominator) of x and of y, and q, p: integers.
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "cfree/planning/connecting_way.hpp"
#include "cfree/planning/exact_fits.hpp"
#include "integers.hpp"
#include "watched.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using cfree::BoundaryWalker, cfree::Connecting, cfree::Connection, cfree::ContactSlide, cfree::Feature, cfree::FoundSlides,
    cfree::Passages, cfree::Poses, cfree::RationalPose, cfree::Surroundings;

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

using Five = std::array<nb::int_, 5>;
// Poses from and to; kind, robot and obstacle feature of each contact; x, y, d; the half-angle tangent as q, p.
using SlideTuple = std::tuple<PoseTuple, PoseTuple, std::array<std::array<int, 3>, 2>, Five, Five, Five, nb::int_, nb::int_>;

static SlideTuple tuple_of(const ContactSlide& s) {
    const auto contact = [](const Feature& f) { return std::array{static_cast<int>(f.kind), f.robot, f.obstacle}; };
    const auto five = [](const auto& c) { return Five{integer(c[0]), integer(c[1]), integer(c[2]), integer(c[3]), integer(c[4])}; };
    return {tuple_of(s.from), tuple_of(s.to), {contact(s.contacts[0]), contact(s.contacts[1])}, five(s.x), five(s.y), five(s.d),
            integer(s.tau.d), integer(s.tau.n)};
}

// Poses, and the slides that join some of them.
using WayTuple = std::pair<std::vector<PoseTuple>, std::vector<SlideTuple>>;

static WayTuple way_of(const Poses& way, const FoundSlides& slides) {
    std::vector<SlideTuple> on_it;
    for (const auto& slide : slides.along(way)) on_it.push_back(tuple_of(slide));
    return {list_of(way), std::move(on_it)};
}

static WayTuple walk(const BoundaryWalker& walker, const End& start, const End& goal, int cell) {
    const auto first = end(start), last = end(goal);
    return way_of(watched([&] { return walker.walk(first, last, cell); }), *walker.slides);
}

static std::optional<WayTuple> path(Passages& passages, const std::array<nb::int_, 6>& start, const std::array<nb::int_, 6>& goal,
                                    bool irrational) {
    const auto first = pose(start), last = pose(goal);
    const auto found = watched([&] { return passages.path(first, last, irrational); });
    return found ? std::optional(way_of(*found, *passages.places.walker->slides)) : std::nullopt;
}

static Feature contact_of(const std::array<int, 3>& c) { return {static_cast<cfree::Kind>(c[0]), c[1], c[2]}; }

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
        .def("way", [](const Connecting& of, double angle_scale) {
            const auto slides = std::make_shared<FoundSlides>();
            const auto find = [&] { return cfree::connecting_way(*of.around, of.found(), angle_scale, slides); };
            return way_of(watched(find), *slides);
        }, "angle_scale"_a);
}

void bind_planning(nb::module_& m) {
    bind_surroundings(m);
    nb::class_<FoundSlides>(m, "FoundSlides").def(nb::init<>());
    nb::class_<BoundaryWalker>(m, "BoundaryWalker")
        .def(nb::init<std::shared_ptr<const cfree::FreeSpace>, std::shared_ptr<const cfree::CellComplex>,
                      std::shared_ptr<const cfree::MotionChecker>, double, std::shared_ptr<FoundSlides>>(),
             "space"_a, "cells"_a, "checker"_a, "angle_scale"_a, "slides"_a)
        .def("walk", &walk, "start"_a, "goal"_a, "cell"_a);
    nb::class_<Passages>(m, "Passages")
        .def("__init__", [](Passages* of, std::shared_ptr<const BoundaryWalker> walker,
                            std::shared_ptr<const cfree::CellComplex> slits) {
            watched([&] { return new (of) Passages(std::move(walker), std::move(slits)); });
        }, "walker"_a, "slits"_a.none())
        .def("path", &path, "start"_a, "goal"_a, "irrational"_a);
    m.def("slide_along", [](const cfree::Scene& scene, const std::array<nb::int_, 6>& from, const std::array<int, 3>& first,
                            const std::array<int, 3>& last, const nb::int_& q, const nb::int_& p) -> std::optional<SlideTuple> {
        const auto found = cfree::slide_along(scene, pose(from), contact_of(first), contact_of(last), {integer(p), integer(q)});
        return found ? std::optional(tuple_of(*found)) : std::nullopt;
    }, "scene"_a, "pose"_a, "first"_a, "last"_a, "q"_a, "p"_a);
    m.def("isolated_end", [](const cfree::Boundary& boundary, int part) -> std::optional<PoseTuple> {
        const auto end = cfree::ThinPart(boundary, part).ends[0];
        return end ? std::optional(tuple_of(*end)) : std::nullopt;
    }, "boundary"_a, "part"_a);
    m.def("middle_of", [](const cfree::Boundary& boundary, bool isolated, int row, const nb::int_& q, const nb::int_& p) {
        const auto& table = isolated ? boundary.isolated.parts : boundary.trapezoids;
        return tuple_of(cfree::middle_of(boundary, table, row, {integer(p), integer(q)}));
    }, "boundary"_a, "isolated"_a, "row"_a, "q"_a, "p"_a);
}
