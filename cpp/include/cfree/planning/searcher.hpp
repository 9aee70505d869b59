// Searches and shorter paths between rational poses: grids, areas and units for what `search/` does in doubles.
#pragma once
#include <span>

#include "cfree/planning/boundary_walk.hpp"
#include "cfree/planning/known_scene.hpp"
#include "cfree/search/rrt_connect.hpp"
#include "cfree/search/shortcut.hpp"

namespace cfree {

using End = BoundaryWalker::End;

// Of positions to try, in the user's units: the bounds, else around the workspace, else with room around obstacles and poses.
Area search_area(const KnownScene& scene, std::span<const Place> poses, double radius);

class Searcher {
public:
    // Around some poses; costs in the user's units, a radian's weight the robot's radius.
    Searcher(std::shared_ptr<const KnownScene> scene, std::span<const Place> poses, const Costs& costs);

    RrtConnect search(const End& start, const End& goal, std::uint64_t seed = 0) const;
    Shortcut shortener(std::span<const End> way, std::uint64_t seed = 0) const;
    // A shortener of a path beside this one that keeps a distance from obstacles where there is room.
    Shortcut balanced(std::span<const End> way, std::uint64_t seed = 0) const;
    Poses poses(const Route& route) const;
    // What lengths of the user are multiplied by in the doubles of shapes.
    const double unit;

private:
    Grid grid(int place_bits, int angle_bits) const;
    Configuration configuration(const End& end) const;
    Route route(std::span<const End> way) const;

    const std::shared_ptr<const KnownScene> scene;
    const Costs costs;  // in the doubles of shapes
    const Area area;
    const int extent;  // its exponent
};

}  // namespace cfree
