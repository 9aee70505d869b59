#include "cfree/search/nearness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/search/rrt_connect.hpp"
#include "cfree/search/way.hpp"
#include "check.hpp"
#include "shapes.hpp"

using namespace cfree;
using std::numbers::pi;

static const Grid grid{0, 20, 20};
static const std::vector<Ring> robot{{{0, 0}, {3, 0}, {3, 1}, {0, 1}}, {{0, 1}, {1, 1}, {1, 3}}};
static const std::vector<Ring> obstacles{{{6, -9}, {7, -9}, {7, 0}, {6, 0}}, {{4, 5}, {9, 4}, {8, 9}}, {{-9, -4}, {-2, -5}, {-6, 2}}};

using Point = Vec<double>;

static double apart(const Point& p, const Point& a, const Point& b) {  // a point from a segment
    const Point e = b - a, d = p - a;
    const double share = std::clamp(dot(d, e) / dot(e, e), 0.0, 1.0);
    return std::hypot(d.x - share * e.x, d.y - share * e.y);
}

static std::vector<Point> placed(const Ring& ring, const Place& at) {
    std::vector<Point> points;
    for (const auto& [u, v] : ring) {
        const auto x = static_cast<double>(u), y = static_cast<double>(v), c = std::cos(at.theta), s = std::sin(at.theta);
        points.push_back({at.x + c * x - s * y, at.y + s * x + c * y});
    }
    return points;
}

static bool is_inside(const Point& p, const std::vector<Point>& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k)
        if (cross(ring[(k + 1) % ring.size()] - ring[k], p - ring[k]) < 0) return false;
    return true;
}

// Distance of all vertices from all edges; 0 if a vertex is inside, which misses pieces that cross without.
static double distance_of_all(const Place& at) {
    double best = HUGE_VAL;
    for (const Ring& r : robot)
        for (const Ring& o : obstacles) {
            const auto A = placed(r, at), B = placed(o, {0, 0, 0});
            for (const auto& [P, Q] : {std::pair{&A, &B}, std::pair{&B, &A}})
                for (const Point& p : *P) {
                    if (is_inside(p, *Q)) return 0;
                    for (std::size_t k = 0; k < Q->size(); ++k) best = std::min(best, apart(p, (*Q)[k], (*Q)[(k + 1) % Q->size()]));
                }
        }
    return best;
}

static Place any_place(Random& random) { return {24 * random() - 12, 24 * random() - 12, 2 * pi * random() - pi}; }

static void distances_are_those_of_all_features(const Nearness& nearness) {
    Random random(3);
    int apart_count = 0;
    for (int k = 0; k < 2000; ++k) {
        const Place at = any_place(random);
        const double expected = distance_of_all(at), found = nearness.distance(at, HUGE_VAL);
        if (expected == 0) CHECK(found <= 0 && nearness.is_nearer(at, 0));
        if (expected == 0 || found <= 0) continue;
        ++apart_count;
        CHECK(std::abs(found - expected) < 1e-9);
        CHECK(nearness.is_nearer(at, 1.01 * expected) && !nearness.is_nearer(at, 0.99 * expected));
    }
    CHECK(apart_count > 1000);
}

static void a_motion_keeps_the_distances_that_its_poses_have(const Nearness& nearness) {
    Random random(4);
    int kept = 0, refused = 0;
    for (int k = 0; k < 2000; ++k) {
        const Place from = any_place(random), to = any_place(random);
        const double share = 0.4 * random() + 0.05;
        const Configuration a = grid.exact(from.x, from.y, from.theta);
        const Configuration b = grid.exact(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), from.theta + share * to.theta);
        const double first = 2 * random(), second = k % 2 ? first : 2 * random();
        const auto need = [&](double u) { return u < 0.5 ? first : second; };
        double least = HUGE_VAL;  // of the distances in those required
        for (int n = 0; n <= 64; ++n) least = std::min(least, nearness.distance(along(a, b, n / 64.0), HUGE_VAL) / need(n / 64.0));
        const bool keeps = nearness.keeps(a, b, need);
        if (keeps) CHECK(least > 0.95 - 1e-9);
        if (least < 0.9) CHECK(!keeps);
        if (k % 2 && least > 1.3) CHECK(keeps);
        ++(keeps ? kept : refused);
    }
    CHECK(kept > 300 && refused > 300);
}

static void the_nearest_pose_of_a_ridge_is_that_of_all(const Nearness& nearness, const MotionChecker& checker) {
    Random random(5);
    Marked ridge{{grid.exact(0, 0, 0)}, {0}};
    for (int k = 0; k < 200; ++k) {
        const Configuration last = ridge.route.back();
        ridge.route.push_back(grid.exact(last.px + random() - 0.4, last.py + random() - 0.5, last.theta + random() - 0.5));
        ridge.mark.push_back(ridge.mark.back() + travel_between(last, ridge.route.back()));
    }
    const double radius = 3;
    const Way way = Way{checker, &nearness, grid, {}, {radius}}.asking(ridge, std::vector<double>(ridge.route.size(), 1));
    for (int k = 0; k < 1000; ++k) {
        const Place at = {40 * random() - 5, 20 * random() - 10, 4 * pi * random() - 2 * pi};
        const double from = ridge.mark.back() * random(), to = from + 9 * random();
        const auto square = [&](std::size_t n) {
            const Configuration& q = ridge.route[n];
            const double turn = radius * std::remainder(q.theta - at.theta, 2 * pi);
            return std::pow(q.px - at.x, 2) + std::pow(q.py - at.y, 2) + turn * turn;
        };
        double least = HUGE_VAL;
        for (std::size_t n = 0; n < ridge.mark.size(); ++n)
            if (from - 2 * radius <= ridge.mark[n] && ridge.mark[n] <= to + 2 * radius) least = std::min(least, square(n));
        CHECK(square(way.nearest(at, from, to)) <= least + 1e-9);
    }
}

int main() {
    const auto scene = scene_of(robot, obstacles);
    const Nearness nearness(*scene);
    const MotionChecker checker(scene);
    distances_are_those_of_all_features(nearness);
    a_motion_keeps_the_distances_that_its_poses_have(nearness);
    the_nearest_pose_of_a_ridge_is_that_of_all(nearness, checker);
    return failures != 0;
}
