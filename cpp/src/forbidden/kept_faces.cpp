// Match the trapezoids of two boundaries by the patches that hold in both; theory, "Closed surfaces".
#include "forbidden/kept_faces.hpp"

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
    const std::size_t half_edges = other.face.size();
    std::vector<char> has_changed(static_cast<std::size_t>(other.edges), 0);
    for (std::size_t h = 0; h < half_edges; ++h) has_changed[other.edge[h]] |= faces.now[other.face[h]] < 0;
    std::vector<char> is_inner_before(other.component.size());
    for (std::size_t f = 0; f < is_inner_before.size(); ++f) is_inner_before[f] = faces.now[f] >= 0;
    for (std::size_t h = 0; h < half_edges; ++h)
        if (has_changed[other.edge[h]]) is_inner_before[other.face[h]] = 0;
    faces.is_border_edge.assign(has_changed.size(), 0);
    for (std::size_t h = 0; h < half_edges; ++h)
        if (!is_inner_before[other.face[h]] && faces.now[other.face[h]] >= 0) faces.is_border_edge[other.edge[h]] = 1;
    const std::size_t count = boundary.trapezoids.size();
    std::vector<char> is_chosen(count, 1);
    faces.is_inner.assign(count, 0);
    for (std::size_t f = 0; f < count; ++f)
        if (faces.before[f] >= 0) faces.is_inner[f] = is_inner_before[faces.before[f]], is_chosen[f] = !faces.is_inner[f];
    for (std::size_t h = 0; h < half_edges; ++h)
        if (faces.is_border_edge[other.edge[h]] && is_inner_before[other.face[h]]) is_chosen[faces.now[other.face[h]]] = 1;
    for (std::size_t f = 0; f < count; ++f)
        if (is_chosen[f]) faces.chosen.push_back(static_cast<Index>(f));
    return faces;
}

}  // namespace cfree
