// Points and figures at arcs that face each other.
#include "scene/facing_arcs.hpp"

#include "check.hpp"

using namespace cfree;

namespace {

RatioPoint point(long x, long y, long d = 1) { return {reduced(x, d), reduced(y, d)}; }
Ratio cross(const RatioPoint& p, const RatioPoint& q, const RatioPoint& from) {
    return (p.x - from.x) * (q.y - from.y) - (p.y - from.y) * (q.x - from.x);
}
Ratio dot(const RatioPoint& p, const RatioPoint& q, const RatioPoint& from) {
    return (p.x - from.x) * (q.x - from.x) + (p.y - from.y) * (q.y - from.y);
}

// A concave quarter circle, with points beyond it by shares of its triangle's height.
Arc fillet(long radius, long share) {
    const auto beyond = [&](long d) { return point(radius * (2 * d + 1), radius * (2 * d + 1), 2 * d); };
    return {point(0, radius), point(radius, 0), point(0, 0), {radius, 1}, std::array{beyond(2 * share), beyond(share)}};
}

void probes_are_on_the_arc_and_near_each_other(const Arc& arc, const FacingArcs& facing) {
    std::vector<RatioPoint> all{arc.from};
    for (const RatioPoint& p : probes(arc, {0, 1}, facing)) all.push_back(p);
    all.push_back(arc.to);
    for (std::size_t k = 0; k + 1 < all.size(); ++k) {
        CHECK(dot(all[k], all[k], arc.centre) == arc.radius * arc.radius);
        const Ratio turn = cross(all[k], all[k + 1], arc.centre), along = dot(all[k], all[k + 1], arc.centre);
        const Ratio tangent = turn / (arc.radius * arc.radius + along);  // of half the angle
        CHECK(tangent.n.sign() > 0 && tangent <= facing.step);
    }
}

}  // namespace

int main() {
    const Arc quarter{point(4, 0), point(0, 4), point(0, 0), {4, 1}}, part{point(4, 3), point(0, 5), point(0, 0), {5, 1}};
    for (const long share : {1, 4, 64}) {
        const FacingArcs facing({{{0, 1}, {fillet(6, share)}}});
        CHECK(facing.hollows == std::vector<Ratio>({{6, 1}}) && facing.arcs.empty());
        for (const Arc& arc : {quarter, part}) {
            probes_are_on_the_arc_and_near_each_other(arc, facing);
            const Wedge figure = wedges(arc, {0, 1}, facing).at(0);
            CHECK(figure.corners[0] == arc.centre && cross(figure.corners[1], figure.corners[2], arc.centre).n.sign() > 0);
        }
        // a larger arc than the concave one needs neither
        const Arc large{point(8, 0), point(0, 8), point(0, 0), {8, 1}};
        CHECK(probes(large, {0, 1}, facing).empty() && wedges(large, {0, 1}, facing).empty());
    }
    // more probes where there is less room beyond the concave arc: an angle e has the tangent w / (2 + w), with w = 1 / share
    const FacingArcs wide({{{0, 1}, {fillet(6, 1)}}}), narrow({{{0, 1}, {fillet(6, 64)}}});
    CHECK(wide.step == reduced(3, 4) && narrow.step < reduced(1, 60));
    CHECK(probes(quarter, {0, 1}, wide).size() == 1 && probes(quarter, {0, 1}, narrow).size() > 50);
    // quadrangles: whole for discs that fit, smaller by the share of the radius for arcs, grown shapes included
    const FacingArcs some({{{1, 1}, {quarter}}});
    const auto figures = quadrangles(fillet(8, 4), {1, 1}, some);
    CHECK(figures.size() == 3 && !figures[0].is_for_arcs && !figures[1].is_for_arcs && figures[2].is_for_arcs);
    CHECK(figures[1].radius == reduced(1, 1) && figures[1].corners[1] == point(8, 0));
    CHECK(figures[2].radius == reduced(5, 1) && figures[2].corners[1] == point(2, 0) && figures[2].corners[3] == point(0, 2));
    return failures > 0;
}
