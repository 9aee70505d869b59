// Octagons around pieces, along and across a patch's line, slice by slice; theory, "The trimmed boundary".
#include "forbidden/shadows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cfree/support/bit_cast.hpp"
#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

constexpr std::size_t most_recent = 8;        // pillars that are tried again
constexpr Index few = 12, corners_tried = 8;  // vertices of a polygon; about so many of a larger one are tried first

// Clip a convex polygon to |x|, |y| <= `reach`.
void clip(std::vector<Vec<double>>& polygon, double reach) {
    std::vector<Vec<double>> rest;
    for (const Vec<double>& n : {Vec<double>{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        rest.clear();
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Vec<double> &v = polygon[k], &w = polygon[k + 1 == polygon.size() ? 0 : k + 1];
            const double from = reach - dot(n, v), to = reach - dot(n, w);
            if (from >= 0) rest.push_back(v);
            if ((from < 0) == (to < 0)) continue;
            const double t = from / (from - to);
            rest.push_back({v.x + t * (w.x - v.x), v.y + t * (w.y - v.y)});
        }
        polygon.swap(rest);
    }
}

bool contains(const std::vector<Index>& list, Index from, Index to, Index what) {
    return std::find(list.begin() + from, list.begin() + to, what) != list.begin() + to;
}

Vec<double> place_of(const Shape& s, Index vertex) { return {s.x[vertex], s.y[vertex]}; }

Vec<double> edge_of(const Shape& s, Index edge) { return place_of(s, s.w[edge]) - place_of(s, s.v[edge]); }

std::uint64_t sign_bit(double x) { return bit_cast<std::uint64_t>(x) >> 63; }

double larger(const Vec<double>& d) { return std::max(std::abs(d.x), std::abs(d.y)); }

}  // namespace

Shadows::Shadows(const Scene& s) : scene(s), at_robot(static_cast<std::size_t>(s.robot.ring_vertices)) {
    const Shape& A = scene.robot;
    for (Index p = 0; p < A.pieces(); ++p) {
        Octagon around;
        for (Index n = A.piece[p]; n < A.piece[p + 1]; ++n) around.add(A.x[A.piece_vertex[n]], A.y[A.piece_vertex[n]]);
        around_robot.push_back(around);
    }
    const auto last = A.rounded.begin() + A.ring_vertices;
    if (std::find(A.rounded.begin(), last, true) == last) return;
    for (Index v = 0; v < A.ring_vertices; ++v) rounded_size = std::max(rounded_size, 2 * larger(place_of(A, v)));
}

void Shadows::look(const Shape& s, Index origin, Index piece, Side& side) const {
    const Vec<double> o = place_of(s, origin);
    for (Index n = s.piece[piece]; n < s.piece[piece + 1]; ++n) {
        const Vec<double> v = place_of(s, s.piece_vertex[n]);
        side.seen.push_back(v - o);
        const bool is_rounded = s.rounded[origin] | s.rounded[s.piece_vertex[n]];
        side.size = std::max(side.size, is_rounded ? 2 * std::max(larger(v), larger(o)) : larger(v - o));
    }
    side.start.push_back(static_cast<Index>(side.seen.size()));
}

void Shadows::look_at_robot(Index origin, Side& side) const {
    side.clear();
    for (Index p = 0; p < scene.robot.pieces(); ++p) look(scene.robot, origin, p, side);
}

// At a contact, the part of an obstacle that the robot covers or touches on the line is within reach of its corner. The rest
// would turn with it, and make its boxes long. The slack includes errors of this clipping.
void Shadows::around(Index j, const std::vector<Index>& pieces, double reach) {
    near = pieces;
    at_obstacle.is_known = false;
    recent.clear();
    robot_size = std::max(reach, rounded_size);
    obstacles.clear(), within_reach.clear();
    for (const Index k : near) look(scene.obstacles, j, k, obstacles);
    within_reach.size = obstacles.size;
    placed.assign(near.size(), {});
    for (Index x = 0; x < obstacles.count(); ++x)
        for (Index v = obstacles.start[x]; v < obstacles.start[x + 1]; ++v) placed[x].add(obstacles.seen[v].x, obstacles.seen[v].y);
    std::vector<Vec<double>> polygon;
    for (Index x = 0; x < obstacles.count(); ++x) {
        polygon.assign(obstacles.seen.begin() + obstacles.start[x], obstacles.seen.begin() + obstacles.start[x + 1]);
        clip(polygon, reach + 0x1p-40 * (reach + obstacles.size));
        within_reach.seen.insert(within_reach.seen.end(), polygon.begin(), polygon.end());
        within_reach.start.push_back(static_cast<Index>(within_reach.seen.size()));
    }
}

// Octagons of all pieces at the point of the angles of x and y.
void Shadows::turn_to(double x, double y, double sign, std::vector<Octagon>& out) const {
    const Vec<double> R = slices.corner(x, y);
    const double cosine = R.x, sine = sign * R.y;
    out.clear();
    for (Index q = 0; q < turning->count(); ++q) {
        Octagon around;
        for (Index v = turning->start[q]; v < turning->start[q + 1]; ++v)
            around.add(cosine * along[v] - sine * across[v], cosine * across[v] + sine * along[v]);
        out.push_back(around);
    }
}

void Shadows::turn(double sign, double slack) {
    const Index count = turning->count();
    auto &before = corners[0], &after = corners[1];
    turned.clear();
    turn_to(slices.at[0], slices.at[0], sign, before);
    for (int s = 0; s < slices.count; ++s) {
        const double from = slices.at[s], to = slices.at[s + 1];
        turn_to(from, to, sign, after);
        turned.insert(turned.end(), after.begin(), after.end());
        turn_to(to, to, sign, after);
        for (Index q = 0; q < count; ++q) {
            Octagon& around = turned[static_cast<std::size_t>(s * count + q)];
            around.add(before[static_cast<std::size_t>(q)]), around.add(after[static_cast<std::size_t>(q)]);
        }
        before.swap(after);
    }
    for (Octagon& around : turned)
        for (int i = 0; i < 4; ++i) around.low[i] -= (i < 2 ? 1 : 2) * slack, around.high[i] += (i < 2 ? 1 : 2) * slack;
}

void Shadows::stand(const Shape& s, Index edge, bool of_robot, Standing& out) const {
    const auto count = static_cast<std::size_t>(out.side.count());
    for (auto* column : {&out.along0, &out.along1, &out.across0, &out.across1}) column->resize(count);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    out.parallel.assign(count, {none, none}), out.has_edge.resize(count), out.octagon.assign(count, {});
    out.is_known = true, out.any_parallel = false;
    for (std::size_t x = 0; x < count; ++x) {
        const Index first = out.side.start[x], size = out.side.start[x + 1] - first, piece = s.piece[of_robot ? x : near[x]];
        Octagon& around = out.octagon[x];
        for (Index v = first; v < first + size; ++v) around.add(dot(E, out.side.seen[v]), cross(E, out.side.seen[v]));
        out.along0[x] = around.low[0], out.along1[x] = around.high[0], out.across0[x] = around.low[1], out.across1[x] = around.high[1];
        out.has_edge[x] = size > 1 && contains(s.piece_edge, piece, piece + size, edge);
        int found = 0;
        for (Index n = 0; size > 1 && n < size && found < 2; ++n)
            if (s.direction[s.piece_edge[piece + n]] == s.direction[edge])
                out.parallel[x][found++] = std::abs(cross(E, out.side.seen[first + n]));
        out.any_parallel |= found > 0;
    }
}

// True if a turning vertex may just reach the height of an edge along the line.
bool Shadows::may_pinch(Index q, Index x, double slack) const {
    for (const double height : still->parallel[x]) {
        if (std::isnan(height)) break;
        for (Index v = turning->start[q]; v < turning->start[q + 1]; ++v)
            if (std::abs(radius[v] - height) <= slack) return true;
    }
    return false;
}

const std::vector<Shadows::Pillar>& Shadows::on(const Surface& surface, double lo, double hi) {
    const Feature& contact = surface.contact;
    const bool on_edge = contact.kind == Kind::vertex_edge;
    const Shape& own = on_edge ? scene.obstacles : scene.robot;
    const Index edge = on_edge ? contact.obstacle : contact.robot;
    const Vec<double> v = place_of(own, own.v[edge]), w = place_of(own, own.w[edge]);
    E = w - v;
    slices.cut(lo, hi, surface.chart);
    Standing& standing = on_edge ? at_obstacle : at_robot[edge];
    if (!standing.is_known) {
        if (on_edge) standing.side = obstacles;
        else look_at_robot(own.v[edge], standing.side);
        stand(own, edge, !on_edge, standing);
    }
    still = &standing;
    if (on_edge) look_at_robot(contact.robot, robot);
    turning = on_edge ? &robot : &within_reach;
    along.clear(), across.clear(), radius.clear();
    for (const Vec<double>& d : turning->seen) along.push_back(dot(E, d)), across.push_back(cross(E, d));
    if (still->any_parallel)
        for (std::size_t k = 0; k < along.size(); ++k) radius.push_back(norm(along[k], across[k]));
    // Let |E.x|, |E.y| <= e and |d.x|, |d.y| <= m. They are within 2 u e and 8 u m of the truth, 6 u m of which by clipping;
    // parts along and across are within 25 u e m, and at most 2 e m; cosines and sines, at most 1.1, are within 6 u. So turned
    // values are within 2 (27.5 + 12 + 2.2) u e m + 4.4 u e m < 90 u e m, fixed ones within 25 u e m. The values compared with
    // them, at most e^2 apart, are within 16 u e^2; sums of two add 6 u of their size. 128 u suffices for all, and twice that
    // for diagonals.
    const bool is_rounded = own.rounded[own.v[edge]] | own.rounded[own.w[edge]];
    const double e = is_rounded ? 2 * std::max(larger(v), larger(w)) : larger(E);
    const double slack = 0x1p-45 * e * (turning->size + still->side.size + e) + 0x1p-900;
    length = dot(E, E);
    turn(on_edge ? 1 : -1, slack);
    pillars.clear(), ranges.clear();
    for (Index q = 0; q < turning->count(); ++q) add_pillars(q, contact, slack);
    std::sort(pillars.begin(), pillars.end(), [&](const Pillar& x, const Pillar& y) {
        if (x.cover != y.cover) return x.cover > y.cover;
        return x.p != y.p ? x.p < y.p : on_edge ? x.still < y.still : x.turning < y.turning;
    });
    return pillars;
}

// Range of the line that a fixed and a turning piece may cover in a slice: (s, 0) is in the difference of both octagons.
Shadows::Range Shadows::range_of(int slice, Index q, Index x) const {
    const Octagon &a = still->octagon[x], &b = in_slice(slice, q);
    return {std::max({a.low[0] - b.high[0], a.low[2] - b.high[2], a.low[3] - b.high[3]}),
            std::min({a.high[0] - b.low[0], a.high[2] - b.low[2], a.high[3] - b.low[3]})};
}

void Shadows::add_pillars(Index q, const Feature& contact, double slack) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const bool robot_turns = contact.kind == Kind::vertex_edge;
    const auto count = static_cast<std::size_t>(still->side.count());
    const double *along0 = still->along0.data(), *along1 = still->along1.data(), *across0 = still->across0.data(),
                 *across1 = still->across1.data();
    crossing.assign(count, 0), meeting.assign(count, 0);
    std::uint64_t *crosses_in = crossing.data(), *meets_in = meeting.data();
    for (int s = 0; s < slices.count; ++s) {
        const Octagon& box = in_slice(s, q);
        const double low = box.low[0], high = box.high[0] + length, below = box.low[1], above = box.high[1];
        for (std::size_t x = 0; x < count; ++x) {  // by signs of differences, without a branch: compilers make vectors of it
            const std::uint64_t passes = sign_bit(across1[x] - below) | sign_bit(above - across0[x]);
            const std::uint64_t misses = passes | sign_bit(along1[x] - low) | sign_bit(high - along0[x]);
            crosses_in[x] |= (passes ^ 1) << s;
            meets_in[x] |= (misses ^ 1) << s;
        }
    }
    const Index own = robot_turns ? q : near[q];
    const bool has_vertex = robot_turns ? contains(A.piece_vertex, A.piece[own], A.piece[own + 1], contact.robot)
                                        : contains(O.piece_vertex, O.piece[own], O.piece[own + 1], contact.obstacle);
    for (Index x = 0; x < still->side.count(); ++x) {
        if (crossing[x] == 0) continue;
        // the pieces in contact: on the patch, one's vertex is extreme towards the other's edge, and the line bounds the pillar
        if (has_vertex && still->has_edge[x]) continue;
        const Index p = robot_turns ? q : x, k = near[robot_turns ? x : q];
        if (A.piece_layer[p] != O.piece_layer[k]) continue;
        const bool pinches = still->any_parallel && may_pinch(q, x, slack);
        if (meeting[x] == 0 && !pinches) continue;
        Pillar pillar{p, k, q, x, pinches, 0, ranges.size(), 0};
        ranges.resize(pillar.ranges + static_cast<std::size_t>(slices.count));
        for (int s = 0; s < slices.count; ++s) {
            if (!((pinches ? crossing[x] : meeting[x]) >> s & 1)) continue;
            const Range& range = ranges[pillar.ranges + static_cast<std::size_t>(s)] = range_of(s, q, x);
            if (!(range.low <= range.high)) continue;  // the line passes beside it
            const double cover = std::min(range.high, length) - std::max(range.low, 0.0);
            if (cover >= 0 || pinches) pillar.slices |= std::uint32_t{1} << s;
            pillar.cover += std::max(0.0, cover) + 0x1p-5 * (range.high - range.low);  // of two that cover the same the larger
        }
        if (pillar.slices != 0) pillars.push_back(pillar);
        else ranges.resize(pillar.ranges);
    }
}

bool Shadows::cover_at_once(const Surface& surface, Event& from, Event& to) {
    slices.cut(from.lo, to.hi, surface.chart);
    const std::array<Helix, 2> ends = ends_of(surface.contact);
    const auto is_covered = [&](int s) {
        const Arc arc = arc_of(s);
        return recent_cover(ends, arc) || covers_slice(ends, s, arc);
    };
    int first = 0, last = slices.count - 1;
    while (first <= last && is_covered(first)) ++first;
    if (first > last) return true;
    while (last > first && is_covered(last)) --last;
    const auto at = [&](int s) { return Event{{}, {}, slices.at[s], slices.at[s]}; };
    if (first > 0) from = at(first);
    if (last + 1 < slices.count) to = at(last + 1);
    return false;
}

std::array<Shadows::Helix, 2> Shadows::ends_of(const Feature& contact) const {
    const Index i = contact.robot;
    if (contact.kind == Kind::vertex_edge) return {{{i, {0, 0}}, {i, edge_of(scene.obstacles, contact.obstacle)}}};
    return {{{scene.robot.v[i], {0, 0}}, {scene.robot.w[i], {0, 0}}}};
}

bool Shadows::recent_cover(const std::array<Helix, 2>& ends, const Arc& arc) {
    const auto covers = [&](const Overlap& x) { return stays_inside(x, x.witness[0], ends[0], arc) && stays_inside(x, x.witness[1], ends[1], arc); };
    const auto found = std::find_if(recent.begin(), recent.end(), covers);
    if (found == recent.end()) return false;
    std::rotate(recent.begin(), found, found + 1);
    return true;
}

// Try the pieces whose octagons meet at both ends of the line in the middle of a slice: all that may cover it. At each angle a
// pillar is convex: it is enough that it covers both ends. A vertex that stays inside the other piece is in its octagon then.
bool Shadows::covers_slice(const std::array<Helix, 2>& ends, int s, const Arc& arc) {
    const Shape& A = scene.robot;
    const double tau = (slices.at[s] + slices.at[s + 1]) / 2;
    const Vec<double> R = slices.corner(tau, tau);
    const auto turned = [&](Index v) {
        const Vec<double> d = place_of(A, v) - place_of(A, ends[0].a);
        return Vec<double>{R.x * d.x - R.y * d.y, R.x * d.y + R.y * d.x};
    };
    const Vec<double> shift[] = {{0, 0}, ends[1].at - turned(ends[1].a)};
    for (Index p = 0; p < A.pieces(); ++p) {
        Octagon around[2];
        at_middle.clear();
        for (Index n = A.piece[p]; n < A.piece[p + 1]; ++n) {
            at_middle.push_back(turned(A.piece_vertex[n]));
            around[0].add(at_middle.back().x, at_middle.back().y);
        }
        around[1] = around[0].shifted(shift[1]);
        const Octagon both = around[0].common(around[1]);
        for (Index place = 0; place < obstacles.count(); ++place) {
            if (A.piece_layer[p] != scene.obstacles.piece_layer[near[place]]) continue;
            if (!both.meets(placed[place])) continue;
            Overlap pieces{p, place};
            const auto has_witness = [&](int end) {
                Index& k = pieces.witness[end] = 0;
                for (const Vec<double>& v : at_middle) {
                    if (placed[place].has_inside(v + shift[end]) && stays_inside(pieces, k, ends[end], arc)) return true;
                    ++k;
                }
                for (Index n = obstacles.start[place]; n < obstacles.start[place + 1]; ++n, ++k)
                    if (around[end].has_inside(obstacles.seen[n]) && stays_inside(pieces, k, ends[end], arc)) return true;
                return false;
            };
            if (!has_witness(0) || !has_witness(1)) continue;
            std::erase_if(recent, [&](const Overlap& x) { return x.p == p && x.place == place; });
            if (recent.size() == most_recent) recent.pop_back();
            recent.insert(recent.begin(), pieces);
            return true;
        }
    }
    return false;
}

Shadows::Arc Shadows::arc_of(int s) const {
    const double lo = slices.at[s], hi = slices.at[s + 1];
    return {slices.corner(lo, hi), slices.corner(lo, lo), slices.corner(hi, hi)};
}

// True if a vertex of one piece stays inside the other along a helix in a slice: its arc is in the triangle of its control
// points.
bool Shadows::stays_inside(const Overlap& pieces, Index witness, const Helix& helix, const Arc& arc) const {
    const Shape& A = scene.robot;
    const Vec<double>* ring = obstacles.seen.data() + obstacles.start[pieces.place];
    const Vec<double> a = place_of(A, helix.a);
    const Index first = A.piece[pieces.p], robot_count = A.piece[pieces.p + 1] - first;
    const Index ring_count = obstacles.start[pieces.place + 1] - obstacles.start[pieces.place];
    const auto of_ring = [&](Index k) { return ring[k]; };
    const auto of_robot = [&](Index k) { return place_of(A, A.piece_vertex[first + k]) - a; };
    // Let relative coordinates of the robot be at most m, of obstacles at most M, as above: control points, at most 2.2 m from
    // the helix, are within 22 u m + 4 u M; edges, at most 2 M, within 6 u M; their product within 2 u M (77 m + 60 M). The
    // other case is alike.
    const double m = robot_size, M = obstacles.size, margin = 0x1p-43 * (m + M) * (m + M) + 0x1p-900;
    const auto is_within = [&](const auto& vertex, Index size, Index step, const Vec<double>& p) {  // every so many vertices
        Vec<double> v = vertex(0);
        for (Index k = step; size > 2; k += step) {
            const Vec<double> w = k < size ? vertex(k) : vertex(0);
            if (!(cross(w - v, p - v) > margin)) return false;
            if (k >= size) return true;
            v = w;
        }
        return false;
    };
    const auto is_inside = [&](const auto& vertex, Index size, const Vec<double>& p) {
        return (size > few && is_within(vertex, size, size / corners_tried, p)) || is_within(vertex, size, 1, p);
    };
    return std::all_of(arc.begin(), arc.end(), [&](const Vec<double>& R) {
        if (witness < robot_count) {
            const Vec<double> d = of_robot(witness), p = Vec<double>{R.x * d.x - R.y * d.y, R.x * d.y + R.y * d.x} + helix.at;
            return placed[pieces.place].has_inside(p) && is_inside(of_ring, ring_count, p);
        }
        const Vec<double> d = of_ring(witness - robot_count) - helix.at, p{R.x * d.x + R.y * d.y, R.x * d.y - R.y * d.x};
        return around_robot[pieces.p].has_inside(p + a) && is_inside(of_robot, robot_count, p);
    });
}

Slices::Part Shadows::part(const Pillar& pillar) const {
    Slices::Part result{slices.count, -1, pillar.may_pinch};
    for (int s = 0; s < slices.count; ++s) {
        if (!(pillar.slices >> s & 1) || slices.low[s] > slices.high[s]) continue;
        const Range& range = ranges[pillar.ranges + static_cast<std::size_t>(s)];
        const bool meets = range.high >= slices.low[s] * length && range.low <= slices.high[s] * length;
        if (meets || pillar.may_pinch) result.first = std::min(result.first, s), result.last = s;
    }
    return result;
}

}  // namespace cfree
