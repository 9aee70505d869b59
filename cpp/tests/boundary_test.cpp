#include "cfree/forbidden/boundary.hpp"

#include <algorithm>
#include <memory>

#include "cfree/forbidden/slice.hpp"
#include "check.hpp"
#include "shapes.hpp"

using namespace cfree;

static const Ring robot{{-1, -1}, {2, -1}, {0, 2}}, box{{5, 5}, {8, 5}, {8, 7}, {5, 7}};

static std::unique_ptr<Job> run(const std::shared_ptr<const Scene>& scene, int threads = 1) {
    auto job = std::make_unique<Job>(scene, threads, false);
    while (!job->wait(1)) {}
    return job;
}

static std::vector<double> interleaved(const Shape& s) {
    std::vector<double> xy;
    for (std::size_t k = 0; k < s.x.size(); ++k) xy.push_back(s.x[k]), xy.push_back(s.y[k]);
    return xy;
}

static double length_at(const std::shared_ptr<const Scene>& scene, const Job& job, int chart, double tau) {
    const auto middle = [](const std::vector<double>& lo, const std::vector<double>& hi) {
        std::vector<double> m;
        for (std::size_t k = 0; k < lo.size(); ++k) m.push_back((lo[k] + hi[k]) / 2);
        return m;
    };
    const auto& t = job.trapezoids;
    const Slicer slicer(scene, interleaved(scene->robot), interleaved(scene->obstacles), job.patches, t.patch, t.chart,
                        t.lower, t.upper, middle(t.from_lo, t.from_hi), middle(t.to_lo, t.to_hi), {});
    const auto s = slicer.segments(chart, tau);
    double length = 0;
    for (std::size_t k = 0; k < s.trapezoid.size(); ++k)
        length += std::hypot(s.xy[4 * k + 2] - s.xy[4 * k], s.xy[4 * k + 3] - s.xy[4 * k + 1]);
    return length;
}

static void one_pair_keeps_all_patches_whole() {
    const auto scene = std::make_shared<const Scene>(Scene{shape_of({robot}), shape_of({box})});
    const auto job = run(scene);
    CHECK(job->patches.kind.size() == 24 && job->tally.live_patches == 24);
    const double perimeter = 3 + std::sqrt(13) + std::sqrt(10) + 10;
    for (const double tau : {-0.77, -0.3, 0.1, 0.6})
        CHECK(std::abs(length_at(scene, *job, 0, tau) - perimeter) < 1e-9);
}

static void coincident_obstacles_count_once() {
    const auto one = std::make_shared<const Scene>(Scene{shape_of({robot}), shape_of({box})});
    const auto two = std::make_shared<const Scene>(Scene{shape_of({robot}), shape_of({box, box})});
    const auto a = run(one), b = run(two);
    for (const double tau : {-0.77, -0.3, 0.1, 0.6})
        CHECK(std::abs(length_at(one, *a, 1, tau) - length_at(two, *b, 1, tau)) < 1e-9);
}

static void buried_obstacles_leave_nothing() {
    const Ring wide{{0, 0}, {20, 0}, {20, 20}, {0, 20}};
    const auto job = run(std::make_shared<const Scene>(Scene{shape_of({robot}), shape_of({box, wide})}));
    CHECK(job->tally.live_patches == 24);
    for (const Index p : job->trapezoids.patch) CHECK(job->patches.obstacle[p] >= 4);
}

static void threads_do_not_change_the_result() {
    std::vector<Ring> many;
    for (long k = 0; k < 40; ++k) many.push_back({{3 * (k % 7), 2 * (k / 7)}, {3 * (k % 7) + 2 + k % 3, 2 * (k / 7)}, {3 * (k % 7) + 1, 2 * (k / 7) + 2}});
    const auto scene = std::make_shared<const Scene>(Scene{shape_of({robot}), shape_of(many)});
    const auto a = run(scene, 1), b = run(scene, 3);
    CHECK(a->trapezoids.lower == b->trapezoids.lower && a->trapezoids.from_lo == b->trapezoids.from_lo);
    const Counters &p = a->tally.decisions, &q = b->tally.decisions;
    CHECK(p.identity == q.identity && p.filter == q.filter && p.interval == q.interval && p.exact == q.exact);
}

static void ties_of_small_integers_are_certain_in_balls() {
    std::vector<Ring> grid;
    for (long k = 0; k < 12; ++k) grid.push_back({{2 * (k % 4), 2 * (k / 4)}, {2 * (k % 4) + 2, 2 * (k / 4)}, {2 * (k % 4) + 2, 2 * (k / 4) + 2}, {2 * (k % 4), 2 * (k / 4) + 2}});
    const Ring square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const Counters c = run(std::make_shared<const Scene>(Scene{shape_of({square}), shape_of(grid)}))->tally.decisions;
    CHECK(c.interval > 1000 && c.exact < c.interval / 20);
    CHECK(c.interval_seconds > 0);
}

static void a_cancelled_job_ends() {
    std::vector<Ring> many;
    for (long k = 0; k < 200; ++k) many.push_back({{2 * (k % 15), 2 * (k / 15)}, {2 * (k % 15) + 3, 2 * (k / 15)}, {2 * (k % 15), 2 * (k / 15) + 3}});
    Job job(std::make_shared<const Scene>(Scene{shape_of({robot}), shape_of(many)}), 2, false);
    job.cancel();
    while (!job.wait(1)) {}
    CHECK(job.progress() <= 1);
}

int main() {
    one_pair_keeps_all_patches_whole();
    coincident_obstacles_count_once();
    buried_obstacles_leave_nothing();
    threads_do_not_change_the_result();
    ties_of_small_integers_are_certain_in_balls();
    a_cancelled_job_ends();
    return failures > 0;
}
