// Whether poses and motions are free. Motions are integers; see motion_checker.hpp.
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "cfree/collision/motion_checker.hpp"
#include "cfree/collision/pose_checker.hpp"
#include "integers.hpp"
#include "watched.hpp"

using namespace nb::literals;
using cfree::MotionChecker, cfree::PoseChecker;

static void check(const PoseChecker& c, const In<double, 2>& poses, int threads, const Out<std::uint8_t, 1>& out) {
    require(poses.shape(1) == 3 && out.shape(0) == poses.shape(0), "poses must have three columns and as many rows as out");
    watched([&] { c.check(poses.data(), poses.shape(0), threads, reinterpret_cast<cfree::Verdict*>(out.data())); });
}

// c, s, w, x, y, unit; vx, vy; start, q, p
using MotionIntegers = std::array<nb::int_, 11>;

static cfree::Motion motion(bool turns, const MotionIntegers& n) {
    const auto at = [&](int k) { return integer(n[static_cast<std::size_t>(k)]); };
    return {at(0), at(1), at(2), at(3), at(4), at(5), turns, at(6), at(7), at(8), at(9), at(10)};
}

// c, s, w, q, p; and five coefficients each of x, y, d
using SlideIntegers = std::array<nb::int_, 20>;

static cfree::Slide slide(const SlideIntegers& n) {
    const auto at = [&](int k) { return integer(n[static_cast<std::size_t>(k)]); };
    const auto five = [&](int k) { return std::array<cfree::Int, 5>{at(k), at(k + 1), at(k + 2), at(k + 3), at(k + 4)}; };
    return {at(0), at(1), at(2), at(3), at(4), five(5), five(10), five(15)};
}

// The polynomial that grows through zero; pieces of the robot and the obstacles; kind, robot and obstacle feature.
using Collision = std::tuple<std::vector<nb::int_>, int, int, int, int, int>;

static std::optional<Collision> first_collision(const MotionChecker& checker, bool turns, const MotionIntegers& numbers) {
    const auto found = checker.first_collision(motion(turns, numbers));
    if (!found) return {};
    return Collision{integers(found->at.p), found->robot_piece, found->obstacle_piece, found->kind, found->robot, found->obstacle};
}

void bind_checkers(nb::module_& m) {
    nb::class_<PoseChecker>(m, "PoseChecker")
        .def(nb::init<std::shared_ptr<const cfree::Scene>, std::array<double, 4>>(), "scene"_a, "limits"_a)
        .def("check", &check, "poses"_a, "threads"_a, "out"_a)
        .def("sweep_is_free", &PoseChecker::sweep_is_free, "start"_a, "by"_a)
        .def("is_free", [](const PoseChecker& c, std::array<double, 4> placement, const std::array<nb::int_, 6>& exact) {
            const auto [x, y, cos, sin] = placement;
            const auto at = [&](std::size_t k) { return integer(exact[k]); };
            return c.is_free({x, y, cos, sin}, {at(0), at(1), at(2), at(3), at(4), at(5)});
        }, "placement"_a, "exact"_a);
    nb::class_<MotionChecker>(m, "MotionChecker")
        .def(nb::init<std::shared_ptr<const cfree::Scene>>(), "scene"_a)
        .def("is_free", [](const MotionChecker& checker, bool turns, const MotionIntegers& numbers) {
            return checker.is_free(motion(turns, numbers));
        }, "turns"_a, "numbers"_a)
        .def("is_slide_free", [](const MotionChecker& checker, const SlideIntegers& numbers) {
            return checker.is_free(slide(numbers));
        }, "numbers"_a)
        .def("first_collision", &first_collision, "turns"_a, "numbers"_a);
}
