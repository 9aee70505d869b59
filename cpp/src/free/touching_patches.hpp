// Which patches may share a curve, a line at one orientation, or a pose with another: all that do are named, and few others.
// In doubles with proven bounds; what is decided exactly, gluing decides.
#pragma once
#include "cfree/free/point_location.hpp"
#include "forbidden/patch_trimming.hpp"

namespace cfree {

class TouchingPatches {
public:
    TouchingPatches(const Scene& scene, const PatchTrimming& patches);

    // On whose surface a curve of another surface may lie, as it does at every angle if it does at one.
    void on_curve(const Surface& on, const Feature& curve, double tau, std::vector<Index>& out);
    // Whose line may be that of another surface at an angle between two.
    void on_line(const Surface& on, double lo, double hi, std::vector<Index>& out);
    // Whose contact may be there at a pose, at which another is.
    void at_pose(const Feature& contact, const ExactPose& pose, std::vector<Index>& out);

private:
    // The robot turned by an angle, seen from the obstacle vertex of a contact.
    struct Turned;
    Turned turned(const Feature& contact, int chart, double tau);
    const std::vector<Index>& near(Index feature);
    template <class Test>
    void find(const Feature& contact, std::vector<Index>& out, const Test& may);

    const Scene &given, &scene;  // as given, and from an origin near by
    const PatchTrimming& one;
    const BoxTree edges;  // of obstacles' rings
    double reach;         // no two points of the robot are farther apart
    Index near_to = -1;
    std::vector<Index> recent;  // features near that one
    std::vector<Vec<Approx>> vertices, directions;
};

}  // namespace cfree
