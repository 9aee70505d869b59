// Overlap of two placed shapes, exactly; theory, "Segments and arcs".
#pragma once
#include "cfree/arcs/shape.hpp"
#include "collision/box_tree.hpp"

namespace cfree {

// A point (x / w, y / w), w > 0.
struct HomogeneousPoint {
    Int x, y, w;
};

// A shape in a pose, in integers that it shares with the other shape. Boxes are in these integers times 2^-shift.
struct PlacedShape {
    const std::vector<Index>* ring;
    bool is_outside;
    std::vector<RoundEdge> curves;
    std::vector<Box> boxes;
    int shift = 0;
    PlacedShape(const ArcShape& shape, std::vector<RoundEdge> placed, int shift_of_boxes);
};
// Shift for the boxes of shapes, so that doubles suffice.
int shift_for(const std::vector<RoundEdge>& a, const std::vector<RoundEdge>& b);

// Turns of some of the curves about a point; nothing if one of them goes through it, which is then `met`.
std::optional<int> turns_about(const PlacedShape& shape, Index first, Index last, const HomogeneousPoint& spot, Index* met = nullptr);

// Last parameter of a curve, and its point at another: a share of a segment; at s an arc has turned by 2 arctan(s).
Ratio last_parameter(const RoundEdge& curve);
HomogeneousPoint point_at(const RoundEdge& curve, const Ratio& parameter);

// A common denominator of two shapes, and the factors of their integers.
struct CommonScale {
    Int whole, of_robot, of_obstacle;
    CommonScale(const ArcShape& robot, const ArcShape& obstacle);
};

// True if the interiors meet; with a distance above 0, if some points are closer than that, or the interiors meet.
bool overlap(const PlacedShape& a, const PlacedShape& b, const Int& distance);

}  // namespace cfree
