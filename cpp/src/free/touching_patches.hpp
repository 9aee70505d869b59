// Index of patches that may share a curve, a line at one orientation, or a pose with another: it names all that do, and few
// others. It uses doubles with proven bounds; gluing decides exactly.
#pragma once
#include "cfree/free/point_location.hpp"
#include "forbidden/patch_trimming.hpp"

namespace cfree {

class TouchingPatches {
public:
    TouchingPatches(const Scene& scene, const PatchTrimming& patches);

    // Patches that may have a piece of a curve of another patch between two angles. A surface contains a curve at every angle if it does
    // at one.
    void on_curve(const Surface& on, const Feature& curve, double from, double to, std::vector<Index>& out);
    // Patches that may have a piece of the line of another patch at an angle between two.
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
    struct Edge {
        Box box;
        Index feature;
    };
    const std::vector<Edge>& near(Index feature);

    // The robot's features that make patches, in their order: with every edge, and with every convex vertex of obstacles.
    struct Layer {
        std::vector<Index> vertices, edges;
        std::vector<Index> first_vertex, first_edge;  // of each chunk
        void begin_chunk() {
            first_vertex.push_back(static_cast<Index>(vertices.size())), first_edge.push_back(static_cast<Index>(edges.size()));
        }
    };
    // Vertices that follow each other, with their edges, are in a disc; where a contact holds, in a box.
    static constexpr Index in_chunk = 8;
    struct Chunk {
        double x, y, radius;
    };
    Chunk chunk(Index first, Index last) const;
    void place_chunks(const Surface& on, double from, double to);
    const Scene &given, &scene;  // the input, and the same from an origin near by
    const PatchTrimming& one;
    const BoxTree obstacle_edges;  // edges of their rings
    std::array<Layer, 2> layers;
    std::vector<Chunk> chunks;
    std::vector<Box> boxes;             // of the chunks
    Box around;                         // of all of them
    std::vector<std::size_t> meeting;   // chunks that meet an edge
    double size = 0;  // no point of the robot is farther from its origin
    Index near_to = -1;
    std::vector<Edge> recent;                       // near the last feature
    std::vector<Vec<Approx>> vertices, edges;       // vertices and edges of the turned robot
    std::vector<Vec<Approx>> places;                // the vertices', for a pose on a curve
    std::vector<Approx> offsets;                    // the edges'
};

}  // namespace cfree
