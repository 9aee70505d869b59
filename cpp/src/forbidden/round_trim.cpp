// Coverage of a line, or of a quadrant of a circle, by a rounded pillar: its states; theory, "Rounded shapes".
#include "forbidden/round_trim.hpp"

#include <algorithm>
#include <stdexcept>

namespace cfree {

RoundTrimmer::RoundTrimmer(const Scene& s, const Surface& on, const Event& from, const Event& to, const std::vector<Index>& edges)
    : Trimmer(s, on), orders(s, on), edges_at_centre(edges) {
    events = {from, to};
    if (is_circle(on.contact)) {
        live = in_cones(on.contact);
        return;
    }
    ends[0] = end_helix(s, on.contact, 0), ends[1] = end_helix(s, on.contact, 1);
    const Index t0 = curve_of(ends[0], false), t1 = curve_of(ends[1], false);
    live.push_back({0, 1, t0, t1, 0, 1});
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
std::array<Feature, 2> RoundTrimmer::ends_of_quadrant(const Dyadic& at) const {
    const auto seams = quadrant();
    auto limits = seams;
    for (const int end : {0, 1})
        for (const Index e : edges_at_centre) {
            const Feature joint{Kind::vertex_edge, surface.contact.robot, e};
            if (orders.turn(seams[end], joint, at) == 0 && orders.turn(seams[1 - end], joint, at) == (end ? 1 : -1)) limits[end] = joint;
        }
    return limits;
}

// The directions of a quadrant in the cones of both vertices, between joints with the edges beside them and ends of the quadrant,
// change only where two of these are parallel.
std::vector<Trimmer::Area> RoundTrimmer::in_cones(const Feature& contact) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = contact.robot, j = contact.obstacle;
    std::vector<Area> areas;
    const auto seams = quadrant();
    std::vector<std::array<Feature, 2>> cones;  // first and last direction
    if (O.has_extent(j)) cones.push_back({Feature{Kind::vertex_edge, i, O.previous[j]}, Feature{Kind::vertex_edge, i, j}});
    if (A.has_extent(i)) cones.push_back({Feature{Kind::edge_vertex, A.previous[i], j}, Feature{Kind::edge_vertex, i, j}});
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
    std::sort(cuts.begin(), cuts.end(), [&](const Event& p, const Event& q) { return decide.order(p, q) < 0; });
    cuts.push_back(events[1]);
    for (Index from = 0; const Event& cut : cuts) {
        if (decide.order(events[from], cut) == 0) continue;
        const Index to = intern(cut);
        const Dyadic at = decide.between(events[from], events[to]).exact();
        const auto is_inside = [&](const Feature& line) {
            if (orders.turn(seams[0], line, at) < 0 || orders.turn(line, seams[1], at) < 0) return false;
            return std::all_of(cones.begin(), cones.end(), [&](const auto& cone) {
                return orders.turn(cone[0], line, at) >= 0 && orders.turn(line, cone[1], at) >= 0;
            });
        };
        std::optional<Feature> limits[2];
        const auto ends_here = ends_of_quadrant(at);
        for (const int end : {0, 1}) {  // a joint in an end of the quadrant bounds
            if (is_inside(seams[end])) limits[end] = ends_here[end];
            for (const auto& cone : cones)
                if (is_inside(cone[end])) limits[end] = cone[end];
        }
        if (limits[0] && limits[1] && orders.turn(*limits[0], *limits[1], at) > 0)
            areas.push_back({from, to, curve_of(*limits[0], false), curve_of(*limits[1], false), 0, 1});
        from = to;
    }
    for (Area& area : areas) bounds(area);
    return areas;
}

void RoundTrimmer::cede_circle(const Feature& owner) {
    for (const Area& area : in_cones(owner)) take({area, -1, -1, nullptr});
}

void RoundTrimmer::cover(Index p, Index k) {
    static const State crossing{Meets::crosses, {}, {}, {}, 0, 0, {}, {}};
    todo.assign(1, {0, 1});
    while (!todo.empty() && !empty()) {
        const Span whole = todo.back();
        todo.pop_back();
        Span span = whole;
        Cover found;
        for (int attempt = 0;; ++attempt) {
            if (attempt == Predicates::most_attempts) throw std::logic_error("no sample decides a pillar's state");
            const Sample at = decide.between(events[whole.from], events[whole.to], attempt);
            Pillar pillar;
            span = whole;
            is_critical = false;
            if (!shape(p, k, at, pillar)) continue;
            found = is_line(surface.contact) ? on_line(pillar, at) : on_circle(pillar, at);
            if (!is_critical && narrow(found, at, span)) break;
        }
        for (const auto& [lower, upper] : found.bands) {
            Area band{span.from, span.to, curve_of(lower, false), curve_of(upper, false), 0, 1};
            bounds(band);
            take({band, p, k, &crossing});
        }
        for (const auto& [lower, upper] : found.touched) {
            Area pinch{span.from, span.to, curve_of(lower, false), curve_of(upper, false), 0, 1};
            bounds(pinch);
            subtract_from_live({pinch, -1, -1, nullptr});
        }
        if (span.to != whole.to) todo.push_back({span.to, whole.to});
        if (span.from != whole.from) todo.push_back({whole.from, span.from});
    }
}

// --- the pillar at a sample ------------------------------------------------------------------------------------------

// Sign at a sample; one that is zero there, and not at every angle, makes it critical.
int RoundTrimmer::sign_of(const Feature& first, const Feature& second, const Sample& at) {
    const int sign = decide.event_sign(first, second, at);
    is_critical |= sign == 0 && !is_zero(orders.exactly(first, second));
    return sign;
}

// Merge the edges of both pieces by direction; false if the sample is critical. An edge F of the obstacle is supported by the
// robot's vertex with R G_before x F <= 0 <= R G_after x F; as F turns on, so does that vertex.
bool RoundTrimmer::shape(Index p, Index k, const Sample& at, Pillar& out) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index *a = &A.piece_vertex[A.piece[p]], *b = &O.piece_vertex[O.piece[k]];
    const Index n = A.piece[p + 1] - A.piece[p], m = O.piece[k + 1] - O.piece[k];
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
    return scene.robot.vertex_radius[circle.robot] != 0 || scene.obstacles.vertex_radius[circle.obstacle] != 0;
}

// Sign of a joint: 1 left of the line or outside the circle; of those that are on it at every angle 0.
int RoundTrimmer::joint_sign(const Pillar& pillar, int k, const Sample& at) {
    const auto [edge, arc] = joint(pillar, k);
    const Feature line = pillar.edge(edge).line, circle = pillar.circle(arc);
    const Feature& x = surface.contact;
    if (is_smooth(scene, x, circle))  // two tangents of one circle, or two lines through a point
        return code(scene, x) != code(scene, line) && has_extent(circle) ? 1 : 0;
    return sign_of(line, circle, at);
}

void RoundTrimmer::watch_joint(const Pillar& pillar, int k, int sign, Cover& out) const {
    const auto [edge, arc] = joint(pillar, k);
    const Feature line = pillar.edge(edge).line, circle = pillar.circle(arc);
    if (!is_smooth(scene, surface.contact, circle)) out.watched.push_back({line, circle, sign, true});
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
        if (is_smooth(scene, x, f)) {
            const bool at_end = code(scene, f) == code(scene, ends[1]);
            return ends[at_end ? 1 : 0];
        }
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

std::vector<int> RoundTrimmer::joint_signs(const Pillar& pillar, const Sample& at) {
    std::vector<int> signs;
    for (int k = 0; k < 2 * pillar.count(); ++k) signs.push_back(joint_sign(pillar, k, at));
    return signs;
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
        watch_edge(pillar.edge(joint(pillar, k).edge), out), watch_edge(pillar.edge(joint(pillar, k + 1).edge), out);
    }
    return curves_of_band;
}

// Counter-clockwise around the pillar, the line enters where joints on its left are followed by one on its right, and leaves
// where they come back. If no joint is on one side, an arc may still be.
RoundTrimmer::Cover RoundTrimmer::on_line(const Pillar& pillar, const Sample& at) {
    Cover out;
    const Feature& x = surface.contact;
    const std::vector<int> sign = joint_signs(pillar, at);
    if (const auto curves_of_band = crossed_once(pillar, sign, 1, out)) {
        out.bands.push_back(*curves_of_band);
        return out;
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
        return out;
    }
    const auto reach = [&](int to) {  // 1 strictly to this side of the line, 0 if it touches this
        const Feature tangent = with_branch(circle, to);
        const int ahead = sign_of(tangent, {}, at) * to;
        out.watched.push_back({tangent, {}, ahead > 0 ? to : -to, ahead <= 0});
        return ahead;
    };
    watch_arc(pillar, far, out);
    if (count > 0)
        for (const int k : {2 * far - 1, 2 * far}) watch_joint(pillar, k, -side, out);
    const int beyond = reach(side);
    if (beyond <= 0 || (count == 0 && reach(-side) <= 0)) {
        if (side > 0 && beyond == 0) {
            touch(circle, at, out);
            for (const int k : {far - 1, far})  // an edge on the line: a slit, between both ends
                if (count > 0 && cross_with_line(pillar.edge(k).line, at) == 0) touch(pillar.circle(k < far ? k + count : k + 1), at, out);
        }
        if (count > 0) watch_direction(pillar.edge(far - 1).line, side, out), watch_direction(pillar.edge(far).line, -side, out);
        return out;
    }
    out.bands.push_back({with_branch(circle, -1), with_branch(circle, 1)});
    return out;
}

// Place of the circle's centre along an edge, from the centre of an arc; see Event.
std::array<Feature, 2> RoundTrimmer::foot(const Pillar& pillar, int edge, int arc) const {
    return {pillar.edge(edge).line, with_branch(pillar.circle(arc), 2)};
}
int RoundTrimmer::foot_sign(const Pillar& pillar, int edge, int arc, const Sample& at) {
    const auto [line, circle] = foot(pillar, edge, arc);
    return sign_of(line, circle, at);
}

// The centre stays beside an edge, between its ends.
void RoundTrimmer::watch_beside(const Pillar& pillar, int k, Cover& out) const {
    for (const int arc : {k, k + 1}) {
        const auto [line, circle] = foot(pillar, k, arc);
        out.watched.push_back({line, circle, arc == k ? 1 : -1, true});
    }
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
RoundTrimmer::Cover RoundTrimmer::on_circle(const Pillar& pillar, const Sample& at) {
    Cover out;
    const Feature& x = surface.contact;
    const int count = pillar.count();
    for (int k = 0; k < count; ++k)  // the circle is one of its own: all but that arc is inside
        if (code(scene, with_branch(pillar.circle(k), x.branch)) == code(scene, x)) {
            watch_arc(pillar, k, out);
            clip({{with_branch(pillar.edge(k).line, 0), true}, {with_branch(pillar.edge(k - 1).line, 0), false}}, at, out);
            return out;
        }
    const std::vector<int> sign = joint_signs(pillar, at);
    if (orders.compare_radius(pillar.circle(0)) != 0) return on_any_circle(pillar, sign, at);
    if (const auto curves_of_band = crossed_once(pillar, sign, -1, out)) {
        clip({{(*curves_of_band)[0], true}, {(*curves_of_band)[1], false}}, at, out);
        return out;
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
        if (touches == 0) watch_beside(pillar, k, out), touch(edge.line, at, out);
        if (touches <= 0) return out;
        out.watched.push_back({with_branch(edge.line, -1), {}, -1, true});
        for (const int j : {2 * k, 2 * k + 1}) watch_joint(pillar, j, 1, out);
        clip({{with_branch(edge.line, -1), true}, {with_branch(edge.line, 1), false}}, at, out);
        return out;
    }
    for (int k = 0; k < std::max(count, 1); ++k) {
        if (count > 0 && (foot_sign(pillar, k - 1, k, at) < 0 || foot_sign(pillar, k, k, at) > 0)) continue;
        const Feature circle = pillar.circle(k);
        const int apart = sign_of(with_branch(circle, 1), {}, at);
        watch_arc(pillar, k, out);
        out.watched.push_back({with_branch(circle, 1), {}, apart >= 0 ? 1 : -1, apart >= 0});
        if (apart == 0) touch(circle, at, out);
        if (apart >= 0) {
            watch_cone(pillar, k, out);
            return out;
        }
        if (count > 0)
            for (const int j : {2 * k - 1, 2 * k}) watch_joint(pillar, j, 1, out);
        clip({{with_branch(circle, -1), true}, {with_branch(circle, 1), false}}, at, out);
        return out;
    }
    // the centre is inside the ungrown pillar
    for (const Edge& edge : pillar.edges) {
        watch_edge(edge, out);
        out.watched.push_back({with_branch(edge.line, -1), {}, 1, true});
    }
    out.bands.push_back(quadrant());
    return out;
}

// A circle of another radius than the pillar's rounding may cross each of its features twice. All are watched. A joint that is
// on the circle at every angle counts as outside: the rim crosses there in either of its features.
RoundTrimmer::Cover RoundTrimmer::on_any_circle(const Pillar& pillar, const std::vector<int>& sign, const Sample& at) {
    Cover out;
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
        const int first = of(2 * k), last = of(2 * k + 1);
        const Feature name = is_smooth(scene, edge.line, surface.contact) ? with_branch(edge.line, 0) : edge.line;
        if ((first < 0) != (last < 0)) cross_once(name, last < 0);
        else if (first >= 0 && watch(with_branch(edge.line, 1), {}, 1) && watch(with_branch(edge.line, -1), {}, -1) &&
                 watch_foot(k, k, 1) && watch_foot(k, k + 1, -1))
            cross_twice(name);
    }
    bool is_apart = false;
    for (int k = 0; k < std::max(count, 1); ++k) {
        const Feature circle = pillar.circle(k);
        const int first = count > 0 ? of(2 * k - 1 + n) : 0, last = count > 0 ? of(2 * k) : 0;
        if ((first < 0) != (last < 0)) {
            cross_once(circle, last < 0);
            continue;
        }
        const bool is_inside = first < 0;
        if (!watch(with_branch(circle, 1), {}, -1) || !watch(with_branch(circle, -1), {}, 1)) continue;
        const int side = is_inside ? -1 : 1;
        if (count > 0 && (!watch_foot(k - 1, k, side) || !watch_foot(k, k, -side))) continue;
        if (!is_inside) cross_twice(circle);
        else cross_once(circle, false), cross_once(circle, true);
    }
    if (!crossings.empty()) {
        clip(crossings, at, out);
        return out;
    }
    // all of the circle is inside, or outside: beyond an edge or an arc, or around the pillar
    for (int k = 0; k < count; ++k) {
        if (foot_sign(pillar, k, k, at) <= 0 || foot_sign(pillar, k, k + 1, at) >= 0) continue;
        const Feature& line = pillar.edge(k).line;
        const int reach = sign_of(with_branch(line, 1), {}, at);
        if (reach == 0) watch_beside(pillar, k, out), touch(line, at, out);
        is_apart |= reach <= 0;
    }
    for (int k = 0; k < std::max(count, 1); ++k) {
        if (count > 0 && (foot_sign(pillar, k - 1, k, at) < 0 || foot_sign(pillar, k, k, at) > 0)) continue;
        const int gap = sign_of(with_branch(pillar.circle(k), 1), {}, at);
        if (gap == 0) watch_cone(pillar, k, out), touch(pillar.circle(k), at, out);
        is_apart |= gap >= 0;
    }
    const bool is_around = std::any_of(sign.begin(), sign.end(), [](int s) { return s < 0; }) ||
                           (count == 0 && orders.compare_radius(pillar.circle(0)) > 0);
    if (!is_apart && !is_around)
        out.bands.push_back(quadrant());
    return out;
}

// Cut the patch where a feature touches it from outside at every angle.
void RoundTrimmer::touch(const Feature& f, const Sample& at, Cover& out) {
    const std::array<Feature, 2> curve{with_branch(f, -1), with_branch(f, 1)};
    if (is_circle(surface.contact)) {
        const Feature other = with_branch(f, 0);
        for (const Feature& seam : quadrant()) {
            const int sign = sign_of(other, seam, at);
            out.watched.push_back({other, seam, sign, sign == 0});
        }
        const Dyadic tau = at.exact();
        if (orders.coordinate_sign(curve[0], 0, tau) <= 0 || orders.coordinate_sign(curve[0], 1, tau) >= 0) return;
    }
    out.touched.push_back(curve);
}

// The covered parts of the quadrant, from crossings in any order: between one where the circle enters and the next one.
void RoundTrimmer::clip(const std::vector<Crossing>& crossings, const Sample& at, Cover& out) {
    const Feature& x = surface.contact;
    const auto seams = quadrant();
    const Dyadic tau = at.exact();
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
        }
        const int ahead = orders.coordinate_sign(c.curve, 0, tau), back = orders.coordinate_sign(c.curve, 1, tau);
        placed.push_back({c, ahead >= 0 ? (back <= 0 ? 0 : 1) : (back > 0 ? 2 : 3)});
    }
    if (is_critical) return;
    const auto order = [&](const Placed& p, const Placed& q) {
        if (p.quadrant != q.quadrant) return p.quadrant - q.quadrant;
        Surface there = surface;
        there.contact.branch = static_cast<std::int8_t>((x.branch + p.quadrant) & 3);
        return RoundOrders(scene, there).order_at(p.crossing.curve, q.crossing.curve, tau);
    };
    std::sort(placed.begin(), placed.end(), [&](const Placed& p, const Placed& q) {
        const int sign = order(p, q);
        return sign != 0 ? sign < 0 : p.crossing.enters < q.crossing.enters;
    });
    // where it leaves and enters in one place, at a corner on the circle, it is covered on both sides or on none: twice, as the
    // first such place may follow others
    for (int again = 0; again < 2; ++again)
        for (std::size_t k = 0; k + 1 < placed.size(); ++k) {
            const bool is_one = !placed[k].crossing.enters && placed[k + 1].crossing.enters && order(placed[k], placed[k + 1]) == 0;
            const bool is_covered_before = placed[(k + placed.size() - 1) % placed.size()].crossing.enters;
            if (!is_one || is_covered_before) continue;
            const auto here = placed.begin() + static_cast<std::ptrdiff_t>(k);
            placed.erase(here, here + 2), --k;
        }
    bool is_covered = placed.back().crossing.enters;
    Feature from = seams[0];
    for (const auto& [crossing, quadrant] : placed) {
        if (quadrant > 0) break;
        if (is_covered) out.bands.push_back({from, crossing.curve});
        is_covered = crossing.enters, from = crossing.curve;
    }
    if (is_covered) out.bands.push_back({from, seams[1]});
}

// Narrow a span to the angles at which a state holds; false if the sample is critical.
bool RoundTrimmer::narrow(Cover& cover, const Sample& sample, Span& span) {
    for (const Watch& w : cover.watched) {
        if (decide.event_sign_on(w.first, w.second, events[span.from].lo, events[span.to].hi) == w.sign) continue;
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

// True if the line passes through the open pillar at an end of a band: discs around its vertices are on both sides; or if the
// two curves do not meet there.
bool RoundTrimmer::crosses_at(const Band& band, Index event) {
    if (!is_line(surface.contact)) return order_at(event, band.area.lower, band.area.upper) != 0;
    const Event& e = events[event];
    const Shape &A = scene.robot, &O = scene.obstacles;
    bool left = false, right = false;
    std::optional<LongRoot> root;
    for (Index x = A.piece[band.p]; x < A.piece[band.p + 1]; ++x)
        for (Index y = O.piece[band.k]; y < O.piece[band.k + 1] && !(left && right); ++y)
            for (const int side : {1, -1}) {
                const Feature circle{Kind::vertex_vertex, A.piece_vertex[x], O.piece_vertex[y], side};
                if (side < 0 && is_smooth(scene, surface.contact, circle)) continue;
                int sign = decide.event_sign_on(circle, {}, e.lo, e.hi);
                if (sign == 0) {
                    if (!root) root = decide.long_root_of(e);
                    sign = sign_at(orders.exactly(circle, {}), *root);
                }
                (side > 0 ? left : right) |= sign == side;
            }
    return left && right;
}

int RoundTrimmer::order_at(Index event, Index p, Index q) {
    const Curve &x = curves[p], &y = curves[q];
    if (x.code == y.code) return 0;
    const Event& e = events[event];
    if (e.first.kind != Kind::none && e.second.kind != Kind::none) {
        const Code first = code(scene, e.first), second = code(scene, e.second);
        if ((first == x.code && second == y.code) || (first == y.code && second == x.code)) return 0;
    }
    if (const int sign = orders.order_on(x.feature, y.feature, e.lo, e.hi); sign != 0) return sign;
    LongRoot root = decide.long_root_of(e);
    return orders.order_at(x.feature, y.feature, root);
}

double RoundTrimmer::extreme(const Curve& c, double lo, double hi, bool want_max) const {
    return orders.range(c.feature, lo, hi)[want_max ? 1 : 0];
}

}  // namespace cfree
