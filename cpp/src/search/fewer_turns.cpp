// Shortest route through layers of nodes, one layer for each place; edges are checked when a shortest route needs them.
#include "cfree/search/fewer_turns.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

constexpr std::size_t most_orientations = 8;
constexpr int checks_each = 12;           // motions checked for each pose, at most
constexpr double off_arc = 0.0625;        // radii by which a straight way may be beside an arc
constexpr double most_arc_parts = 8;      // of an arc

bool are_parallel(const Configuration& a, const Configuration& b) { return a.hx * b.hy == a.hy * b.hx; }
bool are_one(const Configuration& a, const Configuration& b) {
    return a.px == b.px && a.py == b.py && are_parallel(a, b) && a.x * b.unit == b.x * a.unit && a.y * b.unit == b.y * a.unit;
}

// Orientations of the start, the goal, and others on the way.
std::vector<const Configuration*> orientations(const Route& route) {
    std::vector<const Configuration*> all;
    const auto add = [&](const Configuration& q) {
        if (std::none_of(all.begin(), all.end(), [&](const Configuration* other) { return are_parallel(*other, q); })) all.push_back(&q);
    };
    add(route.front()), add(route.back());
    const std::size_t stride = route.size() / most_orientations + 1;
    for (std::size_t k = stride; k + 1 < route.size() && all.size() < most_orientations; k += stride) add(route[k]);
    return all;
}

// Pose at a place, turned about a point of the robot.
Configuration turned(const Way& way, const Configuration& at, const Configuration& as, const Place& about) {
    const auto [c, s] = cosine_sine(at.theta);
    const auto [u, v] = cosine_sine(as.theta);
    const double x = at.px + (c - u) * about.x - (s - v) * about.y, y = at.py + (s - v) * about.x + (c - u) * about.y;
    return corner(way.grid.exact(x, y, as.theta), as);
}

// A path with poses between its own, which are numbered.
struct Divided {
    Marked path;
    std::vector<std::size_t> own;
};

// The path with poses on its arcs, as far as rounding leaves their parts free.
Divided divided(const Way& way, const Marked& path) {
    Marked all{{path.route.front()}, {path.mark.front()}};
    std::vector<std::size_t> own{0};
    for (std::size_t k = 1; k < path.route.size(); ++k) {
        const Configuration &a = path.route[k - 1], &b = path.route[k];
        const double from = path.mark[k - 1], to = path.mark[k];
        const double count = std::ceil(std::sqrt(travel_between(a, b) * std::abs(turn_between(a, b)) / (8 * off_arc * way.costs.weight)));
        Marked parts{{a}, {from}};
        for (double n = 1; n < std::min(count, most_arc_parts); ++n) {
            const double share = n / std::min(count, most_arc_parts);
            const auto [x, y, theta] = along(a, b, share);
            parts.route.push_back(way.grid.exact(x, y, theta)), parts.mark.push_back(from + share * (to - from));
        }
        parts.route.push_back(b), parts.mark.push_back(to);
        all.append(parts.route.size() == 2 || way.joins(parts) ? parts : Marked{{a, b}, {from, to}});
        own.push_back(all.route.size() - 1);
    }
    return {std::move(all), std::move(own)};
}

struct Edge {
    double cost = HUGE_VAL;
    bool is_known = false;
};

// Layers of nodes: first the pose of the path, then that pose turned.
class Layers {
public:
    Layers(const Way& way, Divided path);
    Marked best();

private:
    using Chain = std::vector<std::pair<std::size_t, std::size_t>>;  // nodes reached in each layer and, after a turn, left from
    Edge& turn(std::size_t k, std::size_t from, std::size_t to) { return turns[(k * width + from) * width + to]; }
    Edge& move(std::size_t k, std::size_t node) { return moves[k * width + node]; }
    const Configuration& pose(std::size_t k, std::size_t node) const { return nodes[k * width + node]; }
    Chain cheapest();
    Marked along(const Chain& chain) const;
    bool is_checked(Edge& edge, std::size_t k, const Configuration& a, const Configuration& b, std::size_t to);

    const Way& way;
    const Marked path;
    const std::vector<std::size_t> own;
    std::size_t count, width = 1;
    std::vector<Configuration> nodes;
    std::vector<Edge> turns, moves;  // within a layer; to the same node of the next
    int left;
};

Layers::Layers(const Way& w, Divided p)
    : way(w), path(std::move(p.path)), own(std::move(p.own)), count(path.route.size()), left(checks_each * static_cast<int>(count)) {
    const auto others = orientations(path.route);
    const Place center = way.center.value_or(Place{0, 0, 0});
    const bool is_beside = center.x != 0 || center.y != 0;
    width += (is_beside ? 2 : 1) * others.size();
    for (const Configuration& at : path.route) {
        nodes.push_back(at);
        for (const Configuration* as : others) nodes.push_back(corner(at, *as));
        if (!is_beside) continue;
        for (const Configuration* as : others) nodes.push_back(turned(way, at, *as, center));
    }
    turns.resize(count * width * width), moves.resize(count * width);
    const auto is_about = [&](std::size_t node) { return (node - 1) / others.size(); };  // the point about which it is turned
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t i = 0; i < width; ++i) {
            for (std::size_t j = 0; j < width; ++j)
                if (i == 0 || j == 0 || is_about(i) == is_about(j)) turn(k, i, j).cost = cost_between(pose(k, i), pose(k, j), way.costs);
            if (k + 1 < count) move(k, i) = {cost_between(pose(k, i), pose(k + 1, i), way.costs), i == 0};
        }
}

Layers::Chain Layers::cheapest() {
    std::vector<double> in(width, HUGE_VAL), out(width);
    std::vector<std::size_t> from(count * width, 0);
    in[0] = 0;
    for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t j = 0; j < width; ++j) {
            out[j] = in[j], from[k * width + j] = j;
            for (std::size_t i = 0; i < width; ++i)
                if (const double cost = in[i] + turn(k, i, j).cost; cost < out[j]) out[j] = cost, from[k * width + j] = i;
        }
        for (std::size_t j = 0; j < width; ++j) in[j] = out[j] + move(k, j).cost;
    }
    Chain chain(count);
    for (std::size_t k = count, node = 0; k-- > 0; node = chain[k].first) chain[k] = {from[k * width + node], node};
    return chain;
}

// False if the motion was unknown.
bool Layers::is_checked(Edge& edge, std::size_t k, const Configuration& a, const Configuration& b, std::size_t to) {
    if (std::exchange(edge.is_known, true) || are_one(a, b)) return true;
    if (--left < 0 || !way.joins(a, b, path.mark[k], path.mark[to])) edge.cost = HUGE_VAL;
    return false;
}

// Route along a chain, without poses between those of the path where these are joined without them.
Marked Layers::along(const Chain& chain) const {
    Marked found{{path.route.front()}, {path.mark.front()}};
    const auto add = [&](std::size_t k, std::size_t node) {
        if (!are_one(found.route.back(), pose(k, node))) found.route.push_back(pose(k, node)), found.mark.push_back(path.mark[k]);
    };
    for (std::size_t n = 0; n < own.size(); ++n) {
        const std::size_t k = own[n], node = chain[k].second, next = own[std::min(n + 1, own.size() - 1)];
        add(k, chain[k].first), add(k, node);
        bool is_direct = true;
        for (std::size_t m = k + 1; m < next; ++m) is_direct = is_direct && chain[m] == std::pair{node, node};
        if (is_direct && (next <= k + 1 || way.joins(pose(k, node), pose(next, node), path.mark[k], path.mark[next]))) continue;
        for (std::size_t m = k + 1; m < next; ++m) add(m, chain[m].first), add(m, chain[m].second);
    }
    return found;
}

Marked Layers::best() {
    for (;;) {
        heed_stop();
        const Chain chain = cheapest();
        bool all_known = true;
        for (std::size_t k = 0; k < count; ++k) {
            const auto [i, j] = chain[k];
            if (i != j) all_known &= is_checked(turn(k, i, j), k, pose(k, i), pose(k, j), k);
            if (k + 1 < count) all_known &= is_checked(move(k, j), k, pose(k, j), pose(k + 1, j), k + 1);
        }
        if (!all_known) continue;
        return along(chain);
    }
}

}  // namespace

Marked with_fewer_turns(const Way& way, const Marked& path) {
    const Route& route = path.route;
    double turning = 0;
    for (std::size_t k = 1; k < route.size(); ++k) turning += std::abs(turn_between(route[k - 1], route[k]));
    if (turning == 0 || (route.size() < 3 && travel_between(route.front(), route.back()) == 0)) return path;
    Marked found = Layers(way, divided(way, path)).best();
    return cost_of(found.route, way.costs) < cost_of(route, way.costs) ? found : path;
}

}  // namespace cfree
