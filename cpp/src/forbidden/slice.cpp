// Contact segments at one orientation, chained into outlines by the names of their ends; theory, "The trimmed boundary".
#include "cfree/forbidden/slice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"
#include "forbidden/round_names.hpp"

namespace cfree {

namespace {

std::vector<double> middles(const std::vector<double>& lo, const std::vector<double>& hi) {
    std::vector<double> result(lo.size());
    std::transform(lo.begin(), lo.end(), hi.begin(), result.begin(), [](double x, double y) { return 0.5 * (x + y); });
    return result;
}

}  // namespace

Slicer::Slicer(SharedBoundary of)
    : boundary(std::move(of)), scene(boundary->scene->near()), lines(*boundary),
      tau_from(middles(boundary->trapezoids.from_lo, boundary->trapezoids.from_hi)),
      tau_to(middles(boundary->trapezoids.to_lo, boundary->trapezoids.to_hi)),
      index(boundary->trapezoids.chart, tau_from, tau_to, 8) {}

void Slicer::isolated_curve(Index part, const double* tau, std::size_t count, double* t) const {
    const IsolatedParts& x = boundary->isolated;
    const Feature contact = boundary->patches.contact(x.lower_patch[part]);
    for (std::size_t k = 0; k < count; ++k) {
        const double at = Limits::inside(tau[k], x.parts.tau_from(part), x.parts.tau_to(part));
        const Turn r = rotation_by(x.parts.chart[part], at);
        t[k] = lines.meets(contact, lines.line(contact, r), x.parts.lower[part], r).t;
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

// Move positions, from one on, from the near frame to the user's.
void Slicer::move(std::vector<double>& xy, std::size_t from, const Turn& r) const {
    const auto& f = scene.frame;
    const double x = f[0] - (r.c * f[2] - r.s * f[3]), y = f[1] - (r.s * f[2] + r.c * f[3]);
    for (std::size_t k = from; k < xy.size(); k += 2) xy[k] += x, xy[k + 1] += y;
}

Slicer::Segments Slicer::segments(int c, double tau) const {
    Segments result = near(c, tau);
    move(result.xy, 0, rotation_by(c, tau));
    return result;
}

Slicer::Segments Slicer::near(int c, double tau) const {
    const Trapezoids& t = boundary->trapezoids;
    const Turn asked = rotation_by(c, tau);
    const double was = tau;
    step_off_events(c, tau);
    const Turn r = rotation_by(c, tau);
    const bool stepped = tau != was;
    // Sine below which nearly parallel lines take their intersection from a step beyond the angle.
    constexpr double steep = 1e-6;
    Segments result;
    for (const Index x : index.at(index.part_of(c, tau))) {
        if (!(tau_from[x] <= tau && tau < tau_to[x])) continue;
        const Feature contact = boundary->patches.contact(t.patch[x]);
        const Line l = lines.line(contact, asked), beyond = stepped ? lines.line(contact, r) : l;
        std::array<double, 2> ends{};
        for (const bool upper : {false, true}) {
            const std::uint64_t curve = (upper ? t.upper : t.lower)[x];
            auto m = lines.meets(contact, l, curve, asked);
            if (stepped && !(m.sine > steep)) m = lines.meets(contact, beyond, curve, r);
            const auto p = l.at(ends[upper] = m.t);
            result.xy.insert(result.xy.end(), {p.x, p.y});
        }
        if (scene.is_round) {
            const int turn = l.radius < 0 ? -1 : 1;
            const double begin = 0.5 * std::numbers::pi * (l.quadrant + (turn < 0));
            if (l.is_circle())
                result.arcs.push_back({l.p, l.radius, begin + 2 * turn * arc_tangent(ends[0]), begin + 2 * turn * arc_tangent(ends[1])});
            else result.arcs.push_back({});
        }
        result.trapezoid.push_back(x);
    }
    return result;
}

Slicer::Rings Slicer::rings(std::span<const int> chart, std::span<const double> tau) const {
    Rings result;
    for (std::size_t k = 0; k < chart.size(); ++k) {
        heed_stop();
        const Segments found = near(chart[k], tau[k]);
        const std::size_t from = result.xy.size();
        nest(result, trace(found, chained(found), result));
        move(result.xy, from, rotation_by(chart[k], tau[k]));
        result.first.push_back(static_cast<Index>(result.shell.size()));
    }
    return result;
}

Slicer::Name Slicer::end_name(Index x, std::uint64_t curve) const {
    const Feature on = boundary->patches.contact(boundary->trapezoids.patch[x]), f = unpacked(curve);
    if (scene.is_round && !(f.kind == Kind::vertex_vertex && sum_of_radii(scene, f) == 0)) {
        const CurveName name = curve_name(scene, on, f);
        return {name.first, name.second, name.branch};
    }
    const Code own = code(scene, on), other = code(scene, f);
    if (other >> 61 == static_cast<Code>(Kind::vertex_vertex)) return {other, 0};
    return {std::min(own, other), std::max(own, other)};
}

// Segment after each, -1 if none is left: heads find tails by name, the nearest of several.
std::vector<Index> Slicer::chained(const Segments& s) const {
    const Trapezoids& t = boundary->trapezoids;
    const auto n = static_cast<Index>(s.trapezoid.size());
    using Tail = std::pair<Name, Index>;
    std::vector<Tail> tails;  // a few, so that sorting beats hashing
    for (Index k = 0; k < n; ++k) tails.emplace_back(end_name(s.trapezoid[k], t.lower[s.trapezoid[k]]), k);
    std::sort(tails.begin(), tails.end());
    const auto gap = [&](Index head, Index tail) {
        return norm(s.xy[4 * head + 2] - s.xy[4 * tail], s.xy[4 * head + 3] - s.xy[4 * tail + 1]);
    };
    std::vector<Index> next(n, -1);
    std::vector<char> taken(n, 0);
    const auto link = [&](Index k, auto begin, auto end) {
        Index best = -1;
        for (auto it = begin; it != end; ++it)
            if (!taken[it->second] && (best < 0 || gap(k, it->second) < gap(k, best))) best = it->second;
        if (best < 0) return false;
        next[k] = best, taken[best] = 1;
        return true;
    };
    std::vector<Index> loose;
    for (Index k = 0; k < n; ++k) {
        const Name name = end_name(s.trapezoid[k], t.upper[s.trapezoid[k]]);
        const auto begin = std::lower_bound(tails.begin(), tails.end(), Tail{name, 0});
        const auto end = std::find_if(begin, tails.end(), [&](const Tail& x) { return x.first != name; });
        if (!link(k, begin, end)) loose.push_back(k);
    }
    std::erase_if(tails, [&](const Tail& x) { return taken[x.second]; });
    for (const Index k : loose) {  // several curves through one point carry several names: the nearest tail left
        heed_stop();
        if (!link(k, tails.begin(), tails.end())) break;
    }
    return next;
}

// Trace chains as more rings, of at least three points; returns twice their areas.
std::vector<double> Slicer::trace(const Segments& s, const std::vector<Index>& next, Rings& result) {
    std::vector<char> used(next.size(), 0);
    std::vector<double> area;
    for (std::size_t k = 0; k < next.size(); ++k) {
        if (used[k]) continue;
        const std::size_t first = result.xy.size();
        for (auto x = static_cast<Index>(k); x >= 0 && !used[x]; x = next[x]) {
            used[x] = 1;
            result.xy.insert(result.xy.end(), {s.xy[4 * x], s.xy[4 * x + 1]});
            result.bend.push_back(s.arcs.empty() ? 0 : s.arcs[x].radius);
            if (result.bend.back() == 0) continue;
            const auto& [centre, radius, from, to] = s.arcs[x];
            const int chords = std::max(2, static_cast<int>(std::ceil(std::abs(to - from) / chord)));
            for (int m = 1; m < chords; ++m) {
                const auto [c, n] = cosine_sine(from + (to - from) * m / chords);
                result.xy.insert(result.xy.end(), {centre.x + radius * c, centre.y + radius * n});
                result.bend.push_back(Rings::in_arc);
            }
        }
        const std::size_t count = (result.xy.size() - first) / 2;
        if (count < 3) {
            result.xy.resize(first), result.bend.resize(first / 2);
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
    return area;
}

// Of the newest rings: a hole belongs to the smallest part around it.
void Slicer::nest(Rings& r, const std::vector<double>& area) {
    struct Extent {
        double x0, y0, x1, y1;
        bool holds(const Extent& e) const { return x0 <= e.x0 && y0 <= e.y0 && e.x1 <= x1 && e.y1 <= y1; }
    };
    const auto rings = static_cast<Index>(area.size()), base = static_cast<Index>(r.shell.size());
    const Index* start = &r.start[base];
    std::vector<Extent> extent;
    for (Index k = 0; k < rings; ++k) {
        Extent e{1e308, 1e308, -1e308, -1e308};
        for (Index m = start[k]; m < start[k + 1]; ++m) {
            const double x = r.xy[2 * m], y = r.xy[2 * m + 1];
            e = {std::min(e.x0, x), std::min(e.y0, y), std::max(e.x1, x), std::max(e.y1, y)};
        }
        extent.push_back(e);
    }
    const auto is_inside = [&](double x, double y, Index ring) {
        bool odd = false;
        for (Index m = start[ring], q = start[ring + 1] - 1; m < start[ring + 1]; q = m++) {
            const double x0 = r.xy[2 * q], y0 = r.xy[2 * q + 1], x1 = r.xy[2 * m], y1 = r.xy[2 * m + 1];
            if ((y0 > y) != (y1 > y) && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0)) odd = !odd;
        }
        return odd;
    };
    for (Index k = 0; k < rings; ++k) {
        Index shell = area[k] > 0 ? k : -1;
        for (Index m = 0; area[k] <= 0 && m < rings; ++m) {
            if (area[m] <= 0 || (shell >= 0 && area[m] >= area[shell]) || !extent[m].holds(extent[k])) continue;
            if (is_inside(r.xy[2 * start[k]], r.xy[2 * start[k] + 1], m)) shell = m;
        }
        r.shell.push_back(shell < 0 ? -1 : base + shell);
    }
}

}  // namespace cfree
