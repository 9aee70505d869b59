// What paths are made of, and which distance from obstacles each place of one must keep.
#pragma once
#include <vector>

#include "cfree/search/nearness.hpp"

namespace cfree {

using Route = std::vector<Configuration>;  // a path: the motions between each and the next

struct Area {  // of positions
    double x0, y0, x1, y1;
};

// A route and the marks of its poses, numbers that grow from start to goal.
struct Marked {
    Route route;
    std::vector<double> mark;
    void append(const Marked& further);  // which begins where this one ends
};

// What motions cost: travel plus `weight` a radian. Factors, at least 1, of travel sideways and backward, as the robot sees
// it, whose x axis is forward; and of turning as far as no travel goes with it.
struct Costs {
    double weight, sideways = 1, backward = 1, turning = 1;
    bool prefer() const { return sideways > 1 || backward > 1 || turning > 1; }
};
double cost_between(const Configuration& a, const Configuration& b, const Costs& costs);
double cost_of(const Route& route, const Costs& costs);
// Costs up to each pose.
std::vector<double> costs_along(const Route& route, const Costs& costs);

// The position of one with the orientation of another.
Configuration corner(const Configuration& position, const Configuration& orientation);
// One motion, or a turn and a straight way in either order.
std::vector<Route> turned_or_straight(const Configuration& a, const Configuration& b);

struct Way {
    const MotionChecker& checker;
    const Nearness* nearness;  // none: any free path will do
    Grid grid;
    Area limits;                   // of the reference point
    Costs costs;
    double per_motion = 0;         // the length that a motion is worth
    Marked ridge = {};                   // along which something is asked,
    std::vector<double> distances = {};  // of each pose of it a distance
    std::vector<Place> places = {};      // of these poses

    Way asking(Marked along, std::vector<double> what) const;
    // The pose of the ridge nearest to a place, of those with marks about from a number to another; quick if the guess is near.
    std::size_t nearest(const Place& at, double from, double to, std::size_t guess) const;
    // Is the motion free, and does it keep a distance? What keeps one that means something is free, within limits.
    bool keeps(const Configuration& a, const Configuration& b, double distance) const;
    // The same of what is asked from mark to mark.
    bool joins(const Configuration& a, const Configuration& b, double from, double to) const;
    bool joins(const Marked& path) const;
    // Does the reference point certainly stay within the limits?
    bool is_within(const Configuration& a, const Configuration& b) const;
    // One motion, or a turn and a straight way in either order, or as it is driven: the first, or if something is preferred
    // the cheapest, that costs no more and is joined; or nothing.
    Marked simplest(const Configuration& a, const Configuration& b, double from, double to, double most) const;
    // Ways that go ahead, or back, from place to place: turned, along a line or an arc, or along two arcs.
    std::vector<Route> driven(const Configuration& a, const Configuration& b) const;
    // A pose turned to a direction.
    Configuration turned(const Configuration& q, double theta) const { return corner(q, grid.exact(q.px, q.py, theta)); }
    // The plain length, which no preference changes.
    Costs length() const { return {costs.weight}; }
    // A route with the marks of the nearest poses of the ridge.
    Marked marked(Route route, double from, double to) const;

private:
    // Exactly; most that are not are seen to overlap at some of their poses.
    bool is_free(const Configuration& a, const Configuration& b) const;
};

}  // namespace cfree
