// Shapes of lines and circular arcs, exactly as a page gives them, and polygons inside or around them.
//
// A polygon beyond or within an arc has its vertices on one side of it, and in the order of their angles about its center. So
// the arc can be moved into the polygon's edges over points of that side alone, and winding numbers change there in one sense:
// if the polygon is simple, it is around the shape, or inside.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "cfree/arcs/motion_checker.hpp"
#include "cfree/arcs/pose_checker.hpp"
#include "cfree/scene/features.hpp"

namespace cfree {

// A line (turn 0), or an arc about a center: counter-clockwise (1) or clockwise (-1), by some quarter turns and, after these, an
// angle whose half has the tangent `rest`.
struct GivenCurve {
    RatioPoint start, end, center = {};
    int turn = 0, quarters = 0;
    Ratio rest = {};
};

struct GivenShape {
    std::vector<std::vector<GivenCurve>> rings;
    std::shared_ptr<const Polygon> polygon;  // of lines alone; null with arcs
    Ratio grown;
    bool is_round = false;
    bool has_arcs() const { return is_round && !polygon; }
};

struct GivenScene {
    std::vector<GivenShape> robot, obstacles;
    std::optional<GivenShape> workspace;
    std::optional<std::array<Ratio, 4>> bounds;
    Ratio clearance = {};  // by which the robot is grown
    bool is_round() const;
    // Of a scene without round shapes.
    SceneShapes polygons() const;
};

struct GivenCircle {
    RatioPoint center;
    Ratio radius;
};
// Nothing of other shapes.
std::optional<GivenCircle> circle_of(const GivenShape& shape);
// Throws std::invalid_argument if the ends of an arc are not equally far from its center.
GivenCurve arc_about(const RatioPoint& start, const RatioPoint& center, const RatioPoint& end, bool is_clockwise);
// Throws std::invalid_argument if the three points are on one line.
GivenCurve arc_through(const RatioPoint& start, const RatioPoint& middle, const RatioPoint& end);
// The point after some quarter turns of an arc, and an angle whose half has a tangent.
RatioPoint point_of(const GivenCurve& arc, int quarters, const Ratio& tangent);
// A line, or arcs of at most a quarter turn.
std::vector<GivenCurve> quarters_of(const GivenCurve& curve);
std::vector<GivenCurve> circle_about(const RatioPoint& center, const Ratio& radius);

// Outlines for the eye: the vertices, ring after ring, and beside each the radius of the arc to the next one, below 0 if it is
// clockwise; 0 for a line.
struct Outlines {
    std::vector<double> xy, bend;
    std::vector<Index> ring{0}, shape{0};
    void add(const GivenShape& shape);
};

inline constexpr Index robot_owner = -3;  // beside bounds and workspace

// Polygons in place of round shapes, or rounded shapes as they are, and the numbers of the shapes that they are for.
struct NearShapes {
    SceneShapes shapes;
    std::vector<Index> part_of, obstacle_of;
    std::vector<Index> inexact;  // shapes that have polygons: obstacles, the workspace, the robot
    double error = 0, off = 0;   // the largest of a shape; distances among them differ by no more than the other
};

class Rounds {
public:
    explicit Rounds(GivenScene given);

    const GivenScene asked;  // as it was given
    const GivenScene scene;  // with the robot grown by the clearance
    const std::shared_ptr<const ArcMotionChecker> motions;
    const ArcPoseChecker poses;
    const double size;  // of the robot

    // Polygons around everything forbidden, or inside of it, with an error of a part of the robot's size. Throws
    // std::invalid_argument if a shape has none; obstacles without one inside are left out, and `off` is infinite.
    NearShapes polygons(double share, bool is_outward) const;
    // Rounded shapes as they are, and polygons around the others.
    NearShapes drawn(double share) const;
    // Obstacles that the robot touches at a free pose, or the workspace. Distances below a 2^80th of its size count as 0.
    std::vector<Index> touched(const Motion& still) const;
    // The obstacle's number in collisions, or bounds or workspace.
    Index owner(Index obstacle) const;

private:
    struct Adding;
    std::vector<std::unique_ptr<const ArcMotionChecker>> apart;  // of each obstacle and the robot, grown a little
};

}  // namespace cfree
