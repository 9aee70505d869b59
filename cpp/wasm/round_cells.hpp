// Cells among rounded shapes, and proofs by smaller ones, as in src/cfree/planning/rounded_cells.py.
#pragma once
#include <map>
#include <memory>
#include <optional>

#include "cfree/planning/insets.hpp"
#include "rounds.hpp"

namespace cfree {

class RoundCells {
public:
    // Nothing if a shape is not rounded, or if cells would take too long.
    static std::unique_ptr<RoundCells> of(const Rounds& rounds);

    // True if the closure of a cell has both poses.
    bool are_joined(const RationalPose& start, const RationalPose& goal);
    // A closed surface of contacts of smaller shapes between the poses, with these shapes, if there is one.
    struct Proof {
        Separation separation;
        NearShapes smaller;
    };
    std::optional<Proof> proof(const RationalPose& start, const RationalPose& goal);

private:
    explicit RoundCells(NearShapes given) : near(std::move(given)) {}
    struct Known {
        NearShapes near;
        std::shared_ptr<KnownScene> scene;
    };
    // Shapes whose radii are smaller by a part, with their cells; 0: as they are.
    const Known& smaller_by(const Ratio& part);

    const NearShapes near;
    std::map<Ratio, Known> known;
};

}  // namespace cfree
