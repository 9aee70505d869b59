// Poses of a path left out or moved while its motions stay free; theory, "Paths".
#include <algorithm>
#include <cmath>

#include "cfree/search/rrt_connect.hpp"

namespace cfree {

namespace {

constexpr double least_gain = 1e-9;  // of the length

}  // namespace

Shortcut::Shortcut(const MotionChecker& c, Grid g, double w, Route r, std::uint64_t seed)
    : checker(c), grid(g), weight(w), route(std::move(r)), random(seed) {
    measure();
}

double Shortcut::cost(const Configuration& a, const Configuration& b) const {
    return travel_between(a, b) + weight * std::abs(turn_between(a, b));
}

double Shortcut::cost(const Route& r) const {
    double sum = 0;
    for (std::size_t k = 1; k < r.size(); ++k) sum += cost(r[k - 1], r[k]);
    return sum;
}

bool Shortcut::is_free(const Route& r) {
    for (std::size_t k = 1; k < r.size(); ++k) {
        --left;
        if (!checker.is_free(motion_between(r[k - 1], r[k]))) return false;
    }
    return true;
}

void Shortcut::measure() {
    at.assign(1, 0);
    for (std::size_t k = 1; k < route.size(); ++k) at.push_back(at.back() + cost(route[k - 1], route[k]));
}

void Shortcut::run(int checks) {
    left = checks;
    while (left > 0 && route.size() > 1 && length() > 0) {
        --left;
        attempt();
    }
}

// Two places on the path, joined anew: a turn and a straight way, in either order, or one rotation.
void Shortcut::attempt() {
    const auto place = [&](double where) {  // the pose that begins its motion, and it
        const auto after = std::upper_bound(at.begin() + 1, at.end() - 1, where);
        const auto k = static_cast<std::size_t>(after - at.begin()) - 1;
        const double share = (where - at[k]) / std::max(at[k + 1] - at[k], 1e-300);
        if (random() < 0.5) {  // an end of the motion itself
            const std::size_t end = share > 0.5 ? k + 1 : k;
            return std::pair{end, std::optional<Configuration>{}};
        }
        const auto [x, y, theta] = along(route[k], route[k + 1], share);
        return std::pair{k, std::optional{grid.exact(x, y, theta)}};
    };
    double one = random() * length(), two = random() * length();
    // nearby places more often than not: far ones seldom see each other in a maze
    if (random() < 0.5) two = std::clamp(one + (two - one) * random() * random(), 0.0, length());
    if (one > two) std::swap(one, two);
    const auto [i, p] = place(one);
    const auto [j, q] = place(two);
    const std::size_t last = q ? j + 1 : j;  // the old path is kept up to i and from `last`
    if (last <= i || (last == i + 1 && !p && !q)) return;
    const Configuration &a = p ? *p : route[i], &b = q ? *q : route[j];
    const auto old = route.begin() + static_cast<std::ptrdiff_t>(i);
    const double before = at[last] - at[i];
    const auto corner = [&](const Configuration& position, const Configuration& orientation) {
        Configuration c = position;
        c.hx = orientation.hx, c.hy = orientation.hy, c.theta = orientation.theta;
        return c;
    };
    for (int kind = 0; kind < 3; ++kind) {
        Route fresh{route[i]};
        if (p) fresh.push_back(a);
        if (kind == 0) fresh.push_back(corner(a, b));
        if (kind == 1) fresh.push_back(corner(b, a));
        fresh.push_back(b);
        if (q) fresh.push_back(route[last]);
        const double gain = before - cost(fresh), least = least_gain * length();
        if (gain < -least || (gain <= least && fresh.size() > last - i)) continue;
        if (!is_free(fresh)) continue;
        Route whole(route.begin(), old);
        whole.insert(whole.end(), fresh.begin(), fresh.end());
        whole.insert(whole.end(), route.begin() + static_cast<std::ptrdiff_t>(last) + 1, route.end());
        route = std::move(whole);
        measure();
        return;
    }
}

}  // namespace cfree
