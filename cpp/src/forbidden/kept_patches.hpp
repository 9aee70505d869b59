// Patches of one boundary that hold in another scene; theory, "The trimmed boundary".
#pragma once
#include "cfree/forbidden/boundary.hpp"

namespace cfree {

// Obstacle features that hold in two scenes.
struct KeptFeatures {
    std::vector<Index> from;           // for each obstacle ring vertex the one of the other scene with its patches, or -1
    std::vector<Index> points, lines;  // an obstacle vertex at each point of the other scene, and an edge on each line; or -1
    const Shape* other;                // obstacles of the other scene
    // Name in this scene of a feature of a patch that is kept; one of those of its point or line.
    std::uint64_t renamed(std::uint64_t code) const;
};

// The obstacle features of a scene whose patches are as in another scene: their pieces, and all that is within the robot's reach
// of them, have not changed. None if the two scenes do not have the same robot in the same doubles.
std::optional<KeptFeatures> kept_features(const Scene& before, const Scene& scene);

// The rows of obstacle features, as in another boundary, with the names of this scene.
struct KeptPatches : KeptFeatures {
    std::vector<Index> retrimmed; // the ring vertices that are not kept
    // Add the rows of a ring vertex to those of this boundary, whose first patch is this one.
    void add(Index feature, Index first_patch, Trapezoids& live, Trapezoids& thin) const;

    struct Rows {
        const Trapezoids* columns;
        std::vector<Index> first;  // row of each ring vertex of the other boundary
    };
    Rows live, thin;
    std::vector<Index> first_patch;  // of each ring vertex of the other boundary
};

// First row of each ring vertex, whose patches are rows of one list, one after another.
std::vector<Index> first_rows(const Trapezoids& rows, const Patches& patches, const std::vector<Index>& first_patch);

// The patches of `other` that are the same in a scene. None if no features are, or if `other` does not have its parts without
// width.
std::optional<KeptPatches> kept_patches(const Boundary& other, const Scene& scene);

}  // namespace cfree
