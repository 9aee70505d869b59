// Lead from any free path to the ridge beside it, level by level, and from there to a short path; theory, "Paths".
#include "cfree/search/balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "cfree/search/rrt_connect.hpp"
#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"
#include "search/farthest.hpp"

namespace cfree {

namespace {

constexpr double lowest = 1.0 / 64;                        // level of distance, in radii
constexpr double to_next = 8, near_last = 0.5;             // factor from one level to the next; none is above this share of the last one
constexpr double share_asked = 0.7, share_between = 0.85;  // share of a ridge's distances; factor from one level to the next
constexpr double gained = 0.7;                             // least share of a level's possible distance, to try the next
constexpr double narrow = 1.0 / 16, climbs_on = 1.1;       // radii; times the narrowest place
constexpr double radii_beside = 3;                         // radii of way before and after it
constexpr double worth_of_motion = 0.1;                    // in radii
constexpr double not_much = 1.08;                          // longer
constexpr std::size_t most_nodes = 40;                     // nodes, joined each with each
constexpr int most_fails = 2;                              // failures before longer joins are skipped
constexpr double wider = 1.3;                              // factor by which another way must be wider than a narrow place
constexpr double almost = 0.9, straight = 1e-3;            // share of a distance that suffices; negligible turning per travel
constexpr double shortest_line = 0.05;                     // radii
constexpr double worth_turning = 2, comfortable = 0.5;     // times a distance; radii, more of which are not worth a turn
constexpr double step_of_guess = 0.25;                     // radii
constexpr int guesses_by_pose = 300, most_guesses = 30000;  // to find them: more on a way that was hard to find
constexpr int guesses_at_once = 500, runs = 4;              // at one place
constexpr std::array beside_place = {1.0, 4.0};             // radii: of the area for that

// Replace many motions by a few that cost as much, between poses of the path: doubling, then halving.
Marked pruned(const Way& way, const Marked& path) {
    const Route& route = path.route;
    const std::vector<double> at = costs_along(route, way.costs);
    Marked found{{route.front()}, {path.mark.front()}};
    for (std::size_t i = 0; i + 1 < route.size();) {
        heed_stop();
        Marked best{{route[i], route[i + 1]}, {path.mark[i], path.mark[i + 1]}};
        i = farthest(i, route.size() - 1, [&](std::size_t j) {
            Marked simple = way.simplest(route[i], route[j], path.mark[i], path.mark[j], (at[j] - at[i]) * (1 + 1e-9));
            if (simple.route.empty()) return false;
            best = std::move(simple);
            return true;
        });
        found.append(best);
    }
    return found;
}

// Shortest path over some poses of another, and poses near them with the orientation of the start or the goal.
Marked shortest(const Way& way, const Marked& path, std::size_t most) {
    const Route& route = path.route;
    struct Node {
        Configuration pose;
        std::size_t of;  // the pose of the path
        enum As { itself, start, goal, ahead } as;
    };
    std::vector<Node> nodes;
    const std::size_t stride = (route.size() + most - 1) / most;
    const auto turned = [&](std::size_t k, const Configuration& as, Node::As what) {
        if (k == 0 || k + 1 == route.size() || route[k].theta == as.theta) return;
        const double enough = way.distances[k];
        Place q{route[k].px, route[k].py, as.theta};
        if (climb(way, q, {0, 0, 1}, enough) >= enough) nodes.push_back({corner(way.grid.exact(q.x, q.y, q.theta), as), k, what});
    };
    for (std::size_t k = 0; k + 1 < route.size() + stride; k += stride) {
        k = std::min(k, route.size() - 1);
        turned(k, route.front(), Node::start);
        nodes.push_back({route[k], k, Node::itself});
        if (route.front().theta != route.back().theta) turned(k, route.back(), Node::goal);
        if (!way.costs.prefer() || k == 0 || k + 1 == route.size()) continue;
        const Configuration &before = route[k - std::min(k, stride)], &beyond = route[std::min(k + stride, route.size() - 1)];
        const double ahead = arc_tangent(beyond.py - before.py, beyond.px - before.px);
        for (const double theta : {ahead, ahead + std::numbers::pi}) turned(k, way.turned(route[k], theta), Node::ahead);
    }
    const std::size_t count = nodes.size();
    struct Edge {
        double cost;
        bool known = false;
        int fails = 0;  // failures of edges between intermediate poses of one orientation
        Marked way;
    };
    const auto price = [&](const Route& r) { return cost_of(r, way.costs) + way.per_motion * static_cast<double>(r.size() - 1); };
    std::vector<Edge> edges(count * count);
    for (std::size_t i = 0, last = 0; i < count; ++i) {
        for (std::size_t j = i + 1; j < count; ++j) edges[i * count + j].cost = cost_between(nodes[i].pose, nodes[j].pose, way.length()) + way.per_motion;
        if (nodes[i].as != Node::itself || i == 0) continue;
        Edge& e = edges[last * count + i];
        const auto begin = static_cast<std::ptrdiff_t>(nodes[last].of), end = static_cast<std::ptrdiff_t>(nodes[i].of) + 1;
        e.way = {{route.begin() + begin, route.begin() + end}, {path.mark.begin() + begin, path.mark.begin() + end}};
        e.cost = price(e.way.route), e.known = true, last = i;
    }
    for (;;) {
        heed_stop();
        std::vector<double> best(count, HUGE_VAL);
        std::vector<std::size_t> from(count, 0);
        best[0] = 0;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = i + 1; j < count; ++j)
                if (const double c = best[i] + edges[i * count + j].cost; c < best[j]) best[j] = c, from[j] = i;
        std::vector<Edge*> chain;
        for (std::size_t j = count - 1; j != 0; j = from[j]) chain.push_back(&edges[from[j] * count + j]);
        bool all_known = true;
        for (Edge* e : chain) {
            if (e->known) continue;
            const auto k = static_cast<std::size_t>(e - edges.data());
            const Node &a = nodes[k / count], &b = nodes[k % count];
            all_known = false, e->known = true;
            e->way = way.simplest(a.pose, b.pose, path.mark[a.of], path.mark[b.of], HUGE_VAL);
            e->cost = e->way.route.empty() ? HUGE_VAL : price(e->way.route);
            if (!e->way.route.empty()) continue;
            for (std::size_t i = 0; i <= k / count; ++i)
                for (std::size_t j = k % count; j < count; ++j)
                    if (Edge& f = edges[i * count + j]; !f.known && nodes[i].as == a.as && nodes[j].as == b.as && ++f.fails == most_fails)
                        f.known = true, f.cost = HUGE_VAL;
        }
        if (!all_known) continue;
        Marked found{{route.front()}, {path.mark.front()}};
        for (std::size_t k = chain.size(); k-- > 0;) found.append(chain[k]->way);
        return found;
    }
}

// Least distance of all motions.
double narrowest_of(const Ridge& top) {
    return top.distance.size() < 3 ? top.distance.front() : *std::min_element(top.distance.begin() + 1, top.distance.end() - 1);
}

// Replace a part of a ridge by another ridge.
void replace(Ridge& top, std::size_t i, std::size_t j, const Ridge& by) {
    const auto put = [&](auto& values, const auto& with) {
        values.erase(values.begin() + static_cast<std::ptrdiff_t>(i), values.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        values.insert(values.begin() + static_cast<std::ptrdiff_t>(i), with.begin(), with.end());
    };
    std::vector<double> mark = by.path.mark, distance = by.distance;
    distance.front() = std::min(distance.front(), top.distance[i]), distance.back() = std::min(distance.back(), top.distance[j]);
    for (double& m : mark) m += top.path.mark[i];
    const double longer = mark.back() - top.path.mark[j];
    for (std::size_t k = j; k < top.path.mark.size(); ++k) top.path.mark[k] += longer;
    put(top.path.mark, mark), put(top.path.route, by.path.route), put(top.distance, distance);
}

// Search a new way from one pose of a ridge to another, by two trees, with a distance.
Route another_way(const Way& way, const Ridge& top, std::size_t i, std::size_t j, double asked, double beside, int& guesses) {
    const Route& route = top.path.route;
    const double radius = way.costs.weight, step = step_of_guess * radius;
    Area area{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (std::size_t k = i; k <= j; ++k) {
        area.x0 = std::min(area.x0, route[k].px - beside), area.x1 = std::max(area.x1, route[k].px + beside);
        area.y0 = std::min(area.y0, route[k].py - beside), area.y1 = std::max(area.y1, route[k].py + beside);
    }
    area = {std::max(area.x0, way.limits.x0), std::max(area.y0, way.limits.y0), std::min(area.x1, way.limits.x1), std::min(area.y1, way.limits.y1)};
    const auto seems = [&](const Place& a, const Place& b) {
        const double length = norm(b.x - a.x, b.y - a.y) + radius * std::abs(wrapped(b.theta - a.theta));
        const auto keeps = [&](const Place& q) { return !way.nearness->is_nearer(q, asked); };
        return all_along(a, b, static_cast<int>(length / step) + 1, keeps);
    };
    const auto joins = [&](const Configuration& a, const Configuration& b) { return way.keeps(a, b, asked); };
    RrtConnect search({seems, joins}, way.grid, area, radius, route[i], route[j], 0, way.may_turn ? Growth{} : without_turns);
    Route found;
    for (int k = 0; k < runs && guesses > 0 && found.empty(); ++k, guesses -= guesses_at_once) found = search.run(guesses_at_once);
    return found;
}

// Part of a ridge, its possible replacement, and the distance that this keeps.
struct Detour {
    std::size_t i, j;
    Route route;
    double kept;
};

// Put in the detour's ridge, or the detour itself if its ridge is narrower.
void put_in(const Way& way, Ridge& top, const Detour& by, double level) {
    Ridge part = ridge(way, by.route, level);
    if (narrowest_of(part) < by.kept) part = {{by.route, costs_along(by.route, way.length())}, std::vector<double>(by.route.size(), by.kept)};
    replace(top, by.i, by.j, part);
}

// Detour straight into a narrow place, with the turn before it: follow the line of a translation beyond the place back until a
// pose before the place can be joined to its end.
Detour straight_into(const Way& way, const Ridge& top, std::size_t narrowest, double asked) {
    const auto& at = top.path.mark;
    const Route& route = top.path.route;
    const double radius = way.costs.weight;
    for (std::size_t m = narrowest; m + 1 < route.size() && at[m] - at[narrowest] < radii_beside * radius; ++m) {
        heed_stop();
        const Configuration &p = route[m], &q = route[m + 1];
        const double length = norm(p.px - q.px, p.py - q.py), kept = almost * std::min(top.distance[m], top.distance[m + 1]);
        if (kept < asked || length < shortest_line * radius || radius * std::abs(turn_between(p, q)) > straight * length) continue;
        const double past = norm(route[narrowest].px - q.px, route[narrowest].py - q.py);
        for (const double radii : {0.25, 0.5, 1.0, 2.0}) {
            const double by = (past + radii * radius) / length;
            const Configuration end = corner(way.grid.exact(q.px + by * (p.px - q.px), q.py + by * (p.py - q.py), q.theta), q);
            if (!way.keeps(end, q, kept)) break;
            for (std::size_t k = narrowest; k-- > 0 && at[narrowest] - at[k] < (radii + radii_beside) * radius;) {
                if (top.distance[k] < kept) continue;
                for (const Route& join : turned_or_straight(route[k], end)) {
                    bool is_joined = true;
                    for (std::size_t n = 1; is_joined && n < join.size(); ++n) is_joined = way.keeps(join[n - 1], join[n], kept);
                    if (!is_joined) continue;
                    Detour found{k, m + 1, join, kept};
                    found.route.push_back(q);
                    return found;
                }
            }
        }
    }
    return {};
}

// Detour straight past a narrow place, in either direction.
Detour straight_past(const Way& way, const Ridge& top, std::size_t narrowest, double asked) {
    if (Detour found = straight_into(way, top, narrowest, asked); !found.route.empty()) return found;
    Ridge back = top;
    std::reverse(back.path.route.begin(), back.path.route.end());
    std::reverse(back.distance.begin(), back.distance.end());
    std::reverse(back.path.mark.begin(), back.path.mark.end());
    for (double& m : back.path.mark) m = top.path.mark.back() - m;
    const std::size_t last = top.distance.size() - 1;
    Detour found = straight_into(way, back, last - narrowest, asked);
    std::reverse(found.route.begin(), found.route.end());
    return {last - found.j, last - found.i, std::move(found.route), found.kept};
}

// Lead past the narrowest untried place by another, wider way. False: there is none.
bool past_narrowest(const Way& way, Ridge& top, double level, Route& tried, int& guesses) {
    const auto& at = top.path.mark;
    const Route& route = top.path.route;
    const double radius = way.costs.weight;
    while (guesses > 0) {
        std::size_t narrowest = 0;
        double least = HUGE_VAL;
        const auto is_new = [&](std::size_t k) {
            return at[k] > radius && at[k] < at.back() - radius && std::none_of(tried.begin(), tried.end(), [&](const Configuration& q) {
                return cost_between(q, route[k], way.length()) < radius;
            });
        };
        for (std::size_t k = 0; k < at.size(); ++k)
            if (top.distance[k] < least && is_new(k)) least = top.distance[k], narrowest = k;
        if (least == HUGE_VAL) return false;
        tried.push_back(route[narrowest]);
        const double asked = least > way.nearness->least() ? wider * least : 0.5 * lowest * radius;
        if (least < narrow * radius)
            if (const Detour found = straight_past(way, top, narrowest, asked); !found.route.empty()) {
                put_in(way, top, found, level);
                return true;
            }
        std::size_t i = narrowest, j = narrowest;
        while (i > 0 && (at[narrowest] - at[i] < radius || top.distance[i] < asked)) --i;
        while (j + 1 < at.size() && (at[j] - at[narrowest] < radius || top.distance[j] < asked)) ++j;
        if (top.distance[i] < asked || top.distance[j] < asked) continue;
        Route found;
        for (const double beside : beside_place)
            if (found.empty()) found = another_way(way, top, i, j, asked, beside * radius, guesses);
        if (found.empty()) continue;
        put_in(way, top, {i, j, found, asked}, level);
        return true;
    }
    return false;
}

// Upper bound of the distances of parts: that of their ends, a radius from start and goal.
double most_distance(const Way& way, const Route& route) {
    const auto distance = [&](const Configuration& q) { return way.nearness->distance({q.px, q.py, q.theta}, HUGE_VAL); };
    return std::min({distance(route.front()), distance(route.back()), cost_of(route, way.length())}) + way.costs.weight;
}

// Climb from the ridge itself, about its narrowest place, while that makes it wider.
void climb_on(const Way& way, Ridge& top, double level) {
    const double radius = way.costs.weight;
    for (double least; top.distance.size() > 2 && (least = narrowest_of(top)) < narrow * radius;) {
        const auto& at = top.path.mark;
        const auto begin = top.distance.begin();
        const auto place = static_cast<std::size_t>(std::find(begin + 1, top.distance.end() - 1, least) - begin);
        std::size_t i = place, j = place;
        while (i > 0 && at[place] - at[i] < radii_beside * radius) --i;
        while (j + 1 < at.size() && at[j] - at[place] < radii_beside * radius) ++j;
        const auto from = top.path.route.begin() + static_cast<std::ptrdiff_t>(i);
        const Ridge part = ridge(way, Route(from, from + static_cast<std::ptrdiff_t>(j - i) + 1), level);
        if (narrowest_of(part) < climbs_on * std::max(least, way.nearness->least())) break;
        replace(top, i, j, part);
    }
}

// Shortest path with a share of the possible distance in all parts, if it is not much longer than with only the first parts.
Balanced shortest_along(const Way& way, const Ridge& top, std::size_t nodes) {
    std::optional<Balanced> found;
    for (const int depth : {1, all_parts}) {
        Way along = way.asking(top.path, distances_asked(top, way.costs.weight, share_asked, depth));
        along.per_motion = worth_of_motion * way.costs.weight;
        Marked path = shortest(along, top.path, way.costs.prefer() ? most_nodes : nodes);
        if (!found || cost_of(path.route, way.costs) < not_much * cost_of(found->path.route, way.costs))
            found.emplace(Balanced{std::move(along), std::move(path)});
    }
    return std::move(*found);
}

// Ridge, the distance up to which it was pushed, and the greatest useful distance.
struct Pushed {
    Ridge ridge;
    double level, most;
};

// Push on to greater distances, until no part gains.
void push_on(const Way& way, Pushed& top) {
    const double radius = way.costs.weight;
    for (;;) {
        std::vector<double> asked = distances_asked(top.ridge, radius, share_between, all_parts);
        if (top.level == top.most || *std::max_element(asked.begin(), asked.end()) <= gained * share_between * top.level) return;
        top.level *= to_next;
        if (top.level >= near_last * top.most) top.level = top.most;
        top.ridge = ridge(way, pruned(way.asking(top.ridge.path, std::move(asked)), top.ridge.path).route, top.level);
    }
}

Pushed pushed(const Way& way, const Route& route, double up_to) {
    Way any = way;
    any.nearness = nullptr;
    const Route path = pruned(any, {route, std::vector<double>(route.size())}).route;
    const double most = std::min(most_distance(way, path), up_to), level = std::min(most, lowest * way.costs.weight);
    Pushed top{ridge(way, path, level), level, most};
    push_on(way, top);
    return top;
}

// Ridge beside a path, past its narrow places where there are wider ways.
Ridge widest(const Way& way, const Route& route, double up_to) {
    Pushed top = pushed(way, route, up_to);
    Route tried;
    for (int guesses = std::min(most_guesses, guesses_by_pose * static_cast<int>(route.size()));
         past_narrowest(way, top.ridge, top.level, tried, guesses);)
        push_on(way, top);
    climb_on(way, top.ridge, top.level);
    return std::move(top.ridge);
}

// True if a path turns only from the orientation of its start to that of its goal.
bool turns_least(const Route& route) {
    double turning = 0;
    for (std::size_t k = 1; k < route.size(); ++k) turning += std::abs(turn_between(route[k - 1], route[k]));
    return turning <= std::abs(turn_between(route.front(), route.back())) + straight;
}

// True if a turn widens the narrowest place of a ridge much.
bool gains_by_turning(const Way& way, const Ridge& top) {
    const Route& route = top.path.route;
    if (route.size() < 3) return false;
    const auto begin = top.distance.begin() + 1;
    const auto k = static_cast<std::size_t>(std::min_element(begin, top.distance.end() - 1) - top.distance.begin());
    Place q = route[k].place();
    const double enough = worth_turning * std::max(way.nearness->distance(q, HUGE_VAL), way.nearness->least());
    if (enough > comfortable * way.costs.weight) return false;
    Way turning = way;
    turning.may_turn = true;
    const Configuration &before = route[k - 1], &beyond = route[k + 1];
    return climb(turning, q, {beyond.px - before.px, beyond.py - before.py, way.costs.weight * turn_between(before, beyond)}, enough) >= enough;
}

}  // namespace

Balanced balanced(const Way& way, const Route& route, double up_to) {
    Way plain = way;  // preferences come last
    plain.costs = way.length();
    plain.may_turn = !(way.center && turns_least(route));
    Ridge top = widest(plain, route, up_to);
    if (!plain.may_turn && gains_by_turning(plain, top)) {
        plain.may_turn = true;
        top = widest(plain, route, up_to);
    }
    return shortest_along(way, top, std::min(most_nodes, 12 + route.size() / 2));
}

}  // namespace cfree
