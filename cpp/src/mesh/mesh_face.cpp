// Bounds of the distance of a triangle from its face; theory, "The distance of a triangle".
#include "cfree/mesh/mesh_face.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {
using std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

double square(double x) { return x * x; }
double cube(double x) { return x * x * x; }

// Greatest |cos| from one angle to another.
double most_cosine(double from, double to) {
    if (std::floor(to / pi) > std::floor(from / pi)) return 1;
    return std::max(std::abs(cosine(from)), std::abs(cosine(to)));
}
}  // namespace

Spread::Spread(const Corners& c) {
    const auto [a, b] = std::minmax({c[0]->phi, c[1]->phi, c[2]->phi});
    low = a, high = b, angle = b - a;
    reach = std::max({std::abs(c[0]->s), std::abs(c[1]->s), std::abs(c[2]->s)});
    off = std::max({std::abs(c[0]->off), std::abs(c[1]->off), std::abs(c[2]->off)});
}

double Spread::turn() const { return 1 - square(angle) / 2 * (1 - square(angle) / 12 * (1 - square(angle) / 30)); }

MeshSheet::MeshSheet(const Places& places, const Feature& on, double first, double last, double error, double angle_scale)
    : is_saddle(on.kind == Kind::edge_vertex), from(first), to(last), eps(error), w(angle_scale) {
    const auto parts = places.parts(on);
    direction = parts.edge;
    const Complex normal = -i_unit * direction;
    if (!is_saddle) {
        fixed = parts.a, offset = dot(normal, parts.b);
        return;
    }
    fixed = parts.b, h = dot(normal, parts.a);
    const double start = dot(parts.a, direction), middle = start + 0.5 * parts.length;
    shear = 0.5 * h / norm(w, middle);
}

MeshFace::MeshFace(const Places& places, const Feature& on, const Feature& lower, const Feature& upper, double first,
                   double last,
             double error, double angle_scale)
    : MeshSheet(places, on, first, last, error, angle_scale) {
    if (is_thin()) return;
    curves = {ContactCurve(places, on, lower, first, last), ContactCurve(places, on, upper, first, last)};
    for (int k = 0; k <= 8 && is_saddle; ++k) most_width = std::max(most_width, width_u(from + k * (to - from) / 8));
}

double MeshSheet::position(Complex x, double phi) const {
    return is_saddle ? -dot(x - fixed, std::polar(1.0, phi) * direction) : dot(x, direction);
}

double MeshSheet::gradient(double s) const { return norm(1, s / w); }

Complex MeshSheet::at(double s, double phi, double off) const {
    const Complex z = std::polar(1.0, phi), normal = -i_unit * direction;
    if (is_saddle) return fixed - z * ((h + off) * normal + s * direction);
    return s * direction + (offset - dot(normal, z * fixed)) * normal;
}

double MeshFace::width_u(double phi) const {
    return std::max(0.0, u(position(curves[1].at(phi), phi)) - u(position(curves[0].at(phi), phi)));
}

MeshPoint MeshFace::point(double s, double phi) const {
    const double low = position(curves[0].at(phi), phi), high = position(curves[1].at(phi), phi);
    return {s, phi, {std::max(0.0, s - low), std::max(0.0, high - s)}};
}

MeshPoint MeshFace::point_inside(double s, double phi) const {
    const double low = position(curves[0].at(phi), phi), high = position(curves[1].at(phi), phi);
    s = std::min(std::max(s, low), std::max(low, high));
    return {s, phi, {s - low, std::max(0.0, high - s)}};
}

// A point with weights l of the corners is off the line in its slice by the sum of l_k off_k, minus the sum of
// l_j l_k form(j, k), j < k, up to third order. This is linear in each slice, so the extremes over a triangle are on its
// edges.
double MeshSheet::form(const MeshPoint& p, const MeshPoint& q) const {
    const double phi = q.phi - p.phi;
    return phi * (q.s - p.s + 0.5 * h * phi);
}

// An edge with weights 1 - l and l is off by a linear function, less l (1 - l) (form + at most even + at most odd |1 - 2 l|).
struct MeshSheet::Wave {
    double form, even, odd;
    // Greatest offset on one side, with the values a and b of a linear function at the ends.
    double most(double a, double b, int side) const {
        const double high = even - side * form, rise = std::abs(b - a) + 0.5 * odd;
        if (high > rise) return 0.5 * (a + b) + high / 4 + square(rise) / (4 * high);
        return std::max(a, b) + (high + odd > 0 ? odd / 4 : 0);
    }
};

MeshSheet::Wave MeshSheet::wave(const MeshPoint& p, const MeshPoint& q) const {
    const double angle = std::abs(q.phi - p.phi), third = cube(angle) / 6;
    const double reach = std::max(std::abs(p.s), std::abs(q.s)), off = std::max(std::abs(p.off), std::abs(q.off));
    return {form(p, q),
            0.5 * std::abs(q.s - p.s) * third +
                square(angle) * (square(angle) * (std::abs(h) / 24 + reach * angle / 120) + off / 2),
            0.5 * std::abs(p.s + q.s) * third};
}

// Largest offset on an edge.
double MeshSheet::peak(const MeshPoint& p, const MeshPoint& q) const {
    const Wave of = wave(p, q);
    return std::max(of.most(p.off, q.off, 1), of.most(-p.off, -q.off, -1));
}

double MeshFace::most_form(const Corners& c) const {
    return std::max({std::abs(form(*c[0], *c[1])), std::abs(form(*c[1], *c[2])), std::abs(form(*c[2], *c[0]))});
}

double MeshFace::third_order(const Spread& d) const {
    return d.reach * cube(d.angle) / 48 + std::abs(h) * square(square(d.angle)) / 288 + d.off * square(d.angle) / 8;
}

double MeshSheet::slice_distance(const Corners& c, const Spread& d) const {
    if (is_saddle) return std::max({peak(*c[0], *c[1]), peak(*c[1], *c[2]), peak(*c[2], *c[0])});
    const double turned = std::arg(fixed) - std::arg(-i_unit * direction);
    return std::abs(fixed) * most_cosine(d.low + turned, d.high + turned) * square(d.angle) / 8;
}

// Greatest distance of the foot on the line beyond the face's curves.
double MeshFace::beyond(const Corners& c, const Spread& d) const {
    double most = 0;
    for (int side = 0; side < 2; ++side) {
        std::array<const MeshPoint*, 3> p = c;
        std::sort(p.begin(), p.end(), [&](auto* x, auto* y) { return x->inward[side] < y->inward[side]; });
        const double turn = d.turn(), least = p[0]->inward[side] * turn;
        if (curves[side].bend(d.low, d.high) * square(d.angle) / 8 + d.slip() <= least) continue;
        const double bend = curves[side].bend_near(d.low, d.high), plain = bend * square(d.angle) / 8 - least;
        const double two = std::max(bend * square(p[1]->phi - p[0]->phi) / 8 - least,
                                    bend * square(d.angle) / 2 - p[2]->inward[side] * turn);
        most = std::max(most, std::min(plain, two) + d.slip());
    }
    return most;
}

double MeshSheet::drift(const Spread& d) const {
    return is_saddle ? d.reach * square(d.angle) / 8 + std::abs(h) * cube(d.angle) / 48 : 0;
}

double MeshFace::excess(const Corners& c) const {
    if (is_thin()) return 0;
    const Spread d(c);
    if (d.angle > pi / 2) return infinity;
    const double over = beyond(c, d), plain = norm(slice_distance(c, d), over) / eps;
    if (plain <= 1 || !is_saddle) return plain;
    return std::min(plain, std::max(norm(slice_distance_near_sides(c, d), over) / eps, excess_inside(c)));
}

// Distance within the slice of the points from which a path of length `eps` down the gradient may leave the face by a side.
double MeshFace::slice_distance_near_sides(const Corners& c, const Spread& d) const {
    const double all = slice_distance(c, d), forms = most_form(c) + d.off, turn = d.turn(), margin = eps / w;
    double most = 0;
    // heights of the corners over a side, greatest height of a point that counts, and bend of the side
    const auto add = [&](std::array<double, 3> height, double near_by, double bend) {
        std::array<int, 3> k{0, 1, 2};
        std::sort(k.begin(), k.end(), [&](int x, int y) { return height[x] < height[y]; });
        const double bow = bend * square(d.angle), two = square(c[k[0]]->phi - c[k[1]]->phi);
        if (height[k[0]] - bow / 8 > near_by) return;
        const auto share = [](double part, double whole) { return whole > part ? part / whole : 1.0; };
        const double by_one = std::abs(c[k[0]]->off) + forms * share(near_by, height[k[1]] - bow / 2);
        const double by_two = peak(*c[k[0]], *c[k[1]]) + forms * share(near_by + bend * two / 8, height[k[2]] - bow / 2);
        most = std::max(most, std::min({all, by_one + third_order(d), by_two + third_order(d)}));
    };
    add({c[0]->phi - from, c[1]->phi - from, c[2]->phi - from}, margin, 0);
    add({to - c[0]->phi, to - c[1]->phi, to - c[2]->phi}, margin, 0);
    const double low = std::max(from, d.low - margin), high = std::min(to, d.high + margin);
    for (int side = 0; side < 2; ++side)
        add({c[0]->inward[side] * turn, c[1]->inward[side] * turn, c[2]->inward[side] * turn},
            margin * (curves[side].speed(low, high) + all) + d.slip(), curves[side].bend_near(d.low, d.high));
    return most;
}

// The distance is at most that within the slice over a lower bound G of the gradient near by.
double MeshFace::excess_inside(const Corners& c) const {
    const Spread d(c);
    const double lost = d.slip() + drift(d) +
                        eps * norm(1, (std::abs(h) + eps * norm(1, d.reach / w)) / w);
    const double s = (c[0]->s + c[1]->s + c[2]->s) / 3, r = std::max(0.0, std::abs(s) - lost) / w;
    const double G = norm(1, r), slope = std::copysign(r / (w * G), s);  // the tangent of a convex function
    double most = 0;
    for (int k = 0; k < 3; ++k) {
        const MeshPoint &p = *c[k], &q = *c[(k + 1) % 3];
        const double Gp = G + slope * (p.s - s), Gq = G + slope * (q.s - s);
        const Wave of = wave(p, q);
        for (const int side : {1, -1}) {  // the largest of side * F - eps G on the edge
            const double over = of.most(side * p.off - eps * Gp, side * q.off - eps * Gq, side);
            most = std::max(most, 1 + over / (eps * 0.5 * (Gp + Gq)));
        }
    }
    return most;
}

}  // namespace cfree
