#include "cfree/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cfree {

namespace {
constexpr Complex i_unit{0, 1};
constexpr double pi = std::numbers::pi, infinity = std::numeric_limits<double>::infinity();

double square(double x) { return x * x; }

// The greatest |cos| from one angle to another.
double most_cosine(double from, double to) {
    if (std::floor(to / pi) > std::floor(from / pi)) return 1;
    return std::max(std::abs(std::cos(from)), std::abs(std::cos(to)));
}
}  // namespace

struct Sheet::Spread {
    explicit Spread(const Corners& c) {
        const auto [a, b] = std::minmax({c[0]->phi, c[1]->phi, c[2]->phi});
        low = a, high = b, angle = b - a;
        reach = std::max({std::abs(c[0]->s), std::abs(c[1]->s), std::abs(c[2]->s)});
    }
    double low, high, angle, reach;
};

Sheet::Sheet(const Places& places, const Feature& on, const Feature& lower, const Feature& upper, double first, double last,
             double error, double angle_scale)
    : is_saddle(on.kind == Kind::edge_vertex), from(first), to(last),
      curves{ContactCurve(places, on, lower, first, last), ContactCurve(places, on, upper, first, last)}, eps(error),
      w(angle_scale) {
    const auto parts = places.parts(on);
    direction = parts.edge;
    const Complex normal = -i_unit * direction;
    if (!is_saddle) {
        fixed = parts.a, offset = dot(normal, parts.b);
        return;
    }
    fixed = parts.b, h = dot(normal, parts.a);
    const double start = dot(parts.a, direction), middle = start + 0.5 * parts.length;
    shear = 0.5 * h / std::hypot(w, middle);
    for (int k = 0; k <= 8; ++k) most_width = std::max(most_width, width_u(from + k * (to - from) / 8));
}

double Sheet::position(Complex x, double phi) const {
    return is_saddle ? -dot(x - fixed, std::polar(1.0, phi) * direction) : dot(x, direction);
}

Complex Sheet::at(double s, double phi) const {
    const Complex z = std::polar(1.0, phi), normal = -i_unit * direction;
    if (is_saddle) return fixed - z * (h * normal + s * direction);
    return s * direction + (offset - dot(normal, z * fixed)) * normal;
}

double Sheet::width_u(double phi) const {
    return std::max(0.0, u(position(curves[1].at(phi), phi)) - u(position(curves[0].at(phi), phi)));
}

MeshPoint Sheet::point(double s, double phi) const {
    const double low = position(curves[0].at(phi), phi), high = position(curves[1].at(phi), phi);
    return {s, phi, {std::max(0.0, s - low), std::max(0.0, high - s)}};
}

// In its own slice a point with weights l of the corners is off the line by the sum of l_j l_k form(j, k), j < k, up to third
// order; of a product of two linear forms the extremes over a triangle are in the middles of its edges.
double Sheet::form(const MeshPoint& p, const MeshPoint& q) const {
    const double phi = q.phi - p.phi;
    return phi * (q.s - p.s + 0.5 * h * phi);
}

double Sheet::slice_distance(const Corners& c, const Spread& d) const {
    if (!is_saddle) {
        const double turned = std::arg(fixed) - std::arg(-i_unit * direction);
        return std::abs(fixed) * most_cosine(d.low + turned, d.high + turned) * square(d.angle) / 8;
    }
    double most = 0;
    for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(form(*c[k], *c[(k + 1) % 3])));
    return most / 4 + d.reach * std::pow(d.angle, 3) / 48 + std::abs(h) * std::pow(d.angle, 4) / 288;
}

// How far the foot on the line may be beyond the face's curves.
double Sheet::beyond(const Corners& c, const Spread& d) const {
    double most = 0;
    for (int side = 0; side < 2; ++side) {
        std::array<const MeshPoint*, 3> p = c;
        std::sort(p.begin(), p.end(), [&](auto* x, auto* y) { return x->inward[side] < y->inward[side]; });
        const double bend = curves[side].bend(d.low, d.high), turn = std::cos(d.angle);
        const double least = p[0]->inward[side] * turn;
        const double plain = bend * square(d.angle) / 8 - least;
        const double two = std::max(bend * square(p[1]->phi - p[0]->phi) / 8 - least,
                                    bend * square(d.angle) / 2 - p[2]->inward[side] * turn);
        most = std::max(most, std::min(plain, two));
    }
    return most;
}

double Sheet::excess(const Corners& c) const {
    const Spread d(c);
    if (d.angle > pi / 2) return infinity;
    const double plain = std::hypot(slice_distance(c, d), beyond(c, d)) / eps;
    return plain <= 1 || !is_saddle || !is_far(c, d) ? plain : std::min(plain, excess_inside(c));
}

// Nothing outside the face is within `eps` of the triangle.
bool Sheet::is_far(const Corners& c, const Spread& d) const {
    const double margin = eps / w;
    if (d.low - from < margin || to - d.high < margin) return false;
    for (int side = 0; side < 2; ++side) {
        const auto in = [&](int k) { return c[k]->inward[side]; };
        const double speed = curves[side].speed(d.low - margin, d.high + margin), bend = curves[side].bend(d.low, d.high);
        const double least = std::min({in(0), in(1), in(2)}) * std::cos(d.angle) - bend * square(d.angle) / 8;
        const double width = std::max({c[0]->inward[0] + c[0]->inward[1], c[1]->inward[0] + c[1]->inward[1],
                                       c[2]->inward[0] + c[2]->inward[1]});
        if (least <= eps * (1 + (speed + width + eps) / w)) return false;
    }
    return true;
}

// The distance is at most that within the slice over a lower bound G of the gradient near by.
double Sheet::excess_inside(const Corners& c) const {
    const Spread d(c);
    const double rest = d.reach * std::pow(d.angle, 3) / 48 + std::abs(h) * std::pow(d.angle, 4) / 288;
    const double lost = d.reach * square(d.angle) / 8 + std::abs(h) * std::pow(d.angle, 3) / 48 +
                        eps * std::hypot(1, (std::abs(h) + eps * std::hypot(1, d.reach / w)) / w);
    const double s = (c[0]->s + c[1]->s + c[2]->s) / 3, r = std::max(0.0, std::abs(s) - lost) / w;
    const double G = std::hypot(1, r), slope = std::copysign(r / (w * G), s);  // the tangent of a convex function
    double most = 0;
    for (int k = 0; k < 3; ++k) {
        const MeshPoint &p = *c[k], &q = *c[(k + 1) % 3];
        const double Gp = G + slope * (p.s - s), Gq = G + slope * (q.s - s);
        const double off = std::abs(form(p, q)), tilt = eps * std::abs(Gq - Gp);
        most = std::max(most, tilt >= off ? rest / (eps * std::min(Gp, Gq))
                                          : (off / 4 + square(tilt) / (4 * off) + rest) / (eps * 0.5 * (Gp + Gq)));
    }
    return most;
}

}  // namespace cfree
