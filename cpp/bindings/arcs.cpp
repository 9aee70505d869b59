// Poses and motions among shapes of segments and arcs.
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "cfree/arcs/motion_checker.hpp"
#include "cfree/arcs/pose_checker.hpp"
#include "given_motions.hpp"
#include "watched.hpp"

using namespace nb::literals;
using cfree::ArcMotionChecker, cfree::ArcPoseChecker, cfree::ArcScene, cfree::ArcShape;

namespace arcs {

// x and y of start, end and center, and the turn
using CurveNumbers = std::array<nb::int_, 7>;

void make_shape(ArcShape* shape, const std::vector<std::vector<CurveNumbers>>& rings, nb::int_ radius, nb::int_ scale, bool is_outside) {
    std::vector<std::vector<cfree::RoundEdge>> curves;
    for (const auto& ring : rings) {
        auto& exact = curves.emplace_back();
        for (const CurveNumbers& n : ring)
            exact.push_back({{integer(n[0]), integer(n[1])}, {integer(n[2]), integer(n[3])}, {integer(n[4]), integer(n[5])}, nb::cast<int>(n[6])});
    }
    new (shape) ArcShape(cfree::arc_shape(std::move(curves), integer(radius), integer(scale), is_outside));
}

std::shared_ptr<const ArcScene> make_scene(const std::vector<const ArcShape*>& robot, const std::vector<const ArcShape*>& obstacles,
                                           const std::optional<std::array<nb::object, 4>>& bounds) {
    auto scene = std::make_shared<ArcScene>();
    for (const ArcShape* shape : robot) scene->robot.push_back(*shape);
    for (const ArcShape* shape : obstacles) scene->obstacles.push_back(*shape);
    if (bounds)
        scene->bounds = {ratio_of((*bounds)[0]), ratio_of((*bounds)[1]), ratio_of((*bounds)[2]), ratio_of((*bounds)[3])};
    return scene;
}

std::optional<bool> is_free(const ArcPoseChecker& checker, nb::handle pose) {
    const auto given = given_pose(pose);
    if (!given) return {};
    return checker.is_free(*given);
}

void check(const ArcPoseChecker& checker, const In<double, 2>& poses, int threads, const Out<std::uint8_t, 1>& out) {
    require(poses.shape(1) == 3 && out.shape(0) == poses.shape(0), "poses must have three columns and as many rows as out");
    watched([&] { checker.check(poses.data(), poses.shape(0), threads, reinterpret_cast<cfree::Verdict*>(out.data())); });
}

std::array<double, 2> bounds_of(const cfree::DistanceBounds& interval) { return {interval.low, interval.high}; }

cfree::Motion motion_of(nb::handle from, nb::handle motion, bool turns) {
    const auto m = given_motion(cfree::Int(1), from, motion, turns);
    require(m.has_value(), "the motion must begin at a pose");
    return *m;
}

// Numerators and denominators of the bounds of the parameter; part of the robot, and obstacle.
using Collision = std::tuple<nb::int_, nb::int_, nb::int_, nb::int_, int, int>;

std::optional<Collision> first_collision(const ArcMotionChecker& checker, nb::handle from, nb::handle motion, bool turns) {
    const cfree::Motion m = motion_of(from, motion, turns);
    const auto found = watched([&] { return checker.first_collision(m); });
    if (!found) return {};
    return Collision{integer(found->low.n), integer(found->low.d), integer(found->high.n), integer(found->high.d), found->part, found->obstacle};
}

}  // namespace arcs

void bind_arcs(nb::module_& m) {
    nb::class_<ArcShape>(m, "ArcShape").def("__init__", &arcs::make_shape, "rings"_a, "radius"_a, "scale"_a, "is_outside"_a);
    nb::class_<ArcScene>(m, "ArcScene").def(nb::new_(&arcs::make_scene), "robot"_a, "obstacles"_a, "bounds"_a.none());
    nb::class_<ArcPoseChecker>(m, "ArcPoseChecker")
        .def(nb::init<std::shared_ptr<const ArcScene>>(), "scene"_a)
        .def("check", &arcs::check, "poses"_a, "threads"_a, "out"_a)
        .def("is_free", &arcs::is_free, "pose"_a)
        .def("distance", [](const ArcPoseChecker& checker, nb::handle pose, double most) {
            return arcs::bounds_of(checker.distance(pose_of(pose), most));
        }, "pose"_a, "most"_a);
    nb::class_<ArcMotionChecker>(m, "ArcMotionChecker")
        .def(nb::init<std::shared_ptr<const ArcScene>>(), "scene"_a)
        .def("is_free", [](const ArcMotionChecker& checker, nb::handle pose, nb::handle motion, bool turns) {
            const cfree::Motion moved = arcs::motion_of(pose, motion, turns);
            return watched([&] { return checker.is_free(moved); });
        }, "pose"_a, "motion"_a, "turns"_a)
        .def("first_collision", &arcs::first_collision, "pose"_a, "motion"_a, "turns"_a)
        .def("clearance", [](const ArcMotionChecker& checker, nb::handle pose, nb::handle motion, bool turns, double width) {
            const cfree::Motion moved = arcs::motion_of(pose, motion, turns);
            return arcs::bounds_of(watched([&] { return checker.clearance(moved, width); }));
        }, "pose"_a, "motion"_a, "turns"_a, "width"_a);
}
