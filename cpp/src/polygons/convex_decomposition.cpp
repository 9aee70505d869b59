// Remove diagonals while both sides stay convex, the least useful first; docs/inside-the-core.md.
#include "cfree/polygons/convex_decomposition.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "cfree/polygons/constrained_delaunay.hpp"
#include "cfree/polygons/segment_sweep.hpp"

namespace cfree {

namespace {

using IndexRings = std::vector<std::vector<Index>>;

// Rings of vertices, including points of other rings that touch an edge.
IndexRings outline(const Polygon& polygon) {
    const Points& v = polygon.vertices;
    const RingLinks links(polygon.offsets);
    std::vector<Index> names(static_cast<std::size_t>(v.size()));
    std::iota(names.begin(), names.end(), 0);
    std::vector<std::pair<Index, Index>> touching;
    if (polygon.offsets.size() > 2) {
        const auto order = swept_order(v);
        for (std::size_t k = 1; k < order.size(); ++k)
            if (v.same(order[k - 1], order[k])) names[order[k]] = names[order[k - 1]];
        touching = std::get<Nesting>(sweep(v, polygon.offsets)).touching;  // rings of a polygon do not cross
        for (auto& [edge, point] : touching) point = names[point];
        std::sort(touching.begin(), touching.end(), [&](const auto& a, const auto& b) {
            return a.first != b.first ? a.first < b.first : v.before(a.second, b.second);
        });
        touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
    }
    IndexRings rings(polygon.offsets.size() - 1);
    auto first = touching.begin();
    for (Index k = 0; k < v.size(); ++k) {
        auto& ring = rings[links.ring[k]];
        ring.push_back(names[k]);
        auto beyond = first;
        while (beyond != touching.end() && beyond->first == k) ++beyond;
        const auto on_edge = static_cast<std::ptrdiff_t>(ring.size());
        for (; first != beyond; ++first) ring.push_back(first->second);
        if (!v.before(k, links.next[k])) std::reverse(ring.begin() + on_edge, ring.end());
    }
    return rings;
}

// Order of diagonals by the number of reflex vertices that each of them removes alone, longer ones first.
class Usefulness {
public:
    Usefulness(const Points& points, const IndexRings& rings) : v(points), around(static_cast<std::size_t>(points.size())) {
        for (const auto& ring : rings)
            for (std::size_t k = 0; k < ring.size(); ++k)
                around[ring[k]] = {ring[k ? k - 1 : ring.size() - 1], ring[k + 1 < ring.size() ? k + 1 : 0]};
    }

    struct Diagonal {
        Index a, b, edge;  // ends, a < b, and its half-edge from a
        int cured;
    };
    Diagonal of(Index a, Index b, Index edge) const { return {a, b, edge, cures(a, b) + cures(b, a)}; }
    bool operator()(const Diagonal& d, const Diagonal& e) const {
        if (d.cured != e.cured) return d.cured < e.cured;
        if (const int order = v.compare_lengths(d.a, d.b, e.a, e.b)) return order > 0;
        return std::pair(d.a, d.b) < std::pair(e.a, e.b);
    }

private:
    const Points& v;
    std::vector<std::pair<Index, Index>> around;  // the vertices before and after

    bool cures(Index a, Index b) const {
        const auto [before, after] = around[a];
        return v.orient(before, a, after) < 0 && v.orient(before, a, b) >= 0 && v.orient(b, a, after) >= 0;
    }
};

// Face without straight vertices, from its least index on.
std::vector<Index> corners_only(const Points& v, const std::vector<Index>& face) {
    std::vector<Index> corners;
    const std::size_t n = face.size();
    for (std::size_t k = 0; k < n; ++k)
        if (v.orient(face[k ? k - 1 : n - 1], face[k], face[k + 1 < n ? k + 1 : 0]) != 0) corners.push_back(face[k]);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

// Faces left after removing diagonals while both their ends stay convex.
Pieces merged(const Points& v, const IndexRings& rings, const Cover& cover) {
    const std::vector<Index>& twin = cover.twin;
    const auto count = static_cast<Index>(twin.size());
    const auto origin = [&triangles = cover.triangles](Index h) { return triangles[h / 3][h % 3]; };
    std::vector<Index> following, preceding;
    for (Index h = 0; h < count; ++h)
        following.push_back(h % 3 < 2 ? h + 1 : h - 2), preceding.push_back(h % 3 ? h - 1 : h + 2);
    const Usefulness usefulness(v, rings);
    std::vector<Usefulness::Diagonal> diagonals;
    for (Index h = 0; h < count; ++h)
        if (twin[h] >= 0 && origin(h) < origin(twin[h])) diagonals.push_back(usefulness.of(origin(h), origin(twin[h]), h));
    std::sort(diagonals.begin(), diagonals.end(), std::cref(usefulness));

    // the corner at the origin of h, without h and its reverse (below 2 pi, as at every vertex)
    const auto is_convex_without = [&](Index h, Index back) {
        return v.orient(origin(preceding[h]), origin(h), origin(following[following[back]])) >= 0;
    };
    std::vector<char> alive(twin.size(), 1);
    for (const auto& diagonal : diagonals) {
        const Index h = diagonal.edge, back = twin[h];
        if (!is_convex_without(h, back) || !is_convex_without(back, h)) continue;
        for (const auto& [one, other] : {std::pair(h, back), std::pair(back, h)}) {
            following[preceding[one]] = following[other];
            preceding[following[other]] = preceding[one];
            alive[one] = 0;
        }
    }
    Pieces pieces;
    std::vector<Index> face;
    for (Index first = 0; first < count; ++first) {
        face.clear();
        for (Index h = first; alive[h]; h = following[h]) alive[h] = 0, face.push_back(origin(h));
        if (!face.empty()) pieces.push_back(corners_only(v, face));
    }
    std::sort(pieces.begin(), pieces.end());
    return pieces;
}

}  // namespace

Pieces convex_pieces(const Polygon& polygon) {
    if (polygon.is_convex()) {
        Pieces one(1, std::vector<Index>(static_cast<std::size_t>(polygon.vertices.size())));
        std::iota(one[0].begin(), one[0].end(), 0);
        return one;
    }
    const IndexRings rings = outline(polygon);
    return merged(polygon.vertices, rings, constrained_delaunay(polygon.vertices, rings));
}

}  // namespace cfree
