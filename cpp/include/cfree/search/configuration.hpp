// Poses of a search, exactly and in doubles, and the one motion between two of them.
#pragma once
#include "cfree/collision/motion_checker.hpp"

namespace cfree {

struct Place {
    double x, y, theta;
};

struct Configuration {
    Int hx, hy;             // direction of half the orientation
    Int x, y, unit;         // the position is (x, y) / unit in the scene's integers
    double px, py, theta;   // the same in doubles, scaled like the doubles of shapes; theta in (-pi, pi]
    Place place() const { return {px, py, theta}; }
};

// Grid of a search, on which doubles become exact, in the units of shapes scaled by 2^-shift.
struct Grid {
    int shift;      // shift of the shapes
    int place_bits; // positions are multiples of 2^-place_bits
    int angle_bits; // half-angle tangents of 2^-angle_bits
    Configuration exact(double px, double py, double theta) const;
};

// A translation, or the rotation by less than half a turn (counter-clockwise by half a turn) about its pole.
Motion motion_between(const Configuration& a, const Configuration& b);

// Normalise an angle of few turns to [-pi, pi].
double wrapped(double angle);

// Angle by which the motion turns, and travel of the reference point.
double turn_between(const Configuration& a, const Configuration& b);
double travel_between(const Configuration& a, const Configuration& b);
double arc_over(double chord, double turn);  // length of an arc that turns so far

// Place after a share of the motion, in doubles.
Place along(const Place& a, const Place& b, double share);
// True if a predicate holds at some of this many evenly spaced poses of the motion: its end, its middle, the middles of its
// halves, and so on.
template <class F>
bool all_along(const Place& a, const Place& b, int count, F&& holds) {
    if (!holds(b)) return false;
    int by = 1;
    while (by < count) by *= 2;
    for (; by > 1; by /= 2)
        for (int k = by / 2; k < count; k += by)
            if (!holds(along(a, b, static_cast<double>(k) / count))) return false;
    return true;
}
inline Place along(const Configuration& a, const Configuration& b, double share) { return along(a.place(), b.place(), share); }

}  // namespace cfree
