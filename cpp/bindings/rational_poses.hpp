// Poses as Python gives and takes them: (x, y, p / q) as (numerator, denominator) of x and of y, and q, p, integers.
#pragma once
#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "cfree/planning/boundary_walk.hpp"
#include "integers.hpp"

using PoseNumbers = std::array<nanobind::int_, 6>;
using PoseTuple = std::tuple<nanobind::int_, nanobind::int_, nanobind::int_, nanobind::int_, nanobind::int_, nanobind::int_>;
// And (x, y, theta), the same rounded.
using EndNumbers = std::pair<PoseNumbers, std::array<double, 3>>;

inline cfree::RationalPose pose_of(const PoseNumbers& n) {
    const auto at = [&](std::size_t k) { return integer(n[k]); };
    return {{at(0), at(1)}, {at(2), at(3)}, {at(4), at(5)}};
}
inline cfree::BoundaryWalker::End end_of(const EndNumbers& given) {
    const auto [x, y, theta] = given.second;
    return {pose_of(given.first), {x, y, theta}};
}
inline std::vector<cfree::BoundaryWalker::End> ends_of(const std::vector<EndNumbers>& given) {
    std::vector<cfree::BoundaryWalker::End> ends;
    for (const EndNumbers& end : given) ends.push_back(end_of(end));
    return ends;
}
inline PoseTuple tuple_of(const cfree::RationalPose& q) {
    return {integer(q.x.n), integer(q.x.d), integer(q.y.n), integer(q.y.d), integer(q.half.q), integer(q.half.p)};
}
inline std::vector<PoseTuple> list_of(const cfree::Poses& way) {
    std::vector<PoseTuple> poses;
    for (const auto& q : way) poses.push_back(tuple_of(q));
    return poses;
}
