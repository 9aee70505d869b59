// The scene: two shapes as flat arrays. Users' scenes are made of polygons; the constructors are for tests of the core.
#include "cfree/scene/scene.hpp"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>

#include "arrays.hpp"
#include "cfree/forbidden/columns.hpp"
#include "integers.hpp"

using namespace nb::literals;
using Ints = Column<int>;
using Flags = Column<char>;
using Point = std::pair<nb::int_, nb::int_>;

static void make_shape(cfree::Shape* s, const std::vector<Point>& vertices, int shift, nb::int_ scale, Ints point, Ints v, Ints w,
                       Ints line, Ints direction, int ring_vertices, Ints previous, Flags convex, Flags emit, Ints layer,
                       Ints vertex_rank, Ints edge_rank, Ints piece, Ints piece_vertex, Ints piece_edge, Ints piece_layer) {
    new (s) cfree::Shape{};
    std::vector<cfree::Int> x, y;
    for (const Point& p : vertices) x.push_back(integer(p.first)), y.push_back(integer(p.second));
    s->set_coordinates(std::move(x), std::move(y), shift, integer(scale));
    s->point = vector_of(point), s->v = vector_of(v), s->w = vector_of(w);
    s->line = vector_of(line), s->direction = vector_of(direction);
    s->ring_vertices = ring_vertices, s->previous = vector_of(previous);
    s->convex = vector_of(convex), s->emit = vector_of(emit), s->layer = vector_of(layer);
    s->vertex_rank = vector_of(vertex_rank), s->edge_rank = vector_of(edge_rank);
    s->piece = vector_of(piece), s->piece_vertex = vector_of(piece_vertex);
    s->piece_edge = vector_of(piece_edge), s->piece_layer = vector_of(piece_layer);
}

static std::shared_ptr<const cfree::Scene> make_scene(const cfree::Shape& robot, const cfree::Shape& obstacles, nb::int_ scale,
                                                      int shift, bool is_bounded, const Point& robot_origin,
                                                      const Point& obstacle_origin, int near_shift) {
    const auto exact = [](const Point& p) { return cfree::Vec<cfree::Int>{integer(p.first), integer(p.second)}; };
    const cfree::Int denominator = integer(scale);
    cfree::Scene scene{robot, obstacles, denominator, denominator >> lsb(denominator), shift, is_bounded, {}, nullptr};
    return cfree::scene_around(std::move(scene), exact(robot_origin), exact(obstacle_origin), near_shift);
}

static Made<const std::int8_t> flags(const std::vector<char>& values) {
    return {reinterpret_cast<const std::int8_t*>(values.data()), {values.size()}};
}

void bind_scene(nb::module_& m) {
    nb::class_<cfree::Shape> shape(m, "Shape");
    shape
        .def("__init__", &make_shape, "vertices"_a, "shift"_a, "scale"_a, "point"_a, "v"_a, "w"_a, "line"_a, "direction"_a,
             "ring_vertices"_a, "previous"_a, "convex"_a, "emit"_a, "layer"_a, "vertex_rank"_a, "edge_rank"_a, "piece"_a,
             "piece_vertex"_a, "piece_edge"_a, "piece_layer"_a)
        .def_prop_ro("vertices", [](const cfree::Shape& s) { return integers(s.X, s.Y); },
                     nb::for_getter(nb::sig("def vertices(self) -> tuple[tuple[int, int], ...]")))
        .def_prop_ro("counts",
                     [](const cfree::Shape& s) {  // of vertices, of convex ones, of vertices of pieces
                         return std::tuple(s.convex.size(), std::count(s.convex.begin(), s.convex.end(), 1), s.piece_vertex.size());
                     })
        .def_prop_ro("radius",
                     [](const cfree::Shape& s) {  // of each vertex; empty if no shape is rounded
                         std::vector<nb::int_> radius;
                         for (const auto c : s.vertex_radius) radius.push_back(integer(s.radii[c].exact));
                         return radius;
                     })
        .def("makes_surfaces",
             [](const cfree::Shape& s) {  // edges of rings: 0 for stubs, and for a point
                 std::vector<std::int8_t> makes;
                 for (cfree::Index e = 0; e < s.ring_vertices; ++e) makes.push_back(s.makes_surfaces(e));
                 return array_of(std::move(makes));
             })
        .def_prop_ro("convex", [](const cfree::Shape& s) { return flags(s.convex); })
        .def_prop_ro("emit", [](const cfree::Shape& s) { return flags(s.emit); });
    rows<2>(shape, "xy", &cfree::Shape::xy);
    for (const auto& [name, member] : {std::pair{"point", &cfree::Shape::point}, {"v", &cfree::Shape::v}, {"w", &cfree::Shape::w},
                                       {"line", &cfree::Shape::line}, {"direction", &cfree::Shape::direction},
                                       {"previous", &cfree::Shape::previous}, {"layer", &cfree::Shape::layer},
                                       {"vertex_rank", &cfree::Shape::vertex_rank}, {"edge_rank", &cfree::Shape::edge_rank},
                                       {"piece", &cfree::Shape::piece}, {"piece_vertex", &cfree::Shape::piece_vertex},
                                       {"piece_edge", &cfree::Shape::piece_edge}, {"piece_layer", &cfree::Shape::piece_layer}})
        column(shape, name, member);
    nb::class_<cfree::Scene>(m, "Scene")
        .def(nb::new_(&make_scene), "robot"_a, "obstacles"_a, "scale"_a, "shift"_a, "is_bounded"_a, "robot_origin"_a,
             "obstacle_origin"_a, "near_shift"_a)
        .def_ro("robot", &cfree::Scene::robot)
        .def_ro("obstacles", &cfree::Scene::obstacles)
        .def_prop_ro("near", &cfree::Scene::near, nb::rv_policy::reference_internal)
        .def_prop_ro("scale", [](const cfree::Scene& s) { return integer(s.scale); })
        .def_ro("shift", &cfree::Scene::shift)
        .def_prop_ro("frame", [](const cfree::Scene& s) { return std::apply([](auto... c) { return std::tuple(c...); }, s.frame); })
        .def("named", [](const cfree::Scene& scene, const Column<std::uint64_t>& codes) {
            const cfree::Representatives names(scene);
            auto found = vector_of(codes);
            for (auto& feature : found) feature = cfree::named(names, feature);
            return array_of(std::move(found));
        }, "codes"_a);
}
