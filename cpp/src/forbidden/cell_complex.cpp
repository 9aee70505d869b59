// Put matched sides into loops around faces; find vertices and components; theory, "Closed surfaces".
#include "cfree/forbidden/cell_complex.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "forbidden/curve_sides.hpp"
#include "forbidden/level_sides.hpp"
#include "forbidden/loops.hpp"
#include "support/free_memory.hpp"
#include "support/parallel.hpp"

namespace cfree {

namespace {

[[noreturn]] void fail_alone(Index trapezoid) {
    throw std::logic_error("a side without a partner at trapezoid " + std::to_string(trapezoid));
}

class Assembly {
public:
    // Face k is trapezoid trapezoid_of[k] of the boundary.
    Assembly(const Boundary& b, std::vector<Index>&& trapezoid_of, int t)
        : boundary(&b), faces(std::move(trapezoid_of)), threads(t) {}

    // Complex of parts of faces; components of the own ones, or of all.
    CellComplex run(std::vector<Parts>&& lists, const std::vector<char>* own = nullptr) {
        make_loops(std::move(lists));
        find_vertices();
        find_components(own);
        return std::move(result);
    }

private:
    bool is_level(Index h) const { return side(h) == Side::first || side(h) == Side::last; }
    Side side(Index h) const { return static_cast<Side>(result.side[h]); }
    Index before(Index h) const {
        const Index f = result.face[h];
        return h == result.first[f] ? result.first[f + 1] - 1 : h - 1;
    }
    void make_loops(std::vector<Parts>&& lists);
    void find_vertices();
    void place_vertex(Index vertex, Index h);
    void find_components(const std::vector<char>* own);

    const Boundary* boundary;
    const std::vector<Index> faces;
    const int threads;
    CellComplex result;
    std::vector<double> start;  // one per half-edge: see Parts
};

void Assembly::make_loops(std::vector<Parts>&& lists) {
    Loops loops = loops_of(faces.size(), std::move(lists));
    for (auto& kind : loops.kind) kind /= 2;
    result.face = std::move(loops.face), result.twin = std::move(loops.twin), result.edge = std::move(loops.edge);
    result.first = std::move(loops.first), result.side = std::move(loops.kind), result.edges = loops.edges;
    start = std::move(loops.start);
}

// Find vertices: go around the start of each half-edge, over twins.
void Assembly::find_vertices() {
    result.vertex.assign(result.face.size(), -1);
    std::vector<Index> best;  // a half-edge of each vertex whose start is known: at a level, if there is one
    for (Index h = 0; h < static_cast<Index>(result.face.size()); ++h) {
        if (result.vertex[h] >= 0) continue;
        heed_stop();
        best.push_back(h);
        for (Index x = h; x >= 0 && result.vertex[x] < 0; x = result.twin[before(x)]) {
            result.vertex[x] = result.vertices;
            if (is_level(x)) best.back() = x;
        }
        ++result.vertices;
    }
    result.xy.resize(2 * best.size()), result.theta.resize(best.size());
    for_each_block_in_parallel(threads, best.size(), [&](std::size_t v) { place_vertex(static_cast<Index>(v), best[v]); });
    free_memory(start);
}

void Assembly::place_vertex(Index vertex, Index h) {
    const auto [xy, theta] = place_of(*boundary, faces[result.face[h]], side(h), start[h]);
    result.xy[2 * vertex] = xy.x, result.xy[2 * vertex + 1] = xy.y, result.theta[vertex] = theta;
}

void Assembly::find_components(const std::vector<char>* own) {
    result.component.assign(faces.size(), -1);
    const auto is_other = [&](Index f) { return own && !(*own)[f]; };
    std::vector<Index> stack;
    for (Index f = 0; f < static_cast<Index>(faces.size()); ++f) {
        if (result.component[f] >= 0 || is_other(f)) continue;
        heed_stop();
        result.component[f] = result.components;
        stack.push_back(f);
        while (!stack.empty()) {
            const Index g = stack.back();
            stack.pop_back();
            for (Index h = result.first[g]; h < result.first[g + 1]; ++h) {
                if (result.twin[h] < 0) continue;
                const Index neighbour = result.face[result.twin[h]];
                if (result.component[neighbour] >= 0 || is_other(neighbour)) continue;
                result.component[neighbour] = result.components;
                stack.push_back(neighbour);
            }
        }
        ++result.components;
    }
}

std::vector<Parts> matched_sides(const Boundary& boundary, const Whole& whole, int threads) {
    boundary.angles(threads);
    std::vector<Parts> lists = glue_curves(boundary, whole, Around::free_sectors, threads);
    std::vector<Parts> levels = glue_levels(boundary, whole, Around::free_sectors, threads);
    std::move(levels.begin(), levels.end(), std::back_inserter(lists));
    return lists;
}

std::shared_ptr<const CellComplex> shared(CellComplex&& built, const SharedBoundary& boundary) {
    auto result = std::make_shared<CellComplex>(std::move(built));
    result->boundary = boundary;
    const double unit = boundary->scene->near().unit();
    for (double& c : result->xy) c *= unit;
    return result;
}

// --- part of a boundary ---

// Trapezoids within reach of some over sides: the whole ones, and beyond them those that are not whole.
std::array<std::vector<Index>, 2> reached(const std::vector<Parts>& lists, const Whole& whole, const std::vector<Index>& seeds) {
    std::vector<Index> first(whole.size() + 1, 0);
    for (const Parts& list : lists)
        for (const Index k : list.trapezoid) ++first[k + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Index> place(first.begin(), first.end() - 1), beyond(static_cast<std::size_t>(first.back()));
    for (const Parts& list : lists)
        for (Index k = 0; k < list.size(); ++k)
            beyond[place[list.trapezoid[k]]++] = list.twin[k] < 0 ? -1 : list.trapezoid[list.twin[k]];
    std::array<std::vector<Index>, 2> found;
    std::vector<char> seen(whole.size(), 0);
    std::vector<Index> stack;
    const auto see = [&](Index trapezoid) {
        if (seen[trapezoid]++) return;
        found[whole[trapezoid] ? 0 : 1].push_back(trapezoid);
        if (whole[trapezoid]) stack.push_back(trapezoid);
    };
    for (const Index seed : seeds) see(seed);
    while (!stack.empty()) {
        const Index k = stack.back();
        stack.pop_back();
        for (Index x = first[k]; x < first[k + 1]; ++x) {
            if (beyond[x] < 0) fail_alone(k);
            see(beyond[x]);
        }
    }
    for (auto& list : found) std::sort(list.begin(), list.end());
    return found;
}

// Reduce parts to some faces: renumber edges; sides to others have no twin.
void keep(Parts& list, const std::vector<Index>& face_of) {
    std::vector<Index> number(list.trapezoid.size(), -1);
    Parts kept;
    for (Index k = 0; k < list.size(); ++k) {
        if (list.begins_edge(k)) kept.begin_edge();
        if (const Index f = face_of[list.trapezoid[k]]; f >= 0)
            number[k] = kept.add(f, list.side(k), list.is_backwards(k), list.start[k]);
    }
    for (Index k = 0; k < list.size(); ++k)
        if (number[k] >= 0) kept.twin[number[k]] = number[list.twin[k]];
    list = std::move(kept);
}

}  // namespace

std::shared_ptr<const CellComplex> glue(const SharedBoundary& boundary, int threads) {
    std::vector<Index> all(boundary->trapezoids.size());
    std::iota(all.begin(), all.end(), 0);
    give_back_memory(all.size());  // memory of trimming
    std::vector<Parts> lists = matched_sides(*boundary, Whole(all.size(), 1), threads);
    for (const Parts& list : lists)
        for (Index k = 0; k < list.size(); ++k)
            if (list.twin[k] < 0) fail_alone(list.trapezoid[k]);
    give_back_memory(all.size());
    auto result = shared(Assembly(*boundary, std::move(all), threads).run(std::move(lists)), boundary);
    give_back_memory(boundary->trapezoids.size());
    return result;
}

GluedPart glue_part(const SharedBoundary& boundary, std::vector<char> whole, const std::vector<Index>& seeds, Index target) {
    std::vector<Parts> lists = matched_sides(*boundary, whole, 1);
    auto [faces, missing] = reached(lists, whole, seeds);
    if (!missing.empty() && !std::binary_search(faces.begin(), faces.end(), target)) return {nullptr, std::move(faces), std::move(missing)};
    std::vector<Index> face_of(whole.size(), -1);
    Trapezoids rows;
    for (const Index k : faces) face_of[k] = static_cast<Index>(rows.size()), rows.push_row(boundary->trapezoids, k);
    for (Parts& list : lists) keep(list, face_of);
    const auto part = std::make_shared<const Boundary>(boundary->scene, boundary->patches, boundary->trimmed, std::move(rows),
                                                       IsolatedParts{});
    return {shared(Assembly(*boundary, std::vector(faces), 1).run(std::move(lists)), part), std::move(faces), std::move(missing)};
}

std::shared_ptr<const CellComplex> glue_own(const SharedBoundary& boundary, const std::vector<char>& own, int threads) {
    std::vector<Index> all(own.size());
    std::iota(all.begin(), all.end(), 0);
    Whole whole;
    for (const char is_own : own) whole.push_back(is_own ? 1 : 2);
    std::vector<Parts> lists = matched_sides(*boundary, whole, threads);
    for (const Parts& list : lists)
        for (Index k = 0; k < list.size(); ++k)
            if (list.twin[k] < 0 && own[list.trapezoid[k]]) fail_alone(list.trapezoid[k]);
    return shared(Assembly(*boundary, std::move(all), threads).run(std::move(lists), &own), boundary);
}

std::vector<std::vector<Index>> pinched(const CellComplex& cells) {
    std::vector<Index> count(static_cast<std::size_t>(cells.edges), 0), place(count.size(), -1);
    for (const Index e : cells.edge) ++count[e];
    std::vector<std::vector<Index>> found;
    for (Index e = 0; e < cells.edges; ++e)
        if (count[e] > 2) place[e] = static_cast<Index>(found.size()), found.emplace_back();
    for (Index h = 0; h < static_cast<Index>(cells.edge.size()); ++h)
        if (const Index k = place[cells.edge[h]]; k >= 0) found[k].push_back(h);
    return found;
}

}  // namespace cfree
