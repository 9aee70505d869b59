// Costs of motions, and tests of their required distances; theory, "Paths".
#include "cfree/search/way.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"

namespace cfree {

constexpr double radii_around = 2;  // radii of way, before and after

void Marked::append(const Marked& further) {
    route.insert(route.end(), further.route.begin() + 1, further.route.end());
    mark.insert(mark.end(), further.mark.begin() + 1, further.mark.end());
}

double cost_between(const Configuration& a, const Configuration& b, const Costs& costs) {
    const double turn = turn_between(a, b), turning = costs.weight * std::abs(turn);
    if (!costs.prefer()) return travel_between(a, b) + turning;
    const Place& axle = costs.axle;
    const auto [ca, sa] = cosine_sine(a.theta);
    const auto [cb, sb] = cosine_sine(b.theta);
    const double dx = b.px - a.px + (cb - ca) * axle.x - (sb - sa) * axle.y, dy = b.py - a.py + (sb - sa) * axle.x + (cb - ca) * axle.y;
    const double travel = arc_over(norm(dx, dy), turn), heading = a.theta + 0.5 * turn + axle.theta;  // constant, like the chord's
    const auto [c, s] = cosine_sine(heading);
    const double ahead = c * dx + s * dy, across = c * dy - s * dx;
    const double factor = norm(ahead < 0 ? costs.backward * ahead : ahead, costs.sideways * across) / std::max(norm(dx, dy), 1e-300);
    return factor * travel + turning + (costs.turning - 1) * std::max(0.0, turning - travel);
}

double cost_of(const Route& route, const Costs& costs) {
    double sum = 0;
    for (std::size_t k = 1; k < route.size(); ++k) sum += cost_between(route[k - 1], route[k], costs);
    return sum;
}

std::vector<double> costs_along(const Route& route, const Costs& costs) {
    std::vector<double> at{0};
    for (std::size_t k = 1; k < route.size(); ++k) at.push_back(at.back() + cost_between(route[k - 1], route[k], costs));
    return at;
}

Configuration corner(const Configuration& position, const Configuration& orientation) {
    Configuration c = position;
    c.hx = orientation.hx, c.hy = orientation.hy, c.theta = orientation.theta;
    return c;
}

static bool moves(const Configuration& a, const Configuration& b) { return a.px != b.px || a.py != b.py; }

std::vector<Route> turned_or_straight(const Configuration& a, const Configuration& b) {
    std::vector<Route> ways{{a, b}};
    if (turn_between(a, b) != 0 && moves(a, b)) ways.push_back({a, corner(a, b), b}), ways.push_back({a, corner(b, a), b});
    return ways;
}

Way Way::asking(Marked along, std::vector<double> what) const {
    Places at;
    for (const Configuration& q : along.route) at.x.push_back(q.px), at.y.push_back(q.py), at.theta.push_back(q.theta);
    return {checker, nearness, grid, limits, costs, per_motion, center, may_turn, std::move(along), std::move(what), std::move(at)};
}

std::size_t Way::nearest(const Place& at, double from, double to) const {
    const auto& mark = ridge.mark;
    const double around = radii_around * costs.weight;
    const auto begin = std::lower_bound(mark.begin(), mark.end(), from - around), end = std::upper_bound(begin, mark.end(), to + around);
    const auto index = [&](auto place) { return static_cast<std::size_t>(place - mark.begin()); };
    std::size_t best = std::min(index(begin), mark.size() - 1);
    double least = HUGE_VAL;
    std::array<double, 32> squares;  // of distances: a loop without branches, which compilers turn into vectors
    for (std::size_t first = index(begin); first < index(end); first += squares.size()) {
        const std::size_t count = std::min(squares.size(), index(end) - first);
        for (std::size_t k = 0; k < count; ++k) {
            const double dx = places.x[first + k] - at.x, dy = places.y[first + k] - at.y, turn = std::abs(places.theta[first + k] - at.theta);
            const double least_turn = costs.weight * (turn > std::numbers::pi ? turn - 2 * std::numbers::pi : turn);
            squares[k] = dx * dx + dy * dy + least_turn * least_turn;
        }
        for (std::size_t k = 0; k < count; ++k)
            if (squares[k] < least) least = squares[k], best = first + k;
    }
    return best;
}

bool Way::joins(const Configuration& a, const Configuration& b, double from, double to) const {
    if (!nearness) return is_free(a, b);
    double least = HUGE_VAL;
    const auto need = [&](double share) {
        const double distance = distances[nearest(along(a, b, share), from, to)];
        least = std::min(least, distance);
        return distance;
    };
    if (!nearness->keeps(a, b, need)) return false;
    return (least > nearness->least() && is_within(a, b)) || is_free(a, b);
}

bool Way::joins(const Marked& path) const {
    for (std::size_t k = 1; k < path.route.size(); ++k)
        if (!joins(path.route[k - 1], path.route[k], path.mark[k - 1], path.mark[k])) return false;
    return true;
}

bool Way::keeps(const Configuration& a, const Configuration& b, double distance) const {
    if (!nearness->keeps(a, b, [&](double) { return distance; })) return false;
    return (distance > nearness->least() && is_within(a, b)) || is_free(a, b);
}

bool Way::is_free(const Configuration& a, const Configuration& b) const {
    return !(nearness && nearness->overlaps(a, b)) && checker.is_free(motion_between(a, b));
}

// True if the motion stays within the limits: its arc is beside the chord by at most an eighth.
bool Way::is_within(const Configuration& a, const Configuration& b) const {
    const double off = travel_between(a, b) * std::abs(turn_between(a, b)) / 8 + nearness->least();
    const auto [x0, x1] = std::minmax(a.px, b.px);
    const auto [y0, y1] = std::minmax(a.py, b.py);
    return limits.x0 < x0 - off && x1 + off < limits.x1 && limits.y0 < y0 - off && y1 + off < limits.y1;
}

Marked Way::marked(Route route, double from, double to) const {
    std::vector<double> mark{from};
    for (std::size_t k = 1; k + 1 < route.size(); ++k) {
        const Configuration& q = route[k];
        const double there = ridge.mark.empty() ? from : ridge.mark[nearest({q.px, q.py, q.theta}, from, to)];
        mark.push_back(std::clamp(there, mark.back(), to));
    }
    mark.push_back(to);
    return {std::move(route), std::move(mark)};
}

std::vector<Route> Way::driven(const Configuration& a, const Configuration& b) const {
    const double dx = b.px - a.px, dy = b.py - a.py, direction = arc_tangent(dy, dx);
    std::vector<Route> ways;
    for (const double sign : {1.0, -1.0}) {
        const double heading = sign > 0 ? direction : direction + std::numbers::pi;
        const Configuration straight = turned(a, heading);
        ways.push_back({a, straight, corner(b, straight), b});
        ways.push_back({a, turned(a, 2 * heading - b.theta), b});  // an arc's chord is half way between its tangents
        ways.push_back({a, turned(b, 2 * heading - a.theta), b});
        // two arcs that meet on the line between the ends of tangents, all four parts as long
        const CosineSine p = cosine_sine(a.theta), q = cosine_sine(b.theta);
        const double ux = sign * p.c, uy = sign * p.s, vx = sign * q.c, vy = sign * q.s;
        const double both = dx * (ux + vx) + dy * (uy + vy), bend = 2 * (1 - ux * vx - uy * vy), square = dx * dx + dy * dy;
        const double root = std::sqrt(both * both + bend * square);
        const double length = square / (both + root);  // the positive root of bend l^2 + 2 both l - square
        if (!(both + root > 1e-9 * std::sqrt(square))) continue;
        const double x = dx - length * (ux + vx), y = dy - length * (uy + vy);
        const double theta = arc_tangent(sign * y, sign * x);
        ways.push_back({a, grid.exact(0.5 * (a.px + b.px + length * (ux - vx)), 0.5 * (a.py + b.py + length * (uy - vy)), theta), b});
    }
    return ways;
}

Marked Way::simplest(const Configuration& a, const Configuration& b, double from, double to, double most) const {
    std::vector<Route> ways = turned_or_straight(a, b);
    if (costs.prefer() && moves(a, b)) {
        for (Route& way : driven(a, b)) ways.push_back(std::move(way));
        std::stable_sort(ways.begin(), ways.end(), [&](const Route& r, const Route& s) { return cost_of(r, costs) < cost_of(s, costs); });
    }
    for (Route& way : ways) {
        if (cost_of(way, costs) > most) continue;
        if (Marked found = marked(std::move(way), from, to); joins(found)) return found;
    }
    return {};
}

}  // namespace cfree
