// Fillets and the vertices of the other shape that matter near a contact; theory, "Rounded shapes".
#include "forbidden/near_fillets.hpp"

#include <algorithm>
#include <tuple>

#include "cfree/scene/features.hpp"
#include "collision/shape_boxes.hpp"
#include "predicates/round_surfaces.hpp"

namespace cfree {

// The vertices that matter are convex ones, ends of concave arcs and points of convex arcs: those of the shape without its fillets.
// A fillet and a vertex cover nothing of their own circle, nor of that of an arc of which the vertex is a point. Two arcs cover
// nothing of the circle of one of them and what follows the other one on its rim.
std::vector<NearFillet> fillets_near(const Scene& scene, const Feature& contact, double reach) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    std::vector<NearFillet> result;
    if (A.fillets.empty() && O.fillets.empty()) return result;
    const Box around = grown(edge_box(O, contact.obstacle), reach);
    struct Vertex {
        Index vertex, arc;  // the arc of which it is a point, or -1
    };
    const auto vertices = [&](const Shape& s) {
        std::vector<Vertex> list;
        for (Index v = 0; v < s.ring_vertices; ++v)
            if (s.convex[v] && s.layer[v] == body_layer && !(s.has_arcs() && s.is_arc[v])) list.push_back({v, -1});
        for (const Index v : s.fillet_ends) list.push_back({v, -1});
        for (const auto& [v, arc] : s.probes) list.push_back({v, arc});
        std::sort(list.begin(), list.end(), [&](const Vertex& v, const Vertex& w) {
            return std::tuple(s.point[v.vertex], v.vertex, v.arc) < std::tuple(s.point[w.vertex], w.vertex, w.arc);
        });
        list.erase(std::unique(list.begin(), list.end(), [&](const Vertex& v, const Vertex& w) {
            return s.point[v.vertex] == s.point[w.vertex];
        }), list.end());
        return list;
    };
    for (const bool of_robot : {false, true}) {
        const Shape &own = of_robot ? A : O, &other = of_robot ? O : A;
        if (own.fillets.empty()) continue;
        const std::vector<Vertex> list = vertices(other);
        const Index own_vertex = of_robot ? contact.robot : contact.obstacle, other_vertex = of_robot ? contact.obstacle : contact.robot;
        const auto is_at = [](const Shape& s, Index v, Index w) { return s.point[v] == s.point[w]; };
        const auto add = [&](const Shape::Fillet& fillet, Index v, const Shape::Wedge* directions) {
            Box box;
            if (of_robot) box.add(O.x[v], O.y[v]);
            else
                for (const Index w : fillet.vertex) box.add(O.x[w], O.y[w]);
            if (around.meets(box)) result.push_back({&fillet, of_robot, v, directions});
        };
        const auto is_zero = [&](Index v, Index w) { return (own.radius_of(v).exact + other.radius_of(w).exact).is_zero(); };
        const auto touches = [](const Shape& s, Index arc, Index end) { return s.stub_between(arc, end) >= 0; };
        const auto follows = [&](const Shape& s, Index arc, Index v) {  // in the joint at its end, on one rim
            return touches(s, arc, v) && (s.previous[v] == arc || s.previous[arc] == v);
        };
        for (const Shape::Fillet& fillet : own.fillets) {
            const bool is_own = is_circle(contact) && is_at(own, own_vertex, fillet.arc);
            if (!fillet.is_for_arcs) {
                for (const auto& [v, arc] : list)
                    if (is_zero(fillet.vertex[0], v) && !(is_own && (is_at(other, other_vertex, v) || touches(other, other_vertex, v) ||
                                                                     (arc >= 0 && is_at(other, other_vertex, arc)))))
                        add(fillet, v, nullptr);
                continue;
            }
            for (const Shape::Wedge& directions : other.wedges) {
                const Index v = directions.arc;
                if (!is_zero(fillet.vertex[0], v) || !is_zero(fillet.arc, directions.vertex[0])) continue;
                if (is_own && (is_at(other, other_vertex, v) || follows(other, v, other_vertex))) continue;
                if (is_circle(contact) && is_at(other, other_vertex, v) && follows(own, fillet.arc, own_vertex)) continue;
                add(fillet, v, &directions);
            }
        }
    }
    return result;
}

}  // namespace cfree
