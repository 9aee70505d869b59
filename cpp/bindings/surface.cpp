// Points of contact surfaces in bulk.
#include "cfree/contact/surface.hpp"

#include "arrays.hpp"

using namespace nb::literals;

static cfree::Ruled ruled(const Column<double>& s) {
    require(s.shape(0) == 8, "a ruled surface has 8 coefficients: p, q, a, g");
    const double* v = s.data();
    return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]};
}

static void points(const Column<double>& surface, const Column<double>& t, const Column<double>& phi, const Out<double, 2>& out) {
    const std::size_t n = t.shape(0);
    require(phi.shape(0) == n && out.shape(0) == n && out.shape(1) == 2, "t, phi and out differ in length");
    const auto s = ruled(surface);
    const nb::gil_scoped_release release;
    cfree::evaluate_points(s, t.data(), phi.data(), n, out.data());
}

static void grid(const Column<double>& surface, const Column<double>& t, const Column<double>& phi, const Out<double, 3>& out) {
    require(out.shape(0) == phi.shape(0) && out.shape(1) == t.shape(0) && out.shape(2) == 2, "out must have the shape (phi, t, 2)");
    const auto s = ruled(surface);
    const nb::gil_scoped_release release;
    cfree::evaluate_grid(s, t.data(), t.shape(0), phi.data(), phi.shape(0), out.data());
}

void bind_surface(nb::module_& m) {
    m.def("evaluate_points", &points, "surface"_a, "t"_a, "phi"_a, "out"_a);
    m.def("evaluate_grid", &grid, "surface"_a, "t"_a, "phi"_a, "out"_a);
}
