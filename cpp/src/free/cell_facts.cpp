// Sum contributions of the faces of closed surfaces.
#include "cfree/free/cell_facts.hpp"

#include <limits>
#include <numbers>

#include "cfree/contact/contact_curve.hpp"
#include "cfree/geometry/integrals.hpp"

namespace cfree {

namespace {

using std::numbers::pi;
constexpr double rounded = 0x1p-53;
constexpr double enough = 1e-18;  // times a closed surface's extent, cubed: greatest error of quadrature on an interval
constexpr int halvings = 40;
constexpr int most_intervals = 1000;  // limit for one trapezoid; then the bound may be larger

// Half the cross product of the two ends of a trapezoid's line, from a point, integrated over theta; and its error.
class Flux {
public:
    Flux(const Boundary& of, const Limits& ends, Index which, Vec<double> from_here)
        : boundary(of), limits(ends), trapezoid(which), origin(from_here),
          contact(of.patches.contact(of.trapezoids.patch[static_cast<std::size_t>(which)])) {
        std::tie(start, stop) = std::tuple_cat(angles_of(of, which));
        const Places places{of.scene->near()};
        const auto k = static_cast<std::size_t>(which);
        parts = places.parts(contact);
        curves = {ContactCurve(places, contact, unpacked(of.trapezoids.lower[k]), start, stop),
                  ContactCurve(places, contact, unpacked(of.trapezoids.upper[k]), start, stop)};
        const Complex arm = parts.b - Complex{origin.x, origin.y};
        turns = contact.kind == Kind::edge_vertex;
        size = std::abs(parts.a) + std::abs(arm) + parts.length + std::abs(parts.b);
    }

    Integral over_all() const {
        int intervals = most_intervals;
        return over(start, stop, enough * size * size * size, halvings, intervals);
    }

private:
    Integral over(double from, double to, double most, int depth, int& intervals) const {
        const double left_out = remainder(from, to);
        if (left_out > most && depth > 0 && --intervals > 0) {
            const double middle = 0.5 * (from + to);
            Integral sum = over(from, middle, most, depth - 1, intervals);
            sum += over(middle, to, most, depth - 1, intervals);
            return sum;
        }
        const double half = 0.5 * (to - from);
        Integral sum{0, left_out};
        for (int k = 0; k < gauss_legendre::count; ++k) {
            const Integral at = area(from + half * (1 + gauss_legendre::nodes[k]));
            const double weight = half * gauss_legendre::weights[k];
            sum.value += weight * at.value, sum.error += weight * at.error;
        }
        return sum;
    }

    // Value at an orientation, with its rounding: the ends move along the line as far as its crossings are ill-conditioned.
    Integral area(double theta) const {
        const TrapezoidLine at = trapezoid_line(limits, trapezoid, theta);
        const auto [c, s] = cosine_sine(theta);
        const Limits::Line line = limits.line(contact, {c, s, 1});
        const Vec<double> p = line.at(at.lower), q = line.at(at.upper), P{p.x - origin.x, p.y - origin.y}, Q{q.x - origin.x, q.y - origin.y};
        const double off = std::abs(P.x * line.u.y - P.y * line.u.x) / parts.length, slip = 32 * rounded * size;
        const auto moved = [&](double sine) { return std::min(parts.length, slip / sine); };
        return {0.5 * (P.x * Q.y - P.y * Q.x),
                0.5 * off * (moved(at.lower_sine) + moved(at.upper_sine)) + slip * (norm(P.x, P.y) + norm(Q.x, Q.y))};
    }

    // Error bound of eight nodes: 64/15 M / (rho^14 - rho^12) times half the interval. M bounds the integrand on the ellipse
    // around it whose axes are (rho + 1 / rho) / 2 and (rho - 1 / rho) / 2 times as long.
    double remainder(double from, double to) const {
        const double half = 0.5 * (to - from), middle = 0.5 * (from + to);
        double least = (to - from) * size * size;  // twice the integral between ends within `size` of the point
        for (const double rho : {2.0, 4.0, 8.0, 16.0, 64.0, 1024.0}) {
            const double wide = 0.5 * half * (rho + 1 / rho), beyond = 0.5 * half * (rho - 1 / rho);
            if (beyond > 4) break;
            const double M = most(middle - wide, middle + wide, beyond);
            const double square = rho * rho, sixth = square * square * square;
            least = std::min(least, half * 64 / 15 * M / (sixth * sixth * (square - 1)));
        }
        return least;
    }

    // Half of the line's distance times its length between the curves, for complex angles.
    double most(double from, double to, double beyond) const {
        const double more = growth(beyond);
        const Complex b = parts.b - Complex{origin.x, origin.y};
        const double distance = turns ? more * std::abs(b) + std::abs(cross(parts.a, parts.edge)) : std::abs(cross(b, parts.edge)) + more * std::abs(parts.a);
        const double length = curves[0].reach(parts.b, from, to, beyond) + curves[1].reach(parts.b, from, to, beyond);
        return 0.5 * distance * length * (turns ? more : 1);
    }

    const Boundary& boundary;
    const Limits& limits;
    Index trapezoid;
    Vec<double> origin;
    Feature contact;
    double start, stop, size;
    bool turns;
    Places::Parts parts;
    std::array<ContactCurve, 2> curves;
};

// The same where shapes are grown. Its curves begin and end like square roots; the error is that of halving, and of rounding, which
// moves an end by its own size over the sine of the crossing, or where curves nearly touch by its square root.
Integral round_flux(const Boundary& boundary, const Limits& limits, Index which, Vec<double> origin) {
    const auto [from, to] = angles_of(boundary, which);
    const Feature contact = boundary.patches.contact(boundary.trapezoids.patch[static_cast<std::size_t>(which)]);
    double size = 0;
    const auto area = [&](double theta) {
        const TrapezoidLine at = trapezoid_line(limits, which, theta);
        const auto [c, s] = cosine_sine(theta);
        const Limits::Line line = limits.line(contact, {c, s, 1});
        const auto p = line.at(at.lower) - origin, q = line.at(at.upper) - origin;
        size = std::max({size, norm(p.x, p.y), norm(q.x, q.y)});
        if (!line.is_circle()) return 0.5 * (p.x * q.y - p.y * q.x);
        const auto centre = line.p - origin, chord = q - p;
        const double turn = (line.radius < 0 ? -2 : 2) * (arc_tangent(at.upper) - arc_tangent(at.lower));
        return 0.5 * (centre.x * chord.y - centre.y * chord.x + line.radius * line.radius * turn);
    };
    const auto f = over_roots(area, from, to);
    const double coarse = over_nodes(f, 0, 1);
    Integral found = integral(f, 0, 1, coarse, 0.1 * size * size * (to - from));
    const double slip = 32 * rounded * size;
    const auto moved = [&](double theta) {
        double sum = 0;
        for (const Limits::Meeting& end : limits.meetings(which, theta)) sum += std::min(slip / end.sine, std::sqrt(slip * size));
        return sum;
    };
    found.error += slip * size * (to - from) + size * over_nodes(over_roots(moved, from, to), 0, 1);
    return found;
}

Integral flux_of(const Boundary& boundary, const Limits& limits, Index which, Vec<double> origin) {
    if (boundary.scene->is_round) return round_flux(boundary, limits, which, origin);
    return Flux(boundary, limits, which, origin).over_all();
}

}  // namespace

Volumes enclosed(const Boundary& boundary, const std::vector<Facing>& facing, Index cells) {
    const Trapezoids& table = boundary.trapezoids;
    const Limits limits(boundary);
    // a point near each closed surface, for little cancellation
    std::vector<Vec<double>> origin;
    std::vector<double> count;
    for (const Facing& x : facing) {
        const auto k = static_cast<std::size_t>(x.trapezoid), surface = static_cast<std::size_t>(x.surface);
        if (surface >= origin.size()) origin.resize(surface + 1, {0, 0}), count.resize(surface + 1);
        const auto [from, to] = angles_of(boundary, x.trapezoid);
        const auto [c, s] = cosine_sine(0.5 * (from + to));
        const Vec<double> p = limits.line(boundary.patches.contact(table.patch[k]), {c, s, 1}).at(0.5);
        auto& o = origin[surface];
        o = {o.x + p.x, o.y + p.y}, count[surface] += 1;
    }
    for (std::size_t k = 0; k < origin.size(); ++k) origin[k] = {origin[k].x / count[k], origin[k].y / count[k]};
    Volumes found{std::vector<double>(static_cast<std::size_t>(cells)), std::vector<double>(static_cast<std::size_t>(cells))};
    for (const Facing& x : facing) {
        const auto cell = static_cast<std::size_t>(x.cell);
        const Integral flux = flux_of(boundary, limits, x.trapezoid, origin[static_cast<std::size_t>(x.surface)]);
        found.values[cell] += x.is_inner ? flux.value : -flux.value;
        found.errors[cell] += flux.error + 4 * rounded * std::abs(flux.value) * std::sqrt(static_cast<double>(table.size()));
    }
    return found;
}

Volumes fluxes(const Boundary& boundary, const std::vector<Vec<double>>& origins) {
    const Limits limits(boundary);
    Volumes found;
    for (std::size_t k = 0; k < origins.size(); ++k) {
        heed_stop();
        const Integral flux = flux_of(boundary, limits, static_cast<Index>(k), origins[k]);
        found.values.push_back(-flux.value), found.errors.push_back(flux.error);
    }
    return found;
}

Volumes volumes(const FreeSpace& space) {
    std::vector<Facing> facing;
    const auto& component = space.surfaces.component;
    for (std::size_t k = 0; k < component.size(); ++k)
        facing.push_back({static_cast<Index>(k), component[k], space.cell_of[static_cast<std::size_t>(component[k])], false});
    Volumes found = enclosed(*space.boundary, facing, space.cells());
    if (space.outside == 0) found.values[0] = found.errors[0] = std::numeric_limits<double>::infinity();
    return found;
}

std::vector<std::uint8_t> caged(const FreeSpace& space, const std::vector<Index>& owner) {
    std::vector<std::uint8_t> result(static_cast<std::size_t>(space.cells()), 1);
    if (space.outside == 0) result[0] = 0;
    const auto& patch = space.boundary->trapezoids.patch;
    for (std::size_t k = 0; k < patch.size(); ++k) {
        const Index obstacle = space.boundary->patches.contact(patch[k]).obstacle;
        if (owner[static_cast<std::size_t>(obstacle)] < 0)
            result[static_cast<std::size_t>(space.cell_of[static_cast<std::size_t>(space.surfaces.component[k])])] = 0;
    }
    return result;
}

}  // namespace cfree
