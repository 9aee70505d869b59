// The boundary: computed, or made of columns that come from outside.
#include "cfree/forbidden/boundary.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "cfree/forbidden/consistency.hpp"
#include "cfree/forbidden/sampled_count.hpp"
#include "polynomials.hpp"
#include "watched.hpp"

using namespace nb::literals;
using cfree::Boundary, cfree::IsolatedParts, cfree::Kind, cfree::Patches, cfree::SharedBoundary, cfree::Tally, cfree::Trapezoids;
using Ints = Column<int>;
using Bytes = Column<std::uint8_t>;
using Codes = Column<std::uint64_t>;
using Floats = Column<double>;

static void make_trapezoids(Trapezoids* t, Ints patch, Bytes chart, Codes lower, Codes upper, Codes from_first,
                            Codes from_second, Floats from_lo, Floats from_hi, Bytes from_place, Codes to_first,
                            Codes to_second, Floats to_lo, Floats to_hi, Bytes to_place) {
    new (t) Trapezoids{vector_of(patch),      vector_of(chart),       vector_of(lower),     vector_of(upper),
                       vector_of(from_first), vector_of(from_second), vector_of(to_first),  vector_of(to_second),
                       vector_of(from_lo),    vector_of(from_hi),     vector_of(to_lo),     vector_of(to_hi),
                       vector_of(from_place), vector_of(to_place)};
}

static void bind_columns(nb::module_& m) {
    nb::enum_<Kind>(m, "Kind", nb::is_arithmetic())
        .value("NONE", Kind::none)
        .value("VERTEX_EDGE", Kind::vertex_edge)
        .value("EDGE_VERTEX", Kind::edge_vertex)
        .value("VERTEX_VERTEX", Kind::vertex_vertex)
        .value("EDGE_EDGE", Kind::edge_edge)
        .value("SEAM", Kind::seam);
    nb::class_<Patches> patches(m, "Patches");
    patches.def("__init__", [](Patches* p, Bytes kind, Ints robot, Ints obstacle) {
        new (p) Patches{vector_of(kind), vector_of(robot), vector_of(obstacle)};
    }, "kind"_a, "robot"_a, "obstacle"_a);
    column(patches, "kind", &Patches::kind);
    column(patches, "robot", &Patches::robot);
    column(patches, "obstacle", &Patches::obstacle);

    nb::class_<Trapezoids> table(m, "Trapezoids");
    table.def("__init__", &make_trapezoids, "patch"_a, "chart"_a, "lower"_a, "upper"_a, "from_first"_a, "from_second"_a,
              "from_lo"_a, "from_hi"_a, "from_place"_a, "to_first"_a, "to_second"_a, "to_lo"_a, "to_hi"_a, "to_place"_a);
    column(table, "patch", &Trapezoids::patch);
    column(table, "chart", &Trapezoids::chart);
    column(table, "lower", &Trapezoids::lower);
    column(table, "upper", &Trapezoids::upper);
    column(table, "from_first", &Trapezoids::from_first);
    column(table, "from_second", &Trapezoids::from_second);
    column(table, "from_lo", &Trapezoids::from_lo);
    column(table, "from_hi", &Trapezoids::from_hi);
    column(table, "from_place", &Trapezoids::from_place);
    column(table, "to_first", &Trapezoids::to_first);
    column(table, "to_second", &Trapezoids::to_second);
    column(table, "to_lo", &Trapezoids::to_lo);
    column(table, "to_hi", &Trapezoids::to_hi);
    column(table, "to_place", &Trapezoids::to_place);

    nb::class_<IsolatedParts> isolated(m, "IsolatedParts");
    isolated.def("__init__", [](IsolatedParts* p, const Trapezoids& parts, Ints lower_patch, Ints upper_patch, Ints from_patch,
                                Ints to_patch, Floats first_t, Floats last_t) {
        new (p) IsolatedParts{parts, vector_of(lower_patch), vector_of(upper_patch), vector_of(from_patch), vector_of(to_patch),
                              vector_of(first_t), vector_of(last_t)};
    }, "parts"_a, "lower_patch"_a, "upper_patch"_a, "from_patch"_a, "to_patch"_a, "first_t"_a, "last_t"_a);
    isolated.def_ro("parts", &IsolatedParts::parts);
    column(isolated, "lower_patch", &IsolatedParts::lower_patch);
    column(isolated, "upper_patch", &IsolatedParts::upper_patch);
    column(isolated, "from_patch", &IsolatedParts::from_patch);
    column(isolated, "to_patch", &IsolatedParts::to_patch);
    column(isolated, "first_t", &IsolatedParts::first_t);
    column(isolated, "last_t", &IsolatedParts::last_t);
}

static void bind_tally(nb::module_& m) {
    nb::class_<Tally>(m, "Tally")
        .def_ro("pairs", &Tally::pairs)
        .def_ro("live_patches", &Tally::live_patches)
        .def_ro("kept_patches", &Tally::kept_patches)
        .def_prop_ro("decided_by_identity", [](const Tally& t) { return t.decisions.identity; })
        .def_prop_ro("decided_by_filter", [](const Tally& t) { return t.decisions.filter; })
        .def_prop_ro("decided_by_intervals", [](const Tally& t) { return t.decisions.interval; })
        .def_prop_ro("decided_exactly", [](const Tally& t) { return t.decisions.exact; })
        .def_ro("trim_seconds", &Tally::trim_seconds)
        .def_ro("collect_seconds", &Tally::collect_seconds)
        .def_ro("isolated_seconds", &Tally::isolated_seconds)
        .def_prop_ro("exact_seconds", [](const Tally& t) { return t.decisions.exact_seconds; });
}

// watch(share) is asked ten times a second whether to go on; what it raises ends the call.
static SharedBoundary computed(const std::shared_ptr<const cfree::Scene>& scene, int threads, bool regularized,
                               const nb::typed<nb::callable, bool(double)>& watch, std::optional<std::vector<int>> features,
                               SharedBoundary reuse) {
    Raised raised;
    const auto ask = [&](double share) {
        const nb::gil_scoped_acquire lock;
        if (raised.is_signalled()) return cfree::Wish::cancel;
        try {
            return nb::cast<bool>(watch(share)) ? cfree::Wish::go_on : cfree::Wish::finish;
        } catch (nb::python_error& error) {
            raised.keep(std::move(error));
            return cfree::Wish::cancel;
        }
    };
    try {
        const nb::gil_scoped_release release;
        return cfree::compute_boundary(scene, {threads, regularized, ask, std::move(features), std::move(reuse)});
    } catch (const cfree::Stopped&) {
    }
    raised.rethrow();
    throw cfree::Stopped();
}

static RootTuple root(const Boundary& boundary, std::array<int, 3> contact, int chart, std::uint64_t first, std::uint64_t second,
                      double lo, double hi, int place) {
    const auto [kind, robot, obstacle] = contact;
    const cfree::Surface on{{static_cast<Kind>(kind), robot, obstacle}, chart};
    const cfree::CriticalAngle angle(on, {cfree::unpacked(first), cfree::unpacked(second), lo, hi}, place);
    const auto tuple_of = [](const auto& x) { return RootTuple{integers(x.p), dyadic(x.lo), dyadic(x.hi)}; };
    const cfree::Scene& scene = boundary.scene->near();
    return scene.is_round ? tuple_of(angle.exact_among_grown(scene)) : tuple_of(angle.exact(scene));
}

static std::tuple<Made<int>, Made<int>, int, int> angle_ranks(const Boundary& boundary) {
    cfree::AngleRanks ranks;
    watched([&] { ranks = cfree::angle_ranks(boundary); });
    return {array_of(std::move(ranks.from)), array_of(std::move(ranks.to)), ranks.middle, ranks.last};
}

void bind_boundary(nb::module_& m) {
    bind_columns(m);
    bind_tally(m);
    nb::class_<Boundary>(m, "Boundary")
        .def("__init__", [](Boundary* b, std::shared_ptr<const cfree::Scene> scene, const Patches& patches, const Bytes& trimmed,
                            const Trapezoids& trapezoids, const IsolatedParts& isolated) {
            new (b) Boundary(std::move(scene), patches, vector_of(trimmed), trapezoids, isolated);
        }, "scene"_a, "patches"_a, "trimmed"_a, "trapezoids"_a, "isolated"_a)
        .def_ro("patches", &Boundary::patches)
        .def_prop_ro("trimmed", [](const Boundary& b) { return Made<const std::uint8_t>(b.trimmed.data(), {b.trimmed.size()}); })
        .def_ro("trapezoids", &Boundary::trapezoids)
        .def_ro("isolated", &Boundary::isolated)
        .def_ro("tally", &Boundary::tally)
        .def("root", &root, "contact"_a, "chart"_a, "first"_a, "second"_a, "lo"_a, "hi"_a, "place"_a)
        .def("angle_ranks", &angle_ranks);
    m.def("compute_boundary", &computed, "scene"_a, "threads"_a, "regularized"_a, "watch"_a, "features"_a = nb::none(),
          "reuse"_a = nb::none());
    m.def("sampled_count", [](const cfree::Scene& scene, int samples) {
        Tally tally;
        watched([&] { tally.add(cfree::sampled_count(scene, samples)); });
        return std::tuple(tally, cfree::list_patches(scene.near()).size());
    }, "scene"_a, "samples"_a);
    m.def("may_have_slits", [](const cfree::Scene& scene) { return cfree::may_have_slits(scene); }, "scene"_a);
    m.def("misfit", [](const Boundary& b, int threads) { return watched([&] { return cfree::misfit(b, threads); }); },
          "boundary"_a, "threads"_a);
}
