// Boundaries of grown shapes: patches of circles, their owners, the order of all critical angles, and curves that pair by name.
#include <map>

#include "cfree/forbidden/boundary.hpp"
#include "forbidden/round_names.hpp"
#include "rounded.hpp"

// At orientations between critical angles each curve is the lower side of one trapezoid and the upper side of another, by name.
static int check_pairs(const Boundary& b) {
    const Scene& s = b.scene->near();
    const AngleTable& angles = b.angles();
    int alone = 0;
    for (Index rank = 0; rank < angles.last; ++rank) {
        std::map<CurveName, std::array<int, 2>> sides;
        for (Index k = 0; k < static_cast<Index>(b.trapezoids.size()); ++k) {
            if (!(angles.from[k] <= rank && rank < angles.to[k])) continue;
            const Feature on = b.patches.contact(b.trapezoids.patch[k]);
            ++sides[curve_name(s, on, unpacked(b.trapezoids.lower[k]))][0], ++sides[curve_name(s, on, unpacked(b.trapezoids.upper[k]))][1];
        }
        for (const auto& [name, times] : sides) alone += times[0] != 1 || times[1] != 1;
    }
    return alone;
}

static void angles_have_one_order_on_all_surfaces() {
    int trapezoids = 0, ranks = 0, alone = 0;
    for (unsigned seed = 0; seed < 4; ++seed) {
        random_numbers.seed(seed);
        const SceneFeatures made = random_scene(seed % 2 == 0);
        const SharedBoundary b = compute_boundary(made.scene);
        CHECK(b->is_complete() && b->isolated.parts.size() == 0);
        const AngleTable& angles = b->angles();
        for (Index k = 0; k < static_cast<Index>(b->trapezoids.size()); ++k) CHECK(angles.from[k] < angles.to[k]);
        trapezoids += static_cast<int>(b->trapezoids.size()), ranks += angles.last;
        const int found = check_pairs(*b);
        if (found) std::printf("seed %u: %d names without a pair\n", seed, found);
        alone += found;
    }
    std::printf("%d trapezoids, %d angles, %d names without a pair\n", trapezoids, ranks, alone);
    CHECK(alone == 0);
}

// Four trapezoids around a square hole share corners and sides: each piece of boundary has one owner.
static void shared_circles_have_one_owner() {
    const long a = 36, b = 60;
    const std::vector<std::vector<std::pair<long, long>>> frame{{{-b, -b}, {b, -b}, {a, -a}, {-a, -a}}, {{b, -b}, {b, b}, {a, a}, {a, -a}},
                                                               {{b, b}, {-b, b}, {-a, a}, {a, a}}, {{-b, b}, {-b, -b}, {-a, -a}, {-a, a}}};
    for (const long w : {20L}) {
        std::vector<Polygon> obstacles;
        for (const auto& points : frame) obstacles.push_back(polygon(points));
        const SceneFeatures made = scene_of(polygon({{-w, -12}, {w, -12}, {w, 12}, {-w, 12}}), {6, 1}, std::move(obstacles), {{0, 1}, {0, 1}, {0, 1}, {0, 1}});
        const int found = check_pairs(*compute_boundary(made.scene));
        if (found) std::printf("frame, %ld: %d names without a pair\n", w, found);
        CHECK(found == 0);
    }
}

int main() {
    angles_have_one_order_on_all_surfaces();
    shared_circles_have_one_owner();
    return failures > 0;
}
