// The predicates and the polynomials under them, flat, for tests: they are compared with references in Python. Features are
// packed; an event is (first, second, lo, hi, fine), a sample (tau, None or (n, k) for n / 2^k).
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "cfree/forbidden/critical_angle.hpp"
#include "cfree/forbidden/curve_hash.hpp"
#include "cfree/predicates/junction.hpp"
#include "integers.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using cfree::Code;
using cfree::Index;

using EventTuple = std::tuple<Code, Code, double, double, Index>;
using DyadicPair = std::pair<nb::int_, unsigned>;
using SampleTuple = std::tuple<double, std::optional<DyadicPair>>;
using FilteredTuple = std::array<double, 4>;  // a, b, c, err
using Coefficients = std::vector<nb::int_>;
using RootTuple = std::tuple<Coefficients, DyadicPair, DyadicPair>;  // the only root of a polynomial in [lo, hi]

static cfree::Dyadic dyadic(const DyadicPair& d) { return {integer(d.first), d.second}; }
static DyadicPair dyadic(const cfree::Dyadic& d) { return {integer(d.n), d.k}; }

static cfree::Poly polynomial(const Coefficients& c) {
    if (c.size() > 5) throw std::invalid_argument("the degree is at most 4");
    cfree::Poly p;
    for (const auto& x : c) p.push_back(integer(x));
    p.trim();
    return p;
}
static Coefficients polynomial(const cfree::Poly& p) {
    Coefficients c;
    for (const auto& x : p) c.push_back(integer(x));
    return c;
}

static cfree::RealRoot root(const RootTuple& x) {
    const auto& [p, lo, hi] = x;
    return {polynomial(p), dyadic(lo), dyadic(hi)};
}
static cfree::Event event(const EventTuple& x) {
    const auto& [first, second, lo, hi, fine] = x;
    return {cfree::unpacked(first), cfree::unpacked(second), lo, hi, fine};
}
static EventTuple event(const cfree::Event& x) {
    return {cfree::packed(x.first), cfree::packed(x.second), x.lo, x.hi, x.fine};
}
static cfree::Sample sample(const SampleTuple& at) {
    const auto& [tau, fine] = at;
    return {tau, fine ? std::optional(dyadic(*fine)) : std::nullopt};
}
static SampleTuple sample(const cfree::Sample& at) {
    return {at.tau, at.fine ? std::optional(dyadic(*at.fine)) : std::nullopt};
}
static FilteredTuple filtered(const cfree::Filtered& f) { return {f.a, f.b, f.c, f.err}; }

static std::vector<EventTuple> events(const cfree::Event* at, int count) {
    std::vector<EventTuple> list;
    for (int k = 0; k < count; ++k) list.push_back(event(at[k]));
    return list;
}
static std::pair<std::vector<EventTuple>, bool> roots(const cfree::Predicates::Roots& r) {
    return {events(r.at, r.count), r.all_zero};
}

namespace {

struct OnScene {  // owns what it decides about
    cfree::Scene scene;
    cfree::Surface surface;
    cfree::Predicates decide;
    OnScene(const cfree::Shape& robot, const cfree::Shape& obstacles, const cfree::Surface& on)
        : scene{robot, obstacles}, surface(on), decide(scene, surface) {}
    OnScene(const OnScene&) = delete;
    cfree::CriticalAngle angle(const EventTuple& x) const {
        const cfree::Event e = event(x);
        return {surface, e, decide.place(e)};
    }
    cfree::Curve curve(Code code, bool flipped) const {
        cfree::Curve c = decide.curve(cfree::unpacked(code));
        if (flipped) c.N = -c.N, c.D = -c.D, c.flipped = true;
        return c;
    }
};

using PlaceTuple = std::pair<Code, Code>;  // a surface, and the curve on it that arrives there

class AtAngle {  // a junction at a critical angle of a surface
public:
    AtAngle(const OnScene& on, const EventTuple& x, bool knows)
        : exact(on.angle(x)), at(on.scene, on.surface.chart, exact.lo, exact.hi, [this, &on] { return exact.exact(on.scene); }) {
        if (knows) at.know(exact.name(on.scene));
    }
    AtAngle(const AtAngle&) = delete;
    cfree::Spot spot(const PlaceTuple& x) const { return at.spot(cfree::unpacked(x.first), cfree::unpacked(x.second)); }

private:
    cfree::CriticalAngle exact;

public:
    cfree::Junction at;
};

}  // namespace

void bind_predicates(nb::module_& m) {
    nb::class_<OnScene>(m, "Predicates")
        .def("__init__", [](OnScene* p, const cfree::Shape& robot, const cfree::Shape& obstacles, Code contact, int chart) {
            new (p) OnScene(robot, obstacles, {cfree::unpacked(contact), chart});
        }, "robot"_a, "obstacles"_a, "contact"_a, "chart"_a)
        .def("code", [](const OnScene& p, Code f) { return cfree::code(p.scene, cfree::unpacked(f)); }, "feature"_a)
        .def("offset", [](const OnScene& p, Index s, Index v) { return filtered(p.decide.offset(s, v)); }, "s"_a, "v"_a)
        .def("parallel", [](const OnScene& p, Index g, Index f) { return filtered(p.decide.parallel(g, f)); }, "g"_a, "f"_a)
        .def("curve", [](const OnScene& p, Code f) {
            const auto c = p.decide.curve(cfree::unpacked(f));
            return std::pair(filtered(c.N), filtered(c.D));
        }, "feature"_a)
        .def_static("sign_on", [](const FilteredTuple& f, double lo, double hi) {
            return cfree::Predicates::sign_on({f[0], f[1], f[2], f[3]}, lo, hi);
        }, "f"_a, "lo"_a, "hi"_a)
        .def("offset_sign", [](OnScene& p, Index s, Index v, const SampleTuple& at) {
            return p.decide.offset_sign(s, v, p.decide.offset(s, v), sample(at));
        }, "s"_a, "v"_a, "at"_a)
        .def("parallel_sign", [](OnScene& p, Index g, Index f, const SampleTuple& at) {
            return p.decide.parallel_sign(g, f, p.decide.parallel(g, f), sample(at));
        }, "g"_a, "f"_a, "at"_a)
        .def("cross_sign", [](OnScene& p, bool of_robot, Index e, Index f) {
            return p.decide.cross_sign(of_robot ? p.scene.robot : p.scene.obstacles, e, f);
        }, "of_robot"_a, "e"_a, "f"_a)
        .def("order", [](OnScene& p, const EventTuple& x, const EventTuple& y) {
            return p.decide.order(event(x), event(y));
        }, "x"_a, "y"_a)
        .def("order", [](OnScene& p, const EventTuple& x, const SampleTuple& at) {
            return p.decide.order(event(x), sample(at));
        }, "x"_a, "at"_a)
        .def("between", [](OnScene& p, const EventTuple& x, const EventTuple& y, int attempt) {
            return sample(p.decide.between(event(x), event(y), attempt));
        }, "x"_a, "y"_a, "attempt"_a)
        .def("offset_roots", [](OnScene& p, Index s, Index v, const EventTuple& from, const EventTuple& to) {
            return roots(p.decide.offset_roots(s, v, p.decide.offset(s, v), event(from), event(to)));
        }, "s"_a, "v"_a, "from_"_a, "to"_a)
        .def("parallel_roots", [](OnScene& p, Index g, Index f, const EventTuple& from, const EventTuple& to) {
            return roots(p.decide.parallel_roots(g, f, event(from), event(to)));
        }, "g"_a, "f"_a, "from_"_a, "to"_a)
        .def("compare", [](OnScene& p, Code x, bool x_flipped, Code y, bool y_flipped, const EventTuple& from,
                           const EventTuple& to) {
            const auto r = p.decide.compare(p.curve(x, x_flipped), p.curve(y, y_flipped), event(from), event(to));
            return std::tuple(events(r.at, r.count), std::vector<int>(r.sign, r.sign + r.count + 1), r.strict);
        }, "x"_a, "x_flipped"_a, "y"_a, "y_flipped"_a, "from_"_a, "to"_a)
        .def("order_at", [](const OnScene& p, Code x, Code y, const SampleTuple& at) {
            return p.decide.order_at(cfree::unpacked(x), cfree::unpacked(y), sample(at));
        }, "x"_a, "y"_a, "at"_a)
        .def("place", [](const OnScene& p, const EventTuple& x) { return p.decide.place(event(x)); }, "x"_a)
        .def("restored", [](OnScene& p, const EventTuple& x, int place) {
            return event(p.decide.restored(event(x), place));
        }, "x"_a, "place"_a)
        .def("vanishes", [](const OnScene& p, Code first, Code second) {
            return p.decide.vanishes(cfree::unpacked(first), cfree::unpacked(second));
        }, "first"_a, "second"_a)
        .def("range_end", [](OnScene& p, Index g, Index f, bool is_start) {
            const auto end = cfree::Predicates::range_end(p.scene, g, f, is_start, p.decide.counters);
            return std::pair(end.chart, event(end.event));
        }, "g"_a, "f"_a, "is_start"_a)
        .def("counters", [](const OnScene& p) {
            return std::pair(p.decide.counters.filter, p.decide.counters.exact);
        });
    nb::class_<AtAngle>(m, "Junction")
        .def("__init__", [](AtAngle* j, const OnScene& on, const EventTuple& x, bool knows) {
            new (j) AtAngle(on, x, knows);
        }, "on"_a, "angle"_a, "knows"_a, nb::keep_alive<1, 2>())
        .def("parallel", [](AtAngle& j, Code x, Code y) {
            return j.at.parallel(cfree::unpacked(x), cfree::unpacked(y));
        }, "x"_a, "y"_a)
        .def("side", [](AtAngle& j, Code x, Code y) {
            return j.at.side(cfree::unpacked(x), cfree::unpacked(y));
        }, "x"_a, "y"_a)
        .def("side_of_helix", [](AtAngle& j, Code x, Index a, Index b) {
            return j.at.side(cfree::unpacked(x), a, b);
        }, "x"_a, "a"_a, "b"_a)
        .def("side_of_place", [](AtAngle& j, Code x, const PlaceTuple& p) {
            return j.at.side(cfree::unpacked(x), cfree::unpacked(p.first), j.spot(p));
        }, "x"_a, "place"_a)
        .def("order", [](AtAngle& j, Code line, const PlaceTuple& p, const PlaceTuple& q) {
            return j.at.order(cfree::unpacked(line), j.spot(p), j.spot(q));
        }, "line"_a, "p"_a, "q"_a)
        .def("across", [](AtAngle& j, Code x, Code y, const PlaceTuple& p, const PlaceTuple& q, bool after) {
            return j.at.across(cfree::unpacked(x), cfree::unpacked(y), j.spot(p), j.spot(q), after);
        }, "x"_a, "y"_a, "p"_a, "q"_a, "after"_a)
        .def("value", [](AtAngle& j, Code line, const PlaceTuple& p) {
            return j.at.value(cfree::unpacked(line), j.spot(p));
        }, "line"_a, "place"_a);
    m.def("order", [](const OnScene& on_x, const EventTuple& x, const OnScene& on_y, const EventTuple& y) {
        return cfree::order(on_x.scene, on_x.angle(x), on_y.angle(y));
    }, "on_x"_a, "x"_a, "on_y"_a, "y"_a);
    m.def("lies_on", [](const OnScene& p, const PlaceTuple& curve, Code surface) {
        return cfree::lies_on(p.scene, {cfree::unpacked(curve.first), cfree::unpacked(curve.second)}, cfree::unpacked(surface));
    }, "on"_a, "curve"_a, "surface"_a);
    m.def("is_same_curve", [](const OnScene& p, const PlaceTuple& x, const PlaceTuple& y) {
        return cfree::is_same_curve(p.scene, {cfree::unpacked(x.first), cfree::unpacked(x.second)},
                                    {cfree::unpacked(y.first), cfree::unpacked(y.second)});
    }, "on"_a, "x"_a, "y"_a);
    m.def("sign_at", [](const Coefficients& p, const DyadicPair& at) {
        return cfree::sign_at(polynomial(p), dyadic(at));
    }, "p"_a, "at"_a);
    m.def("sign_at", [](const Coefficients& p, const RootTuple& at) {
        auto x = root(at);
        return cfree::sign_at(polynomial(p), x);
    }, "p"_a, "at"_a);
    m.def("sign_before", [](const Coefficients& p, const RootTuple& at) {
        auto x = root(at);
        return cfree::sign_before(polynomial(p), x);
    }, "p"_a, "at"_a);
    m.def("sign_after", [](const Coefficients& p, const RootTuple& at) {
        auto x = root(at);
        return cfree::sign_after(polynomial(p), x);
    }, "p"_a, "at"_a);
    m.def("compare", [](const RootTuple& p, const RootTuple& q) {
        auto x = root(p), y = root(q);
        return cfree::compare(x, y);
    }, "x"_a, "y"_a);
    m.def("greatest_common_divisor", [](const Coefficients& p, const Coefficients& q) {
        return polynomial(cfree::greatest_common_divisor(polynomial(p), polynomial(q)));
    }, "p"_a, "q"_a);
    m.def("squarefree", [](const Coefficients& p) { return polynomial(cfree::squarefree(polynomial(p))); }, "p"_a);
    m.def("isolate", [](const Coefficients& squarefree, const DyadicPair& lo, const DyadicPair& hi, unsigned bits) {
        std::vector<std::pair<DyadicPair, DyadicPair>> found;
        for (const auto& [l, h] : cfree::isolate(cfree::Sturm(polynomial(squarefree)), dyadic(lo), dyadic(hi), bits))
            found.emplace_back(dyadic(l), dyadic(h));
        return found;
    }, "squarefree"_a, "lo"_a, "hi"_a, "bits"_a);
}
