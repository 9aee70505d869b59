// Match the trapezoids of two boundaries by the patches that hold in both; theory, "Closed surfaces".
#include "forbidden/kept_faces.hpp"

#include <algorithm>

#include "forbidden/kept_patches.hpp"
#include "forbidden/patch_trimming.hpp"

namespace cfree {

namespace {

// True if two rows have the same angles. Their patches hold in both scenes, so they always do, unless a boundary was computed
// by another version.
bool have_same_angles(const Trapezoids& s, Index k, const Trapezoids& t, Index m) {
    return s.chart[k] == t.chart[m] && s.from_lo[k] == t.from_lo[m] && s.from_hi[k] == t.from_hi[m] && s.to_lo[k] == t.to_lo[m] &&
           s.to_hi[k] == t.to_hi[m];
}

// Match the rows of each obstacle feature whose patches hold in both scenes.
bool match_rows(KeptFaces& faces, const Boundary& other, const Boundary& boundary) {
    const Scene& scene = boundary.scene->near();
    const std::optional<KeptPatches> kept = kept_patches(other, scene);
    if (!kept) return false;
    const Trapezoids &s = other.trapezoids, &t = boundary.trapezoids;
    faces.before.assign(t.size(), -1), faces.now.assign(s.size(), -1);
    const std::vector<Index> first = first_rows(t, boundary.patches, first_patches(scene, boundary.patches));
    bool is_any = false;
    for (std::size_t j = 0; j < kept->from.size(); ++j) {
        const Index from = kept->from[j];
        if (from < 0) continue;
        const Index begin = kept->live.first[from], count = kept->live.first[from + 1] - begin;
        bool are_same = count == first[j + 1] - first[j];
        for (Index k = 0; are_same && k < count; ++k) are_same = have_same_angles(s, begin + k, t, first[j] + k);
        for (Index k = 0; are_same && k < count; ++k) faces.before[first[j] + k] = begin + k, faces.now[begin + k] = first[j] + k;
        is_any |= are_same && count > 0;
    }
    return is_any;
}

}  // namespace

std::optional<KeptFaces> kept_faces(const CellComplex& other, const Boundary& boundary) {
    KeptFaces faces;
    if (!match_rows(faces, *other.boundary, boundary)) return {};
    const std::size_t count = boundary.trapezoids.size(), count_before = faces.now.size();
    const auto any_edge = [&](std::size_t f, auto&& holds) {
        return std::any_of(other.edge.begin() + other.first[f], other.edge.begin() + other.first[f + 1], holds);
    };
    const auto mark_edges = [&](std::size_t f, std::vector<char>& marked) {
        for (Index h = other.first[f]; h < other.first[f + 1]; ++h) marked[other.edge[h]] = 1;
    };
    std::vector<char> has_changed(static_cast<std::size_t>(other.edges), 0), is_inner_before(count_before, 0);
    for (std::size_t f = 0; f < count_before; ++f)
        if (faces.now[f] < 0) mark_edges(f, has_changed);
    for (std::size_t f = 0; f < count_before; ++f)
        is_inner_before[f] = faces.now[f] >= 0 && !any_edge(f, [&](Index e) { return has_changed[e]; });
    faces.is_border_edge.assign(has_changed.size(), 0);
    for (std::size_t f = 0; f < count_before; ++f)
        if (!is_inner_before[f] && faces.now[f] >= 0) mark_edges(f, faces.is_border_edge);
    std::vector<char> is_chosen(count, 1);
    faces.is_inner.assign(count, 0);
    for (std::size_t f = 0; f < count_before; ++f)
        if (is_inner_before[f]) {
            faces.is_inner[faces.now[f]] = 1;
            is_chosen[faces.now[f]] = any_edge(f, [&](Index e) { return faces.is_border_edge[e]; });
        }
    for (std::size_t f = 0; f < count; ++f)
        if (is_chosen[f]) faces.chosen.push_back(static_cast<Index>(f));
    return faces;
}

}  // namespace cfree
