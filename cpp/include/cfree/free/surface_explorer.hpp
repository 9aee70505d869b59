// Single closed surfaces of a boundary, grown from a trapezoid over its sides: only patches that they meet are trimmed.
#pragma once
#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/free/point_location.hpp"

namespace cfree {

class SurfaceExplorer {
public:
    SurfaceExplorer(std::shared_ptr<const Scene> scene, bool regularized);
    ~SurfaceExplorer();
    SurfaceExplorer(const SurfaceExplorer&) = delete;
    SurfaceExplorer& operator=(const SurfaceExplorer&) = delete;

    // The trapezoid at a free pose where one contact is, and no other; none where that is not certain.
    std::optional<Index> trapezoid_at(const Feature& contact, const ExactPose& pose);
    // Grow the closed surface of a trapezoid by about so many others; the surface once it is closed.
    std::shared_ptr<const CellComplex> grow(Index seed, Index most);

    std::size_t trimmed_patches() const;

private:
    struct State;
    const std::unique_ptr<State> state;
};

}  // namespace cfree
