// Points in which curves of grown shapes meet the plane of one orientation: which are one point, and directions from there.
#pragma once
#include "predicates/round_places.hpp"

namespace cfree {

// A curve, named on a surface.
struct CurveOf {
    Feature on, curve;
};

// Box of doubles that holds a curve's points.
struct Reach {
    double x0, x1, y0, y1;
};

class RoundPoints {
public:
    RoundPoints(const Scene& s, int in) : scene(s), chart(in), kappa(in ? -1 : 1) {}

    // Points of the curve between two angles of the chart; without a curve, of the surface.
    Reach reach(const CurveOf& c, double lo, double hi) const;
    // Point of the curve, and x of a surface between two of its points at a height, nearly: the balls' radii mean nothing.
    Vec<Ball> near(const CurveOf& c, const Dyadic& tau) const;
    Ball crossing(const Feature& surface, const Vec<Ball>& low, const Vec<Ball>& high, const Ball& y, const Dyadic& tau) const;
    // False only if the points of two curves are certainly different at an angle.
    bool may_be_one(const CurveOf& c, const CurveOf& d, const Dyadic& tau) const;
    bool are_one(const CurveOf& c, const CurveOf& d, const Dyadic& tau) const;
    // Signs at an angle of the cross product and of the product of the directions, along t, of two surfaces that go through the
    // curve's point.
    std::array<int, 2> turn(const CurveOf& at, const Feature& x, const Feature& y, const Dyadic& tau) const;

private:
    std::array<int, 2> counter_clockwise_turn(const CurveOf& at, const Feature& x, const Feature& y, const Dyadic& tau) const;
    const Scene& scene;
    int chart;
    double kappa;
};

}  // namespace cfree
