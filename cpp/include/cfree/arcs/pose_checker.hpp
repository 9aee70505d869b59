// Test that poses are free among shapes of segments and arcs: in doubles with a bound, else exactly; theory, "Segments and arcs".
#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "cfree/arcs/shape.hpp"
#include "cfree/collision/pose_checker.hpp"

namespace cfree {

class NearScene;

// A distance is in an interval; 0, 0 if shapes overlap. In the user's units.
struct DistanceBounds {
    double low, high;
};

class ArcPoseChecker {
public:
    explicit ArcPoseChecker(std::shared_ptr<const ArcScene> scene);
    ~ArcPoseChecker();
    ArcPoseChecker(const ArcPoseChecker&) = delete;
    ArcPoseChecker& operator=(const ArcPoseChecker&) = delete;

    // Verdicts of poses x, y and theta in [0, 2 pi], radians.
    void check(const double* poses, std::size_t count, int threads, Verdict* out) const;
    // Verdict of one pose of many, theta in [0, 2 pi].
    Verdict look(double x, double y, double theta) const;
    // One pose, exactly.
    bool is_free(const GivenPose& pose) const;
    // Exactly the pose that Python's `Pose` makes of three finite doubles. Nothing for an angle that `read_radians` leaves out.
    std::optional<bool> is_free(double x, double y, double theta) const;
    // Distance of the robot from all obstacles, at most `most`.
    DistanceBounds distance(const GivenPose& pose, double most) const;

    const std::shared_ptr<const ArcScene> scene;

private:
    struct Placed;
    Placed& own() const;  // this thread's
    bool is_within(double x, double y) const { return limits[0] <= x && x <= limits[2] && limits[1] <= y && y <= limits[3]; }
    // Of all poses in which no point moves by more than the slack, among all obstacles or some; doubles are those of `near`.
    using Numbers = std::span<const Index>;
    Verdict verdict(Placed& placed, double x, double y, double c, double s, double slack, std::optional<Numbers> among = {}) const;
    Verdict decided(Placed& placed, double x, double y, double theta, double slack, std::optional<Numbers> among) const;
    // Verdicts of boxes of poses, for many poses.
    struct Grid;
    Grid* grid(std::size_t poses) const;
    // A pose in the user's units; by its box, if there is a grid.
    Verdict boxed(Placed& placed, Grid* cells, double x, double y, double theta) const;
    bool decide(const Placed& placed, const ExactPlacement& at) const;
    const std::unique_ptr<const NearScene> near;
    const std::size_t number;
    std::array<double, 4> limits;  // the bounds, rounded inwards
    mutable std::once_flag made;
    mutable std::unique_ptr<Grid> boxes;
    mutable std::atomic<std::size_t> asked{0};
};

}  // namespace cfree
