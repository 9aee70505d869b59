#include "cfree/forbidden/boundary.hpp"
#include "cfree/forbidden/cell_complex.hpp"

#include "check.hpp"
#include "forbidden/kept_faces.hpp"
#include "shapes.hpp"

using namespace cfree;

static Poly poly(std::initializer_list<Int> coefficients) { return Poly(coefficients); }
static Dyadic dyadic(double x) { return Dyadic::from(x); }

static void real_roots_are_compared_exactly() {
    RealRoot root2{poly({-2, 0, 1}), dyadic(1), dyadic(2)}, same{poly({-4, 0, 0, 0, 1}), dyadic(1), dyadic(1.5)};
    CHECK(compare(root2, same) == 0);  // x^2 - 2 and x^4 - 4
    RealRoot close{poly({-Int("2000000000000000000000000000001"), 0, Int("1000000000000000000000000000000")}), dyadic(1), dyadic(2)};
    CHECK(compare(root2, close) < 0 && compare(close, root2) > 0);
    CHECK(sign_at(poly({-2, 0, 1}), root2) == 0);
    CHECK(sign_at(poly({-7, 5}), root2) > 0 && sign_at(poly({-3, 2}), root2) < 0);  // 7/5 < root 2 < 3/2
    const Poly squared = product(poly({-2, 0, 1}), poly({-2, 0, 1}));
    CHECK(sign_after(squared, root2) > 0 && sign_before(squared, root2) > 0);
    CHECK(sign_after(poly({-2, 0, 1}), root2) > 0 && sign_before(poly({-2, 0, 1}), root2) < 0);
}

static CellComplex complex_of(const std::vector<Ring>& robot, const std::vector<Ring>& obstacles) {
    return *glue(compute_boundary(scene_of(robot, obstacles)));
}

static int euler(const CellComplex& c) {
    return c.vertices - static_cast<int>(c.twin.size() / 2) + static_cast<int>(c.component.size());
}

static void boundaries_are_closed() {
    const CellComplex torus = complex_of({{{0, 0}, {2, 0}, {0, 1}}}, {{{5, 5}, {8, 5}, {6, 7}}});
    CHECK(torus.components == 1 && euler(torus) == 0);
    for (std::size_t h = 0; h < torus.twin.size(); ++h) CHECK(torus.twin[torus.twin[h]] == static_cast<Index>(h));
    // squares side by side, sharing corners and edges, with a square robot
    const Ring unit{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    std::vector<Ring> grid;
    for (long x = 0; x < 3; ++x)
        for (long y = 0; y < 3; ++y)
            if ((x + y) % 2 == 0) {
                grid.push_back(unit);
                for (auto& p : grid.back()) p.first += x, p.second += y;
            }
    const CellComplex touching = complex_of({unit}, grid);
    CHECK(euler(touching) % 2 == 0);
}

static void faces_of_another_scene_are_taken_as_they_are() {
    const Ring robot{{0, 0}, {2, 0}, {0, 1}}, box{{0, 0}, {3, 0}, {3, 3}, {0, 3}};
    const auto moved = [&](long x, long y) {
        Ring ring = box;
        for (auto& [a, b] : ring) a += x, b += y;
        return ring;
    };
    const auto old = compute_boundary(scene_of({robot}, {box, moved(4, 0), moved(20, 0), moved(40, 0)}));
    const auto before = glue(old);
    for (const auto& rings : {std::vector{box, moved(4, 1), moved(20, 0), moved(40, 0)}, std::vector{moved(40, 0), moved(20, 0), box, box}}) {
        const auto boundary = compute_boundary(scene_of({robot}, rings));
        const auto anew = glue(boundary), reused = glue(boundary, *before);
        CHECK(kept_faces(*before, *boundary));  // something was taken
        CHECK(anew->twin == reused->twin && anew->edge == reused->edge && anew->vertex == reused->vertex && anew->side == reused->side);
        CHECK(anew->first == reused->first && anew->face == reused->face && anew->component == reused->component);
        CHECK(anew->edges == reused->edges && anew->vertices == reused->vertices && anew->components == reused->components);
        CHECK(anew->places().xy == reused->places().xy && anew->places().theta == reused->places().theta);
    }
    const auto other = compute_boundary(scene_of({box}, {box}));
    CHECK(!kept_faces(*before, *other));
}

int main() {
    real_roots_are_compared_exactly();
    boundaries_are_closed();
    faces_of_another_scene_are_taken_as_they_are();
    return failures > 0;
}
