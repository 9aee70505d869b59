// Trees of poses for vehicles without reverse gear; theory, "Vehicles", "Forward only". Two are joined by words of Dubins:
// one leads on from the start, one to the goal. A further one leads on within the boxes from which the goal may be reached.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <unordered_set>

#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"
#include "cfree/vehicles/driver.hpp"

namespace cfree {

namespace {

constexpr std::size_t near_poses = 12;    // whose words are compared
constexpr double step_of_size = 0.25;     // of the robot's length: between two looks along a word
constexpr double longest_of_size = 6;     // part of a word that is kept
constexpr double about_path = 0.5, wide = 0.5, turned = 0.5;  // share of poses about the path; their spread, in sizes and radians
constexpr int words_to_join = 6;
constexpr double wider = 1 + 1.0 / 256;  // radii of the trees: rounded poses then are joined by words of the vehicle's radius
constexpr int curvatures = 5, few_steps = 16, seldom = 8;  // words to the goal are tried within few steps, else seldom
constexpr int looks_for_chain = 1000;  // at motions: the time of a chain that cannot be made exact

Place moved(const Place& q, int kind, double length, double radius) {
    const auto [c, s] = cosine_sine(q.theta);
    if (kind == 0) return {q.x + radius * length * c, q.y + radius * length * s, q.theta};
    const double theta = q.theta + kind * length, r = kind * radius;
    const auto [d, t] = cosine_sine(theta);
    return {q.x + r * (t - s), q.y - r * (d - c), theta};
}

struct Tree {
    bool onward;  // from the start; else to the goal
    std::vector<Place> at;
    std::vector<std::size_t> next;  // the pose before, or beyond; the root has itself
};

struct Search {
    const Driver& driver;
    Random random;
    double radius = driver.radius() * wider;

    // The shortest word from p to q.
    Word word(const Place& p, const Place& q) const {
        const auto [c, s] = cosine_sine(p.theta);
        const double dx = (q.x - p.x) / radius, dy = (q.y - p.y) / radius;
        std::vector<Word> words;
        dubins_words(c * dx + s * dy, c * dy - s * dx, wrapped(std::remainder(q.theta - p.theta, 2 * std::numbers::pi)), words);
        return *std::min_element(words.begin(), words.end(), [](const Word& a, const Word& b) { return a.total() < b.total(); });
    }
    // Poses along a word, the ends included.
    std::vector<Place> along_word(const Place& p, const Word& w) const {
        std::vector<Place> places{p};
        Place q = p;
        for (int k = 0; k < w.count; ++k) {
            const auto at = static_cast<std::size_t>(k);
            const double length = w.length[at] * radius, step = step_of_size * driver.size;
            const int count = static_cast<int>(std::max(length / step, w.kind[at] ? 2 * w.length[at] : 0.0)) + 1;
            if (length <= 0) continue;
            for (int m = 0; m < count; ++m) places.push_back(q = moved(q, w.kind[at], w.length[at] / count, radius));
        }
        return places;
    }
    double apart(const Place& p, const Place& q) const {
        return norm(p.x - q.x, p.y - q.y) + driver.way.costs.weight * std::abs(std::remainder(p.theta - q.theta, 2 * std::numbers::pi));
    }
    // The pose of a tree with the shortest word to a pose, or from it; a new pose of the tree as near to it as the word is
    // free. Nothing if it is forbidden from the beginning.
    std::optional<std::size_t> extend(Tree& tree, const Place& target, bool whole) const {
        std::vector<std::size_t> order(tree.at.size());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
        const std::size_t count = std::min(near_poses, order.size());
        std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                          [&](std::size_t a, std::size_t b) { return apart(tree.at[a], target) < apart(tree.at[b], target); });
        std::size_t best = order[0];
        Word way;
        double least = HUGE_VAL;
        for (std::size_t k = 0; k < count; ++k) {
            const Place& q = tree.at[order[k]];
            const Word w = tree.onward ? word(q, target) : word(target, q);
            if (const double total = w.total(); total < least) least = total, best = order[k], way = w;
        }
        std::vector<Place> places = along_word(tree.onward ? tree.at[best] : target, way);
        if (!tree.onward) std::reverse(places.begin(), places.end());
        const auto most = static_cast<std::size_t>(longest_of_size / step_of_size);
        std::size_t good = 0;
        while (good + 1 < places.size() && (whole || good < most)) {
            const Place &a = places[good], &b = places[good + 1];
            if (!(tree.onward ? driver.seems_free(a, b) : driver.seems_free(b, a))) break;
            ++good;
        }
        if (good == 0 || (whole && good + 1 < places.size())) return {};
        tree.at.push_back(places[good]), tree.next.push_back(best);
        return tree.at.size() - 1;
    }
    std::vector<Place> to_root(const Tree& tree, std::size_t k) const {
        std::vector<Place> places{tree.at[k]};
        while (tree.next[k] != k) places.push_back(tree.at[k = tree.next[k]]);
        return places;
    }
};

// Exact words over the places of a chain; else the number of the place to which there is none.
struct Chained {
    std::optional<Legs> legs;
    std::size_t until = 0;
};

Chained exact_chain(Driver& driver, const Configuration& start, const Configuration& goal, const std::vector<Place>& chain, double end) {
    Legs legs;
    Configuration at = start;
    double mark = 0;
    for (std::size_t k = 1; k < chain.size(); ++k) {
        const bool is_last = k + 1 == chain.size();
        const Configuration next = is_last ? goal : driver.rounded(chain[k], 0);
        const double to = is_last ? end : driver.mark_of(next, mark, end);
        auto leg = driver.join(at, next, mark, to, HUGE_VAL, words_to_join);
        if (!leg) return {{}, k};
        legs.push_back(std::move(*leg));
        at = next, mark = to;
    }
    return {std::move(legs), chain.size()};
}

}  // namespace

std::optional<Legs> search_in_boxes(Driver& driver, const Marked& path, const Boxes& boxes, double unit, int poses) {
    const Configuration start = driver.vehicle.axle_of(path.route.front()), goal = driver.vehicle.axle_of(path.route.back());
    const Search search{driver, Random(0)};
    struct Node {
        Place at;
        std::size_t last;
        int steps;
        bool is_given_up = false;
    };
    // the boxes are of the way back, with all headings turned by half a turn
    const auto back = [&](const Place& q) { return Place{q.x / unit, q.y / unit, q.theta + std::numbers::pi}; };
    std::vector<Node> nodes{{start.place(), 0, boxes.steps_to(back(start.place())), false}};
    if (nodes[0].steps < 0) return {};
    const auto later = [&](std::size_t a, std::size_t b) {
        return nodes[a].steps > nodes[b].steps || (nodes[a].steps == nodes[b].steps && a < b);
    };
    std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(later)> todo(later);
    std::unordered_set<long long> entered;
    todo.push(0);
    const double travel = boxes.grid.step * unit, left = ratio(driver.vehicle.left.n, driver.vehicle.left.d);
    const double skew = driver.radius() / std::ldexp(ratio(driver.vehicle.right.n, driver.vehicle.right.d), -driver.way.grid.shift);
    const double other = driver.radius() / std::ldexp(left, -driver.way.grid.shift);
    for (long long looks = 0; !todo.empty() && looks < poses;) {
        heed_stop();
        const std::size_t k = todo.top();
        todo.pop();
        const Node node = nodes[k];
        bool is_given_up = node.is_given_up;
        for (std::size_t m = k; m != 0 && !is_given_up;) is_given_up = nodes[m = nodes[m].last].is_given_up;
        if (is_given_up) continue;
        if (node.steps <= few_steps || k % seldom == 0) {
            const Word way = search.word(node.at, goal.place());
            const std::vector<Place> places = search.along_word(node.at, way);
            bool is_free = true;
            for (std::size_t m = 1; m < places.size() && is_free; ++m, ++looks) is_free = driver.seems_free(places[m - 1], places[m]);
            if (is_free) {
                std::vector<Place> chain(places.rbegin(), places.rend() - 1);
                for (std::size_t m = k;; m = nodes[m].last) {
                    chain.push_back(nodes[m].at);
                    if (m == nodes[m].last) break;
                }
                std::reverse(chain.begin(), chain.end());
                Chained chained = exact_chain(driver, start, goal, chain, path.mark.back());
                if (chained.legs) return std::move(chained.legs);
                looks += looks_for_chain;
                const std::size_t poses_of_tree = chain.size() + 1 - places.size();
                if (chained.until < poses_of_tree) {  // what comes after that pose is given up
                    std::size_t m = k;
                    for (std::size_t n = poses_of_tree - 1; n > chained.until; --n) m = nodes[m].last;
                    nodes[m].is_given_up = true;
                    entered.erase(boxes.number_of(back(nodes[m].at)));
                    continue;
                }
            }
        }
        for (int m = 0; m < curvatures; ++m) {
            const double share = 2.0 * m / (curvatures - 1) - 1;  // of the greatest curvature, positive to the left
            const double turn = share * travel / search.radius * (share > 0 ? other : skew);
            const int kind = turn > 0 ? 1 : turn < 0 ? -1 : 0;
            const double radius = kind ? travel / std::abs(turn) : search.radius;
            const Place next = moved(node.at, kind, travel / radius, radius);
            const int steps = boxes.steps_to(back(next));
            if (steps < 0 || !entered.insert(boxes.number_of(back(next))).second) continue;
            ++looks;
            if (!driver.seems_free(node.at, next)) {
                entered.erase(boxes.number_of(back(next)));
                continue;
            }
            nodes.push_back({next, k, steps, false});
            todo.push(nodes.size() - 1);
        }
    }
    return {};
}

std::optional<Legs> search_forward(Driver& driver, const Marked& path, const Area& area, std::uint64_t seed, int poses) {
    const Configuration start = driver.vehicle.axle_of(path.route.front()), goal = driver.vehicle.axle_of(path.route.back());
    Search search{driver, Random(seed)};
    std::array<Tree, 2> trees{Tree{true, {start.place()}, {0}}, Tree{false, {goal.place()}, {0}}};
    Random& random = search.random;
    const auto gauss = [&] { return (random() + random() + random() + random() - 2) * std::sqrt(3.0); };
    for (int n = 0; n < poses; ++n) {
        heed_stop();
        Place target{area.x0 + random() * (area.x1 - area.x0), area.y0 + random() * (area.y1 - area.y0), (2 * random() - 1) * std::numbers::pi};
        if (random() < about_path) {
            const std::size_t k = std::min(path.route.size() - 1, static_cast<std::size_t>(random() * static_cast<double>(path.route.size())));
            const Configuration &a = path.route[k > 0 ? k - 1 : 0], &b = path.route[k];
            const Place q = driver.vehicle.axle_of(along(a, b, random()));
            target = {q.x + gauss() * wide * driver.size, q.y + gauss() * wide * driver.size, q.theta + gauss() * turned};
            if (random() < 0.5) target.theta += std::numbers::pi;
        }
        target.theta = std::remainder(target.theta, 2 * std::numbers::pi);
        if (n == 0) target = goal.place();
        if (!driver.is_free(target)) continue;
        Tree &one = trees[static_cast<std::size_t>(n % 2)], &other = trees[static_cast<std::size_t>((n + 1) % 2)];
        const auto fresh = search.extend(one, target, false);
        if (!fresh) continue;
        const auto met = search.extend(other, one.at[*fresh], true);
        if (!met) continue;
        std::vector<Place> chain = search.to_root(one.onward ? one : other, one.onward ? *fresh : *met);
        std::reverse(chain.begin(), chain.end());
        const std::vector<Place> rest = search.to_root(one.onward ? other : one, one.onward ? *met : *fresh);
        chain.insert(chain.end(), rest.begin() + 1, rest.end());
        if (Chained chained = exact_chain(driver, start, goal, chain, path.mark.back()); chained.legs) return std::move(chained.legs);
    }
    return {};
}

}  // namespace cfree
