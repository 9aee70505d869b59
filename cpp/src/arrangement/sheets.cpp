// Driver of the arrangement: patches one by one, all pillars near each, numbered sets of pairs; theory, "Arrangement".
#include "cfree/arrangement/sheets.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "arrangement/overlay.hpp"
#include "arrangement/pairs.hpp"
#include "forbidden/patch_trimming.hpp"
#include "support/parallel.hpp"

namespace cfree {

namespace {

// Numbers of lines without direction: the same for edges on one line in either direction.
std::vector<Index> carriers(const Shape& s) {
    std::map<std::array<Int, 3>, Index> numbers;
    std::vector<Index> of_line, result;
    for (Index e = 0; e < s.ring_vertices; ++e) {
        const auto known = static_cast<std::size_t>(s.line[e]);
        if (known >= of_line.size()) of_line.resize(known + 1, -1);
        if (of_line[known] < 0) {
            const auto E = edge<Int>(s, e);
            Int c = E.x * s.Y[s.v[e]] - E.y * s.X[s.v[e]], common = gcd(gcd(E.x, E.y), c);
            if (common.is_zero()) common = 1;
            if (E.x < 0 || (E.x.is_zero() && E.y < 0)) common = -common;
            of_line[known] = numbers.try_emplace({E.x / common, E.y / common, c / common}, static_cast<Index>(numbers.size())).first->second;
        }
        result.push_back(of_line[known]);
    }
    return result;
}

using Groups = std::vector<std::vector<Index>>;
Groups grouped(const std::vector<Index>& number, Index count) {
    Groups result;
    for (Index k = 0; k < count; ++k) {
        if (static_cast<std::size_t>(number[k]) >= result.size()) result.resize(static_cast<std::size_t>(number[k]) + 1);
        result[number[k]].push_back(k);
    }
    return result;
}

// Patches on one surface, with either side forbidden.
class SurfaceSharers {
public:
    SurfaceSharers(const Scene& s, const Patches& p)
        : scene(s), patches(p), robot_line(carriers(s.robot)), obstacle_line(carriers(s.obstacles)),
          robot_points(grouped(s.robot.point, s.robot.ring_vertices)), robot_lines(grouped(robot_line, s.robot.ring_vertices)),
          obstacle_points(grouped(s.obstacles.point, s.obstacles.ring_vertices)),
          obstacle_lines(grouped(obstacle_line, s.obstacles.ring_vertices)) {
        for (Index k = 0; k < static_cast<Index>(p.size()); ++k) number.emplace(packed(p.contact(k)), k);
    }

    struct Sharer {
        Index patch;
        bool is_opposite;
    };
    std::vector<Sharer> of(Index patch) const {
        const Shape &A = scene.robot, &O = scene.obstacles;
        const Feature contact = patches.contact(patch);
        const bool on_edge = contact.kind == Kind::vertex_edge;
        const auto& robots = on_edge ? robot_points[A.point[contact.robot]] : robot_lines[robot_line[contact.robot]];
        const auto& others = on_edge ? obstacle_lines[obstacle_line[contact.obstacle]] : obstacle_points[O.point[contact.obstacle]];
        std::vector<Sharer> result;
        for (const Index i : robots)
            for (const Index j : others) {
                const auto found = number.find(packed({contact.kind, i, j}));
                if (found == number.end() || found->second == patch) continue;
                result.push_back({found->second, on_edge ? O.line[j] != O.line[contact.obstacle] : A.line[i] != A.line[contact.robot]});
            }
        return result;
    }

private:
    const Scene& scene;
    const Patches& patches;
    const std::vector<Index> robot_line, obstacle_line;
    const Groups robot_points, robot_lines, obstacle_points, obstacle_lines;
    std::unordered_map<std::uint64_t, Index> number;
};

class Overlaying {
public:
    Overlaying(const SceneFeatures& features, std::int64_t limit)
        : scene(features.scene->near()), pairs(features), one(scene, false), sharers(scene, one.patches), most(limit),
          found(one.first_patch.size() - 1) {}

    // Work of one thread: all patches of one obstacle feature after another.
    void run(const std::atomic<bool>& stop) {
        Shadows near = one.shadows(), near_sharer = one.shadows();
        const auto count = static_cast<Index>(found.size());
        for (Index j = next++; j < count && !stop; j = next++) {
            if (one.first_patch[j] == one.first_patch[j + 1]) continue;
            one.pillars_near(j, near);
            for (Index id = one.first_patch[j]; id < one.first_patch[j + 1]; ++id) {
                lay(id, near, near_sharer, found[j]);
                if (total > most)
                    throw std::length_error("more than " + std::to_string(most) + " pieces of contact surfaces");
            }
        }
    }

    Sheets sheets(const SceneFeatures& features);

private:
    struct Found {
        std::vector<Trapezoid> trapezoids;
        std::map<Holders, Index> numbers;
        std::vector<Index> holders;  // numbers
    };
    void lay(Index patch, Shadows& near, Shadows& near_sharer, Found& into);
    void take_own(Overlay& of, Index pair, const std::vector<Shadows::Pillar>& pillars, Shadows& near) const;
    std::vector<Trapezoid> own_boundary(Index patch, Shadows& near) const;

    const Scene& scene;
    const Pairs pairs;
    PatchTrimming one;
    const SurfaceSharers sharers;
    const std::int64_t most;
    std::atomic<Index> next{0};
    std::atomic<std::int64_t> total{0};
    std::vector<Found> found;  // one per obstacle ring vertex
};

void Overlaying::take_own(Overlay& of, Index pair, const std::vector<Shadows::Pillar>& pillars, Shadows& near) const {
    for (const Shadows::Pillar& pillar : pillars) {
        if (pairs.of_pieces(pillar.p, pillar.k) != pair) continue;
        if (of.empty()) return;
        of.left(near.slices);
        if (const Slices::Part part = near.part(pillar); !part.empty()) of.cover(pillar.p, pillar.k, near.slices, part);
    }
}

// Parts of a patch that its pair leaves.
std::vector<Trapezoid> Overlaying::own_boundary(Index patch, Shadows& near) const {
    const Feature contact = one.patches.contact(patch);
    one.pillars_near(contact.obstacle, near);
    std::vector<Trapezoid> result;
    Counters counters;
    const Range range = range_of(scene, contact, counters);
    for (int r = 0; r < range.count; ++r) {
        Overlay of(scene, {contact, range.chart[r]}, range.from[r], range.to[r]);
        take_own(of, pairs.of(contact), near.on({contact, range.chart[r]}, range.from[r].lo, range.to[r].hi), near);
        of.put_own(result);
    }
    return result;
}

void Overlaying::lay(Index patch, Shadows& near, Shadows& near_sharer, Found& into) {
    const Feature contact = one.patches.contact(patch);
    const Index own = pairs.of(contact);
    struct Shared {
        Index pair;
        Overlay::With how;
        std::vector<Trapezoid> boundary;
    };
    std::vector<Shared> shared;
    for (const auto& [other, is_opposite] : sharers.of(patch)) {
        const Index pair = pairs.of(one.patches.contact(other));
        if (pair == own && other > patch) continue;
        const auto how = other < patch ? Overlay::With::ceded : is_opposite ? Overlay::With::opposite : Overlay::With::same;
        shared.push_back({pair, how, own_boundary(other, near_sharer)});
    }
    Counters counters;
    const Range range = range_of(scene, contact, counters);
    for (int r = 0; r < range.count; ++r) {
        heed_stop();
        const Surface surface{contact, range.chart[r]};
        Overlay of(scene, surface, range.from[r], range.to[r]);
        auto pillars = near.on(surface, range.from[r].lo, range.to[r].hi);
        take_own(of, own, pillars, near);
        if (of.empty()) continue;
        of.left(near.slices);
        of.begin();
        for (const Shared& with : shared) {
            of.start(with.pair);
            for (const Trapezoid& x : with.boundary)
                if (x.chart == surface.chart) of.share(x, with.how);
        }
        const auto pair_of = [&](const Shadows::Pillar& x) { return pairs.of_pieces(x.p, x.k); };
        std::stable_sort(pillars.begin(), pillars.end(), [&](const auto& x, const auto& y) { return pair_of(x) < pair_of(y); });
        Index last = own;
        for (const Shadows::Pillar& pillar : pillars) {
            if (of.is_empty()) break;
            const Index pair = pair_of(pillar);
            if (pair == own) continue;
            if (pair != last) of.start(last = pair);
            if (const Slices::Part part = near.part(pillar); !part.empty()) of.cover(pillar.p, pillar.k, near.slices, part);
        }
        std::vector<Holders> holders;
        of.put(patch, into.trapezoids, holders);
        for (Holders& x : holders)
            into.holders.push_back(into.numbers.try_emplace(std::move(x), static_cast<Index>(into.numbers.size())).first->second);
        total += static_cast<std::int64_t>(holders.size());
    }
}

// Sets of pairs, each with one number.
class SetNumbers {
public:
    Index of(std::vector<Index>&& set) {
        std::sort(set.begin(), set.end());
        const auto [at, is_new] = numbers.try_emplace(std::move(set), sets.size());
        if (is_new) {
            sets.member.insert(sets.member.end(), at->first.begin(), at->first.end());
            sets.start.push_back(static_cast<Index>(sets.member.size()));
        }
        return at->second;
    }
    NumberSets sets;

private:
    std::map<std::vector<Index>, Index> numbers;
};

Sheets Overlaying::sheets(const SceneFeatures& features) {
    Sheets result;
    SetNumbers numbers;
    result.far_away = numbers.of(pairs.far_away()), result.columns = pairs.columns();
    Trapezoids table;
    table.reserve(static_cast<std::size_t>(total));
    struct Sets {
        Index outer, inner, owners;
    };
    for (Found& list : found) {
        std::vector<const Holders*> all(list.numbers.size());
        for (const auto& [holders, number] : list.numbers) all[number] = &holders;
        std::map<std::pair<Index, Index>, Sets> known;  // keys: holders and own pair
        for (std::size_t k = 0; k < list.trapezoids.size(); ++k) {
            const Trapezoid& x = list.trapezoids[k];
            const Index own = pairs.of(one.patches.contact(x.patch));
            const auto [at, is_new] = known.try_emplace({list.holders[k], own});
            if (is_new) {
                const Holders& h = *all[list.holders[k]];
                std::vector<Index> outer = h.around, inner = h.around, owners{own};
                outer.insert(outer.end(), h.opposite.begin(), h.opposite.end());
                inner.push_back(own), inner.insert(inner.end(), h.same.begin(), h.same.end());
                for (const auto* list_of : {&h.same, &h.opposite}) owners.insert(owners.end(), list_of->begin(), list_of->end());
                at->second = {numbers.of(std::move(outer)), numbers.of(std::move(inner)), numbers.of(std::move(owners))};
            }
            table.push_back(x);
            result.outer.push_back(at->second.outer), result.inner.push_back(at->second.inner);
            result.owners.push_back(at->second.owners);
        }
        list = {};
    }
    result.sets = std::move(numbers.sets);
    use_names(scene, table.features());
    std::vector<std::uint8_t> trimmed(one.patches.size(), 1);
    result.boundary = std::make_shared<const Boundary>(features.scene, std::move(one.patches), std::move(trimmed), std::move(table),
                                                       IsolatedParts{});
    return result;
}

}  // namespace

Sheets compute_sheets(const SceneFeatures& features, int threads, std::int64_t most) {
    Overlaying work(features, most);
    std::atomic<bool> stop{false};
    in_parallel(threads, stop, [&] { work.run(stop); });
    heed_stop();
    return work.sheets(features);
}

}  // namespace cfree
