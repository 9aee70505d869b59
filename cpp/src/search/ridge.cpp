// Poses pushed uphill by linear steps, and joined; theory, "Paths".
#include "cfree/search/ridge.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cfree/support/stop.hpp"

namespace cfree {

namespace {

using Three = std::array<double, 3>;

constexpr int most_steps = 12;      // uphill
constexpr double idle = 0.05;       // of a step: what it must gain at least
constexpr double spacing = 1.0 / 3; // of poses, in radii
constexpr double most_poses = 300;  // about
constexpr int most_inserted = 100;  // poses between those
constexpr double ease_off = 0.5;    // how fast distances may change along a way
constexpr double closely = 0.8;     // of the distances at its ends, what a motion keeps unless poses are inserted

double dot(const Three& a, const Three& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Three cross(const Three& a, const Three& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Three unit(const Three& a) {
    const double length = std::max(std::sqrt(dot(a, a)), 1e-300);
    return {a[0] / length, a[1] / length, a[2] / length};
}

// A distance that changes by (u, v) . step.
struct Slope {
    double value, u, v;
};

// The step in a square that makes the least of some distances greatest: golden sections of sections.
std::array<double, 3> best_step(const std::vector<Slope>& slopes, double trust) {
    constexpr double golden = 0.6180339887498949;
    const auto section = [&](auto&& value) {
        double lo = -trust, hi = trust, a = hi - golden * (hi - lo), b = lo + golden * (hi - lo), fa = value(a), fb = value(b);
        for (int k = 0; k < 16; ++k) {
            if (fa < fb) lo = a, a = b, fa = fb, b = lo + golden * (hi - lo), fb = value(b);
            else hi = b, b = a, fb = fa, a = hi - golden * (hi - lo), fa = value(a);
        }
        return fa < fb ? b : a;
    };
    const auto least = [&](double u, double v) {
        double f = HUGE_VAL;
        for (const Slope& s : slopes) f = std::min(f, s.value + s.u * u + s.v * v);
        return f - idle * (std::abs(u) + std::abs(v));
    };
    const auto best_v = [&](double u) { return section([&](double v) { return least(u, v); }); };
    const double u = section([&](double at) { return least(at, best_v(at)); }), v = best_v(u);
    return {u, v, least(u, v) + idle * (std::abs(u) + std::abs(v))};
}

}  // namespace

double climb(const Way& way, Place& q, const Three& direction, double enough) {
    const Three t = unit(direction), other = std::abs(t[2]) < 0.9 ? Three{0, 0, 1} : Three{1, 0, 0};
    const Three e = unit(cross(t, other)), f = cross(t, e);
    const double radius = way.costs.weight;
    const Area& limits = way.limits;
    double d = way.nearness->distance(q, enough), trust = std::min(0.25 * radius, 2 * enough);
    for (int k = 0; k < most_steps && d < enough; ++k) {
        heed_stop();
        std::vector<Slope> slopes{{enough, 0, 0}};
        for (const Witness& w : way.nearness->around(q, d + 3 * trust)) {
            const Three g{w.normal.x, w.normal.y, (w.normal.y * w.arm.x - w.normal.x * w.arm.y) / radius};
            slopes.push_back({w.distance, dot(g, e), dot(g, f)});
        }
        const auto [u, v, aim] = best_step(slopes, trust);
        if (aim - d < 0.02 * std::min(trust, d + 0.1 * trust)) break;
        Place next{q.x + u * e[0] + v * f[0], q.y + u * e[1] + v * f[1], q.theta + (u * e[2] + v * f[2]) / radius};
        next.x = std::clamp(next.x, limits.x0, limits.x1), next.y = std::clamp(next.y, limits.y0, limits.y1);
        const double now = way.nearness->distance(next, enough);
        if (now >= d + 0.1 * (aim - d)) {
            if (now > d + 0.5 * (aim - d)) trust *= 2;
            q = next, d = now;
        } else if ((trust /= 4) < 1e-7 * radius) {
            break;
        }
    }
    return d;
}

namespace {

struct Sample {
    double where;            // on the route
    Configuration own, high; // there, and uphill
    double distance;
};

struct Step {
    Configuration pose;
    double distance;  // of the motion to it
};

class Climber {
public:
    Climber(const Way& w, const Route& r, double most) : way(w), route(r), enough(most), at(costs_along(r, w.length())) {}
    Ridge run();

private:
    Sample sample(double where, double up_to) const;
    std::vector<Sample> samples() const;
    std::optional<Step> measured(const Configuration& a, const Configuration& b, double most, double least_share) const;
    std::vector<Step> joined(const Sample& a, const Sample& b, bool roughly) const;
    std::vector<Step> around(const Sample& a, const Sample& b) const;
    double distance(const Configuration& q) const { return way.nearness->distance({q.px, q.py, q.theta}, enough); }

    const Way& way;
    const Route& route;
    const double enough;
    const std::vector<double> at;
};

Sample Climber::sample(double where, double up_to) const {
    const auto after = std::upper_bound(at.begin() + 1, at.end() - 1, where);
    const auto k = static_cast<std::size_t>(after - at.begin()) - 1;
    const Configuration &a = route[k], &b = route[k + 1];
    const double share = (where - at[k]) / std::max(at[k + 1] - at[k], 1e-300);
    const auto direction = [&](const Configuration& from, const Configuration& to, double here) -> Three {
        const Place before = along(from, to, here - 1e-3), beyond = along(from, to, here + 1e-3);
        return {beyond.x - before.x, beyond.y - before.y, way.costs.weight * (beyond.theta - before.theta)};
    };
    Place q = along(a, b, share);
    Sample s{where, where == at[k] ? a : where == at[k + 1] ? b : way.grid.exact(q.x, q.y, q.theta), {}, 0};
    s.high = s.own;
    if (where != at.front() && where != at.back()) {
        const double reached = climb(way, q, direction(a, b, share), up_to);
        if (where == at[k] && reached < up_to) climb(way, q, direction(route[k - 1], a, 1), up_to);
        s.high = way.grid.exact(q.x, q.y, q.theta);
    }
    s.distance = std::min(up_to, distance(s.high));
    return s;
}

// From goal to start. Near a narrow place no higher than a way from there can be.
std::vector<Sample> Climber::samples() const {
    const double step = std::max(spacing * way.costs.weight, at.back() / most_poses);
    std::vector<Sample> found;
    for (std::size_t k = route.size() - 1; k > 0; --k) {
        const int count = std::max(1, static_cast<int>(std::ceil((at[k] - at[k - 1]) / step)));
        for (int m = count; m > 0; --m) {
            const double where = m == count ? at[k] : at[k - 1] + m * (at[k] - at[k - 1]) / count;
            if (found.empty() || where < found.back().where) found.push_back(sample(where, enough));
        }
    }
    if (found.back().where > 0) found.push_back(sample(0, enough));
    std::vector<double> up_to;
    for (const Sample& s : found) up_to.push_back(s.distance);
    const auto ease = [&](std::size_t k, std::size_t from) {
        up_to[k] = std::min(up_to[k], up_to[from] + ease_off * std::abs(found[k].where - found[from].where));
    };
    for (std::size_t k = 1; k < found.size(); ++k) ease(k, k - 1);
    for (std::size_t k = found.size() - 1; k-- > 0;) ease(k, k + 1);
    for (std::size_t k = 0; k < found.size(); ++k)
        if (up_to[k] < 0.95 * found[k].distance) found[k] = sample(found[k].where, up_to[k]);
    return found;
}

// Which share of a distance a motion keeps, as far as that is looked for; 0: it is free, and no more is known.
std::optional<Step> Climber::measured(const Configuration& a, const Configuration& b, double most, double least_share) const {
    for (const double share : {0.95, 0.8, 0.65, 0.5, 0.35, 0.2, 0.1, 0.03, 0.0})
        if (share >= least_share && way.keeps(a, b, share * most)) return Step{b, share * most};
    return {};
}

std::vector<Step> Climber::joined(const Sample& a, const Sample& b, bool roughly) const {
    const auto step = measured(a.high, b.high, std::min(a.distance, b.distance), roughly ? 0 : closely);
    return step ? std::vector{*step} : std::vector<Step>{};
}

// Down to the route, along it and up again.
std::vector<Step> Climber::around(const Sample& a, const Sample& b) const {
    Route r{a.high, a.own};
    for (std::size_t k = 0; k < at.size(); ++k)
        if (a.where < at[k] && at[k] < b.where) r.push_back(route[k]);
    r.push_back(b.own), r.push_back(b.high);
    std::vector<Step> steps;
    for (std::size_t k = 1; k < r.size(); ++k) {
        const auto step = measured(r[k - 1], r[k], std::min(distance(r[k - 1]), distance(r[k])), 0);
        if (!step) return {};
        steps.push_back(*step);
    }
    return steps;
}

Ridge Climber::run() {
    std::vector<Sample> ahead = samples(), kept{ahead.back()};
    ahead.pop_back();
    std::vector<std::vector<Step>> steps{{}};  // to each sample kept
    for (int inserted = 0; !ahead.empty();) {
        heed_stop();
        const Sample next = ahead.back(), &last = kept.back();
        const double apart = cost_between(last.high, next.high, way.length()), middle = 0.5 * (last.where + next.where);
        const bool divides = apart > 0.5 * std::min(last.distance, next.distance) && next.where - last.where > apart / 8 &&
                             last.where < middle && middle < next.where && inserted < most_inserted;
        auto between = joined(last, next, !divides);
        if (between.empty() && divides) {
            const double off = ease_off * (middle - last.where);
            ahead.push_back(sample(middle, std::min({enough, last.distance + off, next.distance + off}))), ++inserted;
            continue;
        }
        if (between.empty()) between = around(last, next);
        if (!between.empty()) kept.push_back(next), steps.push_back(std::move(between)), ahead.pop_back();
        else if (ahead.size() > 1) ahead.pop_back();        // by another sample
        else kept.pop_back(), steps.pop_back();             // at last along the route itself
    }
    Ridge r{{{kept.front().own}, {0}}, {kept.front().distance}};
    for (const auto& between : steps)
        for (const auto& [pose, kept_there] : between) {
            const double length = cost_between(r.path.route.back(), pose, way.length());
            if (length == 0) continue;
            r.path.mark.push_back(r.path.mark.back() + length), r.path.route.push_back(pose);
            r.distance.back() = std::min(r.distance.back(), kept_there);
            r.distance.push_back(std::min(kept_there, distance(pose)));
        }
    return r;
}

}  // namespace

Ridge ridge(const Way& way, const Route& route, double enough) { return Climber(way, route, enough).run(); }

std::vector<double> distances_asked(const Ridge& ridge, double radius, double share, int most_depth) {
    const auto& at = ridge.path.mark;
    const std::size_t count = at.size();
    // the narrowest place of each part; of what is cut out around one, the wider part beside it
    std::vector<double> asked(count, 0);
    struct Part {
        std::size_t begin, end;  // included
        int depth;
    };
    std::vector<Part> parts{{0, count - 1, 0}};
    for (std::size_t next = 0; next < parts.size(); ++next) {
        const auto [begin, end, depth] = parts[next];
        const auto first = ridge.distance.begin();
        const auto narrow = static_cast<std::size_t>(
            std::min_element(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end) + 1) - first);
        for (std::size_t k = begin; k <= end; ++k) asked[k] = ridge.distance[narrow];
        if (depth == most_depth) continue;
        if (depth > 0 && (narrow == begin || narrow == end)) {  // on with what is between its slopes
            std::size_t from = begin, to = end;
            while (from < to && ridge.distance[from + 1] >= ridge.distance[from]) ++from;
            while (from < to && ridge.distance[to - 1] >= ridge.distance[to]) --to;
            if (from < to) parts.push_back({from, to, depth + 1});
            continue;
        }
        const auto is_cut = [&, first_depth = depth == 0](std::size_t k) {
            return std::abs(at[k] - at[narrow]) < radius || (first_depth && (at[k] < radius || at[k] > at.back() - radius));
        };
        for (std::size_t k = begin; k <= end; ++k) {
            if (is_cut(k)) continue;
            std::size_t stop = k;
            while (stop < end && !is_cut(stop + 1)) ++stop;
            parts.push_back({k, stop, depth + 1});
            k = stop;
        }
    }
    std::vector<double> most = asked;
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t j = k; j-- > 0 && at[k] - at[j] < 1.5 * radius;)
            most[k] = std::max(most[k], asked[j]), most[j] = std::max(most[j], asked[k]);
    for (std::size_t k = 0; k < count; ++k) asked[k] = share * std::min(most[k], ridge.distance[k]);
    return asked;
}

}  // namespace cfree
