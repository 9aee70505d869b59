// A flat list: arrays in, call, arrays out; the lock is released for long calls. Docstrings and checks are in Python.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "cfree/contact/surface.hpp"
#include "cfree/forbidden/boundary.hpp"
#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/forbidden/consistency.hpp"
#include "cfree/forbidden/slice.hpp"
#include "cfree/free/point_location.hpp"
#include "cfree/mesh/mesh.hpp"
#include "integers.hpp"
#include "watched.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using In1 = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using In2 = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Out1 = nb::ndarray<double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Out2 = nb::ndarray<double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Out3 = nb::ndarray<double, nb::ndim<3>, nb::c_contig, nb::device::cpu>;

static cfree::Ruled ruled(const In1& s) {
    if (s.shape(0) != 8) throw std::invalid_argument("a ruled surface has 8 coefficients: p, q, a, g");
    const double* v = s.data();
    return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]};
}

template <class T>
using Column = nb::ndarray<const T, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Limbs = nb::ndarray<const std::int64_t, nb::ndim<3>, nb::c_contig, nb::device::cpu>;

template <class T>
static std::vector<T> vector_of(const Column<T>& column) {
    return {column.data(), column.data() + column.shape(0)};
}

template <class T>
static std::span<const T> span_of(const Column<T>& column) {
    return {column.data(), column.shape(0)};
}

// The vector's memory as an array that owns it.
template <class T>
static nb::ndarray<nb::numpy, T, nb::ndim<1>> array_of(std::vector<T>&& values) {
    auto* kept = new std::vector<T>(std::move(values));
    nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
    return {kept->data(), {kept->size()}, owner};
}

static nb::tuple columns_of(cfree::Trapezoids&& t) {
    return nb::make_tuple(array_of(std::move(t.patch)), array_of(std::move(t.chart)), array_of(std::move(t.lower)),
                          array_of(std::move(t.upper)), array_of(std::move(t.from_first)), array_of(std::move(t.from_second)),
                          array_of(std::move(t.from_lo)), array_of(std::move(t.from_hi)), array_of(std::move(t.from_place)),
                          array_of(std::move(t.to_first)), array_of(std::move(t.to_second)), array_of(std::move(t.to_lo)),
                          array_of(std::move(t.to_hi)), array_of(std::move(t.to_place)));
}

template <class T>
static std::vector<T> vector_at(const nb::list& columns, std::size_t k) {
    return vector_of(nb::cast<Column<T>>(columns[k]));
}

// In the order of columns_of.
static cfree::Trapezoids trapezoids_of(const nb::list& c) {
    using Code = std::uint64_t;
    return {vector_at<int>(c, 0),     vector_at<std::uint8_t>(c, 1), vector_at<Code>(c, 2),    vector_at<Code>(c, 3),
            vector_at<Code>(c, 4),    vector_at<Code>(c, 5),         vector_at<Code>(c, 9),    vector_at<Code>(c, 10),
            vector_at<double>(c, 6),  vector_at<double>(c, 7),       vector_at<double>(c, 11), vector_at<double>(c, 12),
            vector_at<std::uint8_t>(c, 8), vector_at<std::uint8_t>(c, 13)};
}
static cfree::IsolatedParts isolated_of(const nb::list& c) {
    return {trapezoids_of(c),      vector_at<int>(c, 14),    vector_at<int>(c, 15),   vector_at<int>(c, 16),
            vector_at<int>(c, 17), vector_at<double>(c, 18), vector_at<double>(c, 19)};
}

// Two's complement, least limb first.
static cfree::Int integer(const std::int64_t* limbs, std::size_t count) {
    cfree::Int n = limbs[count - 1];
    for (std::size_t k = count - 1; k-- > 0;) n = (n << 64) + static_cast<std::uint64_t>(limbs[k]);
    return n;
}

static std::pair<std::vector<cfree::Int>, std::vector<cfree::Int>> integers(const Limbs& xy) {
    const std::size_t n = xy.shape(0), limbs = xy.shape(2);
    if (xy.shape(1) != 2 || limbs == 0) throw std::invalid_argument("coordinates must have the shape (n, 2, limbs)");
    std::pair<std::vector<cfree::Int>, std::vector<cfree::Int>> result;
    for (std::size_t k = 0; k < n; ++k) {
        result.first.push_back(integer(xy.data() + 2 * k * limbs, limbs));
        result.second.push_back(integer(xy.data() + (2 * k + 1) * limbs, limbs));
    }
    return result;
}

void bind_motion(nb::module_& m);
void bind_predicates(nb::module_& m);
void bind_free(nb::module_& m);
void bind_search(nb::module_& m);

NB_MODULE(_core, m) {
    nb::set_leak_warnings(false);  // objects that globals hold at exit are no news to users
    bind_motion(m);
    bind_predicates(m);
    bind_free(m);
    bind_search(m);
    nb::class_<cfree::Shape>(m, "Shape")
        .def("__init__", [](cfree::Shape* s, Limbs coordinates, int shift, Column<int> point, Column<int> v, Column<int> w,
                            Column<int> line, Column<int> direction, int ring_vertices, Column<int> previous,
                            Column<char> convex, Column<char> emit, Column<int> layer, Column<int> vertex_rank,
                            Column<int> edge_rank, Column<int> piece, Column<int> piece_vertex, Column<int> piece_edge,
                            Column<int> piece_layer) {
            new (s) cfree::Shape{};
            auto [x, y] = integers(coordinates);
            s->set_coordinates(std::move(x), std::move(y), shift);
            s->point = vector_of(point), s->v = vector_of(v), s->w = vector_of(w);
            s->line = vector_of(line), s->direction = vector_of(direction);
            s->ring_vertices = ring_vertices, s->previous = vector_of(previous);
            s->convex = vector_of(convex), s->emit = vector_of(emit), s->layer = vector_of(layer);
            s->vertex_rank = vector_of(vertex_rank), s->edge_rank = vector_of(edge_rank);
            s->piece = vector_of(piece), s->piece_vertex = vector_of(piece_vertex);
            s->piece_edge = vector_of(piece_edge), s->piece_layer = vector_of(piece_layer);
        }, "coordinates"_a, "shift"_a, "point"_a, "v"_a, "w"_a, "line"_a, "direction"_a, "ring_vertices"_a, "previous"_a,
           "convex"_a, "emit"_a, "layer"_a, "vertex_rank"_a, "edge_rank"_a, "piece"_a, "piece_vertex"_a, "piece_edge"_a,
           "piece_layer"_a);
    nb::class_<cfree::Job>(m, "Job")
        .def("__init__", [](cfree::Job* job, const cfree::Shape& robot, const cfree::Shape& obstacles, int threads,
                            bool regularized) {
            new (job) cfree::Job(std::make_shared<cfree::Scene>(cfree::Scene{robot, obstacles}), threads, regularized);
        }, "robot"_a, "obstacles"_a, "threads"_a, "regularized"_a, nb::call_guard<nb::gil_scoped_release>())
        .def("wait", &cfree::Job::wait, "seconds"_a, nb::call_guard<nb::gil_scoped_release>())
        .def("progress", &cfree::Job::progress)
        .def("cancel", &cfree::Job::cancel)
        .def("finish_early", &cfree::Job::finish_early)
        .def("trimmed", [](cfree::Job& job) { return array_of(std::move(job.trimmed)); })
        .def("patches", [](cfree::Job& job) {
            return nb::make_tuple(array_of(std::move(job.patches.kind)), array_of(std::move(job.patches.robot)),
                                  array_of(std::move(job.patches.obstacle)));
        })
        .def("trapezoids", [](cfree::Job& job) { return columns_of(std::move(job.trapezoids)); })
        .def("isolated", [](cfree::Job& job) {
            auto& x = job.isolated;
            return nb::make_tuple(columns_of(std::move(x.parts)), array_of(std::move(x.lower_patch)),
                                  array_of(std::move(x.upper_patch)), array_of(std::move(x.from_patch)),
                                  array_of(std::move(x.to_patch)), array_of(std::move(x.first_t)),
                                  array_of(std::move(x.last_t)));
        })
        .def("tally", [](const cfree::Job& job) {
            const auto& t = job.tally;
            nb::dict d;
            d["pairs"] = t.pairs, d["live_patches"] = t.live_patches;
            d["decided_by_identity"] = t.decisions.identity, d["decided_by_filter"] = t.decisions.filter;
            d["decided_by_intervals"] = t.decisions.interval, d["decided_exactly"] = t.decisions.exact;
            d["trim_seconds"] = t.trim_seconds;
            d["collect_seconds"] = t.collect_seconds, d["isolated_seconds"] = t.isolated_seconds;
            d["intervals_seconds"] = t.decisions.interval_seconds, d["exact_seconds"] = t.decisions.exact_seconds;
            return d;
        });
    m.def("glue", [](const cfree::Shape& robot, const cfree::Shape& obstacles, Column<std::uint8_t> kind, Column<int> patch_robot,
                     Column<int> patch_obstacle, Column<int> patch, Column<std::uint8_t> chart, Column<std::uint64_t> lower,
                     Column<std::uint64_t> upper, Column<std::uint64_t> from_first, Column<std::uint64_t> from_second,
                     In1 from_lo, In1 from_hi, Column<std::uint8_t> from_place, Column<std::uint64_t> to_first,
                     Column<std::uint64_t> to_second, In1 to_lo, In1 to_hi, Column<std::uint8_t> to_place) {
        const cfree::Scene scene{robot, obstacles};
        const cfree::Patches patches{vector_of(kind), vector_of(patch_robot), vector_of(patch_obstacle)};
        const cfree::Trapezoids t{vector_of(patch), vector_of(chart), vector_of(lower), vector_of(upper),
                                  vector_of(from_first), vector_of(from_second), vector_of(to_first), vector_of(to_second),
                                  vector_of(from_lo), vector_of(from_hi), vector_of(to_lo), vector_of(to_hi),
                                  vector_of(from_place), vector_of(to_place)};
        auto x = watched([&] { return cfree::glue(scene, patches, t); });
        return nb::make_tuple(array_of(std::move(x.first)), array_of(std::move(x.face)), array_of(std::move(x.side)),
                              array_of(std::move(x.twin)), array_of(std::move(x.edge)), array_of(std::move(x.vertex)),
                              array_of(std::move(x.component)), array_of(std::move(x.x)), array_of(std::move(x.y)),
                              array_of(std::move(x.theta)), x.edges, x.vertices, x.components);
    });
    // "" or what cannot be right, of columns whose indices are in their ranges
    m.def("misfit", [](const cfree::Shape& robot, const cfree::Shape& obstacles, Column<std::uint8_t> kind, Column<int> patch_robot,
                       Column<int> patch_obstacle, const nb::list& columns, const nb::list& isolated, int threads) {
        const cfree::Scene scene{robot, obstacles};
        const cfree::Patches patches{vector_of(kind), vector_of(patch_robot), vector_of(patch_obstacle)};
        const cfree::Trapezoids t = trapezoids_of(columns);
        const cfree::IsolatedParts parts = isolated_of(isolated);
        return watched([&]() -> std::string {
            if (!cfree::are_patches_of(scene, patches)) return "contact";
            if (const auto k = cfree::first_impossible(scene, patches, t, threads)) return "trapezoid " + std::to_string(*k);
            if (const auto k = cfree::first_impossible(scene, patches, parts)) return "isolated part " + std::to_string(*k);
            return {};
        });
    });
    m.def("mesh", [](const cfree::Shape& robot, const cfree::Shape& obstacles, In1 robot_xy, In1 obstacle_xy,
                     Column<std::uint8_t> kind, Column<int> patch_robot, Column<int> patch_obstacle, Column<int> patch,
                     Column<std::uint8_t> chart, Column<std::uint64_t> lower, Column<std::uint64_t> upper, Column<int> first,
                     Column<int> face, Column<std::uint8_t> side, Column<int> twin, Column<int> edge, Column<int> vertex, In1 x,
                     In1 y, In1 theta, int edges, double error, double angle_scale, double most) {
        const auto count = [](const auto& column) { return static_cast<cfree::Index>(column.shape(0)); };
        const cfree::Scene scene{robot, obstacles};
        const cfree::Patches patches{vector_of(kind), vector_of(patch_robot), vector_of(patch_obstacle)};
        const cfree::MeshInput input{{scene, robot_xy.data(), obstacle_xy.data()}, patches, patch.data(), chart.data(),
                                     lower.data(), upper.data(), count(patch), count(face), edges, count(x), first.data(),
                                     face.data(), twin.data(), edge.data(), vertex.data(), side.data(), x.data(), y.data(),
                                     theta.data(), error, angle_scale};
        auto [estimate, found] = watched([&] {
            const auto expected = cfree::estimate_mesh(input);
            return std::pair(expected, expected.triangles <= most ? cfree::mesh(input) : cfree::MeshArrays());
        });
        return nb::make_tuple(array_of(std::move(found.xyz)), array_of(std::move(found.corners)), array_of(std::move(found.face)),
                              array_of(std::move(found.seam)), found.least, estimate.coarsest, estimate.triangles);
    });
    m.def("turns", [](Column<int> first, Column<int> face, Column<int> twin, Column<int> component, Column<std::int8_t> steps,
                      int components) {
        auto x = cfree::turns(vector_of(first), vector_of(face), vector_of(twin), vector_of(component), vector_of(steps),
                              components);
        return nb::make_tuple(array_of(std::move(x.divisor)), array_of(std::move(x.lift)));
    });
    nb::class_<cfree::Rays>(m, "Rays")
        .def("__init__", [](cfree::Rays* rays, const cfree::Shape& robot, const cfree::Shape& obstacles, int shift,
                            Column<int> component, Column<std::uint8_t> kind, Column<int> patch_robot,
                            Column<int> patch_obstacle, Column<int> patch, Column<std::uint8_t> chart,
                            Column<std::uint64_t> lower, Column<std::uint64_t> upper, Column<std::uint64_t> from_first,
                            Column<std::uint64_t> from_second, In1 from_lo, In1 from_hi, Column<std::uint8_t> from_place,
                            Column<std::uint64_t> to_first, Column<std::uint64_t> to_second, In1 to_lo, In1 to_hi,
                            Column<std::uint8_t> to_place) {
            new (rays) cfree::Rays(
                {robot, obstacles}, shift, {vector_of(kind), vector_of(patch_robot), vector_of(patch_obstacle)},
                {vector_of(patch), vector_of(chart), vector_of(lower), vector_of(upper), vector_of(from_first),
                 vector_of(from_second), vector_of(to_first), vector_of(to_second), vector_of(from_lo), vector_of(from_hi),
                 vector_of(to_lo), vector_of(to_hi), vector_of(from_place), vector_of(to_place)},
                vector_of(component));
        })
        .def("nesting", [](const cfree::Rays& rays) {
            auto x = watched([&] { return rays.nesting(); });
            return nb::make_tuple(array_of(std::move(x.start)), array_of(std::move(x.around)), array_of(std::move(x.free_inside)));
        })
        .def("angle", [](const cfree::Rays& rays, int trapezoid, bool last, unsigned bits) {
            const auto [lo, hi] = rays.angle(trapezoid, last, bits);
            return nb::make_tuple(integer(lo.n), lo.k, integer(hi.n), hi.k);
        }, "trapezoid"_a, "last"_a, "bits"_a)
        .def("root", [](const cfree::Rays& rays, std::array<int, 3> contact, int chart, std::uint64_t first, std::uint64_t second,
                        double lo, double hi, int place) {
            const auto [kind, robot, obstacle] = contact;
            const cfree::RealRoot x = rays.root({{static_cast<cfree::Kind>(kind), robot, obstacle}, chart},
                                                {cfree::unpacked(first), cfree::unpacked(second), lo, hi}, place);
            nb::list polynomial;
            for (int k = 0; k < x.p.size(); ++k) polynomial.append(integer(x.p[k]));
            return nb::make_tuple(polynomial, integer(x.lo.n), x.lo.k, integer(x.hi.n), x.hi.k);
        }, "contact"_a, "chart"_a, "first"_a, "second"_a, "lo"_a, "hi"_a, "place"_a)
        .def("nearby", [](const cfree::Rays& rays, std::array<nb::int_, 5> pose, int chart) {
            const auto at = [&](std::size_t k) { return integer(pose[k]); };
            auto x = rays.nearby({at(0), at(1), at(2), chart, at(3), at(4)});
            return nb::make_tuple(x.on, x.end, x.crossed, x.generic);
        }, "pose"_a, "chart"_a)
        .def("locate_exactly", [](const cfree::Rays& rays, std::array<nb::int_, 5> pose, int chart, Column<int> depth,
                                  Column<int> cell, Column<std::uint8_t> free_inside, int outside) {
            const auto at = [&](std::size_t k) { return integer(pose[k]); };
            return rays.locate({at(0), at(1), at(2), chart, at(3), at(4)},
                               {span_of(depth), span_of(cell), span_of(free_inside), outside});
        }, "pose"_a, "chart"_a, "depth"_a, "cell"_a, "free_inside"_a, "outside"_a)
        .def("locate", [](const cfree::Rays& rays, In2 xy, Column<int> chart, In1 tau, const nb::int_& scale, Column<int> depth,
                          Column<int> cell, Column<std::uint8_t> free_inside, int outside, int threads) {
            const std::size_t n = tau.shape(0);
            if (xy.shape(0) != n || xy.shape(1) != 2 || chart.shape(0) != n)
                throw std::invalid_argument("xy, chart and tau differ in length");
            std::vector<int> found(n);
            const cfree::Int unit = integer(scale);
            watched([&] {
                rays.locate(xy.data(), chart.data(), tau.data(), n, unit, threads,
                            {span_of(depth), span_of(cell), span_of(free_inside), outside}, found.data());
            });
            return array_of(std::move(found));
        }, "xy"_a, "chart"_a, "tau"_a, "scale"_a, "depth"_a, "cell"_a, "free_inside"_a, "outside"_a, "threads"_a);
    nb::class_<cfree::Slicer>(m, "Slicer")
        .def("__init__", [](cfree::Slicer* s, const cfree::Shape& robot, const cfree::Shape& obstacles, In1 robot_xy,
                            In1 obstacle_xy, Column<std::uint8_t> kind, Column<int> patch_robot, Column<int> patch_obstacle,
                            Column<int> patch, Column<std::uint8_t> chart, Column<std::uint64_t> lower,
                            Column<std::uint64_t> upper, In1 tau_from, In1 tau_to, std::array<double, 4> shift) {
            new (s) cfree::Slicer(std::make_shared<cfree::Scene>(cfree::Scene{robot, obstacles}), vector_of(robot_xy),
                                  vector_of(obstacle_xy),
                                  cfree::Patches{vector_of(kind), vector_of(patch_robot), vector_of(patch_obstacle)},
                                  vector_of(patch), vector_of(chart), vector_of(lower), vector_of(upper),
                                  vector_of(tau_from), vector_of(tau_to), shift);
        }, "robot"_a, "obstacles"_a, "robot_xy"_a, "obstacle_xy"_a, "patch_kind"_a, "patch_robot"_a, "patch_obstacle"_a,
           "patch"_a, "chart"_a, "lower"_a, "upper"_a, "tau_from"_a, "tau_to"_a, "shift"_a)
        .def("segments", [](const cfree::Slicer& s, int chart, double tau) {
            auto r = s.segments(chart, tau);
            const std::size_t n = r.trapezoid.size();
            auto* xy = new std::vector<double>(std::move(r.xy));
            nb::capsule owner(xy, [](void* p) noexcept { delete static_cast<std::vector<double>*>(p); });
            return nb::make_tuple(nb::ndarray<nb::numpy, double, nb::ndim<3>>(xy->data(), {n, 2, 2}, owner),
                                  array_of(std::move(r.trapezoid)));
        }, "chart"_a, "tau"_a)
        .def("rings", [](const cfree::Slicer& s, int chart, double tau) {
            auto r = watched([&] { return s.rings(chart, tau); });
            return nb::make_tuple(array_of(std::move(r.xy)), array_of(std::move(r.start)), array_of(std::move(r.shell)));
        }, "chart"_a, "tau"_a)
        .def("limits", [](const cfree::Slicer& s, Column<int> trapezoid, Column<int> chart, In1 tau, Out1 lower, Out1 upper) {
            const std::size_t n = trapezoid.shape(0);
            if (chart.shape(0) != n || tau.shape(0) != n || lower.shape(0) != n || upper.shape(0) != n)
                throw std::invalid_argument("trapezoid, chart, tau, lower and upper differ in length");
            s.limits(trapezoid.data(), chart.data(), tau.data(), n, lower.data(), upper.data());
        }, "trapezoid"_a, "chart"_a, "tau"_a, "lower"_a, "upper"_a);
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
