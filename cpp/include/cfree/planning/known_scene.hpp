// What is found out about one scene, when it is first asked for, and kept: closed surfaces around poses, all of the free space.
#pragma once
#include <mutex>

#include "cfree/collision/pose_checker.hpp"
#include "cfree/free/free_space.hpp"
#include "cfree/planning/deadline.hpp"
#include "cfree/planning/surroundings.hpp"
#include "cfree/scene/features.hpp"
#include "cfree/search/way.hpp"

namespace cfree {

// All of the free space: the boundary, and the surfaces that bound the cells.
struct Built {
    SharedBoundary boundary;
    std::shared_ptr<const CellComplex> surfaces;
    std::shared_ptr<const FreeSpace> space;
    // The first cell that two free poses are both in or on the boundary of, or -1.
    Index common_cell(const RationalPose& start, const RationalPose& goal) const;
};

// A closed surface: some trapezoids of a boundary.
struct Barrier {
    SharedBoundary boundary;
    std::vector<Index> faces;
};

Barrier barrier_of(const CellComplex& surface);

// Calls from several threads are fine where nothing else is said.
class KnownScene {
public:
    static std::shared_ptr<KnownScene> of(const SceneShapes& shapes);
    KnownScene(std::shared_ptr<const SceneFeatures> features, std::shared_ptr<const MotionChecker> checker);

    const std::shared_ptr<const SceneFeatures> features;
    const std::shared_ptr<const MotionChecker> checker;
    const Scene& scene() const { return *features->scene; }
    const SceneShapes& shapes() const { return features->shapes; }

    // What is around bounds and workspace is not all of the plane: the scene does not know it.
    bool is_within_limits(const RationalPose& pose) const;
    bool is_free(const RationalPose& pose) const;
    // Patches before trimming.
    std::int64_t patches() const;
    const Nearness& nearness() const;
    std::shared_ptr<const PoseChecker> poses() const;
    // A box around the workspace, or else around the obstacles, in the user's units; empty if there are none.
    const Area& box() const;

    // What finds out whether two free poses are joined: used by one thread at a time, as all others of this scene.
    Connecting connecting(const RationalPose& start, const RationalPose& goal);
    // A closed surface around one of two poses that touch nothing and not around the other, if one is; by one thread
    // at a time.
    std::optional<Barrier> barrier(const RationalPose& start, const RationalPose& goal, const Listener& listener);

    // Null as long as it has not been built.
    std::shared_ptr<const Built> built() const;
    std::shared_ptr<const Built> build(const Listener& listener);
    void keep(std::shared_ptr<const Built> found);

private:
    std::optional<std::array<Int, 4>> frame;  // around a workspace: xmin, ymin, xmax, ymax
    mutable std::mutex lock;  // of what is kept
    std::shared_ptr<Surroundings> around;
    std::shared_ptr<const Built> space;
    mutable std::unique_ptr<const Nearness> near;
    mutable std::shared_ptr<const PoseChecker> pose_checker;
    mutable std::optional<Area> around_all;
};

// Of the surfaces of a free space: the one with the fewest faces that is around one of two cells and not around the other; -1 is
// no cell. Of no faces if there is none.
Barrier barrier_between(const Built& built, Index first, Index second);

}  // namespace cfree
