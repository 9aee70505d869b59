// Axle poses from robot poses and back; theory, "Vehicles".
#include "cfree/vehicles/vehicle.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "cfree/support/elementary.hpp"

namespace cfree {

using std::numbers::pi;

namespace {

// a + sign * (rotation by twice the half angle h) (x, y) / unit
void shift_by(Configuration& a, const Half& h, const Int& x, const Int& y, const Int& unit, int sign) {
    if (x.is_zero() && y.is_zero()) return;
    const Half square = h * h;
    const Int w = h.x * h.x + h.y * h.y, more = w * unit;
    Int dx = (square.x * x - square.y * y) * a.unit, dy = (square.y * x + square.x * y) * a.unit;
    if (sign < 0) dx = -dx, dy = -dy;
    a.x = a.x * more + dx, a.y = a.y * more + dy, a.unit *= more;
}

void set_half(Configuration& q, const Half& h) { q.hx = h.x, q.hy = h.y; }

}  // namespace

Configuration Vehicle::axle_of(const Configuration& robot) const {
    Configuration q = robot;
    shift_by(q, half_of(robot), ax, ay, unit, 1);
    set_half(q, simple(half_of(robot) * Half{hx, hy}));
    const Int common = gcd(gcd(q.x, q.y), q.unit);
    if (common > 1) q.x /= common, q.y /= common, q.unit /= common;
    const CosineSine r = cosine_sine(robot.theta);
    q.px += r.c * axle.x - r.s * axle.y, q.py += r.s * axle.x + r.c * axle.y;
    q.theta = wrapped(robot.theta + axle.theta);
    return q;
}

Configuration Vehicle::robot_of(const Configuration& of) const {
    Configuration q = of;
    const Half h = half_of(of) * Half{hx, -hy};
    set_half(q, h);
    shift_by(q, h, ax, ay, unit, -1);
    q.theta = wrapped(of.theta - axle.theta);
    if (ax.is_zero() && ay.is_zero()) return q;
    // not from the doubles of the axle: it may be far away
    q.px = std::ldexp(ratio(q.x, q.unit), -shift), q.py = std::ldexp(ratio(q.y, q.unit), -shift);
    return q;
}

Place Vehicle::axle_of(const Place& of) const {
    const CosineSine r = cosine_sine(of.theta);
    return {of.x + (r.c * axle.x - r.s * axle.y), of.y + (r.s * axle.x + r.c * axle.y), wrapped(of.theta + axle.theta)};
}

Place Vehicle::robot_of(const Place& of) const {
    const double theta = wrapped(of.theta - axle.theta);
    const CosineSine r = cosine_sine(theta);
    return {of.x - (r.c * axle.x - r.s * axle.y), of.y - (r.s * axle.x + r.c * axle.y), theta};
}

Half simple(const Half& a) {
    const Int common = gcd(a.x, a.y);
    if (common <= 1) return a;
    return {a.x / common, a.y / common};
}

Half simplest_half(double angle, double tolerance) {
    const bool beside = std::abs(angle) > 0.5 * pi;
    const double half = 0.5 * (beside ? angle - std::copysign(pi, angle) : angle);
    const double t = tangent(std::abs(half)), near = 0.5 * tolerance;
    // convergents p / q of t
    double rest = t, p = 0, q = 1, before_p = 1, before_q = 0;
    for (int k = 0; k < 40 && std::abs(t - p / q) > near; ++k) {
        rest = 1 / rest;
        const double whole = std::floor(rest);
        rest -= whole;
        std::swap(p, before_p), std::swap(q, before_q);
        p += whole * before_p, q += whole * before_q;
        if (rest == 0 || q > 0x1p+50) break;
    }
    const Int x(q), y(half < 0 ? -p : p);
    if (!beside) return {x, y};
    return angle > 0 ? Half{-y, x} : Half{y, -x};  // a right angle further
}

double angle_of(const Half& a) {
    if (a.x.is_zero()) return pi;
    const Int size = abs(a.x) > abs(a.y) ? abs(a.x) : abs(a.y);
    const int by = static_cast<int>(msb(size)) - 900;
    if (by > 0) return angle_of({a.x >> static_cast<unsigned>(by), a.y >> static_cast<unsigned>(by)});
    return wrapped(2 * arc_tangent(static_cast<double>(a.y), static_cast<double>(a.x)));
}

Place seen_from(const Configuration& a, const Configuration& b) {
    const Half turn = conjugate(half_of(a)) * half_of(b), h = half_of(a), back = conjugate(h * h);
    const bool same = a.unit == b.unit;
    const Int x = same ? Int(b.x - a.x) : Int(b.x * a.unit - a.x * b.unit), y = same ? Int(b.y - a.y) : Int(b.y * a.unit - a.y * b.unit);
    const Int unit = (same ? a.unit : Int(a.unit * b.unit)) * (h.x * h.x + h.y * h.y);
    const auto [u, v] = Half{x, y} * back;
    return {ratio(u, unit), ratio(v, unit), angle_of(turn)};
}

}  // namespace cfree
