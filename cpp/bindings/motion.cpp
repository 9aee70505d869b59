// The check of motions, flat: integers in, an answer out.
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>

#include "cfree/collision/motion_checker.hpp"
#include "integers.hpp"

namespace nb = nanobind;
using namespace nb::literals;

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

void bind_motion(nb::module_& m) {
    nb::class_<cfree::MotionChecker>(m, "MotionChecker")
        .def(nb::init<const cfree::Shape&, const cfree::Shape&, int>(), "robot"_a, "obstacles"_a, "shift"_a)
        .def("is_free", [](const cfree::MotionChecker& checker, bool turns, const MotionIntegers& numbers) {
            return checker.is_free(motion(turns, numbers));
        }, "turns"_a, "numbers"_a)
        .def("is_slide_free", [](const cfree::MotionChecker& checker, const SlideIntegers& numbers) {
            return checker.is_free(slide(numbers));
        }, "numbers"_a)
        .def("first_collision", [](const cfree::MotionChecker& checker, bool turns, const MotionIntegers& numbers) -> nb::object {
            const auto found = checker.first_collision(motion(turns, numbers));
            if (!found) return nb::none();
            nb::list polynomial;
            for (const cfree::Int& c : found->at.p) polynomial.append(integer(c));
            return nb::make_tuple(polynomial, found->robot_piece, found->obstacle_piece, found->kind, found->robot,
                                  found->obstacle);
        }, "turns"_a, "numbers"_a);
}
