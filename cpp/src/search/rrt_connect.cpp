// Grow two trees towards each other; theory, "Paths".
#include "cfree/search/rrt_connect.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"
#include "search/farthest.hpp"

namespace cfree {

namespace {

using std::numbers::pi;

constexpr int certainty = 16;         // guesses that take as long as an exact test
constexpr Index few = 200;             // nodes: all of them are scanned
constexpr int squares = 24;            // along the longer side of the area
constexpr int some = 2000;            // at least so many guesses
constexpr std::size_t new_parts = 3;
// In narrow places nearly all long steps fail. So a tree's steps get shorter by a guess that fails, and longer by another one:
// about one in five succeeds.
constexpr double shorter = 0.95, longer = 1.2;
constexpr double least_step = 0.0125;  // as a share of the extent of the configuration space
constexpr int parts = 8;              // parts per side of the configuration space, which record visits of trees

double space_extent(const Area& a, double weight) { return norm(a.x1 - a.x0, a.y1 - a.y0) + weight * pi; }
bool are_one(const Place& a, const Place& b) { return a.x == b.x && a.y == b.y && a.theta == b.theta; }

}  // namespace

std::array<int, 2> RrtConnect::square_of(const Place& q) const {
    const auto at = [&](double offset) {
        const double column = offset / side;
        return column < squares ? static_cast<int>(std::max(column, 0.0)) : squares - 1;
    };
    return {at(q.x - area.x0), at(q.y - area.y0)};
}

void RrtConnect::add(Tree& tree, const Place& q, Index from) const {
    const auto [column, row] = square_of(q);
    tree.near[column * squares + row].push_back({q, tree.size()});
    tree.columns = {std::min(tree.columns[0], column), std::max(tree.columns[1], column)};
    tree.rows = {std::min(tree.rows[0], row), std::max(tree.rows[1], row)};
    tree.x.push_back(q.x), tree.y.push_back(q.y), tree.theta.push_back(q.theta);
    tree.parent.push_back(from), tree.is_certain.push_back(false);
    constexpr int by = squares / parts;
    const double share = 0.5 + q.theta / (2 * pi);
    tree.parts.insert(((column / by) * parts + row / by) * parts + (share < 1 ? static_cast<int>(parts * std::max(share, 0.0)) : parts - 1));
}

void RrtConnect::cut(Tree& tree, Index first) const {
    Tree rest{tree.root, tree.step, {}, {}, {}, {}, {}, std::move(tree.parts), decltype(tree.near)(tree.near.size())};
    std::vector<Index> number(tree.x.size(), -1);
    for (Index k = 0; k < tree.size(); ++k) {
        const Index from = tree.parent[k];
        if (k == first || (from >= 0 && number[from] < 0)) continue;
        number[k] = rest.size();
        add(rest, tree.at(k), from < 0 ? -1 : number[from]);
        rest.is_certain.back() = tree.is_certain[k];
    }
    tree = std::move(rest);
}

RrtConnect::RrtConnect(Joins j, Grid g, Area a, double w, Configuration start, Configuration goal,
                       std::uint64_t seed, const Growth& growth)
    : joins(std::move(j)), grid(g), area(a), weight(growth.turning * w),
      range(growth.step * space_extent(a, weight)), least(std::min(least_step * space_extent(a, weight), range)),
      kept(growth.kept), side(std::max(a.x1 - a.x0, a.y1 - a.y0) / squares), random(seed) {
    trees[0].root = std::move(start), trees[1].root = std::move(goal);
    for (Tree& tree : trees) {
        tree.near.resize(squares * squares), tree.step = range;
        add(tree, tree.root.place(), -1);
    }
}

double RrtConnect::distance(const Place& a, const Place& b) const {
    return norm(norm(b.x - a.x, b.y - a.y), weight * wrapped(b.theta - a.theta));
}

// Nearest node: in rings of squares around the place's own, as far as they have nodes, as long as they may have a nearer one.
Index RrtConnect::nearest(const Tree& tree, const Place& q) const {
    Index best = 0;
    double shortest = HUGE_VAL;
    const auto look = [&](const Place& at, Index k) {
        const double dx = at.x - q.x, dy = at.y - q.y, by = std::abs(at.theta - q.theta);
        const double turning = weight * std::min(by, 2 * pi - by), square = dx * dx + dy * dy + turning * turning;
        if (square < shortest || (square == shortest && k < best)) shortest = square, best = k;
    };
    if (tree.size() <= few) {
        for (Index k = 0; k < tree.size(); ++k) look(tree.at(k), k);
        return best;
    }
    const auto [column, row] = square_of(q);
    const auto &columns = tree.columns, &rows = tree.rows;
    // from a coordinate to the squares of a number; rounded down
    const auto gap = [&](double offset, int number) {
        return std::max({0.0, number * side - offset, offset - (number + 1) * side}) * (1 - 0x1p-40);
    };
    const double x = std::clamp(q.x - area.x0, 0.0, squares * side), y = std::clamp(q.y - area.y0, 0.0, squares * side);
    const auto look_in = [&](int first_column, int last_column, int first_row, int last_row) {
        for (int i = std::max(first_column, columns[0]); i <= std::min(last_column, columns[1]); ++i) {
            const double dx = gap(x, i);
            for (int j = std::max(first_row, rows[0]); j <= std::min(last_row, rows[1]); ++j) {
                const double dy = gap(y, j);
                if (dx * dx + dy * dy > shortest) continue;
                for (const auto& [at, k] : tree.near[i * squares + j]) look(at, k);
            }
        }
    };
    for (int r = std::max({0, columns[0] - column, column - columns[1], rows[0] - row, row - rows[1]}); r < squares; ++r) {
        if (r > 0 && (r - 1) * side * ((r - 1) * side) > shortest) break;
        look_in(column - r, column + r, row - r, row - r);
        if (r == 0) continue;
        look_in(column - r, column + r, row + r, row + r);
        look_in(column - r, column - r, row - r + 1, row + r - 1);
        look_in(column + r, column + r, row - r + 1, row + r - 1);
    }
    return best;
}

// Guess a motion from a node of a tree on; motions of the second tree run the other way, which matters for half turns.
bool RrtConnect::are_joined(bool of_goal, const Place& a, const Place& b) {
    --left;
    return of_goal ? joins.seems(b, a) : joins.seems(a, b);
}

bool RrtConnect::are_certainly_joined(bool of_goal, const Configuration& a, const Configuration& b) {
    left -= certainty;
    return of_goal ? joins.certainly(b, a) : joins.certainly(a, b);
}

Place RrtConnect::towards(const Place& a, const Place& b, double step) const {
    const double share = step / distance(a, b);
    if (share >= 1) return b;
    Place q = along(a, b, share);
    q.theta = wrapped(q.theta);
    return q;
}

// Add a node on the way from the nearest one; its number, or -1.
Index RrtConnect::extend(const Place& q) {
    Tree& tree = trees[turn];
    const Index from = nearest(tree, q);
    const bool keeps = random() < kept;
    const Place next = towards(tree.at(from), {q.x, q.y, keeps ? tree.theta[from] : q.theta}, tree.step);
    const bool is_free = are_joined(turn, tree.at(from), next);
    tree.step = std::clamp(tree.step * (is_free ? longer : shorter), least, range);
    if (!is_free) return -1;
    add(tree, next, from);
    return tree.size() - 1;
}

Configuration RrtConnect::exact(bool of_goal, Index k) const {
    const Tree& tree = trees[of_goal];
    return k == 0 ? tree.root : grid.exact(tree.x[k], tree.y[k], tree.theta[k]);
}

// Route from the root; nothing if some motion is not free.
Route RrtConnect::branch(bool of_goal, Index last) {
    Tree& tree = trees[of_goal];
    std::vector<Index> chain;
    for (Index k = last; k >= 0; k = tree.parent[k]) chain.push_back(k);
    Route route;
    for (auto k = chain.rbegin(); k != chain.rend(); ++k) {
        route.push_back(exact(of_goal, *k));
        if (*k == 0 || tree.is_certain[*k]) continue;
        if (!are_certainly_joined(of_goal, route[route.size() - 2], route.back())) {
            cut(tree, *k);
            return {};
        }
        tree.is_certain[*k] = true;
    }
    return route;
}

// Route over two nodes that seem to be joined. Exact tests take most of the time, so one with few motions comes first.
Route RrtConnect::joined(Index of_first, Index of_second) {
    if (Route route = with_few_motions(of_first, of_second); !route.empty()) return route;
    Route route = branch(false, of_first);
    const Route rest = branch(true, of_second);
    if (route.empty() || rest.empty() || !are_certainly_joined(false, route.back(), rest.back())) return {};
    route.insert(route.end(), rest.rbegin(), rest.rend());
    return route;
}

// The same route without the nodes that guesses pass by; nothing if some motion is not free.
Route RrtConnect::with_few_motions(Index of_first, Index of_second) {
    struct Node {
        bool of_goal;
        Index number;
    };
    std::vector<Node> nodes;
    for (Index k = of_first; k >= 0; k = trees[0].parent[k]) nodes.push_back({false, k});
    std::reverse(nodes.begin(), nodes.end());
    for (Index k = of_second; k >= 0; k = trees[1].parent[k]) nodes.push_back({true, k});
    const auto place = [&](std::size_t n) { return trees[nodes[n].of_goal].at(nodes[n].number); };
    const auto configuration = [&](std::size_t n) { return exact(nodes[n].of_goal, nodes[n].number); };
    const std::size_t last = nodes.size() - 1;
    Route route{trees[0].root};
    for (std::size_t from = 0; from < last;) {
        std::size_t to = farthest(from, last, [&](std::size_t n) { return are_joined(false, place(from), place(n)); });
        Configuration next = configuration(to);
        while (!are_certainly_joined(false, route.back(), next)) {
            if (to == from + 1) return {};
            to = from + (to - from) / 2;
            next = configuration(to);
        }
        route.push_back(std::move(next));
        from = to;
    }
    return route;
}

Route RrtConnect::run(int guesses) {
    left = guesses;
    while (left > 0) {
        heed_stop();
        Tree& other = trees[!turn];
        const double x = area.x0 + random() * (area.x1 - area.x0), y = area.y0 + random() * (area.y1 - area.y0);
        const Index k = extend({x, y, (2 * random() - 1) * pi});
        if (k >= 0) {
            const Place aim = trees[turn].at(k);
            Index from = nearest(other, aim);
            while (left > 0) {
                const Place next = towards(other.at(from), aim, other.step);
                if (!are_joined(!turn, other.at(from), next)) break;
                if (are_one(next, aim)) {
                    if (Route route = turn ? joined(from, k) : joined(k, from); !route.empty()) return route;
                    break;
                }
                add(other, next, from);
                from = other.size() - 1;
            }
        }
        turn = !turn;
    }
    return {};
}

Route RrtConnect::run_on(int guesses) {
    const auto count = [&] { return std::min(trees[0].parts.size(), trees[1].parts.size()); };
    for (;; guesses = some) {
        const std::size_t before = count();
        if (Route route = run(guesses); !route.empty()) return route;
        if (count() < before + new_parts) return {};
    }
}

}  // namespace cfree
