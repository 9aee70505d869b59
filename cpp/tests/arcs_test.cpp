#include "cfree/arcs/motion_checker.hpp"

#include "check.hpp"

using namespace cfree;

namespace {

using Ring = std::vector<RoundEdge>;

Ring polyline(const std::vector<std::pair<long, long>>& points) {
    Ring ring;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const auto &p = points[k], &q = points[(k + 1) % points.size()];
        ring.push_back({{p.first, p.second}, {q.first, q.second}, {0, 0}, 0});
    }
    return ring;
}

// Quarters from a point of the circle.
Ring circle(long x, long y, long dx, long dy = 0) {
    Ring ring;
    Vec<Int> d{dx, dy};
    for (int k = 0; k < 4; ++k) {
        const Vec<Int> e{-d.y, d.x};
        ring.push_back({{x + d.x, y + d.y}, {x + e.x, y + e.y}, {x, y}, 1});
        d = e;
    }
    return ring;
}

ArcShape shape(std::vector<Ring> rings, long radius = 0, long scale = 1, bool is_outside = false) {
    return arc_shape(std::move(rings), radius, scale, is_outside);
}

std::shared_ptr<const ArcScene> scene(std::vector<ArcShape> robot, std::vector<ArcShape> obstacles) {
    auto made = std::make_shared<ArcScene>();
    made->robot = std::move(robot), made->obstacles = std::move(obstacles);
    return made;
}

GivenPose pose(const Ratio& x, const Ratio& y, long q = 1, long p = 0) { return {x, y, q, p, 2 * std::atan2(p, q)}; }
const Ratio tiny{1, Int(1) << 300};

Motion translation(long x, long y, long dx, long dy, long unit = 1) { return {1, 0, 1, x, y, unit, false, dx, dy, 1, 1, 0}; }
Motion turn(long x, long y, long px, long py, long q, long p) { return {1, 0, 1, x, y, 1, true, px, py, 1, q, p}; }

void a_disc_on_a_floor_is_free_and_deeper_is_not() {
    const ArcPoseChecker checker(scene({shape({circle(0, 0, 3, 4)})}, {shape({polyline({{-90, -9}, {90, -9}, {90, 0}, {-90, 0}})})}));
    for (const long p : {0L, 1L, 7L}) {
        CHECK(checker.is_free(pose({2, 1}, {5, 1}, 3, p)));
        CHECK(!checker.is_free(pose({2, 1}, Ratio{5, 1} - tiny, 3, p)));
    }
    CHECK(!checker.is_free(pose({2, 1}, {-4, 1})) && checker.is_free(pose({2, 1}, {-14, 1})));
    CHECK(checker.look(2, 6, 1) == Verdict::free && checker.look(2, 5, 1) == Verdict::uncertain && checker.look(2, 4, 1) == Verdict::forbidden);
    const DistanceBounds far = checker.distance(pose({2, 1}, {7, 1}), 1e300), at = checker.distance(pose({2, 1}, {5, 1}), 1e300);
    CHECK(far.low <= 2 && 2 <= far.high && far.high - far.low < 1e-6 && at.low == 0 && at.high < 1e-6);
}

// Radii sqrt(2) and sqrt(8): the centers are sqrt(18) apart in contact.
void discs_of_irrational_radii_touch() {
    const ArcPoseChecker checker(scene({shape({circle(0, 0, 1, 1)})}, {shape({circle(0, 0, 2, 2)})}));
    CHECK(checker.is_free(pose({3, 1}, {3, 1})) && !checker.is_free(pose({3, 1}, Ratio{3, 1} - tiny)));
    CHECK(checker.is_free(pose({3, 1}, {-3, 1}, 5, 2)) && !checker.is_free(pose({0, 1}, {0, 1})));
}

void a_disc_in_a_hole_of_its_radius_may_turn_and_not_move() {
    Ring hole = circle(1, 2, 3, 4);
    const auto s = scene({shape({circle(0, 0, 5)})}, {shape({circle(1, 2, 9), hole})});
    const ArcPoseChecker poses(s);
    CHECK(poses.is_free(pose({1, 1}, {2, 1}, 2, 1)) && !poses.is_free(pose(Ratio{1, 1} + tiny, {2, 1})));
    const ArcMotionChecker motions(s);
    CHECK(motions.is_free(turn(1, 2, 1, 2, 0, 1)) && !motions.is_free(turn(1, 2, 2, 2, 1000, 1)));
    CHECK(!motions.is_free(translation(1, 2, 20, 0)) && motions.is_free(translation(15, 2, 20, 0)));
}

// The same shape twice: boundaries coincide all around.
void equal_shapes_overlap_and_complements_fit() {
    const Ring moon{{{0, -4}, {4, 0}, {0, 0}, 1}, {{4, 0}, {0, 4}, {0, 0}, 1}, {{0, 4}, {0, -4}, {-3, 0}, -1}};
    const ArcPoseChecker same(scene({shape({moon})}, {shape({moon})})), within(scene({shape({moon})}, {shape({moon}, 0, 1, true)}));
    CHECK(!same.is_free(pose({0, 1}, {0, 1})) && within.is_free(pose({0, 1}, {0, 1})));
    CHECK(!within.is_free(pose(tiny, {0, 1})) && !within.is_free(pose({0, 1}, {0, 1}, 1000000, 1)) && !within.is_free(pose({900, 1}, {0, 1})));
}

// A stadium in a corridor as wide as it is.
void a_stadium_passes_a_corridor_of_its_width() {
    const Ring stadium{{{-4, -2}, {4, -2}, {0, 0}, 0}, {{4, -2}, {6, 0}, {4, 0}, 1}, {{6, 0}, {4, 2}, {4, 0}, 1},
                       {{4, 2}, {-4, 2}, {0, 0}, 0}, {{-4, 2}, {-6, 0}, {-4, 0}, 1}, {{-6, 0}, {-4, -2}, {-4, 0}, 1}};
    const std::vector<ArcShape> walls{shape({polyline({{-9, 2}, {9, 2}, {9, 5}, {-9, 5}})}), shape({polyline({{-9, -5}, {9, -5}, {9, -2}, {-9, -2}})})};
    const auto s = scene({shape({stadium})}, walls);
    const ArcMotionChecker motions(s);
    CHECK(motions.is_free(translation(-40, 0, 80, 0)));
    const auto stopped = motions.first_collision(translation(-40, 0, 80, 1));
    CHECK((stopped && stopped->low > Ratio{1, 8} && stopped->high < Ratio{1, 2} && stopped->obstacle == 0));
    // the same as a segment grown, and a corridor grown
    const Ring thin = polyline({{-4, -1}, {4, -1}, {4, 1}, {-4, 1}});
    const ArcMotionChecker grown(scene({shape({thin}, 1)}, walls));
    CHECK(grown.is_free(translation(-40, 0, 80, 0)) && !grown.is_free(translation(-40, 0, 80, 1)));
    const auto at = grown.first_collision(translation(0, 9, 0, -9));
    CHECK((at && at->low <= Ratio{2, 9} && Ratio{2, 9} <= at->high && at->obstacle == 0));
    CHECK(!grown.first_collision(translation(0, 9, 0, -2)));
    const auto onto = grown.first_collision(translation(0, 9, 0, -4));
    CHECK((onto && onto->low <= Ratio{1, 2} && Ratio{1, 2} <= onto->high && onto->obstacle == 0));
}

// A disc of radius 1 falls beside the origin onto one of radius 2: contact where x^2 + y^2 = 9, at x = 1: y = sqrt(8).
void a_contact_is_in_a_narrow_interval() {
    const auto s = scene({shape({circle(0, 0, 1)})}, {shape({circle(0, 0, 2)})});
    const ArcMotionChecker motions(s);
    const auto found = motions.first_collision(translation(1, 10, 0, -10));
    CHECK((found && found->high - found->low <= Ratio{1, Int(1) << 60}));
    const double u = found ? nearest(found->low.n, found->low.d) : 0;
    CHECK(std::abs(10 - 10 * u - std::sqrt(8.0)) < 1e-14);
    CHECK(motions.is_free(translation(3, 10, 0, -20)) && !motions.is_free(translation(2999, 10000, 0, -20000, 1000)));
    const auto [low, high] = motions.clearance(translation(5, 10, 0, -20), 1e-6);
    CHECK(low <= 2 && 2 <= high && high - low < 1e-5);
}

void shapes_of_all_sizes_meet_in_one_scene() {
    const Int large = Int(1) << 120;
    auto made = std::make_shared<ArcScene>();
    Ring small = circle(0, 0, 1), huge = circle(0, 0, 1);
    for (RoundEdge& k : huge)
        for (auto* p : {&k.start, &k.end}) p->x *= large, p->y *= large;
    made->robot.push_back(arc_shape({small}, 0, Int(1) << 60, false));   // of radius 2^-60
    made->obstacles.push_back(arc_shape({huge}, 0, Int(1) << 60, false));  // of radius 2^60
    const ArcPoseChecker checker(made);
    const Ratio touching = Ratio{Int(1) << 60, 1} + Ratio{1, Int(1) << 60};
    CHECK(checker.is_free(pose(touching, {0, 1})) && !checker.is_free(pose(touching - tiny, {0, 1})));
}

}  // namespace

int main() {
    a_disc_on_a_floor_is_free_and_deeper_is_not();
    discs_of_irrational_radii_touch();
    a_disc_in_a_hole_of_its_radius_may_turn_and_not_move();
    equal_shapes_overlap_and_complements_fit();
    a_stadium_passes_a_corridor_of_its_width();
    a_contact_is_in_a_narrow_interval();
    shapes_of_all_sizes_meet_in_one_scene();
    return failures != 0;
}
