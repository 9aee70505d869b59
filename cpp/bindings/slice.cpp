// Slices of a boundary at one orientation.
#include "cfree/forbidden/slice.hpp"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>

#include "arrays.hpp"
#include "watched.hpp"

using namespace nb::literals;
using cfree::Slicer;

static std::pair<Made<double>, Made<int>> segments(const Slicer& s, int chart, double tau) {
    auto r = s.segments(chart, tau);
    return {array_of(std::move(r.xy)), array_of(std::move(r.trapezoid))};
}

using Outlines = std::tuple<Made<double>, Made<int>, Made<int>, Made<int>>;
static Outlines rings(const Slicer& s, const Column<int>& chart, const Column<double>& tau) {
    require(chart.shape(0) == tau.shape(0), "chart and tau differ in length");
    auto r = watched([&] { return s.rings({chart.data(), chart.shape(0)}, {tau.data(), tau.shape(0)}); });
    return {array_of(std::move(r.xy)), array_of(std::move(r.start)), array_of(std::move(r.shell)), array_of(std::move(r.first))};
}

static std::pair<Made<double>, Made<double>> limits(const Slicer& s, const Column<int>& trapezoid, const Column<double>& tau) {
    const std::size_t n = trapezoid.shape(0);
    require(tau.shape(0) == n, "trapezoid and tau differ in length");
    std::vector<double> lower(n), upper(n);
    for (std::size_t k = 0; k < n; ++k) {
        const auto [low, high] = s.limits().of(trapezoid.data()[k], tau.data()[k]);
        lower[k] = low, upper[k] = high;
    }
    return {array_of(std::move(lower)), array_of(std::move(upper))};
}

void bind_slice(nb::module_& m) {
    nb::class_<Slicer>(m, "Slicer")
        .def(nb::init<cfree::SharedBoundary>(), "boundary"_a)
        .def("segments", &segments, "chart"_a, "tau"_a)
        .def("rings", &rings, "chart"_a, "tau"_a)
        .def("limits", &limits, "trapezoid"_a, "tau"_a)
        .def("isolated_curve", [](const Slicer& s, int part, const Column<double>& tau) {
            std::vector<double> t(tau.shape(0));
            s.isolated_curve(part, tau.data(), t.size(), t.data());
            return array_of(std::move(t));
        }, "part"_a, "tau"_a);
}
