// Poses that a search steps through, exactly and in doubles, and the one motion between two of them.
#pragma once
#include "cfree/collision/motion_checker.hpp"

namespace cfree {

struct Place {
    double x, y, theta;
};

struct Configuration {
    Int hx, hy;             // along the direction of half the orientation
    Int x, y, unit;         // the position is (x, y) / unit in the scene's integers
    double px, py, theta;   // the same in doubles, scaled as those of shapes; theta in (-pi, pi]
    Place place() const { return {px, py, theta}; }
};

// Where a search works: doubles become exact on a grid, in the units of shapes scaled by 2^-shift.
struct Grid {
    int shift;      // of the shapes
    int place_bits; // positions are multiples of 2^-place_bits
    int angle_bits; // half-angle tangents of 2^-angle_bits
    Configuration exact(double px, double py, double theta) const;
};

// A translation, or the rotation by less than half a turn (counter-clockwise by half a turn) about its pole.
Motion motion_between(const Configuration& a, const Configuration& b);

// An angle of few turns, in [-pi, pi].
double wrapped(double angle);

// By how much it turns, and how far the reference point travels.
double turn_between(const Configuration& a, const Configuration& b);
double travel_between(const Configuration& a, const Configuration& b);

// Some way along the motion, in doubles.
Place along(const Place& a, const Place& b, double share);
// Whether something holds at so many poses of the motion, evenly apart: its end, its middle, the middles of its halves, and so on.
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
