// Proofs by cells of smaller rounded shapes, as in src/cfree/planning/rounded_cells.py.
#pragma once
#include <memory>
#include <optional>

#include "cfree/planning/insets.hpp"
#include "rounds.hpp"

namespace cfree {

// True if the closure of a cell has both poses; nothing if a shape is not rounded, or if cells would take too long.
std::optional<bool> joined_by_cells(const Rounds& rounds, const RationalPose& start, const RationalPose& goal);

class RoundCells {
public:
    // Nothing if cells of smaller shapes prove nothing, or would take too long.
    static std::unique_ptr<RoundCells> of(const Rounds& rounds);

    // A closed surface of contacts of the smaller shapes between two free poses, if there is one.
    std::optional<Separation> proof(const RationalPose& start, const RationalPose& goal) const;

    const NearShapes smaller;

private:
    RoundCells(NearShapes shapes, std::shared_ptr<KnownScene> known) : smaller(std::move(shapes)), scene(std::move(known)) {}
    const std::shared_ptr<KnownScene> scene;  // of the smaller shapes
};

}  // namespace cfree
