// The predicates, flat, for tests: they are compared with references in Python. Features are
// packed; an event is (first, second, lo, hi, fine), a sample (tau, None or (n, k) for n / 2^k).
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "cfree/forbidden/critical_angle.hpp"
#include "cfree/forbidden/curve_hashes.hpp"
#include "cfree/predicates/junction.hpp"
#include "polynomials.hpp"

namespace nb = nanobind;
using namespace nb::literals;
using cfree::Code;
using cfree::Index;

using EventTuple = std::tuple<Code, Code, double, double, Index>;
using SampleTuple = std::tuple<double, std::optional<DyadicPair>>;
using FilteredTuple = std::array<double, 4>;  // a, b, c, err

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

static std::vector<EventTuple> events(const cfree::Few<cfree::Event, 6>& at) {
    std::vector<EventTuple> list;
    for (const cfree::Event& x : at) list.push_back(event(x));
    return list;
}
static std::pair<std::vector<EventTuple>, bool> roots(const cfree::Predicates::Roots& r) {
    return {events(r.at), r.all_zero};
}

namespace {

struct OnScene {  // keeps what it decides about
    std::shared_ptr<const cfree::Scene> shared;
    const cfree::Scene& scene;
    cfree::Surface surface;
    cfree::Predicates decide;
    OnScene(std::shared_ptr<const cfree::Scene> s, const cfree::Surface& on)
        : shared(std::move(s)), scene(*shared), surface(on), decide(scene, surface) {}
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
        : exact(on.angle(x)), at(on.scene, on.surface.chart, exact.lo, exact.hi, [this, &on] { return exact.exact(on.scene); },
                                 [this, &on] { return exact.bracket(on.scene); }) {
        if (knows) know(at, on.scene, exact);
    }
    AtAngle(const AtAngle&) = delete;
    cfree::Spot spot(const PlaceTuple& x) const { return at.spot(cfree::unpacked(x.first), cfree::unpacked(x.second)); }

private:
    cfree::CriticalAngle exact;

public:
    cfree::Junction at;
};

}  // namespace

static void bind_signs(nb::module_& m) {
    nb::class_<OnScene>(m, "Predicates")
        .def("__init__", [](OnScene* p, std::shared_ptr<const cfree::Scene> scene, Code contact, int chart) {
            new (p) OnScene(std::move(scene), {cfree::unpacked(contact), chart});
        }, "scene"_a, "contact"_a, "chart"_a)
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
            return std::tuple(events(r.at), std::vector<int>(r.sign, r.sign + r.at.size() + 1), r.strict);
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
}

static void bind_junction(nb::module_& m) {
    nb::class_<AtAngle>(m, "Junction")
        .def("__init__", [](AtAngle* j, const OnScene& on, const EventTuple& x, bool knows) {
            new (j) AtAngle(on, x, knows);
        }, "on"_a, "angle"_a, "knows"_a, nb::keep_alive<1, 2>())
        .def("turn", [](AtAngle& j, Code x, Code y) {
            return j.at.turn(cfree::unpacked(x), cfree::unpacked(y));
        }, "x"_a, "y"_a)
        .def("parallel", [](AtAngle& j, Code x, Code y) {
            return j.at.parallel(cfree::unpacked(x), cfree::unpacked(y));
        }, "x"_a, "y"_a)
        .def("side", [](AtAngle& j, Code x, Code y) {
            return j.at.side(cfree::unpacked(x), cfree::unpacked(y));
        }, "x"_a, "y"_a)
        .def("offset", [](const AtAngle& j, Code x, Code y) {
            const auto [lo, hi] = j.at.offset(cfree::unpacked(x), cfree::unpacked(y));
            return std::pair(lo, hi);
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
        }, "line"_a, "place"_a)
        .def("range", [](const AtAngle& j, Code line, const PlaceTuple& p) {
            const auto [lo, hi] = j.at.reading(cfree::unpacked(line), j.spot(p)).t;
            return std::pair(lo, hi);
        }, "line"_a, "place"_a);
}

static void bind_curves(nb::module_& m) {
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
}

void bind_predicates(nb::module_& m) {
    bind_signs(m);
    bind_junction(m);
    bind_curves(m);
}
