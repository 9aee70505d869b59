// Critical angles of all trapezoids in one order, equal ones merged across patches, names and charts.
#pragma once
#include <span>
#include <utility>

#include "cfree/forbidden/critical_angle.hpp"

namespace cfree {

class AngleTable {
public:
    // The table is the same for any number of threads.
    AngleTable(const Scene& scene, const Patches& patches, const Trapezoids& trapezoids, int threads);

    // Ranks go from 0 (theta = -pi/2) over `middle` (pi/2, where the charts meet) to `last` (3 pi/2, which is -pi/2 again).
    std::vector<Index> from, to;  // one per trapezoid
    Index middle = 0, last = 0;

    // An angle in a chart that holds it: an interval of tau, and the exact number.
    double lo(Index rank, int chart) const { return angles[place(rank, chart)].lo; }
    double hi(Index rank, int chart) const { return angles[place(rank, chart)].hi; }
    CriticalAngle critical(Index rank, int chart) const { return critical(angles[place(rank, chart)]); }
    // A sample strictly between two angles.
    Sample between(Index first, Index second, int chart) const;

private:
    struct Angle {
        double lo, hi;
        Index trapezoid;  // a trapezoid with this angle; -1: the end of a chart
        bool is_to;
    };
    std::size_t place(Index rank, int chart) const { return static_cast<std::size_t>(rank + chart); }
    // Angles whose intervals overlap, one with the next; storage that is used again.
    struct Cluster {
        std::vector<CriticalAngle> all;
        std::vector<std::pair<CriticalAngle::ShortName, const Angle*>> named;
    };
    std::vector<Angle> sorted_ends(int chart) const;
    std::vector<Angle> order_chart(const std::vector<Angle>& ends, int threads);
    void order_cluster(std::span<const Angle> ends, Cluster& cluster, std::vector<Angle>& ordered);
    Index& rank_of(const Angle& x) { return (x.is_to ? to : from)[x.trapezoid]; }
    CriticalAngle critical(const Angle& x) const;

    const Scene& scene;
    const Patches& patches;
    const Trapezoids& trapezoids;
    std::vector<Angle> angles;  // chart 0 from end to end, then chart 1: `middle` is in both
};

}  // namespace cfree
