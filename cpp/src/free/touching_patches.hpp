// Index of patches that may share a curve, a line at one orientation, or a pose with another: it names all that do, and few
// others. It uses doubles with proven bounds; gluing decides exactly.
#pragma once
#include "cfree/free/point_location.hpp"
#include "forbidden/patch_trimming.hpp"

namespace cfree {

class TouchingPatches {
public:
    TouchingPatches(const Scene& scene, const PatchTrimming& patches);

    // Patches whose surface may contain a curve of another surface; it does so at every angle if it does at one.
    void on_curve(const Surface& on, const Feature& curve, double tau, std::vector<Index>& out);
    // Patches whose line may be that of another surface at an angle between two.
    void on_line(const Surface& on, double lo, double hi, std::vector<Index>& out);
    // True if a patch may have an orientation between two of a chart.
    bool is_there(Index patch, int chart, double lo, double hi) const;
    // Patches whose contact may hold at a pose; computed from an obstacle vertex near by.
    void at_pose(const ExactPose& pose, Index vertex, std::vector<Index>& out);

private:
    // Robot turned by an angle, relative to an obstacle vertex.
    struct Turned;
    Turned turned(Index vertex, int chart, double tau);
    Index obstacle_vertex(const Feature& contact) const;
    const std::vector<Index>& near(Index feature);

    // The robot's features that make patches, in their order: with every edge, and with every convex vertex of obstacles.
    struct Layer {
        std::vector<Index> vertices, edges;
    };
    const Scene &given, &scene;  // the input, and the same from an origin near by
    const PatchTrimming& one;
    const BoxTree obstacle_edges;  // edges of their rings
    std::array<Layer, 2> layers;
    double size = 0;  // no point of the robot is farther from its origin
    Index near_to = -1;
    std::vector<Index> recent;                      // features near the last one
    std::vector<Vec<Approx>> vertices, edges;       // vertices and edges of the turned robot
    std::vector<Vec<Approx>> places;                // the vertices', for a pose on a curve
    std::vector<Approx> offsets;                    // the edges'
};

}  // namespace cfree
