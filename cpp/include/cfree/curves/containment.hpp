// Exact containment of closed curves in rings of polygons, and of rings in curves.
//
// A curve is cut into parts until no edge of the ring meets the interior of a part's hull. Then each part is on one side of
// the ring. docs/theory/curved-shapes.md has the proof.
#pragma once
#include "cfree/polygons/polygon.hpp"

namespace cfree {

// A line of two points, a Bézier curve of four, or an arc of an ellipse of three: center + u (1 - s^2) / (1 + s^2) +
// v 2 s / (1 + s^2), for s from 0 to `last`, which is at most 1.
struct CurvePiece {
    std::vector<RatioPoint> points;
    Ratio last;
};

// Each piece begins where the one before ends.
using ClosedCurve = std::vector<CurvePiece>;

// True if all of the curve is inside a ring of the polygon or on it; false if not, or if the case is too close to decide.
bool is_around(const Polygon& polygon, Index ring, const ClosedCurve& curve);
// True if the curve goes around the ring and has no point inside; false if not, or if the case is too close to decide.
bool is_within(const Polygon& polygon, Index ring, const ClosedCurve& curve);

}  // namespace cfree
