// A quick search for a path. Nothing here decides what is free: every motion is checked exactly.
//
// Two trees grow from start and goal towards random poses and towards each other (RRT-Connect: Kuffner and LaValle, 2000).
// Finding nothing means nothing.
#pragma once
#include <functional>
#include <vector>

#include "cfree/search/random.hpp"
#include "cfree/search/way.hpp"

namespace cfree {

// Whether the motion from one to the other will do.
using Joins = std::function<bool(const Configuration&, const Configuration&)>;

class RrtConnect {
public:
    // weight: length per radian
    RrtConnect(Joins joins, Grid grid, Area area, double weight, Configuration start, Configuration goal,
           std::uint64_t seed);
    // Check about so many motions; a route, or nothing yet.
    Route run(int checks);

private:
    struct Tree {
        Route nodes;
        std::vector<Index> parent;
    };
    double distance(const Configuration& a, const Configuration& b) const;
    Index nearest(const Tree& tree, const Configuration& q) const;
    bool are_joined(bool of_goal, const Configuration& a, const Configuration& b);
    Configuration towards(const Configuration& a, const Configuration& b) const;
    Index extend(const Configuration& q);
    Route joined(Index of_first, Index of_second) const;

    const Joins joins;
    const Grid grid;
    const Area area;
    const double weight, range;
    Tree trees[2];
    bool turn = false;  // which tree grows
    Random random;
    int left = 0;
};

}  // namespace cfree
