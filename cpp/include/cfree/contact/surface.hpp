// Points of contact surfaces in bulk. One formula covers both kinds of the paper (eqs. 5 and 8):
//   x = p + t q - R(phi) (a + t g),
// v-e: p = b_j, q = E_j, a = a_i, g = 0;   e-v: p = b_j, q = 0, a = a_i, g = E_i.
#pragma once
#include <cstddef>

namespace cfree {

struct Ruled {
    double px, py, qx, qy, ax, ay, gx, gy;
};

// out[2k], out[2k+1] = x(t[k], phi[k])
void evaluate_points(const Ruled& s, const double* t, const double* phi, std::size_t count, double* out);

// out[(r * nt + k) * 2 + 0, 1] = x(t[k], phi[r]): one sine and cosine a row
void evaluate_grid(const Ruled& s, const double* t, std::size_t nt, const double* phi, std::size_t nphi,
                   double* out);

}  // namespace cfree
