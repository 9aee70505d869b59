// Find points that doubles cannot separate from lines; theory, "One surface alone".
//
// All features that touch at one pose are within the robot's diameter of every obstacle feature that touches there.
#include "free/touching_patches.hpp"

#include "cfree/contact/contact_line.hpp"
#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

// Bound of the roundings of any value below: at most 60 in a row.
constexpr double value_error = 128 * 0x1p-53;
bool may_vanish(const Approx& x, double more = 0) { return !(std::abs(x.v) > (value_error + more) * x.m + 0x1p-1000); }

}  // namespace

TouchingPatches::TouchingPatches(const Scene& g, const PatchTrimming& patches)
    : given(g), scene(g.near()), one(patches), obstacle_edges(edge_boxes(scene.obstacles)), vertices(scene.robot.x.size()),
      edges(scene.robot.v.size()), places(vertices.size()), offsets(edges.size()) {
    const Shape& A = scene.robot;
    for (Index i = 0; i < A.ring_vertices; ++i) {
        if (i % in_chunk == 0) {
            chunks.push_back(chunk(i, std::min(i + in_chunk, A.ring_vertices)));
            for (Layer& layer : layers) layer.begin_chunk();
        }
        if (A.convex[i]) layers[A.layer[i]].vertices.push_back(i);
        if (A.has_extent(i)) layers[A.layer[i]].edges.push_back(i);
    }
    for (Layer& layer : layers) layer.begin_chunk();
    boxes.resize(chunks.size());
    size = reach_of(A);
}

TouchingPatches::Chunk TouchingPatches::chunk(Index first, Index last) const {
    const Shape& A = scene.robot;
    Box box;
    for (Index i = first; i < last; ++i)
        for (const Index end : {A.v[i], A.w[i]}) box.add(A.x[end], A.y[end]);
    return {0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1), 0.5 * norm(box.x1 - box.x0, box.y1 - box.y0)};
}

// A vertex of the robot that touches an edge of an obstacle is on its box; an edge that touches a vertex begins somewhere on the edge
// turned back from there. Others turn about that place: between the two angles by at most their distance.
void TouchingPatches::place_chunks(const Surface& on, double from, double to) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const auto R = rotation_by(on.chart, 0.5 * (from + to));
    const auto turned = [&](double x, double y) { return Vec<double>{R.c * x - R.s * y, R.s * x + R.c * y}; };
    const auto [kind, _, i, j] = on.contact;
    const Index a = kind == Kind::vertex_edge ? i : A.v[i];
    Box base = edge_box(O, j);
    double length = 0;
    if (kind == Kind::edge_vertex) {
        const auto E = turned(A.x[A.w[i]] - A.x[a], A.y[A.w[i]] - A.y[a]);
        base = {};
        base.add(O.x[j], O.y[j]), base.add(O.x[j] - E.x, O.y[j] - E.y);
        length = norm(E.x, E.y);
    }
    around = {};
    for (std::size_t c = 0; c < chunks.size(); ++c) {
        const double x = chunks[c].x - A.x[a], y = chunks[c].y - A.y[a], far = norm(x, y) + chunks[c].radius + length;
        const auto shift = turned(x, y);
        const double rounding = 0x1p-40 * (far + std::max(std::abs(base.x0), std::abs(base.x1)) + std::max(std::abs(base.y0), std::abs(base.y1)));
        boxes[c] = grown({base.x0 + shift.x, base.y0 + shift.y, base.x1 + shift.x, base.y1 + shift.y},
                         chunks[c].radius + (to - from) * far + rounding);
        around.add(boxes[c]);
    }
}

struct TouchingPatches::Turned {
    const Scene& scene;
    const TouchingPatches& at;
    Index b0;  // the origin

    Vec<Approx> place(Index vertex) const { return difference<Approx>(scene.obstacles, vertex, b0); }
    const Vec<Approx>& vertex(Index i) const { return at.vertices[i]; }
    // Line of a contact: the start of its edge, and the edge.
    Vec<Approx> start(const Feature& f) const {
        if (f.kind == Kind::vertex_edge) return place(scene.obstacles.v[f.obstacle]) - vertex(f.robot);
        return place(f.obstacle) - vertex(scene.robot.v[f.robot]);
    }
    Vec<Approx> direction(const Feature& f) const {
        return f.kind == Kind::vertex_edge ? edge<Approx>(scene.obstacles, f.obstacle) : at.edges[f.robot];
    }
};

TouchingPatches::Turned TouchingPatches::turned(Index b0, int chart, double tau) {
    const Shape& A = scene.robot;
    const auto R = rotation_by(chart, tau);
    const Approx c{R.c, 1}, s{R.s, 1};
    const auto turn = [&](const Vec<Approx>& v) { return Vec<Approx>{c * v.x - s * v.y, s * v.x + c * v.y}; };
    for (Index v = 0; v < static_cast<Index>(vertices.size()); ++v)
        vertices[v] = turn({{A.x[v], std::abs(A.x[v])}, {A.y[v], std::abs(A.y[v])}});
    for (Index e = 0; e < static_cast<Index>(edges.size()); ++e) edges[e] = turn(edge<Approx>(A, e));
    return {scene, *this, b0};
}

Index TouchingPatches::obstacle_vertex(const Feature& contact) const {
    return contact.kind == Kind::vertex_edge ? scene.obstacles.v[contact.obstacle] : contact.obstacle;
}

const std::vector<TouchingPatches::Edge>& TouchingPatches::near(Index feature) {
    if (feature == near_to) return recent;
    recent.clear(), near_to = feature;
    obstacle_edges.query(grown(edge_box(scene.obstacles, feature), one.reach()), [&](Index j) {
        if (one.first_patch[j] < one.first_patch[j + 1]) recent.push_back({edge_box(scene.obstacles, j), j});
    });
    return recent;
}

// The curve's point is p / d: the intersection of two lines, or a vertex of the robot on one of an obstacle. Relative to it
// the robot's vertices are at places / d, and its edges pass at offsets / d.
void TouchingPatches::on_curve(const Surface& on, const Feature& curve, double from, double to, std::vector<Index>& out) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Turned t = turned(obstacle_vertex(on.contact), on.chart, 0.5 * (from + to));
    Vec<Approx> p;
    Approx d{1, 1};
    if (curve.kind == Kind::vertex_vertex) {
        p = t.place(curve.obstacle) - t.vertex(curve.robot);
    } else {
        const auto P = t.start(on.contact), U = t.direction(on.contact), V = t.direction(curve);
        d = cross(U, V);
        const Approx n = cross(t.start(curve) - P, V);
        p = {d * P.x + n * U.x, d * P.y + n * U.y};
    }
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = {p.x + d * vertices[i].x, p.y + d * vertices[i].y};
    for (Index e = 0; e < A.ring_vertices; ++e) offsets[e] = cross(edges[e], places[A.v[e]]);
    place_chunks(on, from, to);
    for (const auto& [box, j] : near(on.contact.obstacle)) {
        if (!around.meets(box)) continue;
        meeting.clear();
        for (std::size_t c = 0; c < chunks.size(); ++c)
            if (boxes[c].meets(box)) meeting.push_back(c);
        if (meeting.empty()) continue;
        const Layer& robot = layers[O.layer[j]];
        const auto E = edge<Approx>(O, j), b = t.place(O.v[j]), moved = Vec<Approx>{d * b.x, d * b.y};
        const Approx offset = cross(E, moved);
        const Index first = one.first_patch[j], first_edge = first + static_cast<Index>(robot.vertices.size());
        for (const std::size_t c : meeting)
            for (Index k = robot.first_vertex[c]; k < robot.first_vertex[c + 1]; ++k)
                if (may_vanish(cross(E, places[robot.vertices[k]]) - offset)) out.push_back(first + k);
        if (!O.convex[j]) continue;
        for (const std::size_t c : meeting)
            for (Index k = robot.first_edge[c]; k < robot.first_edge[c + 1]; ++k)
                if (const Index e = robot.edges[k]; may_vanish(cross(edges[e], moved) - offsets[e])) out.push_back(first_edge + k);
    }
}

// Between the two angles cosine and sine change by at most twice their distance, and tested values have two of them as
// factors.
void TouchingPatches::on_line(const Surface& on, double lo, double hi, std::vector<Index>& out) {
    const Shape& O = scene.obstacles;
    const Turned t = turned(obstacle_vertex(on.contact), on.chart, 0.5 * (lo + hi));
    place_chunks(on, lo, hi);
    const double width = 4 * (hi - lo);
    const auto P = t.start(on.contact), U = t.direction(on.contact);
    const auto is_parallel = [&](const Vec<Approx>& V) { return may_vanish(cross(U, V), width); };
    const auto is_on = [&](const Feature& f) { return may_vanish(cross(U, t.start(f) - P), width); };
    std::array<std::vector<std::pair<Index, Index>>, 2> parallel;  // edges of the robot, and their places in their layer
    for (const int layer : {0, 1})
        for (std::size_t k = 0; k < layers[layer].edges.size(); ++k)
            if (const Index e = layers[layer].edges[k]; is_parallel(edges[e])) parallel[layer].emplace_back(e, k);
    for (const auto& [box, j] : near(on.contact.obstacle)) {
        if (!around.meets(box)) continue;
        const Layer& robot = layers[O.layer[j]];
        const Index id = one.first_patch[j], count = static_cast<Index>(robot.vertices.size());
        if (is_parallel(edge<Approx>(O, j)))
            for (Index k = 0; k < count; ++k)
                if (is_on({Kind::vertex_edge, robot.vertices[k], j})) out.push_back(id + k);
        if (!O.convex[j]) continue;
        for (const auto& [e, k] : parallel[O.layer[j]])
            if (is_on({Kind::edge_vertex, e, j})) out.push_back(id + count + k);
    }
}

// Test edges e and f of the vertex in contact against the other's edge: R e x E <= 0 <= R f x E for edges of the robot. A
// single point has no edges: all is zero.
bool TouchingPatches::is_there(Index patch, int chart, double lo, double hi) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Feature on = one.patches.contact(patch);
    const Predicates decide(scene, {on, chart});
    const auto sign = [&](Index g, Index f) { return Predicates::sign_on(decide.parallel(g, f), lo, hi); };
    const Index i = on.robot, j = on.obstacle;
    if (on.kind == Kind::vertex_edge) return sign(A.previous[i], j) <= 0 && sign(i, j) >= 0;
    return sign(i, j) <= 0 && sign(i, O.previous[j]) >= 0;
}

// The robot's vertices from b0 are (q - b0 + R o) + R a', where o + a' are its input vertices.
void TouchingPatches::at_pose(const ExactPose& q, Index b0, std::vector<Index>& out) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const auto R = rotation_by(q.chart, q.p, q.r);
    const auto origin = R(Vec<Int>{given.robot.X[0] - A.X[0], given.robot.Y[0] - A.Y[0]});
    const auto from_b0 = [&](const Int& n, const Int& b, const Int& o) {
        const double x = std::ldexp(ratio((n - q.W * b) * R.w + q.W * o, q.W * R.w), -scene.shift);
        return Approx{x, std::abs(x)};
    };
    const Vec<Approx> place{from_b0(q.X, given.obstacles.X[b0], origin.x), from_b0(q.Y, given.obstacles.Y[b0], origin.y)};
    const Turned t = turned(b0, q.chart, ratio(q.p, q.r));
    const double x = O.x[b0] + place.x.v, y = O.y[b0] + place.y.v, d = size + (std::abs(x) + std::abs(y) + size) * 0x1p-40;
    obstacle_edges.query({x - d, y - d, x + d, y + d}, [&](Index j) {
        for (Index id = one.first_patch[j]; id < one.first_patch[j + 1]; ++id) {
            const Feature f = one.patches.contact(id);
            const auto V = t.direction(f), off = place - t.start(f);
            if (!may_vanish(cross(V, off))) continue;
            // an edge of the robot moves the pose the other way
            const Approx along = f.kind == Kind::vertex_edge ? dot(V, off) : -dot(V, off), rest = dot(V, V) - along;
            if ((along.v > 0 || may_vanish(along)) && (rest.v > 0 || may_vanish(rest))) out.push_back(id);
        }
    });
}

}  // namespace cfree
