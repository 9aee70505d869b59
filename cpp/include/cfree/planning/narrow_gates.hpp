// Proofs by gates between obstacles that are narrower than the robot is at its widest place.
//
// Distances of convex pieces, in doubles, tell whether such gates part start and goal. If they do, the surfaces of a convex polygon
// inside the robot mostly are a proof: it has few vertices. Theory, "One surface alone".
#pragma once
#include "cfree/planning/insets.hpp"
#include "cfree/polygons/inscribed.hpp"

namespace cfree {

class NarrowGates {
public:
    NarrowGates(const KnownScene& scene, const Ratio& by);

    // True if gates that are too narrow for the inscribed polygon part two places of the robot, by doubles.
    bool part(const Place& start, const Place& goal) const;
    // Scene with the inscribed polygon as the robot, made at the first call; null if that has no fewer vertices.
    const std::shared_ptr<KnownScene>& inner();
    // Take what has been computed of the inscribed polygon in another scene and what holds in this one.
    void take(const NarrowGates& other);
    bool has_results() const { return smaller && smaller->has_results(); }

private:
    // Two pieces that are near each other: points of them, and those where they are nearest.
    struct Gate {
        Index first, second;
        std::array<Vec<double>, 4> way;
    };
    void find_gates(const KnownScene& scene);

    std::optional<Inscribed> within;
    Index pieces = 0;
    std::vector<Gate> gates;
    SceneShapes shapes;  // with the inscribed polygon; no robot if that has no fewer vertices
    std::shared_ptr<KnownScene> smaller;
};

}  // namespace cfree
