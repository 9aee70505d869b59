// Free contacts that no trapezoid reaches: where free space is only a curve, a segment at one angle, or a point.
//
// Trimming leaves parts without width on each patch. Most of them lie on trapezoids of other patches; what is left when those
// have been taken away is isolated, and is listed once.
#pragma once
#include "cfree/critical_angle.hpp"

namespace cfree {

// {(t, theta): lower <= t <= upper, from <= theta <= to} of a patch, with from = to (a segment, or a point) or lower = upper (a
// curve). A curve or an angle may be named on the surface of another patch.
struct IsolatedParts {
    Trapezoids parts;
    std::vector<Index> lower_patch, upper_patch, from_patch, to_patch;
};

IsolatedParts isolated_parts(const Scene& scene, const Patches& patches, const Trapezoids& live, const Trapezoids& thin);

}  // namespace cfree
