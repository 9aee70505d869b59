#include "cfree/forbidden/slice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "cfree/support/stop.hpp"

namespace cfree {

Slicer::Slicer(std::shared_ptr<const Scene> s, std::vector<double> robot_xy, std::vector<double> obstacle_xy, Patches p,
               std::vector<Index> patch_, std::vector<std::uint8_t> chart_, std::vector<std::uint64_t> lower_,
               std::vector<std::uint64_t> upper_, std::vector<double> tau_from_, std::vector<double> tau_to_,
               std::array<double, 4> shift_)
    : scene(std::move(s)), a(std::move(robot_xy)), b(std::move(obstacle_xy)), patches(std::move(p)),
      patch(std::move(patch_)), chart(std::move(chart_)), lower(std::move(lower_)), upper(std::move(upper_)),
      tau_from(std::move(tau_from_)), tau_to(std::move(tau_to_)), index(chart, tau_from, tau_to, 8), shift(shift_) {}

Slicer::Turn Slicer::turn(int c, double tau) {
    const double w = (c ? -1 : 1) / (1 + tau * tau);
    return {(1 - tau * tau) * w, 2 * tau * w};
}

// The contact surface at one orientation: the line p + t u.
Slicer::Line Slicer::line(Index id, Turn r) const {
    const Shape &A = scene->robot, &O = scene->obstacles;
    const bool on_edge = static_cast<Kind>(patches.kind[id]) == Kind::vertex_edge;
    const Index i = on_edge ? patches.robot[id] : A.v[patches.robot[id]];
    const Index j = on_edge ? O.v[patches.obstacle[id]] : patches.obstacle[id];
    Line l{b[2 * j] - (r.c * a[2 * i] - r.s * a[2 * i + 1]), b[2 * j + 1] - (r.s * a[2 * i] + r.c * a[2 * i + 1]), 0, 0};
    if (on_edge) {
        const Index w = O.w[patches.obstacle[id]];
        l.ux = b[2 * w] - b[2 * j], l.uy = b[2 * w + 1] - b[2 * j + 1];
    } else {
        const Index w = A.w[patches.robot[id]];
        const double gx = a[2 * w] - a[2 * i], gy = a[2 * w + 1] - a[2 * i + 1];
        l.ux = -(r.c * gx - r.s * gy), l.uy = -(r.s * gx + r.c * gy);
    }
    return l;
}

Slicer::Meeting Slicer::meets(Index id, const Line& l, std::uint64_t curve, Turn r) const {
    const Shape &A = scene->robot, &O = scene->obstacles;
    const Feature f = unpacked(curve);
    if (f.kind == Kind::vertex_vertex) {  // where the vertex lies along the edge; 0 and 1 for the edge's own ends
        const bool on_edge = static_cast<Kind>(patches.kind[id]) == Kind::vertex_edge;
        const Shape& shape = on_edge ? O : A;
        const std::vector<double>& xy = on_edge ? b : a;
        const Index e = on_edge ? patches.obstacle[id] : patches.robot[id], x = on_edge ? f.obstacle : f.robot;
        const Index v = shape.v[e], w = shape.w[e];
        if (shape.point[x] == shape.point[v]) return {0, 1};
        if (shape.point[x] == shape.point[w]) return {1, 1};
        const double ex = xy[2 * w] - xy[2 * v], ey = xy[2 * w + 1] - xy[2 * v + 1];
        return {((xy[2 * x] - xy[2 * v]) * ex + (xy[2 * x + 1] - xy[2 * v + 1]) * ey) / (ex * ex + ey * ey), 1};
    }
    double vx, vy, qx, qy;
    if (f.kind == Kind::vertex_edge) {
        const Index v = O.v[f.obstacle], w = O.w[f.obstacle], s = f.robot;
        vx = b[2 * w] - b[2 * v], vy = b[2 * w + 1] - b[2 * v + 1];
        qx = b[2 * v] - (r.c * a[2 * s] - r.s * a[2 * s + 1]), qy = b[2 * v + 1] - (r.s * a[2 * s] + r.c * a[2 * s + 1]);
    } else {
        const Index g = A.v[f.robot], h = A.w[f.robot], v = f.obstacle;
        const double gx = a[2 * h] - a[2 * g], gy = a[2 * h + 1] - a[2 * g + 1];
        vx = -(r.c * gx - r.s * gy), vy = -(r.s * gx + r.c * gy);
        qx = b[2 * v] - (r.c * a[2 * g] - r.s * a[2 * g + 1]), qy = b[2 * v + 1] - (r.s * a[2 * g] + r.c * a[2 * g + 1]);
    }
    const double cross = vx * l.uy - vy * l.ux, t = -(vx * (l.py - qy) - vy * (l.px - qx)) / cross;
    const double sine = std::abs(cross) / (std::hypot(vx, vy) * std::hypot(l.ux, l.uy));
    return {t > 0 ? std::min(t, 1.0) : 0.0, sine};  // rounding may lead out of the patch
}

// Curves may have no value at the ends of a trapezoid: look at them a little inside.
constexpr double a_little = 1e-9;

void Slicer::limits(const Index* trapezoid, const int* charts, const double* tau, std::size_t count, double* low,
                    double* high) const {
    for (std::size_t k = 0; k < count; ++k) {
        const Index x = trapezoid[k], id = patch[x];
        const double margin = a_little * std::abs(tau_to[x] - tau_from[x]);
        const double at = std::max(tau_from[x] + margin, std::min(tau[k], tau_to[x] - margin));
        const Turn r = turn(charts[k], at);
        const Line l = line(id, r);
        low[k] = meets(id, l, lower[x], r).t, high[k] = meets(id, l, upper[x], r).t;
    }
}

void Slicer::step_off_events(int& c, double& tau) const {
    constexpr double near = 1e-11, step = 1e-8;
    for (int steps = 0; steps < 1000; ++steps) {
        if (tau >= 1) c = 1 - c, tau = -1;
        const auto members = index.at(index.part_of(c, tau));
        const bool clear = tau > near - 1 && tau < 1 - near && std::all_of(members.begin(), members.end(), [&](Index x) {
            return std::abs(tau_from[x] - tau) > near && std::abs(tau_to[x] - tau) > near;
        });
        if (clear) return;
        tau += step;
    }
}

void Slicer::move(std::vector<double>& xy, Turn r) const {
    const double x = shift[0] - (r.c * shift[2] - r.s * shift[3]), y = shift[1] - (r.s * shift[2] + r.c * shift[3]);
    for (std::size_t k = 0; k < xy.size(); k += 2) xy[k] += x, xy[k + 1] += y;
}

Slicer::Segments Slicer::segments(int c, double tau) const {
    Segments result = near(c, tau);
    move(result.xy, turn(c, tau));
    return result;
}

Slicer::Segments Slicer::near(int c, double tau) const {
    const Turn asked = turn(c, tau);
    const double was = tau;
    step_off_events(c, tau);
    Segments result;
    const Turn r = turn(c, tau);
    const bool stepped = tau != was;
    // Where lines are nearly parallel at the angle asked for, they meet where they do a step beyond it.
    constexpr double steep = 1e-6;
    for (const Index x : index.at(index.part_of(c, tau))) {
        const Index id = patch[x];
        if (!(tau_from[x] <= tau && tau < tau_to[x])) continue;
        const Line l = line(id, asked), beyond = stepped ? line(id, r) : l;
        for (const std::uint64_t curve : {lower[x], upper[x]}) {
            Meeting m = meets(id, l, curve, asked);
            if (stepped && !(m.sine > steep)) m = meets(id, beyond, curve, r);
            result.xy.insert(result.xy.end(), {l.px + m.t * l.ux, l.py + m.t * l.uy});
        }
        result.trapezoid.push_back(x);
    }
    return result;
}

std::uint64_t Slicer::name(std::uint64_t feature) const { return code(*scene, unpacked(feature)); }

Slicer::Rings Slicer::rings(int c, double tau) const {
    const Segments s = near(c, tau);
    const auto n = static_cast<Index>(s.trapezoid.size());
    // A point of the outline has a name: the helix, or the two surfaces, that meet there. Heads find tails by name.
    struct Name {
        std::uint64_t first, second;
        bool operator==(const Name& o) const { return first == o.first && second == o.second; }
    };
    struct Hash {
        std::size_t operator()(const Name& x) const {
            return (x.first * 0x9e3779b97f4a7c15u) ^ ((x.second + 0x7f4a7c15u) * 0xc2b2ae3d27d4eb4fu);
        }
    };
    const auto end_name = [&](Index x, std::uint64_t curve) -> Name {
        const std::uint64_t own = name(packed({static_cast<Kind>(patches.kind[patch[x]]), patches.robot[patch[x]],
                                               patches.obstacle[patch[x]]}));
        const std::uint64_t other = name(curve);
        if (other >> 61 == static_cast<std::uint64_t>(Kind::vertex_vertex)) return {other, 0};
        return {std::min(own, other), std::max(own, other)};
    };
    std::unordered_multimap<Name, Index, Hash> tails;
    tails.reserve(static_cast<std::size_t>(2 * n));
    for (Index k = 0; k < n; ++k) tails.emplace(end_name(s.trapezoid[k], lower[s.trapezoid[k]]), k);
    std::vector<Index> next(n, -1);
    std::vector<Index> loose;
    const auto gap = [&](Index head, Index tail) {
        return std::hypot(s.xy[4 * head + 2] - s.xy[4 * tail], s.xy[4 * head + 3] - s.xy[4 * tail + 1]);
    };
    for (Index k = 0; k < n; ++k) {
        const auto [begin, end] = tails.equal_range(end_name(s.trapezoid[k], upper[s.trapezoid[k]]));
        auto best = end;
        for (auto it = begin; it != end; ++it)
            if (best == end || gap(k, it->second) < gap(k, best->second)) best = it;
        if (best == end) {
            loose.push_back(k);
        } else {
            next[k] = best->second;
            tails.erase(best);
        }
    }
    for (const Index k : loose) {  // several curves through one point carry several names: the nearest tail left
        heed_stop();
        auto best = tails.end();
        for (auto it = tails.begin(); it != tails.end(); ++it)
            if (best == tails.end() || gap(k, it->second) < gap(k, best->second)) best = it;
        if (best == tails.end()) break;
        next[k] = best->second;
        tails.erase(best);
    }

    Rings result;
    result.start.push_back(0);
    std::vector<char> used(n, 0);
    std::vector<double> area;
    for (Index k = 0; k < n; ++k) {
        if (used[k]) continue;
        const std::size_t first = result.xy.size();
        Index x = k;
        for (; x >= 0 && !used[x]; x = next[x]) {
            used[x] = 1;
            result.xy.insert(result.xy.end(), {s.xy[4 * x], s.xy[4 * x + 1]});
        }
        const std::size_t count = (result.xy.size() - first) / 2;
        if (count < 3) {
            result.xy.resize(first);
            continue;
        }
        double twice = 0;
        const double* p = &result.xy[first];
        for (std::size_t m = 0; m < count; ++m) {
            const std::size_t q = m + 1 == count ? 0 : m + 1;
            twice += (p[2 * m] - p[0]) * (p[2 * q + 1] - p[1]) - (p[2 * q] - p[0]) * (p[2 * m + 1] - p[1]);
        }
        area.push_back(twice);
        result.start.push_back(static_cast<Index>(result.xy.size() / 2));
    }
    // a hole belongs to the smallest part around it
    const auto rings = static_cast<Index>(area.size());
    struct Extent {
        double x0, y0, x1, y1;
    };
    std::vector<Extent> extent(rings);
    for (Index k = 0; k < rings; ++k) {
        Extent e{1e308, 1e308, -1e308, -1e308};
        for (Index m = result.start[k]; m < result.start[k + 1]; ++m) {
            const double x = result.xy[2 * m], y = result.xy[2 * m + 1];
            e = {std::min(e.x0, x), std::min(e.y0, y), std::max(e.x1, x), std::max(e.y1, y)};
        }
        extent[k] = e;
    }
    const auto inside = [&](double x, double y, Index ring) {
        bool odd = false;
        for (Index m = result.start[ring], q = result.start[ring + 1] - 1; m < result.start[ring + 1]; q = m++) {
            const double x0 = result.xy[2 * q], y0 = result.xy[2 * q + 1], x1 = result.xy[2 * m], y1 = result.xy[2 * m + 1];
            if ((y0 > y) != (y1 > y) && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0)) odd = !odd;
        }
        return odd;
    };
    for (Index k = 0; k < rings; ++k) {
        Index shell = area[k] > 0 ? k : -1;
        for (Index m = 0; area[k] <= 0 && m < rings; ++m) {
            if (area[m] <= 0 || (shell >= 0 && area[m] >= area[shell])) continue;
            const Extent &h = extent[k], &e = extent[m];
            if (h.x0 < e.x0 || h.y0 < e.y0 || h.x1 > e.x1 || h.y1 > e.y1) continue;
            if (inside(result.xy[2 * result.start[k]], result.xy[2 * result.start[k] + 1], m)) shell = m;
        }
        result.shell.push_back(shell);
    }
    move(result.xy, turn(c, tau));
    return result;
}

}  // namespace cfree
