// Pairs of a polygon of the robot and an obstacle; the complements of workspace and bounds are also obstacles.
#pragma once
#include "cfree/forbidden/columns.hpp"
#include "cfree/scene/features.hpp"

namespace cfree {

// Obstacles are numbered as the user's, then the complement of the workspace and that of the bounds; parts of the robot are
// its polygons, then its reference point, which meets only the bounds.
class Pairs {
public:
    explicit Pairs(const SceneFeatures& features)
        : robots(static_cast<Index>(features.shapes.robot.size())), obstacles(static_cast<Index>(features.shapes.obstacles.size())),
          robot_ring(numbers(features.robot.polygon, robots, 0)), obstacle_ring(numbers(features.obstacles.polygon, obstacles, 1)),
          robot_piece(of_pieces(features.scene->robot, robot_ring, robots)),
          obstacle_piece(of_pieces(features.scene->obstacles, obstacle_ring, obstacles + 1)),
          has_workspace(features.shapes.workspace != nullptr), has_bounds(features.shapes.bounds.has_value()) {}

    Index number(Index robot, Index obstacle) const { return robot * columns() + obstacle; }
    Index of(const Feature& contact) const { return number(robot_ring[contact.robot], obstacle_ring[contact.obstacle]); }
    Index of_pieces(Index p, Index k) const { return number(robot_piece[p], obstacle_piece[k]); }
    Index columns() const { return obstacles + 2; }
    // Pairs that forbid poses far away.
    std::vector<Index> far_away() const {
        std::vector<Index> result;
        for (Index r = 0; has_workspace && r < robots; ++r) result.push_back(number(r, obstacles));
        if (has_bounds) result.push_back(number(robots, obstacles + 1));
        return result;
    }

private:
    static std::vector<Index> numbers(const std::vector<Index>& owner, Index count, Index after_bounds) {
        std::vector<Index> result;
        for (const Index k : owner) result.push_back(k >= 0 ? k : k == bounds_owner ? count + after_bounds : count);
        return result;
    }
    static std::vector<Index> of_pieces(const Shape& shape, const std::vector<Index>& ring, Index beyond) {
        std::vector<Index> result;
        for (Index k = 0; k < shape.pieces(); ++k) {
            const Index v = shape.piece_vertex[shape.piece[k]];
            result.push_back(v < shape.ring_vertices ? ring[v] : beyond);
        }
        return result;
    }

    Index robots, obstacles;
    std::vector<Index> robot_ring, obstacle_ring, robot_piece, obstacle_piece;
    bool has_workspace, has_bounds;
};

}  // namespace cfree
