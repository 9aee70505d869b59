#include "cfree/forbidden/boundary.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "cfree/forbidden/isolated.hpp"
#include "forbidden/coincident_surfaces.hpp"
#include "forbidden/pillar_index.hpp"
#include "support/parallel.hpp"

namespace cfree {

namespace {

void gather(std::vector<std::vector<Trapezoid>>& lists, Trapezoids& into) {
    std::size_t total = 0;
    for (const auto& list : lists) total += list.size();
    into.reserve(total);
    for (auto& list : lists) {
        for (const Trapezoid& x : list) into.push_back(x);
        std::vector<Trapezoid>().swap(list);
    }
}

}  // namespace

Patches list_patches(const Scene& scene) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    Patches list;
    const auto add = [&](Kind kind, Index i, Index j) {
        list.kind.push_back(static_cast<std::uint8_t>(kind)), list.robot.push_back(i), list.obstacle.push_back(j);
    };
    for (Index j = 0; j < O.ring_vertices; ++j) {
        if (!O.emit[j]) continue;
        for (Index i = 0; i < A.ring_vertices; ++i)
            if (A.layer[i] == O.layer[j] && A.convex[i]) add(Kind::vertex_edge, i, j);
        for (Index i = 0; O.convex[j] && i < A.ring_vertices; ++i)
            if (A.layer[i] == O.layer[j] && A.has_extent(i)) add(Kind::edge_vertex, i, j);
    }
    return list;
}

// What all threads read.
struct Job::Plan {
    Neighbours neighbours;
    Owners owners;
};

Job::Job(std::shared_ptr<const Scene> s, int threads, bool regularized)
    : scene(std::move(s)), plan(std::make_unique<Plan>(Plan{Neighbours(*scene), Owners(*scene, regularized)})) {
    patches = list_patches(*scene);
    first_patch.assign(static_cast<std::size_t>(scene->obstacles.ring_vertices) + 1, 0);
    for (const Index j : patches.obstacle) ++first_patch[j + 1];
    std::partial_sum(first_patch.begin(), first_patch.end(), first_patch.begin());
    found.resize(first_patch.size() - 1), found_thin.resize(first_patch.size() - 1);
    trimmed.assign(patches.kind.size(), 0);
    runner = std::thread([this, threads] { run(threads); });
}

Job::~Job() {
    cancel();
    runner.join();
}

bool Job::wait(double seconds) {
    std::unique_lock lock(mutex);
    ended_signal.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return ended; });
    if (ended && error) std::rethrow_exception(error);
    return ended;
}

double Job::progress() const { return trimmed.empty() ? 0.0 : static_cast<double>(done) / static_cast<double>(trimmed.size()); }

void Job::run(int threads) {
    using Clock = std::chrono::steady_clock;
    auto start = Clock::now();
    const auto lap = [&] { return std::chrono::duration<double>(Clock::now() - std::exchange(start, Clock::now())).count(); };
    try {
        stop_flag = &stop;
        in_parallel(threads, stop, [this] { trim_patches(); });
        tally.trim_seconds = lap();
        Trapezoids thin;
        if (!cancelled) gather(found, trapezoids), gather(found_thin, thin);
        tally.collect_seconds = lap();
        stop_flag = &cancelled;
        const bool is_complete = std::find(trimmed.begin(), trimmed.end(), 0) == trimmed.end();
        if (is_complete && !cancelled) isolated = isolated_parts(*scene, patches, trapezoids, thin, threads, cancelled);
        tally.isolated_seconds = lap();
    } catch (...) {
        error = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    ended = true;
    ended_signal.notify_all();
}

// What one thread does: all patches of one obstacle feature after another.
void Job::trim_patches() {
    Tally mine;
    std::vector<Index> near;
    const auto count = static_cast<Index>(found.size());
    for (Index j = next++; j < count && !stop; j = next++) {
        if (first_patch[j] == first_patch[j + 1]) continue;
        plan->neighbours.near(j, near);
        try {
            for (Index id = first_patch[j]; id < first_patch[j + 1] && !stop; ++id, ++done) trim_patch(id, near, mine);
        } catch (const Stopped&) {  // in the midst of a patch
        }
    }
    const std::lock_guard lock(mutex);
    tally.pairs += mine.pairs, tally.live_patches += mine.live_patches, tally.decisions += mine.decisions;
}

void Job::trim_patch(Index id, const std::vector<Index>& near, Tally& mine) {
    const Shape &A = scene->robot, &O = scene->obstacles;
    const Feature contact{static_cast<Kind>(patches.kind[id]), patches.robot[id], patches.obstacle[id]};
    const std::vector<Feature> owners = plan->owners.before(contact);
    const Range range = range_of(*scene, contact, mine.decisions);
    const std::size_t before = found[contact.obstacle].size();
    for (int r = 0; r < range.count; ++r) {
        Trimmer trimmer(*scene, {contact, range.chart[r]}, range.from[r], range.to[r]);
        for (const Feature& owner : owners) {
            const Range shared = range_of(*scene, owner, mine.decisions);
            for (int s = 0; s < shared.count; ++s)
                if (shared.chart[s] == range.chart[r]) trimmer.cede(owner, shared.from[s], shared.to[s]);
        }
        for (Index p = 0; p < A.pieces() && !trimmer.empty(); ++p) {
            const Box reachable = plan->neighbours.swept(contact, p, range.chart[r], range.from[r].lo, range.to[r].hi);
            for (const Index k : near) {
                if (A.piece_layer[p] != O.piece_layer[k] || !reachable.meets(plan->neighbours.box(k))) continue;
                ++mine.pairs;
                trimmer.cover(p, k);
                if (trimmer.empty()) break;
            }
        }
        trimmer.finish(id, found[contact.obstacle], found_thin[contact.obstacle]);
        mine.decisions += trimmer.decide.counters;
    }
    mine.live_patches += found[contact.obstacle].size() > before;
    trimmed[id] = 1;
}

}  // namespace cfree
