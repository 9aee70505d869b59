// The core's values, bound once each, by topic: arrays in, call, views out. Docstrings and checks are in Python.
#include <nanobind/nanobind.h>

namespace nb = nanobind;

void bind_scene(nb::module_& m);
void bind_polygons(nb::module_& m);
void bind_surface(nb::module_& m);
void bind_geometry(nb::module_& m);
void bind_predicates(nb::module_& m);
void bind_polynomials(nb::module_& m);
void bind_checkers(nb::module_& m);
void bind_boundary(nb::module_& m);
void bind_cell_complex(nb::module_& m);
void bind_slice(nb::module_& m);
void bind_free_space(nb::module_& m);
void bind_arrangement(nb::module_& m);
void bind_search(nb::module_& m);
void bind_planning(nb::module_& m);
void bind_vehicles(nb::module_& m);
void bind_arcs(nb::module_& m);

NB_MODULE(_core, m) {
    nb::set_leak_warnings(false);  // objects that globals hold at exit are no news to users
    bind_scene(m);
    bind_polygons(m);
    bind_surface(m);
    bind_geometry(m);
    bind_predicates(m);
    bind_polynomials(m);
    bind_checkers(m);
    bind_boundary(m);
    bind_cell_complex(m);
    bind_slice(m);
    bind_free_space(m);
    bind_arrangement(m);
    bind_search(m);
    bind_planning(m);
    bind_vehicles(m);
    bind_arcs(m);
}
