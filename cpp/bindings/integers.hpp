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
// In parts of 62 bits, the highest first.
inline nanobind::int_ integer(const cfree::Int& n) {
    constexpr unsigned bits = 62;
    if (n.is_zero()) return nanobind::int_(0);
    const cfree::Int size = abs(n);
    unsigned shift = static_cast<unsigned>(msb(size)) / bits * bits;
    const auto part = [&] { return nanobind::int_(static_cast<std::int64_t>(cfree::Int(size >> shift) & cfree::Int((1ull << bits) - 1))); };
    nanobind::object value = part();
    while (shift > 0) {
        shift -= bits;
        value = (value << nanobind::int_(bits)) | part();
    }
    return nanobind::borrow<nanobind::int_>(n.sign() < 0 ? -value : value);
}

template <class P>  // a polynomial of any kind
std::vector<nanobind::int_> integers(const P& p) {
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
