#include "cfree/boundary.hpp"

#include <algorithm>
#include <array>

#include "box_tree.hpp"
#include "cfree/isolated.hpp"

namespace cfree {

namespace {

bool has_extent(const Shape& s, Index edge) { return s.v[edge] != s.w[edge]; }

// Ring features that share a class: the candidates for coincident surfaces.
struct Groups {
    std::vector<Index> start, member;
    Groups(const std::vector<Index>& group, Index count) {
        Index last = -1;
        for (Index k = 0; k < count; ++k) last = std::max(last, group[k]);
        start.assign(static_cast<std::size_t>(last) + 2, 0);
        for (Index k = 0; k < count; ++k) ++start[group[k] + 1];
        for (std::size_t g = 1; g < start.size(); ++g) start[g] += start[g - 1];
        member.resize(count);
        std::vector<Index> at(start.begin(), start.end() - 1);
        for (Index k = 0; k < count; ++k) member[at[group[k]]++] = k;
    }
};

struct Range {
    int count = 0;
    int chart[2];
    Event from[2], to[2];
};

// The orientations of a contact (the paper's phi_min to phi_max), cut at the chart walls.
Range range_of(const Scene& scene, const Feature& contact, Counters& counters) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = contact.robot, j = contact.obstacle;
    const Event first_wall{{}, {}, -1, -1}, last_wall{{}, {}, 1, 1};
    const bool on_edge = contact.kind == Kind::vertex_edge;
    if (on_edge && A.previous[i] == i)  // a point touches at every orientation
        return {2, {0, 1}, {first_wall, first_wall}, {last_wall, last_wall}};
    const auto start = on_edge ? Predicates::range_end(scene, i, j, true, counters)
                               : Predicates::range_end(scene, i, O.previous[j], true, counters);
    const auto end = on_edge ? Predicates::range_end(scene, A.previous[i], j, false, counters)
                             : Predicates::range_end(scene, i, j, false, counters);
    if (start.chart == end.chart) return {1, {start.chart, 0}, {start.event, {}}, {end.event, {}}};
    return {2, {start.chart, end.chart}, {start.event, first_wall}, {last_wall, end.event}};
}

void gather(std::vector<std::vector<Trapezoid>>& lists, Trapezoids& into) {
    std::size_t total = 0;
    for (const auto& list : lists) total += list.size();
    into.reserve(total);
    for (auto& list : lists) {
        for (const Trapezoid& x : list) into.push_back(x);
        std::vector<Trapezoid>().swap(list);
    }
}

}  // namespace

Patches list_patches(const Scene& scene) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    Patches list;
    const auto add = [&](Kind kind, Index i, Index j) {
        list.kind.push_back(static_cast<std::uint8_t>(kind)), list.robot.push_back(i), list.obstacle.push_back(j);
    };
    for (Index j = 0; j < O.ring_vertices; ++j) {
        if (!O.emit[j]) continue;
        for (Index i = 0; i < A.ring_vertices; ++i)
            if (A.layer[i] == O.layer[j] && A.convex[i]) add(Kind::vertex_edge, i, j);
        for (Index i = 0; O.convex[j] && i < A.ring_vertices; ++i)
            if (A.layer[i] == O.layer[j] && has_extent(A, i)) add(Kind::edge_vertex, i, j);
    }
    return list;
}

// Which pillars can reach a patch. Boxes are rounded outwards: this decides nothing.
class Job::Neighbours {
public:
    explicit Neighbours(const Scene& s)
        : scene(s), tree(piece_boxes(s.obstacles)), boxes(piece_boxes(s.obstacles)),
          robot_points(s.robot.point, s.robot.ring_vertices), robot_lines(s.robot.line, s.robot.ring_vertices),
          obstacle_points(s.obstacles.point, s.obstacles.ring_vertices),
          obstacle_lines(s.obstacles.line, s.obstacles.ring_vertices) {
        const Shape& A = s.robot;
        Box robot;
        for (std::size_t v = 0; v < A.x.size(); ++v) robot.add(A.x[v], A.y[v]);
        reach = std::hypot(robot.x1 - robot.x0, robot.y1 - robot.y0);
    }

    // Pieces near the obstacle edge or vertex j, nearest first.
    void near(Index j, std::vector<Index>& out) const {
        const Shape& O = scene.obstacles;
        Box contact;
        contact.add(O.x[O.v[j]], O.y[O.v[j]]), contact.add(O.x[O.w[j]], O.y[O.w[j]]);
        out.clear();
        tree.query(grown(contact, reach), [&](Index k) { out.push_back(k); });
        const double x = contact.x0 + contact.x1, y = contact.y0 + contact.y1;
        const auto distance = [&](Index k) {
            return std::hypot(boxes[k].x0 + boxes[k].x1 - x, boxes[k].y0 + boxes[k].y1 - y);
        };
        std::sort(out.begin(), out.end(), [&](Index p, Index q) {
            const double dp = distance(p), dq = distance(q);
            return dp < dq || (dp == dq && p < q);
        });
    }

    // Where robot piece p can be while the contact holds between two angles of one chart.
    Box swept(const Feature& contact, Index p, int chart, double lo, double hi) const {
        const Shape &A = scene.robot, &O = scene.obstacles;
        const bool on_edge = contact.kind == Kind::vertex_edge;
        const Index a[2] = {on_edge ? contact.robot : A.v[contact.robot], on_edge ? contact.robot : A.w[contact.robot]};
        const Index b[2] = {on_edge ? O.v[contact.obstacle] : contact.obstacle,
                            on_edge ? O.w[contact.obstacle] : contact.obstacle};
        // every arc lies in the polygon of its end points and the tangents' meeting points
        std::array<Vec<double>, 17> turn;
        int turns = 0;
        const double from = 2 * std::atan(lo), width = 2 * std::atan(hi) - from;
        const int arcs = 1 + static_cast<int>(width / 0.5);
        const double half = 0.5 * width / arcs, out = 1 / std::cos(half), sign = chart ? -1 : 1;
        for (int k = 0; k <= 2 * arcs; ++k) {
            const double angle = from + k * half, r = sign * (k % 2 ? out : 1);
            turn[turns++] = {r * std::cos(angle), r * std::sin(angle)};
        }
        Box box;
        for (Index k = A.piece[p]; k < A.piece[p + 1]; ++k)
            for (int end = 0; end < (on_edge ? 1 : 2); ++end) {
                const double dx = A.x[A.piece_vertex[k]] - A.x[a[end]], dy = A.y[A.piece_vertex[k]] - A.y[a[end]];
                for (int t = 0; t < turns; ++t) box.add(turn[t].x * dx - turn[t].y * dy, turn[t].y * dx + turn[t].x * dy);
            }
        const double x0 = std::min(O.x[b[0]], O.x[b[1]]), x1 = std::max(O.x[b[0]], O.x[b[1]]);
        const double y0 = std::min(O.y[b[0]], O.y[b[1]]), y1 = std::max(O.y[b[0]], O.y[b[1]]);
        return grown({box.x0 + x0, box.y0 + y0, box.x1 + x1, box.y1 + y1}, 0);
    }

    const Box& box(Index k) const { return boxes[k]; }

private:
    static Box grown(const Box& b, double by) {
        const double size = std::max({std::abs(b.x0), std::abs(b.x1), std::abs(b.y0), std::abs(b.y1)});
        const double d = by + (size + by) * 0x1p-40;
        return {b.x0 - d, b.y0 - d, b.x1 + d, b.y1 + d};
    }
    static std::vector<Box> piece_boxes(const Shape& s) {
        std::vector<Box> result(s.pieces());
        for (Index k = 0; k < s.pieces(); ++k) {
            Box box;
            for (Index v = s.piece[k]; v < s.piece[k + 1]; ++v) box.add(s.x[s.piece_vertex[v]], s.y[s.piece_vertex[v]]);
            result[k] = grown(box, 0);
        }
        return result;
    }
    const Scene& scene;
    BoxTree tree;
    std::vector<Box> boxes;
    double reach;

public:
    const Groups robot_points, robot_lines, obstacle_points, obstacle_lines;
};

Job::Job(std::shared_ptr<const Scene> s, int threads, bool without_slits) : scene(std::move(s)), regularized(without_slits) {
    runner = std::thread([this, threads] { run(threads); });
}

Job::~Job() {
    stop = true;
    runner.join();
}

bool Job::wait(double seconds) {
    std::unique_lock lock(mutex);
    ended_signal.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return ended; });
    if (ended && error) std::rethrow_exception(error);
    return ended;
}

double Job::progress() const {
    const std::lock_guard lock(mutex);
    const auto all = first_patch.empty() ? 0 : first_patch.back();
    return all == 0 ? 0.0 : static_cast<double>(done) / all;
}

void Job::run(int threads) {
    using Clock = std::chrono::steady_clock;
    const auto seconds = [](Clock::time_point from) { return std::chrono::duration<double>(Clock::now() - from).count(); };
    try {
        auto start = Clock::now();
        patches = list_patches(*scene);
        const Index count = scene->obstacles.ring_vertices;
        neighbours = std::make_unique<Neighbours>(*scene);
        found.resize(count), found_thin.resize(count), trimmed.assign(patches.kind.size(), 0);
        std::vector<Index> first(static_cast<std::size_t>(count) + 1, 0);
        for (const Index j : patches.obstacle) ++first[j + 1];
        for (Index j = 0; j < count; ++j) first[j + 1] += first[j];
        {
            const std::lock_guard lock(mutex);
            first_patch = std::move(first);
        }
        tally.setup_seconds = seconds(start);
        start = Clock::now();
        std::vector<std::thread> pool;
        for (int t = 1; t < threads; ++t) pool.emplace_back([this] { work(); });
        work();
        for (std::thread& t : pool) t.join();
        tally.trim_seconds = seconds(start);
        start = Clock::now();
        Trapezoids thin;
        if (!error && (!stop || early)) gather(found, trapezoids), gather(found_thin, thin);
        tally.collect_seconds = seconds(start);
        start = Clock::now();
        if (!error && !stop) isolated = isolated_parts(*scene, patches, trapezoids, thin, threads, stop);
        tally.isolated_seconds = seconds(start);
    } catch (...) {
        const std::lock_guard lock(mutex);
        error = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    ended = true;
    ended_signal.notify_all();
}

void Job::work() {
    const Shape &A = scene->robot, &O = scene->obstacles;
    const auto rank = [&](Kind kind, Index i, Index j) {
        if (kind == Kind::vertex_edge) return std::array<Index, 2>{A.vertex_rank[i], O.edge_rank[j]};
        return std::array<Index, 2>{A.edge_rank[i], O.vertex_rank[j]};
    };
    Tally mine;
    std::vector<Index> close;
    try {
        for (Index j = next++; j < O.ring_vertices && !stop; j = next++) {
            if (first_patch[j] == first_patch[j + 1]) continue;
            neighbours->near(j, close);
            for (Index id = first_patch[j]; id < first_patch[j + 1] && !stop; ++id, ++done) {
                const Feature contact{static_cast<Kind>(patches.kind[id]), patches.robot[id], patches.obstacle[id]};
                const Range range = range_of(*scene, contact, mine.decisions);
                const std::size_t before = found[j].size();
                for (int r = 0; r < range.count; ++r) {
                    const Event &from = range.from[r], &to = range.to[r];
                    Trimmer trimmer(*scene, {contact, range.chart[r]}, from, to);
                    // coincident surfaces: the lowest rank owns what they share
                    const bool on_edge = contact.kind == Kind::vertex_edge;
                    const Groups& robots = on_edge ? neighbours->robot_points : neighbours->robot_lines;
                    const Groups& others = on_edge ? neighbours->obstacle_lines : neighbours->obstacle_points;
                    const Index gr = on_edge ? A.point[contact.robot] : A.line[contact.robot];
                    const Index go = on_edge ? O.line[contact.obstacle] : O.point[contact.obstacle];
                    for (Index x = robots.start[gr]; x < robots.start[gr + 1]; ++x) {
                        for (Index y = others.start[go]; y < others.start[go + 1]; ++y) {
                            const Index i2 = robots.member[x], j2 = others.member[y];
                            if (!O.emit[j2] || A.layer[i2] != O.layer[j2]) continue;
                            if (on_edge ? !A.convex[i2] : !(O.convex[j2] && has_extent(A, i2))) continue;
                            if (!(rank(contact.kind, i2, j2) < rank(contact.kind, contact.robot, j))) continue;
                            const Range shared = range_of(*scene, {contact.kind, i2, j2}, mine.decisions);
                            const Feature first{Kind::vertex_vertex, on_edge ? i2 : A.v[i2], on_edge ? O.v[j2] : j2};
                            const Feature last{Kind::vertex_vertex, on_edge ? i2 : A.w[i2], on_edge ? O.w[j2] : j2};
                            for (int s = 0; s < shared.count; ++s)
                                if (shared.chart[s] == range.chart[r]) trimmer.cede(first, last, shared.from[s], shared.to[s]);
                        }
                    }
                    if (regularized)
                        for (const auto& [i2, j2] : opposite(contact)) {
                            const Range shared = range_of(*scene, {contact.kind, i2, j2}, mine.decisions);
                            const Feature first{Kind::vertex_vertex, i2, O.w[j2]}, last{Kind::vertex_vertex, i2, O.v[j2]};
                            for (int s = 0; s < shared.count; ++s)
                                if (shared.chart[s] == range.chart[r]) trimmer.cede(first, last, shared.from[s], shared.to[s]);
                        }
                    for (Index p = 0; p < A.pieces() && !trimmer.empty(); ++p) {
                        const Box reachable = neighbours->swept(contact, p, range.chart[r], from.lo, to.hi);
                        for (const Index k : close) {
                            if (A.piece_layer[p] != O.piece_layer[k] || !reachable.meets(neighbours->box(k))) continue;
                            ++mine.pairs;
                            trimmer.cover(p, k);
                            if (trimmer.empty()) break;
                        }
                    }
                    trimmer.finish(id, found[j], found_thin[j]);
                    mine.decisions += trimmer.decide.counters;
                }
                mine.live_patches += found[j].size() > before;
                trimmed[id] = 1;
            }
        }
    } catch (...) {
        stop = true;
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    tally.pairs += mine.pairs, tally.live_patches += mine.live_patches, tally.decisions += mine.decisions;
}

// Patches of the same surface with the other side forbidden: a robot vertex at the reference point, a wall on a bound.
std::vector<std::pair<Index, Index>> Job::opposite(const Feature& contact) const {
    const Shape &A = scene->robot, &O = scene->obstacles;
    std::vector<std::pair<Index, Index>> result;
    if (contact.kind != Kind::vertex_edge) return result;
    const Index i = contact.robot, j = contact.obstacle;
    for (Index i2 = 0; i2 < A.ring_vertices; ++i2) {
        if (A.point[i2] != A.point[i] || A.layer[i2] == A.layer[i] || !A.convex[i2]) continue;
        for (Index j2 = 0; j2 < O.ring_vertices; ++j2) {
            if (O.layer[j2] != A.layer[i2] || O.direction[j2] != O.direction[j] || !O.emit[j2]) continue;
            const auto E = edge<Int>(O, j), F = edge<Int>(O, j2);
            if (dot(E, F).sign() < 0 && cross(E, difference<Int>(O, O.v[j2], O.v[j])).is_zero()) result.push_back({i2, j2});
        }
    }
    return result;
}

void Trapezoids::reserve(std::size_t count) {
    patch.reserve(count), chart.reserve(count);
    for (auto* v : {&lower, &upper, &from_first, &from_second, &to_first, &to_second}) v->reserve(count);
    for (auto* v : {&from_lo, &from_hi, &to_lo, &to_hi}) v->reserve(count);
    from_place.reserve(count), to_place.reserve(count);
}

void Trapezoids::push_back(const Trapezoid& x) {
    patch.push_back(x.patch), chart.push_back(static_cast<std::uint8_t>(x.chart));
    lower.push_back(packed(x.lower)), upper.push_back(packed(x.upper));
    from_first.push_back(packed(x.from.first)), from_second.push_back(packed(x.from.second));
    to_first.push_back(packed(x.to.first)), to_second.push_back(packed(x.to.second));
    from_lo.push_back(x.from.lo), from_hi.push_back(x.from.hi);
    to_lo.push_back(x.to.lo), to_hi.push_back(x.to.hi);
    from_place.push_back(static_cast<std::uint8_t>(x.from_place));
    to_place.push_back(static_cast<std::uint8_t>(x.to_place));
}

}  // namespace cfree
