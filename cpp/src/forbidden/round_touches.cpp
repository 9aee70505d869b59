// Curves along which another surface touches a patch from its free side, at every angle: free space is pinched there; theory,
// "Rounded shapes".
#include <algorithm>

#include "cfree/contact/contact_line.hpp"
#include "cfree/scene/features.hpp"
#include "forbidden/coincident_surfaces.hpp"
#include "forbidden/round_trim.hpp"

namespace cfree {

// Two surfaces touch at every angle only if the robot's place is one for both, a disc's centre or the reference point, or if the
// obstacles' is, a disc's centre. In the plane of the other shape they then stand still.
struct RoundTrimmer::Touch {
    Feature feature;
    Vec<Int> towards;  // from the centre of the patch's circle, in the plane of the obstacles, or of the robot
    bool turns;        // true in that of the robot
};

// Ring vertices of some pieces of the obstacles, each once, and of the bounds, which are the last.
static std::vector<Index> ring_vertices(const Shape& O, const std::vector<Index>& pieces) {
    std::vector<Index> result;
    for (const Index k : pieces)
        for (Index p = O.piece[k]; p < O.piece[k + 1]; ++p)
            if (O.piece_vertex[p] < O.ring_vertices) result.push_back(O.piece_vertex[p]);
    for (Index v = O.ring_vertices - 1; v >= 0 && O.layer[v] == reference_layer; --v) result.push_back(v);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

std::vector<RoundTrimmer::Touch> RoundTrimmer::touches(const std::vector<Index>& pieces) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Feature& own = surface.contact;
    const bool is_circle_here = is_circle(own);
    const Index i = own.robot, j = own.obstacle;
    std::vector<Touch> result;
    // the patch's feature of one shape against a vertex or an edge of this shape, at distances from the common place of the other
    const auto add = [&](const Shape& s, Index mine, Index other, bool is_edge, const Int& my_distance, const Int& other_distance,
                         const Feature& feature) {
        const Int both = my_distance + other_distance;  // below 0 if one of them is a concave arc, and the other one touches it from inside
        const bool is_inside = both.sign() < 0;
        const auto is_tangent = [&](Index e, Index v) {
            const Vec<Int> E = edge<Int>(s, e);
            const Int outwards = -cross(E, difference<Int>(s, v, s.v[e]));
            return outwards.sign() >= 0 && outwards * outwards == both * both * dot(E, E);
        };
        if (is_circle_here && is_edge) {
            const Vec<Int> E = edge<Int>(s, other);
            if (!is_inside && is_tangent(other, mine)) result.push_back({feature, {-E.y, E.x}, &s == &A});
        } else if (is_circle_here) {
            const Vec<Int> d = difference<Int>(s, other, mine);
            if (dot(d, d) == both * both && !both.is_zero())
                result.push_back({feature, is_inside ? Vec<Int>{-d.x, -d.y} : d, &s == &A});
        } else if (!is_inside && is_tangent(mine, other)) {
            result.push_back({feature, {}, &s == &A});
        }
    };
    // around one place of the robot
    if (own.kind != Kind::edge_vertex) {
        const std::vector<Index> near = ring_vertices(O, pieces);
        const bool is_reference = A.layer[i] == reference_layer;
        const Int mine = A.radius_of(i).exact + (is_circle_here ? O.radius_of(j).exact : O.radius_of(O.v[j]).exact);
        for (Index i2 = 0; i2 < A.ring_vertices; ++i2) {
            if (A.X[i2] != A.X[i] || A.Y[i2] != A.Y[i] || (i2 == i && A.has_extent(i)) || (is_reference && A.layer[i2] == reference_layer)) continue;
            const auto add_at = [&](Index v) {
                if (O.layer[v] != A.layer[i2] || !O.emit[v]) return;
                if ((O.convex[v] && A.convex[i2]) || makes_circles(scene, i2, v))
                    add(O, j, v, false, mine, A.radius_of(i2).exact + O.radius_of(v).exact, {Kind::vertex_vertex, i2, v, 1});
                if (is_circle_here && O.makes_surfaces(v) && A.convex[i2])
                    add(O, j, v, true, mine, A.radius_of(i2).exact + O.radius_of(v).exact, {Kind::vertex_edge, i2, v, 1});
            };
            if (A.layer[i2] == reference_layer) {
                for (Index v = 0; v < O.ring_vertices; ++v) add_at(v);
                continue;
            }
            for (const Index v : near) add_at(v);
        }
    }
    // around one place of the obstacles
    if (own.kind != Kind::vertex_edge && O.layer[j] == body_layer) {
        const Int mine = O.radius_of(j).exact + (is_circle_here ? A.radius_of(i).exact : A.radius_of(A.v[i]).exact);
        for (const Index j2 : ring_vertices(O, pieces)) {
            if (O.X[j2] != O.X[j] || O.Y[j2] != O.Y[j] || O.layer[j2] != body_layer || !O.emit[j2] || (j2 == j && O.has_extent(j))) continue;
            for (Index v = 0; v < A.ring_vertices; ++v) {
                if (A.layer[v] != body_layer) continue;
                const Int other = A.radius_of(v).exact + O.radius_of(j2).exact;
                if ((A.convex[v] && O.convex[j2]) || makes_circles(scene, v, j2)) add(A, i, v, false, mine, other, {Kind::vertex_vertex, v, j2, 1});
                if (is_circle_here && A.makes_surfaces(v) && O.convex[j2]) add(A, i, v, true, mine, other, {Kind::edge_vertex, v, j2, 1});
            }
        }
    }
    return result;
}

// Angles at which an edge that is parallel to the patch's at every angle touches it from the free side: free space is
// pinched along a segment there.
void RoundTrimmer::find_pinches(const std::vector<Index>& pieces) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Feature& own = surface.contact;
    const auto find_touches_of = [&](const Feature& circle) {
        const auto [a, b, c] = RoundSurfaces<Approx>(scene).tangency(own, circle, 1);  // a + b cos + c sin has a double root
        const double most = a.m + b.m + c.m;
        if (std::abs(a.v * a.v - b.v * b.v - c.v * c.v) > 8 * round_error * most * most + tiny) return;  // certainly not
        for (const Event& root : decide.event_roots({circle.kind, circle.robot, circle.obstacle, 1}, {}, events[0], events[1]).at)
            if (root.is_touch) pinches.push_back(intern(root));
    };
    for (const Index v : ring_vertices(O, pieces)) {
        const bool is_parallel = own.kind == Kind::vertex_edge && O.makes_surfaces(v) && O.direction[v] == O.direction[own.obstacle];
        if (!is_parallel && (own.kind != Kind::edge_vertex || !O.convex[v])) continue;
        for (Index i = 0; i < A.ring_vertices; ++i) {
            if (A.layer[i] != O.layer[v]) continue;
            if (is_parallel && A.convex[i]) find_touches_of({Kind::vertex_vertex, i, O.v[v]});
            if (!is_parallel && A.makes_surfaces(i) && A.direction[i] == A.direction[own.robot]) find_touches_of({Kind::vertex_vertex, A.v[i], v});
        }
    }
}

void RoundTrimmer::split_at_touches(const std::vector<Index>& pieces) {
    if (live.empty()) return;
    if (is_line(surface.contact)) find_pinches(pieces);
    const auto split_between = [&](Index from, Index to, const Feature& feature) {
        const Index t = curve_of(feature, false);
        Area seam{from, to, t, t, 0, 1};
        bounds(seam);
        subtract_from_live({seam, -1, -1, nullptr});
    };
    for (const Touch& touch : touches(pieces)) {
        if (is_line(surface.contact)) {
            split_between(0, 1, touch.feature);
            continue;
        }
        // the place is in the quadrant between two angles at which it is in an end of it
        std::vector<Event> cuts;
        if (touch.turns)
            for (const Feature& seam : quadrant()) {
                const auto roots = decide.event_roots(touch.feature, seam, events[0], events[1]);
                cuts.insert(cuts.end(), roots.at.begin(), roots.at.end());
            }
        for (const auto& [from, to] : spans_between(std::move(cuts))) {
            Vec<Int> to_place = touch.towards;
            if (touch.turns) {
                const Dyadic tau = decide.between(events[from], events[to]).exact();
                const auto R = rotation_by(surface.chart, tau.n, Int(1) << tau.k);
                const Vec<Int> turned = R(to_place);
                to_place = {-turned.x, -turned.y};
            }
            for (int turns = surface.contact.branch; turns > 0; --turns) to_place = {to_place.y, -to_place.x};  // the quadrant becomes the first
            if (to_place.x.sign() > 0 && to_place.y.sign() > 0) split_between(from, to, touch.feature);
        }
    }
}

}  // namespace cfree
