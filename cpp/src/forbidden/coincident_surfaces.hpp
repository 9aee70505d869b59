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

// Contacts among grown shapes whose surfaces coincide and whose free sides face each other. Their vertices of the robot are at one
// place, and lines of the obstacles, moved by both radii, are one; or the same with robot and obstacles exchanged. Or their vertices
// of both are at one place, and a concave arc's circle is that of a convex one.
class RoundSlits {
public:
    explicit RoundSlits(const Scene& scene);
    ~RoundSlits();
    void add_opposite(const Feature& contact, std::vector<Feature>& out) const;
    bool may_be() const;

private:
    struct Lines;
    // Vertices of a shape by place.
    struct Places {
        std::vector<std::vector<Index>> at;
        std::vector<Index> place;
        // Vertices beside which there is another one, or that are discs: the cone of a vertex is narrower than half a turn.
        std::vector<Index> facing;
        explicit Places(const Shape& s);
        // Vertices at the place of one whose normals may be opposite to its own.
        std::vector<Index> beside(const Shape& s, Index vertex) const;
    };
    void add_lines(const Feature& contact, std::vector<Feature>& out) const;
    void add_circles(const Feature& contact, std::vector<Feature>& out) const;
    using LinesByRadius = std::vector<std::unique_ptr<const Lines>>;
    static const Lines* moved_by(const LinesByRadius& all, const Int& further);
    static void add_moved(LinesByRadius& all, const Shape& s, const Int& further);
    const Scene& scene;
    Places of_robot, of_obstacles;
    std::unique_ptr<const Lines> bounds;
    LinesByRadius walls, prongs;  // edges of the obstacles, by radii of the robot, and edges of the robot, by radii of the obstacles
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
