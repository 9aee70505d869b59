// Exact tests that whole motions are free: translations, rotations about a pole, and slides.
//
// Along a motion the robot's points are X(u) / W(u), polynomials in a parameter u in [0, 1]; so are the obstacles' points in
// the robot's frame. The polynomials are quadratic, for slides of degree 6. A point is on the inner side of an edge's line if
// a polynomial is positive. Two convex pieces overlap unless an edge of one has the other's vertices on its outer side or on
// its line.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "cfree/exact/algebraic.hpp"
#include "cfree/exact/ratio.hpp"
#include "cfree/scene/scene.hpp"

namespace cfree {

struct Box;
class BoxTree;

// Motion from a pose along a vector, or about a pole by at most half a turn. Lengths are in the scene's integer units, over
// `unit`.
struct Motion {
    Int c, s, w;     // the pose's cosine is c / w, its sine s / w
    Int x, y, unit;  // and its position
    bool turns;
    Int vx, vy;      // the vector, or the pole
    Int start, q, p; // half of the angle turned is that of (1 - u) (start, 0) + u (q, p)
};

// Motion of a turning robot from a pose along (x / d, y / d), polynomials in u; half the angle is that of (q, p u).
struct Slide {
    Int c, s, w, q, p;
    std::array<Int, 5> x, y, d;  // position in the scene's integer units; d is positive
};

// A parameter just after which pieces overlap: a root at which the polynomial grows through zero, or 0.
struct Collision {
    RealRoot at;
    Index robot_piece, obstacle_piece;
    int kind = 0;  // 1: robot vertex on obstacle edge; 2: robot edge on obstacle vertex; 0: forbidden from the beginning
    Index robot = -1, obstacle = -1;
};

// A test that translations and rotations are free.
class MotionTest {
public:
    virtual ~MotionTest() = default;
    virtual bool is_free(const Motion& motion) const = 0;
};

class MotionChecker final : public MotionTest {
public:
    // With round shapes, in units, instead of which the scene has polygons, they decide if translations and rotations are free.
    explicit MotionChecker(std::shared_ptr<const Scene> scene, std::shared_ptr<const MotionTest> round = {});
    ~MotionChecker() override;
    MotionChecker(const MotionChecker&) = delete;
    MotionChecker& operator=(const MotionChecker&) = delete;
    bool is_free(const Motion& motion) const override;
    bool is_free(const Slide& slide) const;
    // True if it begins beyond the frames around the bounds and the workspace, where nothing of the polygons is in the way.
    bool begins_outside(const Motion& motion) const;
    std::optional<Collision> first_collision(const Motion& motion) const;
    // Parameter of the first collision of a translation.
    std::optional<Ratio> free_share(const Motion& translation) const;

    const std::shared_ptr<const Scene> scene;

private:
    template <int N>
    class Run;
    struct Rim {
        Int x0, y0, x1, y1;
        std::array<double, 4> inner;  // positions of the reference point, in doubles, with all of the robot within
    };
    std::array<std::optional<Rim>, 2> rims;  // one per layer, of the frames
    const std::vector<Box> boxes;
    const std::unique_ptr<BoxTree> tree;  // tree of the obstacles' pieces
    const std::shared_ptr<const MotionTest> round;
};

}  // namespace cfree
