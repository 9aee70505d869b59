// The robot's convex pieces in a pose, in doubles, and their test against pieces of obstacles.
#pragma once
#include <algorithm>

#include "cfree/collision/pose_checker.hpp"

namespace cfree {

// Two doubles at once.
using Two = double __attribute__((vector_size(16), aligned(8), may_alias));
using TwoMasks = long long __attribute__((vector_size(16)));
inline const Two& two(const double* x) { return *reinterpret_cast<const Two*>(x); }
inline Two& two(double* x) { return *reinterpret_cast<Two*>(x); }

// Robot in a pose, in doubles; its memory is reused for the next pose. Vertices of a piece are placed when needed.
struct PoseChecker::Placed {
    const Pieces& at_rest;
    Placement at{};
    std::vector<double> x, y, nx, ny, h;
    std::vector<Ranges> box;  // around the pieces
    std::vector<char> is_placed;
    explicit Placed(const Pieces& p)
        : at_rest(p), x(p.x.size()), y(x), nx(x), ny(x), h(x), box(p.number.size()), is_placed(p.number.size()) {}
    // Place the robot, given its boxes for the pose at the origin.
    void place(const Placement& pose, const Ranges* around) {
        at = pose;
        for (std::size_t i = 0; i < box.size(); ++i) {
            box[i] = {at.x + around[i].x0, at.y + around[i].y0, at.x + around[i].x1, at.y + around[i].y1};
            is_placed[i] = false;
        }
    }
    void place(const Placement& pose) {
        at = pose;
        for (Index i = 0; i < at_rest.count(); ++i) {
            is_placed[i] = false;
            put(i);
            const auto begin = at_rest.first[i], end = at_rest.first[i + 1];
            const auto [x0, x1] = std::minmax_element(x.begin() + begin, x.begin() + end);
            const auto [y0, y1] = std::minmax_element(y.begin() + begin, y.begin() + end);
            box[i] = {*x0, *y0, *x1, *y1};
        }
    }
    void put(Index i) {
        if (is_placed[i]) return;
        is_placed[i] = true;
        for (Index k = at_rest.first[i]; k < at_rest.first[i + 1]; k += 2) {
            const Two ax = two(&at_rest.x[k]), ay = two(&at_rest.y[k]), bx = two(&at_rest.nx[k]), by = two(&at_rest.ny[k]);
            const Two px = at.x + (at.c * ax - at.s * ay), py = at.y + (at.s * ax + at.c * ay);
            const Two qx = at.c * bx - at.s * by, qy = at.s * bx + at.c * by;
            two(&x[k]) = px, two(&y[k]) = py, two(&nx[k]) = qx, two(&ny[k]) = qy, two(&h[k]) = qx * px + qy * py;
        }
    }
    Vec<double> seen_from(const Vec<double>& d) const { return {at.c * d.x + at.s * d.y, at.c * d.y - at.s * d.x}; }
};

// Test all pieces of the robot against some of the obstacles', until a pair is forbidden; `decide` settles uncertain pairs.
template <class F>
Verdict PoseChecker::against(Placed& placed, const Index* list, std::size_t count, const Range& range, F&& decide) const {
    Verdict all = Verdict::free;
    const double slack = range.shift + range.turn * reach;
    for (Index i = 0; i < robot.count(); ++i) {
        Ranges r = placed.box[i];
        r.x0 -= slack, r.y0 -= slack, r.x1 += slack, r.y1 += slack;
        for (std::size_t m = 0; m < count; ++m) {
            const Index j = list[m];
            const Ranges& o = box[j];
            if ((r.x0 > o.x1) | (o.x0 > r.x1) | (r.y0 > o.y1) | (o.y0 > r.y1)) continue;
            Verdict v = meet(placed, i, j, range);
            if (v == Verdict::uncertain) v = decide(i, j);
            if (v == Verdict::forbidden) return v;
            if (v == Verdict::uncertain) all = v;
        }
    }
    return all;
}

}  // namespace cfree
