// All intervals of one halving together.
#include "cfree/geometry/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/forbidden/limits.hpp"
#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

constexpr double close = 1e-12;
constexpr int halvings = 12;

struct Part {
    Index trapezoid;
    double start, stop, value;
};

void integrate(const Boundary& boundary, const QuadratureRule& rule, const AlongT& along_t, std::vector<Part>& parts) {
    const Limits limits(boundary);
    QuadratureLines lines;
    for (const Part& part : parts)
        for (const double node : rule.nodes) {
            const double theta = part.start + 0.5 * (part.stop - part.start) * (1 + node);
            const int chart = boundary.trapezoids.chart[static_cast<std::size_t>(part.trapezoid)];
            const auto [lower, upper] = limits.of(part.trapezoid, tangent(0.5 * (theta - chart * std::numbers::pi)));
            const double first = std::clamp(lower, 0.0, 1.0);
            lines.trapezoid.push_back(part.trapezoid), lines.theta.push_back(theta);
            lines.lower.push_back(first), lines.upper.push_back(std::max(first, std::clamp(upper, 0.0, 1.0)));
        }
    const auto values = along_t(lines);
    const std::size_t n = rule.nodes.size();
    for (std::size_t k = 0; k < parts.size(); ++k) {
        parts[k].value = 0;
        for (std::size_t i = 0; i < n; ++i) parts[k].value += rule.weights[i] * 0.5 * (parts[k].stop - parts[k].start) * values[n * k + i];
    }
}

}  // namespace

const QuadratureRule& gauss_legendre() {
    static const QuadratureRule rule{
        {-0.9602898564975363, -0.7966664774136267, -0.525532409916329, -0.18343464249564978, 0.18343464249564978, 0.525532409916329,
         0.7966664774136267, 0.9602898564975363},
        {0.10122853629037706, 0.22238103445337443, 0.3137066458778873, 0.3626837833783621, 0.3626837833783621, 0.3137066458778873,
         0.22238103445337443, 0.10122853629037706}};
    return rule;
}

std::vector<double> trapezoid_integrals(const Boundary& boundary, const QuadratureRule& rule, const AlongT& along_t) {
    const Trapezoids& table = boundary.trapezoids;
    std::vector<double> found(table.size());
    std::vector<Part> coarse;
    for (Index k = 0; k < static_cast<Index>(table.size()); ++k) {
        const int chart = table.chart[static_cast<std::size_t>(k)];
        coarse.push_back({k, theta_of(chart, table.tau_from(k)), theta_of(chart, table.tau_to(k)), 0});
    }
    integrate(boundary, rule, along_t, coarse);
    double mean = 0;
    for (const Part& part : coarse) mean += std::abs(part.value) / static_cast<double>(coarse.size());
    for (int round = 0; round < halvings && !coarse.empty(); ++round) {
        std::vector<Part> halves, rest;
        for (const Part& part : coarse) {
            const double middle = 0.5 * (part.start + part.stop);
            halves.push_back({part.trapezoid, part.start, middle, 0}), halves.push_back({part.trapezoid, middle, part.stop, 0});
        }
        integrate(boundary, rule, along_t, halves);
        for (std::size_t k = 0; k < coarse.size(); ++k) {
            const Part &a = halves[2 * k], &b = halves[2 * k + 1];
            const double fine = a.value + b.value;
            if (std::abs(fine - coarse[k].value) <= close * std::max(std::abs(fine), mean)) found[static_cast<std::size_t>(a.trapezoid)] += fine;
            else rest.push_back(a), rest.push_back(b);
        }
        coarse = std::move(rest);
    }
    for (const Part& part : coarse) found[static_cast<std::size_t>(part.trapezoid)] += part.value;
    return found;
}

}  // namespace cfree
