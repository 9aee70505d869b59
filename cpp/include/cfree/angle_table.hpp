// The critical angles of all trapezoids in one order, equal ones made one: across patches, names and charts.
#pragma once
#include <memory>
#include <vector>

#include "cfree/boundary.hpp"

namespace cfree {

class AngleTable {
public:
    AngleTable(const Scene& scene, const Patches& patches, const Trapezoids& trapezoids);

    // Ranks from 0 (theta = -pi/2) over `middle` (pi/2, where the charts meet) to `last` (3 pi/2, which is -pi/2 again).
    std::vector<Index> from, to;  // of each trapezoid
    Index middle = 0, last = 0;

    // An angle in a chart that holds it: an interval of tau, and the exact number.
    double lo(Index rank, int chart) const { return angles[place(rank, chart)].lo; }
    double hi(Index rank, int chart) const { return angles[place(rank, chart)].hi; }
    const RealRoot& exact(Index rank, int chart);
    // A sample strictly between two angles.
    Sample between(Index first, Index second, int chart);

    Surface surface(Index trapezoid) const;

private:
    struct Angle {
        double lo, hi;
        Index trapezoid;  // one that has it; -1: a wall
        bool is_to;
        std::shared_ptr<RealRoot> root;  // once needed
    };
    std::size_t place(Index rank, int chart) const { return static_cast<std::size_t>(rank + chart); }
    void sort_chart(int chart);
    void order_cluster(const Angle* begin, const Angle* end, int chart);
    int order(Angle& x, Angle& y);
    RealRoot& exact(Angle& x) const;
    Event event(const Angle& x, Predicates& on) const;
    std::array<Feature, 2> features(const Angle& x) const;
    std::array<Code, 3> name(const Angle& x) const;
    bool is_one(const std::vector<const Angle*>& same);

    const Scene& scene;
    const Patches& patches;
    const Trapezoids& trapezoids;
    std::vector<Angle> angles;  // of chart 0, wall to wall, then of chart 1: `middle` is in both
};

}  // namespace cfree
