// Push poses uphill by linear steps, and join them; theory, "Paths".
#include "cfree/search/ridge.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

using Three = std::array<double, 3>;

constexpr int most_steps = 12;      // uphill
constexpr double idle = 0.05;       // least gain, as a share of a step
constexpr double longest = 0.5;     // longest step, in radii: longer linear ones mean little
constexpr int most_cuts = 16;
constexpr double spacing = 1.0 / 3; // distance of poses, in radii
constexpr double most_poses = 300;  // approximate
constexpr int most_inserted = 100;  // poses between those
constexpr int bridges = 3;          // halvings of gaps between poses
constexpr double most_of_apart = 0.75;
constexpr double off_limits = 0.01; // radii of room for arcs beside the limits
constexpr double ease_off = 0.5;    // greatest change of distances along a way

double dot(const Three& a, const Three& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Three cross(const Three& a, const Three& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Three unit(const Three& a) {
    const double length = std::max(std::sqrt(dot(a, a)), 1e-300);
    return {a[0] / length, a[1] / length, a[2] / length};
}

// Distance that changes by (u, v) . step.
struct Slope {
    double value, u, v;
};

// Concave function of two numbers at one place: its value, and its slopes in both.
struct Tangent {
    double value, slope, across;
};
struct Peak {
    double at;
    Tangent there;
};

// Maximum of a concave function between -most and most: intersect tangents from both sides; the tangent there replaces one of
// them. If the function is piecewise linear, few steps suffice.
template <class F>
Peak peak(F&& tangent, double most) {
    double lo = -most, hi = most;
    Tangent a = tangent(lo), b = tangent(hi);
    if (a.slope <= 0) return {lo, a};
    if (b.slope >= 0) return {hi, b};
    for (int k = 0;; ++k) {
        const double bend = a.slope - b.slope, on = std::clamp((b.value - a.value - b.slope * (hi - lo)) / bend, 0.0, hi - lo);
        const Tangent t = tangent(lo + on);
        const bool is_there = t.value >= a.value + a.slope * on - 1e-6 * most;
        if (is_there || k == most_cuts) return {lo + on, {t.value, 0, (a.slope * b.across - b.slope * a.across) / bend}};
        if (t.slope > 0) lo += on, a = t;
        else hi = lo + on, b = t;
    }
}

// Step in a square that maximises the least of some distances.
std::array<double, 3> best_step(const std::vector<Slope>& slopes, double trust) {
    const auto beside = [&](double u) {
        return peak([&](double v) {
            const Slope* least = nullptr;
            double f = HUGE_VAL;
            for (const Slope& s : slopes)
                if (const double d = s.value + s.u * u + s.v * v; d < f) f = d, least = &s;
            return Tangent{f - idle * std::abs(v), least->v - std::copysign(idle, v), least->u};
        }, trust);
    };
    const double u = peak([&](double at) {
        const Tangent t = beside(at).there;
        return Tangent{t.value - idle * std::abs(at), t.across - std::copysign(idle, at), 0};
    }, trust).at;
    const auto [v, there] = beside(u);
    return {u, v, there.value + idle * std::abs(v)};
}

}  // namespace

double climb(const Way& way, Place& q, const Three& direction, double enough) {
    const bool turns = way.may_turn || (direction[0] == 0 && direction[1] == 0);
    const Three t = unit({direction[0], direction[1], turns ? direction[2] : 0}), other = std::abs(t[2]) < 0.9 ? Three{0, 0, 1} : Three{1, 0, 0};
    const Three e = unit(cross(t, other)), f = cross(t, e);
    const double radius = way.costs.weight;
    const auto between = [off = off_limits * radius](double from, double lo, double hi) {
        return std::pair{std::min(from, lo + off), std::max(from, hi - off)};
    };
    const auto [x0, x1] = between(q.x, way.limits.x0, way.limits.x1);
    const auto [y0, y1] = between(q.y, way.limits.y0, way.limits.y1);
    double d = way.nearness->distance(q, enough), trust = std::min(0.25 * radius, 2 * enough);
    for (int k = 0; k < most_steps && d < enough; ++k) {
        heed_stop();
        std::vector<Slope> slopes{{enough, 0, 0}};
        for (const Witness& w : way.nearness->around(q, d + 3 * trust)) {
            const Three g{w.normal.x, w.normal.y, turns ? (w.normal.y * w.arm.x - w.normal.x * w.arm.y) / radius : 0};
            const Slope s{w.distance, dot(g, e), dot(g, f)};
            if (s.value - trust * (std::abs(s.u) + std::abs(s.v)) < enough) slopes.push_back(s);
        }
        const auto [u, v, aim] = best_step(slopes, trust);
        if (aim - d < 0.02 * std::min(trust, d + 0.1 * trust)) break;
        Place next{q.x + u * e[0] + v * f[0], q.y + u * e[1] + v * f[1], q.theta + (u * e[2] + v * f[2]) / radius};
        next.x = std::clamp(next.x, x0, x1), next.y = std::clamp(next.y, y0, y1);
        const double now = way.nearness->distance(next, enough);
        if (now >= d + 0.1 * (aim - d)) {
            if (now > d + 0.5 * (aim - d)) trust = std::min(2 * trust, longest * radius);
            q = next, d = now;
        } else if ((trust /= 4) < 1e-7 * radius) {
            break;
        }
    }
    return d;
}

namespace {

struct Sample {
    double where;            // place on the route
    Configuration own, high; // pose there, and uphill
    double distance;
    bool is_on_route;  // true if it is on the route, for lack of room beside it
};

struct Step {
    Configuration pose;
    double distance;  // distance of the motion to it
};

class Climber {
public:
    Climber(const Way& w, const Route& r, double most) : way(w), route(r), enough(most), at(costs_along(r, w.length())) {}
    Ridge run();

private:
    Sample sample(double where, double up_to) const;
    std::vector<Sample> samples() const;
    std::optional<Step> measured(const Configuration& a, const Configuration& b, double most, bool roughly) const;
    std::vector<Step> leg(const Configuration& a, const Configuration& b, double most, bool roughly) const;
    std::vector<Step> bridged(const Configuration& a, const Configuration& b, int depth) const;
    std::vector<Step> around(const Sample& a, const Sample& b) const;
    bool is_above(const Sample& s) const { return s.is_on_route && !way.nearness->overlaps(s.own, s.high); }
    double distance(const Configuration& q) const { return way.nearness->distance(q.place(), enough); }
    bool touches(const Configuration& q) const { return way.nearness->is_nearer(q.place(), way.nearness->least()); }

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
    const Place here = along(a, b, share);
    Sample s{where, where == at[k + 1] ? b : where == at[k] ? a : way.grid.exact(here.x, here.y, here.theta), {}, 0, true};
    s.high = s.own, s.is_on_route = where == at[k] || where == at[k + 1] || !touches(s.own);
    if (where != at.front() && where != at.back()) {
        Place q = here;
        const double reached = climb(way, q, direction(a, b, share), up_to);
        if (where == at[k] && reached < up_to) climb(way, q, direction(route[k - 1], a, 1), up_to);
        if (q.x != here.x || q.y != here.y || q.theta != here.theta) s.high = way.grid.exact(q.x, q.y, q.theta);
    }
    s.distance = std::min(up_to, distance(s.high));
    return s;
}

// Samples from goal to start; near a narrow place, no higher than a way from there can be.
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

// Measure the share of a distance that a motion keeps, up to a limit; 0: it is free, and no more is known.
std::optional<Step> Climber::measured(const Configuration& a, const Configuration& b, double most, bool roughly) const {
    constexpr std::array shares{0.95, 0.8, 0.65, 0.5, 0.35, 0.2, 0.1, 0.03};
    constexpr std::size_t close = 2;  // number of samples, unless poses are inserted
    const auto keeps = [&](double share) { return way.keeps(a, b, share * most); };
    if (most > way.nearness->least()) {
        if (keeps(shares[0])) return Step{b, shares[0] * most};
        const std::size_t end = roughly ? shares.size() : close;
        std::size_t bad = 0, good = end;
        while (bad + 1 < good) {
            const std::size_t middle = (bad + good) / 2;
            (keeps(shares[middle]) ? good : bad) = middle;
        }
        if (good < end) return Step{b, shares[good] * most};
        if (!roughly) return {};
    }
    if (!keeps(0)) return {};
    return Step{b, 0};
}

// One motion; or, if its arc may leave the limits, a turn and a straight way in either order.
std::vector<Step> Climber::leg(const Configuration& a, const Configuration& b, double most, bool roughly) const {
    if (const auto step = measured(a, b, most, roughly)) return {*step};
    if (way.is_within(a, b)) return {};
    for (const Configuration& between : {corner(b, a), corner(a, b)})
        if (const auto first = measured(a, between, most, roughly))
            if (const auto second = measured(between, b, most, roughly)) return {*first, *second};
    return {};
}

// Steps over poses half-way between, pushed across.
std::vector<Step> Climber::bridged(const Configuration& a, const Configuration& b, int depth) const {
    const double apart = cost_between(a, b, way.length());
    Place q = along(a, b, 0.5);
    climb(way, q, {b.px - a.px, b.py - a.py, way.costs.weight * turn_between(a, b)}, std::min({enough, distance(a), distance(b)}));
    const Configuration middle = way.grid.exact(q.x, q.y, q.theta);
    if (touches(middle)) return {};
    std::vector<Step> steps;
    for (const auto& [from, to] : {std::pair{&a, &middle}, std::pair{&middle, &b}}) {
        if (cost_between(*from, *to, way.length()) > most_of_apart * apart) return {};
        auto some = leg(*from, *to, std::min(distance(*from), distance(*to)), true);
        if ((some.empty() || some.front().distance == 0) && depth > 0) some = bridged(*from, *to, depth - 1);
        if (some.empty()) return {};
        steps.insert(steps.end(), some.begin(), some.end());
    }
    return steps;
}

// Steps down to the route, along it and up again. Whole motions of the route are free.
std::vector<Step> Climber::around(const Sample& a, const Sample& b) const {
    if (!a.is_on_route || !b.is_on_route) return {};
    std::vector<Step> steps;
    Configuration here = a.high;
    const auto go_on = [&](const Configuration& to, bool is_whole) {
        if (cost_between(here, to, way.length()) == 0) return true;
        auto some = leg(here, to, std::min(distance(here), distance(to)), true);
        if (some.empty() && is_whole) some = {{to, 0}};
        steps.insert(steps.end(), some.begin(), some.end()), here = to;
        return !some.empty();
    };
    bool is_free = go_on(a.own, false);
    double before = a.where;
    for (auto k = std::upper_bound(at.begin(), at.end(), a.where); is_free && *k < b.where; before = *k++)
        is_free = go_on(route[static_cast<std::size_t>(k - at.begin())], *(k - 1) == before);
    const auto last = std::upper_bound(at.begin(), at.end(), b.where) - 1;
    is_free = is_free && go_on(b.own, *last == b.where && *(last - 1) == before) && go_on(b.high, false);
    return is_free ? steps : std::vector<Step>{};
}

Ridge Climber::run() {
    std::vector<Sample> ahead = samples(), kept{ahead.back()};
    ahead.pop_back();
    std::vector<std::vector<Step>> steps{{}};  // steps to each remaining sample
    bool may_divide = true;
    for (int inserted = 0; !ahead.empty();) {
        heed_stop();
        const Sample next = ahead.back(), &last = kept.back();
        const double apart = cost_between(last.high, next.high, way.length()), middle = 0.5 * (last.where + next.where);
        const bool divides = may_divide && apart > 0.5 * std::min(last.distance, next.distance) && next.where - last.where > apart / 8 &&
                             last.where < middle && middle < next.where && inserted < most_inserted;
        auto between = leg(last.high, next.high, std::min(last.distance, next.distance), !divides);
        if (between.empty() && divides) {
            const double off = ease_off * (middle - last.where);
            ahead.push_back(sample(middle, std::min({enough, last.distance + off, next.distance + off}))), ++inserted;
            continue;
        }
        if (between.empty()) between = bridged(last.high, next.high, bridges);
        if (between.empty()) between = around(last, next);
        may_divide = !between.empty();
        if (may_divide) kept.push_back(next), steps.push_back(std::move(between)), ahead.pop_back();
        else if (kept.size() == 1 || (ahead.size() > 1 && (is_above(last) || !is_above(next)))) ahead.pop_back();  // via another sample
        else kept.pop_back(), steps.pop_back();  // finally along the route itself
    }
    if (kept.back().where != at.back()) return {{route, at}, std::vector<double>(at.size(), 0)};  // rounding lost it
    Ridge r{{{route.front()}, {0}}, {kept.front().distance}};
    for (const auto& between : steps)
        for (const auto& [pose, kept_there] : between) {
            const double length = cost_between(r.path.route.back(), pose, way.length());
            if (length == 0) continue;
            r.path.mark.push_back(r.path.mark.back() + length), r.path.route.push_back(pose);
            r.distance.back() = std::min(r.distance.back(), kept_there);
            r.distance.push_back(std::min(kept_there, distance(pose)));
        }
    const Configuration &last = r.path.route.back(), &goal = route.back();
    if (last.x != goal.x || last.y != goal.y || last.unit != goal.unit || last.hx != goal.hx || last.hy != goal.hy)  // within rounding
        r.path.route.push_back(goal), r.path.mark.push_back(r.path.mark.back()), r.distance.push_back(r.distance.back());
    return r;
}

}  // namespace

Ridge ridge(const Way& way, const Route& route, double enough) { return Climber(way, route, enough).run(); }

std::vector<double> distances_asked(const Ridge& ridge, double radius, double share, int most_depth) {
    const auto& at = ridge.path.mark;
    const std::size_t count = at.size();
    // the narrowest place of each part; for cut-outs around one, the wider part beside it
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
        if (depth > 0 && (narrow == begin || narrow == end)) {  // go on between its slopes
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
