// Distances of convex pieces by separating axes and closest features; theory, "Paths".
#include "cfree/search/nearness.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "cfree/support/elementary.hpp"
#include "collision/box_tree.hpp"

namespace cfree {

namespace {

constexpr int deepest = 16, most_parts = 4096;  // limits for a motion: one that needs more does not keep its distance
constexpr double nearly = 0.95;
constexpr double looks_apart = 0.125;  // distance of sampled poses, in the robot's radii
constexpr int most_counted = 32;
constexpr double rounding = 0x1p-40;  // per size of the scene
constexpr Index few_parts = 3;        // of a robot: all are tested against all obstacles near by, else those near its hull

}  // namespace

void Nearness::Pieces::add(const std::vector<Vec<double>>& ring) {
    Box box;
    Disc next{};
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec<double> p = ring[k], e = ring[k + 1 < ring.size() ? k + 1 : 0] - p;
        const double length = std::max(norm(e.x, e.y), 1e-300);
        x.push_back(p.x), y.push_back(p.y);
        nx.push_back(e.y / length), ny.push_back(-e.x / length);
        h.push_back(nx.back() * p.x + ny.back() * p.y);
        box.add(p.x, p.y);
        next.inner.x += p.x / static_cast<double>(ring.size()), next.inner.y += p.y / static_cast<double>(ring.size());
    }
    next.x = 0.5 * (box.x0 + box.x1), next.y = 0.5 * (box.y0 + box.y1);
    for (const auto& p : ring) next.radius = std::max(next.radius, norm(p.x - next.x, p.y - next.y));
    disc.push_back(next);
    first.push_back(static_cast<Index>(x.size()));
}

Nearness::Pieces Nearness::pieces_of(const Shape& s) {
    Pieces p;
    for (Index k = 0; k < s.pieces(); ++k) {
        if (s.piece[k + 1] - s.piece[k] < 3 || s.piece_layer[k] != 0) continue;
        std::vector<Vec<double>> ring;
        for (Index m = s.piece[k]; m < s.piece[k + 1]; ++m) ring.push_back({s.x[s.piece_vertex[m]], s.y[s.piece_vertex[m]]});
        p.add(ring);
    }
    return p;
}

// Convex hull, counter-clockwise (Andrew's monotone chains, 1979).
static std::vector<Vec<double>> hull_of(std::vector<Vec<double>> points) {
    std::sort(points.begin(), points.end(), [](const auto& p, const auto& q) { return p.x < q.x || (p.x == q.x && p.y < q.y); });
    std::vector<Vec<double>> hull;
    for (const bool is_upper : {false, true}) {
        const std::size_t least = hull.size() + 1;
        for (const auto& p : points) {
            while (hull.size() > least && !(cross(hull.back() - hull[hull.size() - 2], p - hull.back()) > 0)) hull.pop_back();
            hull.push_back(p);
        }
        if (!is_upper) std::reverse(points.begin(), points.end());
        hull.pop_back();
    }
    return hull;
}

Nearness::Nearness(const Scene& scene, double slack) : robot(pieces_of(scene.robot)), obstacles(pieces_of(scene.obstacles)), robot_parts(robot.count()) {
    std::vector<Box> boxes(static_cast<std::size_t>(obstacles.count()));
    double size = 0;
    for (Index j = 0; j < obstacles.count(); ++j)
        for (Index k = obstacles.first[j]; k < obstacles.first[j + 1]; ++k) {
            boxes[j].add(obstacles.x[k], obstacles.y[k]);
            size = std::max({size, std::abs(obstacles.x[k]), std::abs(obstacles.y[k])});
        }
    least_distance = rounding * size + slack;
    for (std::size_t k = 0; k < robot.x.size(); ++k) reach = std::max(reach, norm(robot.x[k], robot.y[k]));
    tree = std::make_unique<BoxTree>(std::move(boxes));
    if (robot_parts <= few_parts) return;
    std::vector<Vec<double>> points;
    for (std::size_t k = 0; k < robot.x.size(); ++k) points.push_back({robot.x[k], robot.y[k]});
    robot.add(hull_of(std::move(points)));
}
Nearness::~Nearness() = default;

// The robot at a place.
struct Nearness::Placed {
    double px, py, c, s;
    std::vector<double> x, y;
    Placed(const Pieces& p, const Place& at) : Placed(p, at, cosine_sine(at.theta)) {}
    Placed(const Pieces& p, const Place& at, const CosineSine& turn)
        : px(at.x), py(at.y), c(turn.c), s(turn.s), x(p.x.size()), y(p.x.size()) {
        for (std::size_t k = 0; k < x.size(); ++k) {
            x[k] = px + (c * p.x[k] - s * p.y[k]);
            y[k] = py + (s * p.x[k] + c * p.y[k]);
        }
    }
    Vec<double> turned(const Vec<double>& v) const { return {c * v.x - s * v.y, s * v.x + c * v.y}; }
    Vec<double> turned_back(const Vec<double>& v) const { return {c * v.x + s * v.y, c * v.y - s * v.x}; }
    Vec<double> at(const Vec<double>& p) const { return {px + (c * p.x - s * p.y), py + (s * p.x + c * p.y)}; }
    Vec<double> seen(const Vec<double>& p) const { return turned_back({p.x - px, p.y - py}); }  // from the robot
};

// Distance of a point in the piece's own frame ahead of an edge's line.
double Nearness::Pieces::ahead(Index edge, const Vec<double>& p) const { return nx[edge] * p.x + ny[edge] * p.y - h[edge]; }

// The widest gap that the line of an edge parts two pieces by, and the vertex ahead of it.
struct Nearness::Gap {
    double width = -HUGE_VAL;
    Vec<double> normal{}, vertex{};  // normal: from the obstacle to the robot
    Index edge = 0;
    bool of_robot = false;
};

// False if the gap, or that of the discs around the pieces, is at least `within`. No line parts pieces farther than it is from a
// point inside the other one: most lines need no more than that.
bool Nearness::is_gap_narrower(const Placed& placed, Index i, Index j, double within, Gap& gap) const {
    const auto &a = robot.disc[i], &b = obstacles.disc[j];
    const Vec<double> between = placed.at({a.x, a.y}) - Vec<double>{b.x, b.y};
    const double most_apart = within + a.radius + b.radius;
    if (dot(between, between) >= most_apart * most_apart) return false;
    const Index a0 = robot.first[i], a1 = robot.first[i + 1], b0 = obstacles.first[j], b1 = obstacles.first[j + 1];
    const Vec<double> in_robot = placed.at(a.inner), in_obstacle = placed.seen(b.inner);
    const auto is_wide = [&](Index k, const Vec<double>& n, double h, bool of_robot) {
        const auto &x = of_robot ? obstacles.x : placed.x, &y = of_robot ? obstacles.y : placed.y;
        const Index begin = of_robot ? b0 : a0, end = of_robot ? b1 : a1;
        double side = HUGE_VAL;
        Index nearest = begin;
        for (Index v = begin; v < end; ++v)
            if (const double d = n.x * x[v] + n.y * y[v]; d < side) side = d, nearest = v;
        const double width = side - h;
        if (width > gap.width) gap = {width, of_robot ? Vec<double>{-n.x, -n.y} : n, {x[nearest], y[nearest]}, k, of_robot};
        return width >= within;
    };
    const auto is_wide_at_obstacle = [&](Index k) { return is_wide(k, {obstacles.nx[k], obstacles.ny[k]}, obstacles.h[k], false); };
    Index farthest = b0;
    double most = -HUGE_VAL;
    for (Index k = b0; k < b1; ++k)
        if (const double ahead = obstacles.ahead(k, in_robot); ahead > most) most = ahead, farthest = k;
    if (is_wide_at_obstacle(farthest)) return false;
    for (Index k = b0; k < b1; ++k)
        if (k != farthest && obstacles.ahead(k, in_robot) > gap.width && is_wide_at_obstacle(k)) return false;
    for (Index k = a0; k < a1; ++k) {
        if (robot.ahead(k, in_obstacle) <= gap.width) continue;
        const Vec<double> n = placed.turned({robot.nx[k], robot.ny[k]});
        if (is_wide(k, n, n.x * placed.x[k] + n.y * placed.y[k], true)) return false;
    }
    return true;
}

bool Nearness::are_near(const Placed& placed, Index i, Index j, double within, Witness& found) const {
    Gap gap;
    if (!is_gap_narrower(placed, i, j, within, gap)) return false;
    found = {gap.width, gap.normal, {gap.vertex.x - placed.px, gap.vertex.y - placed.py}};
    if (gap.width <= least_distance) return true;  // they touch or overlap
    const Index begin = gap.of_robot ? robot.first[i] : obstacles.first[j], end = gap.of_robot ? robot.first[i + 1] : obstacles.first[j + 1];
    const Index after = gap.edge + 1 < end ? gap.edge + 1 : begin;
    const auto& xs = gap.of_robot ? placed.x : obstacles.x;
    const auto& ys = gap.of_robot ? placed.y : obstacles.y;
    const double ex = xs[after] - xs[gap.edge], ey = ys[after] - ys[gap.edge];
    const double t = (gap.vertex.x - xs[gap.edge]) * ex + (gap.vertex.y - ys[gap.edge]) * ey;
    if (0 <= t && t <= ex * ex + ey * ey) return true;  // the vertex is ahead of the edge itself
    return are_features_near(placed, i, j, within, gap, found);
}

// Closest vertex and edge of two pieces, which are apart.
bool Nearness::are_features_near(const Placed& placed, Index i, Index j, double within, const Gap& gap, Witness& found) const {
    const Index a0 = robot.first[i], a1 = robot.first[i + 1], b0 = obstacles.first[j], b1 = obstacles.first[j + 1];
    double best = within * within;
    bool near = false;
    // A vertex is at least as far from the other piece as from the line of the gap, and by the gap farther on the line's own side.
    const double line = gap.of_robot ? gap.normal.x * placed.x[gap.edge] + gap.normal.y * placed.y[gap.edge]
                                     : gap.normal.x * obstacles.x[gap.edge] + gap.normal.y * obstacles.y[gap.edge];
    const auto may_be_nearest = [&](double x, double y, bool of_robot) {
        const double beyond = gap.normal.x * x + gap.normal.y * y - line;
        const double least = (of_robot ? beyond : -beyond) + (of_robot == gap.of_robot ? gap.width : 0);
        return least <= 0 || least * least < best;
    };
    const auto may_be_near = [&](double ahead) { return ahead > -least_distance && (ahead <= 0 || ahead * ahead < best); };  // of an edge
    const auto compare = [&](double x, double y, double px, double py, double qx, double qy, bool of_robot) {
        const double ux = qx - px, uy = qy - py, vx = x - px, vy = y - py;
        const double share = std::clamp((vx * ux + vy * uy) / std::max(ux * ux + uy * uy, 1e-300), 0.0, 1.0);
        const double cx = vx - share * ux, cy = vy - share * uy, square = cx * cx + cy * cy;
        if (square >= best) return;
        best = square, near = true;
        if (!of_robot) x = px + share * ux, y = py + share * uy;
        found.normal = of_robot ? Vec<double>{cx, cy} : Vec<double>{-cx, -cy};
        found.arm = {x - placed.px, y - placed.py};
    };
    for (Index v = a0; v < a1; ++v) {
        if (!may_be_nearest(placed.x[v], placed.y[v], true)) continue;
        for (Index k = b0; k < b1; ++k) {
            if (!may_be_near(obstacles.ahead(k, {placed.x[v], placed.y[v]}))) continue;
            const Index next = k + 1 < b1 ? k + 1 : b0;
            compare(placed.x[v], placed.y[v], obstacles.x[k], obstacles.y[k], obstacles.x[next], obstacles.y[next], true);
        }
    }
    for (Index v = b0; v < b1; ++v) {
        if (!may_be_nearest(obstacles.x[v], obstacles.y[v], false)) continue;
        const Vec<double> p = placed.seen({obstacles.x[v], obstacles.y[v]});
        for (Index k = a0; k < a1; ++k) {
            if (!may_be_near(robot.ahead(k, p))) continue;
            const Index next = k + 1 < a1 ? k + 1 : a0;
            compare(obstacles.x[v], obstacles.y[v], placed.x[k], placed.y[k], placed.x[next], placed.y[next], false);
        }
    }
    if (!near) return false;
    found.distance = std::sqrt(best);
    const double scale = 1 / std::max(found.distance, 1e-300);
    found.normal.x *= scale, found.normal.y *= scale;
    return true;
}

// Obstacles that may be nearer than `within`.
std::vector<Index> Nearness::candidates(const Placed& placed, double within) const {
    Box box;
    for (std::size_t k = 0; k < placed.x.size(); ++k) box.add(placed.x[k], placed.y[k]);
    std::vector<Index> found;
    tree->query({box.x0 - within, box.y0 - within, box.x1 + within, box.y1 + within}, [&](Index j) {
        Gap gap;
        if (robot_parts == robot.count() || is_gap_narrower(placed, robot_parts, j, within, gap)) found.push_back(j);
    });
    return found;
}

std::vector<Witness> Nearness::around(const Place& at, double within) const {
    const Placed placed(robot, at);
    std::vector<Witness> found;
    Witness w;
    const auto others = candidates(placed, within);
    for (Index i = 0; i < robot_parts; ++i)
        for (const Index j : others)
            if (are_near(placed, i, j, within, w)) found.push_back(w);
    return found;
}

double Nearness::distance(const Place& at, double within) const { return distance(Placed(robot, at), within); }

double Nearness::distance(const Placed& placed, double within) const {
    double best = within;
    Witness w;
    for (const Index j : candidates(placed, within))
        for (Index i = 0; i < robot_parts; ++i)
            if (are_near(placed, i, j, best, w)) best = w.distance;
    return best;
}

bool Nearness::is_nearer(const Place& at, double than) const { return is_nearer(Placed(robot, at), than); }

bool Nearness::is_nearer(const Placed& placed, double than) const {
    Witness w;
    for (const Index j : candidates(placed, than))
        for (Index i = 0; i < robot_parts; ++i)
            if (are_near(placed, i, j, than, w) && w.distance < than) return true;
    return false;
}

// Sample the middle, the middles of both halves, and so on.
bool Nearness::overlaps(const Configuration& a, const Configuration& b) const {
    const double most = travel_between(a, b) + reach * std::abs(turn_between(a, b));
    int count = 1;
    while (count < most_counted && most > looks_apart * reach * count) count *= 2;
    for (int by = count; by > 0; by /= 2)
        for (int k = by; k < 2 * count; k += 2 * by)
            if (is_nearer(along(a, b, 0.5 * k / count), -least_distance)) return true;
    return false;
}

// How far a direction at the middle pose, fixed in the world or in the robot, separates two pieces from one pose to another.
double Nearness::separates(const Vec<double>& n, const Placed& p, const Placed& m, const Placed& q, Index i, Index j) const {
    const Vec<double> r = m.turned_back(n);
    double robots = HUGE_VAL, others = -HUGE_VAL, robots_own = HUGE_VAL, others_own = -HUGE_VAL;
    for (Index v = robot.first[i]; v < robot.first[i + 1]; ++v) {
        const double bulge = norm(m.x[v] - 0.5 * (p.x[v] + q.x[v]), m.y[v] - 0.5 * (p.y[v] + q.y[v]));
        robots = std::min(robots, std::min(n.x * p.x[v] + n.y * p.y[v], n.x * q.x[v] + n.y * q.y[v]) - bulge);
        robots_own = std::min(robots_own, r.x * robot.x[v] + r.y * robot.y[v]);
    }
    for (Index v = obstacles.first[j]; v < obstacles.first[j + 1]; ++v) {
        const double x = obstacles.x[v], y = obstacles.y[v];
        others = std::max(others, n.x * x + n.y * y);
        const auto s = p.seen({x, y}), t = q.seen({x, y}), u = m.seen({x, y});
        const double bulge = norm(u.x - 0.5 * (s.x + t.x), u.y - 0.5 * (s.y + t.y));
        others_own = std::max(others_own, std::max(r.x * s.x + r.y * s.y, r.x * t.x + r.y * t.y) + bulge);
    }
    return std::max(robots - others, robots_own - others_own);
}

// Halve the motion, the middle parts first. A part keeps its distance if that of the middle covers the robot's travel from
// there. It also does if the direction between the closest points, fixed in the world or in the robot, separates them all
// the way.
bool Nearness::keeps(const Configuration& a, const Configuration& b, const std::function<double(double)>& need) const {
    struct Part {
        double lo, hi;
        int depth;
        double need_lo, need_hi;  // unknown: negative
    };
    std::vector<Part> parts{{0, 1, 0, -1, -1}};
    const double most = travel_between(a, b) + reach * std::abs(turn_between(a, b));
    const auto at = [&](double share) { return Placed(robot, along(a, b, share)); };
    for (std::size_t next = 0; next < parts.size(); ++next) {
        Part part = parts[next];
        const double mid = 0.5 * (part.lo + part.hi), in_middle = need(mid), travel = 0.5 * (part.hi - part.lo) * most;
        const Placed m = at(mid);
        const auto divided = [&] {
            if (part.depth == deepest || parts.size() > most_parts) return false;
            parts.push_back({part.lo, mid, part.depth + 1, part.need_lo, in_middle});
            parts.push_back({mid, part.hi, part.depth + 1, in_middle, part.need_hi});
            return true;
        };
        if (travel > 4 * in_middle + 2 * reach) {  // far too long: test only the middle
            if ((in_middle > least_distance && is_nearer(m, in_middle)) || !divided()) return false;
            continue;
        }
        if (part.need_lo < 0) part.need_lo = need(part.lo);
        if (part.need_hi < 0) part.need_hi = need(part.hi);
        const double asked = std::max({part.need_lo, in_middle, part.need_hi});
        if (asked <= least_distance) continue;
        std::optional<std::pair<Placed, Placed>> ends;
        const auto moves = [&](Index begin, Index end) {
            if (!ends) ends.emplace(at(part.lo), at(part.hi));
            const auto& [p, q] = *ends;
            double most_square = 0;
            for (Index v = begin; v < end; ++v) {
                const double px = p.x[v] - m.x[v], py = p.y[v] - m.y[v], qx = q.x[v] - m.x[v], qy = q.y[v] - m.y[v];
                most_square = std::max({most_square, px * px + py * py, qx * qx + qy * qy});
            }
            return std::sqrt(most_square);
        };
        bool holds = true;
        const auto others = candidates(m, asked + travel);
        for (Index i = 0; i < (others.empty() ? 0 : robot_parts); ++i) {
            double within = asked + travel;
            bool is_exact = false;
            for (const Index j : others) {
                Witness w;
                if (!are_near(m, i, j, within, w)) continue;
                if (w.distance < asked) return false;
                if (!holds) continue;
                if (!is_exact) within = asked + moves(robot.first[i], robot.first[i + 1]), is_exact = true;
                if (w.distance < within) holds = separates(w.normal, ends->first, m, ends->second, i, j) >= nearly * asked;
            }
        }
        if (!holds && !divided()) return false;
    }
    return true;
}

}  // namespace cfree
