// Ranges of contacts, and owners of parts that several share; theory, "Surfaces that coincide".
#include "forbidden/coincident_surfaces.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

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

bool makes_circles(const Scene& scene, Index i, Index j) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    if (A.convex[i] && O.convex[j]) return A.vertex_radius[i] != 0 || O.vertex_radius[j] != 0;
    const bool is_pair = A.convex[i] ? O.is_concave(j) : O.convex[j] && A.is_concave(i);
    return is_pair && (A.radius_of(i).exact + O.radius_of(j).exact).sign() < 0;
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
      obstacle_lines(s.obstacles.line, s.obstacles.ring_vertices) {
    if (regularized && scene.is_round) slits.emplace(scene);
}

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
    if (contact.kind == Kind::vertex_vertex) return makes_circles(scene, i, j);
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
    if (scene.is_round && on_edge) add_bounds(contact, result);
    if (slits) slits->add_opposite(contact, result);
    else if (regularized && on_edge) add_opposite(contact, result);
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

// --- among grown shapes ----------------------------------------------------------------------------------------------

namespace {

bool is_one_place(const Shape& s, Index v, Index w) { return s.X[v] == s.X[w] && s.Y[v] == s.Y[w]; }

// True if an edge runs to the left, or straight down.
bool is_backward(const Shape& s, Index e) {
    const Vec<Int> E = edge<Int>(s, e);
    return E.x.sign() < 0 || (E.x.is_zero() && E.y.sign() < 0);
}

// Offset of a line from the origin, to the left of the least integer vector D along its direction, times |D|; the line is moved
// by its radius outwards, and then `by` further. D points to one half of the plane. None if that is no integer.
std::optional<Int> moved_offset(const Shape& s, Index e, const Int& by) {
    const Vec<Int> E = edge<Int>(s, e);
    const Int divisor = gcd(abs(E.x), abs(E.y));
    const Vec<Int> D{E.x / divisor, E.y / divisor};
    const Int offset = cross(Vec<Int>{s.X[s.v[e]], s.Y[s.v[e]]}, D), outwards = s.radius_of(s.v[e]).exact + by;
    if (!s.lengths[e].is_rational() && !outwards.is_zero()) return {};
    const Int moved = s.lengths[e].is_rational() ? Int(offset + outwards * (s.lengths[e].factor / divisor)) : offset;
    return is_backward(s, e) ? Int(-moved) : moved;
}

}  // namespace

// Edges by direction, sense and moved offset.
struct RoundSlits::Lines {
    using Key = std::tuple<Index, bool, Int, Index>;
    const Shape& s;
    Int by;
    std::vector<Key> keys;

    Lines(const Shape& shape, Index layer, const Int& further) : s(shape), by(further) {
        for (Index e = 0; e < s.ring_vertices; ++e)
            if (s.makes_surfaces(e) && s.layer[e] == layer && s.emit[e])
                if (const auto offset = moved_offset(s, e, by)) keys.emplace_back(s.direction[e], is_backward(s, e), *offset, e);
        std::sort(keys.begin(), keys.end());
    }
    // Edges that run the other way on the line of e, which is moved by another distance.
    std::vector<Index> opposite(Index e, const Int& other_by) const {
        std::vector<Index> result;
        const auto offset = moved_offset(s, e, other_by);
        if (!offset) return result;
        const Key least{s.direction[e], !is_backward(s, e), *offset, -1};
        for (auto k = std::lower_bound(keys.begin(), keys.end(), least); k != keys.end(); ++k) {
            if (std::get<0>(*k) != std::get<0>(least) || std::get<1>(*k) != std::get<1>(least) || std::get<2>(*k) != *offset) break;
            result.push_back(std::get<3>(*k));
        }
        return result;
    }
};

// A bound owns what a line of the obstacles, moved by both radii, has in common with it, on the same side.
void CoincidentSurfaces::add_bounds(const Feature& contact, std::vector<Feature>& out) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = contact.robot, j = contact.obstacle;
    if (A.layer[i] == reference_layer) return;
    for (Index i2 = 0; i2 < A.ring_vertices; ++i2) {
        if (A.layer[i2] != reference_layer || !is_one_place(A, i, i2)) continue;
        for (Index e = 0; e < O.ring_vertices; ++e) {
            if (O.layer[e] != reference_layer || O.direction[e] != O.direction[j] || is_backward(O, e) != is_backward(O, j)) continue;
            if (A.point[i] == A.point[i2] && O.line[e] == O.line[j]) continue;  // of the lower rank
            const auto offset = moved_offset(O, j, A.radius_of(i).exact);
            if (offset && *offset == *moved_offset(O, e, 0)) out.push_back({Kind::vertex_edge, i2, e});
        }
    }
}

RoundSlits::Places::Places(const Shape& s) : place(s.ring_vertices) {
    std::vector<Index> order(s.ring_vertices);
    std::iota(order.begin(), order.end(), Index(0));
    const auto key = [&](Index v) { return std::tie(s.X[v], s.Y[v]); };
    std::sort(order.begin(), order.end(), [&](Index v, Index w) { return std::tuple(key(v), v) < std::tuple(key(w), w); });
    for (const Index v : order) {
        if (at.empty() || !is_one_place(s, at.back().front(), v)) at.emplace_back();
        at.back().push_back(v), place[v] = static_cast<Index>(at.size()) - 1;
    }
    for (Index v = 0; v < s.ring_vertices; ++v)
        if (!beside(s, v).empty()) facing.push_back(v);
}

std::vector<Index> RoundSlits::Places::beside(const Shape& s, Index vertex) const {
    std::vector<Index> result = at[place[vertex]];
    if (s.has_extent(vertex)) std::erase(result, vertex);
    return result;
}

RoundSlits::RoundSlits(const Scene& s) : scene(s), of_robot(s.robot), of_obstacles(s.obstacles) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    for (Index i = 0; i < A.ring_vertices && !bounds; ++i)
        if (A.layer[i] == reference_layer) bounds = std::make_unique<const Lines>(O, reference_layer, 0);
    for (const Index i : of_robot.facing)
        if (A.layer[i] == body_layer && A.convex[i]) add_moved(walls, O, A.radius_of(i).exact);
    for (const Index j : of_obstacles.facing)
        if (O.layer[j] == body_layer && O.convex[j]) add_moved(prongs, A, O.radius_of(j).exact);
}

void RoundSlits::add_moved(LinesByRadius& all, const Shape& s, const Int& further) {
    if (!moved_by(all, further)) all.push_back(std::make_unique<const Lines>(s, body_layer, further));
}

const RoundSlits::Lines* RoundSlits::moved_by(const LinesByRadius& all, const Int& further) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& lines) { return lines->by == further; });
    return found == all.end() ? nullptr : found->get();
}

RoundSlits::~RoundSlits() = default;

void RoundSlits::add_opposite(const Feature& contact, std::vector<Feature>& out) const {
    if (contact.kind == Kind::vertex_vertex) add_circles(contact, out);
    else add_lines(contact, out);
}

void RoundSlits::add_lines(const Feature& contact, std::vector<Feature>& out) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = contact.robot, j = contact.obstacle;
    if (contact.kind == Kind::vertex_edge) {
        for (const Index i2 : of_robot.beside(A, i)) {
            if (!A.convex[i2] || (A.layer[i] == reference_layer && A.layer[i2] == reference_layer)) continue;
            const Lines* others = A.layer[i2] == reference_layer ? bounds.get() : moved_by(walls, A.radius_of(i2).exact);
            for (const Index e : others->opposite(j, A.radius_of(i).exact)) out.push_back({Kind::vertex_edge, i2, e});
        }
    } else if (O.layer[j] == body_layer) {
        for (const Index j2 : of_obstacles.beside(O, j))
            if (O.layer[j2] == body_layer && O.convex[j2] && O.emit[j2])
                for (const Index g : moved_by(prongs, O.radius_of(j2).exact)->opposite(i, O.radius_of(j).exact)) out.push_back({Kind::edge_vertex, g, j2});
    }
}

void RoundSlits::add_circles(const Feature& contact, std::vector<Feature>& out) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    if (!A.has_concave() && !O.has_concave()) return;
    const Int rho = A.radius_of(contact.robot).exact + O.radius_of(contact.obstacle).exact;
    for (const Index i : of_robot.beside(A, contact.robot))
        for (const Index j : of_obstacles.beside(O, contact.obstacle))
            if (A.layer[i] == O.layer[j] && O.emit[j] && A.radius_of(i).exact + O.radius_of(j).exact == -rho && makes_circles(scene, i, j))
                out.push_back({Kind::vertex_vertex, i, j, contact.branch});
}

bool RoundSlits::may_be() const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    std::vector<Feature> opposite;
    for (const Index i : of_robot.facing)
        for (Index j = 0; j < O.ring_vertices && opposite.empty(); ++j) {
            if (A.layer[i] != O.layer[j] || !O.emit[j]) continue;
            if (A.convex[i] && O.makes_surfaces(j)) add_lines({Kind::vertex_edge, i, j}, opposite);
            if (makes_circles(scene, i, j)) add_circles({Kind::vertex_vertex, i, j}, opposite);
        }
    for (const Index j : of_obstacles.facing)
        for (Index i = 0; i < A.ring_vertices && opposite.empty(); ++i)
            if (A.layer[i] == O.layer[j] && O.emit[j] && O.convex[j] && A.makes_surfaces(i)) add_lines({Kind::edge_vertex, i, j}, opposite);
    return !opposite.empty();
}

bool may_have_slits(const Scene& scene) {
    if (scene.is_round) return RoundSlits(scene).may_be();
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
