// Ranges of contacts, and owners of parts that several share; theory, "Surfaces that coincide".
#include "forbidden/coincident_surfaces.hpp"

#include <algorithm>

#include "cfree/scene/features.hpp"

namespace cfree {

Range range_of(const Scene& scene, const Feature& contact, Counters& counters) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = contact.robot, j = contact.obstacle;
    const Event first_end{{}, {}, -1, -1}, last_end{{}, {}, 1, 1};
    const bool on_edge = contact.kind == Kind::vertex_edge;
    // a circle, and a point, touch at every orientation; the cones of a circle's vertices are not heeded here
    if (contact.kind == Kind::vertex_vertex || (on_edge ? A.previous[i] == i : O.previous[j] == j))
        return {2, {0, 1}, {first_end, first_end}, {last_end, last_end}};
    const auto start = on_edge ? Predicates::range_end(scene, i, j, true, counters)
                               : Predicates::range_end(scene, i, O.previous[j], true, counters);
    const auto end = on_edge ? Predicates::range_end(scene, A.previous[i], j, false, counters)
                             : Predicates::range_end(scene, i, j, false, counters);
    if (start.chart == end.chart) return {1, {start.chart, 0}, {start.event, {}}, {end.event, {}}};
    return {2, {start.chart, end.chart}, {start.event, first_end}, {last_end, end.event}};
}

CoincidentSurfaces::Groups::Groups(const std::vector<Index>& group, Index count) {
    Index last = -1;
    for (Index k = 0; k < count; ++k) last = std::max(last, group[k]);
    start.assign(static_cast<std::size_t>(last) + 2, 0);
    for (Index k = 0; k < count; ++k) ++start[group[k] + 1];
    for (std::size_t g = 1; g < start.size(); ++g) start[g] += start[g - 1];
    member.resize(count);
    std::vector<Index> at(start.begin(), start.end() - 1);
    for (Index k = 0; k < count; ++k) member[at[group[k]]++] = k;
}

CoincidentSurfaces::CoincidentSurfaces(const Scene& s, bool without_slits)
    : scene(s), regularized(without_slits), robot_points(s.robot.point, s.robot.ring_vertices),
      robot_lines(s.robot.line, s.robot.ring_vertices), obstacle_points(s.obstacles.point, s.obstacles.ring_vertices),
      obstacle_lines(s.obstacles.line, s.obstacles.ring_vertices) {}

std::array<Index, 2> CoincidentSurfaces::rank(const Feature& contact) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = contact.robot, j = contact.obstacle;
    if (contact.kind == Kind::vertex_edge) return {A.vertex_rank[i], O.edge_rank[j]};
    if (contact.kind == Kind::vertex_vertex) return {A.vertex_rank[i], O.vertex_rank[j]};
    return {A.edge_rank[i], O.vertex_rank[j]};
}

bool CoincidentSurfaces::is_patch(const Feature& contact) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = contact.robot, j = contact.obstacle;
    if (!O.emit[j] || A.layer[i] != O.layer[j]) return false;
    if (contact.kind == Kind::vertex_vertex) return A.convex[i] && O.convex[j];
    return contact.kind == Kind::vertex_edge ? A.convex[i] && O.makes_surfaces(j) : O.convex[j] && A.makes_surfaces(i);
}

std::vector<Feature> CoincidentSurfaces::before(const Feature& contact) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const bool on_edge = contact.kind == Kind::vertex_edge, of_vertex = contact.kind != Kind::edge_vertex;
    const Groups &robots = of_vertex ? robot_points : robot_lines, &others = on_edge ? obstacle_lines : obstacle_points;
    const Index r = of_vertex ? A.point[contact.robot] : A.line[contact.robot];
    const Index o = on_edge ? O.line[contact.obstacle] : O.point[contact.obstacle];
    std::vector<Feature> result;
    for (Index x = robots.start[r]; x < robots.start[r + 1]; ++x)
        for (Index y = others.start[o]; y < others.start[o + 1]; ++y) {
            const Feature other{contact.kind, robots.member[x], others.member[y], contact.branch};
            if (is_patch(other) && rank(other) < rank(contact)) result.push_back(other);
        }
    if (regularized && on_edge) add_opposite(contact, result);
    return result;
}

std::vector<Index> CoincidentSurfaces::edges_at(Index vertex) const {
    const Shape& O = scene.obstacles;
    std::vector<Index> edges;
    for (Index k = obstacle_points.start[O.point[vertex]]; k < obstacle_points.start[O.point[vertex] + 1]; ++k) {
        const Index j = obstacle_points.member[k];
        if (O.has_extent(j)) edges.insert(edges.end(), {O.previous[j], j});
    }
    return edges;
}

// True if the second edge of obstacles is on the line of the first, and runs the other way.
static bool is_opposite(const Shape& O, Index j, Index other) {
    if (O.direction[j] != O.direction[other]) return false;
    const auto E = edge<Int>(O, j), F = edge<Int>(O, other);
    return dot(E, F).sign() < 0 && cross(E, difference<Int>(O, O.v[other], O.v[j])).is_zero();
}

// The same surface with the other side forbidden: a robot vertex at the reference point, an obstacle edge on a bound.
void CoincidentSurfaces::add_opposite(const Feature& contact, std::vector<Feature>& out) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = contact.robot, j = contact.obstacle;
    for (Index i2 = 0; i2 < A.ring_vertices; ++i2) {
        if (A.point[i2] != A.point[i] || A.layer[i2] == A.layer[i]) continue;
        for (Index j2 = 0; j2 < O.ring_vertices; ++j2) {
            const Feature other{Kind::vertex_edge, i2, j2};
            if (is_patch(other) && is_opposite(O, j, j2)) out.push_back(other);
        }
    }
}

bool may_have_slits(const Scene& scene) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    std::vector<Index> points, bounds;
    for (Index i = 0; i < A.ring_vertices; ++i)
        if (A.layer[i] == reference_layer) points.push_back(A.point[i]);
    bool is_at_vertex = false;
    for (Index i = 0; i < A.ring_vertices; ++i)
        is_at_vertex |= A.layer[i] == body_layer && std::count(points.begin(), points.end(), A.point[i]) > 0;
    if (!is_at_vertex) return false;
    for (Index j = 0; j < O.ring_vertices; ++j)
        if (O.layer[j] == reference_layer) bounds.push_back(j);
    for (Index j = 0; j < O.ring_vertices; ++j)
        if (O.layer[j] == body_layer && O.emit[j])
            for (const Index bound : bounds)
                if (is_opposite(O, bound, j)) return true;
    return false;
}

}  // namespace cfree
