// Junctions at the angles of a table.
#pragma once
#include "cfree/forbidden/angle_table.hpp"
#include "cfree/predicates/junction.hpp"

namespace cfree {

// At is Junction, or RoundJunction where shapes are grown. Scene and table must outlive it.
template <class At>
At junction_at(const Scene& scene, const AngleTable& angles, Index rank, int chart) {
    const auto exact = [&angles, &scene, rank, chart] {
        const CriticalAngle angle = angles.critical(rank, chart);
        if constexpr (std::is_same_v<At, Junction>) return angle.exact(scene);
        else return angle.exact_among_grown(scene);
    };
    return At(scene, chart, angles.lo(rank, chart), angles.hi(rank, chart), exact,
              [&angles, &scene, rank, chart] { return angles.critical(rank, chart).bracket(scene); });
}

}  // namespace cfree
