#include "cfree/planning/passages.hpp"

#include <algorithm>
#include <set>

#include "cfree/planning/clusters.hpp"
#include "check.hpp"
#include "shapes.hpp"

using namespace cfree;

// A square, and a slot between two rooms, as wide as it but for `more`.
struct Slot {
    explicit Slot(long more)
        : scene(scene_of({{{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}}, {{{20, -90}, {60, -90}, {60, -10}, {20, -10}},
                                                                         {{20, 10 + more}, {60, 10 + more}, {60, 90}, {20, 90}},
                                                                         {{-99, -99}, {99, -99}, {99, -90}, {-99, -90}},
                                                                         {{-99, 90}, {99, 90}, {99, 99}, {-99, 99}},
                                                                         {{-99, -99}, {-90, -99}, {-90, 99}, {-99, 99}},
                                                                         {{90, -99}, {99, -99}, {99, 99}, {90, 99}}})) {}
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const CellComplex> cells = glue(compute_boundary(scene));
    std::shared_ptr<const FreeSpace> space = FreeSpace::of(*cells);
    std::shared_ptr<const MotionChecker> checker = std::make_shared<const MotionChecker>(scene);
    std::shared_ptr<FoundSlides> slides = std::make_shared<FoundSlides>();
    Passages passages{std::make_shared<const BoundaryWalker>(space, cells, checker, 15, slides), nullptr};
};

static const RationalPose left{{-60}, {5}, {3, 1}}, within{{40}, {0}, {}}, right{{75}, {-7}, {1, 1}};

static void a_way_leads_through_an_exact_fit() {
    Slot slot(0);
    for (const auto& [start, goal] : {std::pair{left, right}, {right, left}, {within, right}}) {
        const auto way = slot.passages.path(start, goal, false);
        CHECK(way && way->front() == start && way->back() == goal);
        for (std::size_t k = 1; way && k < way->size(); ++k)
            CHECK(slot.checker->is_free(
                motion_between((*way)[k - 1].configuration(*slot.scene), (*way)[k].configuration(*slot.scene))));
    }
    Slot closed(-1);
    CHECK(!closed.passages.path(left, right, false) && !closed.passages.path(left, right, true));
}

static void places_are_held_by_what_meets_there() {
    const Slot slot(0);  // is an isolated segment; its ends are on the boundary of the rooms before and behind it
    const MeetingPlaces& places = slot.passages.places;
    const auto has = [](const std::vector<Holder>& holders, Holder::Of what) {
        return std::any_of(holders.begin(), holders.end(), [&](const Holder& x) { return x.of == what; });
    };
    const auto candidates = places.candidates();
    CHECK(std::any_of(candidates.begin(), candidates.end(), [&](const RationalPose& pose) {
        const auto of = places.holders(pose);
        return has(of, Holder::Of::part) && has(of, Holder::Of::cell);
    }));
    const auto of = places.holders(within);
    CHECK(of.size() == 1 && of[0].of == Holder::Of::part);
}

// A ladder 5 long: its foot slides on a floor, y = 0, and its head on a wall, x = 0.
static void slides_keep_two_contacts() {
    const auto scene = scene_of({{{0, 0}, {0, -5}, {1, 0}}}, {{{0, -1}, {6, -1}, {6, 0}, {0, 0}}, {{-1, 0}, {0, 0}, {0, 6}, {-1, 6}}});
    const Feature foot{Kind::vertex_edge, 1, 2}, head{Kind::vertex_edge, 0, 5};
    const auto slide = slide_along(*scene, {{0}, {5}, {}}, foot, head, {1, 2});
    CHECK(slide && slide->to == (RationalPose{{0}, {3}, {2, 1}}));
    CHECK(slide && MotionChecker(scene).is_free(slide->motion(*scene)));
    CHECK(!slide_along(*scene, {{0}, {5}, {}}, foot, head, {-1, 2}));  // the foot leaves its edge
    CHECK(!slide_along(*scene, {{0}, {4}, {}}, foot, head, {1, 2}));   // the lines meet elsewhere
    CHECK(!slide_along(*scene, {{0}, {5}, {}}, foot, foot, {1, 2}));
}

static void points_that_are_not_told_apart_are_one_cluster() {
    const auto found = clusters({{0, 1, 0, 0}, {5, 1, 0, 0}, {1e-12, 1, 0, 0}, {0, 2, 0, 0}, {1e-12, 1, 0, 1}}, 1e-9);
    CHECK(std::set(found.begin(), found.end()) == std::set<std::vector<Index>>({{0, 2}, {1}, {3}, {4}}));
}

int main() {
    a_way_leads_through_an_exact_fit();
    places_are_held_by_what_meets_there();
    slides_keep_two_contacts();
    points_that_are_not_told_apart_are_one_cluster();
    return failures > 0;
}
