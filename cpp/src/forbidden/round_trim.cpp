// Coverage of a line, or of a quadrant of a circle, by a rounded pillar: its states; theory, "Rounded shapes".
#include "forbidden/round_trim.hpp"

#include <algorithm>
#include <stdexcept>

#include "cfree/contact/contact_line.hpp"
#include "predicates/round_junction.hpp"

namespace cfree {

RoundTrimmer::RoundTrimmer(const Scene& s, const Surface& on, const Event& from, const Event& to, const std::vector<Index>& edges)
    : Trimmer(s, on), orders(decide.round_orders()), edges_at_centre(edges), has_arcs(s.robot.has_arcs() || s.obstacles.has_arcs()),
      has_concave(s.robot.has_concave() || s.obstacles.has_concave()), is_concave(cfree::is_concave(s, on.contact)) {
    events = {from, to};
    if (is_circle(on.contact)) {
        live = in_cones(on.contact);
        return;
    }
    ends[0] = end_helix(s, on.contact, 0), ends[1] = end_helix(s, on.contact, 1);
    fill();
}

static Feature with_branch(Feature f, int branch) {
    f.branch = static_cast<std::int8_t>(branch);
    return f;
}

// The ends of the circle's quadrant.
std::array<Feature, 2> RoundTrimmer::quadrant() const {
    const Feature& x = surface.contact;
    return {Feature{Kind::seam, x.robot, x.obstacle, x.branch}, Feature{Kind::seam, x.robot, x.obstacle, (x.branch + 1) & 3}};
}

// The same, or the joints that are in them at every angle.
std::array<Feature, 2> RoundTrimmer::ends_of_quadrant() const {
    const Sample any{events[0].lo, {}};  // these do not turn
    const auto seams = quadrant();
    const RoundOrders::Direction first[] = {orders.direction(seams[0], any), orders.direction(seams[1], any)};
    auto limits = seams;
    for (const Index e : edges_at_centre) {
        const auto joint = orders.direction({Kind::vertex_edge, surface.contact.robot, e}, any);
        for (const int end : {0, 1})
            if (orders.turn(first[end], joint, any) == 0 && orders.turn(first[1 - end], joint, any) == (end ? 1 : -1)) limits[end] = joint.to;
    }
    return limits;
}

// Spans of the range between angles that cut it, in any order.
std::vector<Trimmer::Span> RoundTrimmer::spans_between(std::vector<Event> cuts, Index first, Index last) {
    std::sort(cuts.begin(), cuts.end(), [&](const Event& p, const Event& q) { return decide.order(p, q) < 0; });
    cuts.push_back(events[last]);
    std::vector<Span> spans;
    Index from = first;
    for (const Event& cut : cuts) {
        if (decide.order(events[from], cut) == 0) continue;
        spans.push_back({from, intern(cut)});
        from = spans.back().to;
    }
    return spans;
}

// The directions of a quadrant in the cones of both vertices, between joints with the edges beside them and ends of the quadrant,
// change only where two of these are parallel. If the pair's circle is this one with the other side free, its normals are opposite.
std::vector<Trimmer::Area> RoundTrimmer::in_cones(const Feature& contact) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = contact.robot, j = contact.obstacle;
    const bool is_opposite = cfree::is_concave(scene, contact) != is_concave;
    std::vector<Area> areas;
    const auto seams = quadrant();
    std::vector<std::array<Feature, 2>> cones;  // first and last direction
    if (O.has_extent(j)) cones.push_back({Feature{Kind::vertex_edge, i, O.previous[j]}, Feature{Kind::vertex_edge, i, j}});
    if (O.is_concave(j)) std::swap(cones.back()[0], cones.back()[1]);
    if (A.has_extent(i)) cones.push_back({Feature{Kind::edge_vertex, A.previous[i], j}, Feature{Kind::edge_vertex, i, j}});
    if (A.is_concave(i)) std::swap(cones.back()[0], cones.back()[1]);
    // a direction of a seam, or of a cone's end
    using Direction = RoundOrders::Direction;
    const auto turn = [&](const Direction& u, const Direction& v, const Sample& at) {
        const bool is_reversed = is_opposite && (u.to.kind == Kind::seam) != (v.to.kind == Kind::seam);
        return is_reversed ? -orders.turn(u, v, at) : orders.turn(u, v, at);
    };
    if (O.has_extent(j)) {  // a cone that does not turn
        const Sample any{events[0].lo, {}};
        const auto of = [&](const Feature& f) { return orders.direction(f, any); };
        const auto first = of(cones[0][0]), last = of(cones[0][1]), begin = of(seams[0]), end = of(seams[1]);
        const auto is_between = [&](const auto& from, const auto& to, const auto& here) {
            return turn(from, here, any) >= 0 && turn(here, to, any) >= 0;
        };
        if (!is_between(begin, end, first) && !is_between(first, last, begin)) return areas;
    }
    std::vector<Event> cuts;
    const auto add = [&](const Predicates::Roots& roots) { cuts.insert(cuts.end(), roots.at.begin(), roots.at.end()); };
    for (const auto& [first, last] : cones)
        for (const Feature& f : {first, last}) {
            if (f.kind != Kind::edge_vertex) continue;
            for (const Feature& seam : seams) add(decide.event_roots(f, seam, events[0], events[1]));
            for (const auto& other : cones)
                for (const Feature& g : other)
                    if (g.kind == Kind::vertex_edge) add(decide.parallel_roots(f.robot, g.obstacle, events[0], events[1]));
        }
    const auto ends_here = ends_of_quadrant();
    for (const auto& [from, to] : spans_between(std::move(cuts))) {
        const Sample at = decide.between(events[from], events[to]);
        const auto both = [&](const std::array<Feature, 2>& f) { return std::array{orders.direction(f[0], at), orders.direction(f[1], at)}; };
        const std::array<Direction, 2> ends_of = both(seams);
        std::array<std::array<Direction, 2>, 2> of_cones;
        for (std::size_t k = 0; k < cones.size(); ++k) of_cones[k] = both(cones[k]);
        const auto is_inside = [&](const Direction& line) {
            if (turn(ends_of[0], line, at) < 0 || turn(line, ends_of[1], at) < 0) return false;
            return std::all_of(of_cones.begin(), of_cones.begin() + static_cast<std::ptrdiff_t>(cones.size()), [&](const auto& cone) {
                return turn(cone[0], line, at) >= 0 && turn(line, cone[1], at) >= 0;
            });
        };
        struct Limit {
            Feature curve;
            Direction direction;
        };
        std::optional<Limit> limits[2];
        for (const int end : {0, 1}) {  // a joint in an end of the quadrant bounds
            if (is_inside(ends_of[end])) limits[end] = {ends_here[end], ends_of[end]};
            for (std::size_t k = 0; k < cones.size(); ++k)
                if (is_inside(of_cones[k][end])) limits[end] = {cones[k][end], of_cones[k][end]};
        }
        if (!limits[0] || !limits[1] || turn(limits[0]->direction, limits[1]->direction, at) <= 0) continue;
        areas.push_back({from, to, curve_of(limits[is_concave]->curve, false), curve_of(limits[!is_concave]->curve, false), 0, 1});
    }
    for (Area& area : areas) bounds(area);
    return areas;
}

void RoundTrimmer::cede_circle(const Feature& owner) {
    for (const Area& area : in_cones(owner)) take({area, -1, -1, nullptr});
}

void RoundTrimmer::cover(Index p, Index k, const Slices& slices, const Slices::Part& part) {
    cover_by(p, k, slices, part, [&](const Sample& at, Cover& out) {
        pillar.arcs.clear(), pillar.edges.clear();
        if (!shape(p, k, at, pillar)) return false;
        if (is_line(surface.contact)) on_line(pillar, at, out);
        else on_circle(pillar, at, out);
        return true;
    });
}

// All of the quadrangle that is outside the circle, and in the triangle of directions.
void RoundTrimmer::cover_fillet(const Shape::Fillet& fillet, bool of_robot, Index vertex, const Shape::Wedge* directions,
                                const Slices& slices, const Slices::Part& part) {
    const auto pillar_of = [](const auto& vertices, const auto& edges, bool are_of_robot, Index v) {
        Pillar result;
        for (std::size_t n = 0; n < vertices.size(); ++n) {
            result.arcs.push_back(are_of_robot ? Arc{vertices[n], v} : Arc{v, vertices[n]});
            result.edges.push_back({are_of_robot ? Feature{Kind::edge_vertex, edges[n], v} : Feature{Kind::vertex_edge, v, edges[n]}, {-1, -1}});
        }
        result.has_arcs = true;
        return result;
    };
    const Pillar around = pillar_of(fillet.vertex, fillet.edge, of_robot, vertex);
    const Pillar wedge = directions ? pillar_of(directions->vertex, directions->edge, !of_robot, fillet.arc) : Pillar{};
    Pillar circle;
    circle.arcs.push_back(of_robot ? Arc{fillet.arc, vertex} : Arc{vertex, fillet.arc});
    circle.has_arcs = true;
    cover_by(-1, -1, slices, part, [&](const Sample& at, Cover& out) {
        const auto find_cover = [&](const Pillar& pillar, Cover& found) {
            if (is_line(surface.contact)) on_line(pillar, at, found);
            else on_any_circle(pillar, joint_signs(pillar, at), at, found);
        };
        const auto add = [&](const Pillar& pillar) {
            Cover other;
            find_cover(pillar, other);
            out.watched.insert(out.watched.end(), other.watched.begin(), other.watched.end());
            return std::move(other.bands);
        };
        find_cover(around, out);
        if (directions && !out.bands.empty()) {
            out.within = add(wedge);
            if (out.within->empty()) out.bands.clear();
        }
        if (!out.bands.empty()) out.left_out = add(circle);
        return true;
    });
}

// Take what is left of a band between orders that change.
void RoundTrimmer::take_part(const std::array<Feature, 2>& band, const Cover& cover, const Span& span) {
    static const State crossing{Meets::crosses, {}, {}, {}, 0, 0, {}, {}};
    const auto curve = [&](const Feature& f) { return curves[static_cast<std::size_t>(curve_of(f, false))]; };
    std::vector<Event> cuts;
    const auto cut = [&](const std::array<Feature, 2>& some, const std::vector<std::array<Feature, 2>>& parts) {
        for (const Feature& end : some)
            for (const auto& part : parts)
                for (const Feature& other : part) {
                    const auto order = decide.compare(curve(end), curve(other), events[span.from], events[span.to]);
                    for (const Event& at : order.at)
                        if (!at.is_touch) cuts.push_back(at);
                }
    };
    cut(band, cover.left_out);
    if (cover.within) {
        cut(band, *cover.within);
        for (const auto& part : *cover.within) cut(part, cover.left_out);
    }
    for (const Span& some : spans_between(std::move(cuts), span.from, span.to)) {
        const Sample at = decide.between(events[some.from], events[some.to]);
        const auto order = [&](const Feature& p, const Feature& q) {
            return code(scene, p) == code(scene, q) ? 0 : orders.order_at(p, q, at);
        };
        const auto add = [&](const Feature& lower, const Feature& upper) {
            if (order(lower, upper) >= 0) return;
            Area area{some.from, some.to, curve_of(lower, false), curve_of(upper, false), 0, 1};
            bounds(area);
            take({area, -1, -1, &crossing});
        };
        const auto add_outside = [&](Feature from, const Feature& to) {
            for (const auto& [lower, upper] : cover.left_out) {
                add(from, order(lower, to) < 0 ? lower : to);
                if (order(upper, from) > 0) from = upper;
            }
            add(from, to);
        };
        if (!cover.within) {
            add_outside(band[0], band[1]);
            continue;
        }
        for (const auto& [lower, upper] : *cover.within) {
            const Feature &from = order(lower, band[0]) > 0 ? lower : band[0], &to = order(upper, band[1]) < 0 ? upper : band[1];
            if (order(from, to) < 0) add_outside(from, to);
        }
    }
}

// True if something is left between two angles, as far as their doubles tell.
bool RoundTrimmer::is_left_between(const Span& span) const {
    const double lo = events[span.from].lo, hi = events[span.to].hi;
    const auto is_there = [&](const Area& x) { return events[x.from].lo <= hi && events[x.to].hi >= lo; };
    return std::any_of(live.begin(), live.end(), is_there) || std::any_of(thin.begin(), thin.end(), is_there);
}

template <class Find>
void RoundTrimmer::cover_by(Index p, Index k, const Slices& slices, const Slices::Part& part, const Find& find) {
    static const State crossing{Meets::crosses, {}, {}, {}, 0, 0, {}, {}};
    const auto limit = [&](int s) {
        return s == 0 ? 0 : s == slices.count ? 1 : intern({{}, {}, slices.at[s], slices.at[s]});
    };
    // nothing is left before the first part, or after the last one
    double lo = first_end, hi = last_end;
    for (const auto* areas : {&live, &thin})
        for (const Area& x : *areas) lo = std::min(lo, events[x.from].lo), hi = std::max(hi, events[x.to].hi);
    int first = part.first, last = part.last;
    while (first <= last && slices.at[first + 1] < lo) ++first;
    while (first <= last && slices.at[last] > hi) --last;
    if (first > last) return;
    todo.assign(1, {limit(first), limit(last + 1)});
    while (!todo.empty() && !empty()) {
        const Span whole = todo.back();
        todo.pop_back();
        if (!is_left_between(whole)) continue;
        Span span = whole;
        for (int attempt = 0;; ++attempt) {
            if (attempt == Predicates::most_attempts) throw std::logic_error("no sample decides a pillar's state");
            const Sample at = decide.between(events[whole.from], events[whole.to], attempt);
            span = whole;
            is_critical = false;
            found.clear();
            if (!find(at, found)) continue;
            if (!is_critical && narrow(found, at, span)) break;
        }
        if (!found.left_out.empty() || found.within) {
            for (const auto& band : found.bands) take_part(band, found, span);
            found.bands.clear();
        }
        for (const auto& [lower, upper] : found.bands) {
            Area band{span.from, span.to, curve_of(lower, false), curve_of(upper, false), 0, 1};
            bounds(band);
            take({band, p, k, &crossing});
        }
        if (span.to != whole.to) todo.push_back({span.to, whole.to});
        if (span.from != whole.from) todo.push_back({whole.from, span.from});
    }
}

// --- the pillar at a sample ------------------------------------------------------------------------------------------

// Sign at a sample; one that is zero there, and not at every angle, makes it critical.
int RoundTrimmer::sign_of(const Feature& first, const Feature& second, const Sample& at) {
    const int sign = decide.event_sign(first, second, at);
    is_critical |= sign == 0 && !orders.exactly(first, second).norm.empty();
    return sign;
}

// Merge the edges of both pieces by direction; false if the sample is critical. An edge F of the obstacle is supported by the
// robot's vertex with R G_before x F <= 0 <= R G_after x F; as F turns on, so does that vertex.
bool RoundTrimmer::shape(Index p, Index k, const Sample& at, Pillar& out) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index *a = &A.piece_vertex[A.piece[p]], *b = &O.piece_vertex[O.piece[k]];
    const Index n = A.piece[p + 1] - A.piece[p], m = O.piece[k + 1] - O.piece[k];
    const auto is_arc = [](const Shape& of, Index v) { return of.has_arcs() && of.is_arc[v] != 0; };
    out.has_arcs = std::any_of(a, a + n, [&](Index v) { return is_arc(A, v); }) || std::any_of(b, b + m, [&](Index v) { return is_arc(O, v); });
    const Index *ga = n > 1 ? &A.piece_edge[A.piece[p]] : nullptr, *fb = m > 1 ? &O.piece_edge[O.piece[k]] : nullptr;
    const auto add_arcs = [&](Index from, Index to, Index y) {  // the robot's vertices from one to another at one of the obstacle
        for (Index x = from; x <= to; ++x) {
            out.arcs.push_back({a[x % n], b[y]});
            if (x == to) continue;
            out.edges.push_back({{Kind::edge_vertex, ga[x % n], b[y]}, {-1, -1}});
            if (m > 1) out.edges.back().around[0] = fb[(y + m - 1) % m], out.edges.back().around[1] = fb[y];
        }
    };
    if (m == 1) {
        if (n == 1) return add_arcs(0, 0, 0), true;
        add_arcs(0, n, 0);
        out.arcs.pop_back();
        return true;
    }
    const auto sign = [&](Index x, Index y) {
        const Index g = ga[x % n], f = fb[y];
        return decide.parallel_sign(g, f, decide.parallel(g, f), at);
    };
    Index x = 0;
    const auto turn_on = [&](Index y) {
        for (int s; n > 1 && !is_critical && (s = sign(x, y)) <= 0; ++x) is_critical = s == 0;
    };
    if (n > 1)
        while (sign(x + n - 1, m - 1) >= 0 || sign(x, m - 1) <= 0)  // support of the last edge
            if (++x == n) return false;                              // an edge is parallel to it
    const Index first = x;
    for (Index y = 0; y < m && !is_critical; ++y) {
        const Index from = x;
        if (y + 1 < m) turn_on(y);
        else x = first + (n > 1 ? n : 0);  // once around
        add_arcs(from, x, y);
        out.edges.push_back({{Kind::vertex_edge, a[x % n], fb[y]}, {n > 1 ? ga[(x + n - 1) % n] : -1, n > 1 ? ga[x % n] : -1}});
    }
    return !is_critical;
}

// Joints in counter-clockwise order, two for each edge: with the arc before it, and with the one after it.
RoundTrimmer::Joint RoundTrimmer::joint(const Pillar& pillar, int k) const {
    const int n = 2 * pillar.count(), j = (k % n + n) % n, edge = j / 2;
    return {edge, j % 2 == 0 ? edge : (edge + 1) % pillar.count()};
}

bool RoundTrimmer::has_extent(const Feature& circle) const {
    if (has_concave) return !(scene.robot.radius_of(circle.robot).exact + scene.obstacles.radius_of(circle.obstacle).exact).is_zero();
    return scene.robot.vertex_radius[circle.robot] != 0 || scene.obstacles.vertex_radius[circle.obstacle] != 0;
}

// The circle of a joint: of those that have it, that about the end of the line's edge.
Feature RoundTrimmer::circle_of(const Pillar& pillar, const Joint& j) const {
    const Feature &line = pillar.edge(j.edge).line, circle = pillar.circle(j.arc);
    return has_arcs ? circle_at_end(scene, line, smooth_end(scene, line, circle)) : circle;
}

// Sign of a joint that its features prove to be the same at every angle: of those on the line 0; of those on the circle -1, where it
// is inside of the pillar, or 1, where it is outside, that of a concave arc.
std::optional<int> RoundTrimmer::known_sign(const Feature& line, const Feature& circle) const {
    const Feature& x = surface.contact;
    if (is_line(x)) {  // two tangents of one circle, or two lines through a point
        if (!is_smooth(scene, x, circle)) return {};
        return code(scene, x) != code(scene, line) && has_extent(circle) ? 1 : 0;
    }
    if (!has_arcs) return {};
    const int end = smooth_end(scene, line, x);
    const int side = is_concave ? 1 : -1;
    if (end >= 0 && end == smooth_end(scene, line, circle)) return side;
    return !has_extent(circle) && line_of_joint(scene, x, circle) ? std::optional(side) : std::nullopt;  // a point of the arc
}

bool RoundTrimmer::is_stub(const Feature& line) const {
    return line.kind == Kind::vertex_edge ? scene.obstacles.is_stub(line.obstacle) : scene.robot.is_stub(line.robot);
}

void RoundTrimmer::watch_joint(const Pillar& pillar, int k, int sign, Cover& out) const {
    const Joint j = joint(pillar, k);
    const Feature line = pillar.edge(j.edge).line, circle = circle_of(pillar, j);
    if (!known_sign(line, circle)) out.watched.push_back({line, circle, sign, true});
}

void RoundTrimmer::watch_edge(const Edge& edge, Cover& out) const {
    const Feature& f = edge.line;
    const auto parallel = [&](Index g, Index e, int sign) { out.watched.push_back({{Kind::edge_edge, g, e}, {}, sign, false}); };
    if (edge.around[0] < 0) return;
    if (f.kind == Kind::vertex_edge) {  // R G_before x F <= 0 <= R G_after x F
        parallel(edge.around[0], f.obstacle, -1), parallel(edge.around[1], f.obstacle, 1);
    } else {  // R G x F_after <= 0 <= R G x F_before
        parallel(f.robot, edge.around[0], 1), parallel(f.robot, edge.around[1], -1);
    }
}

void RoundTrimmer::watch_arc(const Pillar& pillar, int k, Cover& out) const {
    if (pillar.count() == 0) return;
    watch_edge(pillar.edge(k - 1), out), watch_edge(pillar.edge(k), out);
}

// Sign of the surface's vector U x V. It is constant if both belong to one shape.
void RoundTrimmer::watch_direction(const Feature& line, int sign, Cover& out) const {
    const Feature& x = surface.contact;
    if (x.kind == line.kind) return;
    const bool on_edge = x.kind == Kind::vertex_edge;
    const Feature parallel{Kind::edge_edge, on_edge ? line.robot : x.robot, on_edge ? x.obstacle : line.obstacle};
    out.watched.push_back({parallel, {}, on_edge ? sign : -sign, false});
}

// Curve of the feature between a joint and the next one, as its name on the surface.
Feature RoundTrimmer::feature_after(const Pillar& pillar, int k, int branch) const {
    const auto [edge, arc] = joint(pillar, k);
    const bool is_edge = arc == edge && k % 2 == 0;
    Feature f = is_edge ? pillar.edge(edge).line : pillar.circle(arc);
    const Feature& x = surface.contact;
    if (is_line(x)) {
        if (const int end = smooth_end(scene, x, f); end >= 0) return ends[static_cast<std::size_t>(end)];
        f.branch = static_cast<std::int8_t>(is_line(f) ? 0 : branch);
    } else {
        f.branch = static_cast<std::int8_t>(is_smooth(scene, f, x) ? 0 : branch);
    }
    return f;
}

// --- states ----------------------------------------------------------------------------------------------------------

// Sign of the surface's vector U x V at a sample.
int RoundTrimmer::cross_with_line(const Feature& line, const Sample& at) {
    const Feature& x = surface.contact;
    if (x.kind == line.kind)
        return x.kind == Kind::vertex_edge ? decide.cross_sign(scene.obstacles, x.obstacle, line.obstacle)
                                           : decide.cross_sign(scene.robot, x.robot, line.robot);
    const bool on_edge = x.kind == Kind::vertex_edge;
    const Index g = on_edge ? line.robot : x.robot, f = on_edge ? x.obstacle : line.obstacle;
    const int sign = decide.parallel_sign(g, f, decide.parallel(g, f), at);
    is_critical |= sign == 0;
    return on_edge ? sign : -sign;
}

// Signs of all joints: 1 left of the line or outside the circle; of others that are on it at every angle 0.
const std::vector<int>& RoundTrimmer::joint_signs(const Pillar& pillar, const Sample& at) {
    const int count = pillar.count();
    signs.clear();
    const auto here = orders.turned_to(at.tau);
    const RoundOrders::Vector on = is_line(surface.contact) ? orders.along(surface.contact, here) : RoundOrders::Vector{};
    Feature circle;
    RoundOrders::Vector to_circle{}, along{};
    for (int k = 0; k < 2 * count; ++k) {
        const Joint j = joint(pillar, k);
        const Feature& line = pillar.edge(j.edge).line;
        if (const Feature next = circle_of(pillar, j); k == 0 || next != circle) circle = next, to_circle = orders.to_centre(circle, here);
        if (k % 2 == 0) along = orders.along(line, here);
        const auto known = known_sign(line, circle);
        int sign = known ? *known : at.fine ? 0 : orders.joint_sign(line, along, circle, to_circle, on);
        if (!known && sign != 0) ++decide.counters.filter;
        if (!known && sign == 0) sign = sign_of(line, circle, at);
        signs.push_back(sign);
    }
    const auto set_inside = [&](int k) { signs[static_cast<std::size_t>((k + 2 * count) % (2 * count))] = -1; };
    for (int k = 0; is_concave && k < count; ++k) {  // an arc of the same circle, free outside: its joints count as those of a smaller pillar
        if (!is_opposite(pillar.circle(k))) continue;
        set_inside(2 * k), set_inside(2 * k - 1);
        if (is_stub(pillar.edge(k).line)) set_inside(2 * k + 1);
        if (is_stub(pillar.edge(k - 1).line)) set_inside(2 * k - 2);
    }
    return signs;
}

// True if a pillar's circle is that of the concave arc.
bool RoundTrimmer::is_opposite(const Feature& circle) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Feature& x = surface.contact;
    const auto is_one_place = [](const Shape& s, Index v, Index w) { return s.X[v] == s.X[w] && s.Y[v] == s.Y[w]; };
    return is_one_place(A, x.robot, circle.robot) && is_one_place(O, x.obstacle, circle.obstacle) && orders.compare_radius(circle) == 0;
}

// Curves by which the surface enters and leaves, each between a joint on one side and the next one on the other: it enters after
// a joint of the sign `before`. Nothing if no joint is on one of the sides.
std::optional<std::array<Feature, 2>> RoundTrimmer::crossed_once(const Pillar& pillar, const std::vector<int>& sign, int before,
                                                                 Cover& out) const {
    for (const int side : {1, -1})
        if (std::count(sign.begin(), sign.end(), side) == 0) return {};
    const auto of = [&](int k) { return sign[static_cast<std::size_t>(k) % sign.size()]; };
    std::array<Feature, 2> curves_of_band;
    for (const int branch : {-1, 1}) {
        const int side = -branch * before;
        int k = 0;
        while (of(k) != side) ++k;
        while (of(k + 1) != -side) ++k;
        curves_of_band[branch < 0 ? 0 : 1] = feature_after(pillar, k, branch);
        watch_joint(pillar, k, side, out), watch_joint(pillar, k + 1, -side, out);
        watch_edge(pillar.edge(joint(pillar, k).edge), out);
        if (joint(pillar, k).edge != joint(pillar, k + 1).edge) watch_edge(pillar.edge(joint(pillar, k + 1).edge), out);
    }
    return curves_of_band;
}

// Counter-clockwise around the pillar, the line enters where joints on its left are followed by one on its right, and leaves
// where they come back. If no joint is on one side, an arc may still be.
void RoundTrimmer::on_line(const Pillar& pillar, const Sample& at, Cover& out) {
    const Feature& x = surface.contact;
    const std::vector<int>& sign = joint_signs(pillar, at);
    if (const auto curves_of_band = crossed_once(pillar, sign, 1, out)) {
        out.bands.push_back(*curves_of_band);
        return;
    }
    // the arc farthest on the side where no joint is
    const int side = std::count(sign.begin(), sign.end(), 1) > 0 ? -1 : 1, count = pillar.count();
    int far = 0;
    for (int k = 0; k < count; ++k) {
        const int before = side * cross_with_line(pillar.edge(k - 1).line, at);
        const int after = side * cross_with_line(pillar.edge(k).line, at);
        if (before >= 0 && after <= 0 && before != after) far = k;
    }
    const Feature circle = pillar.circle(far);
    if (is_smooth(scene, x, circle)) {  // it touches the line at its end
        watch_arc(pillar, far, out);
        return;
    }
    const auto reaches = [&](int to) {  // true if some of it is strictly on this side of the line
        const Feature tangent = with_branch(circle, to);
        const bool is_beyond = sign_of(tangent, {}, at) * to > 0;
        out.watched.push_back({tangent, {}, is_beyond ? to : -to, !is_beyond});
        return is_beyond;
    };
    watch_arc(pillar, far, out);
    if (count > 0)
        for (const int k : {2 * far - 1, 2 * far}) watch_joint(pillar, k, -side, out);
    if (!reaches(side) || (count == 0 && !reaches(-side))) {
        if (count > 0) watch_direction(pillar.edge(far - 1).line, side, out), watch_direction(pillar.edge(far).line, -side, out);
        return;
    }
    out.bands.push_back({with_branch(circle, -1), with_branch(circle, 1)});
}

// Place of the circle's centre along an edge, from the centre of an arc; see Event.
std::array<Feature, 2> RoundTrimmer::foot(const Pillar& pillar, int edge, int arc) const {
    return {pillar.edge(edge).line, with_branch(pillar.circle(arc), 2)};
}
int RoundTrimmer::foot_sign(const Pillar& pillar, int edge, int arc, const Sample& at) {
    const auto [line, circle] = foot(pillar, edge, arc);
    return sign_of(line, circle, at);
}

// The centre stays in the cone of an arc.
void RoundTrimmer::watch_cone(const Pillar& pillar, int k, Cover& out) const {
    if (pillar.count() == 0) return;
    for (const int edge : {k - 1, k}) {
        const auto [line, circle] = foot(pillar, edge, k);
        out.watched.push_back({line, circle, edge < k ? 1 : -1, true});
    }
}

// Counter-clockwise around the pillar, its rim goes into the circle where this leaves the pillar, and comes out where it enters.
// No joint may be inside though the rim cuts the circle in one feature; else the centre's nearest feature decides.
void RoundTrimmer::on_circle(const Pillar& pillar, const Sample& at, Cover& out) {
    const Feature& x = surface.contact;
    const int count = pillar.count();
    if (pillar.has_arcs || is_concave) return on_any_circle(pillar, joint_signs(pillar, at), at, out);
    for (int k = 0; k < count; ++k)  // the circle is one of its own: all but that arc is inside
        if (code(scene, with_branch(pillar.circle(k), x.branch)) == code(scene, x)) {
            watch_arc(pillar, k, out);
            clip_between(with_branch(pillar.edge(k).line, 0), with_branch(pillar.edge(k - 1).line, 0), at, out);
            return;
        }
    const std::vector<int>& sign = joint_signs(pillar, at);
    if (orders.compare_radius(pillar.circle(0)) != 0) return on_any_circle(pillar, sign, at, out);
    if (const auto curves_of_band = crossed_once(pillar, sign, -1, out)) {
        clip_between((*curves_of_band)[0], (*curves_of_band)[1], at, out);
        return;
    }
    // nearest feature to the centre: an edge beyond which it is, between its ends; an arc in whose cone it is; or none, inside
    for (int k = 0; k < count; ++k) {
        const Edge& edge = pillar.edge(k);
        if (foot_sign(pillar, k, k, at) <= 0 || foot_sign(pillar, k, k + 1, at) >= 0) continue;
        const int beyond = sign_of(with_branch(edge.line, -1), {}, at);  // of the ungrown edge, as radii are equal
        if (beyond >= 0) continue;
        const int touches = sign_of(with_branch(edge.line, 1), {}, at);
        watch_edge(edge, out);
        out.watched.push_back({with_branch(edge.line, 1), {}, touches > 0 ? 1 : -1, touches <= 0});
        if (touches <= 0) return;
        out.watched.push_back({with_branch(edge.line, -1), {}, -1, true});
        for (const int j : {2 * k, 2 * k + 1}) watch_joint(pillar, j, 1, out);
        clip_between(with_branch(edge.line, -1), with_branch(edge.line, 1), at, out);
        return;
    }
    for (int k = 0; k < std::max(count, 1); ++k) {
        if (count > 0 && (foot_sign(pillar, k - 1, k, at) < 0 || foot_sign(pillar, k, k, at) > 0)) continue;
        const Feature circle = pillar.circle(k);
        const int apart = sign_of(with_branch(circle, 1), {}, at);
        watch_arc(pillar, k, out);
        out.watched.push_back({with_branch(circle, 1), {}, apart >= 0 ? 1 : -1, apart >= 0});
        if (apart >= 0) {
            watch_cone(pillar, k, out);
            return;
        }
        if (count > 0)
            for (const int j : {2 * k - 1, 2 * k}) watch_joint(pillar, j, 1, out);
        clip_between(with_branch(circle, -1), with_branch(circle, 1), at, out);
        return;
    }
    // the centre is inside the ungrown pillar: if an edge is supported by another vertex, its line moves outwards
    for (const Edge& edge : pillar.edges) out.watched.push_back({with_branch(edge.line, -1), {}, 1, true});
    out.bands.push_back(quadrant());
}

// A circle of another radius than the pillar's rounding may cross each of its features twice. All are watched. A joint that is
// on the circle at every angle counts as outside: the rim crosses there in either of its features. But if the two touch there,
// both on the pillar's side of a line, the joint counts as inside: it is, for a pillar a little smaller.
void RoundTrimmer::on_any_circle(const Pillar& pillar, const std::vector<int>& sign, const Sample& at, Cover& out) {
    std::vector<Crossing> crossings;
    const int count = pillar.count(), n = 2 * count;
    const auto watch = [&](const Feature& first, const Feature& second, int wanted) {  // true if it has this sign
        const int found = sign_of(first, second, at);
        out.watched.push_back({first, second, found == wanted ? wanted : -wanted, found != wanted});
        return found == wanted;
    };
    const auto watch_foot = [&](int edge, int arc, int wanted) {
        const auto [line, circle] = foot(pillar, edge, arc);
        return watch(line, circle, wanted);
    };
    const auto cross_once = [&](const Feature& f, bool is_into) {
        crossings.push_back({with_branch(f, is_into ? 1 : -1), !is_into});
    };
    const auto cross_twice = [&](const Feature& f) { cross_once(f, true), cross_once(f, false); };
    const auto of = [&](int k) { return sign[static_cast<std::size_t>(k % n)]; };
    for (int k = 0; k < n; ++k) watch_joint(pillar, k, of(k), out);
    for (int k = 0; k < count; ++k) {
        const Edge& edge = pillar.edge(k);
        watch_edge(edge, out);
        if (is_stub(edge.line)) continue;
        const int first = of(2 * k), last = of(2 * k + 1);
        const Feature name = is_smooth(scene, edge.line, surface.contact) ? with_branch(edge.line, 0) : edge.line;
        if ((first < 0) != (last < 0)) cross_once(name, last < 0);
        else if (first >= 0 && watch(with_branch(edge.line, 1), {}, 1) && watch(with_branch(edge.line, -1), {}, -1) &&
                 watch_foot(k, k, 1) && watch_foot(k, k + 1, -1))
            cross_twice(name);
    }
    for (int k = 0; k < std::max(count, 1); ++k) {
        const Feature circle = pillar.circle(k);
        const int first = count > 0 ? of(2 * k - 1 + n) : 0, last = count > 0 ? of(2 * k) : 0;
        if (pillar.has_arcs && code(scene, with_branch(circle, surface.contact.branch)) == code(scene, surface.contact)) continue;
        if (const auto line = line_of_joint(scene, surface.contact, circle)) {  // there they touch, and meet nowhere else
            if ((first < 0) != (last < 0)) crossings.push_back({with_branch(*line, 0), last >= 0});
            continue;
        }
        if ((first < 0) != (last < 0)) {
            cross_once(circle, last < 0);
            continue;
        }
        if (!watch(with_branch(circle, 1), {}, -1) || !watch(with_branch(circle, -1), {}, 1)) continue;
        const int side = first < 0 ? -1 : 1;
        if (count > 0 && (!watch_foot(k - 1, k, side) || !watch_foot(k, k, -side))) continue;
        cross_twice(circle);
    }
    if (!crossings.empty()) {
        clip(crossings, at, out);
        return;
    }
    // all of the circle is inside, or outside: beyond an edge or an arc, or around the pillar
    bool is_apart = false;
    for (int k = 0; k < count; ++k) {
        if (foot_sign(pillar, k, k, at) <= 0 || foot_sign(pillar, k, k + 1, at) >= 0) continue;
        is_apart |= sign_of(with_branch(pillar.edge(k).line, 1), {}, at) <= 0;
    }
    for (int k = 0; k < std::max(count, 1); ++k) {
        if (count > 0 && (foot_sign(pillar, k - 1, k, at) < 0 || foot_sign(pillar, k, k, at) > 0)) continue;
        is_apart |= sign_of(with_branch(pillar.circle(k), 1), {}, at) >= 0;
    }
    const bool is_around = std::any_of(sign.begin(), sign.end(), [](int s) { return s < 0; }) ||
                           (count == 0 && (orders.compare_radius(pillar.circle(0)) > 0 || (is_concave && is_opposite(pillar.circle(0)))));
    if (!is_apart && !is_around) out.bands.push_back(quadrant()), turn_bands(out);
}

// The covered parts of the quadrant, from crossings in any order: between one where the circle enters and the next one.
void RoundTrimmer::clip(std::span<const Crossing> crossings, const Sample& at, Cover& out) {
    const Feature& x = surface.contact;
    const auto seams = quadrant();
    struct Placed {
        Crossing crossing;
        int quadrant;  // quarter turns from the beginning of this one
    };
    std::vector<Placed> placed;
    for (const Crossing& c : crossings) {
        for (const Feature& seam : seams) {  // of both branches
            const Feature other = with_branch(c.curve, 0);
            const int sign = sign_of(other, seam, at);
            out.watched.push_back({other, seam, sign, sign == 0});
            if (sign != 0 || is_smooth(scene, other, x)) continue;
            for (const int side : {1, -1}) {  // one of the two is always there: the other one passes it where the surfaces touch
                const int touches = sign_of(with_branch(other, side), {}, at);
                out.watched.push_back({with_branch(other, side), {}, touches, touches == 0});
            }
        }
        const int first = orders.coordinate_sign(c.curve, 0, at), second = orders.coordinate_sign(c.curve, 1, at);
        const int ahead = is_concave ? -second : first, back = is_concave ? -first : second;
        placed.push_back({c, ahead >= 0 ? (back <= 0 ? 0 : 1) : (back > 0 ? 2 : 3)});
    }
    if (is_critical) return;
    const auto order = [&](const Placed& p, const Placed& q) {
        if (p.quadrant != q.quadrant) return p.quadrant - q.quadrant;
        if (p.quadrant == 0) return (is_concave ? -1 : 1) * orders.order_at(p.crossing.curve, q.crossing.curve, at);
        Surface there = surface;
        there.contact.branch = static_cast<std::int8_t>((x.branch + p.quadrant) & 3);
        return (is_concave ? -1 : 1) * RoundOrders(scene, there).order_at(p.crossing.curve, q.crossing.curve, at);
    };
    std::sort(placed.begin(), placed.end(), [&](const Placed& p, const Placed& q) {
        const int sign = order(p, q);
        return sign != 0 ? sign < 0 : p.crossing.enters > q.crossing.enters;
    });
    // where a joint that is on the circle reaches out of it, nothing is covered between its two features
    for (std::size_t k = 0; k + 1 < placed.size();)
        if (const auto here = placed.begin() + static_cast<std::ptrdiff_t>(k); here->crossing.enters && order(*here, here[1]) == 0)
            placed.erase(here, here + 2);
        else
            ++k;
    if (placed.empty()) return;
    bool is_covered = placed.back().crossing.enters;
    Feature from = seams[0];
    for (const auto& [crossing, quadrant] : placed) {
        if (quadrant > 0) break;
        if (is_covered) out.bands.push_back({from, crossing.curve});
        is_covered = crossing.enters, from = crossing.curve;
    }
    if (is_covered) out.bands.push_back({from, seams[1]});
    turn_bands(out);
}

// The same for one part.
void RoundTrimmer::clip_between(const Feature& enters, const Feature& leaves, const Sample& at, Cover& out) {
    const Crossing both[] = {{enters, true}, {leaves, false}};
    clip(both, at, out);
}

// Bands in the order of t, which is clockwise on the circle of a concave arc.
void RoundTrimmer::turn_bands(Cover& out) const {
    if (!is_concave) return;
    for (auto& [lower, upper] : out.bands) std::swap(lower, upper);
    std::reverse(out.bands.begin(), out.bands.end());
}

// Narrow a span to the angles at which a state holds; false if the sample is critical.
bool RoundTrimmer::narrow(Cover& cover, const Sample& sample, Span& span) {
    for (const Watch& w : cover.watched) {
        // an end of the span that is its own root has no other root beside it
        const auto is_own = [&](const Event& x) { return x.fine < 0 && x.first == w.first && x.second == w.second; };
        const Event &from = events[span.from], &to = events[span.to];
        const double lo = is_own(from) ? from.hi : from.lo, hi = is_own(to) ? to.lo : to.hi;
        if (lo < hi && decide.event_sign_on(w.first, w.second, lo, hi) == w.sign) continue;
        const auto roots = decide.event_roots(w.first, w.second, events[span.from], events[span.to]);
        if (roots.all_zero) {
            if (!w.may_vanish) throw std::logic_error("a sign of a pillar's state is zero at every angle");
            continue;
        }
        const int at = decide.event_sign(w.first, w.second, sample);
        if (at == 0) return false;
        if (at != w.sign && w.sign != 0) throw std::logic_error("a pillar's state contradicts its own signs");
        for (const Event& root : roots.at) {
            const bool is_before = decide.order(root, sample) < 0;
            (is_before ? span.from : span.to) = intern(root);
            if (!is_before) break;
        }
    }
    return true;
}

// --- at one angle ----------------------------------------------------------------------------------------------------

// True if the line passes through the open pillar at an end of a band: discs around its vertices, and its arcs, are on both sides;
// or if the two curves do not meet there.
bool RoundTrimmer::crosses_at(const Band& band, Index event) {
    if (!is_line(surface.contact)) return order_at(event, band.area.lower, band.area.upper) != 0;
    if (band.p < 0) return true;  // of a fillet: more may count as covered there, which matters for parts without width only
    const Event& e = events[event];
    const Shape &A = scene.robot, &O = scene.obstacles;
    bool left = false, right = false;
    std::optional<LongRoot> root;
    const auto sign_of_event = [&](const Feature& first) {
        const int sign = decide.event_sign_on(first, {}, e.lo, e.hi);
        if (sign != 0) return sign;
        if (!root) root = decide.long_root_of(e);
        return sign_at(orders.exactly(first, {}).p, *root);
    };
    // Sign of V x U, V the edge's vector around the pillar.
    const Feature& on = surface.contact;
    const auto turn = [&](bool of_robot, Index edge) {
        const bool on_edge = on.kind == Kind::vertex_edge;
        if (of_robot == !on_edge) return of_robot ? decide.cross_sign(A, edge, on.robot) : decide.cross_sign(O, edge, on.obstacle);
        return on_edge ? -sign_of_event({Kind::edge_edge, edge, on.obstacle}) : sign_of_event({Kind::edge_edge, on.robot, edge});
    };
    // True if a vertex is none of an arc, or the arc has the direction of the rim on that side of the line.
    const auto has_direction = [&](const Shape& s, Index piece, Index at, int side) {
        if (!s.has_arcs() || !s.is_arc[s.piece_vertex[at]]) return true;
        const Index before = at > s.piece[piece] ? at - 1 : s.piece[piece + 1] - 1;
        const bool of_robot = &s == &A;
        return side * turn(of_robot, s.piece_edge[before]) <= 0 && side * turn(of_robot, s.piece_edge[at]) >= 0;
    };
    for (Index x = A.piece[band.p]; x < A.piece[band.p + 1]; ++x)
        for (Index y = O.piece[band.k]; y < O.piece[band.k + 1] && !(left && right); ++y)
            for (const int side : {1, -1}) {
                const Feature circle{Kind::vertex_vertex, A.piece_vertex[x], O.piece_vertex[y], side};
                if (side < 0 && is_smooth(scene, on, circle)) continue;
                if (!has_direction(A, band.p, x, side) || !has_direction(O, band.k, y, side)) continue;
                (side > 0 ? left : right) |= sign_of_event(circle) == side;
            }
    return left && right;
}

int RoundTrimmer::order_at(Index event, Index p, Index q) {
    const Curve &x = curves[p], &y = curves[q];
    if (x.code == y.code) return 0;
    const Event& e = events[event];
    const auto bare = [&](const Feature& f) { return code(scene, f.kind == Kind::seam ? f : with_branch(f, 0)); };
    const Code first = bare(e.first), second = bare(e.second), p_code = bare(x.feature), q_code = bare(y.feature);
    if (e.second.kind == Kind::none) {
        if (first == p_code && first == q_code) return 0;  // both branches, where the surface is touched
    } else if (!is_center(e.second) &&
               ((first == p_code && second == q_code) || (first == q_code && second == p_code))) {
        const auto is_pair = [&](const Feature& f, const Feature& g) { return code(scene, f) == x.code && code(scene, g) == y.code; };
        if (is_pair(e.first, e.second) || is_pair(e.second, e.first)) return 0;
        if (e.fine < 0 && orders.do_meet(x.feature, y.feature, e.lo, e.hi)) return 0;
    }
    if (const int sign = orders.order_on(x.feature, y.feature, e.lo, e.hi); sign != 0) return sign;
    if (const auto& near = decide.narrowed(e))
        if (const auto sign = orders.order_in_balls(x.feature, y.feature, ball_around(*near)); sign && *sign != 0) return *sign;
    LongRoot root = decide.long_root_of(e);
    return orders.order_at(x.feature, y.feature, root);
}

// Lines that are parallel at the angle have a place on the surface's line by continuity, if they are one with it, or none.
int RoundTrimmer::order_of_end(Index event, Index end_of_band, Index curve, int beyond) {
    if (goes_on_beyond(end_of_band)) return beyond;
    const Feature &on = surface.contact, &p = curves[end_of_band].feature, &q = curves[curve].feature;
    if (!is_line(on) || !(is_line(p) || is_line(q))) return order_at(event, end_of_band, curve);
    const Event& e = events[event];
    if (const int sign = orders.order_on(p, q, e.lo, e.hi); sign != 0) return sign;
    RoundJunction here(scene, surface.chart, e.lo, e.hi, [&] { return decide.long_root_of(e); }, [&] { return decide.narrowed(e); });
    if (e.first.kind == Kind::edge_edge) here.know_parallel(e.first.robot, e.first.obstacle);
    const RoundSpot end = here.spot(on, p, false), other = here.spot(on, q, false);
    if (end.is_limit && here.side(on, p) != 0) return beyond;
    const auto is_parallel = [&](const RoundSpot& spot, const Feature& f) { return spot.is_limit || spot.curve != f; };
    return is_parallel(end, p) || is_parallel(other, q) ? here.order(on, end, other) : order_at(event, end_of_band, curve);
}

void RoundTrimmer::bounds(Area& area) const {
    const double lo = events[area.from].lo, hi = events[area.to].hi;
    const auto lower = orders.range(curves[area.lower].feature, lo, hi), upper = orders.range(curves[area.upper].feature, lo, hi);
    area.t_min = lower[0], area.lower_max = lower[1], area.upper_min = upper[0], area.t_max = upper[1];
}

double RoundTrimmer::extreme(const Curve& c, double lo, double hi, bool want_max) const {
    return orders.range(c.feature, lo, hi)[want_max ? 1 : 0];
}

}  // namespace cfree
