// Convex pieces of a scene, and separating axes between two: in doubles with a bound, and in integers.
#include <cmath>
#include <limits>
#include <numbers>

#include "cfree/support/elementary.hpp"
#include "collision/placed_robot.hpp"

namespace cfree {

// Error of a distance n . p - h. u = 2^-53; M bounds all compared coordinates, after placing the robot: those of the
// obstacles plus twice the robot's. To first order in u:
//   placed vertex   x + (c a_x - s a_y): 32 u (|a_x| + |a_y|) from c and s, 3 u of that from rounding, 2 u M from x and the
//                   sum; below 72 u M in each coordinate, 102 u M along n
//   edge's normal   3 u in each component (an exact difference, rounded; its length; the quotient), 72 u more when it is
//                   turned; times |p - v| <= 2 M in each coordinate: 300 u M
//   n . p, h and their difference: 10 u M
//   vertex seen from the robot, instead of the first and the turned normal: 142 u M in each coordinate, 201 u M along n;
//                   edge's normal 3 u times at most 4 M, 24 u M; n . p and h 29 u M
// In all below 412 u M; 512 u M is allowed. A range of poses adds its width: a point of the robot moves by at most
// shift + turn |a|, a point b of an obstacle, seen from the robot, by shift + turn |b - r|.
namespace {
constexpr double margin_by_size = 0x1p-44, least_margin = 0x1p-1000, least_square = 0x1p-1022;
constexpr Index few = 4;  // vertices of a piece: testing all is faster than choosing

Vec<double> unit_normal(const Vec<Int>& e) {
    const auto bits = static_cast<int>(std::max(e.x.is_zero() ? 0 : msb(abs(e.x)), e.y.is_zero() ? 0 : msb(abs(e.y))));
    const double dx = ball(e.x, bits).hi, dy = ball(e.y, bits).hi, length = std::sqrt(dx * dx + dy * dy);
    return {dy / length, -dx / length};
}

// Sixteenths of the circle, nearly: by signs and two comparisons, as the tangent of pi / 8 is about 5 / 12.
std::size_t direction_of(const Vec<double>& d) {
    const double x = std::abs(d.x), y = std::abs(d.y), less = std::min(x, y), more = std::max(x, y);
    return std::size_t(d.x < 0) + 2 * std::size_t(d.y < 0) + 4 * std::size_t(y > x) + 8 * std::size_t(12 * less > 5 * more);
}
Vec<double> middle_of_direction(std::size_t k) {
    const double less = tangent((k & 8 ? 3 : 1) * std::numbers::pi / 16);
    const Vec<double> d = k & 4 ? Vec<double>{less, 1} : Vec<double>{1, less};
    return {k & 1 ? -d.x : d.x, k & 2 ? -d.y : d.y};
}
}  // namespace

PoseChecker::Pieces PoseChecker::pieces_of(const Shape& shape) {
    const auto& xy = shape.xy;
    Pieces p;
    p.first.push_back(0);
    for (Index k = 0; k < shape.pieces(); ++k) {
        const Index begin = shape.piece[k], end = shape.piece[k + 1];
        if (end - begin < 3 || shape.piece_layer[k] != 0) continue;
        p.number.push_back(k);
        for (Index m = begin; m < end; ++m) {
            const Index v = shape.piece_vertex[m], w = shape.piece_vertex[m + 1 < end ? m + 1 : begin];
            const auto n = unit_normal(difference<Int>(shape, w, v));
            p.x.push_back(xy[2 * v]), p.y.push_back(xy[2 * v + 1]);
            p.nx.push_back(n.x), p.ny.push_back(n.y), p.h.push_back(n.x * xy[2 * v] + n.y * xy[2 * v + 1]);
        }
        if ((end - begin) % 2)
            for (auto* values : {&p.x, &p.y, &p.nx, &p.ny, &p.h}) values->push_back(values->back());
        p.first.push_back(static_cast<Index>(p.x.size()));
        auto& far = p.far.emplace_back();
        for (std::size_t d = 0; d < far.size(); ++d) {
            const Vec<double> to = middle_of_direction(d);
            far[d] = p.first[p.first.size() - 2];
            for (Index m = far[d]; m < p.first.back(); ++m)
                if (to.x * p.x[m] + to.y * p.y[m] > to.x * p.x[far[d]] + to.y * p.y[far[d]]) far[d] = m;
        }
    }
    return p;
}

PoseChecker::PoseChecker(std::shared_ptr<const Scene> s, std::array<double, 4> bounds)
    : scene(std::move(s)), limits(bounds), robot(pieces_of(scene->robot)), obstacles(pieces_of(scene->obstacles)) {
    double largest = 0;
    for (std::size_t k = 0; k < robot.x.size(); ++k) reach = std::max(reach, norm(robot.x[k], robot.y[k]));
    for (std::size_t k = 0; k < obstacles.x.size(); ++k)
        largest = std::max({largest, std::abs(obstacles.x[k]), std::abs(obstacles.y[k])});
    margin = margin_by_size * (largest + 4 * reach) + least_margin;
    reach += margin;
    for (Index j = 0; j < obstacles.count(); ++j) {
        const auto [x0, x1] = std::minmax_element(&obstacles.x[obstacles.first[j]], &obstacles.x[0] + obstacles.first[j + 1]);
        const auto [y0, y1] = std::minmax_element(&obstacles.y[obstacles.first[j]], &obstacles.y[0] + obstacles.first[j + 1]);
        box.push_back({*x0 - margin, *y0 - margin, *x1 + margin, *y1 + margin});
    }
}

// Compare edges begin <= k < end, an even number, of a convex polygon with the vertices of another. Free: all of it is on the
// outer side of one line, by the slack. Forbidden: each line has some of it on its inner side, most likely vertex `far`.
static Verdict beside(const double* nx, const double* ny, const double* h, Index count, double slack, const double* x, const double* y,
                      Index vertices, Index far, bool& is_inside) {
    is_inside = true;
    Verdict all = Verdict::forbidden;
    for (Index k = 0; k < count; k += 2) {
        const Two ax = two(nx + k), ay = two(ny + k), outer = two(h + k) + slack, inner = two(h + k) - slack;
        const TwoMasks is_in = ax * x[far] + ay * y[far] <= inner;
        if (vertices > few && (is_in[0] & is_in[1])) continue;
        is_inside = false;
        TwoMasks some_not_out{}, some_in{};
        for (Index v = 0; v < vertices; ++v) {
            const Two d = ax * x[v] + ay * y[v];
            some_not_out |= d < outer, some_in |= d <= inner;
        }
        if (!(some_not_out[0] & some_not_out[1])) return Verdict::free;
        if (!(some_in[0] & some_in[1])) all = Verdict::uncertain;
    }
    return all;
}

// Verdict on two pieces. The first vertex tried of each reaches far towards the other; if it is inside, the interiors meet.
Verdict PoseChecker::meet(Placed& placed, Index i, Index j, const Range& range) const {
    const Index a = robot.first[i], b = obstacles.first[j], n = robot.first[i + 1] - a, m = obstacles.first[j + 1] - b;
    const Vec<double> towards{0.5 * (box[j].x0 + box[j].x1) - placed.at.x, 0.5 * (box[j].y0 + box[j].y1) - placed.at.y};
    double slack = margin + range.shift + range.turn * reach;
    placed.put(i);
    bool is_inside;
    const Index p = n > few ? robot.far[i][direction_of(placed.seen_from(towards))] - a : 0;
    const Verdict v = beside(&obstacles.nx[b], &obstacles.ny[b], &obstacles.h[b], m, slack, &placed.x[a], &placed.y[a], n, p, is_inside);
    if (v == Verdict::free || is_inside) return v;
    if (range.turn > 0) {  // in the robot's frame, the farthest vertex moves most
        const double dx = std::max(box[j].x1 - placed.at.x, placed.at.x - box[j].x0);
        const double dy = std::max(box[j].y1 - placed.at.y, placed.at.y - box[j].y0);
        slack = margin + range.shift + range.turn * (std::abs(dx) + std::abs(dy));
    }
    const Index q = m > few ? obstacles.far[j][direction_of({-towards.x, -towards.y})] - b : 0;
    const Verdict w = beside(&placed.nx[a], &placed.ny[a], &placed.h[a], n, slack, &obstacles.x[b], &obstacles.y[b], m, q, is_inside);
    return w == Verdict::free || is_inside ? w : std::max(v, w);
}

// Distance of a point from a piece, within the margin; 0 inside. The margin decides which edges count, because of thin
// pieces: ahead of their tips, the distances of lines are small, and may have any sign.
double PoseChecker::distance(const Pieces& p, Index piece, double x, double y) const {
    const Index begin = p.first[piece], end = p.first[piece + 1];
    double least = std::numeric_limits<double>::infinity();
    bool inside = true;
    for (Index k = begin; k < end; ++k) {
        const Index next = k + 1 < end ? k + 1 : begin;
        const double d = p.nx[k] * x + p.ny[k] * y - p.h[k];
        if (d <= -margin) continue;
        inside = false;
        const double ex = p.x[next] - p.x[k], ey = p.y[next] - p.y[k], dx = x - p.x[k], dy = y - p.y[k];
        const double t = std::clamp((dx * ex + dy * ey) / std::max(ex * ex + ey * ey, least_square), 0.0, 1.0);
        least = std::min(least, norm(dx - t * ex, dy - t * ey));
    }
    return inside ? 0 : least;
}

// Everything times scale * w * unit.
bool PoseChecker::overlap(const ExactPlacement& at, Index i, Index j) const {
    using Ring = std::vector<Vec<Int>>;
    const auto ring = [](const Shape& shape, Index piece, auto&& place) {
        Ring r;
        for (Index m = shape.piece[piece]; m < shape.piece[piece + 1]; ++m)
            r.push_back(place(shape.X[shape.piece_vertex[m]], shape.Y[shape.piece_vertex[m]]));
        return r;
    };
    const Int dx = at.x * scene->scale * at.w, dy = at.y * scene->scale * at.w, unit = at.w * at.unit;
    const Ring a = ring(scene->robot, robot.number[i], [&](const Int& x, const Int& y) {
        return Vec<Int>{(at.c * x - at.s * y) * at.unit + dx, (at.s * x + at.c * y) * at.unit + dy};
    });
    const Ring b = ring(scene->obstacles, obstacles.number[j], [&](const Int& x, const Int& y) {
        return Vec<Int>{x * unit, y * unit};
    });
    const auto separates = [](const Ring& own, const Ring& other) {
        for (std::size_t k = 0; k < own.size(); ++k) {
            const Vec<Int>&v = own[k], &w = own[k + 1 < own.size() ? k + 1 : 0], e{w.x - v.x, w.y - v.y};
            if (std::all_of(other.begin(), other.end(),
                            [&](const Vec<Int>& p) { return cross(e, Vec<Int>{p.x - v.x, p.y - v.y}) <= 0; }))
                return true;
        }
        return false;
    };
    return !separates(a, b) && !separates(b, a);
}

}  // namespace cfree
