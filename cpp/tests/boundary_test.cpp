#include "cfree/forbidden/boundary.hpp"

#include "cfree/forbidden/sampled_count.hpp"
#include "cfree/forbidden/slice.hpp"
#include "check.hpp"
#include "shapes.hpp"

using namespace cfree;

static const Ring robot{{-1, -1}, {2, -1}, {0, 2}}, box{{5, 5}, {8, 5}, {8, 7}, {5, 7}};

static SharedBoundary run(const std::vector<Ring>& robot_rings, const std::vector<Ring>& obstacles, int threads = 1) {
    return compute_boundary(scene_of(robot_rings, obstacles), {threads, false, {}});
}

static double length_at(const SharedBoundary& boundary, int chart, double tau) {
    const auto s = Slicer(boundary).segments(chart, tau);
    double length = 0;
    for (std::size_t k = 0; k < s.trapezoid.size(); ++k)
        length += std::hypot(s.xy[4 * k + 2] - s.xy[4 * k], s.xy[4 * k + 3] - s.xy[4 * k + 1]);
    return length;
}

static void one_pair_keeps_all_patches_whole() {
    const auto found = run({robot}, {box});
    CHECK(found->patches.size() == 24 && found->tally.live_patches == 24 && found->is_complete());
    const double perimeter = 3 + std::sqrt(13) + std::sqrt(10) + 10;
    for (const double tau : {-0.77, -0.3, 0.1, 0.6}) CHECK(std::abs(length_at(found, 0, tau) - perimeter) < 1e-9);
}

static void coincident_obstacles_count_once() {
    const auto a = run({robot}, {box}), b = run({robot}, {box, box});
    for (const double tau : {-0.77, -0.3, 0.1, 0.6}) CHECK(std::abs(length_at(a, 1, tau) - length_at(b, 1, tau)) < 1e-9);
}

static void buried_obstacles_leave_nothing() {
    const Ring wide{{0, 0}, {20, 0}, {20, 20}, {0, 20}};
    const auto found = run({robot}, {box, wide});
    CHECK(found->tally.live_patches == 24);
    for (const Index p : found->trapezoids.patch) CHECK(found->patches.obstacle[p] >= 4);
}

static std::vector<Ring> triangles(long count) {
    std::vector<Ring> many;
    for (long k = 0; k < count; ++k)
        many.push_back({{3 * (k % 7), 2 * (k / 7)}, {3 * (k % 7) + 2 + k % 3, 2 * (k / 7)}, {3 * (k % 7) + 1, 2 * (k / 7) + 2}});
    return many;
}

static void threads_do_not_change_the_result() {
    const auto a = run({robot}, triangles(40), 1), b = run({robot}, triangles(40), 3);
    CHECK(a->trapezoids.lower == b->trapezoids.lower && a->trapezoids.from_lo == b->trapezoids.from_lo);
    const Counters &p = a->tally.decisions, &q = b->tally.decisions;
    CHECK(p.identity == q.identity && p.filter == q.filter && p.interval == q.interval && p.exact == q.exact);
}

static void ties_of_small_integers_are_certain_in_balls() {
    std::vector<Ring> grid;
    for (long k = 0; k < 12; ++k)
        grid.push_back({{2 * (k % 4), 2 * (k / 4)}, {2 * (k % 4) + 2, 2 * (k / 4)}, {2 * (k % 4) + 2, 2 * (k / 4) + 2}, {2 * (k % 4), 2 * (k / 4) + 2}});
    const Ring square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const Counters c = run({square}, grid)->tally.decisions;
    CHECK(c.interval > 1000 && c.exact < c.interval / 20);
    CHECK((c.exact > 0) == (c.exact_seconds > 0));
}

// One thread: nobody else could ask.
static void the_one_who_waits_is_asked() {
    const auto crowded = scene_of({robot}, triangles(1000));
    for (const int threads : {1, 2}) {
        double last = -1;
        const auto wish = [&](Wish what) {
            return [&last, what](double share) {
                CHECK(share >= 0 && share <= 1);
                last = share;
                return what;
            };
        };
        const auto part = compute_boundary(crowded, {threads, false, wish(Wish::finish)});
        CHECK(last >= 0 && !part->is_complete() && part->isolated.parts.size() == 0);
        bool stopped = false;
        try {
            compute_boundary(crowded, {threads, false, wish(Wish::cancel)});
        } catch (const Stopped&) {
            stopped = true;
        }
        CHECK(stopped);
    }
}

static void far_away_it_is_the_same() {
    const Int far = Int(1) << 300;
    const auto at_home = scene_of({robot}, {box});
    Scene away = *at_home;
    const auto moved = [&](std::vector<Int> c) {
        for (Int& x : c) x += far;
        return c;
    };
    away.obstacles.set_coordinates(moved(away.obstacles.X), moved(away.obstacles.Y));
    const auto a = compute_boundary(at_home), b = compute_boundary(scene_around(away, {0, 0}, {far, far}, 0));
    CHECK(a->trapezoids.from_lo == b->trapezoids.from_lo && a->trapezoids.upper == b->trapezoids.upper);
    CHECK(b->scene->frame[0] == 0x1p300);
}

static void patches_far_from_a_change_are_kept_as_they_are() {
    const auto moved = [](int x, int y) {
        Ring ring = box;
        for (auto& [a, b] : ring) a += x, b += y;
        return ring;
    };
    const auto old = run({robot}, {box, moved(20, 0), moved(40, 0)});
    for (const auto& rings : {std::vector{moved(40, 0), moved(0, 1), moved(20, 0)}, std::vector{moved(20, 0), moved(40, 0), box, box}}) {
        const auto scene = scene_of({robot}, rings);
        const auto anew = compute_boundary(scene), reused = compute_boundary(scene, {1, false, {}, {}, old});
        CHECK(reused->tally.kept_patches == 48 && anew->tally.kept_patches == 0);
        const Trapezoids &a = anew->trapezoids, &b = reused->trapezoids;
        CHECK(a.patch == b.patch && a.lower == b.lower && a.from_first == b.from_first && a.to_hi == b.to_hi);
        CHECK(anew->tally.pairs == reused->tally.pairs && anew->tally.live_patches == reused->tally.live_patches);
    }
}

static void a_sample_of_all_patches_counts_like_the_boundary() {
    const auto scene = scene_of({robot}, triangles(40));
    const auto whole = compute_boundary(scene, {1, false, {}});
    const auto patches = static_cast<Index>(whole->patches.size());
    const Count all = sampled_count(*scene, 2 * patches), some = sampled_count(*scene, patches / 4);
    CHECK(all.pairs == whole->tally.pairs && all.live_patches == whole->tally.live_patches);
    CHECK(all.decisions.filter == whole->tally.decisions.filter);
    CHECK(some.pairs * 5 > all.pairs && some.pairs * 3 < all.pairs);
}

int main() {
    one_pair_keeps_all_patches_whole();
    coincident_obstacles_count_once();
    buried_obstacles_leave_nothing();
    threads_do_not_change_the_result();
    ties_of_small_integers_are_certain_in_balls();
    the_one_who_waits_is_asked();
    far_away_it_is_the_same();
    patches_far_from_a_change_are_kept_as_they_are();
    a_sample_of_all_patches_counts_like_the_boundary();
    return failures > 0;
}
