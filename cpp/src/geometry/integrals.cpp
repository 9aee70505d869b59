// Three integrands: the area element and K, integrated over t in closed form, and the geodesic curvature of sides. In the frame
// along and across the ruling u, a curve (x(theta), w theta) of the surface has the velocity (x'.u, R), R^2 = w^2 + s^2. Its
// acceleration (x'', 0) has the parts x''.u and (x''.Ju) s / R.
#include "cfree/geometry/integrals.hpp"

#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "cfree/contact/round_curve.hpp"
#include "cfree/geometry/local_geometry.hpp"
#include "cfree/support/elementary.hpp"

namespace cfree {

TrapezoidLine trapezoid_line(const Limits& limits, Index trapezoid, double theta) {
    const auto [lower, upper] = limits.meetings(trapezoid, theta);
    return {trapezoid, theta, lower.t, std::max(lower.t, upper.t), lower.sine, upper.sine};
}

std::array<double, 2> angles_of(const Boundary& boundary, Index trapezoid) {
    const Trapezoids& table = boundary.trapezoids;
    const int chart = table.chart[static_cast<std::size_t>(trapezoid)];
    return {theta_of(chart, table.tau_from(trapezoid)), theta_of(chart, table.tau_to(trapezoid))};
}

namespace {

Ruled ruled(const Boundary& boundary, Index trapezoid) {
    const Feature contact = boundary.patches.contact(boundary.trapezoids.patch[static_cast<std::size_t>(trapezoid)]);
    ContactLine<double> l(*boundary.scene, contact, Places{*boundary.scene});
    if (boundary.scene->is_round) move_outwards(l, sum_of_radii(*boundary.scene, contact) * boundary.scene->unit());
    if (l.on_edge) return {l.b.x, l.b.y, l.E.x, l.E.y, l.a.x, l.a.y, 0, 0};
    return {l.b.x, l.b.y, 0, 0, l.a.x, l.a.y, l.E.x, l.E.y};
}

// Patch of a circle at an orientation: s = |a| sin(psi - alpha), a + bi the robot's vertex turned by theta, alpha its angle.
struct CircleAt {
    Complex a;
    double radius, first, last;  // angles psi
    double s(double psi) const { return cross(a, std::polar(1.0, psi)); }
};
std::optional<CircleAt> circle_at(const Boundary& boundary, const Limits& limits, const TrapezoidLine& at) {
    if (!boundary.scene->is_round) return {};
    const Feature contact = boundary.patches.contact(boundary.trapezoids.patch[static_cast<std::size_t>(at.trapezoid)]);
    if (contact.kind != Kind::vertex_vertex) return {};
    const auto [c, s] = cosine_sine(at.theta);
    const Limits::Line l = limits.line(contact, {c, s, 1});
    const bool is_back = l.radius < 0;  // psi falls
    const double begin = 0.5 * std::numbers::pi * (l.quadrant + is_back), twice = is_back ? -2 : 2;
    return CircleAt{Complex{c, s} * Places{*boundary.scene}.a(contact.robot), l.radius, begin + twice * arc_tangent(at.lower),
                    begin + twice * arc_tangent(at.upper)};
}

// Integrals over psi of v = rho sqrt(w^2 + s^2), and of K v, whose primitive is -s / sqrt(w^2 + s^2).
double circle_area(const CircleAt& x, double w) {
    const auto f = [&](double psi) { return norm(w, x.s(psi)); };
    return x.radius * integral(f, x.first, x.last, over_nodes(f, x.first, x.last), 0).value;
}
double circle_curvature(const CircleAt& x, double w) {
    const double s = x.s(x.first), S = x.s(x.last);
    return s / norm(w, s) - S / norm(w, S);
}

// Integrals over theta of a function of lines, for each trapezoid; `one` is the mean of all.
std::vector<Integral> trapezoid_integrals(const Boundary& boundary, const Limits& limits,
                                          const std::function<double(const TrapezoidLine&)>& along_t) {
    std::vector<Integral> found(boundary.trapezoids.size());
    const auto each = [&](const auto& set) {
        for (std::size_t k = 0; k < found.size(); ++k) {
            const auto [from, to] = angles_of(boundary, static_cast<Index>(k));
            const auto f = [&](double theta) { return along_t(trapezoid_line(limits, static_cast<Index>(k), theta)); };
            if (boundary.scene->is_round) found[k] = set(over_roots(f, from, to), 0, 1, found[k].value);
            else found[k] = set(f, from, to, found[k].value);
        }
    };
    double mean = 0;
    each([&](const auto& f, double from, double to, double) {
        const double coarse = over_nodes(f, from, to);
        mean += std::abs(coarse) / static_cast<double>(found.size());
        return Integral{coarse, 0};
    });
    each([&](const auto& f, double from, double to, double coarse) { return integral(f, from, to, coarse, mean); });
    return found;
}

}  // namespace

std::vector<Integral> trapezoid_areas(const Boundary& boundary, double w) {
    const Limits limits(boundary);
    return trapezoid_integrals(boundary, limits, [&](const TrapezoidLine& at) {
        if (const auto circle = circle_at(boundary, limits, at)) return circle_area(*circle, w);
        return ruling_area(ruled(boundary, at.trapezoid), at.lower, at.upper, at.theta, w);
    });
}

std::vector<Integral> trapezoid_curvatures(const Boundary& boundary, double w) {
    const Limits limits(boundary);
    return trapezoid_integrals(boundary, limits, [&](const TrapezoidLine& at) {
        if (const auto circle = circle_at(boundary, limits, at)) return circle_curvature(*circle, w);
        return ruling_curvature(ruled(boundary, at.trapezoid), at.lower, at.upper, at.theta, w);
    });
}

namespace {

using std::numbers::pi;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

class Face {
public:
    Face(const CellComplex& in, Index f, double scale)
        : cells(in), w(scale), on(in.boundary->patches.contact(in.boundary->trapezoids.patch[static_cast<std::size_t>(f)])) {
        const Boundary& boundary = *in.boundary;
        const Trapezoids& table = boundary.trapezoids;
        const auto k = static_cast<std::size_t>(f);
        std::tie(from, to) = std::tuple_cat(angles_of(boundary, f));
        const Places places{*boundary.scene};
        is_round = boundary.scene->is_round, is_circle = on.kind == Kind::vertex_vertex;
        const Feature lower = unpacked(table.lower[k]), upper = unpacked(table.upper[k]);
        if (is_circle) {
            a = places.a(on.robot), b = places.b(on.obstacle);
            const double rho = sum_of_radii(*boundary.scene, on) * boundary.scene->unit();
            radius = std::abs(rho), begin = begin_of(on.branch, rho), turn_of_t = rho < 0 ? -1 : 1;
        } else {
            const auto parts = places.parts(on);
            turns = on.kind == Kind::edge_vertex;
            a = parts.a, b = parts.b, edge = parts.edge;
        }
        if (is_round) round_curves = {RoundCurve(places, on, lower, from, to), RoundCurve(places, on, upper, from, to)};
        else curves = {ContactCurve(places, on, lower, from, to), ContactCurve(places, on, upper, from, to)};
        first = in.first[k], last = in.first[k + 1];
    }

    void put_into(SideCurvatures& out) const {
        for (Index h = first; h < last; ++h) {
            const auto k = static_cast<std::size_t>(h);
            const Index before = h == first ? last - 1 : h - 1, after = h + 1 == last ? first : h + 1;
            out.turn[k] = side(before) == side(h) ? 0 : turn(tangent_of(before, angle(h)), tangent_of(h, angle(h)));
            put_start(h, before, &out.start[3 * k]);
            const auto put = [&](const Integral& found) { out.total[k] = found.value, out.error[k] = std::abs(found.error); };
            if (is_wall(h)) {
                if (is_circle) put(along_arc(angle(h), position_at(h), position_at(after)));
                continue;  // lines are straight
            }
            const bool upper = side(h) == Side::upper;
            const auto f = [&](double at) { return curvature(upper, at); };
            const double start = angle(h), stop = angle(after);
            if (is_round) {
                const auto g = over_roots(f, start, stop);
                put(integral(g, 0, 1, over_nodes(g, 0, 1), 1));
            } else put(integral(f, start, stop, over_nodes(f, start, stop), 1));
        }
    }

private:
    void put_start(Index h, Index before, double* out) const {
        const double phi = angle(h);
        const bool within_wall = is_wall(h) && side(before) == side(h), upper = side(is_wall(h) ? before : h) == Side::upper;
        const Complex x = within_wall ? Complex{unknown, unknown} : motion(upper, phi).x;
        out[0] = x.real(), out[1] = x.imag(), out[2] = w * phi;
    }
    bool is_wall(Index h) const { return side(h) == Side::first || side(h) == Side::last; }
    Side side(Index h) const { return static_cast<Side>(cells.side[static_cast<std::size_t>(h)]); }
    // start of a half-edge; the ends of a trapezoid are its own
    double angle(Index h) const {
        const Index before = h == first ? last - 1 : h - 1;
        if (side(h) == Side::first) return from;
        if (side(h) == Side::last) return to;
        if (side(before) != side(h)) return side(h) == Side::upper ? from : to;
        return std::clamp(cells.places().theta[static_cast<std::size_t>(cells.vertex[static_cast<std::size_t>(h)])], from, to);
    }
    struct Motion {
        Complex x, velocity, acceleration;
    };
    Motion motion(bool upper, double phi) const {
        if (!is_round) return {curves[upper].at(phi), curves[upper].velocity(phi), curves[upper].acceleration(phi)};
        const auto [s, v, acceleration] = round_curves[upper].motion(phi);
        const Complex z = std::polar(1.0, phi), za = z * a;
        if (is_circle) {
            const Complex u = std::polar(1.0, begin + turn_of_t * s), tangent = turn_of_t * i_unit * u;
            return {b - za + radius * u, radius * v * tangent - i_unit * za, za + radius * (acceleration * tangent - v * v * u)};
        }
        const Complex normal = -i_unit * edge;
        if (!turns) {
            const double off = dot(normal, b - za), off_1 = -dot(normal, i_unit * za), off_2 = dot(normal, za);
            return {s * edge + off * normal, v * edge + off_1 * normal, acceleration * edge + off_2 * normal};
        }
        const Complex y = dot(normal, a) * normal + s * edge;
        return {b - z * y, -z * (i_unit * y + v * edge), -z * (2.0 * i_unit * v * edge + acceleration * edge - y)};
    }
    // Direction of growing t, and a half-edge's start as an angle on a circle.
    Complex ruling(Complex x, double phi) const {
        if (is_circle) {
            const Complex u = x - (b - std::polar(1.0, phi) * a);
            return turn_of_t * i_unit * u / std::abs(u);
        }
        return turns ? -std::polar(1.0, phi) * edge : edge;
    }
    double position_at(Index h) const {
        const auto v = static_cast<std::size_t>(cells.vertex[static_cast<std::size_t>(h)]);
        const auto [c, s] = cosine_sine(cells.places().theta[v]);
        const Scene& scene = *cells.boundary->scene;
        const Complex x{cells.places().xy[2 * v] - (c * scene.frame[2] - s * scene.frame[3]),
                        cells.places().xy[2 * v + 1] - (s * scene.frame[2] + c * scene.frame[3])};
        const Complex u = x - (b - Complex{c, s} * a);
        return in_quadrant(turn_of_t * (std::arg(u) - begin));
    }
    // Geodesic curvature along an arc at one orientation.
    Integral along_arc(double phi, double start, double stop) const {
        const Complex turned = i_unit * std::polar(1.0, phi) * a;
        const auto f = [&](double psi) {
            const double s = dot(turned, std::polar(1.0, begin + turn_of_t * psi));
            return s / norm(w, s);
        };
        return integral(f, start, stop, over_nodes(f, start, stop), 1);
    }
    // V across the ruling
    double across(Complex x, double phi) const {
        if (is_circle) return dot(i_unit * std::polar(1.0, phi) * a, -i_unit * ruling(x, phi));
        return turns ? -dot(x - b, std::polar(1.0, phi) * edge) : -dot(edge, std::polar(1.0, phi) * a);
    }
    // Tangent in the frame, in the direction of the loop.
    Complex tangent_of(Index h, double phi) const {
        if (side(h) == Side::first) return 1;
        if (side(h) == Side::last) return -1;
        const bool upper = side(h) == Side::upper;
        const Motion at = motion(upper, phi);
        const Complex along{dot(at.velocity, ruling(at.x, phi)), norm(w, across(at.x, phi))};
        return upper ? along : -along;
    }
    // Turn from 0 to pi, up to rounding.
    static double turn(Complex before, Complex after) {
        const double by = std::arg(after * std::conj(before));
        return by < -0.5 * pi ? by + 2 * pi : by;
    }
    // Geodesic curvature per step of theta.
    double curvature(bool upper, double phi) const {
        const auto [x, velocity, acceleration] = motion(upper, phi);
        const Complex u = ruling(x, phi);
        const double s = across(x, phi), R = norm(w, s), along = dot(velocity, u);
        return (along * (s / R) * cross(u, acceleration) - R * dot(u, acceleration)) / (along * along + R * R);
    }

    const CellComplex& cells;
    double w, from, to;
    Feature on;
    bool turns = false, is_round, is_circle;
    Complex a, b, edge;
    double radius = 0, begin = 0, turn_of_t = 1;  // of a circle
    std::array<ContactCurve, 2> curves;
    std::array<RoundCurve, 2> round_curves;
    Index first, last;
};

}  // namespace

SideCurvatures side_curvatures(const CellComplex& cells, double angle_scale) {
    const std::size_t n = cells.face.size();
    SideCurvatures out{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n), std::vector<double>(3 * n)};
    for (Index f = 0; f < static_cast<Index>(cells.component.size()); ++f) Face(cells, f, angle_scale).put_into(out);
    return out;
}

}  // namespace cfree
