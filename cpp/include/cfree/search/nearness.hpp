// Distances and directions from obstacles to the robot: doubles that guide paths and decide nothing.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "cfree/scene/scene.hpp"
#include "cfree/search/configuration.hpp"

namespace cfree {

class BoxTree;

// A pair of convex pieces: their distance, or, negative, their overlap; the direction from the obstacle's to the robot's
// closest point; and the arm to this from the reference point.
struct Witness {
    double distance;
    Vec<double> normal, arm;
};

class Nearness {
public:
    // slack: distances may be too large by as much.
    explicit Nearness(const Scene& scene, double slack = 0);
    ~Nearness();
    Nearness(const Nearness&) = delete;
    Nearness& operator=(const Nearness&) = delete;

    // All pairs of pieces nearer than `within`.
    std::vector<Witness> around(const Place& at, double within) const;
    // Least distance, at most `within`; not positive if the robot overlaps something.
    double distance(const Place& at, double within) const;
    // True if the robot is nearer to something than that, or overlaps it by more than a negative distance.
    bool is_nearer(const Place& at, double than) const;
    // True if the robot keeps the distance need(u), or nearly, at every share u of the motion. False: it does not, or not
    // certainly. Distances below `least` do not count.
    bool keeps(const Configuration& a, const Configuration& b, const std::function<double(double)>& need) const;
    // True if the robot overlaps something, by more than rounding, at one of some sampled poses of the motion.
    bool overlaps(const Configuration& a, const Configuration& b) const;
    // Least meaningful distance.
    double least() const { return least_distance; }

private:
    struct Pieces {  // edge k from vertex k, with its outward unit normal n and n . vertex
        std::vector<Index> first{0};
        std::vector<double> x = {}, y = {}, nx = {}, ny = {}, h = {};
        struct Disc {  // disc around a piece, and a point in it
            double x, y, radius;
            Vec<double> inner;
        };
        std::vector<Disc> disc = {};
        void add(const std::vector<Vec<double>>& ring);
        double ahead(Index edge, const Vec<double>& p) const;
        Index count() const { return static_cast<Index>(first.size()) - 1; }
    };
    static Pieces pieces_of(const Shape& shape);
    struct Placed;
    struct Gap;
    double distance(const Placed& placed, double within) const;
    bool is_nearer(const Placed& placed, double than) const;
    bool are_near(const Placed& placed, Index i, Index j, double within, Witness& found) const;
    bool is_gap_narrower(const Placed& placed, Index i, Index j, double within, Gap& gap) const;
    bool are_features_near(const Placed& placed, Index i, Index j, double within, const Gap& gap, Witness& found) const;
    std::vector<Index> candidates(const Placed& placed, double within) const;
    double separates(const Vec<double>& n, const Placed& p, const Placed& m, const Placed& q, Index i, Index j) const;

    Pieces robot, obstacles;
    Index robot_parts;  // its convex hull comes after them if there are many
    std::unique_ptr<BoxTree> tree;  // tree of the obstacles' pieces
    double least_distance, reach = 0;  // the robot's radius
};

}  // namespace cfree
