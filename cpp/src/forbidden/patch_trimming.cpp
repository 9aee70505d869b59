// Trim a patch by the pillars near it; theory, "The trimmed boundary".
#include "forbidden/patch_trimming.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "forbidden/equal_radii.hpp"
#include "forbidden/near_fillets.hpp"
#include "forbidden/round_shadows.hpp"
#include "forbidden/round_trim.hpp"

namespace cfree {

std::vector<Index> first_patches(const Scene& scene, const Patches& patches) {
    std::vector<Index> first(static_cast<std::size_t>(scene.obstacles.ring_vertices) + 1, 0);
    for (const Index j : patches.obstacle) ++first[j + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    return first;
}

Patches list_patches(const Scene& scene) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    Patches list;
    const auto add = [&](Kind kind, Index i, Index j) {
        list.kind.push_back(static_cast<std::uint8_t>(kind)), list.robot.push_back(i), list.obstacle.push_back(j);
    };
    for (Index j = 0; j < O.ring_vertices; ++j) {
        if (!O.emit[j]) continue;
        for (Index i = 0; O.makes_surfaces(j) && i < A.ring_vertices; ++i)
            if (A.layer[i] == O.layer[j] && A.convex[i]) add(Kind::vertex_edge, i, j);
        for (Index i = 0; O.convex[j] && i < A.ring_vertices; ++i)
            if (A.layer[i] == O.layer[j] && A.makes_surfaces(i)) add(Kind::edge_vertex, i, j);
        for (Index i = 0; scene.is_round && i < A.ring_vertices; ++i) {
            if (A.layer[i] != O.layer[j]) continue;
            if (have_equal_radii(scene, i, j)) add(Kind::vertex_vertex, i, j);  // a helix, of which only isolated parts are on the boundary
            for (int quadrant = 0; quadrant < 4 && makes_circles(scene, i, j); ++quadrant) {
                add(Kind::vertex_vertex, i, j);
                list.kind.back() = static_cast<std::uint8_t>(list.kind.back() | quadrant << 4);
            }
        }
    }
    return list;
}

PatchTrimming::PatchTrimming(const Scene& s, bool regularized)
    : patches(list_patches(s)), first_patch(first_patches(s, patches)), scene(s), neighbours(s), owners(s, regularized) {
    const Shape& A = s.robot;
    for (Index r = 0; r < A.ring_vertices; ++r)
        for (Index i = 0; A.layer[r] == reference_layer && i < A.ring_vertices; ++i)
            if (A.layer[i] != reference_layer && A.point[i] == A.point[r]) at_reference.push_back(i);
}

// A pillar below a bound may have a vertex that stays on it while the robot turns: the sum of an obstacle's vertex on the
// bound and the robot's vertex at its reference point. Within one layer this is impossible: two convex bodies on one side of
// a line that touch in a point of it overlap once one of them moves along the line one way or the other.
void PatchTrimming::seams(const Feature& contact, std::vector<Feature>& out) const {
    out.clear();
    const Shape &A = scene.robot, &O = scene.obstacles;
    if (at_reference.empty() || A.layer[contact.robot] != reference_layer) return;
    const Index a = O.v[contact.obstacle], b = O.w[contact.obstacle];
    const auto between = [&](const std::vector<double>& near, const std::vector<Int>& along, const std::vector<Int>& across,
                             Index o) {
        return near[o] == near[a] && across[o] == across[a] && (along[a] < along[o]) == (along[o] < along[b]) &&
               along[o] != along[a] && along[o] != along[b];
    };
    const bool is_level = O.Y[a] == O.Y[b];
    for (Index o = 0; o < O.ring_vertices; ++o)
        if (O.layer[o] != reference_layer && (is_level ? between(O.y, O.X, O.Y, o) : between(O.x, O.Y, O.X, o)))
            out.push_back({Kind::vertex_vertex, at_reference.front(), o});
    // in the order of their places, each once: not in that of the input
    std::sort(out.begin(), out.end(), [&](const Feature& x, const Feature& y) {
        const auto& along = is_level ? O.X : O.Y;
        return along[x.obstacle] < along[y.obstacle];
    });
    const auto is_same = [&](const Feature& x, const Feature& y) { return O.point[x.obstacle] == O.point[y.obstacle]; };
    out.erase(std::unique(out.begin(), out.end(), is_same), out.end());
}

void PatchTrimming::pillars_near(Index feature, Shadows& out) const {
    std::vector<Index> near;
    neighbours.near(feature, near);
    out.around(feature, near, neighbours.reach());
}

void PatchTrimming::trim(Index patch, Scratch& with, std::vector<Trapezoid>& out, std::vector<Trapezoid>& thin,
                         Count& count) const {
    Shadows& near = with.near;
    const Feature contact = patches.contact(patch);
    std::vector<Feature> before_it = owners.before(contact);
    if (scene.is_round) return trim_round(patch, near, before_it, out, thin, count);
    // owners elsewhere on the line share nothing
    const auto is_apart = [&](const Feature& owner) {
        return !edge_box(scene.obstacles, owner.obstacle).meets(edge_box(scene.obstacles, contact.obstacle));
    };
    if (contact.kind == Kind::vertex_edge) std::erase_if(before_it, is_apart);
    const Range range = range_of(scene, contact, count.decisions);
    std::vector<Feature> touching;
    seams(contact, touching);
    const std::size_t before = out.size();
    for (int r = 0; r < range.count; ++r) {
        const Surface surface{contact, range.chart[r]};
        Event from = range.from[r], to = range.to[r];
        if (near.cover_at_once(surface, from, to)) {
            ++count.pairs;
            continue;
        }
        const auto& pillars = near.on(surface, from.lo, to.hi);
        Trimmer trimmer(scene, surface, from, to, std::move(with.lists));
        for (const Feature& owner : before_it) {
            const Range shared = range_of(scene, owner, count.decisions);
            for (int s = 0; s < shared.count; ++s)
                if (shared.chart[s] == range.chart[r]) trimmer.cede(owner, shared.from[s], shared.to[s]);
        }
        for (const Shadows::Pillar& pillar : pillars) {
            if (trimmer.empty()) break;
            ++count.pairs;
            trimmer.left(near.slices);
            const Slices::Part part = near.part(pillar);
            if (part.empty()) continue;
            heed_stop();
            trimmer.cover(pillar.p, pillar.k, near.slices, part);
        }
        for (const Feature& helix : touching) trimmer.split(helix);
        trimmer.finish(patch, out, thin);
        count.decisions += trimmer.decide.counters;
        with.lists = trimmer.released();
    }
    count.live_patches += out.size() > before;
}

// The same among grown shapes, by all pillars near the patch.
void PatchTrimming::trim_round(Index patch, const Shadows& near, const std::vector<Feature>& before_it, std::vector<Trapezoid>& out,
                               std::vector<Trapezoid>& thin, Count& count) const {
    const Feature contact = patches.contact(patch);
    if (is_circle(contact) && have_equal_radii(scene, contact.robot, contact.obstacle)) return;
    const Range range = range_of(scene, contact, count.decisions);
    const std::size_t before = out.size();
    const std::vector<Index> edges = owners.edges_at(contact.obstacle);
    const std::vector<NearFillet> fillets = fillets_near(scene, contact, reach());
    std::vector<RoundShadows::Sum> sums;
    for (const auto& [fillet, of_robot, vertex, directions] : fillets) {
        const std::vector<Index> around(fillet->vertex.begin(), fillet->vertex.end());
        sums.push_back(of_robot ? RoundShadows::Sum{std::vector{vertex}, around} : RoundShadows::Sum{around, std::vector{vertex}});
    }
    RoundShadows shadows(scene, contact, near.pieces(), sums);
    for (int r = 0; r < range.count; ++r) {
        RoundTrimmer trimmer(scene, {contact, range.chart[r]}, range.from[r], range.to[r], edges);
        for (const Feature& owner : before_it) {
            const Range shared = range_of(scene, owner, count.decisions);
            for (int s = 0; s < shared.count; ++s) {
                if (shared.chart[s] != range.chart[r]) continue;
                if (is_circle(owner)) trimmer.cede_circle(owner);
                else trimmer.cede(owner, shared.from[s], shared.to[s]);
            }
        }
        if (!trimmer.empty()) shadows.cut(range.chart[r], range.from[r].lo, range.to[r].hi);
        for (std::size_t n = 0; n < near.pieces().size(); ++n)
            for (Index p = 0; p < scene.robot.pieces() && !trimmer.empty(); ++p) {
                const Index k = near.pieces()[n];
                if (scene.robot.piece_layer[p] != scene.obstacles.piece_layer[k] || shadows.is_own(p, n)) continue;
                const Slices::Part part = shadows.part(p, n);
                if (part.empty()) continue;
                ++count.pairs;
                heed_stop();
                trimmer.cover(p, k, shadows.slices, part);
            }
        for (std::size_t n = 0; n < fillets.size() && !trimmer.empty(); ++n) {
            const Slices::Part part = shadows.part_of_sum(n);
            if (part.empty()) continue;
            ++count.pairs;
            heed_stop();
            const auto& [fillet, of_robot, vertex, directions] = fillets[n];
            trimmer.cover_fillet(*fillet, of_robot, vertex, directions, shadows.slices, part);
        }
        trimmer.split_at_touches(near.pieces());
        trimmer.finish(patch, out, thin);
        count.decisions += trimmer.decide.counters;
    }
    count.live_patches += out.size() > before;
}

}  // namespace cfree
