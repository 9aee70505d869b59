// Join vertices with those visible to their left, then flip edges; docs/inside-the-core.md.
#include "cfree/polygons/constrained_delaunay.hpp"

#include <algorithm>
#include <numeric>

#include "cfree/exact/ratio.hpp"
#include "cfree/polygons/segment_sweep.hpp"

namespace cfree {

namespace {

// Hertel and Mehlhorn's sweep. Between two edges that the sweep line cuts, with the interior between them, a chain of
// vertices from the lower edge's start to the upper one's separates the triangulated part from the rest: no corner of it,
// viewed from the right, is convex. A vertex met at either end of the chain cuts off the corners that it makes convex.
class SweptTriangles {
public:
    SweptTriangles(const Points& v, const std::vector<std::vector<Index>>& rings) : points(v), line(v, start, end) {
        for (const auto& ring : rings)
            for (std::size_t k = 0; k < ring.size(); ++k) {
                const Index from = ring[k], to = ring[k + 1 < ring.size() ? k + 1 : 0];
                rightward.push_back(points.before(from, to));
                start.push_back(rightward.back() ? from : to), end.push_back(rightward.back() ? to : from);
            }
        chains.resize(start.size());
    }

    Triangles run() {
        std::vector<Index> edges(start.size());
        std::iota(edges.begin(), edges.end(), 0);
        std::sort(edges.begin(), edges.end(), [&](Index e, Index f) { return points.before(start[e], start[f]); });
        // a point at which edges end and none starts also counts
        std::vector<Index> stops = start;
        stops.insert(stops.end(), end.begin(), end.end());
        std::sort(stops.begin(), stops.end());
        stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
        std::sort(stops.begin(), stops.end(), [&](Index p, Index q) { return points.before(p, q); });
        auto next = edges.begin();
        for (const Index p : stops) {
            std::vector<Index> leaving;
            for (; next != edges.end() && start[*next] == p; ++next) leaving.push_back(*next);
            pass(p, line.from_below(p, leaving));
        }
        return std::move(triangles);
    }

private:
    struct Node {
        Index vertex, below, above;  // the next nodes of the chain, -1 at its ends
    };
    struct Chain {
        Index lowest = -1, highest = -1, latest = -1;
    };
    const Points& points;
    std::vector<Index> start, end;
    std::vector<char> rightward;  // true for each edge with the interior above it
    SweepLine line;
    std::vector<Node> nodes;
    std::vector<Chain> chains;  // ordered by the edge below
    Triangles triangles;

    Index add(Index vertex, Index below, Index above) {
        const auto node = static_cast<Index>(nodes.size());
        nodes.push_back({vertex, below, above});
        if (below >= 0) nodes[below].above = node;
        if (above >= 0) nodes[above].below = node;
        return node;
    }

    void put_above(Chain& chain, Index p) {
        Index v = chain.highest, u = nodes[v].below;
        for (; u >= 0 && points.orient(nodes[u].vertex, p, nodes[v].vertex) > 0; v = u, u = nodes[v].below)
            triangles.push_back({nodes[u].vertex, p, nodes[v].vertex});
        chain.highest = chain.latest = add(p, v, -1);
    }

    void put_below(Chain& chain, Index p) {
        Index v = chain.lowest, u = nodes[v].above;
        for (; u >= 0 && points.orient(nodes[v].vertex, p, nodes[u].vertex) > 0; v = u, u = nodes[v].above)
            triangles.push_back({nodes[v].vertex, p, nodes[u].vertex});
        chain.lowest = chain.latest = add(p, -1, v);
    }

    void pass(Index p, const std::vector<Index>& leaving) {
        const auto range = line.through(p);
        const std::vector<Index> arriving(line.edges.begin() + static_cast<std::ptrdiff_t>(range.first),
                                          line.edges.begin() + static_cast<std::ptrdiff_t>(range.second));
        const Index under = range.first ? line.edges[range.first - 1] : -1;
        const bool is_inside_below = under >= 0 && rightward[under];
        Chain above;  // right above p, if the interior is there
        if (arriving.empty() && is_inside_below) {
            // p is visible from the latest vertex of the chain: both parts begin with it
            Chain& chain = chains[under];
            const Index latest = chain.latest, beyond = nodes[latest].above, copy = add(nodes[latest].vertex, -1, beyond);
            above = {copy, beyond < 0 ? copy : chain.highest, copy};
            nodes[latest].above = -1;
            chain.highest = latest;
            put_above(chain, p), put_below(above, p);
        } else if (!arriving.empty()) {
            if (is_inside_below) put_above(chains[under], p);
            for (const Index e : arriving)
                if (rightward[e]) e == arriving.back() ? put_below(chains[e], p) : put_above(chains[e], p);
            if (rightward[arriving.back()]) above = chains[arriving.back()];
        }
        if (!leaving.empty()) {
            for (const Index e : leaving)
                if (rightward[e] && e != leaving.back()) chains[e].lowest = chains[e].highest = chains[e].latest = add(p, -1, -1);
            chains[leaving.back()] = above;
        } else if (above.lowest >= 0 && is_inside_below) {
            // two chains that end at p become one
            Chain& chain = chains[under];
            const Index beyond = nodes[above.lowest].above;
            nodes[chain.highest].above = beyond;
            if (beyond >= 0) nodes[beyond].below = chain.highest, chain.highest = above.highest;
        }
        line.replace(range, leaving);
    }
};

// Exact tests that points are inside circles, in the frame of the points' box.
class Circles {
public:
    explicit Circles(const Points& v) : points(v) {
        const auto [least_x, least_y, most_x, most_y] = v.box();
        width = most_x - least_x, height = most_y - least_y;
        are_tiny = v.are_small() && width < (1 << 20) && height < (1 << 20);
        for (Index k = 0; k < v.size(); ++k)
            place.push_back({nearest(Int(v.X(k) - least_x), width), nearest(Int(v.Y(k) - least_y), height)});
    }

    // 1 if d is inside the circle through a, b and c, which are counter-clockwise, 0 if it is on it.
    int side(Index a, Index b, Index c, Index d) const {
        const std::array<Index, 3> corners{a, b, c};
        std::array<Vec<Approx>, 3> about;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [px, py] = place[corners[k]];
            const auto [qx, qy] = place[d];
            about[k] = {{px - qx, px + qx}, {py - qy, py + qy}};
        }
        // fifteen roundings in a row: differences 2, their squares' sum 6, their cross product 6, then 13, and two sums
        const Approx value = determinant(about, [](const Vec<Approx>& u) { return dot(u, u); });
        if (std::abs(value.v) > 16 * 0x1p-53 * value.m + 0x1p-900) return value.v > 0 ? 1 : -1;
        if (are_tiny) {  // differences have 20 bits, stretched ones 40, their squares' sums 81, cross products 41
            const auto w = static_cast<std::int64_t>(width), h = static_cast<std::int64_t>(height);
            std::array<Vec<Wide>, 3> exact;
            for (std::size_t k = 0; k < 3; ++k)
                exact[k] = {points.small_x(corners[k]) - points.small_x(d), points.small_y(corners[k]) - points.small_y(d)};
            const Wide sign = determinant(exact, [&](const Vec<Wide>& u) { return u.x * h * u.x * h + u.y * w * u.y * w; });
            return (sign > 0) - (sign < 0);
        }
        std::array<Vec<Int>, 3> exact;
        for (std::size_t k = 0; k < 3; ++k)
            exact[k] = {points.X(corners[k]) - points.X(d), points.Y(corners[k]) - points.Y(d)};
        return determinant(exact, [&](const Vec<Int>& u) {
                   const Int x = u.x * height, y = u.y * width;
                   return Int(x * x + y * y);
               }).sign();
    }

private:
    const Points& points;
    Int width, height;
    bool are_tiny;
    std::vector<Vec<double>> place;

    template <class T, class Lift>
    static T determinant(const std::array<Vec<T>, 3>& u, Lift lift) {
        return lift(u[0]) * cross(u[1], u[2]) + lift(u[1]) * cross(u[2], u[0]) + lift(u[2]) * cross(u[0], u[1]);
    }
};

}  // namespace

Triangles swept_triangles(const Points& points, const std::vector<std::vector<Index>>& rings) {
    return SweptTriangles(points, rings).run();
}

std::vector<Index> twins(const Points& points, const std::vector<std::vector<Index>>& rings, const Triangles& triangles) {
    struct Side {
        std::uint64_t ends;  // the lesser, the greater
        Index number;        // the triangle edge's, -1 for an edge of the rings
        bool upwards;        // from the lesser to the greater
    };
    std::vector<Side> sides;
    const auto add = [&](Index from, Index to, Index number) {
        const auto [low, high] = std::minmax(from, to);
        sides.push_back({static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high), number, from < to});
    };
    sides.reserve(3 * triangles.size() + static_cast<std::size_t>(points.size()));
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto [a, b, c] = triangles[t];
        if (points.orient(a, b, c) <= 0) return {};
        const auto first = static_cast<Index>(3 * t);
        add(a, b, first), add(b, c, first + 1), add(c, a, first + 2);
    }
    for (const auto& ring : rings)
        for (std::size_t k = 0; k < ring.size(); ++k) add(ring[k], ring[k + 1 < ring.size() ? k + 1 : 0], -1);
    std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) { return s.ends < t.ends; });
    // each edge of a triangle has one partner: the same one of the rings, or another triangle's, backwards
    std::vector<Index> twin(3 * triangles.size(), -1);
    if (sides.size() % 2) return {};
    for (std::size_t k = 0; k < sides.size(); k += 2) {
        const Side &one = sides[k], &other = sides[k + 1];
        if (one.ends != other.ends || (k && one.ends == sides[k - 1].ends)) return {};
        const bool are_inside = one.number >= 0 && other.number >= 0;
        if ((one.number < 0 && other.number < 0) || are_inside == (one.upwards == other.upwards)) return {};
        if (are_inside) twin[one.number] = other.number, twin[other.number] = one.number;
    }
    return twin;
}

Cover constrained_delaunay(const Points& points, const std::vector<std::vector<Index>>& rings) {
    Triangles triangles = swept_triangles(points, rings);
    std::vector<Index> twin = twins(points, rings, triangles);
    if (twin.empty()) throw BrokenInvariant("triangles do not cover their polygon");
    const Circles circles(points);
    const auto corner = [&](Index e) -> Index& { return triangles[e / 3][e % 3]; };
    const auto after = [](Index e) { return e % 3 < 2 ? e + 1 : e - 2; };
    const auto link = [&](Index e, Index other) {
        twin[e] = other;
        if (other >= 0) twin[other] = e;
    };
    std::vector<Index> stack(twin.size());
    std::iota(stack.begin(), stack.end(), 0);
    while (!stack.empty()) {
        const Index e = stack.back();
        stack.pop_back();
        const Index back = twin[e];
        if (back < 0) continue;
        const Index e1 = after(e), e2 = after(e1), b1 = after(back), b2 = after(b1);
        const Index a = corner(e), b = corner(back), c = corner(e2), d = corner(b2);
        const int side = circles.side(a, b, c, d);
        if (side < 0 || (side == 0 && std::min(a, b) < std::min(c, d))) continue;
        // abc and bad become adc and bcd; two that are not Delaunay together are a convex quadrilateral
        const Index beyond_ad = twin[b1], beyond_bc = twin[e1];
        corner(e1) = d, corner(b1) = c;
        link(e, beyond_ad), link(back, beyond_bc), link(e1, b1);
        stack.insert(stack.end(), {e, e2, back, b2});
    }
    return {std::move(triangles), std::move(twin)};
}

}  // namespace cfree
