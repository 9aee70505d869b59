// Bounds of points in eight directions.
#pragma once
#include <algorithm>
#include <array>
#include <limits>

#include "cfree/scene/scene.hpp"

namespace cfree {

// Bounds of x, y, x + y and x - y.
struct Octagon {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    double low[4] = {infinity, infinity, infinity, infinity}, high[4] = {-infinity, -infinity, -infinity, -infinity};
    static std::array<double, 4> values(double x, double y) { return {x, y, x + y, x - y}; }
    void add(double x, double y) {
        const auto value = values(x, y);
        for (int i = 0; i < 4; ++i) {
            low[i] = value[i] < low[i] ? value[i] : low[i];
            high[i] = high[i] < value[i] ? value[i] : high[i];
        }
    }
    void add(const Octagon& o) {
        for (int i = 0; i < 4; ++i) {
            low[i] = o.low[i] < low[i] ? o.low[i] : low[i];
            high[i] = high[i] < o.high[i] ? o.high[i] : high[i];
        }
    }
    bool meets(const Octagon& o) const {
        for (int i = 0; i < 4; ++i)
            if (o.high[i] < low[i] || high[i] < o.low[i]) return false;
        return true;
    }
    // Its high bounds may be below the low ones.
    Octagon common(const Octagon& o) const {
        Octagon result;
        for (int i = 0; i < 4; ++i) result.low[i] = std::max(low[i], o.low[i]), result.high[i] = std::min(high[i], o.high[i]);
        return result;
    }
    bool has_inside(const Vec<double>& p) const {
        const auto value = values(p.x, p.y);
        for (int i = 0; i < 4; ++i)
            if (!(low[i] < value[i] && value[i] < high[i])) return false;
        return true;
    }
    Octagon shifted(const Vec<double>& d) const {
        const auto value = values(d.x, d.y);
        Octagon result;
        for (int i = 0; i < 4; ++i) result.low[i] = low[i] + value[i], result.high[i] = high[i] + value[i];
        return result;
    }
    // A disc.
    void add(double x, double y, double radius) {
        constexpr double root_of_two = 1.4375;  // a little more than it
        const double slanted = root_of_two * radius;
        add({{x - radius, y - radius, x + y - slanted, x - y - slanted}, {x + radius, y + radius, x + y + slanted, x - y + slanted}});
    }
};

}  // namespace cfree
