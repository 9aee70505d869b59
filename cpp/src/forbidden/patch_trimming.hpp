// Trimming of one patch of a scene at a time: subtract all pillars near it, and keep only the parts of its surface that it
// owns.
#pragma once
#include "cfree/forbidden/boundary.hpp"
#include "forbidden/coincident_surfaces.hpp"
#include "forbidden/pillar_index.hpp"
#include "forbidden/shadows.hpp"

namespace cfree {

// Patches of obstacle feature j, which is a ring vertex and the edge that starts there: first[j] .. first[j + 1].
std::vector<Index> first_patches(const Scene& scene, const Patches& patches);

class PatchTrimming {
public:
    PatchTrimming(const Scene& scene, bool regularized);

    Patches patches;
    const std::vector<Index> first_patch;
    // Upper bound of the distance of two points of the robot.
    double reach() const { return neighbours.reach(); }
    Shadows shadows() const { return Shadows(scene); }
    // What a thread keeps from one patch to the next.
    struct Scratch {
        Shadows near;
        TrimLists lists;
    };
    Scratch scratch() const { return {shadows(), {}}; }
    // Pillars that may reach the patches of an obstacle feature.
    void pillars_near(Index feature, Shadows& out) const;
    // Add the live parts of a patch, with the pillars near its obstacle feature, to `out`, and those without width to `thin`.
    void trim(Index patch, Scratch& with, std::vector<Trapezoid>& out, std::vector<Trapezoid>& thin, Count& count) const;

private:
    void trim_round(Index patch, const Shadows& near, const std::vector<Feature>& before_it, std::vector<Trapezoid>& out,
                    std::vector<Trapezoid>& thin, Count& count) const;
    // Helices inside a bound's patch along which pillars may touch it, free space on both sides; theory, "The trimmed boundary".
    void seams(const Feature& contact, std::vector<Feature>& out) const;

    const Scene& scene;
    std::vector<Index> at_reference;  // vertices of the robot at its reference point
    const PillarIndex neighbours;
    const CoincidentSurfaces owners;
};

}  // namespace cfree
