// Sums over the faces of closed surfaces.
#include "cfree/free/cell_facts.hpp"

#include <limits>

#include "cfree/forbidden/limits.hpp"
#include "cfree/geometry/quadrature.hpp"

namespace cfree {

std::vector<double> volumes(const FreeSpace& space) {
    const Boundary& boundary = *space.boundary;
    const Trapezoids& table = boundary.trapezoids;
    const Limits limits(boundary);
    const auto line = [&](Index trapezoid, double theta) {
        const auto [c, s] = cosine_sine(theta);
        return limits.line(boundary.patches.contact(table.patch[static_cast<std::size_t>(trapezoid)]), {c, s, 1});
    };
    // of each closed surface a point near by, seen from where little cancels
    const auto& component = space.surfaces.component;
    std::vector<Vec<double>> origin(space.surfaces.parent.size(), {0, 0});
    std::vector<double> count(origin.size());
    for (std::size_t k = 0; k < table.size(); ++k) {
        const Index which = static_cast<Index>(k);
        const int chart = table.chart[k];
        const Vec<double> p = line(which, 0.5 * (theta_of(chart, table.tau_from(which)) + theta_of(chart, table.tau_to(which)))).at(0.5);
        auto& o = origin[static_cast<std::size_t>(component[k])];
        o = {o.x + p.x, o.y + p.y}, count[static_cast<std::size_t>(component[k])] += 1;
    }
    for (std::size_t k = 0; k < origin.size(); ++k) origin[k] = {origin[k].x / count[k], origin[k].y / count[k]};
    const auto signed_volumes = trapezoid_integrals(boundary, gauss_legendre(), [&](const QuadratureLines& lines) {
        std::vector<double> area;
        for (std::size_t k = 0; k < lines.theta.size(); ++k) {
            const auto of = line(lines.trapezoid[k], lines.theta[k]);
            const Vec<double> o = origin[static_cast<std::size_t>(component[static_cast<std::size_t>(lines.trapezoid[k])])];
            const Vec<double> P = of.at(lines.lower[k]), Q = of.at(lines.upper[k]);
            area.push_back(0.5 * ((P.x - o.x) * (Q.y - o.y) - (P.y - o.y) * (Q.x - o.x)));
        }
        return area;
    });
    std::vector<double> result(static_cast<std::size_t>(space.cells()));
    for (std::size_t k = 0; k < signed_volumes.size(); ++k)
        result[static_cast<std::size_t>(space.cell_of[static_cast<std::size_t>(component[k])])] -= signed_volumes[k];
    if (space.outside == 0) result[0] = std::numeric_limits<double>::infinity();
    return result;
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
