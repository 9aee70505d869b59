// Quick search for a path. Nothing here decides freedom: every motion of a result is checked exactly.
//
// Two trees grow from start and goal towards random poses and towards each other (RRT-Connect: Kuffner and LaValle, 2000), in
// doubles, over motions that seem to be free. When trees meet, the motions on the path are checked, and the subtree behind one
// that is not free is cut off (as in Bohlin and Kavraki's lazy roadmaps, 2000). Finding nothing proves nothing.
#pragma once
#include <array>
#include <climits>
#include <functional>
#include <set>
#include <vector>

#include "cfree/search/random.hpp"
#include "cfree/search/way.hpp"

namespace cfree {

struct Joins {
    std::function<bool(const Place&, const Place&)> seems;  // guess: the motion may be admissible
    std::function<bool(const Configuration&, const Configuration&)> certainly;  // exact: the motion is admissible
};

// Longest step of a tree, as a share of the extent of the configuration space; factor of a radian's weight; share of tries
// without turning, against needless turning.
struct Growth {
    double step = 0.2, turning = 1, kept = 0.5;
};
constexpr Growth by_short_steps{0.05, 0.25}, without_turns{0.2, 1, 1};  // turns only where the trees meet

class RrtConnect {
public:
    // weight: length per radian
    RrtConnect(Joins joins, Grid grid, Area area, double weight, Configuration start, Configuration goal,
           std::uint64_t seed, const Growth& growth = {});
    // Run for about this many guesses of motions; a route, or nothing yet.
    Route run(int guesses);
    // Run, and continue as long as both trees reach new parts of the space.
    Route run_on(int guesses);
    // Number of parts of the configuration space that the trees of start and goal have reached.
    std::array<std::size_t, 2> reached() const { return {trees[0].parts.size(), trees[1].parts.size()}; }

private:
    struct Tree {
        Configuration root;
        double step = 0;  // longest one that it tries next
        std::vector<double> x, y, theta;
        std::vector<Index> parent;
        std::vector<char> is_certain;  // certainty of the motion from the parent
        std::set<int> parts;           // parts of the configuration space with a node
        struct Node {
            Place at;
            Index number;
        };
        std::vector<std::vector<Node>> near;  // nodes by squares of the area
        std::array<int, 2> columns{INT_MAX, -1}, rows{INT_MAX, -1};  // the first and the last square with a node
        Index size() const { return static_cast<Index>(x.size()); }
        Place at(Index k) const { return {x[k], y[k], theta[k]}; }
    };
    void add(Tree& tree, const Place& q, Index from) const;
    void cut(Tree& tree, Index k) const;  // the pose and its subtree
    std::array<int, 2> square_of(const Place& q) const;
    Index nearest(const Tree& tree, const Place& q) const;
    double distance(const Place& a, const Place& b) const;
    bool are_joined(bool of_goal, const Place& a, const Place& b);
    bool are_certainly_joined(bool of_goal, const Configuration& a, const Configuration& b);
    Place towards(const Place& a, const Place& b, double step) const;
    Index extend(const Place& q);
    Route branch(bool of_goal, Index k);
    Route joined(Index of_first, Index of_second);
    Route with_few_motions(Index of_first, Index of_second);
    Configuration exact(bool of_goal, Index k) const;

    const Joins joins;
    const Grid grid;
    const Area area;
    const double weight, range, least, kept, side;  // steps are at most `range`, and their limit is at least `least`; side: of a square
    Tree trees[2];
    bool turn = false;  // the tree that grows next
    Random random;
    int left = 0;
};

}  // namespace cfree
