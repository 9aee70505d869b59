// Match the polygons of two scenes, and find the features beyond the robot's reach of those that are in one only; theory,
// "The trimmed boundary".
#include "forbidden/kept_patches.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

#include "collision/shape_boxes.hpp"
#include "forbidden/patch_trimming.hpp"

namespace cfree {

namespace {

// Ring vertices and pieces that refer to each other only: a polygon, the ring of the bounds, or one piece outside of these.
struct Block {
    Index begin, end;           // ring vertices
    std::vector<Index> pieces;
};

std::vector<Block> blocks(const Shape& s) {
    // last vertex that is in a ring or a piece with each vertex
    std::vector<Index> last(static_cast<std::size_t>(s.ring_vertices));
    std::iota(last.begin(), last.end(), 0);
    const auto link = [&](Index v, Index w) { last[std::min(v, w)] = std::max(last[std::min(v, w)], std::max(v, w)); };
    for (Index v = 0; v < s.ring_vertices; ++v) link(v, s.previous[v]);
    const auto is_in_ring = [&](Index k) { return s.piece_vertex[s.piece[k]] < s.ring_vertices; };
    for (Index k = 0; k < s.pieces(); ++k)
        for (Index n = s.piece[k] + 1; is_in_ring(k) && n < s.piece[k + 1]; ++n) link(s.piece_vertex[n - 1], s.piece_vertex[n]);
    std::vector<Block> result;
    std::vector<Index> block(last.size());
    for (Index v = 0, end = 0; v < s.ring_vertices; ++v) {
        if (v == end) result.push_back({v, v, {}});
        end = std::max(end, last[v] + 1);
        result.back().end = end, block[v] = static_cast<Index>(result.size()) - 1;
    }
    for (Index k = 0; k < s.pieces(); ++k) {
        if (is_in_ring(k)) result[block[s.piece_vertex[s.piece[k]]]].pieces.push_back(k);
        else result.push_back({0, 0, {k}});
    }
    return result;
}

std::size_t hash_of(const Shape& s, const Block& block) {
    std::uint64_t h = 0;
    const auto add = [&](Index v) {
        for (const double c : {s.xy[2 * v], s.xy[2 * v + 1]}) h = (h ^ bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
    };
    for (Index v = block.begin; v < block.end; ++v) add(v);
    if (block.begin == block.end)
        for (Index n = s.piece[block.pieces[0]]; n < s.piece[block.pieces[0] + 1]; ++n) add(s.piece_vertex[n]);
    return static_cast<std::size_t>(h);
}

// Obstacles or robots of two scenes, and integers that make their coordinates equal if they are multiplied by these.
struct Two {
    const Shape &s, &t;
    const Int &s_factor, &t_factor;
    bool are_same_place(Index v, Index w) const {
        if (s_factor == t_factor) return s.X[v] == t.X[w] && s.Y[v] == t.Y[w];
        return s.X[v] * s_factor == t.X[w] * t_factor && s.Y[v] * s_factor == t.Y[w] * t_factor;
    }
};

// True if two blocks are the same but for numbers.
bool are_same(const Two& both, const Block& b, const Block& c) {
    const Shape &s = both.s, &t = both.t;
    if (b.end - b.begin != c.end - c.begin || b.pieces.size() != c.pieces.size()) return false;
    const auto is_same_place = [&](Index v, Index w) { return both.are_same_place(v, w); };
    for (Index v = b.begin, w = c.begin; v < b.end; ++v, ++w)
        if (!is_same_place(v, w) || s.previous[v] - b.begin != t.previous[w] - c.begin || s.convex[v] != t.convex[w] ||
            s.emit[v] != t.emit[w] || s.layer[v] != t.layer[w])
            return false;
    for (std::size_t n = 0; n < b.pieces.size(); ++n) {
        const Index p = b.pieces[n], q = c.pieces[n];
        if (s.piece[p + 1] - s.piece[p] != t.piece[q + 1] - t.piece[q] || s.piece_layer[p] != t.piece_layer[q]) return false;
        for (Index k = s.piece[p], m = t.piece[q]; k < s.piece[p + 1]; ++k, ++m) {
            const Index v = s.piece_vertex[k], w = t.piece_vertex[m];
            if (b.begin == b.end ? !is_same_place(v, w) : v - b.begin != w - c.begin) return false;
        }
    }
    return true;
}

// Features of one shape in another.
struct Matching {
    std::vector<Index> vertex, edge;  // of the second shape by those of the first; -1: none
    std::vector<Index> ring_vertex;   // of the first shape by those of the second
    std::vector<Box> changed;         // pieces that are in one shape only
};

// Boxes of the first shape are multiplied by a factor.
Matching matching(const Two& both, double box_factor) {
    const Shape &s = both.s, &t = both.t;
    Matching result{std::vector<Index>(s.x.size(), -1), std::vector<Index>(s.v.size(), -1),
                    std::vector<Index>(static_cast<std::size_t>(t.ring_vertices), -1), {}};
    const auto ours = blocks(s), theirs = blocks(t);
    std::unordered_map<std::size_t, std::vector<std::size_t>> by_hash;  // those not matched yet, the last first
    for (std::size_t b = ours.size(); b-- > 0;) by_hash[hash_of(s, ours[b])].push_back(b);
    std::vector<char> is_matched(ours.size(), 0);
    const auto our_boxes = piece_boxes(s), their_boxes = piece_boxes(t);
    for (const Block& c : theirs) {
        const auto same_hash = by_hash.find(hash_of(t, c));
        std::size_t b = ours.size();
        if (same_hash != by_hash.end()) {
            auto& list = same_hash->second;
            const auto match = std::find_if(list.rbegin(), list.rend(), [&](std::size_t x) { return are_same(both, ours[x], c); });
            if (match != list.rend()) b = *match, list.erase(std::next(match).base());
        }
        if (b == ours.size()) {
            for (const Index k : c.pieces) result.changed.push_back(their_boxes[k]);
            continue;
        }
        is_matched[b] = 1;
        for (Index v = ours[b].begin, w = c.begin; w < c.end; ++v, ++w)
            result.vertex[v] = w, result.edge[v] = w, result.ring_vertex[w] = v;
        for (std::size_t n = 0; n < c.pieces.size(); ++n)
            for (Index k = s.piece[ours[b].pieces[n]], m = t.piece[c.pieces[n]]; m < t.piece[c.pieces[n] + 1]; ++k, ++m)
                result.vertex[s.piece_vertex[k]] = t.piece_vertex[m], result.edge[s.piece_edge[k]] = t.piece_edge[m];
    }
    for (std::size_t b = 0; b < ours.size(); ++b)
        if (!is_matched[b])
            for (const Index k : ours[b].pieces) {
                const Box& x = our_boxes[k];
                result.changed.push_back(grown({x.x0 * box_factor, x.y0 * box_factor, x.x1 * box_factor, x.y1 * box_factor}));
            }
    return result;
}

// Of vertices of one place and of edges that overlap, the order decides which own what they share: let go of all of them if
// it has changed.
void release_reordered(const Shape& t, std::vector<Index>& from) {
    const std::vector<Index> all = from;
    std::vector<Index> order(from.size()), members;
    const auto release = [&] {
        std::sort(members.begin(), members.end());
        Index last = -1;
        bool is_reordered = false;
        for (const Index j : members)
            if (all[j] >= 0) is_reordered |= all[j] < last, last = all[j];
        for (const Index j : members)
            if (is_reordered) from[j] = -1;
        members.clear();
    };
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index v, Index w) { return t.point[v] < t.point[w]; });
    for (const Index v : order) {
        if (!members.empty() && t.point[v] != t.point[members.back()]) release();
        members.push_back(v);
    }
    release();
    const auto boxes = edge_boxes(t);
    std::sort(order.begin(), order.end(), [&](Index e, Index f) {
        if (t.line[e] != t.line[f]) return t.line[e] < t.line[f];
        return boxes[e].x0 != boxes[f].x0 ? boxes[e].x0 < boxes[f].x0 : boxes[e].y0 < boxes[f].y0;
    });
    Box around;
    for (const Index e : order) {
        if (!members.empty() && !(t.line[e] == t.line[members.back()] && around.meets(boxes[e]))) release(), around = {};
        members.push_back(e), around.add(boxes[e]);
    }
    release();
}

bool are_same_robots(const Two& both) {
    const Shape &s = both.s, &t = both.t;
    if (s.previous != t.previous || s.layer != t.layer || s.piece != t.piece || s.piece_vertex != t.piece_vertex) return false;
    for (Index v = 0; v < static_cast<Index>(s.X.size()); ++v)
        if (!both.are_same_place(v, v)) return false;
    return true;
}

// True if the doubles of one scene, in which it is trimmed, are those of the other times a power of two, which leaves signs,
// errors and mantissas as they are unless something underflows.
bool have_same_doubles(const Scene& s, const Scene& t) {
    constexpr int most = 64;  // bits below 1, so that products of eight do not underflow
    const bool may_underflow = short_shift(s) > most || short_shift(t) > most;
    return s.short_part == t.short_part && (!may_underflow || (s.scale == t.scale && s.shift == t.shift));
}

std::vector<Index> members(const std::vector<Index>& group, const std::vector<Index>& other) {
    std::vector<Index> result;
    for (std::size_t k = 0; k < group.size(); ++k) {
        if (static_cast<std::size_t>(group[k]) >= result.size()) result.resize(static_cast<std::size_t>(group[k]) + 1, -1);
        if (other[k] >= 0) result[group[k]] = other[k];
    }
    return result;
}

}  // namespace

std::vector<Index> first_rows(const Trapezoids& rows, const Patches& patches, const std::vector<Index>& first_patch) {
    std::vector<Index> first(first_patch.size(), 0);
    for (const Index patch : rows.patch) ++first[patches.obstacle[patch] + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    return first;
}

std::optional<KeptFeatures> kept_features(const Scene& before, const Scene& scene) {
    const Shape &s = before.obstacles, &t = scene.obstacles;
    if (before.is_round || scene.is_round || !have_same_doubles(before, scene) ||
        !are_same_robots({before.robot, scene.robot, scene.scale, before.scale}))
        return {};
    Matching match = matching({s, t, scene.scale, before.scale}, before.unit() / scene.unit());
    const BoxTree changed(match.changed);
    const double reach = diagonal(scene.robot);
    KeptFeatures kept{std::move(match.ring_vertex), members(s.point, match.vertex), members(s.line, match.edge), &s};
    if (!std::is_sorted(kept.from.begin(), kept.from.end())) release_reordered(t, kept.from);
    for (Index j = 0; j < t.ring_vertices; ++j)
        // twice, for the rounding of both scenes
        if (kept.from[j] >= 0) changed.query(grown(grown(edge_box(t, j), reach)), [&](Index) { kept.from[j] = -1; });
    return kept;
}

std::uint64_t KeptFeatures::renamed(std::uint64_t code) const {
    Feature f = unpacked(code);
    if (f.kind == Kind::none) return code;
    const bool is_vertex = f.kind == Kind::vertex_vertex || f.kind == Kind::edge_vertex;
    f.obstacle = is_vertex ? points[other->point[f.obstacle]] : lines[other->line[f.obstacle]];
    if (f.obstacle < 0) throw std::logic_error("a patch that is kept is named by a feature that has changed");
    return packed(f);
}

std::optional<KeptPatches> kept_patches(const Boundary& other, const Scene& scene) {
    const Scene& before = other.scene->near();
    if (!other.thin) return {};
    auto features = kept_features(before, scene);
    if (!features) return {};
    KeptPatches kept{std::move(*features), {}, {}, {}, {}};
    kept.first_patch = first_patches(before, other.patches);
    for (Index j = 0; j < static_cast<Index>(kept.from.size()); ++j) {
        Index& from = kept.from[j];
        for (Index p = from < 0 ? 0 : kept.first_patch[from]; from >= 0 && p < kept.first_patch[from + 1]; ++p)
            if (!other.trimmed[p]) from = -1;
        if (from < 0) kept.retrimmed.push_back(j);
    }
    kept.live = {&other.trapezoids, first_rows(other.trapezoids, other.patches, kept.first_patch)};
    kept.thin = {&*other.thin, first_rows(*other.thin, other.patches, kept.first_patch)};
    return kept;
}

void KeptPatches::add(Index feature, Index patch, Trapezoids& live_out, Trapezoids& thin_out) const {
    const Index before = from[feature];
    for (const auto& [rows, out] : {std::pair{&live, &live_out}, std::pair{&thin, &thin_out}})
        for (Index k = rows->first[before]; k < rows->first[before + 1]; ++k) {
            out->push_row(*rows->columns, k);
            out->patch.back() += patch - first_patch[before];
            for (auto* column : out->features()) column->back() = renamed(column->back());
        }
}

}  // namespace cfree
