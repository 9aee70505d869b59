// Nest closed surfaces by rays, and find the cells between them; theory, "Cells".
#include "cfree/free/free_space.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

namespace cfree {

namespace {

std::vector<Index> cells_of(const Surfaces& s, Index outside) {
    std::vector<Index> own, result;
    Index last = outside;
    for (const auto free : s.free_inside) own.push_back(last += free);
    for (std::size_t k = 0; k < own.size(); ++k)
        result.push_back(s.free_inside[k] ? own[k] : s.parent[k] >= 0 ? own[s.parent[k]] : outside);
    return result;
}

std::vector<Index> depths(const Surfaces& s) {
    std::vector<Index> result;
    for (Index k = 0; k < static_cast<Index>(s.parent.size()); ++k) {
        Index depth = 0;
        for (Index above = s.parent[k]; above >= 0; above = s.parent[above]) ++depth;
        result.push_back(depth);
    }
    return result;
}

}  // namespace

Turns turns_of(const CellComplex& c) {
    const auto& chart = c.boundary->trapezoids.chart;
    const auto leaves = [&](Index h) {  // over theta = 3 pi / 2
        if (c.side[h] != static_cast<std::uint8_t>(Side::last)) return false;
        const Index twin = c.twin[h];
        return chart[c.face[h]] == 1 && c.side[twin] == static_cast<std::uint8_t>(Side::first) && chart[c.face[twin]] == 0;
    };
    constexpr Index none = std::numeric_limits<Index>::min();
    const auto faces = static_cast<Index>(c.component.size());
    Turns out{std::vector<Index>(c.components, 0), std::vector<Index>(c.component.size(), none)};
    std::vector<Index> stack;
    for (Index f = 0; f < faces; ++f) {
        if (c.component[f] < 0 || out.lift[f] != none) continue;
        Index& divisor = out.turns[c.component[f]];
        out.lift[f] = 0;
        stack.push_back(f);
        while (!stack.empty()) {
            const Index g = stack.back();
            stack.pop_back();
            for (Index h = c.first[g]; h < c.first[g + 1]; ++h) {
                const Index next = c.face[c.twin[h]], lift = out.lift[g] + leaves(h) - leaves(c.twin[h]);
                if (out.lift[next] != none) {
                    if (lift != out.lift[next]) divisor = std::gcd(divisor, lift - out.lift[next]);
                } else if (c.component[next] >= 0) {
                    out.lift[next] = lift;
                    stack.push_back(next);
                }
            }
        }
    }
    for (Index f = 0; f < faces; ++f)
        if (c.component[f] < 0) out.lift[f] = 0;
    return out;
}

std::vector<Index> parents(const PointLocation::Nesting& n, bool is_bounded) {
    const auto count = static_cast<Index>(n.free_inside.size());
    const auto around = [&](Index k) { return std::vector(n.around.begin() + n.start[k], n.around.begin() + n.start[k + 1]); };
    const auto listed = [](const std::vector<Index>& of) {
        std::string text;
        for (const Index x : of) text += (text.empty() ? "" : ", ") + std::to_string(x);
        return "[" + text + "]";
    };
    std::vector<Index> result;
    for (Index k = 0; k < count; ++k) {
        auto outer = around(k);
        std::sort(outer.begin(), outer.end());
        const auto size = [&](Index x) { return n.start[x + 1] - n.start[x]; };
        const auto next = std::max_element(outer.begin(), outer.end(), [&](Index x, Index y) { return size(x) < size(y); });
        const Index above = next == outer.end() ? -1 : *next;
        std::vector<Index> expected;
        if (above >= 0) {
            expected = around(above), expected.push_back(above);
            std::sort(expected.begin(), expected.end());
        }
        if (outer != expected)
            throw std::logic_error("closed surface " + std::to_string(k) + " is inside " + listed(outer) +
                                   ", which are not inside each other");
        const bool free_around = above >= 0 ? n.free_inside[above] != 0 : !is_bounded;
        if ((n.free_inside[k] != 0) == free_around)
            throw std::logic_error("closed surface " + std::to_string(k) + " has the wrong side free for its place inside " +
                                   listed(outer));
        result.push_back(above);
    }
    return result;
}

FreeSpace::FreeSpace(SharedBoundary b, Surfaces s)
    : FreeSpace(b, s, PointLocation(b, s.component)) {}

FreeSpace::FreeSpace(SharedBoundary b, Surfaces s, PointLocation points)
    : boundary(std::move(b)), surfaces(std::move(s)), outside(boundary->scene->is_bounded ? -1 : 0),
      cell_of(cells_of(surfaces, outside)), depth(depths(surfaces)), location(std::move(points)) {}

std::shared_ptr<const FreeSpace> FreeSpace::of(const CellComplex& cells) {
    Surfaces s{cells.component, {}, {}};
    PointLocation location(cells.boundary, cells.component);
    auto nesting = location.nesting();
    s.parent = parents(nesting, cells.boundary->scene->is_bounded), s.free_inside = std::move(nesting.free_inside);
    return std::make_shared<const FreeSpace>(cells.boundary, std::move(s), std::move(location));
}

Index FreeSpace::cells() const {
    Index most = outside;
    for (const Index c : cell_of) most = std::max(most, c);
    return most + 1;
}

}  // namespace cfree
