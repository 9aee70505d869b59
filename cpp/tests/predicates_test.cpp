#include "cfree/predicates/predicates.hpp"

#include "check.hpp"
#include "predicates/isolation.hpp"
#include "shapes.hpp"

using namespace cfree;

static const Scene triangles{shape_of({{{0, 0}, {2, 0}, {0, 1}}}), shape_of({{{5, 5}, {8, 5}, {6, 7}}})};
static const Event first{{}, {}, -1, -1}, last{{}, {}, 1, 1};

static void equal_features_have_equal_codes() {
    const Scene s{triangles.robot, shape_of({{{0, 0}, {1, 0}, {0, 1}}, {{1, 0}, {2, 0}, {1, 1}}})};
    const auto edge = [&](Index i, Index j) { return code(s, {Kind::vertex_edge, i, j}); };
    CHECK(edge(1, 0) == edge(1, 3));  // collinear bottoms
    CHECK(edge(1, 0) != edge(1, 1));
    CHECK(code(s, {Kind::vertex_vertex, 0, 1}) == code(s, {Kind::vertex_vertex, 0, 3}));
    CHECK(code(s, {Kind::vertex_vertex, 0, 1}) != code(s, {Kind::edge_vertex, 0, 1}));
}

static void parallels_are_found_and_ordered() {
    Predicates p(triangles, {{Kind::vertex_edge, 0, 0}, 0});
    // E_1 = (-2, 1) is parallel to (3, 0) at tan(theta) = 1/2
    const auto roots = p.parallel_roots(1, 0, first, last);
    CHECK(roots.at.size() == 1);
    const double tau = std::tan(std::atan(0.5) / 2);
    CHECK(roots.at[0].lo < tau && tau < roots.at[0].hi);
    CHECK(p.order(first, roots.at[0]) < 0 && p.order(roots.at[0], last) < 0);
    CHECK(p.order(roots.at[0], roots.at[0]) == 0);
    // G . F = 0: the roots are the ends of the chart, and not inside
    CHECK(p.parallel_roots(2, 0, first, last).at.empty());
}

static void a_sample_lies_between() {
    Predicates p(triangles, {{Kind::vertex_edge, 0, 0}, 0});
    const Event root = p.parallel_roots(1, 0, first, last).at[0];
    for (int attempt = 0; attempt < 30; ++attempt) {
        const Sample at = p.between(first, root, attempt);
        CHECK(at.tau > -1 && p.order(root, at) > 0 && p.order(first, at) < 0);
    }
}

static void identical_curves_compare_equal() {
    Predicates p(triangles, {{Kind::vertex_edge, 0, 0}, 0});
    const Curve low = p.curve({Kind::vertex_vertex, 0, 0}), high = p.curve({Kind::vertex_vertex, 0, 1});
    CHECK(p.compare(low, low, first, last).sign[0] == 0);
    const auto order = p.compare(low, high, first, last);
    CHECK(order.is(-1));
    // the next edge through b_1 meets this surface in the helix of b_1: t = 1, by arithmetic
    Curve next = p.curve({Kind::vertex_edge, 0, 1});
    next.N = -next.N, next.D = -next.D, next.flipped = true;
    CHECK(p.compare(next, high, first, last).sign[0] == 0);
}

// Angles 1e-17 apart, and equal ones of different names: whatever has been asked before, the answers are those of a new object.
static void close_angles_are_ordered_as_if_asked_alone() {
    const long far = 30'000'000'000'000'000;
    std::vector<Ring> rings;
    for (long k = 0; k < 6; ++k) {
        const long x = 5 * far / 30 + k % 3, y = 5 * far / 30 - k / 2;
        rings.push_back({{x, y}, {x + far / 10, y}, {x + far / 30, y + far / 15 + k}});
    }
    const Scene s{shape_of({{{0, 0}, {far / 15, 0}, {0, far / 30}}}), shape_of(rings)};
    const Surface on{{Kind::vertex_edge, 0, 1}, 0};
    Predicates kept(s, on);
    std::vector<Event> angles;
    for (Index vertex = 0; vertex < 18; ++vertex)
        for (Index mine = 0; mine < 3; ++mine)
            for (const Event& x : kept.offset_roots(mine, vertex, kept.offset(mine, vertex), first, last).at)
                if (x.fine < 0) angles.push_back(x);
    int close = 0;
    for (int round = 0; round < 3; ++round)
        for (const Event& x : angles)
            for (const Event& y : angles) {
                Predicates alone(s, on);
                const int order = kept.order(x, y);
                CHECK(order == alone.order(x, y) && order == -kept.order(y, x));
                if (order >= 0) continue;
                close += !(x.hi < y.lo);
                const Sample at = kept.between(x, y), own = alone.between(x, y);
                CHECK(at.tau == own.tau && compare(at.exact(), own.exact()) == 0);
                CHECK(kept.order(x, at) < 0 && kept.order(y, at) > 0);
            }
    CHECK(close > 32);
}

static void ranges_begin_and_end_on_walls_exactly() {
    Counters c;
    const Scene boxes{shape_of({{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}), shape_of({{{5, 5}, {8, 5}, {8, 7}, {5, 7}}})};
    for (Index g = 0; g < 4; ++g)
        for (Index f = 0; f < 4; ++f) {
            const auto start = Predicates::range_end(boxes, g, f, true, c), end = Predicates::range_end(boxes, g, f, false, c);
            const bool wall = (g + f) % 2 == 1;
            CHECK((start.event.first.kind == Kind::none) == wall);
            CHECK(wall ? start.event.lo == -1 && end.event.lo == 1 && start.chart != end.chart
                       : start.chart == end.chart && start.event.lo < 0 && start.event.hi > 0);
        }
}

// Changes of sign, where each unknown one is known.
static int changes(const std::vector<int>& sign) {
    int count = 0, last = 0;
    for (const int s : sign) {
        count += s * last < 0;
        if (s != 0) last = s;
    }
    return count;
}

// An interval has one root, or none, only if it has so many changes for all that unknown signs may be.
static void unknown_signs_hide_no_roots() {
    const auto digits = [](int number, int size) {  // each -1, 0 or 1
        std::vector<int> result;
        for (; size > 0; --size, number /= 3) result.push_back(number % 3 - 1);
        return result;
    };
    for (const int degree : {2, 4, 6})
        for (int k = 0; k < std::pow(3, degree + 1); ++k) {
            const std::vector<int> known = digits(k, degree + 1);
            const Found found = roots_inside(known.data(), degree);
            if (found != Found::one && found != Found::none) continue;
            const auto unknown = static_cast<int>(std::count(known.begin(), known.end(), 0));
            for (int n = 0; n < std::pow(3, unknown); ++n) {
                std::vector<int> sign = known, rest = digits(n, unknown);
                for (int& s : sign)
                    if (s == 0) s = rest.back(), rest.pop_back();
                CHECK(changes(sign) == (found == Found::one));
            }
        }
}

int main() {
    unknown_signs_hide_no_roots();
    equal_features_have_equal_codes();
    parallels_are_found_and_ordered();
    a_sample_lies_between();
    close_angles_are_ordered_as_if_asked_alone();
    identical_curves_compare_equal();
    ranges_begin_and_end_on_walls_exactly();
    return failures > 0;
}
