// Distances of convex pieces by separating axes and closest features; theory, "Paths".
#include "cfree/search/nearness.hpp"

#include <algorithm>
#include <cmath>

#include "cfree/support/elementary.hpp"
#include "collision/box_tree.hpp"

namespace cfree {

namespace {

constexpr int deepest = 16, most_parts = 4096;  // limits for a motion: one that needs more does not keep its distance
constexpr double nearly = 0.95;
constexpr double looks_apart = 0.125;  // distance of sampled poses, in the robot's radii
constexpr int most_counted = 32;
constexpr double rounding = 0x1p-40;  // per size of the scene

}  // namespace

Nearness::Pieces Nearness::pieces_of(const Shape& s) {
    Pieces p;
    p.first.push_back(0);
    for (Index k = 0; k < s.pieces(); ++k) {
        const Index begin = s.piece[k], end = s.piece[k + 1];
        if (end - begin < 3 || s.piece_layer[k] != 0) continue;
        for (Index m = begin; m < end; ++m) {
            const Index v = s.piece_vertex[m], w = s.piece_vertex[m + 1 < end ? m + 1 : begin];
            const double ex = s.x[w] - s.x[v], ey = s.y[w] - s.y[v], length = std::max(norm(ex, ey), 1e-300);
            p.x.push_back(s.x[v]), p.y.push_back(s.y[v]);
            p.nx.push_back(ey / length), p.ny.push_back(-ex / length);
            p.h.push_back(p.nx.back() * s.x[v] + p.ny.back() * s.y[v]);
        }
        const auto begin_at = static_cast<std::size_t>(p.first.back());
        Box box;
        for (std::size_t m = begin_at; m < p.x.size(); ++m) box.add(p.x[m], p.y[m]);
        p.disc.push_back({0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1), 0, {}});
        for (std::size_t m = begin_at; m < p.x.size(); ++m)
            p.disc.back().radius = std::max(p.disc.back().radius, norm(p.x[m] - p.disc.back().x, p.y[m] - p.disc.back().y));
        const double share = 1 / static_cast<double>(p.x.size() - begin_at);
        for (std::size_t m = begin_at; m < p.x.size(); ++m) p.disc.back().inner.x += share * p.x[m], p.disc.back().inner.y += share * p.y[m];
        p.first.push_back(static_cast<Index>(p.x.size()));
    }
    return p;
}

Nearness::Nearness(const Scene& scene, double slack) : robot(pieces_of(scene.robot)), obstacles(pieces_of(scene.obstacles)) {
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
}
Nearness::~Nearness() = default;

// The robot at a place.
struct Nearness::Placed {
    double px, py, c, s;
    std::vector<double> x, y;
    Placed(const Pieces& p, const Place& at)
        : px(at.x), py(at.y), c(cosine(at.theta)), s(sine(at.theta)), x(p.x.size()), y(p.x.size()) {
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

template <class F>
void Nearness::query(const Placed& placed, Index i, double within, F&& report) const {
    Box box;
    for (Index k = robot.first[i]; k < robot.first[i + 1]; ++k) box.add(placed.x[k], placed.y[k]);
    tree->query({box.x0 - within, box.y0 - within, box.x1 + within, box.y1 + within}, report);
}

// Distance of a point in the piece's own frame ahead of an edge's line.
double Nearness::Pieces::ahead(Index edge, const Vec<double>& p) const { return nx[edge] * p.x + ny[edge] * p.y - h[edge]; }

// The widest gap that the line of an edge parts two pieces by, and the vertex ahead of it.
struct Nearness::Gap {
    double width = -HUGE_VAL;
    Vec<double> normal{}, vertex{};  // normal: from the obstacle to the robot
    Index edge = 0;
    bool of_robot = false;
};

// False if it is at least `within`. No line parts pieces farther than it is from a point inside the other one: most lines need
// no more than that.
bool Nearness::is_gap_narrower(const Placed& placed, Index i, Index j, double within, Gap& gap) const {
    const Index a0 = robot.first[i], a1 = robot.first[i + 1], b0 = obstacles.first[j], b1 = obstacles.first[j + 1];
    const Vec<double> in_robot = placed.at(robot.disc[i].inner), in_obstacle = placed.seen(obstacles.disc[j].inner);
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
    const auto &a = robot.disc[i], &b = obstacles.disc[j];
    const Vec<double> centre = placed.at({a.x, a.y});
    const double dx = centre.x - b.x, dy = centre.y - b.y, between = within + a.radius + b.radius;
    if (dx * dx + dy * dy >= between * between) return false;
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

std::vector<Witness> Nearness::around(const Place& at, double within) const {
    const Placed placed(robot, at);
    std::vector<Witness> found;
    Witness w;
    for (Index i = 0; i < robot.count(); ++i)
        query(placed, i, within, [&](Index j) {
            if (are_near(placed, i, j, within, w)) found.push_back(w);
        });
    return found;
}

double Nearness::distance(const Place& at, double within) const { return distance(Placed(robot, at), within); }

double Nearness::distance(const Placed& placed, double within) const {
    double best = within;
    Witness w;
    for (Index i = 0; i < robot.count(); ++i)
        query(placed, i, best, [&](Index j) {
            if (are_near(placed, i, j, best, w)) best = w.distance;
        });
    return best;
}

// Sample the middle, the middles of both halves, and so on.
bool Nearness::overlaps(const Configuration& a, const Configuration& b) const {
    const double most = travel_between(a, b) + reach * std::abs(turn_between(a, b));
    int count = 1;
    while (count < most_counted && most > looks_apart * reach * count) count *= 2;
    for (int by = count; by > 0; by /= 2)
        for (int k = by; k < 2 * count; k += 2 * by)
            if (distance(along(a, b, 0.5 * k / count), 0) < -least_distance) return true;
    return false;
}

// Halve the motion, the middle parts first. A part keeps its distance if that of the middle covers the robot's travel from
// there. It also does if the direction between the closest points, fixed in the world or in the robot, separates them all
// the way.
bool Nearness::keeps(const Configuration& a, const Configuration& b, const std::function<double(double)>& need) const {
    struct Part {
        double lo, hi;
        int depth;
    };
    std::vector<Part> parts{{0, 1, 0}};
    const double most = travel_between(a, b) + reach * std::abs(turn_between(a, b));
    const auto at = [&](double share) { return Placed(robot, along(a, b, share)); };
    for (std::size_t next = 0; next < parts.size(); ++next) {
        const auto [lo, hi, depth] = parts[next];
        const double mid = 0.5 * (lo + hi), in_middle = need(mid);
        const Placed m = at(mid);
        if (0.5 * (hi - lo) * most > 4 * in_middle + 2 * reach) {  // far too long: test only the middle
            if (in_middle > least_distance && distance(m, in_middle) < in_middle) return false;
            if (depth == deepest || parts.size() > most_parts) return false;
            parts.push_back({lo, mid, depth + 1});
            parts.push_back({mid, hi, depth + 1});
            continue;
        }
        const double asked = std::max({need(lo), in_middle, need(hi)});
        if (asked <= least_distance) continue;
        const Placed p = at(lo), q = at(hi);
        bool fails = false, holds = true;
        for (Index i = 0; i < robot.count() && !fails; ++i) {
            const Index begin = robot.first[i], end = robot.first[i + 1];
            double moves = 0;
            for (Index v = begin; v < end; ++v) {
                const double px = p.x[v] - m.x[v], py = p.y[v] - m.y[v], qx = q.x[v] - m.x[v], qy = q.y[v] - m.y[v];
                moves = std::max({moves, px * px + py * py, qx * qx + qy * qy});
            }
            const double within = asked + std::sqrt(moves);
            query(m, i, within, [&](Index j) {
                Witness w;
                if (fails || !are_near(m, i, j, within, w)) return;
                if (w.distance < asked) {
                    fails = true;
                    return;
                }
                if (!holds) return;
                const Vec<double> n = w.normal, r = m.turned_back(n);
                double robots = HUGE_VAL, others = -HUGE_VAL, robots_own = HUGE_VAL, others_own = -HUGE_VAL;
                for (Index v = begin; v < end; ++v) {
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
                if (std::max(robots - others, robots_own - others_own) < nearly * asked) holds = false;
            });
        }
        if (fails) return false;
        if (holds) continue;
        if (depth == deepest || parts.size() > most_parts) return false;
        parts.push_back({lo, mid, depth + 1});
        parts.push_back({mid, hi, depth + 1});
    }
    return true;
}

}  // namespace cfree
