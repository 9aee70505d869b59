// Scene in the form of the core, made from polygons: integer coordinates, and an identity for every feature.
//
// Coordinates are multiplied by one common denominator. Coincident vertices get one point, directed edges on one line with
// one direction get one line, parallel edges get one direction: equality of features is settled here, exactly, once. The
// core then names curves and critical angles by these, and most ties need no arithmetic.
//
// Two layers meet only themselves: the robot's polygons with the obstacles (and the complement of the workspace), and the
// robot's reference point, as a shape of its own, with the complement of the bounds.
//
// Radii are data of features, in integers of the same denominator. The workspace and the bounds have none: the robot's counts
// against the workspace, and not against the bounds, which its reference point keeps.
#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "cfree/polygons/polygon.hpp"
#include "cfree/scene/scene.hpp"

namespace cfree {

// An arc in place of a polygon's side between two of its vertices, or of two sides if it is concave. A convex arc is
// counter-clockwise, and of less than half a turn.
struct Arc {
    RatioPoint from, to, centre;
    Ratio radius;
    // Of a concave arc, which is clockwise and of a quarter turn at most: the vertex between its two sides, and a point beyond it.
    // Less the disc, the triangle of the ends and that point is in the shape, and has the vertex inside.
    std::optional<std::array<RatioPoint, 2>> beyond = {};
};

// How a polygon is rounded: some of its sides are arcs, then it is grown. A thin one has a radius above 0.
struct Rounding {
    Ratio radius = {};
    std::vector<Arc> arcs = {};
};

// Rounding of polygon k; if the list is empty, none.
const Rounding& rounding_of(const std::vector<Rounding>& all, std::size_t k);

// Shapes of a scene.
struct SceneShapes {
    std::vector<std::shared_ptr<const Polygon>> robot, obstacles;
    std::shared_ptr<const Polygon> workspace;         // optional; the whole robot stays in it
    std::optional<std::array<Ratio, 4>> bounds;       // xmin, ymin, xmax, ymax: the reference point stays in them
    std::vector<Rounding> robot_rounding = {}, obstacle_rounding = {};  // one for each polygon; or empty, and none is rounded
    Index frames = 0;  // how many of the last obstacles are the complement of a round workspace: a frame, then its holes
    // The largest of the robot's radii: the robot is within the corners grown by it.
    Ratio robot_radius() const;
};

struct FacingArcs;

// Odd parts of the denominators of obstacles.
class SharedDenominators {
public:
    void add(const Polygon& polygon);
    // The common one of those that are not long and that a quarter of the vertices have.
    Int short_part() const;

private:
    Index vertices = 0;
    std::array<Index, 3> with_groups{};     // how many have decimals of more than 0, 6, and 12 digits
    std::map<unsigned, Index> with_factor;  // how many have which factor beyond those of decimals
};

// Data of the whole scene that the features of its parts need, so that all parts have the numbers of the whole.
struct WholeScene {
    Int scale = 1;                          // the common denominator
    std::optional<std::array<Int, 4>> box;  // box of its obstacles, grown, times the denominator: xmin, ymin, xmax, ymax
    std::optional<Int> short_part = {};     // see Scene; of its obstacles
    bool is_round = false;                  // true if a radius is above 0
    std::vector<Rounding> robot = {};       // of the robot's polygons: obstacles with arcs have points for them
    // Of some obstacles: the robot's arcs have all the points for these that they have for all.
    std::vector<Rounding> facing = {};
    // Add an obstacle.
    void add(const Polygon& polygon, const Rounding& rounding = {});
    SharedDenominators shared = {};  // of the obstacles that were added
    std::shared_ptr<FacingArcs> of_robot = {}, of_obstacles = {};  // made by the first obstacle that is rounded
};

inline constexpr Index body_layer = 0, reference_layer = 1;
inline constexpr Index bounds_owner = -1, workspace_owner = -2;  // used in place of polygons of the user's robot or obstacles

// Owners of the vertices of a shape's rings. The vertices of a polygon with arcs are its corners and its arcs, in order.
struct Owners {
    std::vector<Index> polygon, vertex;
    std::vector<Index> polygon_of_end;  // of the last vertices of the shape, ends of arcs and of stubs
};

struct SceneFeatures {
    SceneShapes shapes;
    std::shared_ptr<const Scene> scene;
    Owners robot, obstacles;
    std::optional<std::array<double, 4>> rim;  // around all patches, if bounds or a workspace are given
};
SceneFeatures scene_features(const SceneShapes& shapes, const WholeScene& whole = {});

Int floor_divide(const Int& n, const Int& d);  // d > 0

}  // namespace cfree
