// Ways along the boundary of a cell.
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/vector.h>

#include "cfree/planning/face_graph.hpp"
#include "watched.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using cfree::FaceGraph, cfree::Mark, cfree::Place;

// A place is (x, y, theta); a mark the face as well.
using Numbers = std::array<double, 3>;
using FaceAt = std::pair<int, Numbers>;

static Place place(const Numbers& n) { return {n[0], n[1], n[2]}; }
static std::vector<Mark> marks(const std::vector<FaceAt>& given) {
    std::vector<Mark> result;
    for (const auto& [face, at] : given) result.push_back({face, place(at)});
    return result;
}

void bind_planning(nb::module_& m) {
    nb::class_<FaceGraph>(m, "FaceGraph")
        .def(nb::init<std::shared_ptr<const cfree::CellComplex>, double>(), "cells"_a, "angle_scale"_a)
        .def("shortest", [](const FaceGraph& graph, const Numbers& start, const std::vector<FaceAt>& starts, const Numbers& goal,
                            const std::vector<FaceAt>& goals, const std::vector<FaceAt>& links) {
            const auto from = marks(starts), to = marks(goals), ends = marks(links);
            const auto way = watched([&] { return graph.shortest(place(start), from, place(goal), to, ends); });
            std::vector<std::pair<int, int>> found;
            for (const auto& [face, by] : way) found.emplace_back(face, by);
            return found;
        }, "start"_a, "starts"_a, "goal"_a, "goals"_a, "links"_a);
}
