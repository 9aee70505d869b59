// Scenes with a robot a little smaller, in bounds as much larger; what is found of each is kept.
//
// A pose at which the smaller robot touches an obstacle is one at which the robot overlaps it. What that proves is in theory,
// "Separations".
#pragma once
#include <map>

#include "cfree/planning/known_scene.hpp"

namespace cfree {

// A closed surface between two poses: of a smaller robot in larger bounds, "closed", or of the scene's own, "interior".
struct Separation {
    Barrier surface;
    std::shared_ptr<const KnownScene> of;
    bool is_closed;
};

class Insets {
public:
    explicit Insets(const SceneShapes& scene);

    // Insets that a proof may need, as powers of two of the robot's size: each is half as many digits as the next. The narrowest
    // gap may be as narrow as the scene's coordinates have digits, and some times that.
    const std::vector<int> powers;
    // The first of them that leaves something of each of the robot's polygons.
    int first();
    // With the robot smaller by 2^power of its size; none if nothing is left of it, or coordinates are beyond what is allowed.
    std::shared_ptr<KnownScene> scene(int power);
    // Of the power of two that is about as large as the robot.
    const int size;

    // By an inset of 2^power of the robot's size, if that separates. Calls from several threads are made one after the other.
    std::optional<Separation> closed(const RationalPose& start, const RationalPose& goal, int power, const Listener& listener);
    std::size_t known() const { return scenes.size(); }

private:
    struct Inner {
        std::shared_ptr<KnownScene> scene;  // null if nothing is left of the robot, or coordinates are beyond what is allowed
        bool is_whole = false;
    };
    const Inner& at(int power);

    const SceneShapes shapes;
    std::mutex lock;
    std::map<int, Inner> scenes;
};

// A proof that no motion joins two free poses that are not in the closure of one cell: closed, by the first of some insets that
// separates them; or else of the interior.
Separation separation(const std::shared_ptr<const KnownScene>& scene, const Built& built, Insets& insets, const RationalPose& start,
                      const RationalPose& goal, const std::vector<int>& powers, const Listener& listener);

}  // namespace cfree
