// Where on a patch pillars may cover something: octagons around their pieces, rounded outwards. This decides nothing.
//
// At an orientation the line of a patch is fixed to one shape: to the obstacle whose edge E it is, or to the robot. Along it and
// across it, seen from where t = 0 and times |E|, pillar (p, k) covers
//   v-e: O_k - b_j (+) -R (A_p - a_i),    e-v: A_p - a_i (+) -R^-1 (O_k - b_j),
// the sum of one piece that stands still and one that turns. Boxes of both, and boxes half way between their axes, are found once an
// edge, and once a patch for every slice of its range; a pair costs comparisons.
#pragma once
#include <cstdint>
#include <limits>

#include "cfree/forbidden/trim.hpp"

namespace cfree {

class Shadows {
public:
    explicit Shadows(const Scene& s) : scene(s), at_robot(static_cast<std::size_t>(s.robot.ring_vertices)) {}

    // The patches to come are those of obstacle ring vertex j and the edge from it. The pieces near it; no two points of the
    // robot are farther apart than `reach`.
    void around(Index j, const std::vector<Index>& near, double reach);
    struct Pillar {
        Index p, k;
        Index turning, still;  // places of its two pieces
        bool may_pinch;        // may touch the surface along the line, which counts wherever on the line that is
        std::uint32_t slices;  // where its shadow meets the patch, by bit
        std::size_t ranges;    // by slice: where on the line
        double cover;          // about how much of the patch
    };
    // Pillars that may cover some of a patch between two angles of a chart, in the order in which they are best taken away.
    const std::vector<Pillar>& on(const Surface& surface, double lo, double hi);
    // The slices of that patch; what is left in them is set by Trimmer::left.
    Slices slices;
    // Whether one of them is seen to cover all of the patch, its rim included.
    bool cover_all(const Feature& contact);
    // Where the pillar may cover some of what is left.
    Slices::Part part(const Pillar& pillar) const;

private:
    // Between which values are: along, across, their sum, their difference.
    struct Octagon {
        static constexpr double infinity = std::numeric_limits<double>::infinity();
        double low[4] = {infinity, infinity, infinity, infinity}, high[4] = {-infinity, -infinity, -infinity, -infinity};
        void add(double along, double across) {
            const double value[4] = {along, across, along + across, along - across};
            for (int i = 0; i < 4; ++i) {
                low[i] = value[i] < low[i] ? value[i] : low[i];
                high[i] = high[i] < value[i] ? value[i] : high[i];
            }
        }
        void add(const Octagon& o) {
            for (int i = 0; i < 4; ++i) {
                low[i] = o.low[i] < low[i] ? o.low[i] : low[i];
                high[i] = high[i] < o.high[i] ? o.high[i] : high[i];
            }
        }
    };
    struct Range {
        double low, high;
    };
    // Vertices of one piece after another, seen from one of the shape's vertices.
    struct Side {
        std::vector<Index> start{0};
        std::vector<Vec<double>> seen;
        double size = 0;  // no coordinate of a vertex seen is greater, nor were those it was rounded from
        Index count() const { return static_cast<Index>(start.size()) - 1; }
        void clear() { start.assign(1, 0), seen.clear(), size = 0; }
    };
    // What stands still with an edge.
    struct Standing {
        Side side;
        std::vector<Octagon> octagon;                          // by piece
        std::vector<double> along0, along1, across0, across1;  // the first half of that
        std::vector<char> has_edge;                            // whether it has the edge
        std::vector<std::array<double, 2>> parallel;           // how far across its edges along the line are; NaN: none
        bool is_known = false, any_parallel = false;
    };
    void look(const Shape& shape, Index origin, Index piece, Side& side) const;
    void look_at_robot(Index origin, Side& side) const;
    void stand(const Shape& shape, Index edge, bool of_robot, Standing& out) const;
    Vec<double> rotation(double x, double y) const;
    void turn(double sign, double slack);
    void turn_to(double x, double y, double sign, std::vector<Octagon>& out) const;
    bool covers_helix(const Pillar& pillar, Index robot_vertex, const Vec<double>& at);
    bool may_pinch(Index turning_piece, Index still_piece, double slack) const;
    Range range_of(int slice, Index turning_piece, Index still_piece) const;
    void add_pillars(Index turning_piece, const Feature& contact, double slack);
    const Octagon& in_slice(int slice, Index piece) const { return turned[static_cast<std::size_t>(slice * turning->count() + piece)]; }

    const Scene& scene;
    std::vector<Index> near;
    Side obstacles, within_reach, robot;   // the near pieces, of them what the robot can touch, and the robot's
    Standing at_obstacle;                  // with the edge from the obstacle vertex
    std::vector<Standing> at_robot;        // with the robot's edges
    const Side* turning = nullptr;         // for the patch
    const Standing* still = nullptr;
    std::vector<double> along, across, radius;  // of what turns, by vertex
    std::vector<Octagon> turned;                // by slice and piece, rounded outwards
    std::vector<Octagon> corners[2];            // scratch: of the angles between two slices
    Side seen_robot;                            // scratch: one piece
    Vec<double> E;                              // of the patch's edge
    double length = 0;                          // |E|^2
    std::vector<std::uint64_t> crossing, meeting;          // slices, by piece that stands still
    std::vector<Pillar> pillars;
    std::vector<Range> ranges;
};

}  // namespace cfree
