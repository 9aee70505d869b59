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
    // Whether a patch may have an orientation between two of a chart.
    bool is_there(Index patch, int chart, double lo, double hi) const;
    // Whose contact may be there at a pose; seen from an obstacle vertex near by.
    void at_pose(const ExactPose& pose, Index vertex, std::vector<Index>& out);

private:
    // The robot turned by an angle, seen from an obstacle vertex.
    struct Turned;
    Turned turned(Index vertex, int chart, double tau);
    Index obstacle_vertex(const Feature& contact) const;
    const std::vector<Index>& near(Index feature);

    // The robot's features that make patches, in their order: with every edge, and with every convex vertex of obstacles.
    struct Layer {
        std::vector<Index> vertices, edges;
    };
    const Scene &given, &scene;  // as given, and from an origin near by
    const PatchTrimming& one;
    const BoxTree obstacle_edges;  // of their rings
    std::array<Layer, 2> layers;
    double size = 0;  // no point of the robot is farther from its origin
    Index near_to = -1;
    std::vector<Index> recent;                      // features near that one
    std::vector<Vec<Approx>> vertices, edges;       // of the robot, turned
    std::vector<Vec<Approx>> places;                // of its vertices on a curve
    std::vector<Approx> offsets;                    // and of its edges
};

}  // namespace cfree
