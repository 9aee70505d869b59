// Integrate in t in closed form, over theta by quadrature.
#include "cfree/geometry/quadrature.hpp"

#include "cfree/contact/contact_curve.hpp"
#include "cfree/geometry/local_geometry.hpp"

namespace cfree {

namespace {

Ruled ruled(const Boundary& boundary, Index trapezoid) {
    const Feature contact = boundary.patches.contact(boundary.trapezoids.patch[static_cast<std::size_t>(trapezoid)]);
    const ContactLine<double> l(*boundary.scene, contact, Places{*boundary.scene});
    if (l.on_edge) return {l.b.x, l.b.y, l.E.x, l.E.y, l.a.x, l.a.y, 0, 0};
    return {l.b.x, l.b.y, 0, 0, l.a.x, l.a.y, l.E.x, l.E.y};
}

}  // namespace

TrapezoidLine trapezoid_line(const Limits& limits, Index trapezoid, double theta) {
    const auto [lower, upper] = limits.meetings(trapezoid, theta);
    return {trapezoid, theta, lower.t, std::max(lower.t, upper.t), lower.sine, upper.sine};
}

std::array<double, 2> angles_of(const Boundary& boundary, Index trapezoid) {
    const Trapezoids& table = boundary.trapezoids;
    const int chart = table.chart[static_cast<std::size_t>(trapezoid)];
    return {theta_of(chart, table.tau_from(trapezoid)), theta_of(chart, table.tau_to(trapezoid))};
}

std::vector<Integral> trapezoid_integrals(const Boundary& boundary, const std::function<double(const TrapezoidLine&)>& along_t) {
    const Limits limits(boundary);
    std::vector<Integral> found(boundary.trapezoids.size());
    const auto each = [&](const auto& set) {
        for (std::size_t k = 0; k < found.size(); ++k) {
            const auto [from, to] = angles_of(boundary, static_cast<Index>(k));
            const auto f = [&](double theta) { return along_t(trapezoid_line(limits, static_cast<Index>(k), theta)); };
            found[k] = set(f, from, to, found[k].value);
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

std::vector<Integral> trapezoid_areas(const Boundary& boundary, double w) {
    return trapezoid_integrals(boundary, [&](const TrapezoidLine& at) {
        return ruling_area(ruled(boundary, at.trapezoid), at.lower, at.upper, at.theta, w);
    });
}

std::vector<Integral> trapezoid_curvatures(const Boundary& boundary, double w) {
    return trapezoid_integrals(boundary, [&](const TrapezoidLine& at) {
        return ruling_curvature(ruled(boundary, at.trapezoid), at.lower, at.upper, at.theta, w);
    });
}

}  // namespace cfree
