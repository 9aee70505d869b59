// Directions of rings; theory, "Segments and arcs".
#include "cfree/arcs/shape.hpp"

#include <algorithm>

#include "arcs/overlap.hpp"
#include "cfree/exact/surd.hpp"

namespace cfree {

RoundEdge reversed(const RoundEdge& curve) { return {curve.end, curve.start, curve.center, -curve.turn}; }

namespace {

constexpr int finest = 4000;

// The winding number of a simple ring about the points inside it: looked up at points nearer and nearer to the middle of each
// curve, until one is inside. 0 if none is.
int direction_of(const std::vector<RoundEdge>& ring) {
    ArcShape shape;
    shape.ring = {0, static_cast<Index>(ring.size())};
    const PlacedShape placed(shape, ring, shift_for(ring, {}));
    for (unsigned k = 1; k < finest; k += 1 + k / 4)
        for (const RoundEdge& curve : ring) {
            const HomogeneousPoint m = point_at(curve, last_parameter(curve) * Ratio{1, 2});
            // towards the center, or across the segment
            const Vec<Int> d = curve.turn == 0 ? Vec<Int>{(curve.start.y - curve.end.y) * m.w, (curve.end.x - curve.start.x) * m.w}
                                               : Vec<Int>{curve.center.x * m.w - m.x, curve.center.y * m.w - m.y};
            for (const int side : {1, -1}) {
                const HomogeneousPoint spot{(m.x << k) + side * d.x, (m.y << k) + side * d.y, m.w << k};
                if (const auto turns = turns_about(placed, 0, shape.ring[1], spot); turns && *turns != 0) return *turns > 0 ? 1 : -1;
            }
        }
    return 0;
}

}  // namespace

ArcShape arc_shape(std::vector<std::vector<RoundEdge>> rings, Int radius, Int scale, bool is_outside) {
    ArcShape shape;
    shape.radius = std::move(radius), shape.scale = std::move(scale), shape.is_outside = is_outside;
    shape.ring = {0};
    for (std::size_t k = 0; k < rings.size(); ++k) {
        auto& ring = rings[k];
        const int wanted = (k == 0) != is_outside ? 1 : -1;
        const int direction = direction_of(ring);
        if (direction == 0) {  // there and back: a shape without inside, or a hole without
            if (k == 0) break;
            continue;
        }
        if (direction != wanted) {
            std::reverse(ring.begin(), ring.end());
            std::transform(ring.begin(), ring.end(), ring.begin(), reversed);
        }
        shape.curves.insert(shape.curves.end(), ring.begin(), ring.end());
        shape.ring.push_back(static_cast<Index>(shape.curves.size()));
    }
    return shape;
}

}  // namespace cfree
