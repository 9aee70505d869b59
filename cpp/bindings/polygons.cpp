// Polygons and scenes from Python's numbers: what needs no second look is read here, all else is left to Python.
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>

#include "arrays.hpp"
#include "cfree/curves/containment.hpp"
#include "cfree/scene/coordinate_range.hpp"
#include "given_poses.hpp"
#include "integers.hpp"

using namespace nb::literals;
using cfree::Index;
using cfree::Int;
using cfree::Polygon;
using cfree::Ratio;

namespace {

// Rounded to doubles it would be infinite, or may be.
bool is_huge(const Ratio& value) {
    return !value.n.is_zero() && static_cast<int>(msb(abs(value.n))) - static_cast<int>(msb(value.d)) >= 1023;
}

// Numbers of the kinds that are common; false for others, and for what is none.
class Numbers {
public:
    bool read(PyObject* from, Ratio& to) const {
        if (PyFloat_Check(from)) {
            const double value = PyFloat_AsDouble(from);
            if (!std::isfinite(value)) return false;
            to = cfree::ratio_of(value);
            return true;
        }
        const auto* type = reinterpret_cast<PyObject*>(Py_TYPE(from));
        if (type == reinterpret_cast<PyObject*>(&PyLong_Type)) {
            to = {integer(nb::borrow<nb::int_>(from)), 1};
            return !is_huge(to);
        }
        if (PyUnicode_Check(from)) return read_text(from, to);
        if (type == decimal.ptr()) return read_text(nb::steal(PyObject_Str(from)).ptr(), to);
        if (type != fraction.ptr()) return false;
        const auto pair = nb::cast<nb::tuple>(nb::borrow(from).attr("as_integer_ratio")());
        to = {integer(nb::cast<nb::int_>(pair[0])), integer(nb::cast<nb::int_>(pair[1]))};
        return !is_huge(to);
    }

private:
    nb::object fraction = nb::module_::import_("fractions").attr("Fraction");
    nb::object decimal = nb::module_::import_("decimal").attr("Decimal");

    static bool read_text(PyObject* text, Ratio& to) {
        Py_ssize_t size = 0;
        const char* data = text ? PyUnicode_AsUTF8AndSize(text, &size) : nullptr;
        if (!data) return PyErr_Clear(), false;
        const auto found = cfree::ratio_of(std::string_view(data, static_cast<std::size_t>(size)));
        if (found) to = *found;
        return found && !is_huge(to);
    }
};

const Numbers& numbers() {
    static const auto* kept = new Numbers;  // types live as long as Python
    return *kept;
}

// Elements of a list or a tuple; nothing of others.
class Elements {
public:
    explicit Elements(PyObject* of) : sequence(of), is_list(PyList_CheckExact(of)), is_tuple(PyTuple_CheckExact(of)) {}
    explicit operator bool() const { return is_list || is_tuple; }
    Py_ssize_t size() const { return is_list ? PyList_Size(sequence) : PyTuple_Size(sequence); }
    PyObject* operator[](Py_ssize_t k) const { return is_list ? PyList_GetItem(sequence, k) : PyTuple_GetItem(sequence, k); }

private:
    PyObject* sequence;
    bool is_list, is_tuple;
};

bool read_ring(PyObject* from, cfree::RatioRing& to) {
    const Elements rows(from);
    if (!rows) return false;
    const Py_ssize_t n = rows.size();
    to.resize(static_cast<std::size_t>(n));
    for (Py_ssize_t k = 0; k < n; ++k) {
        const Elements row(rows[k]);
        auto& point = to[static_cast<std::size_t>(k)];
        if (!row || row.size() != 2 || !numbers().read(row[0], point.x) || !numbers().read(row[1], point.y)) return false;
    }
    return true;
}

// Pieces as pairs: points, and the last parameter of an arc.
cfree::ClosedCurve curve_of(const nb::list& pieces) {
    cfree::ClosedCurve curve(pieces.size());
    for (std::size_t k = 0; k < curve.size(); ++k) {
        const nb::object item = pieces[k];
        const Elements pair(item.ptr());
        if (!pair || pair.size() != 2 || !read_ring(pair[0], curve[k].points) || !numbers().read(pair[1], curve[k].last))
            throw std::invalid_argument("a piece of a curve is a pair of points and a number");
    }
    return curve;
}

// Polygons are in the memory of their Python objects.
std::optional<Polygon> polygon_of(nb::handle rings) {
    const Elements items(rings.ptr());
    if (!items) return {};
    std::vector<cfree::RatioRing> read(static_cast<std::size_t>(items.size()));
    for (Py_ssize_t r = 0; r < items.size(); ++r)
        if (!read_ring(items[r], read[static_cast<std::size_t>(r)])) return {};
    return read.empty() ? std::optional<Polygon>() : Polygon(std::move(read));
}

// Polygons without holes, one for each ring; none for what is to be looked at by itself, or is wrong.
nb::list polygons_of(const nb::list& outers) {
    nb::list found;
    for (const nb::handle outer : outers) {
        std::vector<cfree::RatioRing> read(1);
        std::optional<Polygon> polygon;
        try {
            if (read_ring(outer.ptr(), read[0])) polygon.emplace(std::move(read));
        } catch (const cfree::InvalidPolygon&) {  // said where its place is known
        }
        found.append(std::move(polygon));
    }
    return found;
}

using GivenRounding = std::pair<nb::object, std::vector<std::vector<nb::object>>>;
cfree::Rounding rounding_of(const GivenRounding& given) {
    cfree::Rounding result{::ratio_of(given.first), {}};
    for (const auto& arc : given.second) {
        if (arc.size() != 7 && arc.size() != 11)
            throw nb::value_error("an arc has seven numbers: x and y of its ends and centre, and the radius; "
                                  "a concave one four more, of two points beyond it");
        const auto number = [&](std::size_t k) { return ::ratio_of(arc[k]); };
        result.arcs.push_back({{number(0), number(1)}, {number(2), number(3)}, {number(4), number(5)}, number(6)});
        if (arc.size() == 11) result.arcs.back().beyond = {cfree::RatioPoint{number(7), number(8)}, cfree::RatioPoint{number(9), number(10)}};
    }
    return result;
}

std::vector<cfree::Rounding> roundings_of(const std::vector<GivenRounding>& given) {
    std::vector<cfree::Rounding> result;
    for (const GivenRounding& one : given) result.push_back(rounding_of(one));
    return result;
}

cfree::SceneShapes shapes_of(std::vector<std::shared_ptr<Polygon>> robot, std::vector<std::shared_ptr<Polygon>> obstacles,
                             std::shared_ptr<Polygon> workspace, std::optional<std::array<nb::object, 4>> bounds) {
    cfree::SceneShapes shapes{{robot.begin(), robot.end()}, {obstacles.begin(), obstacles.end()}, std::move(workspace), {}};
    if (!bounds) return shapes;
    shapes.bounds.emplace();
    for (std::size_t k = 0; k < 4; ++k)
        if (!numbers().read((*bounds)[k].ptr(), (*shapes.bounds)[k])) {
            // beyond all doubles, and so of the range
            const auto pair = nb::cast<nb::tuple>((*bounds)[k].attr("as_integer_ratio")());
            (*shapes.bounds)[k] = {integer(nb::cast<nb::int_>(pair[0])), integer(nb::cast<nb::int_>(pair[1]))};
        }
    return shapes;
}

}  // namespace

void bind_polygons(nb::module_& m) {
    nb::register_exception_translator([](const std::exception_ptr& p, void*) {
        try {
            std::rethrow_exception(p);
        } catch (const cfree::InvalidPolygon& error) {
            const nb::object type = nb::module_::import_("cfree.errors").attr("InvalidPolygonError");
            nb::list edges;
            for (const Index e : error.edges) edges.append(e);
            const nb::object ring = error.ring < 0 ? nb::none() : nb::object(nb::int_(error.ring));
            PyErr_SetObject(type.ptr(), type(error.what(), "ring"_a = ring, "edges"_a = nb::tuple(edges)).ptr());
        } catch (const cfree::BrokenInvariant& error) {
            const nb::object type = nb::module_::import_("cfree.errors").attr("InvariantError");
            PyErr_SetObject(type.ptr(), type(error.what()).ptr());
        }
    });
    nb::class_<Polygon>(m, "Polygon")
        .def_static("of", &polygon_of, "rings"_a, nb::sig("def of(rings: Sequence[typing.Any]) -> Polygon | None"))
        .def_static("thin", [](const nb::object& points) -> std::optional<Polygon> {
            cfree::RatioRing ring;
            if (!read_ring(points.ptr(), ring)) return {};
            return Polygon::thin(ring);
        }, "points"_a, "A point, or a segment.", nb::sig("def thin(points: list[typing.Any]) -> Polygon | None"))
        .def_static("of_each", &polygons_of, "outers"_a, nb::sig("def of_each(outers: list[typing.Any]) -> list[Polygon | None]"))
        .def_prop_ro("numerators", [](const Polygon& p) {
            const auto [x, y] = p.vertices.coordinates();
            return integers(x, y);
        },
                     nb::for_getter(nb::sig("def numerators(self) -> tuple[tuple[int, int], ...]")))
        .def_prop_ro("denominator", [](const Polygon& p) { return integer(p.denominator); })
        .def_prop_ro("ring_offsets", [](const Polygon& p) { return p.offsets; })
        .def_prop_ro("removed", [](const Polygon& p) {
            std::vector<std::tuple<Index, Index, bool>> removed;
            for (const auto& r : p.removed) removed.emplace_back(r.ring, r.index, r.repeated);
            return removed;
        })
        .def_prop_ro("vertices", [](const Polygon& p) {
            std::vector<double> xy;
            for (Index k = 0; k < p.vertices.size(); ++k)
                for (const Int& c : {p.vertices.X(k), p.vertices.Y(k)}) xy.push_back(cfree::nearest(c, p.denominator));
            auto* kept = new std::vector<double>(std::move(xy));
            nb::capsule owner(kept, [](void* q) noexcept { delete static_cast<std::vector<double>*>(q); });
            return Made<const double, 2>(kept->data(), {kept->size() / 2, 2}, owner);
        }, nb::rv_policy::automatic)
        .def_prop_ro("box", [](const Polygon& p) {  // least x, least y, greatest x, greatest y
            const auto box = p.vertices.box();
            const auto rounded = [&](std::size_t k) { return cfree::nearest(box[k], p.denominator); };
            return std::tuple(rounded(0), rounded(1), rounded(2), rounded(3));
        })
        .def_prop_ro("convex", [](const Polygon& p) {
            return Made<const bool>(reinterpret_cast<const bool*>(p.convex.data()), {p.convex.size()});
        })
        .def_prop_ro("is_convex", &Polygon::is_convex)
        .def_prop_ro("pieces", &Polygon::pieces)
        .def("is_inside", &cfree::is_inside, "outer"_a)
        .def("is_around", [](const Polygon& p, Index ring, const nb::list& curve) { return cfree::is_around(p, ring, curve_of(curve)); },
             "ring"_a, "curve"_a, nb::sig("def is_around(self, ring: int, curve: list[typing.Any]) -> bool"))
        .def("is_within", [](const Polygon& p, Index ring, const nb::list& curve) { return cfree::is_within(p, ring, curve_of(curve)); },
             "ring"_a, "curve"_a, nb::sig("def is_within(self, ring: int, curve: list[typing.Any]) -> bool"))
        .def("__len__", [](const Polygon& p) { return p.vertices.size(); });
    nb::class_<cfree::Owners> owners(m, "Owners");
    column(owners, "polygon", &cfree::Owners::polygon);
    column(owners, "vertex", &cfree::Owners::vertex);
    column(owners, "polygon_of_end", &cfree::Owners::polygon_of_end);
    nb::class_<cfree::WholeScene>(m, "WholeScene")
        .def("__init__", [](cfree::WholeScene* w, const nb::int_& scale, const std::optional<std::array<nb::int_, 4>>& box,
                            const std::optional<nb::int_>& short_part, const std::optional<std::vector<GivenRounding>>& robot,
                            const std::optional<std::vector<GivenRounding>>& facing) {
            new (w) cfree::WholeScene{integer(scale)};
            if (short_part) w->short_part = integer(*short_part);
            if (box) w->box = std::array{integer((*box)[0]), integer((*box)[1]), integer((*box)[2]), integer((*box)[3])};
            w->is_round = robot.has_value();
            if (robot) w->robot = roundings_of(*robot);
            if (facing) w->facing = roundings_of(*facing);
        }, "scale"_a, "box"_a.none(), "short_part"_a.none(), "robot"_a.none() = nb::none(), "facing"_a.none() = nb::none(),
             "Without roundings of the robot, none of the shapes is rounded. Without a short part, it is that of the obstacles added.",
             nb::sig("def __init__(self, scale: int, box: Sequence[int] | None, short_part: int | None, "
                     "robot: Sequence[tuple[fractions.Fraction, Sequence[Sequence[fractions.Fraction]]]] | None = None, "
                     "facing: Sequence[tuple[fractions.Fraction, Sequence[Sequence[fractions.Fraction]]]] | None = None) -> None"))
        .def("add", [](cfree::WholeScene& w, const Polygon& polygon, const std::optional<GivenRounding>& rounding) {
            w.add(polygon, rounding ? rounding_of(*rounding) : cfree::Rounding());
        }, "polygon"_a, "rounding"_a.none() = nb::none(),
             nb::sig("def add(self, polygon: Polygon, rounding: tuple[fractions.Fraction, Sequence[Sequence[fractions.Fraction]]] | None = None) -> None"))
        .def_prop_ro("facing", [](const cfree::WholeScene& w) {
            using Numbers = std::vector<std::pair<nb::int_, nb::int_>>;
            std::vector<std::pair<std::pair<nb::int_, nb::int_>, std::vector<Numbers>>> all;
            const auto pair = [](const cfree::Ratio& x) { return std::pair(integer(x.n), integer(x.d)); };
            for (const cfree::Rounding& rounding : w.facing) {
                all.emplace_back(pair(rounding.radius), std::vector<Numbers>());
                for (const cfree::Arc& arc : rounding.arcs) {
                    Numbers numbers;
                    const auto add = [&](const cfree::RatioPoint& p) { numbers.push_back(pair(p.x)), numbers.push_back(pair(p.y)); };
                    for (const auto* p : {&arc.from, &arc.to, &arc.centre}) add(*p);
                    numbers.push_back(pair(arc.radius));
                    if (arc.beyond)
                        for (const auto& p : *arc.beyond) add(p);
                    all.back().second.push_back(std::move(numbers));
                }
            }
            return all;
        }, "Roundings by numerators and denominators.")
        .def_prop_ro("scale", [](const cfree::WholeScene& w) { return integer(w.scale); })
        .def_prop_ro("short_part", [](const cfree::WholeScene& w) { return integer(w.short_part.value_or(w.shared.short_part())); })
        .def_prop_ro("box", [](const cfree::WholeScene& w) {
            using Box = std::optional<std::tuple<nb::int_, nb::int_, nb::int_, nb::int_>>;
            return w.box ? std::apply([](const auto&... c) { return Box({integer(c)...}); }, *w.box) : Box();
        });
    nb::class_<cfree::SceneFeatures>(m, "SceneFeatures")
        .def("__init__", [](cfree::SceneFeatures* f, std::vector<std::shared_ptr<Polygon>> robot,
                            std::vector<std::shared_ptr<Polygon>> obstacles, std::shared_ptr<Polygon> workspace,
                            std::optional<std::array<nb::object, 4>> bounds, const cfree::WholeScene* whole,
                            const std::optional<std::vector<GivenRounding>>& rounding, Index frames) {
            cfree::SceneShapes shapes = shapes_of(std::move(robot), std::move(obstacles), std::move(workspace), std::move(bounds));
            shapes.frames = frames;
            for (std::size_t k = 0; rounding && k < rounding->size(); ++k)
                (k < shapes.robot.size() ? shapes.robot_rounding : shapes.obstacle_rounding).push_back(rounding_of((*rounding)[k]));
            new (f) cfree::SceneFeatures(cfree::scene_features(shapes, whole ? *whole : cfree::WholeScene{}));
        }, "robot"_a, "obstacles"_a, "workspace"_a.none(), "bounds"_a.none(), "whole"_a.none() = nb::none(),
             "rounding"_a.none() = nb::none(), "frames"_a = 0,
             "How the robot's polygons and the obstacles are rounded: the radius by which each is grown, and its sides that are "
             "arcs, by x and y of their ends and centre, and radius. The last `frames` obstacles are the complement of the workspace.",
             nb::sig("def __init__(self, robot: Sequence[Polygon], obstacles: Sequence[Polygon], workspace: Polygon | None, "
                     "bounds: Sequence[fractions.Fraction] | None, whole: WholeScene | None = None, "
                     "rounding: Sequence[tuple[fractions.Fraction, Sequence[Sequence[fractions.Fraction]]]] | None = None, frames: int = 0) -> None"))
        .def_ro("scene", &cfree::SceneFeatures::scene)
        .def_ro("robot", &cfree::SceneFeatures::robot)
        .def_ro("obstacles", &cfree::SceneFeatures::obstacles)
        .def_prop_ro("rim", [](const cfree::SceneFeatures& f) {
            using Box = std::optional<std::tuple<double, double, double, double>>;
            return f.rim ? std::apply([](auto... c) { return Box({c...}); }, *f.rim) : Box();
        });
    m.def("range_fault", [](const nb::list& robot, const nb::list& obstacles, const Polygon* workspace,
                            std::optional<std::array<nb::object, 4>> bounds) {
        cfree::SceneShapes shapes = shapes_of({}, {}, {}, std::move(bounds));
        // Python owns the polygons as long as this takes
        const auto borrowed = [](const Polygon* polygon) { return std::shared_ptr<const Polygon>(std::shared_ptr<const Polygon>(), polygon); };
        for (const auto& [from, to] : {std::pair{&robot, &shapes.robot}, {&obstacles, &shapes.obstacles}}) {
            to->reserve(from->size());
            for (const nb::handle polygon : *from) to->push_back(borrowed(nb::cast<const Polygon*>(polygon)));
        }
        if (workspace) shapes.workspace = borrowed(workspace);
        const auto fault = cfree::range_fault(shapes);
        using Answer = std::optional<std::tuple<std::string, Index, std::string>>;
        return fault ? Answer({fault->kind, fault->index, fault->message}) : Answer();
    }, "robot"_a, "obstacles"_a, "workspace"_a.none(), "bounds"_a.none(),
       nb::sig("def range_fault(robot: list[Polygon], obstacles: list[Polygon], workspace: Polygon | None, "
               "bounds: Sequence[fractions.Fraction] | None) -> tuple[str, int, str] | None"));
}
