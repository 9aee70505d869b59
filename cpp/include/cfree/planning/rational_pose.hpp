// Poses with rational coordinates in the user's units.
#pragma once
#include "cfree/contact/contact_line.hpp"
#include "cfree/exact/ratio.hpp"
#include "cfree/free/point_location.hpp"
#include "cfree/search/configuration.hpp"

namespace cfree {

// Half of an orientation, as the direction (q, p) in lowest terms, tau = p / q: q > 0, or it is (0, 1).
struct HalfAngle {
    Int q = 1, p = 0;
    // Half angle of a coordinate in a chart.
    static HalfAngle of(int chart, const Ratio& tau);
    // Half angle of a direction that may not be in lowest terms, or point the other way.
    static HalfAngle along(const Int& x, const Int& y);
    // Chart and coordinate; the border belongs to chart 0.
    int chart() const { return abs(p) <= q ? 0 : 1; }
    Ratio tau() const;
    // The coordinate in a chart, -1 or 1 on the border.
    Ratio tau_in(int which) const { return which == chart() ? tau() : -tau(); }
    Rotation<Int> rotation() const { return {q * q - p * p, 2 * q * p, q * q + p * p}; }
    double theta() const;  // in [0, 2 pi)
    // Turned further, by the half angle of (c, s), which is not (0, 0).
    HalfAngle turned(const Int& c, const Int& s) const;
    friend bool operator==(const HalfAngle&, const HalfAngle&) = default;
};

struct RationalPose {
    Ratio x, y;
    HalfAngle half;
    static RationalPose of(const ExactPose& pose, const Scene& scene);
    Place place() const { return {nearest(x.n, x.d), nearest(y.n, y.d), half.theta()}; }
    ExactPose exact(const Scene& scene) const;
    Configuration configuration(const Scene& scene) const;  // computed without doubles
    friend bool operator==(const RationalPose&, const RationalPose&) = default;
    // Key for order and look-up.
    using Key = std::array<Int, 6>;
    Key key() const { return {x.n, x.d, y.n, y.d, half.q, half.p}; }
};

}  // namespace cfree
