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

// Travel plus `weight` a radian.
double cost_between(const Configuration& a, const Configuration& b, double weight);
double cost_of(const Route& route, double weight);
// Costs up to each pose.
std::vector<double> costs_along(const Route& route, double weight);

// The position of one with the orientation of another.
Configuration corner(const Configuration& position, const Configuration& orientation);

struct Way {
    const MotionChecker& checker;
    const Nearness* nearness;  // none: any free path will do
    Grid grid;
    Area limits;                   // of the reference point
    double weight, per_motion = 0; // lengths that a radian and a motion are worth
    Marked ridge = {};                   // along which something is asked,
    std::vector<double> distances = {};  // of each pose of it a distance

    Way asking(Marked along, std::vector<double> what) const;
    // The pose of the ridge nearest to a place, of those with marks about from a number to another.
    std::size_t nearest(const Place& at, double from, double to) const;
    // Is the motion free, and does it keep a distance? What keeps one that means something is free, within limits.
    bool keeps(const Configuration& a, const Configuration& b, double distance) const;
    // The same of what is asked from mark to mark.
    bool joins(const Configuration& a, const Configuration& b, double from, double to) const;
    bool joins(const Marked& path) const;
    // One motion, or a turn and a straight way in either order: the first that costs no more and is joined; or nothing.
    Marked simplest(const Configuration& a, const Configuration& b, double from, double to, double most) const;
    // A route with the marks of the nearest poses of the ridge.
    Marked marked(Route route, double from, double to) const;

private:
    bool is_within(const Configuration& a, const Configuration& b) const;
};

}  // namespace cfree
