#include "cfree/search/rrt_connect.hpp"

#include <cmath>
#include <numbers>

#include "cfree/search/shortcut.hpp"
#include "check.hpp"
#include "shapes.hpp"

using namespace cfree;
using std::numbers::pi;

static const Grid grid{0, 20, 20};

static bool near(double a, double b) { return std::abs(a - b) < 1e-9; }

// The point of the robot at (x, y), where the pose puts it.
static Vec<double> placed(const Configuration& q, double x, double y) {
    const double hx = static_cast<double>(q.hx), hy = static_cast<double>(q.hy), w = hx * hx + hy * hy;
    const double c = (hx * hx - hy * hy) / w, s = 2 * hx * hy / w, unit = static_cast<double>(q.unit);
    return {c * x - s * y + static_cast<double>(q.x) / unit, s * x + c * y + static_cast<double>(q.y) / unit};
}

static void a_configuration_is_the_same_in_both_ways() {
    for (int k = -20; k <= 20; ++k) {
        const Configuration q = grid.exact(0.37 * k, 1.1 - k, k * pi / 7);
        CHECK(std::abs(std::remainder(q.theta - k * pi / 7, 2 * pi)) < 1e-5);
        const auto p = placed(q, 1, 0);
        CHECK(near(p.x, q.px + std::cos(q.theta)) && near(p.y, q.py + std::sin(q.theta)));
    }
}

static void one_motion_leads_from_one_to_the_other() {
    Random random(1);
    for (int k = 0; k < 200; ++k) {
        const auto any = [&] { return grid.exact(9 * random(), 9 * random(), k % 5 ? 7 * random() : 1); };
        const Configuration a = any(), b = any();
        const Motion m = motion_between(a, b);
        const double unit = static_cast<double>(m.unit), x = static_cast<double>(m.vx) / unit, y = static_cast<double>(m.vy) / unit;
        if (!m.turns) {
            CHECK(near(a.px + x, b.px) && near(a.py + y, b.py));
            continue;
        }
        const double q = static_cast<double>(m.q), p = static_cast<double>(m.p), w = q * q + p * p;
        const double c = (q * q - p * p) / w, s = 2 * q * p / w, dx = a.px - x, dy = a.py - y;
        CHECK(q >= 0 && std::abs(x + c * dx - s * dy - b.px) < 1e-6 && std::abs(y + s * dx + c * dy - b.py) < 1e-6);
        const auto end = along(a, b, 1), start = along(a, b, 0), half = along(a, b, 0.5);
        CHECK(near(end.x, b.px) && near(end.y, b.py) && near(start.x, a.px) && near(start.y, a.py));
        const double radius = std::hypot(dx, dy);  // about the pole
        CHECK(std::abs(std::hypot(half.x - x, half.y - y) - radius) < 1e-6 * (1 + radius));
    }
}

static void a_search_finds_a_way_and_shortening_keeps_it_free() {
    const MotionChecker checker(scene_of({{{0, 0}, {2, 0}, {2, 1}, {0, 1}}},
                                         {{{5, -20}, {6, -20}, {6, 0}, {5, 0}}, {{5, 4}, {6, 4}, {6, 20}, {5, 20}}}));
    const Configuration start = grid.exact(0, -8, 0), goal = grid.exact(9, 8, pi / 2);
    const auto certainly = [&](const Configuration& a, const Configuration& b) { return checker.is_free(motion_between(a, b)); };
    const Joins joins{[](const Place&, const Place&) { return true; }, certainly};  // a bad guess
    RrtConnect search(joins, grid, {-10, -15, 20, 15}, 2, start, goal, 7);
    Route route;
    for (int k = 0; k < 100 && route.empty(); ++k) route = search.run(100);
    CHECK(route.size() >= 2);
    const auto is_free = [&](const Route& r) {
        for (std::size_t k = 1; k < r.size(); ++k)
            if (!checker.is_free(motion_between(r[k - 1], r[k]))) return false;
        return true;
    };
    CHECK(is_free(route));
    Shortcut shortener({checker, nullptr, grid, {}, 2}, {route, std::vector<double>(route.size())}, 7);
    const double before = shortener.length();
    shortener.run(2000);
    CHECK(is_free(shortener.path()) && shortener.length() < before);
    CHECK(shortener.path().front().x == start.x && shortener.path().back().hy == goal.hy);
    CHECK(shortener.length() > std::hypot(9, 16) + pi);
}

static void no_way_is_found_where_there_is_none() {
    const MotionChecker checker(scene_of({{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, {{{5, -50}, {6, -50}, {6, 50}, {5, 50}}}));
    const auto certainly = [&](const Configuration& a, const Configuration& b) { return checker.is_free(motion_between(a, b)); };
    const Joins joins{[](const Place&, const Place&) { return true; }, certainly};  // a bad guess
    RrtConnect search(joins, grid, {-10, -15, 20, 15}, 2, grid.exact(0, 0, 0), grid.exact(9, 0, 0), 7);
    CHECK(search.run(2000).empty());
}

int main() {
    a_configuration_is_the_same_in_both_ways();
    one_motion_leads_from_one_to_the_other();
    a_search_finds_a_way_and_shortening_keeps_it_free();
    no_way_is_found_where_there_is_none();
    return failures != 0;
}
