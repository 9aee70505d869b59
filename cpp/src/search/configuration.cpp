// Poses on a grid, and the one motion between two of them; theory, "Motions".
#include "cfree/search/configuration.hpp"

#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"

namespace cfree {

using std::numbers::pi;

Configuration Grid::exact(double px, double py, double theta) const {
    Configuration q;
    q.theta = std::remainder(theta, 2 * pi);
    const bool beside = std::abs(q.theta) > 0.5 * pi;  // true if half the angle is nearer to the y axis
    const double half = 0.5 * (beside ? q.theta - std::copysign(pi, q.theta) : q.theta);
    const auto across = static_cast<long long>(std::llround(std::ldexp(tangent(half), angle_bits)));
    const long long one = 1LL << angle_bits;
    q.hx = beside ? -across : one, q.hy = beside ? one : across;
    q.theta = 2 * arc_tangent(static_cast<double>(beside ? one : across), static_cast<double>(beside ? -across : one));
    if (q.theta > pi) q.theta -= 2 * pi;
    const double x = std::nearbyint(std::ldexp(px, place_bits)), y = std::nearbyint(std::ldexp(py, place_bits));
    q.px = std::ldexp(x, -place_bits), q.py = std::ldexp(y, -place_bits);
    const int by = shift - place_bits;
    q.x = Int(x), q.y = Int(y), q.unit = 1;  // whole numbers
    if (by >= 0) q.x <<= static_cast<unsigned>(by), q.y <<= static_cast<unsigned>(by);
    else q.unit <<= static_cast<unsigned>(-by);
    return q;
}

Motion motion_between(const Configuration& a, const Configuration& b) {
    Motion m;
    m.c = a.hx * a.hx - a.hy * a.hy, m.s = 2 * a.hx * a.hy, m.w = a.hx * a.hx + a.hy * a.hy;
    Int q = b.hx * a.hx + b.hy * a.hy, p = b.hy * a.hx - b.hx * a.hy;
    if (q < 0 || (q == 0 && p < 0)) q = -q, p = -p;
    const bool same = a.unit == b.unit;
    const Int unit = same ? a.unit : Int(a.unit * b.unit);
    const Int ax = same ? a.x : Int(a.x * b.unit), ay = same ? a.y : Int(a.y * b.unit);
    const Int bx = same ? b.x : Int(b.x * a.unit), by = same ? b.y : Int(b.y * a.unit);
    m.turns = !p.is_zero();
    if (!m.turns) {
        m.x = ax, m.y = ay, m.unit = unit, m.vx = bx - ax, m.vy = by - ay, m.start = m.q = 1, m.p = 0;
        return m;
    }
    const Int g = gcd(q, p);
    q /= g, p /= g;
    const Int twice = p < 0 ? Int(-2 * p) : Int(2 * p);  // the pole is ((a + b) p + q J (b - a)) / 2 p
    m.unit = unit * twice, m.x = ax * twice, m.y = ay * twice;
    m.vx = (ax + bx) * p - q * (by - ay), m.vy = (ay + by) * p + q * (bx - ax);
    if (p < 0) m.vx = -m.vx, m.vy = -m.vy;
    m.q = q, m.p = p, m.start = root_below(q * q + p * p);
    return m;
}

double turn_between(const Configuration& a, const Configuration& b) { return wrapped(b.theta - a.theta); }

double wrapped(double angle) {
    while (angle > pi) angle -= 2 * pi;  // exact, like std::remainder
    while (angle < -pi) angle += 2 * pi;
    return angle;
}

double travel_between(const Configuration& a, const Configuration& b) {
    return arc_over(norm(b.px - a.px, b.py - a.py), turn_between(a, b));
}

double arc_over(double chord, double turn) {
    const double half = 0.5 * std::abs(turn);
    return half > 1e-6 ? chord * half / sine(half) : chord;
}

Place along(const Place& a, const Place& b, double share) {
    const double turn = wrapped(b.theta - a.theta), half = 0.5 * turn, dx = b.x - a.x, dy = b.y - a.y;
    if (std::abs(half) < 1e-9) return {a.x + share * dx, a.y + share * dy, a.theta + share * turn};
    // from a: the chord of share * turn, which leaves the whole chord's direction by the rest's half
    const double scale = sine(share * half) / sine(half), off = (share - 1) * half;
    const CosineSine to = cosine_sine(off);
    const double c = to.c * scale, s = to.s * scale;
    return {a.x + c * dx - s * dy, a.y + s * dx + c * dy, a.theta + share * turn};
}

}  // namespace cfree
