// Cars and differential drives: the pose of the axle, and the motions that a vehicle can do.
#pragma once
#include <vector>

#include "cfree/exact/ratio.hpp"
#include "cfree/search/configuration.hpp"

namespace cfree {

// The axle's pose is that of the axle point, with forward as its x axis. Lengths are in the scene's integer units.
struct Vehicle {
    bool turns_in_place = false, reverses = true;
    Ratio left, right;               // least radii of arcs to the left and to the right; both 0 if it turns in place
    Int ax = 0, ay = 0, unit = 1;    // axle point (ax, ay) / unit in the robot's frame
    Int hx = 1, hy = 0;              // direction of half the angle of forward there
    double radius = 0;               // the larger radius, and the axle's place in the robot's frame, in the doubles of shapes
    Place axle{0, 0, 0};             // the last in radians
    int shift = 0;                   // of the doubles of shapes

    Configuration axle_of(const Configuration& robot) const;
    Configuration robot_of(const Configuration& axle) const;
    Place axle_of(const Place& robot) const;
    Place robot_of(const Place& axle) const;
};

// Product of half angles as complex numbers, and with the conjugate of the first.
struct Half {
    Int x = 1, y = 0;
};
inline Half operator*(const Half& a, const Half& b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
inline Half conjugate(const Half& a) { return {a.x, -a.y}; }
inline Half half_of(const Configuration& q) { return {q.hx, q.hy}; }
// Without a common factor.
Half simple(const Half& a);
// The simplest half angle within a tolerance of half an angle in [-pi, pi], in radians.
Half simplest_half(double angle, double tolerance);
double angle_of(const Half& a);  // twice that of the direction, in (-pi, pi]

// Where the axle of b is from that of a: place in its frame, and turn; precise however near they are.
Place seen_from(const Configuration& a, const Configuration& b);

}  // namespace cfree
