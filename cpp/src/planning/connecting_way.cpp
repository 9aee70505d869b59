// Stretches on surfaces, joined by straight ways; theory, "One surface alone".
#include "cfree/planning/connecting_way.hpp"

#include <algorithm>

namespace cfree {

namespace {

RationalPose rational(const ExactPose& q, const Scene& scene) {
    const Int unit = q.W * scene.scale;
    return {reduced(q.X, unit), reduced(q.Y, unit), HalfAngle::of(q.chart, reduced(q.p, q.r))};
}

// A surface, or a part of it, as the boundary of one cell.
std::shared_ptr<const FreeSpace> cell_of(const CellComplex& surface) {
    std::vector<Index> one(surface.component.size(), 0);
    return std::make_shared<const FreeSpace>(surface.boundary, Surfaces{one, {-1}, {1}, {0}, one});
}

}  // namespace

Way connecting_way(const Surroundings& around, const Connection& joined, double angle_scale, const Slides& slides) {
    const Scene& scene = *around.scene;
    const RationalPose first = rational(joined.near_start, scene), last = rational(joined.near_goal, scene);
    Way way{joined.start, first};
    const auto far_away = [&] {
        RationalPose left = way.back();
        left.x = rational({around.far_left(), 0, 1, 0, 0, 1}, scene).x;
        way.push_back(left);
        left.half = last.half;
        way.push_back(left);
        left.y = last.y;
        way.push_back(left);
    };
    for (std::size_t k = 0; k <= joined.stretches.size(); ++k) {
        if (joined.is_far && k == joined.before) far_away();
        if (k == joined.stretches.size()) break;
        const auto& [surface, enter, leave] = joined.stretches[k];
        const auto space = cell_of(*surface);
        const BoundaryWalker walker(space, surface, around.checker, angle_scale);
        const RationalPose from = rational(enter, scene), to = rational(leave, scene);
        const Way along = walker.walk({from, from.place()}, {to, to.place()}, space->cell_of[0], slides);
        way.insert(way.end(), along.begin(), along.end());
    }
    way.insert(way.end(), {last, joined.goal});
    way.erase(std::unique(way.begin(), way.end()), way.end());
    return way;
}

}  // namespace cfree
