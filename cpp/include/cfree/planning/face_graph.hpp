// Which trapezoids a path along the boundary of a cell crosses: the shortest way over common sides, in doubles. Nothing is
// decided here. Where a cell has several closed surfaces, free segments link them.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/forbidden/limits.hpp"
#include "cfree/search/configuration.hpp"

namespace cfree {

inline constexpr Index far_away = -1;  // in place of a face: to the left of everything

// Where a free way ends on a face, or far away.
struct Mark {
    Index face;
    Place at;
};

// In the user's units.
Vec<double> position(const CellComplex& cells, Index vertex);
Place position_on(const Scene& scene, const Feature& contact, double t, double theta);

class FaceGraph {
public:
    // Lengths are travel plus angle_scale times turning, between the middles of sides.
    FaceGraph(std::shared_ptr<const CellComplex> cells, double angle_scale);

    // A face, and the half-edge that it is left by. From their number H on these stand for ends of links, H + 2 k for the
    // first one of link k, H + 2 k + 1 for the second; after them comes the end of the way.
    struct Step {
        Index face, by;
    };
    // From a place over one of the starts, and one of the goals, to another; links by their ends, two by two. Empty if there is
    // no way. A side without a twin is not crossed.
    std::vector<Step> shortest(const Place& start, std::span<const Mark> starts, const Place& goal, std::span<const Mark> goals,
                               std::span<const Mark> links) const;
    // Of the sides of a face, behind what was found before.
    void middles(Index face, std::vector<Place>& found) const;
    double apart(const Place& a, const Place& b) const;
    const std::shared_ptr<const CellComplex> cells;

private:
    const Scene& scene;
    const Limits limits;
    const double angle_scale;
};

}  // namespace cfree
