#include "cfree/scene/coordinate_range.hpp"
#include "cfree/scene/features.hpp"
#include "check.hpp"

using namespace cfree;

static std::shared_ptr<const Polygon> polygon(const std::vector<std::pair<const char*, const char*>>& numbers) {
    RatioRing ring;
    for (const auto& [x, y] : numbers) ring.push_back({ratio_of(x).value(), ratio_of(y).value()});
    return std::make_shared<Polygon>(std::vector<RatioRing>{ring});
}
static std::shared_ptr<const Polygon> box(const char* x0, const char* y0, const char* x1, const char* y1) {
    return polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

static void equal_features_share_an_identity() {
    //  3---2 7---6   edges 2 and 6 lie on one line; 0 and 4 on another
    //  0---1 4---5
    const auto f = scene_features({{box("0", "0", "1", "1")}, {box("0", "0", "2", "2"), box("3", "0", "5", "2")}, {}, {}});
    const Shape& s = f.scene->obstacles;
    CHECK(s.line[2] == s.line[6] && s.line[0] == s.line[4] && s.line[0] != s.line[2]);
    CHECK(s.direction[0] == s.direction[2] && s.direction[0] != s.direction[1]);
    CHECK(f.scene->scale == 1 && !f.rim && s.ring_vertices == 8 && s.pieces() == 2);
}

static void coincident_features_are_ranked_by_geometry() {
    const auto f = scene_features({{box("0", "0", "1", "1")}, {box("0", "0", "2", "2"), box("2", "2", "3", "3")}, {}, {}});
    const Shape& s = f.scene->obstacles;
    CHECK(s.point[2] == s.point[4] && s.vertex_rank[2] != s.vertex_rank[4]);
}

static void coordinates_have_one_denominator() {
    const auto f = scene_features({{polygon({{"1/3", "0"}, {"1", "0"}, {"0", "1/7"}})}, {box("0.1", "0", "1", "1")}, {}, {}});
    CHECK(f.scene->scale == 210 && f.scene->robot.X[0] == 70 && f.scene->obstacles.X[0] == 21);
    CHECK(f.scene->obstacles.xy[0] == 0.1);
}

static void bounds_and_workspace_have_a_rim() {
    SceneShapes shapes{{box("0", "0", "1", "1")}, {box("2", "2", "3", "3")}, box("0", "0", "9", "9"), {}};
    shapes.bounds = {ratio_of("0").value(), ratio_of("0").value(), ratio_of("8").value(), ratio_of("8").value()};
    const auto f = scene_features(shapes);
    CHECK(f.rim && (*f.rim)[0] < 0 && (*f.rim)[2] > 9);
    CHECK(f.robot.polygon.back() == bounds_owner && f.obstacles.polygon[4] == workspace_owner);
    CHECK(f.obstacles.vertex[4] == -1);  // the frame's rim
    const Shape& s = f.scene->obstacles;
    // the frame has the workspace as a hole: the same vertices, turned around
    CHECK(s.X[8] == 0 && s.Y[8] == 0 && f.obstacles.vertex[8] == 0 && f.obstacles.vertex[9] == 3);
    CHECK(s.X[9] == 0 && s.Y[9] == 9 && s.emit[8] && !s.emit[4]);
}

static void far_shapes_are_measured_from_near() {
    const auto f = scene_features({{box("0", "0", "1", "1")}, {box("1e9", "-1e9", "1000000001", "-999999999.5")}, {}, {}});
    CHECK(f.scene->frame[0] == 1000000000.5 && f.scene->frame[2] == 0);
    CHECK(f.scene->near().obstacles.X[0] == -1 && f.scene->near().obstacles.X[1] == 1);
    CHECK(floor_divide(-7, 2) == -4 && floor_divide(7, 2) == 3 && floor_divide(-8, 2) == -4);
}

static void denominators_of_a_quarter_of_the_vertices_are_those_of_doubles_also_in_parts() {
    const auto decimals = polygon({{"1/10", "0"}, {"1", "0"}, {"0", "1"}}), third = polygon({{"1/3", "0"}, {"1", "0"}, {"0", "1"}});
    const auto square = box("0", "0", "1", "1");
    WholeScene whole;
    std::vector<std::shared_ptr<const Polygon>> all;
    const auto add = [&](const auto& shape) { all.push_back(shape), whole.add(*shape); };
    const auto short_part = [&](const auto& robot) {
        const auto scene = scene_features({{robot}, all, {}, {}}).scene;
        WholeScene given;
        given.short_part = whole.shared.short_part();
        CHECK(scene_features({{robot}, {all.front()}, {}, {}}, given).scene->short_part == scene->short_part);
        return scene->short_part;
    };
    for (int k = 0; k < 9; ++k) add(square);
    for (int k = 0; k < 4; ++k) {
        CHECK(short_part(square) == 1 && short_part(third) == 3);
        add(decimals);
    }
    CHECK(short_part(square) == 15625 && short_part(third) == 3 * 15625);
    for (int k = 0; k < 20; ++k) add(third);
    CHECK(short_part(square) == 3);
}

static void doubles_of_a_short_denominator_are_those_without_the_turned_shape() {
    const auto plain = box("0.1", "0", "2", "3"), turned = polygon({{"0", "0"}, {"1/1000003", "5"}, {"-7", "1/9999991"}});
    const auto both = scene_features({{box("0", "0", "1", "1")}, {plain, turned}, {}, {}}).scene;
    CHECK(both->short_part == 15625);  // decimals count by six digits
    const auto other = with_short_doubles(*both);
    const auto alone = with_short_doubles(*scene_features({{box("0", "0", "1", "1")}, {plain}, {}, {}}).scene);
    CHECK(other && alone);
    int exponent;
    const double factor = other->obstacles.x[1] / alone->obstacles.x[1];
    CHECK(std::frexp(factor, &exponent) == 0.5);
    for (Index v = 0; v < 4; ++v) {
        CHECK(other->obstacles.x[v] == alone->obstacles.x[v] * factor && other->obstacles.y[v] == alone->obstacles.y[v] * factor);
        CHECK(other->obstacles.rounded[v] == 0 && both->obstacles.X[v] == other->obstacles.X[v]);
    }
    CHECK(other->obstacles.rounded[4] == 0 && other->obstacles.rounded[5] == 2 && other->obstacles.rounded[6] == 2);
    const double third = other->obstacles.x[5], rest = other->obstacles.x_low[5];
    const Int error = Int(third * 0x1p200) * 1000003 + Int(rest * 0x1p200) * 1000003 - (Int(15625) << (200 + static_cast<unsigned>(lsb(both->scale))));
    CHECK(abs(error) < (Int(1) << 110));
    CHECK(!with_short_doubles(*scene_features({{box("0", "0", "1", "1")}, {box("1/3", "0", "1", "1")}, {}, {}}).scene));
}

static void what_is_out_of_range_is_named() {
    const auto fault = range_fault({{box("0", "0", "1", "1")}, {polygon({{"0", "0"}, {"1e151", "0"}, {"0", "1"}})}, {}, {}});
    CHECK(fault && fault->kind == "obstacles" && fault->index == 0);
    CHECK(fault && fault->message == "the coordinate 1e151 is larger than 1e150; scale the scene");
    CHECK(!range_fault({{box("0", "0", "1", "1")}, {box("1e-140", "0", "1", "1e140")}, {}, {}}));
    CHECK(range_fault({{box("0", "0", "1", "1")}, {box("1e-190", "0", "1", "1e150")}, {}, {}}));
}

int main() {
    equal_features_share_an_identity();
    coincident_features_are_ranked_by_geometry();
    coordinates_have_one_denominator();
    bounds_and_workspace_have_a_rim();
    far_shapes_are_measured_from_near();
    denominators_of_a_quarter_of_the_vertices_are_those_of_doubles_also_in_parts();
    doubles_of_a_short_denominator_are_those_without_the_turned_shape();
    what_is_out_of_range_is_named();
    return failures > 0;
}
