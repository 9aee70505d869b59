// Lines of contact at rational orientations, and their ends; theory, "Paths".
#include "cfree/planning/sheet.hpp"

#include <algorithm>

#include "cfree/planning/moving_line.hpp"

namespace cfree {

namespace {

// Divide by the factor r tau - n.
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

// t at the intersection of a line with another, as numerator and denominator.
std::array<Poly, 2> quotient(const MovingLine& one, const MovingLine& other) {
    return {cross(difference(other.P, one.P), other.U), cross(one.U, other.U)};
}

}  // namespace

Sheet::Sheet(const Scene& of_scene, const Feature& on, int in_chart, std::array<std::uint64_t, 2> codes, Ratio from, Ratio to)
    : contact(on), chart(in_chart), curves(codes), low(std::move(from)), high(std::move(to)), scene(of_scene),
      line(scene, contact, CoreUnits<Int>{}) {}

Sheet::Sheet(const Boundary& b, const PointLocation& ends, Index k)
    : contact(b.patches.contact(b.trapezoids.patch[k])), chart(b.trapezoids.chart[k]),
      curves{b.trapezoids.lower[k], b.trapezoids.upper[k]}, face(k), low(ratio_of(b.trapezoids.from_hi[k])),
      high(ratio_of(b.trapezoids.to_lo[k])), scene(*b.scene), points(&ends), line(scene, contact, CoreUnits<Int>{}) {}

Sheet Sheet::of(const Boundary& boundary, const PointLocation& points, Index face) {
    Sheet sheet(boundary, points, face);
    for (unsigned digits = 2 * trusted_bits; sheet.low >= sheet.high; digits *= 2) sheet.refine(digits);
    return sheet;
}

Sheet Sheet::isolated(const Boundary& boundary, Index part) {
    const Trapezoids& table = boundary.isolated.parts;
    return {*boundary.scene, boundary.patches.contact(table.patch[part]), table.chart[part], {table.lower[part], table.upper[part]},
            ratio_of(table.from_hi[part]), ratio_of(table.to_lo[part])};
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

// Constant t of a vertex that is always on the line.
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
    const Int d = cross(l.U, V);
    return d.is_zero() ? limit_around(other, tau) : reduced(cross(Q - l.P, V), d);
}

MovingLine Sheet::moving(const ContactLine<Int>& of) const { return {of, {chart ? -1 : 1, 0, 1}}; }

std::vector<Int> Sheet::trace(std::size_t side) const {
    const Feature f = unpacked(curves[side]);
    const MovingLine own = moving(line);
    std::array<Poly, 2> t;
    if (f.kind == Kind::vertex_vertex) {
        const Ratio at = along(f);
        t = {Poly{at.n}, Poly{at.d}};
    } else {
        t = quotient(own, moving({scene, f, CoreUnits<Int>{}}));
    }
    const auto& [n, d] = t;
    std::array<Poly, 3> parts{sum(product(own.P[0], d), product(n, own.U[0])), sum(product(own.P[1], d), product(n, own.U[1])),
                              product(d, {1, 0, 1})};
    cancel(parts);
    const Int sign = parts[2].back().sign();
    std::vector<Int> name;
    for (const Poly& part : parts) {
        name.push_back(part.size());
        for (const Int& c : part) name.push_back(sign * c);
    }
    return name;
}

// Limit of t at an orientation at which two lines coincide: common factors are divided out.
Ratio Sheet::limit_around(const ContactLine<Int>& other, const Ratio& tau) const {
    auto [n, d] = quotient(moving(line), moving(other));
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

RationalPose middle_of(const Boundary& boundary, const Trapezoids& table, Index row, const Ratio& tau) {
    const Feature contact = boundary.patches.contact(table.patch[row]);
    const Sheet sheet(*boundary.scene, contact, table.chart[row], {table.lower[row], table.upper[row]}, tau, tau);
    const auto [lower, upper] = sheet.limits(tau);
    return sheet.pose((lower + upper) / Ratio{2}, tau);
}

Ratio common_tau(std::initializer_list<Sheet*> sheets) { return common_tau(std::span(sheets.begin(), sheets.size())); }
Ratio common_tau(std::span<Sheet* const> sheets) {
    for (unsigned bits = trusted_bits;;) {
        Ratio low = sheets[0]->low, high = sheets[0]->high;
        for (const Sheet* f : sheets) low = std::max(low, f->low), high = std::min(high, f->high);
        if (low < high) return simple_middle(low, high);
        bits *= 2;
        for (Sheet* f : sheets) f->refine(bits);
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
