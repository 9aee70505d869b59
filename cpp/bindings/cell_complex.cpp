// Closed surfaces, and meshes of them.
#include "cfree/forbidden/cell_complex.hpp"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>

#include "arrays.hpp"
#include "cfree/mesh/mesh.hpp"
#include "watched.hpp"

using namespace nb::literals;
using cfree::CellComplex, cfree::Mesh;

void bind_cell_complex(nb::module_& m) {
    nb::class_<CellComplex> cells(m, "CellComplex");
    column(cells, "first", &CellComplex::first);
    column(cells, "face", &CellComplex::face);
    column(cells, "side", &CellComplex::side);
    column(cells, "twin", &CellComplex::twin);
    column(cells, "edge", &CellComplex::edge);
    column(cells, "vertex", &CellComplex::vertex);
    column(cells, "component", &CellComplex::component);
    cells.def_prop_ro("theta", [](const CellComplex& of) {
        const auto* places = watched([&] { return &of.places(); });
        return Made<const double>(places->theta.data(), {places->theta.size()});
    });
    cells.def_prop_ro("xy", [](const CellComplex& of) {
        const auto* places = watched([&] { return &of.places(); });
        return Made<const double, 2>(places->xy.data(), {places->xy.size() / 2, 2});
    });
    cells.def_ro("boundary", &CellComplex::boundary);
    cells.def_ro("edges", &CellComplex::edges).def_ro("vertices", &CellComplex::vertices);
    cells.def_ro("components", &CellComplex::components);
    m.def("glue", [](const cfree::SharedBoundary& boundary, int threads, const CellComplex* reuse) {
        return watched([&] { return reuse ? cfree::glue(boundary, *reuse, threads) : cfree::glue(boundary, threads); });
    }, "boundary"_a, "threads"_a, "reuse"_a = nb::none());
    m.def("glue_own", [](const cfree::SharedBoundary& boundary, const Column<char>& own, int threads) {
        return watched([&] { return cfree::glue_own(boundary, vector_of(own), threads); });
    }, "boundary"_a, "own"_a, "threads"_a);

    nb::class_<Mesh> mesh(m, "Mesh");
    rows<3>(mesh, "xyz", &Mesh::xyz);
    rows<3>(mesh, "corners", &Mesh::corners);
    rows<2>(mesh, "seam", &Mesh::seam);
    column(mesh, "face", &Mesh::face);
    mesh.def_ro("least", &Mesh::least);
    m.def("estimate_mesh", [](const CellComplex& of, double error, double angle_scale) {
        const auto x = watched([&] { return cfree::estimate_mesh(of, error, angle_scale); });
        return std::pair(x.coarsest, x.triangles);
    }, "cells"_a, "error"_a, "angle_scale"_a);
    m.def("mesh", [](const CellComplex& of, double error, double angle_scale, bool off_surface) {
        return watched([&] { return cfree::mesh(of, error, angle_scale, off_surface); });
    }, "cells"_a, "error"_a, "angle_scale"_a, "off_surface"_a);
}
