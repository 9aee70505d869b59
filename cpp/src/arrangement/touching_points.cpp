// Compare corners at one angle in doubles, and close ones exactly.
#include "arrangement/touching_points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cfree/contact/contact_line.hpp"
#include "cfree/forbidden/limits.hpp"
#include "support/parallel.hpp"

namespace cfree {

namespace {

class AtOneAngle {
public:
    AtOneAngle(const Boundary& b, const std::vector<PieceCorner>& c, Index rank)
        : boundary(b), scene(b.scene->near()), corners(c), chart(rank > b.angles().middle ? 1 : 0),
          at(scene, chart, b.angles().lo(rank, chart), b.angles().hi(rank, chart),
             [&b, rank, in = chart] { return b.angles().critical(rank, in).exact(b.scene->near()); },
             [&b, rank, in = chart] { return b.angles().critical(rank, in).bracket(b.scene->near()); }) {}

    void know_of(Index corner) {
        const PieceCorner& x = corners[corner];
        const auto& t = boundary.trapezoids;
        know(at, scene, x.is_last ? angle_to(boundary.patches, t, x.trapezoid) : angle_from(boundary.patches, t, x.trapezoid));
    }
    Vec<double> place(Index corner, const Rotation<double>& R) const {
        const Feature contact = line_of(corner);
        const double t = at.value(contact, spot_of(corner));
        const auto end = [&](int which) {
            const Feature helix = end_helix(scene, contact, which);
            return Vec<double>{scene.obstacles.x[helix.obstacle], scene.obstacles.y[helix.obstacle]} -
                   R(Vec<double>{scene.robot.x[helix.robot], scene.robot.y[helix.robot]});
        };
        const auto p = end(0), q = end(1);
        return {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
    }
    bool are_one(Index x, Index y) {
        const Feature p = line_of(x), q = line_of(y);
        const Spot of_x = spot_of(x), of_y = spot_of(y);
        if (at.side(q, p, of_x) != 0 || at.side(p, q, of_y) != 0) return false;
        return at.turn(p, q) != 0 || at.order(p, of_x, of_y) == 0;
    }

private:
    Feature line_of(Index corner) const {
        return surface_of(boundary.patches, boundary.trapezoids, corners[corner].trapezoid).contact;
    }
    Spot spot_of(Index corner) const {
        const PieceCorner& x = corners[corner];
        return at.spot(line_of(corner), unpacked((x.is_upper ? boundary.trapezoids.upper : boundary.trapezoids.lower)[x.trapezoid]));
    }

    const Boundary& boundary;
    const Scene& scene;
    const std::vector<PieceCorner>& corners;
    const int chart;
    Junction at;
};

}  // namespace

std::vector<std::vector<Index>> touching_points(const Boundary& boundary, const std::vector<PieceCorner>& corners, int threads) {
    const AngleTable& angles = boundary.angles();
    std::vector<Index> by_rank(corners.size());
    std::iota(by_rank.begin(), by_rank.end(), 0);
    const auto rank_of = [&](Index k) {
        const Index rank = (corners[k].is_last ? angles.to : angles.from)[corners[k].trapezoid];
        return rank == angles.last ? 0 : rank;
    };
    std::stable_sort(by_rank.begin(), by_rank.end(), [&](Index x, Index y) { return rank_of(x) < rank_of(y); });
    std::vector<std::size_t> first;
    for (std::size_t k = 0; k < by_rank.size(); ++k)
        if (k == 0 || rank_of(by_rank[k]) != rank_of(by_rank[k - 1])) first.push_back(k);
    first.push_back(by_rank.size());
    std::vector<std::vector<std::vector<Index>>> found(first.size() - 1);
    for_each_in_parallel(threads, found.size(), [&](std::size_t a) {
        if (first[a + 1] - first[a] < 2) return;
        heed_stop();
        const Index rank = rank_of(by_rank[first[a]]);
        const int chart = rank > angles.middle ? 1 : 0;
        AtOneAngle at(boundary, corners, rank);
        const auto R = rotation_by(chart, 0.5 * (angles.lo(rank, chart) + angles.hi(rank, chart)));
        struct Placed {
            Vec<double> p;
            Index corner;
        };
        std::vector<Placed> placed;
        double size = 0;
        for (std::size_t k = first[a]; k < first[a + 1]; ++k) {
            at.know_of(by_rank[k]);
            placed.push_back({at.place(by_rank[k], R), by_rank[k]});
            size = std::max({size, std::abs(placed.back().p.x), std::abs(placed.back().p.y)});
        }
        const double apart = 0x1p-20 * size;  // places are far more precise
        std::sort(placed.begin(), placed.end(), [](const Placed& x, const Placed& y) { return x.p.x < y.p.x; });
        std::vector<Index> of(placed.size(), -1);  // lists
        for (std::size_t k = 0; k < placed.size(); ++k)
            for (std::size_t m = k + 1; m < placed.size() && placed[m].p.x - placed[k].p.x <= apart; ++m) {
                if (of[m] >= 0 || std::abs(placed[m].p.y - placed[k].p.y) > apart || !at.are_one(placed[k].corner, placed[m].corner)) continue;
                if (of[k] < 0) of[k] = static_cast<Index>(found[a].size()), found[a].push_back({placed[k].corner});
                of[m] = of[k];
                found[a][of[k]].push_back(placed[m].corner);
            }
    });
    std::vector<std::vector<Index>> result;
    for (auto& lists : found) std::move(lists.begin(), lists.end(), std::back_inserter(result));
    return result;
}

}  // namespace cfree
