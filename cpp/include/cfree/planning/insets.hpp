// Scenes with a slightly smaller robot, in bounds larger by the same amount, with cached results.
//
// If the smaller robot touches an obstacle at a pose, the robot overlaps it there. Theory, "Separations", has the
// consequences.
#pragma once
#include <map>

#include "cfree/planning/known_scene.hpp"

namespace cfree {

// Separating surface of two poses: "closed", of a smaller robot in larger bounds, or "interior", of the scene itself.
struct Separation {
    Barrier surface;
    std::shared_ptr<const KnownScene> of;
    bool is_closed;
};

// Enlarge bounds, if there are any, on all sides.
void enlarge_bounds(SceneShapes& shapes, const Ratio& by);

class Insets {
public:
    explicit Insets(const SceneShapes& scene);

    // Insets that a proof may need, as powers of two of the robot's size: each has half as many digits as the next. The
    // narrowest gap may need the digits of the scene's coordinates, and some times as many.
    const std::vector<int> powers;
    // First power that leaves something of each of the robot's polygons.
    int first();
    // Scene with a robot smaller by 2^power of its size; null if nothing is left of it, or coordinates are out of range.
    std::shared_ptr<KnownScene> scene(int power);
    // Exponent of the power of two that is about the size of the robot.
    const int size;

    // Separation by an inset of 2^power of the robot's size, if there is one. Calls from several threads run one after another.
    std::optional<Separation> closed(const RationalPose& start, const RationalPose& goal, int power, const Listener& listener);
    std::size_t known() const { return scenes.size(); }
    // Take what has been computed of the insets of another scene and what holds in this one.
    void take(Insets& other);

private:
    struct Inner {
        std::shared_ptr<KnownScene> scene;  // null if nothing is left of the robot, or coordinates are out of range
        bool is_whole = false;
    };
    const Inner& at(int power);

    const SceneShapes shapes;
    std::mutex lock;
    std::map<int, Inner> scenes;
};

// Proof that no motion joins two free poses that are not in the closure of one cell: "closed", by the first inset that
// separates them; else "interior".
Separation separation(const std::shared_ptr<const KnownScene>& scene, const Built& built, Insets& insets, const RationalPose& start,
                      const RationalPose& goal, const std::vector<int>& powers, const Listener& listener);

}  // namespace cfree
