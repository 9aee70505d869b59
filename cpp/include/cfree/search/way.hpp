// Routes of paths, and the distance from obstacles that each place must keep.
#pragma once
#include <optional>
#include <vector>

#include "cfree/search/nearness.hpp"

namespace cfree {

using Route = std::vector<Configuration>;  // a path: the motions between consecutive poses

struct Area {  // area of positions
    double x0, y0, x1, y1;
};

// A route and the marks of its poses, numbers that grow from start to goal.
struct Marked {
    Route route;
    std::vector<double> mark;
    void append(const Marked& further);  // `further` begins at the end of this one
};

// Costs of motions: travel plus `weight` per radian. There are factors, at least 1, for travel sideways and backward of the
// axle, a place in the robot's frame that looks forward; and for turning without travel.
struct Costs {
    double weight, sideways = 1, backward = 1, turning = 1;
    Place axle{0, 0, 0};
    bool prefer() const { return sideways > 1 || backward > 1 || turning > 1; }
};
double cost_between(const Configuration& a, const Configuration& b, const Costs& costs);
double cost_of(const Route& route, const Costs& costs);
// Costs up to each pose.
std::vector<double> costs_along(const Route& route, const Costs& costs);

// Configuration with the position of one and the orientation of another.
Configuration corner(const Configuration& position, const Configuration& orientation);
// One motion, or a turn and a straight way in either order.
std::vector<Route> turned_or_straight(const Configuration& a, const Configuration& b);

struct Way {
    const MotionChecker& checker;
    const Nearness* nearness;  // null: any free path is admissible
    Grid grid;
    Area limits;                   // limits of the reference point
    Costs costs;
    double per_motion = 0;         // cost of each motion, as a length
    std::optional<Place> center = {};  // about this point of the robot poses are turned, so that a path turns less; or not at all
    bool may_turn = true;          // false: poses keep their orientations when they are pushed away from obstacles
    Marked ridge = {};                   // ridge with requirements,
    std::vector<double> distances = {};  // a distance for each pose of it,
    struct Places {
        std::vector<double> x, y, theta;
    } places = {};  // and the places of these poses

    Way asking(Marked along, std::vector<double> what) const;
    // Pose of the ridge nearest to a place, among marks between about `from` and `to`.
    std::size_t nearest(const Place& at, double from, double to) const;
    // True if the motion is free and keeps a distance. A motion that keeps a meaningful distance within the limits is free.
    bool keeps(const Configuration& a, const Configuration& b, double distance) const;
    // True if the motion is free and keeps the distances required from mark to mark.
    bool joins(const Configuration& a, const Configuration& b, double from, double to) const;
    bool joins(const Marked& path) const;
    // True if the reference point certainly stays within the limits.
    bool is_within(const Configuration& a, const Configuration& b) const;
    // One motion, or a turn and a straight way in either order, or a driven way: the first admissible one of at most cost
    // `most`, or with preferences the cheapest; or nothing.
    Marked simplest(const Configuration& a, const Configuration& b, double from, double to, double most) const;
    // Ways of driving ahead, or back, from place to place: turns with a line or an arc, or two arcs.
    std::vector<Route> driven(const Configuration& a, const Configuration& b) const;
    // Pose turned to a direction.
    Configuration turned(const Configuration& q, double theta) const { return corner(q, grid.exact(q.px, q.py, theta)); }
    // Plain length, without preferences.
    Costs length() const { return {costs.weight}; }
    // Route with the marks of the nearest poses of the ridge.
    Marked marked(Route route, double from, double to) const;

private:
    // True if the motion is free, exactly; most forbidden ones already overlap at sampled poses.
    bool is_free(const Configuration& a, const Configuration& b) const;
};

}  // namespace cfree
