// Driver of the boundary: trim patches one by one, gather them, name their features; theory, "The trimmed boundary".
#include "cfree/forbidden/boundary.hpp"

#include <algorithm>
#include <utility>

#include "cfree/forbidden/isolated.hpp"
#include "forbidden/patch_trimming.hpp"
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

namespace {

// Trimming of all patches of a scene, one after another, by any number of threads.
class Trimming {
public:
    Trimming(const Scene& scene, bool regularized, const std::optional<std::vector<Index>>& features)
        : one(scene, regularized), chosen(features), trimmed(one.patches.size(), 0), found(one.first_patch.size() - 1),
          found_thin(found.size()) {}

    // Work of one thread: all patches of one obstacle feature after another.
    void run(const std::atomic<bool>& stop) {
        Tally mine;
        Shadows near = one.shadows();
        const auto count = static_cast<Index>(chosen ? chosen->size() : found.size());
        for (Index n = next++; n < count && !stop; n = next++) {
            const Index j = chosen ? (*chosen)[n] : n;
            if (one.first_patch[j] == one.first_patch[j + 1]) continue;
            one.pillars_near(j, near);
            std::size_t whole = 0, whole_thin = 0;
            try {
                for (Index id = one.first_patch[j]; id < one.first_patch[j + 1] && !stop; ++id, ++done) {
                    whole = found[j].size(), whole_thin = found_thin[j].size();
                    one.trim(id, near, found[j], found_thin[j], mine);
                    trimmed[id] = 1;
                }
            } catch (const Stopped&) {  // in the middle of a patch, with perhaps one chart done
                found[j].resize(whole), found_thin[j].resize(whole_thin);
            }
        }
        const std::lock_guard lock(mutex);
        tally.pairs += mine.pairs, tally.live_patches += mine.live_patches, tally.decisions += mine.decisions;
    }

    double share() const { return trimmed.empty() ? 0.0 : static_cast<double>(done) / static_cast<double>(trimmed.size()); }
    bool is_complete() const { return std::find(trimmed.begin(), trimmed.end(), 0) == trimmed.end(); }

private:
    PatchTrimming one;
    const std::optional<std::vector<Index>>& chosen;
    std::atomic<Index> next{0};
    std::atomic<std::int64_t> done{0};
    std::mutex mutex;

public:
    Patches& patches = one.patches;
    std::vector<std::uint8_t> trimmed;
    std::vector<std::vector<Trapezoid>> found, found_thin;  // one per obstacle ring vertex
    Tally tally;
};

}  // namespace

Boundary::Boundary(std::shared_ptr<const Scene> s, Patches p, std::vector<std::uint8_t> done, Trapezoids t, IsolatedParts i,
                   const Tally& counted)
    : scene(std::move(s)), patches(std::move(p)), trimmed(std::move(done)), trapezoids(std::move(t)), isolated(std::move(i)),
      tally(counted) {}

bool Boundary::is_complete() const { return std::find(trimmed.begin(), trimmed.end(), 0) == trimmed.end(); }

const AngleTable& Boundary::angles(int threads) const {
    std::call_once(ordered, [&] { table = std::make_unique<const AngleTable>(scene->near(), patches, trapezoids, threads); });
    return *table;
}

namespace {

// Add a row whose two angles are one angle of an isolated part, on the patch that names it.
void push_angle(Trapezoids& rows, const IsolatedParts& isolated, Index k, bool is_to) {
    const Trapezoids& p = isolated.parts;
    rows.patch.push_back((is_to ? isolated.to_patch : isolated.from_patch)[k]);
    rows.chart.push_back(p.chart[k]), rows.lower.push_back(p.lower[k]), rows.upper.push_back(p.upper[k]);
    for (auto* first : {&rows.from_first, &rows.to_first}) first->push_back((is_to ? p.to_first : p.from_first)[k]);
    for (auto* second : {&rows.from_second, &rows.to_second}) second->push_back((is_to ? p.to_second : p.from_second)[k]);
    for (auto* lo : {&rows.from_lo, &rows.to_lo}) lo->push_back((is_to ? p.to_lo : p.from_lo)[k]);
    for (auto* hi : {&rows.from_hi, &rows.to_hi}) hi->push_back((is_to ? p.to_hi : p.from_hi)[k]);
    for (auto* place : {&rows.from_place, &rows.to_place}) place->push_back((is_to ? p.to_place : p.from_place)[k]);
}

}  // namespace

AngleRanks angle_ranks(const Boundary& boundary) {
    Trapezoids rows = boundary.trapezoids;
    const std::size_t faces = rows.size(), parts = boundary.isolated.parts.size();
    for (const bool is_to : {false, true})
        for (std::size_t k = 0; k < parts; ++k) push_angle(rows, boundary.isolated, static_cast<Index>(k), is_to);
    const AngleTable table(boundary.scene->near(), boundary.patches, rows, 1);
    AngleRanks ranks{table.from, table.to, table.middle, table.last};
    ranks.from.resize(faces + parts), ranks.to.resize(faces);
    ranks.to.insert(ranks.to.end(), table.to.begin() + static_cast<std::ptrdiff_t>(faces + parts), table.to.end());
    return ranks;
}

SharedBoundary compute_boundary(const std::shared_ptr<const Scene>& shared, const Task& task) {
    using Clock = std::chrono::steady_clock;
    auto start = Clock::now();
    const auto lap = [&] { return std::chrono::duration<double>(Clock::now() - std::exchange(start, Clock::now())).count(); };
    const Scene& scene = shared->near();
    Trimming work(scene, task.regularized, task.features);
    std::atomic<bool> stop{false}, cancelled{false};
    const auto ask = [&] {
        const Wish wish = task.watch(work.share());
        if (wish == Wish::cancel) cancelled = true;
        if (wish != Wish::go_on) stop = true;
    };
    const auto look = task.watch ? std::function<void()>(ask) : nullptr;
    {
        const Lookout trimming(stop, look);
        in_parallel(task.threads, stop, [&] { work.run(stop); });
    }
    Tally tally = work.tally;
    tally.trim_seconds = lap();
    const Lookout afterwards(cancelled, look);
    heed_stop();
    Trapezoids trapezoids, thin;
    gather(work.found, trapezoids), gather(work.found_thin, thin);
    tally.collect_seconds = lap();
    IsolatedParts isolated;
    if (work.is_complete() && !task.regularized && !task.features && !scene.is_round)  // not there yet for grown shapes
        isolated = isolated_parts(scene, work.patches, trapezoids, thin, task.threads, cancelled);
    heed_stop();
    if (!task.features && !scene.is_round) {  // a grown edge is smooth with its own end only
        use_names(scene, trapezoids.features());
        use_names(scene, isolated.parts.features());
    }
    tally.isolated_seconds = lap();
    return std::make_shared<const Boundary>(shared, std::move(work.patches), std::move(work.trimmed), std::move(trapezoids),
                                            std::move(isolated), tally);
}

}  // namespace cfree
