// Radii as data of features: classes of points and offset lines, lengths of edges, and cores that are points or segments.
#include <array>

#include "cfree/scene/coordinate_range.hpp"
#include "cfree/scene/features.hpp"
#include "cfree/scene/lengths.hpp"
#include "check.hpp"

using namespace cfree;
using Shapes = std::vector<std::shared_ptr<const Polygon>>;

static Ratio number(const char* text) { return ratio_of(text).value(); }
static RatioRing ring_of(const std::vector<std::pair<Ratio, Ratio>>& numbers) {
    RatioRing ring;
    for (const auto& [x, y] : numbers) ring.push_back({x, y});
    return ring;
}
static std::shared_ptr<const Polygon> polygon(const std::vector<std::pair<Ratio, Ratio>>& numbers) {
    return std::make_shared<Polygon>(std::vector<RatioRing>{ring_of(numbers)});
}
static std::shared_ptr<const Polygon> thin(const std::vector<std::pair<Ratio, Ratio>>& numbers) {
    return std::make_shared<Polygon>(Polygon::thin(ring_of(numbers)));
}
static std::shared_ptr<const Polygon> box(const Ratio& x0, const Ratio& y0, const Ratio& x1, const Ratio& y1) {
    return polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}
static std::shared_ptr<const Polygon> unit_box() { return box({0, 1}, {0, 1}, {1, 1}, {1, 1}); }

// Square with a side from (x, y) along (a, b), its interior on the left.
static std::shared_ptr<const Polygon> square(const Ratio& x, const Ratio& y, const Ratio& a, const Ratio& b) {
    return polygon({{x, y}, {x + a, y + b}, {x + a - b, y + b + a}, {x - b, y + a}});
}

static SceneFeatures features(Shapes robot, Shapes obstacles, const Ratio& robot_radius, std::vector<Ratio> radii) {
    SceneShapes shapes{std::move(robot), std::move(obstacles), {}, {}};
    shapes.robot_rounding.assign(shapes.robot.size(), {robot_radius, {}});
    for (const Ratio& radius : radii) shapes.obstacle_rounding.push_back({radius, {}});
    CHECK(!range_fault(shapes));
    return scene_features(shapes);
}

// The offset of one edge's line minus that of the other, both moved outwards, times their lengths; found without `lengths`.
static int order_of_lines(const Shape& s, Index e, Index f) {
    const auto term = [&](Index k) {
        const auto E = edge<Int>(s, k);
        return std::pair{RootSum(cross(Vec<Int>{s.X[s.v[k]], s.Y[s.v[k]]}, E)), RootSum::root(dot(E, E))};
    };
    const auto [h, m] = term(e);
    const auto [k, n] = term(f);
    const RootSum r(s.radii[s.vertex_radius[s.v[e]]].exact), t(s.radii[s.vertex_radius[s.v[f]]].exact);
    return (h * n - k * m + (r - t) * m * n).sign();
}

// Equal features, and no others, have one number; numbers are in order of appearance.
static void check_classes(const Shape& s) {
    const auto in_order = [](const std::vector<Index>& numbers) {
        Index next = 0;
        for (const Index n : numbers) {
            if (n > next) return false;
            next += n == next;
        }
        return true;
    };
    CHECK(in_order(s.point) && in_order(s.line) && in_order(s.direction));
    for (Index e = 0; e < static_cast<Index>(s.v.size()); ++e) {
        CHECK(s.vertex_radius[s.v[e]] == s.vertex_radius[s.w[e]]);
        for (Index f = 0; f < e; ++f) {
            if (!s.has_extent(e) || !s.has_extent(f)) continue;
            const auto E = edge<Int>(s, e), F = edge<Int>(s, f);
            const bool is_parallel = cross(E, F).is_zero();
            CHECK(is_parallel == (s.direction[e] == s.direction[f]));
            CHECK((is_parallel && dot(E, F).sign() > 0 && order_of_lines(s, e, f) == 0) == (s.line[e] == s.line[f]));
        }
    }
    for (Index p = 0; p < static_cast<Index>(s.X.size()); ++p)
        for (Index q = 0; q < p; ++q) {
            const bool is_one_place = s.X[p] == s.X[q] && s.Y[p] == s.Y[q];
            CHECK((is_one_place && s.vertex_radius[p] == s.vertex_radius[q]) == (s.point[p] == s.point[q]));
        }
}

// True if an exact number of the scene's integers is within a ball, and the ball is small.
static bool holds(const Ball& ball, const RootSum& exact, int shift) {
    const auto is_within = [&](const Ratio& low, const Ratio& high) {
        const auto against = [&](const Ratio& x) {
            return (exact * RootSum(x.d) - RootSum(x.n << static_cast<unsigned>(shift))).sign();
        };
        return against(low) >= 0 && against(high) <= 0;
    };
    const Ratio middle = ratio_of(ball.hi) + ratio_of(ball.lo), error = ratio_of(ball.radius);
    return is_within(middle - error, middle + error) && ball.radius <= std::abs(ball.hi) * 0x1p-103 &&
           is_within(ratio_of(ball.hi * (1 - 0x1p-52)), ratio_of(ball.hi * (1 + 0x1p-52)));
}

// Doubles and balls of all radii and lengths are those of the exact numbers; rational lengths are whole.
static void check_numbers(const Scene& scene) {
    for (const Shape* s : {&scene.robot, &scene.obstacles}) {
        CHECK(s->radii[0].exact == 0 && s->lengths.size() == s->v.size());
        for (Index c = 0; c < static_cast<Index>(s->radii.size()); ++c) {
            CHECK(c == 0 || s->radii[c - 1].exact < s->radii[c].exact);
            CHECK(holds(radius<Ball>(*s, c), radius<RootSum>(*s, c), scene.shift));
            CHECK(radius<Approx>(*s, c).v == radius<Ball>(*s, c).hi && radius<RootSum>(*s, c).sign() == (c > 0));
        }
        for (Index e = 0; e < static_cast<Index>(s->v.size()); ++e) {
            const auto E = edge<Int>(*s, e);
            const Int squared = dot(E, E), root = root_below(squared);
            CHECK((length<RootSum>(*s, e) - RootSum::root(squared)).sign() == 0);
            CHECK(s->lengths[e].is_rational() == (root * root == squared));
            CHECK(!s->lengths[e].is_rational() || length<Int>(*s, e) == root);
            CHECK(holds(length<Ball>(*s, e), length<RootSum>(*s, e), scene.shift));
            CHECK(length<Approx>(*s, e).v == length<Ball>(*s, e).hi);
            for (Index f = 0; f < e; ++f)
                CHECK(s->direction[e] != s->direction[f] || s->lengths[e].radicand == s->lengths[f].radicand || !s->has_extent(f));
        }
    }
    for (Index r = 0; r < static_cast<Index>(scene.robot.radii.size()); ++r)
        for (Index t = 0; t < static_cast<Index>(scene.obstacles.radii.size()); ++t) {
            CHECK(rho<Int>(scene, r, t) == scene.robot.radii[r].exact + scene.obstacles.radii[t].exact);
            CHECK((rho<Int>(scene, r, t) == 0) == (r == 0 && t == 0));
            CHECK(holds(rho<Ball>(scene, r, t), rho<RootSum>(scene, r, t), scene.shift));
        }
}

static void check(const SceneFeatures& f) {
    CHECK(f.scene->is_round && f.scene->near().is_round);
    for (const Scene* scene : {f.scene.get(), &f.scene->near()}) {
        check_classes(scene->robot), check_classes(scene->obstacles);
        check_numbers(*scene);
    }
}

static bool same_features(const Shape& a, const Shape& b) {
    return a.point == b.point && a.v == b.v && a.w == b.w && a.line == b.line && a.direction == b.direction &&
           a.ring_vertices == b.ring_vertices && a.previous == b.previous && a.convex == b.convex && a.emit == b.emit &&
           a.layer == b.layer && a.vertex_rank == b.vertex_rank && a.edge_rank == b.edge_rank && a.piece == b.piece &&
           a.piece_vertex == b.piece_vertex && a.piece_edge == b.piece_edge && a.piece_layer == b.piece_layer;
}
static bool same_numbers(const Shape& a, const Shape& b) {
    return a.X == b.X && a.Y == b.Y && a.x == b.x && a.y == b.y && a.x_low == b.x_low && a.y_low == b.y_low && a.xy == b.xy &&
           a.rounded == b.rounded;
}

static SceneShapes polygons_of_all_kinds() {
    const auto ring = [](std::vector<std::pair<const char*, const char*>> numbers) {
        RatioRing result;
        for (const auto& [x, y] : numbers) result.push_back({number(x), number(y)});
        return result;
    };
    const auto l_shape = std::make_shared<Polygon>(
        std::vector<RatioRing>{ring({{"0", "0"}, {"2", "0"}, {"2", "1"}, {"1", "1"}, {"1", "2"}, {"0", "2"}})});
    const auto holed = std::make_shared<Polygon>(std::vector<RatioRing>{ring({{"3", "0"}, {"6", "0"}, {"6", "3"}, {"3", "3"}}),
                                                             ring({{"4", "1"}, {"4", "2"}, {"5", "2"}, {"5", "1"}})});
    const auto slanted = square(number("2"), number("1"), number("1"), number("2"));
    return {{l_shape, unit_box()},
            {holed, l_shape, slanted, unit_box()},
            box(number("-9"), number("-9"), number("9"), number("8.5")),
            std::array{number("-8"), number("-8"), number("8"), number("0")}};
}

static void radii_of_zero_change_nothing() {
    SceneShapes shapes = polygons_of_all_kinds();
    const auto plain = scene_features(shapes);
    shapes.obstacle_rounding.assign(shapes.obstacles.size(), {});
    const auto zero = scene_features(shapes);
    CHECK(!plain.scene->is_round && !zero.scene->is_round && plain.rim == zero.rim && plain.scene->scale == zero.scene->scale);
    for (const Scene* scene : {plain.scene.get(), zero.scene.get()})
        for (const Shape* s : {&scene->robot, &scene->obstacles})
            CHECK(s->radii.empty() && s->lengths.empty() && s->vertex_radius.empty() && !s->has_arcs());
    const Shape &A = plain.scene->robot, &B = zero.scene->robot, &O = plain.scene->obstacles, &P = zero.scene->obstacles;
    CHECK(same_features(A, B) && same_numbers(A, B) && same_features(O, P) && same_numbers(O, P));
}

static void one_radius_of_all_changes_no_class() {
    SceneShapes shapes = polygons_of_all_kinds();
    const auto plain = scene_features(shapes);
    shapes.robot_rounding.assign(shapes.robot.size(), {number("1/4"), {}});
    const auto grown = scene_features(shapes);
    check(grown);
    CHECK(same_features(plain.scene->obstacles, grown.scene->obstacles));  // all of radius 0
    shapes.workspace = {}, shapes.bounds = {}, shapes.robot_rounding = {};
    const auto open = scene_features(shapes);
    shapes.obstacle_rounding.assign(shapes.obstacles.size(), {number("1/4"), {}});
    const auto grown_obstacles = scene_features(shapes);
    check(grown_obstacles);
    CHECK(same_features(open.scene->obstacles, grown_obstacles.scene->obstacles));
    CHECK(same_features(open.scene->robot, grown_obstacles.scene->robot));
}

static void a_wall_with_and_one_without_radius_share_an_offset_line() {
    // y = 0 with 1/5 is y = 1/5 with 0
    const auto left = box(number("-5/2"), number("-1"), number("-1/2"), number("0"));
    const auto right = box(number("1/2"), number("-1"), number("5/2"), number("1/5"));
    const auto f = features({box(number("-1/2"), number("-1/2"), number("1/2"), number("1/2"))}, {left, right}, number("1/10"),
                            {number("1/5"), number("0")});
    check(f);
    const Shape& s = f.scene->obstacles;
    for (Index e = 0; e < 4; ++e)
        for (Index g = 4; g < 8; ++g) CHECK((s.line[e] == s.line[g]) == (e == 2 && g == 6));  // nor do the bottoms share one
    CHECK(s.edge_rank[2] != s.edge_rank[6] && s.edge_rank[2] + s.edge_rank[6] == 1);
    CHECK(Representatives(*f.scene).edge(false, 6) == Representatives(*f.scene).edge(false, 2));
    // the same two the other way round: geometry decides the owner
    const auto g = features({unit_box()}, {right, left}, number("1/10"), {number("0"), number("1/5")});
    CHECK(g.scene->obstacles.edge_rank[6] == s.edge_rank[2] && g.scene->obstacles.edge_rank[2] == s.edge_rank[6]);
    // moved by 2^-60 they are two
    const auto h = features({unit_box()}, {left, right}, number("0"), {number("1/5") + power_of_two(-60), number("0")});
    check(h);
    CHECK(h.scene->obstacles.line[2] != h.scene->obstacles.line[6]);
}

static void slanted_walls_of_rational_length_share_offset_lines() {
    // one side along (4, 3), outward normal (3, -4) / 5; the other square starts s further out, and farther along
    const Ratio s = number("2/7"), along = number("3"), place = number("1000000000");
    for (const Ratio& at : {number("0"), place, -place})
        for (const Ratio& more : {number("0"), power_of_two(-60), -power_of_two(-60)}) {
            const Ratio h = s + more;
            const auto one = square(at, at, number("4"), number("3"));
            const Ratio x = at + number("3/5") * h + number("4") * along, y = at - number("4/5") * h + number("3") * along;
            const auto other = square(x, y, number("8"), number("6"));
            const auto f = features({unit_box()}, {one, other}, number("0"), {s, number("0")});
            check(f);
            const Shape& O = f.scene->obstacles;
            CHECK((O.line[0] == O.line[4]) == more.n.is_zero());
            CHECK(length<Int>(O, 0) == 5 * f.scene->scale && length<Int>(O, 4) == 10 * f.scene->scale);
        }
}

static void slanted_walls_of_irrational_length_share_one_only_with_one_radius() {
    const Ratio s = number("1/5"), at = number("1000000000");
    const auto one = square(at, at, number("1"), number("2"));
    const auto further = [&](const Ratio& out) {  // outward normal (2, -1) / sqrt(5)
        return square(at + number("4") + number("2") * out, at + number("8") - out, number("3"), number("6"));
    };
    const auto are_one = [&](const Ratio& out, const Ratio& radius, const Ratio& other) {
        const auto f = features({unit_box()}, {one, further(out)}, number("0"), {radius, other});
        check(f);
        return f.scene->obstacles.line[0] == f.scene->obstacles.line[4];
    };
    CHECK(are_one(number("0"), s, s));
    CHECK(!are_one(number("0"), s, number("0")));
    CHECK(!are_one(power_of_two(-60), s, s));
    // s / sqrt(5) within 2^-60, from either side: no doubles tell them apart
    const Int root = root_below((Int(1) << 160) / 125);
    for (const int more : {0, 1}) CHECK(!are_one(reduced(root + more, Int(1) << 80), s, number("0")));
}

static void tiny_and_huge_radii_are_exact() {
    const Ratio tiny = power_of_two(-60), huge = power_of_two(60), third = number("1/3");
    const auto f = features({box(number("-1"), number("-1"), number("1"), number("1"))},
                            {unit_box(), unit_box(), thin({{number("5"), number("7")}}), unit_box(), unit_box()}, third,
                            {tiny, huge, huge, number("0"), third});
    check(f);
    const Shape& s = f.scene->obstacles;
    CHECK(s.radii.size() == 4 && s.radii[1].exact == 3 && s.radii[3].exact == (Int(3) << 120));
    CHECK(f.scene->shift > 0 && s.vertex_radius[0] == 1 && s.vertex_radius[4] == 3 && s.vertex_radius[9] == 0);
    const auto small = features({unit_box()}, {unit_box()}, number("1e-150"), {number("1e-150")});
    check(small);
    const auto large = features({unit_box()}, {unit_box()}, number("1e150"), {number("1e-150")});
    check(large);
    // doubles stay below the largest that the core multiplies
    CHECK(radius<Approx>(s, 3).v <= 0x1p100 && radius<Approx>(large.scene->robot, 1).v <= 0x1p100);
    CHECK(radius<Approx>(large.scene->near().robot, 1).v <= 0x1p100);
}

static void far_cores_are_measured_from_near() {
    const Ratio far = number("1000000000");
    const auto point = thin({{far, -far}}), segment = thin({{far + number("1"), -far}, {far + number("2"), -far}});
    const auto f = features({unit_box()}, {point, segment}, number("1/4"), {number("1/8"), number("1/2")});
    check(f);
    CHECK(f.scene->moved && f.scene->near().obstacles.radii[1].exact == f.scene->scale / 8);
    CHECK(same_features(f.scene->obstacles, f.scene->near().obstacles));
    CHECK(f.scene->near().obstacles.vertex_radius == f.scene->obstacles.vertex_radius);
}

static void points_and_segments_are_cores() {
    const auto point = thin({{number("1/2"), number("1/3")}});
    const auto segment = thin({{number("0"), number("0")}, {number("3"), number("4")}});
    CHECK(point->is_thin() && point->denominator == 6 && point->vertices.X(0) == 3 && point->is_convex() && !unit_box()->is_thin());
    CHECK((point->pieces() == Pieces{{0}} && segment->pieces() == Pieces{{0, 1}}));
    const auto f = features({point, segment}, {segment, point, point, point}, number("1/5"),
                            {number("1/4"), number("1/4"), number("1/4"), number("1/3")});
    check(f);
    const Shape& s = f.scene->obstacles;
    CHECK((s.ring_vertices == 5 && s.v == std::vector<Index>{0, 1, 2, 3, 4} && s.w == std::vector<Index>{1, 0, 2, 3, 4}));
    CHECK((s.previous == std::vector<Index>{1, 0, 2, 3, 4} && s.convex == std::vector<char>{1, 1, 1, 1, 1}));
    CHECK((s.piece == std::vector<Index>{0, 2, 3, 4, 5} && s.piece_vertex == std::vector<Index>{0, 1, 2, 3, 4}));
    CHECK((s.piece_edge == std::vector<Index>{0, 1, 2, 3, 4} && s.has_extent(0) && s.has_extent(1) && !s.has_extent(2)));
    CHECK(s.direction[0] == s.direction[1] && s.line[0] != s.line[1]);  // there and back
    CHECK(s.point[2] == s.point[3] && s.vertex_rank[2] != s.vertex_rank[3] && s.point[2] != s.point[4]);
    CHECK(length<Int>(s, 1) == 5 * f.scene->scale && length<Int>(s, 2) == 0);
    CHECK(f.scene->robot.vertex_radius == (std::vector<Index>{1, 1, 1}));
    const auto refused = [](auto make) {
        try {
            make();
        } catch (const InvalidPolygon&) {
            return true;
        }
        return false;
    };
    const RatioPoint p{number("1"), number("2")}, q{number("2"), number("2")}, r{number("3"), number("3")};
    for (const RatioRing& ring : {RatioRing{}, RatioRing{p, p}, RatioRing{p, q, r}}) CHECK(refused([&] { Polygon::thin(ring); }));
    for (const RatioRing& ring : {RatioRing{p}, RatioRing{p, q}}) CHECK(refused([&] { Polygon{std::vector<RatioRing>{ring}}; }));
}

static void workspace_and_bounds_have_no_radius_and_reach_past_the_robots() {
    SceneShapes shapes{{thin({{number("0"), number("0")}})},
                       {thin({{number("9"), number("4")}})},
                       box(number("0"), number("0"), number("9"), number("9")),
                       std::array{number("1"), number("1"), number("8"), number("8")},
                       {{number("5"), {}}},
                       {{number("7"), {}}}};
    CHECK(!range_fault(shapes));
    const auto f = scene_features(shapes);
    check(f);
    const Shape &A = f.scene->robot, &O = f.scene->obstacles;
    CHECK((A.radii.size() == 2 && A.vertex_radius == std::vector<Index>{1, 0} && A.point[0] != A.point[1]));  // the reference point
    CHECK((A.layer == std::vector<Index>{body_layer, reference_layer}));
    CHECK(O.vertex_radius[0] == 1);
    for (Index v = 1; v < static_cast<Index>(O.vertex_radius.size()); ++v) CHECK(O.vertex_radius[v] == 0);
    // the frame is around the grown obstacle and thicker than the robot, the rim around all that touches
    CHECK(O.X[2] >= 9 + 7 + 10 && O.X[1] <= -10);
    CHECK((*f.rim)[2] >= 9 + 7 + 5 && (*f.rim)[1] <= 4 - 7 - 5);
    shapes.workspace = {};
    const auto open = scene_features(shapes);
    CHECK((*open.rim)[2] >= 9 + 7 + 5 && (*open.rim)[3] >= 4 + 7 + 5);
}

static void the_whole_of_parts_has_radii() {
    WholeScene whole;
    whole.add(*unit_box());
    CHECK(!whole.is_round && whole.box && (*whole.box)[2] == 1);
    whole.add(*thin({{number("5"), number("1/2")}}), {number("1/3"), {}});
    CHECK(whole.is_round && whole.scale == 6 && (*whole.box)[2] == 32 && (*whole.box)[0] == 0 && (*whole.box)[1] == 0);
    const auto part = scene_features({{unit_box()}, {unit_box()}, {}, {}}, whole);  // of polygons alone
    check(part);
    CHECK(part.scene->scale == 6 && part.scene->obstacles.radii.size() == 1);
}

static void wrong_radii_are_named() {
    const auto fault = [](SceneShapes shapes) {
        const auto wrong = range_fault(shapes);
        return wrong ? wrong->kind + " " + std::to_string(wrong->index) + ": " + wrong->message : "";
    };
    const auto point = thin({{number("0"), number("0")}});
    CHECK(fault({{unit_box()}, {unit_box()}, {}, {}, {{number("-1/4"), {}}}}) == "robot 0: the radius -1/4 is below 0; give 0 or more");
    CHECK(fault({{unit_box()}, {unit_box(), unit_box()}, {}, {}, {}, {{number("0"), {}}, {number("-2"), {}}}}) ==
          "obstacles 1: the radius -2 is below 0; give 0 or more");
    CHECK(fault({{unit_box()}, {unit_box()}, {}, {}, {}, {{number("0"), {}}, {number("2"), {}}}}) ==
          "obstacles -1: 2 radii for 1 polygons; give one for each, or none");
    const std::string thin_one = ": a point or a segment has no interior; give it a radius above 0";
    CHECK(fault({{unit_box(), point}, {unit_box()}, {}, {}}) == "robot 1" + thin_one);
    CHECK(fault({{unit_box()}, {point}, {}, {}, {{number("1"), {}}}, {{number("0"), {}}}}) == "obstacles 0" + thin_one);
    CHECK(fault({{unit_box()}, {point}, {}, {}, {{number("1"), {}}}}) == "obstacles 0" + thin_one);
    CHECK(fault({{unit_box()}, {point}, {}, {}, {}, {{number("1"), {}}}}) == "");
    CHECK(fault({{point}, {unit_box()}, {}, {}, {{number("1"), {}}}}) == "");
    CHECK(fault({{unit_box()}, {unit_box()}, {}, {}, {{number("1e151"), {}}}}) ==
          "robot 0: the radius 1e151 is larger than 1e150; scale the scene");
    const std::string fine = fault({{unit_box()}, {unit_box()}, {}, {}, {}, {{number("1e-400"), {}}}});
    CHECK(fine.starts_with("obstacles 0: with the denominator 1e400 of its radius, the scene's coordinates, over one"));
}

int main() {
    radii_of_zero_change_nothing();
    one_radius_of_all_changes_no_class();
    a_wall_with_and_one_without_radius_share_an_offset_line();
    slanted_walls_of_rational_length_share_offset_lines();
    slanted_walls_of_irrational_length_share_one_only_with_one_radius();
    tiny_and_huge_radii_are_exact();
    far_cores_are_measured_from_near();
    points_and_segments_are_cores();
    workspace_and_bounds_have_no_radius_and_reach_past_the_robots();
    the_whole_of_parts_has_radii();
    wrong_radii_are_named();
    return failures > 0;
}
