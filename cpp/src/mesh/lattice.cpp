// Layout in the lattice of best triangles. On the surface the edges are (1/g, g), (1, -1) and (g, 1/g), g the golden ratio,
// with |dx dy| = 1. A third of the error below it, |dx dy| is 2/3 for two of them and 4/3 for the third, (k, -k).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/mesh/layout.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

constexpr double golden = std::numbers::phi;
constexpr double rim_gap = 0.1;   // least distance of points from the rim, in units of the lattice
constexpr double rim_cost = 1.1;  // measured extra triangles per unit of the rim

class Lattice {
public:
    // Lattice on a face, mirrored if helices lean to the other side.
    Lattice(const MeshFace& on, double most_error, bool free)
        : face(on), error(most_error), stretch(usual_stretch), side(on.shear < 0 ? -1 : 1),
          m(free ? 1 - 1 / std::numbers::sqrt3 : 1 / golden), n(free ? 1 + 1 / std::numbers::sqrt3 : golden),
          k(free ? 2 / std::numbers::sqrt3 : 1), off(free ? -1.0 / 3 : 0), unit(2 * std::sqrt(most_error / on.scale())) {}

    Layout run() {
        Layout result;
        result.stretch = stretch, result.lean = -face.shear;
        result.triangles = triangles_of_lattice(face, error);
        unit *= scale();
        double left = 1e300, right = -1e300;
        for (int part = 0; part <= 16; ++part) {
            const double phi = face.from + part * (face.to - face.from) / 16, x = low(phi) + face.shear * phi;
            left = std::min(left, x / stretch), right = std::max(right, (x + face.width_u(phi)) / stretch);
        }
        const double x0 = 0.5 * (left + right), y0 = 0.5 * (face.from + face.to) * stretch, gap = rim_gap * unit;
        const double wide = 0.5 * (right - left) / unit, high = 0.5 * (face.to - face.from) * stretch / unit;
        const auto rows = static_cast<Index>(std::ceil((wide * n + high * m) / (k * (m + n)))) + 2;
        for (Index j = -rows; j <= rows; ++j) {
            heed_stop();
            const auto from = static_cast<Index>(std::floor((-high + j * k) / n));
            const auto to = static_cast<Index>(std::ceil((high + j * k) / n));
            for (Index i = from; i <= to; ++i) {
                const double x = x0 + side * unit * (i * m + j * k), phi = (y0 + unit * (i * n - j * k)) / stretch;
                if (x < left || x > right || phi < face.from + gap / stretch || phi > face.to - gap / stretch) continue;
                const double u = stretch * x - face.shear * phi, above = u - low(phi);
                if (above > gap * stretch && face.width_u(phi) - above > gap * stretch)
                    result.inside.push_back({u, phi, lifted(u)});
            }
        }
        return result;
    }

private:
    double low(double phi) const { return face.u(face.position(face.curves[0].at(phi), phi)); }
    double lifted(double u) const { return side * off * error * face.gradient(face.s(u)); }

    // Largest share of the ideal area at which triangles of the lattice fit everywhere.
    double scale() const {
        const double phi = 0.5 * (face.from + face.to), left = low(phi), wide = face.width_u(phi);
        const auto fits = [&](double share) {
            for (int part = 0; part <= 16; ++part) {
                std::array<MeshPoint, 3> p;
                const double x[] = {0, m, n}, y[] = {0, n, m};
                for (int c = 0; c < 3; ++c) {
                    const double dy = share * unit * y[c] / stretch;
                    const double u = left + wide * part / 16 + side * stretch * share * unit * (x[c] - 0.76) - face.shear * dy;
                    p[c] = {face.s(u), phi + dy, {0, 0}};
                    p[c].off = lifted(u);
                }
                if (face.excess_inside({&p[0], &p[1], &p[2]}) > 1) return false;
            }
            return true;
        };
        double share = 1;
        while (share > 0.5 && !fits(share)) share *= 0.985;
        return share;
    }

    const MeshFace& face;
    const double error, stretch, side, m, n, k, off;
    double unit;
};

}  // namespace

// Integral of the best known density over the face, by Simpson's rule.
double least_triangles(const MeshFace& face, double error) {
    if (!face.is_saddle || face.is_thin()) return 0;
    double sum = 0;
    const int parts = 16;
    for (int k = 0; k <= parts; ++k)
        sum += (k == 0 || k == parts ? 1 : k % 2 ? 4 : 2) * face.width_u(face.from + k * (face.to - face.from) / parts);
    return best_density * face.scale() * (face.to - face.from) * sum / (3 * parts) / error;
}

double triangles_of_lattice(const MeshFace& face, double error) {
    const double around = 2 * (face.to - face.from) + face.width_u(face.from) + face.width_u(face.to);
    return 1.033 * least_triangles(face, error) + rim_cost * around / (2 * std::sqrt(error / face.scale()));
}

Layout lattice_over(const MeshFace& face, double error, bool free) { return Lattice(face, error, free).run(); }

}  // namespace cfree
