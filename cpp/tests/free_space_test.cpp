#include "cfree/free/free_space.hpp"

#include <stdexcept>
#include <string>

#include "check.hpp"
#include "shapes.hpp"

using namespace cfree;

static ExactPose at(int x, int y) { return {x, y, 1, 0, 0, 1}; }

// Walls around a room in which a small robot can turn.
static void a_room_is_a_cell() {
    const std::vector<Ring> walls{{{-1, -1}, {10, -1}, {10, 0}, {-1, 0}},
                                  {{-1, 9}, {10, 9}, {10, 10}, {-1, 10}},
                                  {{-1, -1}, {0, -1}, {0, 10}, {-1, 10}},
                                  {{9, -1}, {10, -1}, {10, 10}, {9, 10}}};
    const auto cells = glue(compute_boundary(scene_of({{{0, 0}, {2, 0}, {0, 1}}}, walls)));
    const auto space = FreeSpace::of(*cells);
    CHECK(space->cells() == 2 && space->outside == 0);
    CHECK(space->locate(at(20, 0)) == 0 && space->locate(at(4, 4)) == 1 && space->locate(at(8, 8)) == -1);
    CHECK(turns_of(*cells).turns == std::vector<Index>({1, 1}) && space->depth == std::vector<Index>({0, 1}));
}

static std::string fault(const std::vector<std::vector<Index>>& sets, const std::vector<std::uint8_t>& free_inside) {
    PointLocation::Nesting n{{0}, {}, free_inside};
    for (const auto& set : sets) {
        n.around.insert(n.around.end(), set.begin(), set.end());
        n.start.push_back(static_cast<Index>(n.around.size()));
    }
    try {
        std::string found;
        for (const Index x : parents(n, false)) found += std::to_string(x) + " ";
        return found;
    } catch (const std::logic_error& error) {
        return error.what();
    }
}

static void nesting_that_cannot_be_is_an_error() {
    CHECK(fault({{}, {0}, {0, 1}}, {0, 1, 0}) == "-1 0 1 ");
    CHECK(fault({{}, {}, {0, 1}}, {0, 0, 1}) == "closed surface 2 is inside [0, 1], which are not inside each other");
    CHECK(fault({{}, {0}}, {0, 0}) == "closed surface 1 has the wrong side free for its place inside [0]");
    CHECK(fault({{}}, {1}) == "closed surface 0 has the wrong side free for its place inside []");
}

int main() {
    a_room_is_a_cell();
    nesting_that_cannot_be_is_an_error();
    return failures > 0;
}
