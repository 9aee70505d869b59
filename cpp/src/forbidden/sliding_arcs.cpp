// Cut a quadrant at an angle where it is on another circle, and find the parts that nothing covers.
#include "forbidden/sliding_arcs.hpp"

#include <algorithm>

#include "cfree/support/lookout.hpp"
#include "predicates/round_orders.hpp"

namespace cfree {

bool has_normal(RoundJunction& at, const std::vector<std::array<Feature, 2>>& cones, const Feature& pair, const RoundSpot& p) {
    return std::all_of(cones.begin(), cones.end(), [&](const auto& edges) { return at.ahead(edges[0], pair, p) <= 0 && at.ahead(edges[1], pair, p) >= 0; });
}

std::vector<Feature> opposite_circles(const Scene& scene, const Feature& pair, double reach) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Box near = grown(edge_box(O, pair.obstacle), reach);
    const Int radius = A.radius_of(pair.robot).exact + O.radius_of(pair.obstacle).exact;
    const auto are_as_far = [&](Index i, Index j) {
        const auto about = [](const Shape& s, Index v, Index w) { return length_of(s.x[v] - s.x[w], s.y[v] - s.y[w]); };
        const double a = about(A, i, pair.robot), b = about(O, j, pair.obstacle);
        if (std::abs(a - b) > 0x1p-30 * (a + b + reach)) return false;
        const auto u = difference<Int>(A, i, pair.robot), v = difference<Int>(O, j, pair.obstacle);
        return dot(u, u) == dot(v, v) && !dot(u, u).is_zero();
    };
    std::vector<Feature> result;
    for (Index j = 0; j < O.ring_vertices; ++j) {
        if (!O.convex[j] || !O.emit[j] || O.layer[j] != body_layer || !near.meets(edge_box(O, j))) continue;
        for (Index i = 0; i < A.ring_vertices; ++i)
            if (A.convex[i] && A.layer[i] == body_layer && are_as_far(i, j) && Int(radius + A.radius_of(i).exact + O.radius_of(j).exact).is_zero())
                result.push_back({Kind::vertex_vertex, i, j, -1});
    }
    return result;
}

namespace {

class SlidingArcs {
public:
    SlidingArcs(const Scene& s, const HollowQuadrant& q) : scene(s), quadrant(q), pair(q.on.contact), decide(s, q.on) {}

    // Angles of the chart at which the two circles are one: they touch there from inside.
    std::vector<Event> angles(const Feature& circle) {
        const Event first{{}, {}, -1, -1}, last{{}, {}, 1, 1};
        const auto roots = decide.event_roots(circle, {}, first, last);
        if (roots.all_zero) return {};
        std::vector<Event> result(roots.at.begin(), roots.at.end());
        for (const Event& end : {first, last})
            if (sign_at_angle(circle, end) == 0) result.push_back(end);
        return result;
    }

    void add(const Event& e, Index patch, std::vector<Trapezoid>& out) {
        RoundJunction at(scene, quadrant.on.chart, e.lo, e.hi, [&] { return decide.long_root_of(e); }, [&] { return decide.narrowed(e); });
        const std::vector<RoundSpot> ends = cuts(at, e);
        std::optional<std::size_t> from;
        const auto put = [&](std::size_t to) {
            out.push_back({patch, quadrant.on.chart, ends[*from].curve, ends[to].curve, e, e, decide.place(e), decide.place(e)});
            from.reset();
        };
        for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
            heed_stop();
            const bool is_free = is_free_between(at, e, ends[k], ends[k + 1]);
            if (is_free && !from) from = k;
            if (!is_free && from) put(k);
        }
        if (from) put(ends.size() - 1);
    }

private:
    int sign_at_angle(const Feature& f, const Event& e) {
        if (const int sign = decide.event_sign_on(f, {}, e.lo, e.hi); sign != 0) return sign;
        LongRoot root = decide.long_root_of(e);
        return sign_at(decide.round_orders().exactly(f, {}).p, root);
    }
    // True if a surface crosses the circle in two points.
    bool crosses(const Feature& f, const Event& e) {
        const int outside = is_line(f) ? 1 : -1;  // sign of a touch from outside where it is nearer than that
        return sign_at_angle(on_branch(f, 1), e) == outside && sign_at_angle(on_branch(f, -1), e) == -outside;
    }

    // Ends of the quadrant, and places in it where a cone ends or the rim of a cover goes through, in order, each once.
    std::vector<RoundSpot> cuts(RoundJunction& at, const Event& e) {
        const Quadrant turns = quadrant_of(scene, pair);
        const auto seam = [&](int turn) { return at.spot(pair, {Kind::seam, pair.robot, pair.obstacle, turn & 3}, false); };
        const RoundSpot low = seam(turns.begin), high = seam(turns.end);
        std::vector<RoundSpot> result{low, high};
        const auto add_curve = [&](const Feature& curve) {
            const RoundSpot spot = at.spot(pair, curve, false);
            if (!spot.jumps && at.is_between(pair, low, high, spot)) result.push_back(spot);
        };
        for (const auto& edges : quadrant.cones)
            for (const Feature& edge : edges) add_curve(on_branch(edge, 0));
        for (const OpenCover& cover : quadrant.near)
            for (const Feature& f : cover.surfaces) {
                if (const auto line = line_of_joint(scene, pair, f)) add_curve(on_branch(*line, 0));
                else if (crosses(f, e)) add_curve(on_branch(f, 1)), add_curve(on_branch(f, -1));
            }
        std::sort(result.begin(), result.end(), [&](const RoundSpot& p, const RoundSpot& q) { return at.order(pair, p, q) < 0; });
        result.erase(std::unique(result.begin(), result.end(), [&](const RoundSpot& p, const RoundSpot& q) { return at.order(pair, p, q) == 0; }),
                     result.end());
        return result;
    }

    bool is_free_between(RoundJunction& at, const Event& e, const RoundSpot& low, const RoundSpot& high) {
        const RoundSpot place = at.between(pair, low, high);
        RoundJunction quick(scene, quadrant.on.chart, e.lo, e.hi, [&] { return decide.long_root_of(e); });
        quick.ask_doubles_only();
        const auto is_covered = [&](RoundJunction& here) {
            return std::any_of(quadrant.near.begin(), quadrant.near.end(), [&](const OpenCover& cover) { return cover.has(here, place); });
        };
        return !is_covered(quick) && has_normal(at, quadrant.cones, pair, place) && !is_covered(at);
    }

    const Scene& scene;
    const HollowQuadrant& quadrant;
    const Feature& pair;
    Predicates decide;
};

}  // namespace

void add_sliding_arcs(const Scene& scene, const HollowQuadrant& quadrant, const Feature& circle, Index patch, std::vector<Trapezoid>& out) {
    SlidingArcs arcs(scene, quadrant);
    for (const Event& e : arcs.angles(circle)) arcs.add(e, patch, out);
}

}  // namespace cfree
