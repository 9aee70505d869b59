// Graph of trapezoids for paths along the boundary of a cell: the shortest path over common sides, in doubles. Nothing is
// decided here. If a cell has several closed surfaces, free segments link them.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/forbidden/limits.hpp"
#include "cfree/search/configuration.hpp"

namespace cfree {

inline constexpr Index far_away = -1;  // stands for a face to the left of everything

// End of a free path on a face, or far away.
struct Mark {
    Index face;
    Place at;
};

// Position of a vertex in the user's units.
Vec<double> position(const CellComplex& cells, Index vertex);
Place position_on(const Scene& scene, const Feature& contact, double t, double theta);

class FaceGraph {
public:
    // Lengths are travel plus angle_scale times total rotation, between the middles of sides.
    FaceGraph(std::shared_ptr<const CellComplex> cells, double angle_scale);

    // A face, and the half-edge through which the path leaves it. Numbers from H, the number of half-edges, on are ends of
    // links: H + 2 k is the first end of link k, H + 2 k + 1 the second; after them comes the end of the path.
    struct Step {
        Index face, by;
    };
    // Shortest path from a place over one of the starts, and one of the goals, to another place; links have two ends each.
    // Empty if there is no path. It does not cross sides without a twin.
    std::vector<Step> shortest(const Place& start, std::span<const Mark> starts, const Place& goal, std::span<const Mark> goals,
                               std::span<const Mark> links) const;
    // Append the middles of a face's sides.
    void middles(Index face, std::vector<Place>& found) const;
    double apart(const Place& a, const Place& b) const;
    const std::shared_ptr<const CellComplex> cells;

private:
    const Scene& scene;
    const Limits limits;
    const double angle_scale;
};

}  // namespace cfree
