// Compute all from L, s, k and w: V = dx / dphi is k along the ruling and s across it.
#include "cfree/geometry/local_geometry.hpp"

#include <cmath>

#include "cfree/support/elementary.hpp"

namespace cfree {

RulingPoint ruling_point(const Ruled& r, double t, double phi) {
    const double ex = r.qx + r.gx, ey = r.qy + r.gy, L = norm(ex, ey), dx = ex / L, dy = ey / L;
    const auto [c, n] = cosine_sine(phi);
    if (r.gx != 0 || r.gy != 0)  // robot and obstacle are rotated back together, so that no rounding of phi enters
        return {true, L, n * dy - c * dx, -n * dx - c * dy, dx * r.ax + dy * r.ay + t * L, r.ax * dy - r.ay * dx};
    const double ax = c * r.ax - n * r.ay, ay = n * r.ax + c * r.ay;
    return {false, L, dx, dy, -(dx * ax + dy * ay), -(ax * dy - ay * dx)};
}

LocalGeometry local_geometry(const Ruled& r, double t, double phi, double w) {
    const auto [turns, L, ux, uy, s, k] = ruling_point(r, t, phi);
    const double R = norm(w, s), v = L * R, g = turns ? L : 0;
    LocalGeometry at{L * L, L * k, R * R + k * k, 0, -w * g * (g / v), -w * k / R, v,
                     {ux, uy, 0, -s / R * uy, s / R * ux, w / R, w / R * uy, -w / R * ux, s / R}, 0, 0};
    const double root = at.f / v;
    at.K = 0.0 - root * root, at.H = ((at.g / v) * (at.E / v) - 2 * root * (at.F / v)) / 2;
    return at;
}

double ruling_area(const Ruled& r, double lower, double upper, double phi, double w) {
    const RulingPoint first = ruling_point(r, lower, phi), last = ruling_point(r, upper, phi);
    if (!first.turns) return first.L * (upper - lower) * norm(w, first.s);
    const auto primitive = [w](double s) { return 0.5 * (s * norm(w, s) + w * w * std::asinh(s / w)); };
    return primitive(last.s) - primitive(first.s);
}

// On e-v surfaces K v dt = -d(s / R), R = sqrt(w^2 + s^2).
double ruling_curvature(const Ruled& r, double lower, double upper, double phi, double w) {
    const RulingPoint first = ruling_point(r, lower, phi), last = ruling_point(r, upper, phi);
    if (!first.turns) return 0;
    const double s = first.s, S = last.s, R = norm(w, s), Q = norm(w, S);
    if (s * S <= 0) return s / R - S / Q;
    return -(w / R) * (w / Q) * (upper - lower) * first.L * ((S + s) / (S * R + s * Q));  // nothing cancels
}

}  // namespace cfree
