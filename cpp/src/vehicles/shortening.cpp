// Random words instead of some legs, and shortest chains of words through windows of poses; theory, "Vehicles".
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"
#include "cfree/vehicles/driver.hpp"

namespace cfree {

namespace {

constexpr double least_gain = 1e-9;       // relative
constexpr int idle_at_most = 50;          // attempts in a row without gain, before a window
constexpr int tries_to_shorten = 4;
constexpr std::size_t farthest = 512;     // legs that one word replaces in the first pass: each attempt takes time for all of them
constexpr int most_legs = 12, stations = 7, copies = 2, most_struck = 150;
constexpr double worth = 1e-5;            // relative gain of a window
constexpr int bits = 0;
constexpr std::size_t no_leg = static_cast<std::size_t>(-1);

double travel_of(const Leg& leg) {
    double sum = 0;
    for (const Piece& p : leg.word.pieces) sum += std::abs(p.travel);
    return sum;
}

}  // namespace

Shortening::Shortening(Driver by, Legs legs, std::uint64_t seed) : driver(std::move(by)), path(std::move(legs)), random(seed) {}

Run Shortening::run_before(std::size_t i) const {
    Run run;
    while (i > 0) {
        const Leg& leg = path[--i];
        if (leg.last.gear == 0) continue;
        if (run.gear == -leg.last.gear) break;
        run = {leg.last.gear, run.length + leg.last.length, run.gear == 0 ? leg.last.curvature : run.curvature};
        if (leg.changes) break;
    }
    return run;
}

Run Shortening::run_after(std::size_t j) const {
    Run run;
    for (; j < path.size(); ++j) {
        const Leg& leg = path[j];
        if (leg.first.gear == 0) continue;
        if (run.gear == -leg.first.gear) break;
        run = {leg.first.gear, run.length + leg.first.length, run.gear == 0 ? leg.first.curvature : run.curvature};
        if (leg.changes) break;
    }
    return run;
}

int Shortening::cusps() const {
    int found = 0, last = 0;
    for (const Leg& leg : path)
        for (const Piece& p : leg.word.pieces) {
            const int gear = p.travel > 0 ? 1 : p.travel < 0 ? -1 : last;
            if (gear == -last && last != 0) ++found;
            last = gear;
        }
    return found;
}

double Shortening::gauss() { return (random() + random() + random() + random() - 2) * std::sqrt(3.0); }

// Replace legs i to j by others that cost less there.
bool Shortening::replace(std::size_t i, std::size_t j, Legs fresh) {
    const Run before = run_before(i), beyond = run_after(j);
    const double old = driver.total(part(i, j), before, beyond), cost = driver.total(fresh, before, beyond);
    if (!(cost < old * (1 - least_gain))) return false;
    const auto at = path.erase(path.begin() + static_cast<std::ptrdiff_t>(i), path.begin() + static_cast<std::ptrdiff_t>(j));
    path.insert(at, std::make_move_iterator(fresh.begin()), std::make_move_iterator(fresh.end()));
    return true;
}

void Shortening::join_far() {
    for (std::size_t i = 0; i < path.size(); ++i)
        for (std::size_t j = std::min(path.size(), i + farthest); j > i + 1; j = i + (j - i) / 2) {
            const double old = driver.total(part(i, j), run_before(i), run_after(j));
            auto leg = driver.join(path[i].begin(), path[j - 1].end(), path[i].from, path[j - 1].to, old, tries_to_shorten);
            if (leg && replace(i, j, {std::move(*leg)})) break;
        }
}

void Shortening::run(int rounds) {
    for (int k = 0; k < rounds && !path.empty(); ++k) {
        heed_stop();
        const bool has_gain = idle % idle_at_most == idle_at_most - 1 && !driver.vehicle.turns_in_place ? window() : attempt();
        idle = has_gain ? 0 : idle + 1;
    }
}

bool Shortening::attempt() {
    const std::size_t n = path.size(), i = std::min(n - 1, static_cast<std::size_t>(random() * static_cast<double>(n)));
    std::size_t j = i + 1;
    while (j < n && random() < 0.75) ++j;
    const double old = driver.total(part(i, j), run_before(i), run_after(j));
    const Leg &first = path[i], &last = path[j - 1];
    if (j > i + 1 && random() < 0.4) {
        auto leg = driver.join(first.begin(), last.end(), first.from, last.to, old, tries_to_shorten);
        return leg && replace(i, j, {std::move(*leg)});
    }
    // over a pose beside the path between them
    const Leg& by = path[std::min(j - 1, i + static_cast<std::size_t>(random() * static_cast<double>(j - i)))];
    const std::size_t pieces = by.word.pieces.size(), piece = std::min(pieces - 1, static_cast<std::size_t>(random() * static_cast<double>(pieces)));
    const Place on = along(by.word.joints[piece], by.word.joints[piece + 1], random());
    const double width = driver.size * std::ldexp(1 + random(), -1 - static_cast<int>(random() * 9));
    const Place place{on.x + gauss() * width, on.y + gauss() * width, on.theta + gauss() * width / driver.way.costs.weight};
    const Configuration middle = driver.rounded(place, bits);
    const double mark = driver.mark_of(middle, first.from, last.to);
    auto one = driver.join(first.begin(), middle, first.from, mark, old, tries_to_shorten);
    if (!one) return false;
    auto two = driver.join(middle, last.end(), mark, last.to, old - one->cost, tries_to_shorten);
    return two && replace(i, j, {std::move(*one), std::move(*two)});
}

// The cheapest chain of words, with the gears at their ends, over the joints of some legs and poses along and beside them.
// Only words on the best chain are proved; one that is not free is struck out.
bool Shortening::window() {
    constexpr std::array<std::size_t, 6> sizes{2, 3, 4, 6, 8, most_legs};
    const std::size_t n = path.size(), count = std::min(n, sizes[static_cast<std::size_t>(random() * sizes.size())]);
    const std::size_t begin = std::min(n - count, static_cast<std::size_t>(random() * static_cast<double>(n - count + 1))), end = begin + count;
    const Run before = run_before(begin), beyond = run_after(end);
    const Legs old(path.begin() + static_cast<std::ptrdiff_t>(begin), path.begin() + static_cast<std::ptrdiff_t>(end));
    const double cost = driver.total(old, before, beyond);
    struct Node {
        double at;
        Configuration pose;
        double mark;
        std::size_t leg = no_leg;  // that begins here
    };
    std::vector<Node> nodes;
    double length = 0, whole = 0;
    for (const Leg& leg : old) whole += travel_of(leg);
    if (!(whole > 0)) return false;
    const double step = whole / stations, width = driver.size * std::ldexp(1 + random(), -1 - static_cast<int>(random() * 7));
    double next = 0.5 * step;
    const double from = old.front().from, to = old.back().to;
    const auto beside = [&](double at, const Place& on) {
        const Place place{on.x + gauss() * width, on.y + gauss() * width, on.theta + gauss() * width / driver.way.costs.weight};
        if (driver.is_free(place)) {
            const Configuration q = driver.rounded(place, bits);
            nodes.push_back({at, q, driver.mark_of(q, from, to)});
        }
    };
    for (const Leg& leg : old) {
        nodes.push_back({length, leg.begin(), leg.from, static_cast<std::size_t>(&leg - old.data())});
        if (length > 0) beside(length, leg.begin().place());
        for (std::size_t k = 0; k < leg.word.pieces.size(); ++k) {
            const double piece = std::abs(leg.word.pieces[k].travel);
            for (; next < length + piece; next += step) {
                const Place on = along(leg.word.joints[k], leg.word.joints[k + 1], (next - length) / piece);
                const Configuration q = driver.rounded(on, bits);
                nodes.push_back({next, q, driver.mark_of(q, from, to)});
                for (int c = 0; c < copies; ++c) beside(next, on);
            }
            length += piece;
        }
    }
    std::stable_sort(nodes.begin(), nodes.end(), [](const Node& p, const Node& q) { return p.at < q.at; });
    nodes.push_back({length, old.back().end(), to});
    const std::size_t m = nodes.size();
    // for each pair in order and each gear at both ends, the cheapest word
    struct Edge {
        double cost = HUGE_VAL;
        Word word;
        std::optional<Leg> leg;
    };
    std::vector<Edge> edges(m * m * 4);
    const auto edge = [&](std::size_t i, std::size_t j, std::size_t a, std::size_t b) -> Edge& { return edges[((i * m + j) * 2 + a) * 2 + b]; };
    std::vector<Word> words;
    const double radius = driver.radius();
    for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = i + 1; j < m; ++j) {
            const Place p = nodes[i].pose.place(), q = nodes[j].pose.place();
            const auto [c, s] = cosine_sine(p.theta);
            const double dx = (q.x - p.x) / radius, dy = (q.y - p.y) / radius;
            words.clear();
            if (driver.vehicle.reverses) reeds_shepp_words(c * dx + s * dy, c * dy - s * dx, wrapped(q.theta - p.theta), words);
            else dubins_words(c * dx + s * dy, c * dy - s * dx, wrapped(q.theta - p.theta), words);
            for (const Word& word : words) {
                int first = 0, last = 0;
                for (int k = 0; k < word.count; ++k) {
                    const double l = word.length[static_cast<std::size_t>(k)];
                    if (std::abs(l) < 1e-10) continue;
                    last = l > 0 ? 1 : -1;
                    if (first == 0) first = last;
                }
                if (first == 0) continue;
                Edge& e = edge(i, j, first > 0, last > 0);
                if (const double price = driver.cost_of(word); price < e.cost) e.cost = price, e.word = word;
            }
        }
    std::size_t last = 0;
    for (std::size_t k = 0; k < old.size(); ++k) {
        std::size_t j = last + 1;
        if (k + 1 == old.size()) j = m - 1;
        else while (j < m - 1 && nodes[j].leg != k + 1) ++j;
        if (old[k].first.gear != 0) {
            Edge& e = edge(last, j, old[k].first.gear > 0, old[k].last.gear > 0);
            if (old[k].cost <= e.cost * (1 + 1e-4)) e.cost = old[k].cost, e.leg = old[k];
        }
        last = j;
    }
    struct State {
        double cost = HUGE_VAL;
        std::size_t from = 0, gear = 0, first = 0;
    };
    for (int struck = 0; struck < most_struck; ++struck) {
        heed_stop();
        std::vector<std::array<State, 2>> best(m);
        for (std::size_t g = 0; g < 2; ++g) best[0][g].cost = before.gear == 0 || (before.gear > 0) == (g == 1) ? 0 : HUGE_VAL;
        for (std::size_t i = 0; i + 1 < m; ++i)
            for (std::size_t g = 0; g < 2; ++g) {
                if (best[i][g].cost == HUGE_VAL) continue;
                for (std::size_t j = i + 1; j < m; ++j)
                    for (std::size_t a = 0; a < 2; ++a) {
                        const double here = best[i][g].cost + (i == 0 && before.gear == 0 ? 0 : a == g ? driver.dues.stop : driver.dues.cusp);
                        for (std::size_t b = 0; b < 2; ++b)
                            if (const double c = here + edge(i, j, a, b).cost; c < best[j][b].cost) best[j][b] = {c, i, g, a};
                    }
            }
        std::size_t gear = 0;
        std::array<double, 2> ends{};
        for (std::size_t g = 0; g < 2; ++g)
            ends[g] = best[m - 1][g].cost + (beyond.gear == 0 ? 0 : (beyond.gear > 0) == (g == 1) ? driver.dues.stop : driver.dues.cusp);
        if (ends[1] < ends[0]) gear = 1;
        if (!(ends[gear] < cost * (1 - worth))) return false;
        struct Step {
            std::size_t i, j, a, b;
        };
        std::vector<Step> chain;
        for (std::size_t j = m - 1, g = gear; j > 0;) {
            const State& s = best[j][g];
            chain.push_back({s.from, j, s.first, g});
            j = s.from, g = s.gear;
        }
        std::reverse(chain.begin(), chain.end());
        bool is_good = true;
        for (const Step& s : chain) {  // those that do not even seem free first
            Edge& e = edge(s.i, s.j, s.a, s.b);
            if (e.leg || driver.seems_free(nodes[s.i].pose.place(), e.word)) continue;
            e.cost = HUGE_VAL, is_good = false;
        }
        if (!is_good) continue;
        Legs fresh;
        for (const Step& s : chain) {
            Edge& e = edge(s.i, s.j, s.a, s.b);
            if (!e.leg) {
                ++driver.looked;
                e.leg = driver.made(nodes[s.i].pose, nodes[s.j].pose, nodes[s.i].mark, nodes[s.j].mark, e.word);
            }
            if (!e.leg) {
                e.cost = HUGE_VAL, is_good = false;
                break;
            }
            fresh.push_back(*e.leg);
        }
        if (is_good) return replace(begin, end, std::move(fresh));
    }
    return false;
}

}  // namespace cfree
