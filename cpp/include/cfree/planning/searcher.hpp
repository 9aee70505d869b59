// Searches and shorter paths between rational poses: grids, areas and units for the doubles of `search/`.
#pragma once
#include <span>

#include "cfree/planning/boundary_walk.hpp"
#include "cfree/planning/known_scene.hpp"
#include "cfree/search/rrt_connect.hpp"
#include "cfree/search/shortcut.hpp"

namespace cfree {

using End = BoundaryWalker::End;

// Area of positions to try, in the user's units: the bounds, else the box of the workspace, else a box around obstacles and
// poses with room.
Area search_area(const KnownScene& scene, std::span<const Place> poses, double radius);

class Searcher {
public:
    // Searcher around poses; costs are in the user's units, the weight of a radian is the robot's radius.
    // If there is a center, a point of the robot, paths turn no more than they need to.
    Searcher(std::shared_ptr<const KnownScene> scene, std::span<const Place> poses, const Costs& costs,
             const std::optional<Place>& center = {});

    RrtConnect search(const End& start, const End& goal, std::uint64_t seed = 0, const Growth& growth = {}) const;
    // The same in a box around both, larger by some room on each side.
    RrtConnect search_near(const End& start, const End& goal, double room) const;
    Shortcut shortener(std::span<const End> way, std::uint64_t seed = 0) const;
    // Shortener of a path beside this one that keeps a distance from obstacles if there is room, at most so many radii.
    Shortcut balanced(std::span<const End> way, std::uint64_t seed = 0, double radii = HUGE_VAL) const;
    Poses poses(const Route& route) const;
    // Factor from the user's lengths to the doubles of shapes.
    const double unit;

private:
    RrtConnect search_in(const Area& within, const End& start, const End& goal, std::uint64_t seed, const Growth& growth) const;
    Grid grid(int place_bits, int angle_bits) const;
    Configuration configuration(const End& end) const;
    Route route(std::span<const End> way) const;

    const std::shared_ptr<const KnownScene> scene;
    const Costs costs;  // per length in the doubles of shapes
    std::optional<Place> center;  // there
    const Area area;
    const int extent;  // exponent of the area's extent
};

}  // namespace cfree
