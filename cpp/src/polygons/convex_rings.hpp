// Rings in doubles, and parts of convex ones. They decide nothing.
#pragma once
#include <algorithm>
#include <vector>

#include "cfree/exact/number.hpp"

namespace cfree {

using DoubleRing = std::vector<Vec<double>>;

inline const Vec<double>& vertex_after(const DoubleRing& ring, std::size_t k) { return ring[k + 1 < ring.size() ? k + 1 : 0]; }

// Share of an edge, from a to b, before its point nearest to p.
inline double share_before(const Vec<double>& a, const Vec<double>& b, const Vec<double>& p) {
    return std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
}

inline Vec<double> point_at(const Vec<double>& a, const Vec<double>& b, double share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

// Part of a convex ring on one side of the line through p: that opposite of its normal n.
inline DoubleRing cut_off(const DoubleRing& ring, const Vec<double>& p, const Vec<double>& n) {
    DoubleRing rest;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec<double> &a = ring[k], &b = vertex_after(ring, k);
        const double from = dot(a - p, n), to = dot(b - p, n);
        if (from <= 0) rest.push_back(a);
        if ((from < 0 && to > 0) || (from > 0 && to < 0)) rest.push_back(point_at(a, b, from / (from - to)));
    }
    return rest;
}

}  // namespace cfree
