// The arrangement of all contact surfaces.
#include "cfree/arrangement/arrangement.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "integers.hpp"
#include "watched.hpp"

using namespace nb::literals;
using cfree::Arrangement;

void bind_arrangement(nb::module_& m) {
    nb::class_<Arrangement> a(m, "Arrangement");
    for (const auto& [name, member] :
         {std::pair{"face_of", &Arrangement::face_of}, {"component", &Arrangement::component}, {"face_first", &Arrangement::face_first},
          {"face_outer", &Arrangement::face_outer}, {"face_inner", &Arrangement::face_inner}, {"face_euler", &Arrangement::face_euler},
          {"edge_start", &Arrangement::edge_start}, {"edge_face", &Arrangement::edge_face},
          {"vertex_degree", &Arrangement::vertex_degree}, {"vertex_pairs", &Arrangement::vertex_pairs},
          {"cell_set", &Arrangement::cell_set}, {"cell_euler", &Arrangement::cell_euler}, {"cell_surfaces", &Arrangement::cell_surfaces}})
        column(a, name, member);
    column(a, "edge_kind", &Arrangement::edge_kind);
    column(a, "vertex_kind", &Arrangement::vertex_kind);
    column(a, "theta", &Arrangement::theta);
    rows<2>(a, "edge_vertices", &Arrangement::edge_vertices);
    rows<2>(a, "xy", &Arrangement::xy);
    const auto ints = [](const std::vector<int>& values) { return Made<const int>(values.data(), {values.size()}); };
    a.def_prop_ro("boundary", [](const Arrangement& x) { return x.sheets.boundary; });
    a.def_prop_ro("outer", [ints](const Arrangement& x) { return ints(x.sheets.outer); });
    a.def_prop_ro("inner", [ints](const Arrangement& x) { return ints(x.sheets.inner); });
    a.def_prop_ro("owners", [ints](const Arrangement& x) { return ints(x.sheets.owners); });
    a.def_prop_ro("set_start", [ints](const Arrangement& x) { return ints(x.sheets.sets.start); });
    a.def_prop_ro("set_member", [ints](const Arrangement& x) { return ints(x.sheets.sets.member); });
    a.def("volumes", [](const Arrangement& x) {
        auto found = watched([&] { return x.volumes(); });
        return std::tuple{array_of(std::move(found.values)), array_of(std::move(found.errors))};
    });
    a.def("locate", [](const Arrangement& x, const std::array<nb::int_, 5>& n, int chart) {
        auto at = x.locate({integer(n[0]), integer(n[1]), integer(n[2]), chart, integer(n[3]), integer(n[4])});
        return std::pair(at.cell, std::move(at.on));
    }, "pose"_a, "chart"_a);
    m.def("arrange", [](const cfree::SceneFeatures& features, int threads, std::int64_t most_pieces, std::int64_t most_vertices) {
        return watched([&] {
            return cfree::arrange(cfree::compute_sheets(features, threads, most_pieces), threads, most_vertices);
        });
    }, "features"_a, "threads"_a, "most_pieces"_a, "most_vertices"_a);
}
