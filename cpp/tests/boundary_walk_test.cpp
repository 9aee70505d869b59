#include "cfree/planning/boundary_walk.hpp"

#include "check.hpp"
#include "shapes.hpp"

using namespace cfree;

static Ratio quotient(int n, int d) { return reduced(n, d); }

static void simple_fractions_are_between() {
    CHECK((simplest_between(quotient(33, 100), quotient(34, 100)) == Ratio{1, 3}));
    CHECK((simplest_between(quotient(-3, 1), quotient(-5, 2)) == Ratio{-3, 1}));
    CHECK((simplest_between(quotient(-1, 9), quotient(1, 9)) == Ratio{0, 1}));
    for (int a = 1; a < 40; ++a)
        for (int b = 1; b < 40; ++b) {  // none of a lesser denominator
            const Ratio low = quotient(a, b), high = low + quotient(1, 50), found = simplest_between(low, high);
            CHECK(low <= found && found <= high);
            for (Int d = 1; d < found.d; ++d) CHECK((low.n * d + low.d - 1) / low.d * high.d > high.n * d);
        }
}

// Two rooms with a door between them, which a bent path leads through, and a pillar in the second one.
struct Rooms {
    std::shared_ptr<const Scene> scene = scene_of({{{-10, -4}, {10, -4}, {10, 4}, {-10, 4}}}, {{{-5, -5}, {205, -5}, {205, 0}, {-5, 0}},
                                                                                    {{-5, 100}, {205, 100}, {205, 105}, {-5, 105}},
                                                                                    {{-5, -5}, {0, -5}, {0, 105}, {-5, 105}},
                                                                                    {{200, -5}, {205, -5}, {205, 105}, {200, 105}},
                                                                                    {{98, -5}, {102, -5}, {102, 70}, {98, 70}},
                                                                                    {{98, 81}, {102, 81}, {102, 105}, {98, 105}},
                                                                                    {{140, 40}, {160, 40}, {160, 60}, {140, 60}}});
    std::shared_ptr<const CellComplex> cells = glue(compute_boundary(scene));
    std::shared_ptr<const FreeSpace> space = FreeSpace::of(*cells);
    std::shared_ptr<const MotionChecker> checker = std::make_shared<const MotionChecker>(scene);
    BoundaryWalker walker{space, cells, checker, 11, std::make_shared<FoundSlides>()};
};

static BoundaryWalker::End end_of(const RationalPose& q) { return {q, q.place()}; }

static void walks_are_free_and_lead_to_their_goal() {
    const Rooms rooms;
    const RationalPose left{{20}, {20}, {}}, right{{180}, {20}, {1, 1}}, beyond{{500}, {20}, {}}, behind{{-100}, {0}, {0, 1}};
    for (const auto& [start, goal] : {std::pair{left, right}, {right, left}, {beyond, behind}}) {
        const Index cell = rooms.space->locate(start.exact(*rooms.scene));
        CHECK(cell >= 0 && cell == rooms.space->locate(goal.exact(*rooms.scene)));
        const Poses way = rooms.walker.walk(end_of(start), end_of(goal), cell);
        CHECK(way.front() == start && way.back() == goal && way.size() > 2);
        for (std::size_t k = 1; k < way.size(); ++k)
            CHECK(rooms.checker->is_free(
                motion_between(way[k - 1].configuration(*rooms.scene), way[k].configuration(*rooms.scene))));
    }
}

static void unknown_sides_are_not_crossed() {
    const Rooms rooms;
    const Index first = rooms.cells->first[0], twin = rooms.cells->twin[first];
    const auto ways = [&](std::shared_ptr<const CellComplex> cells) {
        const FaceGraph graph(cells, 11);
        const auto middle = [&](Index h) {
            std::vector<Place> sides;
            graph.middles(cells->face[h], sides);
            return Mark{cells->face[h], sides[static_cast<std::size_t>(h - cells->first[cells->face[h]])]};
        };
        const Mark start[] = {middle(first)}, goal[] = {middle(twin)};
        return graph.shortest(start[0].at, start, goal[0].at, goal, {});
    };
    CHECK(ways(rooms.cells).size() == 2);
    auto closed = std::make_shared<CellComplex>(*rooms.cells);
    std::fill(closed->twin.begin(), closed->twin.end(), -1);
    CHECK(ways(closed).empty());
}

int main() {
    simple_fractions_are_between();
    walks_are_free_and_lead_to_their_goal();
    unknown_sides_are_not_crossed();
    return failures > 0;
}
