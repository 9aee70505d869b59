// Lines of contacts and their intersections, in doubles; theory, "The trimmed boundary".
#include "cfree/forbidden/limits.hpp"

#include <algorithm>
#include <cmath>

#include "cfree/support/elementary.hpp"
#include "predicates/round_surfaces.hpp"

namespace cfree {

double Limits::inside(double tau, double from, double to) {
    constexpr double a_little = 1e-9;
    const double margin = a_little * std::abs(to - from);
    return std::max(from + margin, std::min(tau, to - margin));
}

std::array<double, 2> Limits::of(Index trapezoid, double tau) const {
    const auto [lower, upper] = crossings(trapezoid, tau);
    return {lower.t, upper.t};
}

std::array<Limits::Meeting, 2> Limits::meetings(Index trapezoid, double theta) const {
    const int chart = boundary.trapezoids.chart[trapezoid];
    return crossings(trapezoid, tangent(0.5 * (theta - chart * std::numbers::pi)));
}

std::array<Limits::Meeting, 2> Limits::crossings(Index trapezoid, double tau) const {
    const Trapezoids& t = boundary.trapezoids;
    const Feature contact = boundary.patches.contact(t.patch[trapezoid]);
    const auto r = rotation_by(t.chart[trapezoid], inside(tau, t.tau_from(trapezoid), t.tau_to(trapezoid)));
    const Line l = line(contact, r);
    return {meets(contact, l, t.lower[trapezoid], r), meets(contact, l, t.upper[trapezoid], r)};
}

Limits::Line Limits::line(const Feature& contact, const Rotation<double>& r) const {
    if (scene.is_round) return round_line(contact, r);
    const ContactLine<double> l(scene, contact, UserUnits{});
    return {l.start(r), l.direction(r)};
}

Limits::Line Limits::round_line(const Feature& contact, const Rotation<double>& r) const {
    const double rho = sum_of_radii(scene, contact) * unit;
    if (is_circle(contact)) {
        const UserUnits of;
        return {of.vertex(scene.obstacles, contact.obstacle) - r(of.vertex(scene.robot, contact.robot)), {0, 0}, rho, contact.branch};
    }
    const ContactLine<double> l(scene, contact, UserUnits{});
    const auto p = l.start(r), u = l.direction(r);
    const double scale = rho / norm(u.x, u.y);
    return {{p.x + scale * u.y, p.y - scale * u.x}, u};
}

Vec<double> Limits::Line::at(double t) const {
    if (!is_circle()) return {p.x + t * u.x, p.y + t * u.y};
    const Vec<double> outwards = on_quadrant(quadrant, radius, t);
    return {p.x + radius * outwards.x, p.y + radius * outwards.y};
}

// Place of the vertex along the edge; 0 and 1 for the edge's own ends.
double Limits::helix_at(const Feature& contact, const Feature& helix) const {
    const bool on_edge = contact.kind == Kind::vertex_edge;
    const Shape& shape = on_edge ? scene.obstacles : scene.robot;
    const Index e = on_edge ? contact.obstacle : contact.robot, x = on_edge ? helix.obstacle : helix.robot;
    const Index v = shape.v[e];
    if (const int end = end_at(shape, e, x); end >= 0) return end;
    const UserUnits of;
    const Vec<double> E = of.edge(shape, e), p = of.vertex(shape, x), q = of.vertex(shape, v);
    return ((p.x - q.x) * E.x + (p.y - q.y) * E.y) / (E.x * E.x + E.y * E.y);
}

Limits::Meeting Limits::meets(const Feature& contact, const Line& l, std::uint64_t curve, const Rotation<double>& r) const {
    const Feature f = unpacked(curve);
    if (scene.is_round && !(is_line(contact) && is_line(f))) return meets_round(contact, l, f, r);
    if (f.kind == Kind::vertex_vertex) return {helix_at(contact, f), 1};
    const Line other = line(f, r);
    const auto &q = other.p, &v = other.u;
    const double across = v.x * l.u.y - v.y * l.u.x;
    const double t = -(v.x * (l.p.y - q.y) - v.y * (l.p.x - q.x)) / across;
    const double sine = std::abs(across) / (norm(v.x, v.y) * norm(l.u.x, l.u.y));
    return {t > 0 ? std::min(t, 1.0) : 0.0, sine};  // rounding may lead out of the patch
}

// A line with a circle, or a circle with any surface: the formulas of predicates/round_surfaces.hpp.
Limits::Meeting Limits::meets_round(const Feature& contact, const Line& l, const Feature& f, const Rotation<double>& r) const {
    const auto within = [](double t, double sine) { return Meeting{t > 0 ? std::min(t, 1.0) : 0.0, sine}; };
    const auto dot_of = [](const Vec<double>& x, const Vec<double>& y) { return x.x * y.x + x.y * y.y; };
    const auto cross_of = [](const Vec<double>& x, const Vec<double>& y) { return x.x * y.y - x.y * y.x; };
    const auto root_of = [](double whole, double part) { return std::sqrt(std::max(0.0, (whole - part) * (whole + part))); };
    const bool is_back = is_circle(contact) && l.radius < 0;
    if (f.kind == Kind::seam) return {(f.branch == contact.branch) == is_back ? 1.0 : 0.0, 1};
    const Line other = line(f, r);
    if (is_line(contact)) {
        if (is_smooth(scene, contact, f)) return {helix_at(contact, f), 1};
        const Vec<double> d = other.p - l.p;
        const double length = norm(l.u.x, l.u.y), root = root_of(other.radius, cross_of(l.u, d) / length);
        const double size = std::abs(other.radius);
        return within(dot_of(d, l.u) / (length * length) + f.branch * root / length, size > 0 ? root / size : 1);
    }
    Vec<double> outwards, d = other.p - l.p;
    double sine = 1, more = other.radius - l.radius;
    if (is_circle(f)) {  // circles that are almost one: differences of exact numbers
        const auto from = [&](const Shape& shape, Index v, Index w) {
            const auto by = difference<Ball>(shape, w, v);
            return Vec<double>{unit * by.x.hi, unit * by.y.hi};
        };
        d = from(scene.obstacles, contact.obstacle, f.obstacle) - r(from(scene.robot, contact.robot, f.robot));
        const Shape &A = scene.robot, &O = scene.obstacles;
        more = unit * (O.radius_of(f.obstacle).about - O.radius_of(contact.obstacle).about +
                       (A.radius_of(f.robot).about - A.radius_of(contact.robot).about)).hi;
    }
    if (is_smooth(scene, f, contact)) {
        const double length = norm(other.u.x, other.u.y);
        outwards = {other.u.y / length, -other.u.x / length};
    } else {
        // n and delta, divided by the length of n
        Vec<double> n = is_line(f) ? Vec<double>{-other.u.y, other.u.x} : d;
        const double length = norm(n.x, n.y);
        n = {n.x / length, n.y / length};
        const double delta = is_line(f) ? cross_of(other.u, d) / length
                                        : 0.5 * (length - more * (l.radius + other.radius) / length);
        const double cosine = delta / l.radius, root = l.radius < 0 ? -root_of(1, cosine) : root_of(1, cosine);
        outwards = {cosine * n.x - f.branch * root * n.y, cosine * n.y + f.branch * root * n.x};
        sine = is_line(f) ? std::abs(root) : other.radius != 0 ? std::min(1.0, std::abs(cross_of(outwards, d) / other.radius)) : 1;
    }
    for (int k = 0; k < l.quadrant; ++k) outwards = {outwards.y, -outwards.x};
    const double t = outwards.y / (1 + std::max(0.0, outwards.x));
    return within(is_back ? from_other_end(t) : t, sine);
}

}  // namespace cfree
