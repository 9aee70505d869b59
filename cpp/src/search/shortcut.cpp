// Leave out or move poses of a path while its motions stay free and keep their distance; theory, "Paths".
#include "cfree/search/shortcut.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "cfree/search/fewer_turns.hpp"
#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

constexpr double least_gain = 1e-9;  // per length
constexpr std::size_t most_merged = 6;

}  // namespace

Shortcut::Shortcut(Way w, Marked path, std::uint64_t seed)
    : way(std::move(w)), route(std::move(path.route)), mark(std::move(path.mark)), at(costs_along(route, way.costs)), random(seed) {}

void Shortcut::run(int checks) {
    left = checks;
    while (left > 0 && route.size() > 1 && length() > 0) {
        --left;
        attempt();
    }
}

void Shortcut::merge() {
    turn_less();
    for (std::size_t i = 0; i + 2 < route.size(); ++i)
        for (std::size_t j = std::min(i + most_merged, route.size() - 1); j > i + 1; --j) {
            const Configuration &a = route[i], &b = route[j];
            if (replace(i, j, {a, b}) || (j > i + 2 && (replace(i, j, {a, corner(a, b), b}) || replace(i, j, {a, corner(b, a), b})))) break;
        }
}

void Shortcut::turn_less() {
    if (!way.center) return;
    Marked path = with_fewer_turns(way, {route, mark});
    route = std::move(path.route), mark = std::move(path.mark), at = costs_along(route, way.costs);
}

// Replace the path between two of its poses by a fresh route, if that is shorter and keeps the required distances.
bool Shortcut::replace(std::size_t i, std::size_t last, Route fresh) {
    const double motions = static_cast<double>(last - i) - static_cast<double>(fresh.size() - 1);
    const double gain = at[last] - at[i] - cost_of(fresh, way.costs) + way.per_motion * motions, least = least_gain * length();
    if (gain < -least || (gain <= least && fresh.size() > last - i)) return false;
    const Marked path = way.marked(std::move(fresh), mark[i], mark[last]);
    for (std::size_t k = 1; k < path.route.size(); ++k) {
        --left;
        if (!way.joins(path.route[k - 1], path.route[k], path.mark[k - 1], path.mark[k])) return false;
    }
    const auto put = [&](auto& values, const auto& with) {
        auto whole = std::vector(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(i));
        whole.insert(whole.end(), with.begin(), with.end());
        whole.insert(whole.end(), values.begin() + static_cast<std::ptrdiff_t>(last) + 1, values.end());
        values = std::move(whole);
    };
    put(mark, path.mark), put(route, path.route);
    at = costs_along(route, way.costs);
    return true;
}

// Turn a pose to point ahead or back on its way.
void Shortcut::steer() {
    if (route.size() < 3) return;
    const std::size_t k = 1 + static_cast<std::size_t>(random() * static_cast<double>(route.size() - 2));
    const Configuration &before = route[k - 1], &beyond = route[k + 1];
    const double ahead = arc_tangent(beyond.py - before.py, beyond.px - before.px);
    for (const double theta : {ahead, ahead + std::numbers::pi})
        if (replace(k - 1, k + 1, {before, way.turned(route[k], theta), beyond})) return;
}

// Give all poses between two poses the orientation of one of them, as far as that helps.
void Shortcut::straighten() {
    const auto any = [&] { return static_cast<std::size_t>(random() * static_cast<double>(route.size())); };
    std::size_t i = any(), j = any();
    const bool first = random() < 0.5;
    if (i > j) std::swap(i, j);
    if (j - i < 2) return;
    Route fresh{route[i]};
    if (!first) fresh.push_back(corner(route[i], route[j]));
    for (std::size_t k = i + 1; k < j; ++k) fresh.push_back(corner(route[k], first ? route[i] : route[j]));
    if (first) fresh.push_back(corner(route[j], route[i]));
    fresh.push_back(route[j]);
    const auto last = std::unique(fresh.begin(), fresh.end(), [](const Configuration& a, const Configuration& b) {
        return a.px == b.px && a.py == b.py && a.theta == b.theta;
    });
    fresh.erase(last, fresh.end());
    fresh.back() = route[j];  // doubles may not distinguish it from the one before
    replace(i, j, std::move(fresh));
}

// Join two places on the path anew: by a turn and a straight way, in either order, or by one rotation.
void Shortcut::attempt() {
    if (way.costs.prefer() && random() < 0.2) return steer();
    if (way.nearness && random() < 0.2) return straighten();
    const auto place = [&](double where) {  // the pose at the start of its motion, and the place
        const auto after = std::upper_bound(at.begin() + 1, at.end() - 1, where);
        const auto k = static_cast<std::size_t>(after - at.begin()) - 1;
        const double share = (where - at[k]) / std::max(at[k + 1] - at[k], 1e-300);
        if (random() < 0.5) {  // an end of the motion itself
            const std::size_t end = share > 0.5 ? k + 1 : k;
            return std::pair{end, std::optional<Configuration>{}};
        }
        const auto [x, y, theta] = along(route[k], route[k + 1], share);
        return std::pair{k, std::optional{way.grid.exact(x, y, theta)}};
    };
    double one = random() * length(), two = random() * length();
    // prefer near places: straight ways between far ones are rare in a maze
    if (random() < 0.5) two = std::clamp(one + (two - one) * random() * random(), 0.0, length());
    if (one > two) std::swap(one, two);
    const auto [i, p] = place(one);
    const auto [j, q] = place(two);
    const std::size_t last = q ? j + 1 : j;  // the old path is kept up to i and from `last`
    if (last <= i || (last == i + 1 && !p && !q)) return;
    const Configuration &a = p ? *p : route[i], &b = q ? *q : route[j];
    for (int kind = way.center && turn_between(a, b) == 0 ? 2 : 0; kind < 3; ++kind) {
        Route fresh{route[i]};
        if (p) fresh.push_back(a);
        if (kind == 0) fresh.push_back(corner(a, b));
        if (kind == 1) fresh.push_back(corner(b, a));
        fresh.push_back(b);
        if (q) fresh.push_back(route[last]);
        if (replace(i, last, std::move(fresh))) return;
    }
    if (!way.costs.prefer()) return;
    for (const Route& driven : way.driven(a, b)) {
        Route fresh{route[i]};
        fresh.insert(fresh.end(), driven.begin() + !p, driven.end());
        if (q) fresh.push_back(route[last]);
        if (replace(i, last, std::move(fresh))) return;
    }
}

}  // namespace cfree
