// Angles in radians, given as doubles, read as the rational half-angle tangents that Python's `Pose` takes for them.
#pragma once
#include <optional>

#include "cfree/exact/number.hpp"

namespace cfree {

struct Radians {
    Int q, p;      // tau = p / q in lowest terms, q >= 0; half a turn is 0, 1
    double theta;  // the angle in [0, 2 pi), rounded
    double error;  // bound of the distance of the angle given from 2 atan(tau)
};

// Bit for bit what `read_angle` in src/cfree/exact/half_angle.py computes. Nothing from 2^63 on, and of no numbers: pi has
// too few digits here.
std::optional<Radians> read_radians(double theta);

}  // namespace cfree
