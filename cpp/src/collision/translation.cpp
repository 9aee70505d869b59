// Free share of a translation: two convex pieces overlap along it on an open interval, whose ends are quotients; theory,
// "Motions".
//
// All points of the robot move alike. So the vertex of a piece farthest inside an edge of the other stays the farthest, and
// m + s u > 0 while some vertex is inside: two pieces overlap while this holds for all edges of both.
#include <algorithm>
#include <cmath>
#include <limits>

#include "cfree/collision/motion_checker.hpp"
#include "cfree/contact/contact_line.hpp"
#include "collision/box_tree.hpp"
#include "collision/rounding.hpp"

namespace cfree {

namespace {

// Placed robot: its points times W, and the vector by which all of them move in the end.
template <class T>
struct Moved {
    Rotation<T> R;
    Vec<T> at, by;
    T unit, W;
    Vec<T> turned(const Vec<T>& a) const { return {unit * (R.c * a.x - R.s * a.y), unit * (R.s * a.x + R.c * a.y)}; }
    Vec<T> operator()(const Vec<T>& a) const {
        const Vec<T> p = turned(a);
        return {p.x + at.x, p.y + at.y};
    }
};

Approx rounded(const Int& n, const Int& d) {
    const double v = ratio(n, d);
    return {v, std::abs(v)};
}

Moved<Approx> approximately(const Motion& m, int shift) {
    const Int unit = m.unit << static_cast<unsigned>(shift);
    return {{rounded(m.c, m.w), rounded(m.s, m.w), {1, 1}},
            {rounded(m.x, unit), rounded(m.y, unit)},
            {rounded(m.vx, unit), rounded(m.vy, unit)},
            {1, 1},
            {1, 1}};
}
Moved<Int> exactly(const Motion& m) {
    return {{m.c, m.s, m.w}, {m.w * m.x, m.w * m.y}, {m.w * m.vx, m.w * m.vy}, m.unit, m.w * m.unit};
}

// Bounds of a number.
struct Range {
    double low, high;
};
Range range(const Approx& x) {
    const double error = error_of(x);
    return {x.v - error, x.v + error};
}
// Bounds of a / b, b positive.
Range quotient(const Range& a, const Range& b) {
    const double low = a.low / (a.low < 0 ? b.low : b.high), high = a.high / (a.high < 0 ? b.high : b.low);
    return {low - std::abs(low) * 0x1p-50, high + std::abs(high) * 0x1p-50};
}

// Pieces of the robot and of the obstacles along one translation.
class Course {
public:
    Course(const Scene& of, const Motion& m) : scene(of), near(approximately(m, of.shift)), exact(exactly(m)) {}

    // Select a piece of the robot; return a box around its motion, if doubles can give one.
    std::optional<Box> look_at(Index robot_piece) {
        const Shape& A = scene.robot;
        piece = robot_piece;
        points.clear(), edges.clear();
        Box swept;
        bool known = true;
        for (Index v = A.piece[piece]; v < A.piece[piece + 1]; ++v) {
            const Index vertex = A.piece_vertex[v], edge = A.piece_edge[v];
            points.push_back(near(doubles.vertex(A, vertex)));
            const auto& p = points.back();
            const double dx = error_of(p.x) + error_of(near.by.x), dy = error_of(p.y) + error_of(near.by.y);
            known = known && std::isfinite(p.x.m + p.y.m + near.by.x.m + near.by.y.m);
            for (const double share : {0.0, 1.0}) {
                const double x = p.x.v + share * near.by.x.v, y = p.y.v + share * near.by.y.v;
                swept.add(x - dx, y - dy), swept.add(x + dx, y + dy);
            }
            if (A.has_extent(edge)) edges.push_back({near(doubles.vertex(A, A.v[edge])), near.turned(doubles.edge(A, edge)), edge});
        }
        if (!known) return {};
        return swept;
    }

    // Share of the way before which the pieces do not overlap; nothing if they never do.
    std::optional<double> apart_until(Index obstacle_piece) {
        if (!find_lines(obstacle_piece)) return {};
        double from = 0, to = 1;
        for (const Line& line : lines)
            if (line.is_entry) from = std::max(from, line.at.low);
            else if (line.is_exit) to = std::min(to, line.at.high);
        if (from >= to) return {};
        return from;
    }

    // Share of the way, in [0, 1), from which on the pieces overlap.
    std::optional<Ratio> meeting(Index obstacle_piece) {
        if (!find_lines(obstacle_piece)) return {};
        Range entry{0, 0}, exit{1, 1};
        for (const Line& line : lines)
            if (line.is_entry) entry = {std::max(entry.low, line.at.low), std::max(entry.high, line.at.high)};
            else if (line.is_exit) exit = {std::min(exit.low, line.at.low), std::min(exit.high, line.at.high)};
        Ratio from{0, 1}, to{1, 1};  // not reduced
        const bool is_long = entry.high < exit.low;
        for (const Line& line : lines) {  // lines that may be first or last
            if (line.is_entry ? line.at.high < entry.low : line.is_exit && (is_long || line.at.low > exit.high)) continue;
            const Int m = most(line), s = slope(line);
            if (s.is_zero()) {
                if (m.sign() <= 0) return {};
                continue;
            }
            const Ratio root = s.sign() > 0 ? Ratio{-m, s} : Ratio{m, -s};
            if (s.sign() > 0 ? root > from : root < to) (s.sign() > 0 ? from : to) = root;
            if (from >= to) return {};
        }
        return from;
    }

private:
    // An edge of one piece and the vertices of the other; positive on its inner side, times positive numbers.
    struct Line {
        bool of_robot;
        Index edge;
        bool is_entry, is_exit;  // certain; else m and s are imprecise
        Range at;                // the u with m + s u = 0
    };

    // Collect the edges that may matter; false if one of them keeps the pieces apart all the way.
    bool find_lines(Index obstacle_piece) {
        const Shape& O = scene.obstacles;
        other = obstacle_piece;
        lines.clear();
        corners.clear();
        for (Index v = O.piece[other]; v < O.piece[other + 1]; ++v) corners.push_back(doubles.vertex(O, O.piece_vertex[v]));
        for (Index e = O.piece[other]; e < O.piece[other + 1]; ++e) {
            const Index edge = O.piece_edge[e];
            if (!O.has_extent(edge)) continue;
            if (!add(false, edge, doubles.vertex(O, O.v[edge]), doubles.edge(O, edge), points)) return false;
        }
        for (const auto& [from, along, edge] : edges)
            if (!add(true, edge, from, along, corners)) return false;
        return true;
    }
    bool add(bool of_robot, Index edge, const Vec<Approx>& from, const Vec<Approx>& along, const std::vector<Vec<Approx>>& seen) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Range m{-infinity, -infinity};
        const Approx by = cross(along, near.by);
        const Range s = range(of_robot ? -by : by);
        bool known = std::isfinite(by.m);
        for (const auto& p : seen) {
            const Approx side = cross(along, p - from);
            known = known && std::isfinite(side.m);
            const Range x = range(side);
            m = {std::max(m.low, x.low), std::max(m.high, x.high)};
        }
        if (!known) return lines.push_back({of_robot, edge, false, false, {}}), true;
        if (m.high < 0 && m.high + s.high <= 0) return false;
        if (m.low > 0 && m.low + s.low > 0) return true;  // inside all the way
        if (s.low > 0) lines.push_back({of_robot, edge, true, false, quotient({-m.high, -m.low}, s)});
        else if (s.high < 0) lines.push_back({of_robot, edge, false, true, quotient(m, {-s.high, -s.low})});
        else lines.push_back({of_robot, edge, false, false, {}});
        return true;
    }

    Vec<Int> along(const Line& line) const {
        return line.of_robot ? exact.turned(whole.edge(scene.robot, line.edge)) : whole.edge(scene.obstacles, line.edge);
    }
    Int slope(const Line& line) const {
        const Int by = cross(along(line), exact.by);
        return line.of_robot ? Int(-by) : by;
    }
    // Greatest value m, of the vertex farthest inside.
    Int most(const Line& line) const {
        const Shape &A = scene.robot, &O = scene.obstacles;
        const auto fixed = [&](Index v) {
            const Vec<Int> b = whole.vertex(O, v);
            return Vec<Int>{exact.W * b.x, exact.W * b.y};
        };
        const Vec<Int> d = along(line);
        const Vec<Int> from = line.of_robot ? exact(whole.vertex(A, A.v[line.edge])) : fixed(O.v[line.edge]);
        const Shape& moving = line.of_robot ? O : A;
        const Index k = line.of_robot ? other : piece, first = moving.piece[k];
        // doubles restrict the candidates
        const Vec<Approx> near_from = line.of_robot ? near(doubles.vertex(A, A.v[line.edge])) : doubles.vertex(O, O.v[line.edge]);
        const Vec<Approx> near_d = line.of_robot ? near.turned(doubles.edge(A, line.edge)) : doubles.edge(O, line.edge);
        const auto& seen = line.of_robot ? corners : points;
        double low = -std::numeric_limits<double>::infinity();
        for (const auto& p : seen) low = std::max(low, range(cross(near_d, p - near_from)).low);
        std::optional<Int> found;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            if (range(cross(near_d, seen[i] - near_from)).high < low) continue;
            const Index v = moving.piece_vertex[first + static_cast<Index>(i)];
            Int value = cross(d, (line.of_robot ? fixed(v) : exact(whole.vertex(A, v))) - from);
            if (!found || value > *found) found = std::move(value);
        }
        return *found;
    }

    struct Edge {
        Vec<Approx> from, along;
        Index edge;
    };
    const Scene& scene;
    const Moved<Approx> near;
    const Moved<Int> exact;
    const CoreUnits<Approx> doubles{};
    const CoreUnits<Int> whole{};
    Index piece = 0, other = 0;
    std::vector<Vec<Approx>> points, corners;  // vertices of the robot's piece at the beginning, and of the obstacles'
    std::vector<Edge> edges;                   // edges of the robot's piece
    std::vector<Line> lines;
};

}  // namespace

std::optional<Ratio> MotionChecker::free_share(const Motion& motion) const {
    const Shape &A = scene->robot, &O = scene->obstacles;
    Course course(*scene, motion);
    struct Pair {
        double until;
        Index robot, obstacle;
    };
    std::vector<Pair> pairs;
    for (Index i = 0; i < A.pieces(); ++i) {
        const auto look = [&](Index k) {
            if (O.piece_layer[k] != A.piece_layer[i]) return;
            if (const auto until = course.apart_until(k)) pairs.push_back({*until, i, k});
        };
        if (const auto swept = course.look_at(i)) tree->query(*swept, look);
        else for (Index k = 0; k < O.pieces(); ++k) look(k);
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) { return p.until < q.until; });
    std::optional<Ratio> first;
    double horizon = 1;  // nothing after it matters
    for (const Pair& pair : pairs) {
        if (pair.until > horizon) break;
        course.look_at(pair.robot);
        const auto found = course.meeting(pair.obstacle);
        if (!found || (first && *found >= *first)) continue;
        first = found;
        if (first->n.is_zero()) break;
        horizon = ratio(first->n, first->d) * (1 + 0x1p-50);
    }
    if (first) first = reduced(first->n, first->d);
    return first;
}

}  // namespace cfree
