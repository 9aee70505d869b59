// Single closed surfaces of a boundary, grown from a trapezoid over its sides; only patches that they meet are trimmed.
#pragma once
#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/free/point_location.hpp"

namespace cfree {

struct KeptFeatures;

class SurfaceExplorer {
public:
    SurfaceExplorer(std::shared_ptr<const Scene> scene, bool regularized);
    ~SurfaceExplorer();
    SurfaceExplorer(const SurfaceExplorer&) = delete;
    SurfaceExplorer& operator=(const SurfaceExplorer&) = delete;

    // Trapezoid at a free pose with exactly one contact; nothing if that is not certain. `vertex` is an obstacle vertex near
    // the pose, the origin of doubles.
    std::optional<Index> trapezoid_at(const ExactPose& pose, Index vertex);
    // Grow the closed surface of a trapezoid by this many others; the result is there once it is closed, or a target is
    // reached.
    struct Grown {
        std::shared_ptr<const CellComplex> complex;
        bool is_closed = false;
    };
    Grown grow(Index seed, Index most, Index target = -1);

    // Begin another question: what is trimmed and explored stays, but no surface is grown from where an earlier one ended.
    void begin();

    // Take the patches that another explorer has trimmed and that are the same in this scene.
    void take(const SurfaceExplorer& other, const KeptFeatures& kept);
    // Closed surface of another explorer in this scene; null if some of its patches are not the same.
    std::shared_ptr<const CellComplex> taken(const CellComplex& surface, const KeptFeatures& kept) const;

    // Number of patches trimmed so far, and of those that this question has met.
    std::size_t trimmed_patches() const;
    std::size_t met_patches() const;

private:
    struct State;
    const std::unique_ptr<State> state;
};

}  // namespace cfree
