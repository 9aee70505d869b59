// Shadows of pillars on a patch, which bound their coverage: octagons around their pieces, rounded outwards. They decide
// nothing.
//
// At an orientation the line of a patch is fixed to one shape: to the obstacle with its edge E, or to the robot. Along it and
// across it, from the origin t = 0 and times |E|, pillar (p, k) covers
//   v-e: O_k - b_j (+) -R (A_p - a_i),    e-v: A_p - a_i (+) -R^-1 (O_k - b_j),
// the sum of a fixed piece and a turning one. Boxes of both, and boxes half-way between their axes, are computed once per
// edge, and once per patch for every slice of its range; a pair costs comparisons.
#pragma once
#include <array>
#include <cstdint>
#include <limits>

#include "cfree/forbidden/trim.hpp"
#include "forbidden/octagon.hpp"

namespace cfree {

class Shadows {
public:
    explicit Shadows(const Scene& s);

    // Prepare for the patches of obstacle ring vertex j and the edge from it, with the pieces near it; no two points of the
    // robot are farther apart than `reach`.
    void around(Index j, const std::vector<Index>& near, double reach);
    const std::vector<Index>& pieces() const { return near; }
    struct Pillar {
        Index p, k;
        Index turning, still;  // places of its two pieces
        bool may_pinch;        // may touch the surface along the line, which counts anywhere on the line
        std::uint32_t slices;  // slices in which its shadow meets the patch, by bit
        std::size_t ranges;    // each slice's range on the line
        double cover;          // about its share of the patch, and a little for its size
    };
    // True if pillars certainly cover all of a patch between two angles of a chart, its rim included, one for each slice. Else
    // the first and the last slices that are covered are cut off.
    bool cover_at_once(const Surface& surface, Event& from, Event& to);
    // Pillars that may cover some of a patch between two angles of a chart, in the best order for subtraction.
    const std::vector<Pillar>& on(const Surface& surface, double lo, double hi);
    // Slices of that patch; Trimmer::left sets the live range in them.
    Slices slices;
    // Slices in which the pillar may cover something live.
    Slices::Part part(const Pillar& pillar) const;

private:
    struct Range {
        double low, high;
    };
    // Vertices of one piece after another, relative to one of the shape's vertices.
    struct Side {
        std::vector<Index> start{0};
        std::vector<Vec<double>> seen;
        double size = 0;  // bound of all coordinates of vertices, before and after rounding
        Index count() const { return static_cast<Index>(start.size()) - 1; }
        void clear() { start.assign(1, 0), seen.clear(), size = 0; }
    };
    // Pieces that are fixed together with an edge.
    struct Standing {
        Side side;
        std::vector<Octagon> octagon;                          // one per piece
        std::vector<double> along0, along1, across0, across1;  // the first half of that
        std::vector<char> has_edge;                            // true if it has the edge
        std::vector<std::array<double, 2>> parallel;           // place across of its edges along the line; NaN: none
        bool is_known = false, any_parallel = false;
    };
    // A robot piece and one of the near pieces, by its place, with a vertex of one that has been inside the other at each end.
    struct Overlap {
        Index p, place;
        Index witness[2] = {0, 0};
    };
    // That of robot vertex a at a point of the obstacles, relative to the patch's vertex.
    struct Helix {
        Index a;
        Vec<double> at;
    };
    using Arc = std::array<Vec<double>, 3>;  // control points of the rotations of a slice, the middle one first
    void look(const Shape& shape, Index origin, Index piece, Side& side) const;
    void look_at_robot(Index origin, Side& side) const;
    void stand(const Shape& shape, Index edge, bool of_robot, Standing& out) const;
    void turn(double sign, double slack);
    void turn_to(double x, double y, double sign, std::vector<Octagon>& out) const;
    std::array<Helix, 2> ends_of(const Feature& contact) const;
    bool recent_cover(const std::array<Helix, 2>& ends, const Arc& arc);
    bool covers_slice(const std::array<Helix, 2>& ends, int slice, const Arc& arc);
    Arc arc_of(int slice) const;
    bool stays_inside(const Overlap& pieces, Index witness, const Helix& helix, const Arc& arc) const;
    bool may_pinch(Index turning_piece, Index still_piece, double slack) const;
    Range range_of(int slice, Index turning_piece, Index still_piece) const;
    void add_pillars(Index turning_piece, const Feature& contact, double slack);
    const Octagon& in_slice(int slice, Index piece) const { return turned[static_cast<std::size_t>(slice * turning->count() + piece)]; }

    const Scene& scene;
    std::vector<Index> near;
    std::vector<Octagon> around_robot;     // around the robot's pieces
    std::vector<Octagon> placed;           // around the near pieces as they are, relative to the vertex
    Side obstacles, within_reach, robot;   // the near pieces, their parts that the robot can touch, and the robot's
    Standing at_obstacle;                  // fixed with the edge from the obstacle vertex
    std::vector<Standing> at_robot;        // fixed with the robot's edges
    const Side* turning = nullptr;         // turning side of the patch
    const Standing* still = nullptr;
    std::vector<double> along, across, radius;  // turning vertices
    std::vector<Vec<double>> at_middle;         // scratch: vertices of a robot piece in the middle of a slice
    std::vector<Octagon> turned;                // one per slice and piece, rounded outwards
    std::vector<Octagon> corners[2];            // scratch: octagons at the angles between two slices
    double rounded_size = 0;                    // twice the largest coordinate of the robot, if one of them is rounded
    double robot_size = 0;                      // bound of coordinates of the robot's vertices, relative to one of them
    std::vector<Overlap> recent;                // pillars that covered a slice of a patch, the last one first
    Vec<double> E;                              // vector of the patch's edge
    double length = 0;                          // |E|^2
    std::vector<std::uint64_t> crossing, meeting;          // slices, by fixed piece
    std::vector<Pillar> pillars;
    std::vector<Range> ranges;
};

}  // namespace cfree
