// Lazily computed, cached results for one scene: closed surfaces around poses, and all of the free space.
#pragma once
#include <mutex>

#include "cfree/arcs/pose_checker.hpp"
#include "cfree/collision/pose_checker.hpp"
#include "cfree/free/free_space.hpp"
#include "cfree/planning/deadline.hpp"
#include "cfree/planning/surroundings.hpp"
#include "cfree/scene/features.hpp"
#include "cfree/search/motion_guess.hpp"
#include "cfree/search/way.hpp"

namespace cfree {

// The whole free space: the boundary, and the surfaces that bound the cells.
struct Built {
    SharedBoundary boundary;
    std::shared_ptr<const CellComplex> surfaces;
    std::shared_ptr<const FreeSpace> space;
    // First cell whose closure contains two free poses, or -1.
    Index common_cell(const RationalPose& start, const RationalPose& goal) const;
};

// A closed surface: some trapezoids of a boundary.
struct Barrier {
    SharedBoundary boundary;
    std::vector<Index> faces;
};

Barrier barrier_of(const CellComplex& surface);

// Several threads may call this, with the exceptions noted below.
class KnownScene {
public:
    static std::shared_ptr<KnownScene> of(const SceneShapes& shapes);
    // If round shapes decide: their poses, and how much too large the distances of the polygons may be.
    KnownScene(std::shared_ptr<const SceneFeatures> features, std::shared_ptr<const MotionChecker> checker, double slack = 0,
               std::shared_ptr<const ArcPoseChecker> round = {});

    const std::shared_ptr<const SceneFeatures> features;
    const std::shared_ptr<const MotionChecker> checker;
    const double slack;
    const std::shared_ptr<const ArcPoseChecker> round;
    const Scene& scene() const { return *features->scene; }
    const SceneShapes& shapes() const { return features->shapes; }

    // False outside the frame around bounds and workspace, which the scene does not represent.
    bool is_within_limits(const RationalPose& pose) const;
    bool is_free(const RationalPose& pose) const;
    // Number of patches before trimming.
    std::int64_t patches() const;
    const Nearness& nearness() const;
    // A look at one pose after another: is it certainly forbidden?
    MotionGuess::IsForbidden looks() const;
    // Box around the workspace, or else around the obstacles, in the user's units; empty if there are none.
    const Area& box() const;

    // Search that decides whether two free poses are joined; only one thread may use those of a scene at a time.
    Connecting connecting(const RationalPose& start, const RationalPose& goal);
    // Closed surface around exactly one of two poses that touch nothing, if there is one; for one thread at a time.
    std::optional<Barrier> barrier(const RationalPose& start, const RationalPose& goal, const Listener& listener);

    // Take what has been computed of another scene and what holds in this one; before any other call, and for one thread at a time,
    // in both scenes.
    void take(const KnownScene& other);
    // True if there is something to take.
    bool has_results() const { return around || built() || former; }

    // Null until it has been built.
    std::shared_ptr<const Built> built() const;
    std::shared_ptr<const Built> build(const Listener& listener);
    void keep(std::shared_ptr<const Built> found);

private:
    std::optional<std::array<Int, 4>> frame;  // frame of a workspace: xmin, ymin, xmax, ymax
    mutable std::mutex lock;  // guards the cache
    std::shared_ptr<Surroundings> around;
    std::shared_ptr<const Built> space, former;  // former: of another scene
    std::shared_ptr<const PoseChecker> poses() const;
    mutable std::unique_ptr<const Nearness> near;
    mutable std::shared_ptr<const PoseChecker> pose_checker;
    mutable std::optional<Area> around_all;
};

// Surface of a free space with the fewest faces that is around exactly one of two cells; -1 is no cell. It has no faces if
// there is none.
Barrier barrier_between(const Built& built, Index first, Index second);

}  // namespace cfree
