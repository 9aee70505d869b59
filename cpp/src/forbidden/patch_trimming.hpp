// One patch of a scene at a time: all pillars near it taken away, of its surface only what it owns.
#pragma once
#include "cfree/forbidden/boundary.hpp"
#include "forbidden/coincident_surfaces.hpp"
#include "forbidden/pillar_index.hpp"

namespace cfree {

class PatchTrimming {
public:
    PatchTrimming(const Scene& scene, bool regularized);

    Patches patches;
    // Patches of obstacle feature j, which is a ring vertex and the edge that starts there: first_patch[j] .. first_patch[j + 1].
    const std::vector<Index> first_patch;
    // Pillars that may reach the patches of an obstacle feature.
    void pillars_near(Index feature, std::vector<Index>& out) const { neighbours.near(feature, out); }
    // What is left of a patch is added to `out`, what is left without width to `thin`.
    void trim(Index patch, const std::vector<Index>& near, std::vector<Trapezoid>& out, std::vector<Trapezoid>& thin,
              Tally& tally) const;

private:
    const Scene& scene;
    const PillarIndex neighbours;
    const CoincidentSurfaces owners;
};

}  // namespace cfree
