// Glue sides around edges, merge equal parts, and nest cells; theory, "Arrangement".
#include "cfree/arrangement/arrangement.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "arrangement/touching_points.hpp"
#include "forbidden/curve_sides.hpp"
#include "forbidden/level_sides.hpp"
#include "forbidden/loops.hpp"
#include "support/parallel.hpp"
#include "support/union_find.hpp"

namespace cfree {

namespace {

class Assembly {
public:
    Assembly(Sheets&& sheets, int t)
        : boundary(*sheets.boundary), threads(t), n(boundary.trapezoids.size()), loops(glued()) {
        result.sheets = std::move(sheets);
    }

    Arrangement run(std::int64_t most_vertices) {
        join_around_edges();
        find_faces();
        find_touching_points();
        find_vertices(most_vertices);
        find_edges();
        find_cells();
        return std::move(result);
    }

private:
    Loops glued();
    Side side(Index h) const { return static_cast<Side>(loops.kind[h] / 2); }
    bool is_level(Index h) const { return side(h) == Side::first || side(h) == Side::last; }
    bool is_against(Index h) const { return loops.kind[h] % 2 != 0; }
    Index next(Index h) const { return h + 1 == loops.first[loops.face[h] + 1] ? loops.first[loops.face[h]] : h + 1; }
    // Corners of faces at the two ends of an edge.
    Index at_start(Index h) const { return is_against(h) ? next(h) : h; }
    Index at_end(Index h) const { return is_against(h) ? h : next(h); }
    // Side of a sheet, 0 outer, 1 inner, that faces the next sheet around the edge.
    int side_after(Index h) const {
        const bool backwards = is_against(h) == is_forwards(side(h));
        return side(h) == Side::upper || (side(h) == Side::first && !backwards) || (side(h) == Side::last && backwards) ? 0 : 1;
    }
    Index set_at(Index trapezoid, int of_side) const {
        return (of_side == 0 ? result.sheets.outer : result.sheets.inner)[trapezoid];
    }
    bool is_spurious(Index h) const;
    bool goes_on(Index h, Index other) const;
    std::vector<std::pair<Index, Side>> signature(Index h) const;
    [[noreturn]] void refuse(Index f, Index g) const;
    void join_around_edges();
    void find_faces();
    void find_touching_points();
    void join_touching_points(const std::vector<Index>& cell);
    void find_vertices(std::int64_t most);
    void place_vertices(const std::vector<Index>& first_corner);
    void find_edges();
    void find_cells();

    const Boundary& boundary;
    const int threads;
    const std::size_t n;
    Loops loops;
    Arrangement result;
    std::vector<Index> first_of;                // one half-edge of each edge of the loops
    UnionFind sides{0}, fans{0}, corners{0};    // classes of sides of trapezoids, of corners on each side, of corners
    std::vector<Index> corner_class, vertex;    // each corner's class; each class's vertex, -1 if none
    std::vector<Index> edge_of;                 // each loop edge's number; -1 within a face
    Index corner_classes = 0;
    std::vector<Index> link;                     // each corner's class before touching points are merged
    std::vector<std::vector<Index>> touching;    // classes of links that touch
    std::vector<char> is_touching;               // one per class of corners
};

Loops Assembly::glued() {
    const Whole whole(n, 1);
    boundary.angles(threads);
    std::vector<Parts> lists = glue_curves(boundary, whole, Around::all, threads);
    std::vector<Parts> levels = glue_levels(boundary, whole, Around::all, threads);
    std::move(levels.begin(), levels.end(), std::back_inserter(lists));
    return loops_of(n, std::move(lists));
}

// Throws std::domain_error: the two sides of a sector have different cells.
void Assembly::refuse(Index f, Index g) const {
    std::string names;
    const Sheets& sheets = result.sheets;
    for (const Index k : {f, g})
        for (const Index pair : sheets.sets[sheets.owners[k]])
            names += (names.empty() ? "(" : ", (") + std::to_string(pair / sheets.columns) + ", " + std::to_string(pair % sheets.columns) + ")";
    throw std::domain_error("surfaces of the pairs " + names + " (polygon of the robot, obstacle) meet in a way that is not decided");
}

// Join the two sides of each sector around an edge: it lies in one cell.
void Assembly::join_around_edges() {
    const auto count = loops.face.size();
    sides = UnionFind(2 * n), fans = UnionFind(2 * count), corners = UnionFind(count);
    UnionFind components(n);
    first_of.assign(static_cast<std::size_t>(loops.edges), -1);
    for (Index h = 0; h < static_cast<Index>(count); ++h) {
        if (first_of[loops.edge[h]] < 0) first_of[loops.edge[h]] = h;
        const Index y = loops.twin[h], f = loops.face[h], g = loops.face[y];
        const int after = side_after(h), before = 1 - side_after(y);
        if (set_at(f, after) != set_at(g, before))
            refuse(f, g);
        sides.unite(2 * f + after, 2 * g + before);
        components.unite(f, g);
        for (const auto& [p, q] : {std::pair{at_start(h), at_start(y)}, std::pair{at_end(h), at_end(y)}}) {
            fans.unite(2 * p + after, 2 * q + before);
            corners.unite(p, q);
        }
    }
    components.number(result.component);
}

// True for an edge at which a sheet just continues.
bool Assembly::is_spurious(Index h) const {
    const Index y = loops.twin[h];
    if (y == h || loops.twin[y] != h) return false;
    const Index f = loops.face[h], g = loops.face[y];
    const auto& patch = boundary.trapezoids.patch;
    return patch[f] == patch[g] && set_at(f, 0) == set_at(g, 0) && set_at(f, 1) == set_at(g, 1);
}

void Assembly::find_faces() {
    UnionFind joined(n);
    for (const Index h : first_of)
        if (is_spurious(h)) joined.unite(loops.face[h], loops.face[loops.twin[h]]);
    const Index faces = joined.number(result.face_of);
    result.face_euler.assign(static_cast<std::size_t>(faces), 0), result.face_first.assign(static_cast<std::size_t>(faces), -1);
    for (std::size_t k = 0; k < n; ++k) {
        ++result.face_euler[result.face_of[k]];
        if (Index& first = result.face_first[result.face_of[k]]; first < 0) first = static_cast<Index>(k);
    }
    for (const Index h : first_of)
        if (is_spurious(h)) --result.face_euler[result.face_of[loops.face[h]]];
}

// Patches around an edge, and their sides on which it is.
std::vector<std::pair<Index, Side>> Assembly::signature(Index h) const {
    std::vector<std::pair<Index, Side>> of;
    Index x = h;
    do of.push_back({boundary.trapezoids.patch[loops.face[x]], side(x)}), x = loops.twin[x];
    while (x != h);
    std::sort(of.begin(), of.end());
    return of;
}

// True if two edges that meet at a point without other edges are one.
bool Assembly::goes_on(Index h, Index other) const {
    return h == other || (is_level(h) == is_level(other) && signature(h) == signature(other));
}

// Find points with several links, which are the parts around a point that edges connect.
void Assembly::find_touching_points() {
    const Index links = corners.number(link);
    std::vector<PieceCorner> of_link(static_cast<std::size_t>(links), {-1, false, false});
    for (Index h = 0; h < static_cast<Index>(link.size()); ++h) {
        PieceCorner& corner = of_link[link[h]];
        const Index before = h == loops.first[loops.face[h]] ? loops.first[loops.face[h] + 1] - 1 : h - 1;
        if (corner.trapezoid >= 0 || side(before) == side(h)) continue;  // a piece has a corner at the start of one side
        const Side begins = side(h);
        corner = {loops.face[h], begins == Side::last || begins == Side::lower, begins == Side::upper || begins == Side::last};
    }
    touching = touching_points(boundary, of_link, threads);
    std::vector<Index> first(static_cast<std::size_t>(links), -1);
    for (Index h = 0; h < static_cast<Index>(link.size()); ++h)
        if (first[link[h]] < 0) first[link[h]] = h;
    for (const auto& links_there : touching)
        for (const Index other : links_there) corners.unite(first[links_there[0]], first[other]);
    corner_classes = corners.number(corner_class);
    is_touching.assign(static_cast<std::size_t>(corner_classes), 0);
    for (const auto& links_there : touching) is_touching[corner_class[first[links_there[0]]]] = 1;
}

// Merge touching points. If r links are in one place, the Euler number of a cell among them counts r - 1 fewer: its boundary,
// pushed inwards, is connected there.
void Assembly::join_touching_points(const std::vector<Index>& cell) {
    std::vector<Index> place(link.empty() ? 0 : static_cast<std::size_t>(*std::max_element(link.begin(), link.end())) + 1, -1);
    std::vector<std::vector<Index>> cells_of;
    std::vector<Index> face_at;
    for (const auto& links_there : touching)
        for (const Index x : links_there) place[x] = static_cast<Index>(cells_of.size()), cells_of.emplace_back(), face_at.push_back(-1);
    for (Index h = 0; h < static_cast<Index>(link.size()); ++h) {
        const Index x = place[link[h]];
        if (x < 0) continue;
        face_at[x] = loops.face[h];
        for (const int s : {0, 1}) cells_of[x].push_back(cell[result.surface[2 * loops.face[h] + s] + 1]);
    }
    for (auto& list : cells_of) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    for (const auto& links_there : touching) {
        std::vector<Index> common = cells_of[place[links_there[0]]], rest;
        for (const Index x : links_there) {
            const auto& list = cells_of[place[x]];
            rest.clear();
            std::set_intersection(common.begin(), common.end(), list.begin(), list.end(), std::back_inserter(rest));
            common.swap(rest);
        }
        if (common.size() != 1) refuse(face_at[place[links_there[0]]], face_at[place[links_there[1]]]);
        result.cell_euler[common[0]] -= static_cast<Index>(links_there.size()) - 1;
    }
}

void Assembly::find_vertices(std::int64_t most) {
    const auto classes = static_cast<std::size_t>(corner_classes);
    std::vector<Index> degree(classes, 0), first_corner(classes, -1);
    std::vector<std::array<Index, 2>> ends(classes, {-1, -1});  // edges that end there, as half-edges
    for (const Index h : first_of) {
        if (is_spurious(h)) continue;
        for (const Index c : {corner_class[at_start(h)], corner_class[at_end(h)]})
            if (degree[c]++ < 2) ends[c][degree[c] - 1] = h;
    }
    for (Index h = 0; h < static_cast<Index>(corner_class.size()); ++h) {
        // a corner with a known place: at a level, if there is one
        Index& first = first_corner[corner_class[h]];
        if (first < 0 || (is_level(h) && !is_level(first))) first = h;
    }
    vertex.assign(classes, -1);
    std::vector<Index> chosen;
    for (Index c = 0; c < corner_classes; ++c) {
        if (degree[c] == 0 && !is_touching[c]) ++result.face_euler[result.face_of[loops.face[first_corner[c]]]];
        if (!is_touching[c] && (degree[c] == 0 || (degree[c] == 2 && goes_on(ends[c][0], ends[c][1])))) continue;
        vertex[c] = static_cast<Index>(chosen.size());
        chosen.push_back(first_corner[c]);
        result.vertex_degree.push_back(degree[c]);
    }
    if (static_cast<std::int64_t>(chosen.size()) > most)
        throw std::length_error(std::to_string(chosen.size()) + " vertices, and at most " + std::to_string(most) + " are allowed");
    place_vertices(chosen);
}

void Assembly::place_vertices(const std::vector<Index>& chosen) {
    result.xy.resize(2 * chosen.size()), result.theta.resize(chosen.size());
    const double unit = boundary.scene->near().unit();
    for_each_block_in_parallel(threads, chosen.size(), [&](std::size_t v) {
        const Index h = chosen[v];
        const auto [xy, theta] = place_of(boundary, loops.face[h], side(h), loops.start[h]);
        result.xy[2 * v] = unit * xy.x, result.xy[2 * v + 1] = unit * xy.y, result.theta[v] = theta;
    });
}

// Join parts of edges that meet without a vertex; set the kinds of edges and vertices.
void Assembly::find_edges() {
    const auto count = static_cast<std::size_t>(loops.edges);
    UnionFind joined(count);
    std::vector<Index> last(static_cast<std::size_t>(corner_classes), -1);
    const auto ends_of = [&](Index e) { return std::array{corner_class[at_start(first_of[e])], corner_class[at_end(first_of[e])]}; };
    for (Index e = 0; e < loops.edges; ++e) {
        if (is_spurious(first_of[e])) continue;
        for (const Index c : ends_of(e)) {
            if (vertex[c] >= 0) continue;
            if (last[c] >= 0) joined.unite(last[c], e);
            last[c] = e;
        }
    }
    std::vector<std::vector<Index>> owners(result.theta.size());
    result.vertex_kind.assign(result.theta.size(), static_cast<std::uint8_t>(ArrangementVertex::triple));
    edge_of.assign(count, -1);
    std::vector<Index> number(count, -1), filled;
    const Trapezoids& t = boundary.trapezoids;
    for (Index e = 0; e < loops.edges; ++e) {
        if (is_spurious(first_of[e])) continue;
        const Index root = joined.find(e);
        if (root == e) {
            number[e] = static_cast<Index>(result.edge_kind.size());
            auto kind = is_level(first_of[e]) ? ArrangementEdge::segment : ArrangementEdge::crossing;
            Index x = first_of[e];
            do {
                const Index f = loops.face[x];
                const auto curve = unpacked((side(x) == Side::upper ? t.upper : t.lower)[f]);
                if (!is_level(x) && curve.kind == Kind::vertex_vertex) kind = ArrangementEdge::helix;
                result.edge_face.push_back(result.face_of[f]);
                x = loops.twin[x];
            } while (x != first_of[e]);
            result.edge_start.push_back(static_cast<Index>(result.edge_face.size()));
            result.edge_kind.push_back(static_cast<std::uint8_t>(kind));
            result.edge_vertices.insert(result.edge_vertices.end(), {-1, -1}), filled.push_back(0);
        }
        const Index edge = edge_of[e] = number[root];
        for (const Index c : ends_of(e)) {
            const Index v = vertex[c];
            if (v < 0) continue;
            result.edge_vertices[2 * edge + filled[edge]++] = v;
            const auto kind = static_cast<ArrangementEdge>(result.edge_kind[edge]);
            const auto least = kind == ArrangementEdge::segment ? ArrangementVertex::end
                               : kind == ArrangementEdge::helix ? ArrangementVertex::helix_crossing
                                                                : ArrangementVertex::triple;
            result.vertex_kind[v] = std::max(result.vertex_kind[v], static_cast<std::uint8_t>(least));
            Index x = first_of[e];
            do owners[v].push_back(result.sheets.owners[loops.face[x]]), x = loops.twin[x];
            while (x != first_of[e]);
        }
    }
    for (auto& sets : owners) {
        std::vector<Index> pairs;
        std::sort(sets.begin(), sets.end());
        sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
        for (const Index set : sets) pairs.insert(pairs.end(), result.sheets.sets[set].begin(), result.sheets.sets[set].end());
        std::sort(pairs.begin(), pairs.end());
        result.vertex_pairs.push_back(static_cast<Index>(std::unique(pairs.begin(), pairs.end()) - pairs.begin()));
    }
}

// Find closed surfaces of sides, and by rays the surfaces that bound one cell.
void Assembly::find_cells() {
    std::vector<Index>& surface = result.surface;
    const Index surfaces = sides.number(surface);
    std::vector<Index> euler(static_cast<std::size_t>(surfaces), 0);
    for (const Index s : surface) ++euler[s];
    std::vector<Index> fan;
    const Index fan_count = fans.number(fan);
    std::vector<char> seen(static_cast<std::size_t>(fan_count), 0);
    for (Index h = 0; h < static_cast<Index>(loops.face.size()); ++h) {
        --euler[surface[2 * loops.face[h] + side_after(h)]];  // the sector between it and the next
        for (const int s : {0, 1})
            if (!seen[fan[2 * h + s]]++) ++euler[surface[2 * loops.face[h] + s]];
    }
    UnionFind cells(static_cast<std::size_t>(surfaces) + 1);  // 0: the unbounded cell
    auto points = std::make_shared<PointLocation>(result.sheets.boundary, result.component);
    for (const PointLocation::Ray& ray : points->rays()) {
        Index at = 1 + surface[2 * ray.from + ray.is_on_left];
        for (const auto& [k, to_left] : points->in_order(ray.pose, ray.crossed, false)) {
            cells.unite(at, 1 + surface[2 * k + to_left]);
            at = 1 + surface[2 * k + !to_left];
        }
        cells.unite(at, 0);
    }
    std::vector<Index> cell;
    const Index count = cells.number(cell);
    result.cell_set.assign(static_cast<std::size_t>(count), -1);
    result.cell_set[0] = result.sheets.far_away;
    result.cell_euler.assign(static_cast<std::size_t>(count), 0), result.cell_surfaces.assign(static_cast<std::size_t>(count), 0);
    for (Index s = 0; s < surfaces; ++s) result.cell_euler[cell[s + 1]] += euler[s], ++result.cell_surfaces[cell[s + 1]];
    for (Index& x : result.cell_euler) x /= 2;
    join_touching_points(cell);
    for (std::size_t k = 0; k < 2 * n; ++k) {
        const auto trapezoid = static_cast<Index>(k / 2);
        Index& set = result.cell_set[cell[surface[k] + 1]];
        if (set < 0) set = set_at(trapezoid, k % 2 != 0);
        if (set != set_at(trapezoid, k % 2 != 0))
            throw std::logic_error("a cell with two depths, at piece " + std::to_string(trapezoid));
    }
    for (const Index k : result.face_first) {
        result.face_outer.push_back(cell[surface[2 * k] + 1]);
        result.face_inner.push_back(cell[surface[2 * k + 1] + 1]);
    }
    result.points = std::move(points);
}

}  // namespace

std::shared_ptr<const Arrangement> arrange(Sheets&& sheets, int threads, std::int64_t most_vertices) {
    return std::make_shared<const Arrangement>(Assembly(std::move(sheets), threads).run(most_vertices));
}

Arrangement::Place Arrangement::locate(const ExactPose& pose) const {
    const auto seen = points->nearby(pose);
    if (!seen.on.empty()) return {-1, seen.on};
    ExactPose q = pose;
    if (q.p == q.r) q.chart = 1 - q.chart, q.p = -1, q.r = 1;
    const auto crossed = points->in_order(q, seen.crossed, true);
    if (crossed.empty()) return {0, {}};
    const Index face = face_of[crossed[0].trapezoid];
    return {(crossed[0].to_left ? face_inner : face_outer)[face], {}};
}

Volumes Arrangement::volumes() const {
    std::vector<Facing> facing;
    for (std::size_t k = 0; k < surface.size(); ++k) {
        const bool is_inner = k % 2 != 0;
        facing.push_back({static_cast<Index>(k / 2), surface[k], (is_inner ? face_inner : face_outer)[face_of[k / 2]], is_inner});
    }
    Volumes found = enclosed(*sheets.boundary, facing, static_cast<Index>(cell_set.size()));
    found.values[0] = found.errors[0] = std::numeric_limits<double>::infinity();
    return found;
}

}  // namespace cfree
