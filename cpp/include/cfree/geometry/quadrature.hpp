// Gauss-Legendre quadrature with eight nodes, on intervals that are halved until halving changes less than 1e-12 of the
// value: a measured error, not a proved one.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"

namespace cfree {

struct Integral {
    double value = 0, error = 0;
    void operator+=(const Integral& x) { value += x.value, error += x.error; }
};

namespace gauss_legendre {
inline constexpr int count = 8;
inline constexpr std::array<double, count> nodes{-0.9602898564975363, -0.7966664774136267, -0.525532409916329, -0.18343464249564978,
                                                 0.18343464249564978, 0.525532409916329,   0.7966664774136267, 0.9602898564975363};
inline constexpr std::array<double, count> weights{0.10122853629037706, 0.22238103445337443, 0.3137066458778873, 0.3626837833783621,
                                                   0.3626837833783621,  0.3137066458778873,  0.22238103445337443, 0.10122853629037706};
}  // namespace gauss_legendre

// f(x) at the nodes of an interval, each with its weight.
template <class F>
double over_nodes(const F& f, double from, double to) {
    const double half = 0.5 * (to - from);
    double sum = 0;
    for (int k = 0; k < gauss_legendre::count; ++k) sum += gauss_legendre::weights[k] * half * f(from + half * (1 + gauss_legendre::nodes[k]));
    return sum;
}

// f over an interval as a function on [0, 1], for integrands that begin or end like square roots, as curves of circles do.
template <class F>
auto over_roots(const F& f, double from, double to) {
    return [&f, half = 0.5 * (to - from), middle = 0.5 * (from + to)](double x) {
        const auto [c, s] = cosine_sine(std::numbers::pi * x);
        return half * std::numbers::pi * s * f(middle - half * c);
    };
}

// Halving may change at most `close` of `one` or of the value; `coarse` is the integral by all nodes over the interval.
template <class F>
Integral integral(const F& f, double from, double to, double coarse, double one, int halvings = 12) {
    constexpr double close = 1e-12;
    const double middle = 0.5 * (from + to), left = over_nodes(f, from, middle), right = over_nodes(f, middle, to);
    const double fine = left + right, off = std::abs(fine - coarse);
    if (off <= close * std::max(std::abs(fine), one) || halvings == 1) return {fine, off};
    Integral sum = integral(f, from, middle, left, one, halvings - 1);
    sum += integral(f, middle, to, right, one, halvings - 1);
    return sum;
}

}  // namespace cfree
