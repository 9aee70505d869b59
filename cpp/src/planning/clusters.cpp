// Cluster points by gaps in sorted coordinates.
#include "cfree/planning/clusters.hpp"

#include <algorithm>
#include <numeric>

namespace cfree {

std::vector<std::vector<Index>> clusters(const std::vector<std::array<double, 4>>& points, double near) {
    std::vector<Index> label(points.size(), 0), order(points.size());
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t axis = 0; axis < 4; ++axis) {
        const auto at = [&](Index k) { return std::pair(label[k], points[k][axis]); };
        std::sort(order.begin(), order.end(), [&](Index p, Index q) { return at(p) < at(q); });
        std::vector<Index> finer(label.size());
        Index now = 0;
        for (std::size_t k = 0; k < order.size(); ++k) {
            if (k > 0) {
                const auto [of, value] = at(order[k]);
                const auto [before, last] = at(order[k - 1]);
                now += of != before || value - last > near;
            }
            finer[order[k]] = now;
        }
        label = std::move(finer);
    }
    std::sort(order.begin(), order.end(), [&](Index p, Index q) { return std::pair(label[p], p) < std::pair(label[q], q); });
    std::vector<std::vector<Index>> groups;
    for (std::size_t k = 0, end; k < order.size(); k = end) {
        for (end = k + 1; end < order.size() && label[order[end]] == label[order[k]];) ++end;
        groups.emplace_back(order.begin() + static_cast<std::ptrdiff_t>(k), order.begin() + static_cast<std::ptrdiff_t>(end));
    }
    return groups;
}

}  // namespace cfree
