// Driver of the boundary: trim patches one by one, gather them, name their features; theory, "The trimmed boundary".
#include "cfree/forbidden/boundary.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "cfree/forbidden/isolated.hpp"
#include "forbidden/kept_patches.hpp"
#include "forbidden/patch_trimming.hpp"
#include "support/parallel.hpp"

namespace cfree {

namespace {

// Trimming of all patches of a scene, one after another, by any number of threads.
class Trimming {
public:
    // `scene` has the doubles for trimming, `near` is of the same shapes.
    Trimming(const Scene& scene, const Scene& near, const Task& task)
        : one(scene, task.regularized), chosen(task.features), trimmed(one.patches.size(), 0),
          counted(one.first_patch.size() - 1), found(counted.size()), found_thin(counted.size()) {
        if (!task.reuse || task.regularized || chosen) return;
        kept = kept_patches(*task.reuse, near);
        if (!kept) return;
        chosen = kept->retrimmed;
        for (Index j = 0; j < static_cast<Index>(counted.size()); ++j) {
            if (kept->from[j] < 0) continue;
            const Index begin = one.first_patch[j], end = one.first_patch[j + 1];
            std::fill(trimmed.begin() + begin, trimmed.begin() + end, 1);
            counted[j] = task.reuse->counted[kept->from[j]], counted[j].decisions.exact_seconds = 0;
            done += end - begin;
        }
        kept_count = done;
    }

    // Work of one thread: all patches of one obstacle feature after another.
    void run(const std::atomic<bool>& stop) {
        PatchTrimming::Scratch scratch = one.scratch();
        const auto count = static_cast<Index>(chosen ? chosen->size() : found.size());
        for (Index n = next++; n < count && !stop; n = next++) {
            const Index j = chosen ? (*chosen)[n] : n;
            if (one.first_patch[j] == one.first_patch[j + 1]) continue;
            one.pillars_near(j, scratch.near);
            std::size_t whole = 0, whole_thin = 0;
            try {
                for (Index id = one.first_patch[j]; id < one.first_patch[j + 1] && !stop; ++id, ++done) {
                    whole = found[j].size(), whole_thin = found_thin[j].size();
                    one.trim(id, scratch, found[j], found_thin[j], counted[j]);
                    trimmed[id] = 1;
                }
            } catch (const Stopped&) {  // in the middle of a patch, with perhaps one chart done
                found[j].resize(whole), found_thin[j].resize(whole_thin);
            }
        }
    }

    // Write all rows in the order of their patches.
    void gather(Trapezoids& live, Trapezoids& thin) {
        const auto rows = [](const auto& lists) {
            return std::accumulate(lists.begin(), lists.end(), std::size_t{0}, [](std::size_t n, const auto& x) { return n + x.size(); });
        };
        live.reserve(rows(found) + (kept ? kept->live.columns->size() : 0));
        thin.reserve(rows(found_thin) + (kept ? kept->thin.columns->size() : 0));
        for (Index j = 0; j < static_cast<Index>(counted.size()); ++j) {
            if (kept && kept->from[j] >= 0) kept->add(j, one.first_patch[j], live, thin);
            for (const auto& [list, out] : {std::pair{&found[j], &live}, std::pair{&found_thin[j], &thin}}) {
                for (const Trapezoid& x : *list) out->push_back(x);
                std::vector<Trapezoid>().swap(*list);
            }
        }
    }

    Tally tally() const {
        Tally sum;
        for (const Count& x : counted) sum.add(x);
        sum.kept_patches = kept_count;
        return sum;
    }

    double share() const { return trimmed.empty() ? 0.0 : static_cast<double>(done) / static_cast<double>(trimmed.size()); }
    bool is_complete() const { return std::find(trimmed.begin(), trimmed.end(), 0) == trimmed.end(); }

private:
    PatchTrimming one;
    std::optional<std::vector<Index>> chosen;
    std::optional<KeptPatches> kept;
    std::atomic<Index> next{0};
    std::atomic<std::int64_t> done{0};
    std::int64_t kept_count = 0;

public:
    Patches& patches = one.patches;
    std::vector<std::uint8_t> trimmed;
    std::vector<Count> counted;  // one per obstacle ring vertex, as the lists

private:
    std::vector<std::vector<Trapezoid>> found, found_thin;
};

}  // namespace

Boundary::Boundary(std::shared_ptr<const Scene> s, Patches p, std::vector<std::uint8_t> done, Trapezoids t, IsolatedParts i,
                   const Tally& sum, std::optional<Trapezoids> without_width, std::vector<Count> counts)
    : scene(std::move(s)), patches(std::move(p)), trimmed(std::move(done)), trapezoids(std::move(t)), isolated(std::move(i)),
      tally(sum), thin(std::move(without_width)), counted(std::move(counts)) {}

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
    const Scene& near = shared->near();
    const std::optional<Scene> with_others = with_short_doubles(near);
    const Scene& scene = with_others ? *with_others : near;
    Trimming work(scene, near, task);
    std::atomic<bool> stop{false}, cancelled{false};
    const auto ask = [&] {
        const Wish wish = task.watch(work.share());
        if (wish == Wish::cancel) cancelled = true;
        if (wish != Wish::go_on) stop = true;
    };
    const auto look = task.watch ? std::function<void()>(ask) : nullptr;
    if (look) ask();  // limits hold for the shortest work, too
    {
        const Lookout trimming(stop, look);
        in_parallel(task.threads, stop, [&] { work.run(stop); });
    }
    Tally tally = work.tally();
    tally.trim_seconds = lap();
    const Lookout afterwards(cancelled, look);
    heed_stop();
    Trapezoids trapezoids, thin;
    work.gather(trapezoids, thin);
    const bool has_names = !task.features && !scene.is_round;  // a grown edge is smooth with its own end only
    if (has_names)
        for (Trapezoids* rows : {&trapezoids, &thin}) use_names(scene, rows->features());
    tally.collect_seconds = lap();
    IsolatedParts isolated;
    if (work.is_complete() && !task.regularized && !task.features)
        isolated = scene.is_round ? isolated_round_parts(scene, work.patches, trapezoids, thin, task.threads)
                                  : isolated_parts(scene, work.patches, trapezoids, thin, task.threads, cancelled);
    heed_stop();
    if (has_names) use_names(scene, isolated.parts.features());
    tally.isolated_seconds = lap();
    auto without_width = task.regularized ? std::nullopt : std::optional(std::move(thin));
    return std::make_shared<const Boundary>(shared, std::move(work.patches), std::move(work.trimmed), std::move(trapezoids),
                                            std::move(isolated), tally, std::move(without_width), std::move(work.counted));
}

}  // namespace cfree
