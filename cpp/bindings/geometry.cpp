// The geometry of contact surfaces in bulk, and integrals over trapezoids.
#include "cfree/geometry/local_geometry.hpp"

#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "cfree/geometry/quadrature.hpp"

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

// along_t(trapezoid, lower, upper, theta): a column.
static Made<double> trapezoid_integrals(const cfree::SharedBoundary& boundary, std::vector<double> nodes, std::vector<double> weights,
                                        const nb::callable& along_t) {
    return array_of(cfree::trapezoid_integrals(*boundary, {std::move(nodes), std::move(weights)}, [&](const cfree::QuadratureLines& lines) {
        auto of = lines;
        return vector_of(nb::cast<Column<double>>(along_t(array_of(std::move(of.trapezoid)), array_of(std::move(of.lower)),
                                                          array_of(std::move(of.upper)), array_of(std::move(of.theta)))));
    }));
}

void bind_geometry(nb::module_& m) {
    m.def("local_geometry", &local_geometry, "ruled"_a, "t"_a, "phi"_a, "angle_scale"_a);
    m.def("trapezoid_integrals", &trapezoid_integrals, "boundary"_a, "nodes"_a, "weights"_a, "along_t"_a);
}
