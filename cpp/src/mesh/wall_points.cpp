// Place points on a side of faces, each as far from the one before as edges to the points next to the side allow.
#include <algorithm>
#include <cmath>

#include "cfree/mesh/layout.hpp"

namespace cfree {

namespace {

constexpr double most_load = 0.96;  // share of the error that an edge takes, to first order
constexpr double least_distance = 0.5;   // between points on the side, per mean distance of points next to it
constexpr double least_share = 1e-3;  // the same, per length of the side

// Points of one face from left to right; those before `next` have edges to points on the side.
struct Chain {
    const MeshFace& face;
    const std::vector<Layout::Point>& points;
    double phi, error;
    std::size_t next;

    bool is_close(double u, std::size_t k) const {
        const Layout::Point& p = points[k];
        const MeshPoint a{face.s(u), phi, {0, 0}}, b{face.s(p.u), p.phi, {0, 0}};
        const double room = 0.5 * error * (face.gradient(a.s) + face.gradient(b.s));
        return std::abs(0.5 * p.off - face.form(a, b) / 4) <= most_load * room;
    }
    void join(double u, double end) {
        while (next + 1 < points.size() && points[next + 1].u <= end && is_close(u, next + 1)) ++next;
    }
    bool is_last(double end) const { return next + 1 >= points.size() || points[next + 1].u > end; }
    // Farthest place whose edges to the last joined point and to the next one are close.
    double reach(double from, double end) const {
        double least = end;
        for (std::size_t k = next; k <= next + !is_last(end) && k < points.size(); ++k) {
            if (is_close(end, k)) continue;
            double good = std::clamp(points[k].u, from, end), bad = end;
            for (int tries = 0; tries < 20; ++tries) {
                const double middle = 0.5 * (good + bad);
                (is_close(middle, k) ? good : bad) = middle;
            }
            least = std::min(least, good);
        }
        return least;
    }
};

}  // namespace

std::vector<double> wall_points(const std::vector<Wall>& walls, double error, double from, double to) {
    std::vector<Chain> chains;
    double least = 0.5 * (to - from);
    for (const Wall& wall : walls) {
        const auto& ends = *wall.ends;
        const auto is_before = [](const Layout::Point& p, double u) { return p.u < u; };
        const auto first = std::lower_bound(ends.begin(), ends.end(), from, is_before);
        if (first == ends.end() || first->u > to) continue;
        chains.push_back({*wall.face, ends, wall.phi, error, static_cast<std::size_t>(first - ends.begin())});
        const double wide = ends.back().u - ends.front().u;
        if (wide > 0) least = std::min(least, least_distance * wide / static_cast<double>(ends.size()));
    }
    least = std::max(least, least_share * (to - from));
    std::vector<double> result;
    for (double at = from; !chains.empty();) {
        double next = to;
        Chain* nearest = nullptr;
        for (Chain& chain : chains) {
            chain.join(at, to);
            const double reach = chain.reach(at, to);
            if (reach < next) next = reach, nearest = &chain;
        }
        if (nearest && next < at + least && !nearest->is_last(to)) {
            ++nearest->next;
            continue;
        }
        if (!(next < to - least) || next < at + least) break;
        result.push_back(at = next);
    }
    return result;
}

}  // namespace cfree
