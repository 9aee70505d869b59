// Signs of points against lines that doubles cannot tell from zero; theory, "One surface alone".
//
// All that touches at one pose is within the robot's diameter of every obstacle feature that touches there.
#include "free/touching_patches.hpp"

#include "cfree/contact/contact_line.hpp"

namespace cfree {

namespace {

// More roundings than lead to any value below, in a row: at most 60.
constexpr double value_error = 128 * 0x1p-53;
bool may_vanish(const Approx& x, double more = 0) { return !(std::abs(x.v) > (value_error + more) * x.m + 0x1p-1000); }

std::vector<Box> edge_boxes(const Shape& s) {
    std::vector<Box> result(static_cast<std::size_t>(s.ring_vertices));
    for (Index e = 0; e < s.ring_vertices; ++e) result[e].add(s.x[s.v[e]], s.y[s.v[e]]), result[e].add(s.x[s.w[e]], s.y[s.w[e]]);
    return result;
}

}  // namespace

TouchingPatches::TouchingPatches(const Scene& g, const PatchTrimming& patches)
    : given(g), scene(g.near()), one(patches), edges(edge_boxes(scene.obstacles)), vertices(scene.robot.x.size()), directions(scene.robot.v.size()) {
    Box robot;
    for (std::size_t v = 0; v < scene.robot.x.size(); ++v) robot.add(scene.robot.x[v], scene.robot.y[v]);
    reach = std::hypot(robot.x1 - robot.x0, robot.y1 - robot.y0);
}

struct TouchingPatches::Turned {
    const Scene& scene;
    const TouchingPatches& at;
    Index b0;           // the origin
    bool on_edge;       // of an obstacle
    Vec<Approx> P, U;   // the contact's line

    Vec<Approx> place(Index vertex) const { return difference<Approx>(scene.obstacles, vertex, b0); }
    const Vec<Approx>& vertex(Index i) const { return at.vertices[i]; }
    const Vec<Approx>& edge(Index e) const { return at.directions[e]; }
    // On the contact's own line.
    Vec<Approx> at_share(const Approx& t) const {
        const Approx by = on_edge ? t : -t;
        return P - Vec<Approx>{-(by * U.x), -(by * U.y)};
    }
    // Another contact's line: its direction is the edge's.
    Vec<Approx> start(const Feature& f) const {
        if (f.kind == Kind::vertex_edge) return place(scene.obstacles.v[f.obstacle]) - vertex(f.robot);
        return place(f.obstacle) - vertex(scene.robot.v[f.robot]);
    }
    Vec<Approx> direction(const Feature& f) const {
        return f.kind == Kind::vertex_edge ? cfree::edge<Approx>(scene.obstacles, f.obstacle) : edge(f.robot);
    }
};

TouchingPatches::Turned TouchingPatches::turned(const Feature& contact, int chart, double tau) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const auto R = rotation_by(chart, tau);
    const Approx c{R.c, 1}, s{R.s, 1};
    const auto turn = [&](const Vec<Approx>& v) { return Vec<Approx>{c * v.x - s * v.y, s * v.x + c * v.y}; };
    for (Index v = 0; v < static_cast<Index>(vertices.size()); ++v)
        vertices[v] = turn({{A.x[v], std::abs(A.x[v])}, {A.y[v], std::abs(A.y[v])}});
    for (Index e = 0; e < static_cast<Index>(directions.size()); ++e) directions[e] = turn(edge<Approx>(A, e));
    const bool on_edge = contact.kind == Kind::vertex_edge;
    Turned t{scene, *this, on_edge ? O.v[contact.obstacle] : contact.obstacle, on_edge, {}, {}};
    t.P = t.start(contact), t.U = t.direction(contact);
    return t;
}

const std::vector<Index>& TouchingPatches::near(Index feature) {
    if (feature == near_to) return recent;
    const Shape& O = scene.obstacles;
    Box box;
    double size = reach;
    for (const Index v : {O.v[feature], O.w[feature]}) {
        box.add(O.x[v], O.y[v]);
        size = std::max({size, std::abs(O.x[v]), std::abs(O.y[v])});
    }
    const double d = reach + size * 0x1p-40;
    recent.clear(), near_to = feature;
    edges.query({box.x0 - d, box.y0 - d, box.x1 + d, box.y1 + d}, [&](Index j) { recent.push_back(j); });
    return recent;
}

template <class Test>
void TouchingPatches::find(const Feature& contact, std::vector<Index>& out, const Test& may) {
    for (const Index j : near(contact.obstacle))
        for (Index id = one.first_patch[j]; id < one.first_patch[j + 1]; ++id)
            if (may(one.patches.contact(id))) out.push_back(id);
}

// The curve's point is p / d: where two lines meet, or a vertex of the robot is on one of an obstacle.
void TouchingPatches::on_curve(const Surface& on, const Feature& curve, double tau, std::vector<Index>& out) {
    const Turned t = turned(on.contact, on.chart, tau);
    Vec<Approx> p;
    Approx d{1, 1};
    if (curve.kind == Kind::vertex_vertex) {
        p = t.place(curve.obstacle) - t.vertex(curve.robot);
    } else {
        const auto Q = t.start(curve), V = t.direction(curve);
        d = cross(t.U, V);
        const Approx n = cross(Q - t.P, V);
        p = {d * t.P.x + n * t.U.x, d * t.P.y + n * t.U.y};
    }
    find(on.contact, out, [&](const Feature& f) {
        const auto Q = t.start(f);
        return may_vanish(cross(t.direction(f), Vec<Approx>{p.x - d * Q.x, p.y - d * Q.y}));
    });
}

// Between the two angles cosine and sine change by at most twice their distance, and what is tested has two of them as factors.
void TouchingPatches::on_line(const Surface& on, double lo, double hi, std::vector<Index>& out) {
    const Turned t = turned(on.contact, on.chart, 0.5 * (lo + hi));
    const double width = 4 * (hi - lo);
    find(on.contact, out, [&](const Feature& f) {
        return may_vanish(cross(t.U, t.direction(f)), width) && may_vanish(cross(t.U, t.start(f) - t.P), width);
    });
}

void TouchingPatches::at_pose(const Feature& contact, const ExactPose& q, std::vector<Index>& out) {
    const auto R = rotation_by(q.chart, q.p, q.r);
    const ContactLine<Int> line(given, contact, CoreUnits<Int>{});
    const auto P = line.start(R), U = line.direction(R);
    const Vec<Int> off{q.X * R.w - q.W * P.x, q.Y * R.w - q.W * P.y};
    const double share = ratio(dot(off, U), q.W * dot(U, U));
    const Turned t = turned(contact, q.chart, ratio(q.p, q.r));
    const Vec<Approx> place = t.at_share({share, std::abs(share)});
    find(contact, out, [&](const Feature& f) {
        const auto V = t.direction(f), x = place - t.start(f);
        if (!may_vanish(cross(V, x))) return false;
        // an edge of the robot moves the pose the other way
        const Approx along = f.kind == Kind::vertex_edge ? dot(V, x) : -dot(V, x), rest = dot(V, V) - along;
        return (along.v > 0 || may_vanish(along)) && (rest.v > 0 || may_vanish(rest));
    });
}

}  // namespace cfree
