// Index of the pillars that can reach a patch. Boxes are rounded outwards: this decides nothing.
#pragma once
#include "cfree/predicates/predicates.hpp"
#include "collision/shape_boxes.hpp"

namespace cfree {

class PillarIndex {
public:
    explicit PillarIndex(const Scene& scene);

    // Obstacle pieces near the obstacle edge or vertex j, nearest first.
    void near(Index j, std::vector<Index>& out) const;
    // Upper bound of the distance of two points of the robot.
    double reach() const { return robot_diagonal; }

private:
    const Scene& scene;
    std::vector<Box> boxes;  // boxes of obstacle pieces
    BoxTree tree;
    double robot_diagonal;
};

}  // namespace cfree
