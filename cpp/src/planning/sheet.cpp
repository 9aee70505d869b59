// Lines of contact at rational orientations, and where they end; theory, "Paths".
#include "cfree/planning/sheet.hpp"

#include <algorithm>

namespace cfree {

namespace {

constexpr unsigned finest = 32;  // bits of tau that doubles are trusted with

Ratio ratio_of(const Dyadic& x) { return reduced(x.n, Int(1) << x.k); }

// Positions of a contact line times 1 + tau^2, polynomials in tau.
struct Moving {
    std::array<Poly, 2> P, U;
    Moving(const ContactLine<Int>& l, int chart) {
        const Int sign = chart ? -1 : 1;
        const auto turned = [&](const Vec<Int>& fixed, const Vec<Int>& v) {  // fixed - R v
            const Int x = sign * v.x, y = sign * v.y;
            return std::array{Poly{fixed.x - x, 2 * y, fixed.x + x}, Poly{fixed.y - y, -2 * x, fixed.y + y}};
        };
        const Vec<Int> none{0, 0};
        P = turned(l.b, l.a);
        U = l.on_edge ? turned(l.E, none) : turned(none, l.E);
    }
};
Poly cross(const std::array<Poly, 2>& u, const std::array<Poly, 2>& v) {
    return difference(product(u[0], v[1]), product(u[1], v[0]));
}
// n^k r^(degree - k) of a root n / r, summed up.
Int value_at(const Poly& f, const Ratio& at) {
    Int value = 0, power = 1;
    for (int k = f.size(); k-- > 0; power *= at.d) value = value * at.n + f[k] * power;
    return value;
}
// Without the factor r tau - n.
Poly divided(const Poly& f, const Ratio& root) {
    Poly result;
    result.resize(f.size() - 1);
    Int carried = 0;
    for (int k = f.size(); k-- > 1;) {
        carried = (f[k] + carried * root.n) / root.d;
        result[k - 1] = carried;
    }
    return result;
}

}  // namespace

Sheet::Sheet(const Scene& of_scene, const Feature& on, int in_chart, std::array<std::uint64_t, 2> codes, Ratio from, Ratio to)
    : contact(on), chart(in_chart), curves(codes), low(std::move(from)), high(std::move(to)), scene(of_scene),
      line(scene, contact, CoreUnits<Int>{}) {}

Sheet::Sheet(const Boundary& b, const PointLocation& ends, Index k)
    : contact(b.patches.contact(b.trapezoids.patch[k])), chart(b.trapezoids.chart[k]),
      curves{b.trapezoids.lower[k], b.trapezoids.upper[k]}, face(k), low(cfree::ratio_of(b.trapezoids.from_hi[k])),
      high(cfree::ratio_of(b.trapezoids.to_lo[k])), scene(*b.scene), points(&ends), line(scene, contact, CoreUnits<Int>{}) {}

Sheet Sheet::of(const Boundary& boundary, const PointLocation& points, Index face) {
    Sheet sheet(boundary, points, face);
    for (unsigned digits = 2 * finest; sheet.low >= sheet.high; digits *= 2) sheet.refine(digits);
    return sheet;
}

void Sheet::refine(unsigned digits) {
    if (!points || digits <= bits) return;
    low = ratio_of(points->angle(face, false, digits)[1]), high = ratio_of(points->angle(face, true, digits)[0]);
    bits = digits;
}

Sheet::Line Sheet::at(const HalfAngle& half) const {
    const auto r = half.rotation();
    return {line.start(r), line.direction(r), r.w};
}

// t of a vertex on the line, where it always is.
Ratio Sheet::along(const Feature& helix) const {
    const Vec<Int> to = line.on_edge ? CoreUnits<Int>{}.vertex(scene.obstacles, helix.obstacle) - line.b
                                     : CoreUnits<Int>{}.vertex(scene.robot, helix.robot) - line.a;
    return reduced(dot(to, line.E), dot(line.E, line.E));
}

Ratio Sheet::limit(std::uint64_t curve, const HalfAngle& half, const Line& l, const Ratio& tau) const {
    const Feature f = unpacked(curve);
    if (f.kind == Kind::vertex_vertex) return along(f);
    const ContactLine<Int> other(scene, f, CoreUnits<Int>{});
    const auto r = half.rotation();
    const Vec<Int> Q = other.start(r), V = other.direction(r);
    const Int d = cfree::cross(l.U, V);
    return d.is_zero() ? limit_around(other, tau) : reduced(cfree::cross(Q - l.P, V), d);
}

// Where two lines coincide: common factors are divided out.
Ratio Sheet::limit_around(const ContactLine<Int>& other, const Ratio& tau) const {
    const Moving one(line, chart), two(other, chart);
    Poly n = cross({difference(two.P[0], one.P[0]), difference(two.P[1], one.P[1])}, two.U), d = cross(one.U, two.U);
    while (!d.empty() && value_at(d, tau).is_zero() && value_at(n, tau).is_zero()) {
        d = divided(d, tau);
        if (!n.empty()) n = divided(n, tau);
    }
    if (d.empty() || value_at(d, tau).is_zero()) throw std::logic_error("a curve has no end");
    // both over the same power of the denominator
    const int more = d.size() - n.size();
    Int above = value_at(n, tau), below = value_at(d, tau);
    for (int k = 0; k < more; ++k) above *= tau.d;
    for (int k = more; k < 0; ++k) below *= tau.d;
    return reduced(above, below);
}

std::pair<Ratio, Ratio> Sheet::limits(const Ratio& tau) const {
    const HalfAngle half = HalfAngle::of(chart, tau);
    const Line l = at(half);
    return {limit(curves[0], half, l, tau), limit(curves[1], half, l, tau)};
}

Ratio Sheet::middle(const Ratio& tau) const {
    const auto [lower, upper] = limits(tau);
    return simple_middle(lower, upper);
}

RationalPose Sheet::pose(const Ratio& t, const HalfAngle& half) const {
    const Line l = at(half);
    const Int d = l.w * t.d * scene.scale;
    return {reduced(l.P.x * t.d + t.n * l.U.x, d), reduced(l.P.y * t.d + t.n * l.U.y, d), half};
}

Ratio Sheet::t_of(const RationalPose& pose, const Ratio& tau) const {
    const Line l = at(tau);
    const Int by = scene.scale * l.w;
    const Int x = pose.x.n * by - l.P.x * pose.x.d, y = pose.y.n * by - l.P.y * pose.y.d;
    return reduced(x * l.U.x * pose.y.d + y * l.U.y * pose.x.d, pose.x.d * pose.y.d * dot(l.U, l.U));
}

Ratio common_tau(Sheet& f, Sheet& g) {
    for (unsigned bits = finest;;) {
        const Ratio &low = std::max(f.low, g.low), &high = std::min(f.high, g.high);
        if (low < high) return simple_middle(low, high);
        bits *= 2;
        f.refine(bits), g.refine(bits);
    }
}

std::optional<std::pair<Ratio, Ratio>> common_part(const Sheet& f, const Ratio& sigma, const Sheet& g, const Ratio& tau) {
    const auto [first, last] = f.limits(sigma);
    const auto [least, most] = g.limits(tau);
    Ratio from = f.t_of(g.pose(least, tau), sigma), to = f.t_of(g.pose(most, tau), sigma);
    if (to < from) std::swap(from, to);
    const Ratio &low = std::max(first, from), &high = std::min(last, to);
    if (low >= high) return {};
    const Ratio t = simple_middle(low, high), s = g.t_of(f.pose(t, sigma), tau);
    if (!(least < s && s < most)) return {};
    return std::pair{t, s};
}

}  // namespace cfree
