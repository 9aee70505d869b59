// Planning for a scene and its poses: paths, surfaces between poses, all of the free space.
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>

#include "arrays.hpp"
#include "caller.hpp"
#include "cfree/planning/connecting_way.hpp"
#include "cfree/planning/planner.hpp"
#include "cfree/polygons/inset.hpp"
#include "rational_poses.hpp"

using namespace nb::literals;
using cfree::Built, cfree::Connecting, cfree::Connection, cfree::ContactSlide, cfree::Feature, cfree::FoundSlides, cfree::Insets,
    cfree::KnownScene, cfree::Planner, cfree::Poses, cfree::Separation;

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

static Feature contact_of(const std::array<int, 3>& c) { return {static_cast<cfree::Kind>(c[0]), c[1], c[2]}; }

// --- all of the free space ---

using Parts = std::tuple<cfree::SharedBoundary, std::shared_ptr<const cfree::CellComplex>, std::shared_ptr<const cfree::FreeSpace>>;

static Parts build(KnownScene& scene, const nb::object& who) {
    Caller caller(who);
    const auto found = caller.run([&] { return scene.build(caller.listener); });
    return {found->boundary, found->surfaces, found->space};
}

static void keep(KnownScene& scene, cfree::SharedBoundary boundary, std::shared_ptr<const cfree::CellComplex> surfaces,
                 std::shared_ptr<const cfree::FreeSpace> space) {
    scene.keep(std::make_shared<const Built>(Built{std::move(boundary), std::move(surfaces), std::move(space)}));
}

static std::optional<Separation> barrier(const std::shared_ptr<KnownScene>& scene, const PoseNumbers& start, const PoseNumbers& goal,
                                         const nb::object& who) {
    Caller caller(who);
    auto found = caller.run([&, first = pose_of(start), last = pose_of(goal)] { return scene->barrier(first, last, caller.listener); });
    if (!found) return {};
    return Separation{std::move(*found), scene, true};
}

// --- plans ---

static std::variant<WayTuple, Separation, std::string> plan(Planner& planner, const EndNumbers& start, const EndNumbers& goal,
                                                           const nb::object& who, bool few) {
    Caller caller(who);
    const auto most = few ? Planner::Effort::few_surfaces : Planner::Effort::all;
    const auto answer = caller.run([&, first = end_of(start), last = end_of(goal)] {
        return planner.plan(first, last, caller.listener, most);
    });
    if (const auto* way = std::get_if<cfree::Poses>(&answer)) return way_of(*way, *planner.slides);
    if (const auto* proof = std::get_if<Separation>(&answer)) return *proof;
    switch (std::get<Planner::Refused>(answer)) {
        case Planner::Refused::start: return "start";
        case Planner::Refused::goal: return "goal";
        case Planner::Refused::unclear: break;
    }
    return "unclear";
}

static std::optional<WayTuple> walk(Planner& planner, const EndNumbers& start, const EndNumbers& goal, const nb::object& who) {
    Caller caller(who);
    const auto way = caller.run([&, first = end_of(start), last = end_of(goal)] { return planner.walk(first, last, caller.listener); });
    return way ? std::optional(way_of(*way, *planner.slides)) : std::nullopt;
}

static std::optional<std::vector<PoseTuple>> quick(const Planner& planner, const EndNumbers& start, const EndNumbers& goal,
                                                   const nb::object& who, std::optional<int> guesses) {
    Caller caller(who);
    const auto way = caller.run([&, first = end_of(start), last = end_of(goal)] { return planner.quick(first, last, guesses); });
    if (!way) return {};
    return list_of(*way);
}

static Separation separation(const std::shared_ptr<const KnownScene>& scene, Insets& insets, const PoseNumbers& start,
                             const PoseNumbers& goal, const std::vector<int>& powers, const nb::object& who) {
    Caller caller(who);
    return caller.run([&, first = pose_of(start), last = pose_of(goal)] {
        return cfree::separation(scene, *scene->built(), insets, first, last, powers, caller.listener);
    });
}

static void bind_known_scene(nb::module_& m) {
    nb::register_exception_translator([](const std::exception_ptr& p, void*) {
        try {
            std::rethrow_exception(p);
        } catch (const cfree::TooLate& error) {
            const nb::object type = nb::module_::import_("cfree.errors").attr("IncompleteError");
            PyErr_SetObject(type.ptr(), type(error.what()).ptr());
        }
    });
    nb::enum_<Connection::Verdict>(m, "Verdict")
        .value("OPEN", Connection::Verdict::open)
        .value("UNCLEAR", Connection::Verdict::unclear)
        .value("APART", Connection::Verdict::apart)
        .value("JOINED", Connection::Verdict::joined);
    nb::class_<Connecting>(m, "Connecting")
        .def("decide", [](Connecting& of) {
            return watched([&] { return of.decide(); });
        })
        .def_prop_ro("inside", [](const Connecting& of) { return of.found().inside; })
        .def_prop_ro("surface", [](const Connecting& of) { return of.found().surface; })
        .def_prop_ro("trimmed_patches", [](const Connecting& of) { return of.around->trimmed_patches(); })
        .def("way", [](const Connecting& of, double angle_scale) {
            const auto slides = std::make_shared<FoundSlides>();
            const auto find = [&] { return cfree::connecting_way(*of.around, of.found(), angle_scale, slides); };
            return way_of(watched(find), *slides);
        }, "angle_scale"_a);
    nb::class_<KnownScene>(m, "KnownScene")
        .def(nb::init<std::shared_ptr<const cfree::SceneFeatures>, std::shared_ptr<const cfree::MotionChecker>, double,
                      std::shared_ptr<const cfree::ArcPoseChecker>>(), "features"_a, "checker"_a, "slack"_a = 0.0, "round"_a = nb::none())
        .def("keep", &keep, "boundary"_a, "surfaces"_a, "space"_a)
        .def("build", &build, "caller"_a)
        .def("connecting", [](KnownScene& scene, const PoseNumbers& start, const PoseNumbers& goal) {
            return scene.connecting(pose_of(start), pose_of(goal));
        }, "start"_a, "goal"_a)
        .def("barrier", &barrier, "start"_a, "goal"_a, "caller"_a);
}

static void bind_separations(nb::module_& m) {
    using Fraction = std::pair<nb::int_, nb::int_>;
    nb::class_<Separation>(m, "Separation")
        .def_ro("is_closed", &Separation::is_closed)
        .def_prop_ro("boundary", [](const Separation& s) { return s.surface.boundary; })
        .def_prop_ro("faces", [](const Separation& s) { return Made<const int>(s.surface.faces.data(), {s.surface.faces.size()}); })
        .def_prop_ro("features", [](const Separation& s) { return s.of->features; })
        .def_prop_ro("robot", [](const Separation& s) { return s.of->shapes().robot; })
        .def_prop_ro("bounds", [](const Separation& s) -> std::optional<std::vector<Fraction>> {
            if (!s.of->shapes().bounds) return {};
            std::vector<Fraction> found;
            for (const auto& bound : *s.of->shapes().bounds) found.emplace_back(integer(bound.n), integer(bound.d));
            return found;
        });
    nb::class_<Insets>(m, "Insets")
        .def("__init__", [](Insets* of, const cfree::SceneFeatures& features) { new (of) Insets(features.shapes); }, "features"_a)
        .def_ro("powers", &Insets::powers)
        .def_ro("size", &Insets::size)
        .def_prop_ro("known", &Insets::known);
    m.def("separation", &separation, "scene"_a, "insets"_a, "start"_a, "goal"_a, "powers"_a, "caller"_a);
    m.def("inset", [](const cfree::Polygon& polygon, const nb::int_& n, const nb::int_& d) {
        return cfree::inset(polygon, {integer(n), integer(d)});
    }, "polygon"_a, "numerator"_a, "denominator"_a, nb::sig("def inset(polygon: Polygon, numerator: int, denominator: int) -> Polygon | None"));
    nb::class_<Planner>(m, "Planner")
        .def(nb::init<std::shared_ptr<KnownScene>, double>(), "scene"_a, "angle_scale"_a)
        .def("take", [](Planner& planner, Planner& other) { watched([&] { planner.take(other); }); }, "other"_a)
        .def("plan", &plan, "start"_a, "goal"_a, "caller"_a, "few"_a)
        .def("walk", &walk, "start"_a, "goal"_a, "caller"_a)
        .def("quick", &quick, "start"_a, "goal"_a, "caller"_a, "guesses"_a = nb::none());
}

void bind_planning(nb::module_& m) {
    bind_known_scene(m);
    bind_separations(m);
    m.def("slide_along", [](const cfree::Scene& scene, const PoseNumbers& from, const std::array<int, 3>& first,
                            const std::array<int, 3>& last, const nb::int_& q, const nb::int_& p) -> std::optional<SlideTuple> {
        const auto found = cfree::slide_along(scene, pose_of(from), contact_of(first), contact_of(last), {integer(p), integer(q)});
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
