// Surfaces that coincide: every piece of boundary that several patches share belongs to one of them.
#pragma once
#include <memory>
#include <optional>

#include "cfree/predicates/predicates.hpp"

namespace cfree {

// Orientations of a contact (the paper's phi_min to phi_max), cut at the ends of the charts.
struct Range {
    int count = 0;
    int chart[2];
    Event from[2], to[2];
};
Range range_of(const Scene& scene, const Feature& contact, Counters& counters);

// Contacts among grown shapes whose surfaces coincide and whose free sides face each other. A line of the obstacles, moved by
// both radii, is one with a line that faces it. The robot's vertex is then a disc's centre for both; or it is at the reference
// point, and one of the lines is a bound. Or else two lines of the robot face each other around a disc.
class RoundSlits {
public:
    explicit RoundSlits(const Scene& scene);
    ~RoundSlits();
    void add_opposite(const Feature& contact, std::vector<Feature>& out) const;
    bool may_be() const;

private:
    struct Lines;
    std::vector<Index> at(Index vertex) const;  // vertices of the other layer at the place of one
    static const Lines* moved_by(const std::vector<std::unique_ptr<const Lines>>& all, const Int& further);
    const Scene& scene;
    std::vector<Index> references, bodies;
    std::unique_ptr<const Lines> bounds;
    // Edges of the obstacles, by radii of the robot, and edges of the robot, by radii of discs among the obstacles.
    std::vector<std::unique_ptr<const Lines>> walls, prongs;
};

// True if vertex i of the robot and vertex j of the obstacles touch on a circle: both are convex, and one is an arc; or one is a
// concave arc and the other a convex vertex of a smaller radius.
bool makes_circles(const Scene& scene, Index i, Index j);

class CoincidentSurfaces {
public:
    // regularized: patches of one surface whose free sides face each other own nothing.
    CoincidentSurfaces(const Scene& scene, bool regularized);

    // Contacts that own the parts they share with this one: same surface, lower rank, for any order of input.
    std::vector<Feature> before(const Feature& contact) const;
    // Edges of obstacles that begin or end in the point of a vertex.
    std::vector<Index> edges_at(Index vertex) const;

private:
    // Ring features by class.
    struct Groups {
        std::vector<Index> start, member;
        Groups(const std::vector<Index>& group, Index count);
    };
    std::array<Index, 2> rank(const Feature& contact) const;
    bool is_patch(const Feature& contact) const;
    void add_opposite(const Feature& contact, std::vector<Feature>& out) const;
    void add_bounds(const Feature& contact, std::vector<Feature>& out) const;

    const Scene& scene;
    bool regularized;
    Groups robot_points, robot_lines, obstacle_points, obstacle_lines;
    std::optional<RoundSlits> slits;  // of grown shapes
};

}  // namespace cfree
