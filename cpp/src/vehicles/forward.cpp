// Two trees of poses, joined by words of Dubins: one leads on from the start, one to the goal; theory, "Vehicles".
#include <algorithm>
#include <cmath>
#include <numbers>

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

    // The shortest word from p to q.
    Word word(const Place& p, const Place& q) const {
        const auto [c, s] = cosine_sine(p.theta);
        const double dx = (q.x - p.x) / driver.radius(), dy = (q.y - p.y) / driver.radius();
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
            const double length = w.length[at] * driver.radius(), step = step_of_size * driver.size;
            const int count = static_cast<int>(std::max(length / step, w.kind[at] ? 2 * w.length[at] : 0.0)) + 1;
            if (length <= 0) continue;
            for (int m = 0; m < count; ++m) places.push_back(q = moved(q, w.kind[at], w.length[at] / count, driver.radius()));
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

// Exact words over the places of a chain; longer ones where these do.
std::optional<Legs> exact_chain(Driver& driver, const Configuration& start, const Configuration& goal, const std::vector<Place>& chain,
                                double end) {
    Legs legs;
    Configuration at = start;
    double mark = 0;
    for (std::size_t k = 1; k < chain.size(); ++k) {
        const bool is_last = k + 1 == chain.size();
        const Configuration next = is_last ? goal : driver.rounded(chain[k], 0);
        const double to = is_last ? end : driver.mark_of(next, mark, end);
        auto leg = driver.join(at, next, mark, to, HUGE_VAL, words_to_join);
        if (!leg) return {};
        legs.push_back(std::move(*leg));
        at = next, mark = to;
    }
    return legs;
}

}  // namespace

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
        if (auto legs = exact_chain(driver, start, goal, chain, path.mark.back())) return legs;
    }
    return {};
}

}  // namespace cfree
