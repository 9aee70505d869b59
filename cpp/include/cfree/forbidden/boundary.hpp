// Trimmed boundary of the forbidden space: all patches, divided among threads. Everything built on it shares it.
#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "cfree/forbidden/angle_table.hpp"
#include "cfree/forbidden/columns.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

struct Count {
    std::int64_t pairs = 0;         // pairs of a patch and a pillar near it
    std::int64_t live_patches = 0;
    Counters decisions;
    void add(const Count& o) { pairs += o.pairs, live_patches += o.live_patches, decisions += o.decisions; }
};

struct Tally : Count {
    std::int64_t kept_patches = 0;  // patches of another boundary
    double trim_seconds = 0, collect_seconds = 0, isolated_seconds = 0;
};

class Boundary {
public:
    Boundary(std::shared_ptr<const Scene> scene, Patches patches, std::vector<std::uint8_t> trimmed, Trapezoids trapezoids,
             IsolatedParts isolated, const Tally& tally = {}, std::optional<Trapezoids> thin = {},
             std::vector<Count> counted = {});

    const std::shared_ptr<const Scene> scene;
    const Patches patches;
    const std::vector<std::uint8_t> trimmed;  // true for each patch that has been trimmed
    const Trapezoids trapezoids;
    const IsolatedParts isolated;
    const Tally tally;
    // Parts of patches without width, on trapezoids or not; and counts by obstacle ring vertex. Only if it has been computed,
    // and not regularized: no file has them, and other scenes take nothing without them.
    const std::optional<Trapezoids> thin;
    const std::vector<Count> counted;

    bool is_complete() const;
    // All critical angles in one order, computed at the first call, by this many threads.
    const AngleTable& angles(int threads = 1) const;

private:
    mutable std::once_flag ordered;
    mutable std::unique_ptr<const AngleTable> table;
};

// Critical angles of trapezoids and of isolated parts in one order; see AngleTable.
struct AngleRanks {
    std::vector<Index> from, to;  // one per trapezoid, then one per isolated part
    Index middle = 0, last = 0;
};
AngleRanks angle_ranks(const Boundary& boundary);

using SharedBoundary = std::shared_ptr<const Boundary>;

// All pairs of a convex vertex and an edge, patches of the boundary before trimming.
Patches list_patches(const Scene& scene);

// True if the robot has a vertex at its reference point, and an obstacle an edge on the outside of the bounds: then surfaces
// may coincide with opposite sides.
bool may_have_slits(const Scene& scene);

// Wish of the waiting caller: to go on, to finish with the result so far, or to cancel.
enum class Wish { go_on, finish, cancel };

struct Task {
    int threads = 1;
    bool regularized = false;           // true: no slits, surfaces that coincide with opposite sides
    std::function<Wish(double)> watch;  // called ten times a second, with the share done
    // A part of the scene: the obstacle features, vertices of rings and the edges that start there, whose patches are
    // trimmed. Then isolated parts are not computed, and curves keep their first names, which depend on the features near by.
    std::optional<std::vector<Index>> features = {};
    // Boundary of another scene: its patches that are the same here are not trimmed again. The result is the same.
    std::shared_ptr<const Boundary> reuse = {};
};

// Throws Stopped if cancelled.
SharedBoundary compute_boundary(const std::shared_ptr<const Scene>& scene, const Task& task = {});

}  // namespace cfree
