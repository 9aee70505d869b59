// Everything of L, s, k and w: V = dx / dphi is k along the ruling and s across it.
#include "cfree/geometry/local_geometry.hpp"

#include "cfree/support/elementary.hpp"

namespace cfree {

LocalGeometry local_geometry(const Ruled& r, double t, double phi, double w) {
    const double ex = r.qx + r.gx, ey = r.qy + r.gy, L = norm(ex, ey), dx = ex / L, dy = ey / L, g = norm(r.gx, r.gy);
    const bool is_edge = g > 0;  // of the robot
    const auto [c, n] = cosine_sine(phi);
    double ux = dx, uy = dy, s, k;
    if (is_edge) {  // robot and obstacle are turned back together, so that no rounding of phi enters
        ux = n * dy - c * dx, uy = -n * dx - c * dy;
        s = dx * r.ax + dy * r.ay + t * L, k = r.ax * dy - r.ay * dx;
    } else {
        const double ax = c * r.ax - n * r.ay, ay = n * r.ax + c * r.ay;
        s = -(dx * ax + dy * ay), k = -(ax * dy - ay * dx);
    }
    const double R = norm(w, s), v = L * R;
    LocalGeometry at{L * L, L * k, R * R + k * k, 0, -w * g * (g / v), -w * k / R, v,
                     {ux, uy, 0, -s / R * uy, s / R * ux, w / R, w / R * uy, -w / R * ux, s / R}, 0, 0};
    const double root = at.f / v;
    at.K = 0.0 - root * root, at.H = ((at.g / v) * (at.E / v) - 2 * root * (at.F / v)) / 2;
    return at;
}

}  // namespace cfree
