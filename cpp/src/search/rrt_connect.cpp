// Two trees that grow towards each other; theory, "Paths".
#include "cfree/search/rrt_connect.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

constexpr double longest_step = 0.2;  // of the extent of the configuration space

bool are_one(const Configuration& a, const Configuration& b) {
    return a.px == b.px && a.py == b.py && a.theta == b.theta;
}

}  // namespace

RrtConnect::RrtConnect(Joins j, Grid g, Area a, double w, Configuration start, Configuration goal,
                       std::uint64_t seed)
    : joins(std::move(j)), grid(g), area(a), weight(w),
      range(longest_step * (norm(a.x1 - a.x0, a.y1 - a.y0) + w * std::numbers::pi)), random(seed) {
    trees[0] = {{std::move(start)}, {-1}};
    trees[1] = {{std::move(goal)}, {-1}};
}

double RrtConnect::distance(const Configuration& a, const Configuration& b) const {
    return norm(b.px - a.px, b.py - a.py) + weight * std::abs(turn_between(a, b));
}

Index RrtConnect::nearest(const Tree& tree, const Configuration& q) const {
    Index best = 0;
    double least = HUGE_VAL;
    for (Index k = 0; k < static_cast<Index>(tree.nodes.size()); ++k)
        if (const double d = distance(tree.nodes[k], q); d < least) least = d, best = k;
    return best;
}

// From a node of a tree on; the second tree's motions are run the other way, which matters for half turns.
bool RrtConnect::are_joined(bool of_goal, const Configuration& a, const Configuration& b) {
    --left;
    return of_goal ? joins(b, a) : joins(a, b);
}

Configuration RrtConnect::towards(const Configuration& a, const Configuration& b) const {
    const double share = range / distance(a, b);
    if (share >= 1) return b;
    const auto [x, y, theta] = along(a, b, share);
    return grid.exact(x, y, theta);
}

// A new node on the way from the nearest one, or -1.
Index RrtConnect::extend(const Configuration& q) {
    Tree& tree = trees[turn];
    const Index from = nearest(tree, q);
    Configuration next = towards(tree.nodes[from], q);
    if (!are_joined(turn, tree.nodes[from], next)) return -1;
    tree.nodes.push_back(std::move(next));
    tree.parent.push_back(from);
    return static_cast<Index>(tree.nodes.size()) - 1;
}

Route RrtConnect::joined(Index of_first, Index of_second) const {
    Route route;
    for (Index k = of_first; k >= 0; k = trees[0].parent[k]) route.push_back(trees[0].nodes[k]);
    std::reverse(route.begin(), route.end());
    for (Index k = of_second; k >= 0; k = trees[1].parent[k]) route.push_back(trees[1].nodes[k]);
    return route;
}

Route RrtConnect::run(int checks) {
    left = checks;
    while (left > 0) {
        Tree& other = trees[!turn];
        const double x = area.x0 + random() * (area.x1 - area.x0), y = area.y0 + random() * (area.y1 - area.y0);
        const Index k = extend(grid.exact(x, y, random() * 2 * std::numbers::pi));
        if (k >= 0) {
            const Configuration aim = trees[turn].nodes[k];
            Index from = nearest(other, aim);
            while (left > 0) {
                Configuration next = towards(other.nodes[from], aim);
                const bool arrives = are_one(next, aim);
                if (arrives) next = aim;
                else if (are_one(next, other.nodes[from])) break;  // the grid is too coarse
                if (!are_joined(!turn, other.nodes[from], next)) break;
                if (arrives) return turn ? joined(from, k) : joined(k, from);
                other.nodes.push_back(std::move(next));
                other.parent.push_back(from);
                from = static_cast<Index>(other.nodes.size()) - 1;
            }
        }
        turn = !turn;
    }
    return {};
}

}  // namespace cfree
