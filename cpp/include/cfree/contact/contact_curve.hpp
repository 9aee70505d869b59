// Intersection curves of contact surfaces in closed form, with bounds of their derivatives. With complex z = exp(i phi):
//   x(phi) = c + z m + m' / z + z^2 m'' + e [k cot(psi / 2) + l tan(psi / 2)] / 2,   psi = phi - phi_0.
// Helices: c + z m. Two v-e surfaces: c + z m + m' / z. Two e-v: c + z m + z^2 m''. One of each: c + z m and the last term.
#pragma once
#include <complex>

#include "cfree/contact/contact_line.hpp"

namespace cfree {

using Complex = std::complex<double>;
inline constexpr Complex i_unit{0, 1};

inline Complex complex(const Vec<double>& v) { return {v.x, v.y}; }
inline double dot(Complex u, Complex v) { return u.real() * v.real() + u.imag() * v.imag(); }
inline double cross(Complex u, Complex v) { return u.real() * v.imag() - u.imag() * v.real(); }

// Upper bound of exp(x), not far above it, for x from 0 to 4.
inline double growth(double x) {
    double bound = 1 / (1 - x / 16);
    for (int k = 0; k < 4; ++k) bound *= bound;
    return bound;
}

// Coordinates of robot and obstacles in the user's units: the robot's unchanged, obstacles' from their origin.
struct Places {
    const Scene& scene;
    Vec<double> vertex(const Shape& s, Index v) const {
        return UserUnits{}.vertex(&s == &scene.robot ? s : scene.near().obstacles, v);
    }
    Vec<double> edge(const Shape& s, Index e) const {
        return UserUnits{}.edge(&s == &scene.robot ? s : scene.near().obstacles, e);
    }
    Complex a(Index i) const { return complex(vertex(scene.robot, i)); }
    Complex b(Index j) const { return complex(vertex(scene.obstacles, j)); }
    // The robot's and the obstacle's point of a surface, and the edge's unit vector.
    struct Parts {
        Complex a, b, edge;
        double length;
    };
    Parts parts(const Feature& contact) const;
};

class ContactCurve {
public:
    ContactCurve() = default;
    // Curve between two angles, which decide about removable poles.
    ContactCurve(const Places& places, const Feature& on, const Feature& other, double from, double to);
    Complex at(double phi) const;
    Complex velocity(double phi) const;      // x'
    Complex acceleration(double phi) const;  // x''
    // Bounds of |x'| and |x''| from one angle to another.
    double speed(double from, double to) const;
    double bend(double from, double to) const;
    double bend_near(double from, double to) const;  // a smaller bound if the angles are close
    // Bound of |x - origin| for complex angles between these and within `beyond` of the real ones; infinite at a pole.
    double reach(Complex origin, double from, double to, double beyond) const;

private:
    void meet_parallel(const Places::Parts& p, const Places::Parts& q, bool turning);
    void meet_mixed(const Places::Parts& still, const Places::Parts& turning, double from, double to);
    double half(double phi) const { return 0.5 * (phi - phi_0); }

    Complex c = 0, m = 0, m_back = 0, m_twice = 0, e = 0;
    double k = 0, l = 0, phi_0 = 0;
    double once = 0, twice = 0;  // |m| + |m'| and |m''|
};

}  // namespace cfree
