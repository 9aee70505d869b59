// Bounds of a triangle's distance from a line or a circle; theory, "Meshes among rounded shapes".
#include "cfree/mesh/round_face.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cfree/mesh/layout.hpp"
#include "cfree/support/elementary.hpp"
#include "predicates/round_surfaces.hpp"

namespace cfree {

namespace {
using std::numbers::pi;
constexpr double unbounded = std::numeric_limits<double>::infinity();
}  // namespace

RoundFace::RoundFace(const Places& places, const Feature& on, const Feature& lower, const Feature& upper, double first, double last,
                     double error, double angle_scale)
    : is_circle(cfree::is_circle(on)), is_saddle(on.kind != Kind::vertex_edge), from(first), to(last),
      curves{RoundCurve(places, on, lower, first, last), RoundCurve(places, on, upper, first, last)}, eps(error), w(angle_scale) {
    if (!is_circle) {
        line.emplace(places, on, first, last, error, angle_scale);
        const double middle = 0.5 * (curves[0].position(0.5 * (from + to)) + curves[1].position(0.5 * (from + to)));
        unit = is_saddle ? norm(w, std::isfinite(middle) ? middle : 0) : 1, shear = line->shear;
        return;
    }
    a = places.a(on.robot), b = places.b(on.obstacle);
    const double rho = sum_of_radii(places.scene, on) * places.scene.unit();
    radius = std::abs(rho), begin = begin_of(on.branch, rho), side = rho < 0 ? -1 : 1;
    // errors are radius ds^2 + |a| dphi^2
    unit = std::clamp(std::sqrt(std::abs(a) / radius), 0.1, 10.0) / (usual_stretch * usual_stretch);
}

double RoundFace::position(Complex x, double phi) const {
    if (line) return line->position(x, phi);
    const Complex u = x - (b - std::polar(1.0, phi) * a);
    return in_quadrant(side * (std::arg(u) - begin));
}

Complex RoundFace::at(double s, double phi) const {
    if (line) return line->at(s, phi);
    return b - std::polar(1.0, phi) * a + radius * std::polar(1.0, begin + side * s);
}

double RoundFace::within(const Corners& c) const {
    const Spread d(c);
    if (line) return norm(line->slice_distance(c, d), line->drift(d));
    const auto [low, high] = std::minmax({c[0]->s, c[1]->s, c[2]->s});
    return (radius * (high - low) * (high - low) + std::abs(a) * d.angle * d.angle) / 8;
}

double RoundFace::excess(const Corners& c) const {
    if (is_thin() && line) return 0;
    const Spread d(c);
    return d.angle > pi / 2 ? unbounded : within(c) / ((1 - on_rim) * eps);
}

double RoundFace::bow(double first, double last, bool upper) const {
    return (is_circle ? radius : 1.0) * curves[upper].bow(std::max(first, from), std::min(last, to));
}

bool RoundFace::is_close(const MeshPoint& p, const MeshPoint& q, bool upper) const {
    return within({&p, &q, &p}) <= over_chord * eps && bow(std::min(p.phi, q.phi), std::max(p.phi, q.phi), upper) <= on_rim * eps;
}

double RoundFace::side_step() const {
    return is_circle ? std::sqrt(8 * over_chord * eps / radius) : unbounded;
}

double RoundFace::estimate() const {
    double width = 0;
    constexpr int parts = 8;
    for (int k = 0; k < parts; ++k) {
        const double phi = from + (k + 0.5) * (to - from) / parts;
        width += std::abs(curves[1].position(phi) - curves[0].position(phi)) / parts;
    }
    const double high = to - from, room = (1 - on_rim) * eps;
    if (is_circle)
        return width * high * std::sqrt(radius * std::abs(a)) / (2 * room) + width / side_step() + high * std::sqrt(std::abs(a) / room);
    return (is_saddle ? 1.5 * least() : 0) + high * std::sqrt((std::abs(width) + w) / room);
}

double RoundFace::least() const {
    if (!line || !is_saddle || is_thin()) return 0;
    double sum = 0;
    constexpr int parts = 16;
    const auto u_at = [&](const RoundCurve& x, double phi) { return std::asinh(x.position(phi) / w); };
    for (int k = 0; k < parts; ++k) {
        const double phi = from + (k + 0.5) * (to - from) / parts;
        sum += std::max(0.0, u_at(curves[1], phi) - u_at(curves[0], phi));
    }
    return best_density * w * (to - from) * sum / parts / eps;
}

}  // namespace cfree
