// The geometry of contact surfaces in bulk, and integrals over trapezoids.
#include "cfree/geometry/local_geometry.hpp"

#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>

#include "arrays.hpp"
#include "cfree/geometry/integrals.hpp"
#include "watched.hpp"

using namespace nb::literals;

// Rows of 18 numbers: E, F, G, e, f, g, v, the frame, K, H.
static Made<double> local_geometry(const In<double, 2>& ruled, const Column<double>& t, const Column<double>& phi, double angle_scale) {
    const std::size_t n = t.shape(0);
    require(ruled.shape(0) == n && ruled.shape(1) == 8 && phi.shape(0) == n, "ruled, t and phi differ in length");
    std::vector<double> out;
    out.reserve(18 * n);
    for (std::size_t k = 0; k < n; ++k) {
        const double* r = ruled.data() + 8 * k;
        const auto at = cfree::local_geometry({r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7]}, t.data()[k], phi.data()[k], angle_scale);
        out.insert(out.end(), {at.E, at.F, at.G, at.e, at.f, at.g, at.v});
        out.insert(out.end(), at.frame.begin(), at.frame.end());
        out.insert(out.end(), {at.K, at.H});
    }
    return array_of(std::move(out));
}

template <double of(const cfree::Ruled&, double, double, double, double)>
static Made<double> along_rulings(const In<double, 2>& ruled, const Column<double>& phi, double angle_scale) {
    const std::size_t n = phi.shape(0);
    require(ruled.shape(0) == n && ruled.shape(1) == 8, "ruled and phi differ in length");
    std::vector<double> out(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double* r = ruled.data() + 8 * k;
        out[k] = of({r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7]}, 0, 1, phi.data()[k], angle_scale);
    }
    return array_of(std::move(out));
}

// Values and errors.
using Integrals = std::tuple<Made<double>, Made<double>>;
template <std::vector<cfree::Integral> of(const cfree::Boundary&, double)>
static Integrals over_trapezoids(const cfree::SharedBoundary& boundary, double angle_scale) {
    std::vector<double> values, errors;
    for (const auto& found : watched([&] { return of(*boundary, angle_scale); })) values.push_back(found.value), errors.push_back(found.error);
    return {array_of(std::move(values)), array_of(std::move(errors))};
}

// Geodesic curvatures, their errors, turns; and starts, three numbers each.
static std::tuple<Made<double>, Made<double>, Made<double>, Made<double>> side_curvatures(const cfree::CellComplex& cells, double angle_scale) {
    auto of = watched([&] { return cfree::side_curvatures(cells, angle_scale); });
    return {array_of(std::move(of.total)), array_of(std::move(of.error)), array_of(std::move(of.turn)), array_of(std::move(of.start))};
}

void bind_geometry(nb::module_& m) {
    m.def("local_geometry", &local_geometry, "ruled"_a, "t"_a, "phi"_a, "angle_scale"_a);
    m.def("ruling_areas", &along_rulings<cfree::ruling_area>, "ruled"_a, "phi"_a, "angle_scale"_a);
    m.def("ruling_curvatures", &along_rulings<cfree::ruling_curvature>, "ruled"_a, "phi"_a, "angle_scale"_a);
    m.def("trapezoid_areas", &over_trapezoids<cfree::trapezoid_areas>, "boundary"_a, "angle_scale"_a);
    m.def("trapezoid_curvatures", &over_trapezoids<cfree::trapezoid_curvatures>, "boundary"_a, "angle_scale"_a);
    m.def("side_curvatures", &side_curvatures, "cells"_a, "angle_scale"_a);
}
