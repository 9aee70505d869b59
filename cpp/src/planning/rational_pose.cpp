// Convert poses between the planner and the rest of the core; theory, "Poses, exactly".
#include "cfree/planning/rational_pose.hpp"

#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"

namespace cfree {

HalfAngle HalfAngle::of(int chart, const Ratio& tau) {
    if (chart == 0) return {tau.d, tau.n};
    // half a right angle further: tau becomes -1 / tau
    if (tau.n.is_zero()) return {0, 1};
    return tau.n.sign() > 0 ? HalfAngle{tau.n, -tau.d} : HalfAngle{-tau.n, tau.d};
}

HalfAngle HalfAngle::along(const Int& x, const Int& y) {
    if (x.is_zero()) return {0, 1};
    const Ratio slope = reduced(y, x);
    return {slope.d, slope.n};
}

Ratio HalfAngle::tau() const {
    if (chart() == 0) return {p, q};
    return p.sign() > 0 ? Ratio{-q, p} : Ratio{q, -p};
}

HalfAngle HalfAngle::turned(const Int& c, const Int& s) const {
    Int x = q * c - p * s, y = q * s + p * c;
    const Int common = x.sign() < 0 || (x.is_zero() && y.sign() < 0) ? Int(-gcd(x, y)) : gcd(x, y);
    return {x / common, y / common};
}

double HalfAngle::theta() const {
    constexpr double pi = std::numbers::pi;
    if (q.is_zero()) return pi;
    const Ratio local = tau();
    if (chart() == 1) return pi + 2 * arc_tangent(nearest(local.n, local.d));
    const double theta = 2 * arc_tangent(nearest(local.n, local.d));
    const double positive = theta < 0 ? theta + 2 * pi : theta;
    return positive < 2 * pi ? positive : 0;
}

RationalPose RationalPose::of(const ExactPose& q, const Scene& scene) {
    const Int unit = q.W * scene.scale;
    return {reduced(q.X, unit), reduced(q.Y, unit), HalfAngle::of(q.chart, reduced(q.p, q.r))};
}

ExactPose RationalPose::exact(const Scene& scene) const {
    const Int unit = x.d == y.d ? x.d : lcm(x.d, y.d);
    const Ratio tau = half.tau();
    return {x.n * (unit / x.d) * scene.scale, y.n * (unit / y.d) * scene.scale, unit, half.chart(), tau.n, tau.d};
}

Configuration RationalPose::configuration(const Scene& scene) const {
    const Int unit = x.d == y.d ? x.d : lcm(x.d, y.d);
    return {half.q, half.p, x.n * (unit / x.d) * scene.scale, y.n * (unit / y.d) * scene.scale, unit, 0, 0, 0};
}

}  // namespace cfree
