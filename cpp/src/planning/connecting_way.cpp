// Join stretches on surfaces by straight ways; theory, "One surface alone".
#include "cfree/planning/connecting_way.hpp"

#include <algorithm>

namespace cfree {

namespace {

// A surface, or a part of it, as the boundary of one cell.
std::shared_ptr<const FreeSpace> cell_of(const CellComplex& surface) {
    std::vector<Index> one(surface.component.size(), 0);
    return std::make_shared<const FreeSpace>(surface.boundary, Surfaces{one, {-1}, {1}});
}

}  // namespace

Poses connecting_way(const Surroundings& around, const Connection& joined, double angle_scale,
                     const std::shared_ptr<FoundSlides>& slides) {
    const Scene& scene = *around.scene;
    const auto first = RationalPose::of(joined.near_start, scene), last = RationalPose::of(joined.near_goal, scene);
    Poses way{joined.start, first};
    const auto go_far = [&] {
        RationalPose left = way.back();
        left.x = reduced(around.far_left(), scene.scale);
        way.push_back(left);
        left.half = last.half;
        way.push_back(left);
        left.y = last.y;
        way.push_back(left);
    };
    for (std::size_t k = 0; k <= joined.stretches.size(); ++k) {
        if (joined.is_far && k == joined.before) go_far();
        if (k == joined.stretches.size()) break;
        const auto& [surface, enter, leave] = joined.stretches[k];
        const auto space = cell_of(*surface);
        const BoundaryWalker walker(space, surface, around.checker, angle_scale, slides);
        const auto from = RationalPose::of(enter, scene), to = RationalPose::of(leave, scene);
        const Poses along = walker.walk({from, from.place()}, {to, to.place()}, space->cell_of[0]);
        way.insert(way.end(), along.begin(), along.end());
    }
    way.insert(way.end(), {last, joined.goal});
    way.erase(std::unique(way.begin(), way.end()), way.end());
    return way;
}

}  // namespace cfree
