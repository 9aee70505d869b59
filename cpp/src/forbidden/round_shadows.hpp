// Octagons around rounded pieces, slice by slice, which bound the coverage of a patch; see Shadows. They decide nothing.
//
// At an orientation R, pillar (p, k) touches the patch of sites a and b if a point of O_k - b, less the patch, is one of R (A_p - a). For
// a line that is fixed to the robot, the patch is on the other side, and turns. Vectors are measured along and across an edge of the
// obstacles, or along the axes.
#pragma once
#include "cfree/forbidden/trim.hpp"
#include "forbidden/octagon.hpp"

namespace cfree {

class RoundShadows {
public:
    // For the patches of one contact and obstacle pieces near it.
    // And for more pillars of radius 0: vertices of the obstacles, and of the robot.
    using Sum = std::array<std::vector<Index>, 2>;
    RoundShadows(const Scene& scene, const Feature& contact, const std::vector<Index>& pieces, const std::vector<Sum>& more = {});
    // Cut a range of angles into slices.
    void cut(int chart, double lo, double hi);
    Slices slices;
    // True if the patch is on the pillar's rim: the pieces have its features.
    bool is_own(Index p, std::size_t near) const;
    // Slices in which robot piece p and one of the obstacle pieces may touch the patch.
    Slices::Part part(Index p, std::size_t near) const;
    Slices::Part part_of_sum(std::size_t n) const {
        return part(scene.robot.pieces() + static_cast<Index>(n), near_pieces.size() + n);
    }

private:
    Vec<double> seen(const Shape& shape, Index from, Index to);

    const Scene& scene;
    const Feature contact;
    const std::vector<Index>& near_pieces;
    Vec<double> direction{1, 0};  // unit vector, rounded
    double size = 0;              // bound of all coordinates
    Index rows;                   // the robot's pieces, and those of more pillars
    struct Vertex {
        Index piece;
        Vec<double> at;
        double radius;
    };
    std::vector<Vertex> turning;  // the robot's
    std::vector<Octagon> still, turned;  // by obstacle piece; by slice and robot piece
};

}  // namespace cfree
