// One pose as users give it: three numbers that are doubles, or a `Pose`, whose numbers are fractions. Whatever is neither
// is for Python to read, or to refuse.
#pragma once
#include <nanobind/nanobind.h>

#include <array>
#include <cmath>
#include <optional>

#include "cfree/collision/pose_checker.hpp"
#include "cfree/exact/radians.hpp"
#include "integers.hpp"

// A finite number that is a double. No truth values, no integers beyond 2^53.
inline std::optional<double> double_of(nanobind::handle number) {
    if (PyFloat_Check(number.ptr())) {
        const double value = PyFloat_AsDouble(number.ptr());
        return std::isfinite(value) ? std::optional(value) : std::nullopt;
    }
    if (!PyLong_CheckExact(number.ptr())) return {};
    int overflow;
    const long long value = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
    constexpr long long most = 1ll << 53;
    return !overflow && -most <= value && value <= most ? std::optional(static_cast<double>(value)) : std::nullopt;
}

// The item of a tuple or list, which outlives the call.
inline nanobind::handle item(nanobind::handle row, Py_ssize_t k) {
    return PyTuple_Check(row.ptr()) ? PyTuple_GetItem(row.ptr(), k) : PyList_GetItem(row.ptr(), k);
}
inline Py_ssize_t length(nanobind::handle row) {
    return PyTuple_Check(row.ptr()) ? PyTuple_Size(row.ptr()) : PyList_Check(row.ptr()) ? PyList_Size(row.ptr()) : -1;
}

// x, y and theta in a tuple or list.
inline std::optional<std::array<double, 3>> doubles_of(nanobind::handle row) {
    if (length(row) != 3) return {};
    std::array<double, 3> found;
    for (Py_ssize_t k = 0; k < 3; ++k) {
        const auto value = double_of(item(row, k));
        if (!value) return {};
        found[static_cast<std::size_t>(k)] = *value;
    }
    return found;
}

// An attribute; its name is made once.
class Attribute {
public:
    explicit Attribute(const char* name) : name(PyUnicode_InternFromString(name)) {}
    nanobind::object of(nanobind::handle value) const {
        PyObject* found = PyObject_GetAttr(value.ptr(), name);
        if (!found) throw nanobind::python_error();
        return nanobind::steal(found);
    }

private:
    PyObject* name;
};

// The ratio of a Fraction.
inline cfree::Ratio ratio_of(nanobind::handle fraction) {
    static const Attribute numerator("numerator"), denominator("denominator");
    const auto whole = [](const nanobind::object& n) { return integer(nanobind::borrow<nanobind::int_>(n)); };
    return {whole(numerator.of(fraction)), whole(denominator.of(fraction))};
}

// The pose of three doubles, as `Pose` takes them; nothing for very large angles.
inline std::optional<cfree::GivenPose> given_pose(const std::array<double, 3>& numbers) {
    const auto [x, y, theta] = numbers;
    const auto read = cfree::read_radians(theta);
    if (!read) return {};
    return cfree::GivenPose{cfree::ratio_of(x), cfree::ratio_of(y), read->q, read->p, read->theta};
}

// The pose of a `Pose`.
inline cfree::GivenPose pose_of(nanobind::handle pose) {
    static const Attribute x("x"), y("y"), tau("tau"), theta("theta");
    const nanobind::object half = tau.of(pose);
    const cfree::Ratio tangent = half.is_none() ? cfree::Ratio{1, 0} : ratio_of(half);
    return {ratio_of(x.of(pose)), ratio_of(y.of(pose)), tangent.d, tangent.n, PyFloat_AsDouble(theta.of(pose).ptr())};
}

// The pose of either.
inline std::optional<cfree::GivenPose> given_pose(nanobind::handle pose) {
    if (length(pose) < 0) return pose_of(pose);
    const auto numbers = doubles_of(pose);
    return numbers ? given_pose(*numbers) : std::nullopt;
}
