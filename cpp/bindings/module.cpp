// A flat list: arrays in, call, arrays out; the lock is released for long calls. Docstrings and checks are in Python.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "cfree/surface.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using In1 = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Out2 = nb::ndarray<double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Out3 = nb::ndarray<double, nb::ndim<3>, nb::c_contig, nb::device::cpu>;

static cfree::Ruled ruled(const In1& s) {
    if (s.shape(0) != 8) throw std::invalid_argument("a ruled surface has 8 coefficients: p, q, a, g");
    const double* v = s.data();
    return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]};
}

NB_MODULE(_core, m) {
    m.def("evaluate_points", [](In1 surface, In1 t, In1 phi, Out2 out) {
        if (t.shape(0) != phi.shape(0) || out.shape(0) != t.shape(0) || out.shape(1) != 2)
            throw std::invalid_argument("t, phi and out differ in length");
        const auto s = ruled(surface);
        nb::gil_scoped_release release;
        cfree::evaluate_points(s, t.data(), phi.data(), t.shape(0), out.data());
    }, "surface"_a, "t"_a, "phi"_a, "out"_a);
    m.def("evaluate_grid", [](In1 surface, In1 t, In1 phi, Out3 out) {
        if (out.shape(0) != phi.shape(0) || out.shape(1) != t.shape(0) || out.shape(2) != 2)
            throw std::invalid_argument("out must have the shape (phi, t, 2)");
        const auto s = ruled(surface);
        nb::gil_scoped_release release;
        cfree::evaluate_grid(s, t.data(), t.shape(0), phi.data(), phi.shape(0), out.data());
    }, "surface"_a, "t"_a, "phi"_a, "out"_a);
}
