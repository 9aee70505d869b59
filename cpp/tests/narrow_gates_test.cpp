#include "cfree/planning/narrow_gates.hpp"

#include "check.hpp"

using namespace cfree;

static std::shared_ptr<const Polygon> polygon(const std::vector<std::vector<std::pair<int, int>>>& rings, int d = 1) {
    std::vector<RatioRing> all;
    for (const auto& ring : rings) {
        all.emplace_back();
        for (const auto& [x, y] : ring) all.back().push_back({reduced(x, d), reduced(y, d)});
    }
    return std::make_shared<const Polygon>(std::move(all));
}

static std::shared_ptr<const Polygon> box(int x0, int y0, int x1, int y1, int d = 1) {
    return polygon({{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}, d);
}

static const Ratio by = power_of_two(-18);

static void an_inscribed_polygon_is_inside_and_as_wide() {
    // a plank with cut corners, one with a notch, a frame with a hole, and a triangle
    const auto plank = polygon({{{0, 1}, {1, 0}, {39, 0}, {40, 1}, {40, 9}, {39, 10}, {1, 10}, {0, 9}}});
    const auto notched = polygon({{{0, 0}, {30, 0}, {30, 10}, {20, 10}, {20, 5}, {12, 5}, {12, 10}, {0, 10}}});
    const auto framed = polygon({{{0, 0}, {30, 0}, {30, 30}, {0, 30}}, {{12, 4}, {4, 4}, {4, 26}, {12, 26}}});
    const auto triangle = polygon({{{0, 0}, {8, 0}, {0, 6}}});
    const struct {
        std::shared_ptr<const Polygon> shape;
        double width;
        Index most_vertices;
    } cases[] = {{plank, 10, 4}, {notched, 10, 4}, {framed, 18, 4}, {triangle, 4.8, 3}};
    for (const auto& [shape, width, most] : cases) {
        const auto found = inscribed({shape}, by);
        CHECK(found && found->polygon->is_convex() && is_inside(*found->polygon, *shape));
        CHECK(found->polygon->vertices.size() <= most);
        CHECK(std::abs(found->width - width) < 1e-3 * width);
    }
    // the widest of some, and none where there is no room
    CHECK(std::abs(inscribed({triangle, plank}, by)->width - 10) < 1e-2);
    CHECK(!inscribed({box(0, 0, 1, 1)}, Ratio{1}));
    CHECK(!inscribed({}, by));
}

static void far_away_and_thin_shapes_do_no_harm() {
    const auto far = std::make_shared<const Polygon>(
        std::vector<RatioRing>{{{Ratio{Int(1) << 60}, {0}}, {Ratio{(Int(1) << 60) + 4}, {0}}, {Ratio{(Int(1) << 60) + 4}, {1}}, {Ratio{Int(1) << 60}, {1}}}});
    CHECK(inscribed({far}, by) && is_inside(*inscribed({far}, by)->polygon, *far));
    const auto thin = std::make_shared<const Polygon>(std::vector<RatioRing>{{{{0}, {0}}, {{1}, {0}}, {{1}, power_of_two(-80)}}});
    CHECK(!inscribed({thin}, by));
}

static SceneShapes rooms_of_dust() {
    SceneShapes shapes;
    shapes.robot = {box(0, 0, 40, 40)};
    for (int x = 0; x < 40; ++x)
        for (int y = 0; y < 40; ++y) shapes.obstacles.push_back(box(2 * x, 2 * y, 2 * x + 1, 2 * y + 1));
    return shapes;
}

static void of_many_vertices_few_are_left() {
    std::vector<std::pair<int, int>> ring;  // two half circles of 500 vertices, and straight sides
    for (int k = 0; k < 1000; ++k) {
        const double angle = (k + 0.5) * 3.14159265358979 / 500;
        ring.push_back({static_cast<int>(1e6 * std::cos(angle)) + (k < 250 || k >= 750 ? 4'000'000 : 0), static_cast<int>(1e6 * std::sin(angle))});
    }
    const auto stadium = polygon({ring});
    const auto found = inscribed({stadium}, power_of_two(-2));
    CHECK(found && is_inside(*found->polygon, *stadium) && found->polygon->vertices.size() <= 64);
    CHECK(found->width > 1.99e6);
}

static void a_robot_far_larger_than_what_is_around_it_is_left_alone() {
    SceneShapes shapes = rooms_of_dust();
    const auto scene = KnownScene::of(shapes);
    CHECK(!NarrowGates(*scene, by).part({-9, -9, 0}, {50, 50, 0}));
}

// Two rooms, with a wall between them that has a gate of height `high` sixteenths; bounds or a workspace around.
static SceneShapes rooms(int high, bool has_bounds) {
    SceneShapes shapes;
    shapes.robot = {polygon({{{-32, -8}, {32, -8}, {32, 8}, {8, 8}, {8, 0}, {-8, 0}, {-8, 8}, {-32, 8}}}, 16)};
    shapes.obstacles = {box(144, -64, 176, 64, 16), box(144, 64 + high, 176, 160, 16)};
    if (has_bounds) shapes.bounds = std::array{Ratio{0}, Ratio{0}, Ratio{20}, Ratio{8}};
    else shapes.workspace = box(0, 0, 20, 8);
    return shapes;
}

static void gates_part_places_if_they_are_narrower() {
    const Place left{3, 3, 0.5}, right{17, 5, 2}, other{4, 6, 1};
    for (const bool has_bounds : {false, true})
        for (const int high : {15, 16, 17}) {
            const auto scene = KnownScene::of(rooms(high, has_bounds));
            NarrowGates gates(*scene, by);
            CHECK(gates.part(left, right) == (high == 15) && gates.part(right, left) == (high == 15));
            CHECK(!gates.part(left, other));
            CHECK(gates.inner() && gates.inner()->shapes().robot.front()->is_convex());
        }
}

static void a_wall_that_ends_in_free_space_parts_nothing() {
    SceneShapes shapes = rooms(15, true);
    shapes.bounds = {};
    const auto scene = KnownScene::of(shapes);
    CHECK(!NarrowGates(*scene, by).part({3, 3, 0.5}, {17, 5, 2}));
}

int main() {
    an_inscribed_polygon_is_inside_and_as_wide();
    far_away_and_thin_shapes_do_no_harm();
    of_many_vertices_few_are_left();
    a_robot_far_larger_than_what_is_around_it_is_left_alone();
    gates_part_places_if_they_are_narrower();
    a_wall_that_ends_in_free_space_parts_nothing();
    return failures > 0;
}
