// Which pillars can reach a patch. Boxes are rounded outwards: this decides nothing.
#pragma once
#include "cfree/predicates/predicates.hpp"
#include "collision/box_tree.hpp"

namespace cfree {

class PillarIndex {
public:
    explicit PillarIndex(const Scene& scene);

    // Obstacle pieces near the obstacle edge or vertex j, nearest first.
    void near(Index j, std::vector<Index>& out) const;
    // Where robot piece p can be while the contact holds between two angles of one chart.
    Box swept(const Feature& contact, Index p, int chart, double lo, double hi) const;
    const Box& box(Index k) const { return boxes[k]; }

private:
    const Scene& scene;
    std::vector<Box> boxes;  // of obstacle pieces
    BoxTree tree;
    double reach;  // no two points of the robot are farther apart
};

}  // namespace cfree
