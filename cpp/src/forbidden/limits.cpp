// Lines of contacts and their intersections, in doubles; theory, "The trimmed boundary".
#include "cfree/forbidden/limits.hpp"

#include <algorithm>
#include <cmath>

#include "cfree/support/elementary.hpp"

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
    const ContactLine<double> l(scene, contact, UserUnits{});
    return {l.start(r), l.direction(r)};
}

// Place of the vertex along the edge; 0 and 1 for the edge's own ends.
double Limits::helix_at(const Feature& contact, const Feature& helix) const {
    const bool on_edge = contact.kind == Kind::vertex_edge;
    const Shape& shape = on_edge ? scene.obstacles : scene.robot;
    const Index e = on_edge ? contact.obstacle : contact.robot, x = on_edge ? helix.obstacle : helix.robot;
    const Index v = shape.v[e], w = shape.w[e];
    if (shape.point[x] == shape.point[v]) return 0;
    if (shape.point[x] == shape.point[w]) return 1;
    const UserUnits of;
    const Vec<double> E = of.edge(shape, e), p = of.vertex(shape, x), q = of.vertex(shape, v);
    return ((p.x - q.x) * E.x + (p.y - q.y) * E.y) / (E.x * E.x + E.y * E.y);
}

Limits::Meeting Limits::meets(const Feature& contact, const Line& l, std::uint64_t curve, const Rotation<double>& r) const {
    const Feature f = unpacked(curve);
    if (f.kind == Kind::vertex_vertex) return {helix_at(contact, f), 1};
    const auto [q, v] = line(f, r);
    const double across = v.x * l.u.y - v.y * l.u.x;
    const double t = -(v.x * (l.p.y - q.y) - v.y * (l.p.x - q.x)) / across;
    const double sine = std::abs(across) / (norm(v.x, v.y) * norm(l.u.x, l.u.y));
    return {t > 0 ? std::min(t, 1.0) : 0.0, sine};  // rounding may lead out of the patch
}

}  // namespace cfree
