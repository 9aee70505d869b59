// How far a translation is free: along it two convex pieces overlap on an open interval, whose ends are quotients; theory, "Motions".
//
// All points of the robot move alike. So of all vertices of a piece the one farthest inside an edge of the other stays it, and
// m + s u > 0 where some vertex is inside: two pieces overlap where that is so for all edges of both.
#include <algorithm>
#include <cmath>
#include <limits>

#include "cfree/collision/motion_checker.hpp"
#include "cfree/contact/contact_line.hpp"
#include "collision/box_tree.hpp"

namespace cfree {

namespace {

// At most 20 roundings lead to the side of a vertex, as in motion_checker.cpp.
double error_of(const Approx& f) { return f.m * 0x1p-47 + 0x1p-850; }

// Turned and moved: points of the robot times W, and how far all of them move in the end.
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


// A piece of the robot and one of the obstacles: report(sides, slope) for every edge of both, times positive numbers. Sides are
// positive for vertices on its inner side in the beginning; slope is what each grows by. Ends if the report is false.
template <class T, class F>
bool each_edge(const Scene& scene, Index i, Index k, const Moved<T>& moved, std::vector<T>& sides, F&& report) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const CoreUnits<T> of;
    const auto fixed = [&](Index v) {
        const Vec<T> b = of.vertex(O, v);
        return Vec<T>{moved.W * b.x, moved.W * b.y};
    };
    std::vector<Vec<T>> points;
    for (Index v = A.piece[i]; v < A.piece[i + 1]; ++v) points.push_back(moved(of.vertex(A, A.piece_vertex[v])));
    for (Index e = O.piece[k]; e < O.piece[k + 1]; ++e) {
        const Vec<T> d = of.edge(O, O.piece_edge[e]), from = fixed(O.v[O.piece_edge[e]]);
        sides.clear();
        for (const auto& p : points) sides.push_back(cross(d, p - from));
        if (!report(sides, cross(d, moved.by))) return false;
    }
    points.clear();
    for (Index v = O.piece[k]; v < O.piece[k + 1]; ++v) points.push_back(fixed(O.piece_vertex[v]));
    for (Index e = A.piece[i]; e < A.piece[i + 1]; ++e) {
        if (!A.has_extent(A.piece_edge[e])) continue;
        const Vec<T> d = moved.turned(of.edge(A, A.piece_edge[e])), from = moved(of.vertex(A, A.v[A.piece_edge[e]]));
        sides.clear();
        for (const auto& p : points) sides.push_back(cross(d, p - from));
        if (!report(sides, -cross(d, moved.by))) return false;
    }
    return true;
}

// Before this share of the way they do not overlap; nothing if they never do.
std::optional<double> certainly_apart_until(const Scene& scene, Index i, Index k, const Moved<Approx>& moved,
                                            std::vector<Approx>& sides) {
    double until = 0;
    const bool may_meet = each_edge(scene, i, k, moved, sides, [&](const std::vector<Approx>& m, const Approx& s) {
        double most = -std::numeric_limits<double>::infinity();
        for (const Approx& x : m) {
            if (!std::isfinite(x.m + s.m)) return true;
            most = std::max(most, x.v + error_of(x));
        }
        const double slope = s.v + error_of(s);
        if (most >= 0) return true;
        if (most + slope <= 0) return false;
        until = std::max(until, -most / slope * (1 - 0x1p-50));
        return true;
    });
    if (!may_meet || until >= 1) return {};
    return until;
}

// Where they begin to overlap, from 0 on and before 1.
std::optional<Ratio> meeting(const Scene& scene, Index i, Index k, const Moved<Int>& moved, std::vector<Int>& sides) {
    Ratio from{0, 1}, to{1, 1};  // not reduced
    const bool meet = each_edge(scene, i, k, moved, sides, [&](const std::vector<Int>& all, const Int& s) {
        const Int& m = *std::max_element(all.begin(), all.end());
        if (s.is_zero()) return m.sign() > 0;
        const Ratio root = s.sign() > 0 ? Ratio{-m, s} : Ratio{m, -s};
        if (s.sign() > 0 ? root > from : root < to) (s.sign() > 0 ? from : to) = root;
        return from < to;
    });
    if (!meet) return {};
    return from;
}

}  // namespace

std::optional<Ratio> MotionChecker::free_share(const Motion& motion) const {
    const Shape& A = scene->robot;
    const Moved<Approx> near = approximately(motion, scene->shift);
    struct Pair {
        double until;
        Index robot, obstacle;
    };
    std::vector<Pair> pairs;
    std::vector<Approx> values;
    for (Index i = 0; i < A.pieces(); ++i) {
        Box swept;
        bool known = true;
        for (Index v = A.piece[i]; v < A.piece[i + 1]; ++v) {
            const Vec<Approx> p = near(CoreUnits<Approx>{}.vertex(A, A.piece_vertex[v]));
            const double dx = error_of(p.x) + error_of(near.by.x), dy = error_of(p.y) + error_of(near.by.y);
            known = known && std::isfinite(p.x.m + p.y.m + near.by.x.m + near.by.y.m);
            for (const double share : {0.0, 1.0}) {
                const double x = p.x.v + share * near.by.x.v, y = p.y.v + share * near.by.y.v;
                swept.add(x - dx, y - dy), swept.add(x + dx, y + dy);
            }
        }
        const auto look = [&](Index k) {
            if (scene->obstacles.piece_layer[k] != A.piece_layer[i]) return;
            if (const auto until = certainly_apart_until(*scene, i, k, near, values)) pairs.push_back({*until, i, k});
        };
        if (known) tree->query(swept, look);
        else for (Index k = 0; k < scene->obstacles.pieces(); ++k) look(k);
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) { return p.until < q.until; });
    const Moved<Int> exact = exactly(motion);
    std::optional<Ratio> first;
    double horizon = 1;  // nothing after it matters
    std::vector<Int> sides;
    for (const Pair& pair : pairs) {
        if (pair.until > horizon) break;
        const auto found = meeting(*scene, pair.robot, pair.obstacle, exact, sides);
        if (!found || (first && *found >= *first)) continue;
        first = found;
        if (first->n.is_zero()) break;
        horizon = ratio(first->n, first->d) * (1 + 0x1p-50);
    }
    if (first) first = reduced(first->n, first->d);
    return first;
}

}  // namespace cfree
