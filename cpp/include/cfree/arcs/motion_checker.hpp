// Exact tests that whole translations and rotations are free among shapes of segments and arcs; theory, "Segments and arcs".
//
// Between two successive parameters at which some pair of curves is exactly in contact, all poses are free or all are not. So a
// motion is free if one pose between each two is. Doubles first leave out what keeps its distance.
#pragma once
#include <memory>
#include <optional>

#include "cfree/arcs/pose_checker.hpp"
#include "cfree/collision/motion_checker.hpp"

namespace cfree {

// A motion is free up to a parameter in [low, high], and not just after it; low = high = 0 also if it begins forbidden. The
// numbers of the part of the robot and of the obstacle, which is -1 for the bounds.
struct ArcCollision {
    Ratio low, high;
    Index part, obstacle;
};

class ArcMotionChecker final : public MotionTest {
public:
    // Motions are in units.
    explicit ArcMotionChecker(std::shared_ptr<const ArcScene> scene);
    ~ArcMotionChecker() override;
    ArcMotionChecker(const ArcMotionChecker&) = delete;
    ArcMotionChecker& operator=(const ArcMotionChecker&) = delete;
    bool is_free(const Motion& motion) const override;
    std::optional<ArcCollision> first_collision(const Motion& motion) const;
    // Bounds of the least distance along a free motion, at most `most` apart unless that takes too long. In the user's units.
    DistanceBounds clearance(const Motion& motion, double width) const;

    const std::shared_ptr<const ArcScene> scene;

private:
    class Run;
    const std::unique_ptr<const NearScene> near;
};

}  // namespace cfree
