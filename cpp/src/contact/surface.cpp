// Points of ruled surfaces; theory, "The paper, and where it is".
#include "cfree/contact/surface.hpp"

#include <cmath>

#include "cfree/support/elementary.hpp"

namespace cfree {

void evaluate_points(const Ruled& s, const double* t, const double* phi, std::size_t count, double* out) {
    for (std::size_t k = 0; k < count; ++k) {
        const auto [c, n] = cosine_sine(phi[k]);
        const double ax = s.ax + t[k] * s.gx, ay = s.ay + t[k] * s.gy;
        out[2 * k] = s.px + t[k] * s.qx - (c * ax - n * ay);
        out[2 * k + 1] = s.py + t[k] * s.qy - (n * ax + c * ay);
    }
}

void evaluate_grid(const Ruled& s, const double* t, std::size_t nt, const double* phi, std::size_t nphi,
                   double* out) {
    for (std::size_t r = 0; r < nphi; ++r) {
        // at a fixed phi the row is a line: x = x0 + t u
        const auto [c, n] = cosine_sine(phi[r]);
        const double x0 = s.px - (c * s.ax - n * s.ay), y0 = s.py - (n * s.ax + c * s.ay);
        const double ux = s.qx - (c * s.gx - n * s.gy), uy = s.qy - (n * s.gx + c * s.gy);
        double* row = out + 2 * r * nt;
        for (std::size_t k = 0; k < nt; ++k) {
            row[2 * k] = x0 + t[k] * ux;
            row[2 * k + 1] = y0 + t[k] * uy;
        }
    }
}

}  // namespace cfree
