#include "cfree/planning/planner.hpp"

#include "check.hpp"

using namespace cfree;

static std::shared_ptr<const Polygon> polygon(std::initializer_list<std::pair<Ratio, Ratio>> points) {
    RatioRing ring;
    for (const auto& [x, y] : points) ring.push_back({x, y});
    return std::make_shared<const Polygon>(std::vector<RatioRing>{ring});
}

static std::shared_ptr<const Polygon> box(const Ratio& x0, const Ratio& y0, const Ratio& x1, const Ratio& y1) {
    return polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

// A plank 1 wide and 4 long, and two rooms with a corridor 2 high between them, bent around a block; `high` is left of it.
static SceneShapes rooms(const Ratio& high) {
    SceneShapes shapes;
    shapes.robot = {box({-2}, {-1, 2}, {2}, {1, 2})};
    shapes.workspace = box({0}, {0}, {30}, {10});
    shapes.obstacles = {box({10}, {0}, {20}, {5}), box({10}, Ratio{5} + high, {20}, {10})};
    return shapes;
}

static End end_at(long x, long y, const HalfAngle& half) {
    const RationalPose pose{{x}, {y}, half};
    return {pose, pose.place()};
}
static const End left = end_at(3, 3, {1, 1}), right = end_at(27, 3, {1, 1}), on_block = end_at(15, 2, {});

static bool is_free_way(const Planner& planner, const Poses& way, const End& start, const End& goal) {
    if (way.empty() || way.front() != start.pose || way.back() != goal.pose) return false;
    return FreeMotions(planner.scene->scene(), *planner.scene->checker, *planner.slides).join(way);
}

static void a_way_is_free_and_the_way_back_the_same() {
    for (const Ratio& high : {Ratio{2}, Ratio{1025, 1024}, Ratio{1}}) {
        Planner there(KnownScene::of(rooms(high)), 2.1), again(KnownScene::of(rooms(high)), 2.1);
        const auto way = there.plan(left, right, {}), back = again.plan(right, left, {});
        CHECK(std::holds_alternative<Poses>(way) && std::holds_alternative<Poses>(back));
        CHECK(is_free_way(there, std::get<Poses>(way), left, right));
        CHECK(is_free_way(again, std::get<Poses>(back), right, left));
        CHECK(reversed(std::get<Poses>(way)) == std::get<Poses>(back));
    }
}

static void where_it_is_too_narrow_there_is_a_proof() {
    for (const Ratio& high : {Ratio{1, 2}, Ratio{1023, 1024}, Ratio{1} - power_of_two(-150)}) {
        Planner planner(KnownScene::of(rooms(high)), 2.1);
        const auto answer = planner.plan(left, right, {});
        CHECK(std::holds_alternative<Separation>(answer));
        const auto& proof = std::get<Separation>(answer);
        CHECK(proof.is_closed && !proof.surface.faces.empty());
        CHECK(proof.of != planner.scene);  // a smaller robot's
    }
}

static void the_answer_is_the_same_once_everything_is_built() {
    for (const Ratio& high : {Ratio{2}, Ratio{1, 2}}) {
        Planner planner(KnownScene::of(rooms(high)), 2.1);
        const bool first = std::holds_alternative<Poses>(planner.plan(left, right, {}));
        planner.scene->build({});
        const auto later = planner.plan(left, right, {});
        CHECK(std::holds_alternative<Poses>(later) == first);
        CHECK(planner.walk(left, right, {}).has_value() == first);
    }
}

static void forbidden_ends_are_refused() {
    Planner planner(KnownScene::of(rooms({2})), 2.1);
    CHECK(std::get<Planner::Refused>(planner.plan(on_block, right, {})) == Planner::Refused::start);
    CHECK(std::get<Planner::Refused>(planner.plan(left, on_block, {})) == Planner::Refused::goal);
}

int main() {
    a_way_is_free_and_the_way_back_the_same();
    where_it_is_too_narrow_there_is_a_proof();
    the_answer_is_the_same_once_everything_is_built();
    forbidden_ends_are_refused();
    return failures > 0;
}
