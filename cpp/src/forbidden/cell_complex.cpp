// Put matched sides into loops around faces; find vertices and components; theory, "Closed surfaces".
#include "cfree/forbidden/cell_complex.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "forbidden/curve_sides.hpp"
#include "forbidden/kept_faces.hpp"
#include "forbidden/level_sides.hpp"
#include "forbidden/loops.hpp"
#include "support/free_memory.hpp"
#include "support/parallel.hpp"

namespace cfree {

namespace {

[[noreturn]] void fail_alone(Index trapezoid) {
    throw std::logic_error("a side without a partner at trapezoid " + std::to_string(trapezoid));
}

// Number edges in the order of their half-edges, which depends on no other face.
void number_edges(CellComplex& cells) {
    std::vector<Index> number(static_cast<std::size_t>(cells.edges), -1);
    cells.edges = 0;
    for (Index& edge : cells.edge) {
        if (number[edge] < 0) number[edge] = cells.edges++;
        edge = number[edge];
    }
}

class Assembly {
public:
    // Face k is trapezoid trapezoid_of[k] of the boundary.
    Assembly(SharedBoundary b, std::vector<Index>&& trapezoid_of, int t)
        : boundary(std::move(b)), faces(std::move(trapezoid_of)), threads(t) {}

    // Complex of parts of faces; components of the own ones, or of all.
    CellComplex run(std::vector<Parts>&& lists, const std::vector<char>* own = nullptr) {
        make_loops(std::move(lists));
        in_two(threads, [&] { find_components(own); }, [&] {
            number_edges(result);
            place_later(find_vertices());
        });
        return std::move(result);
    }
    // Complex of half-edges that have their faces, sides and twins, and any numbers of edges; without places.
    CellComplex run(CellComplex&& half_edges) {
        result = std::move(half_edges);
        in_two(threads, [&] { find_components(nullptr); }, [&] {
            number_edges(result);
            find_vertices();
        });
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
    std::vector<Index> find_vertices();
    void place_later(const std::vector<Index>& best);
    void find_components(const std::vector<char>* own);

    const SharedBoundary boundary;
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

// Find vertices: go around the start of each half-edge, over twins. Return a half-edge of each vertex whose start is known: at a
// level, if there is one.
std::vector<Index> Assembly::find_vertices() {
    result.vertex.assign(result.face.size(), -1);
    std::vector<Index> best;
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
    return best;
}

void Assembly::place_later(const std::vector<Index>& best) {
    struct Start {
        double at;  // see Parts
        Index trapezoid;
        Side side;
    };
    std::vector<Start> starts;
    starts.reserve(best.size());
    for (const Index h : best) starts.push_back({start[h], faces[result.face[h]], side(h)});
    free_memory(start);
    result.placing->later = [from = boundary, starts = std::move(starts), threads = threads] {
        VertexPlaces places{std::vector<double>(2 * starts.size()), std::vector<double>(starts.size())};
        const double unit = from->scene->near().unit();
        for_each_block_in_parallel(threads, starts.size(), [&](std::size_t v) {
            const auto [xy, theta] = place_of(*from, starts[v].trapezoid, starts[v].side, starts[v].at);
            places.xy[2 * v] = xy.x * unit, places.xy[2 * v + 1] = xy.y * unit, places.theta[v] = theta;
        });
        return places;
    };
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

// Half-edges of a complex: those of faces that are kept, and those of the others glued among themselves.
class Merging {
public:
    Merging(const CellComplex& other, const KeptFaces& kept_faces, const Loops& glued_parts)
        : before(other), kept(kept_faces), glued(glued_parts), place(kept.is_inner.size(), -1) {
        for (std::size_t n = 0; n < kept.chosen.size(); ++n) place[kept.chosen[n]] = static_cast<Index>(n);
        has_other.assign(static_cast<std::size_t>(glued.edges), 0);
        for (std::size_t p = 0; p < glued.face.size(); ++p)
            if (!is_inner(kept.chosen[glued.face[p]])) has_other[glued.edge[p]] = 1;
    }

    // Nothing if a face that is kept does not have the sides that its neighbours have: a fault, so all is glued.
    std::optional<CellComplex> run() {
        make_faces();
        if (!match_parts()) return {};
        for (Index f = 0; f < static_cast<Index>(kept.is_inner.size()); ++f)
            if (!(kept.is_inner[f] ? copy(f) : add(f))) return {};
        return std::move(result);
    }

private:
    bool is_inner(Index f) const { return kept.is_inner[f] != 0; }
    Index first_before(Index f) const { return before.first[kept.before[f]]; }
    // Half-edge of a face that is kept, by its number in the other complex.
    Index now(Index h) const { return h + shift[before.face[h]]; }
    void make_faces();
    bool match_parts();
    bool match(Index f);
    bool copy(Index f);
    bool add(Index f);

    const CellComplex& before;
    const KeptFaces& kept;
    const Loops& glued;
    std::vector<Index> place;    // of each face among those glued
    std::vector<Index> shift;    // by which half-edges of each face of the other complex that is kept have moved
    std::vector<char> has_other; // true for each edge glued at which a face is not kept
    std::vector<Index> of_part;  // half-edge of each part glued, -1 for those that faces do not need
    std::vector<Index> part_of;  // part of each half-edge that a face that is kept shares with another one
    CellComplex result;
};

void Merging::make_faces() {
    const auto count = static_cast<Index>(kept.is_inner.size());
    result.first.reserve(kept.is_inner.size() + 1), result.first.assign(1, 0);
    shift.assign(kept.now.size(), 0);
    for (Index f = 0; f < count; ++f) {
        if (is_inner(f)) shift[kept.before[f]] = result.first[f] - first_before(f);
        result.first.push_back(result.first[f] + (is_inner(f) ? before.first[kept.before[f] + 1] - first_before(f)
                                                              : glued.first[place[f] + 1] - glued.first[place[f]]));
    }
    result.face.resize(static_cast<std::size_t>(result.first.back()));
    for (Index f = 0; f < count; ++f) std::fill(result.face.begin() + result.first[f], result.face.begin() + result.first[f + 1], f);
    result.twin.assign(result.face.size(), -1), result.edge.assign(result.face.size(), -1), result.side.assign(result.face.size(), 0);
    result.edges = before.edges + glued.edges;
}

bool Merging::match_parts() {
    of_part.assign(glued.face.size(), -1), part_of.assign(result.face.size(), -1);
    for (const Index f : kept.chosen)
        for (Index p = glued.first[place[f]]; !is_inner(f) && p < glued.first[place[f] + 1]; ++p)
            of_part[p] = result.first[f] + p - glued.first[place[f]];
    return std::all_of(kept.chosen.begin(), kept.chosen.end(), [&](Index f) { return !is_inner(f) || match(f); });
}

// Match the sides of a face that is kept, which it shares with others: they come in the same order.
bool Merging::match(Index f) {
    const auto is_shared = [&](Index p) { return glued.twin[p] >= 0 && has_other[glued.edge[p]]; };
    Index p = glued.first[place[f]];
    const Index end = glued.first[place[f] + 1];
    for (Index h = first_before(f); h < before.first[kept.before[f] + 1]; ++h) {
        if (!kept.is_border_edge[before.edge[h]]) continue;
        while (p < end && !is_shared(p)) ++p;
        if (p == end || glued.kind[p] / 2 != before.side[h]) return false;
        of_part[p] = now(h), part_of[now(h)] = p, ++p;
    }
    while (p < end && !is_shared(p)) ++p;
    return p == end;
}

bool Merging::copy(Index f) {
    if (place[f] < 0) {  // it meets only faces that are kept
        const Index begin = first_before(f), end = before.first[kept.before[f] + 1], to = result.first[f];
        std::copy(before.side.begin() + begin, before.side.begin() + end, result.side.begin() + to);
        std::copy(before.edge.begin() + begin, before.edge.begin() + end, result.edge.begin() + to);
        for (Index h = begin; h < end; ++h) result.twin[to + h - begin] = now(before.twin[h]);
        return true;
    }
    for (Index h = first_before(f); h < before.first[kept.before[f] + 1]; ++h) {
        const Index x = now(h), p = part_of[x];
        result.side[x] = before.side[h];
        result.twin[x] = p < 0 ? now(before.twin[h]) : of_part[glued.twin[p]];
        result.edge[x] = p < 0 ? before.edge[h] : before.edges + glued.edge[p];
        if (result.twin[x] < 0) return false;
    }
    return true;
}

bool Merging::add(Index f) {
    for (Index p = glued.first[place[f]]; p < glued.first[place[f] + 1]; ++p) {
        const Index x = of_part[p];
        if (glued.twin[p] < 0) fail_alone(f);
        result.side[x] = static_cast<std::uint8_t>(glued.kind[p] / 2);
        result.twin[x] = of_part[glued.twin[p]];
        result.edge[x] = before.edges + glued.edge[p];
        if (result.twin[x] < 0) return false;
    }
    return true;
}

}  // namespace

std::shared_ptr<const CellComplex> glue(const SharedBoundary& boundary, const CellComplex& reuse, int threads) {
    const auto kept = kept_faces(reuse, *boundary);
    if (!kept) return glue(boundary, threads);
    Trapezoids rows;
    Whole whole;
    for (const Index k : kept->chosen) rows.push_row(boundary->trapezoids, k), whole.push_back(!kept->is_inner[k]);
    const Boundary part(boundary->scene, boundary->patches, boundary->trimmed, std::move(rows), IsolatedParts{});
    const Loops loops = loops_of(kept->chosen.size(), matched_sides(part, whole, threads));
    auto half_edges = Merging(reuse, *kept, loops).run();
    if (!half_edges) return glue(boundary, threads);
    CellComplex result = Assembly(boundary, std::vector<Index>(kept->is_inner.size()), threads).run(std::move(*half_edges));
    result.boundary = boundary;
    result.placing->later = [boundary, threads] { return glue(boundary, threads)->places(); };
    return std::make_shared<const CellComplex>(std::move(result));
}

std::shared_ptr<const CellComplex> glue(const SharedBoundary& boundary, int threads) {
    std::vector<Index> all(boundary->trapezoids.size());
    std::iota(all.begin(), all.end(), 0);
    give_back_memory(all.size());  // memory of trimming
    std::vector<Parts> lists = matched_sides(*boundary, Whole(all.size(), 1), threads);
    for (const Parts& list : lists)
        for (Index k = 0; k < list.size(); ++k)
            if (list.twin[k] < 0) fail_alone(list.trapezoid[k]);
    give_back_memory(all.size());
    auto result = shared(Assembly(boundary, std::move(all), threads).run(std::move(lists)), boundary);
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
    auto cells = shared(Assembly(boundary, std::vector(faces), 1).run(std::move(lists)), part);
    cells->places();  // so that nothing keeps the whole boundary
    return {std::move(cells), std::move(faces), std::move(missing)};
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
    return shared(Assembly(boundary, std::move(all), threads).run(std::move(lists), &own), boundary);
}

const VertexPlaces& CellComplex::places() const {
    std::call_once(placing->once, [&] {
        placing->places = placing->later();
        placing->later = nullptr;
    });
    return placing->places;
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
