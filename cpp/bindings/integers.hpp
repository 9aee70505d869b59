// Python's integers and the core's.
#pragma once
#include <nanobind/nanobind.h>

#include <vector>

#include "cfree/exact/algebraic.hpp"

inline cfree::Int integer(const nanobind::int_& n) {
    int overflow;
    const long long small = PyLong_AsLongLongAndOverflow(n.ptr(), &overflow);
    if (!overflow) return small;
    return cfree::Int(nanobind::steal<nanobind::str>(PyNumber_ToBase(n.ptr(), 16)).c_str());
}
inline nanobind::int_ integer(const cfree::Int& n) {
    const auto digits = cfree::Int(abs(n)).str(0, std::ios_base::hex);
    return nanobind::steal<nanobind::int_>(PyLong_FromString(((n.sign() < 0 ? "-" : "") + digits).c_str(), nullptr, 16));
}

inline std::vector<nanobind::int_> integers(const cfree::Poly& p) {
    std::vector<nanobind::int_> result;
    for (const cfree::Int& c : p) result.push_back(integer(c));
    return result;
}
// Points as a tuple of pairs.
inline nanobind::tuple integers(const std::vector<cfree::Int>& x, const std::vector<cfree::Int>& y) {
    nanobind::list points;
    for (std::size_t k = 0; k < x.size(); ++k) points.append(nanobind::make_tuple(integer(x[k]), integer(y[k])));
    return nanobind::tuple(points);
}
