// Verdicts on poses: arrays in, arrays out.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>

#include "cfree/collision/pose_checker.hpp"
#include "integers.hpp"
#include "watched.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using In2 = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Out = nb::ndarray<std::uint8_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

void bind_free(nb::module_& m) {
    nb::class_<cfree::Checker>(m, "Checker")
        .def("__init__", [](cfree::Checker* c, const cfree::Shape& robot, const cfree::Shape& obstacles, const nb::int_& scale,
                            In2 robot_xy, In2 obstacle_xy, std::array<double, 4> limits) {
            if (robot_xy.shape(0) != robot.x.size() || obstacle_xy.shape(0) != obstacles.x.size() ||
                robot_xy.shape(1) != 2 || obstacle_xy.shape(1) != 2)
                throw std::invalid_argument("robot_xy and obstacle_xy must have two columns and a row for every vertex");
            new (c) cfree::Checker(std::make_shared<cfree::Scene>(cfree::Scene{robot, obstacles}), integer(scale),
                                   robot_xy.data(), obstacle_xy.data(), limits);
        }, "robot"_a, "obstacles"_a, "scale"_a, "robot_xy"_a, "obstacle_xy"_a, "limits"_a)
        .def("check", [](const cfree::Checker& c, In2 poses, int threads, Out out) {
            if (poses.shape(1) != 3 || out.shape(0) != poses.shape(0))
                throw std::invalid_argument("poses must have three columns and as many rows as out");
            const auto check = [&] {
                c.check(poses.data(), poses.shape(0), threads, reinterpret_cast<cfree::Verdict*>(out.data()));
            };
            if (poses.shape(0) > 10'000) return watched(check);
            nb::gil_scoped_release release;
            check();
        }, "poses"_a, "threads"_a, "out"_a)
        .def("sweep_is_free", &cfree::Checker::sweep_is_free, "start"_a, "by"_a)
        .def("is_free", [](const cfree::Checker& c, std::array<double, 4> placement, const nb::int_& cos, const nb::int_& sin,
                           const nb::int_& w, const nb::int_& x, const nb::int_& y, const nb::int_& unit) {
            const auto [px, py, pc, ps] = placement;
            return c.is_free({px, py, pc, ps}, {integer(cos), integer(sin), integer(w), integer(x), integer(y), integer(unit)});
        }, "placement"_a, "c"_a, "s"_a, "w"_a, "x"_a, "y"_a, "unit"_a);
}
