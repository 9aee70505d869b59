// A quick search for a path, and shortening one. Nothing here decides what is free: every motion is checked exactly.
//
// Two trees grow from start and goal towards random poses and towards each other (RRT-Connect: Kuffner and LaValle, 2000).
// Finding nothing means nothing.
#pragma once
#include <random>
#include <vector>

#include "cfree/search/configuration.hpp"

namespace cfree {

using Route = std::vector<Configuration>;  // a path: the motions between each and the next

struct Area {  // of positions
    double x0, y0, x1, y1;
};

class Random {
public:
    explicit Random(std::uint64_t seed) : engine(seed) {}
    double operator()() { return std::ldexp(static_cast<double>(engine() >> 11), -53); }  // in [0, 1), the same anywhere

private:
    std::mt19937_64 engine;
};

class RrtConnect {
public:
    // weight: length per radian
    RrtConnect(const MotionChecker& checker, Grid grid, Area area, double weight, Configuration start, Configuration goal,
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
    bool is_free(bool of_goal, const Configuration& a, const Configuration& b);
    Configuration towards(const Configuration& a, const Configuration& b) const;
    Index extend(const Configuration& q);
    Route joined(Index of_first, Index of_second) const;

    const MotionChecker& checker;
    const Grid grid;
    const Area area;
    const double weight, range;
    Tree trees[2];
    bool turn = false;  // which tree grows
    Random random;
    int left = 0;
};

class Shortcut {
public:
    Shortcut(const MotionChecker& checker, Grid grid, double weight, Route route, std::uint64_t seed);
    // Check about so many motions.
    void run(int checks);
    const Route& path() const { return route; }
    double length() const { return at.back(); }

private:
    double cost(const Configuration& a, const Configuration& b) const;
    double cost(const Route& r) const;
    bool is_free(const Route& r);
    void measure();
    void attempt();

    const MotionChecker& checker;
    const Grid grid;
    const double weight;
    Route route;
    std::vector<double> at;  // lengths up to each pose
    Random random;
    int left = 0;
};

}  // namespace cfree
