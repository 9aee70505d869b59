// Order the crossings of a ray, by exact signs of polynomials in tau.
#include <algorithm>

#include "cfree/free/point_location.hpp"
#include "free/lines.hpp"

namespace cfree {

std::vector<PointLocation::Crossing> PointLocation::in_order(const ExactPose& pose, const std::vector<Index>& crossed,
                                                             bool after) const {
    const Expansion expand{pose.chart};
    const auto sign = [&](const Poly& f) {
        return after ? leading(f, pose.p, pose.r).sign : value_at(f, pose.p, pose.r).sign();
    };
    struct Place {
        Poly x, run, down;  // x / down: place of the crossing, from the pose; run / down: its change with a rise of the ray
        int descends;       // the sign of down
        Index trapezoid;
    };
    std::vector<Place> places;
    for (const Index k : crossed) {
        const Line<Int> line(scene, surface_of(patches, trapezoids, k).contact, {pose.X, pose.Y}, pose.W);
        const Poly height = expand(line.height()), down = expand(line.down()), back = expand(line.back());
        places.push_back({difference(product(expand(line.distance()), down), product(height, back)), back, down, sign(down), k});
    }
    const auto compare = [&](const Poly& p, const Place& x, const Poly& q, const Place& y) {
        return sign(difference(product(p, y.down), product(q, x.down))) * x.descends * y.descends;
    };
    std::sort(places.begin(), places.end(), [&](const Place& x, const Place& y) {
        int order = compare(x.x, x, y.x, y);
        if (order == 0) order = compare(x.run, x, y.run, y);  // at one point: compare for a ray a little higher
        return order > 0;
    });
    std::vector<Crossing> result;
    for (const Place& x : places) result.push_back({x.trapezoid, x.descends > 0});
    return result;
}

}  // namespace cfree
