// Cut a polygon by a half-plane for each edge, which keeps the widest disc; theory, "One surface alone".
#include "cfree/polygons/inscribed.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "cfree/polygons/inset.hpp"
#include "cfree/support/elementary.hpp"
#include "polygons/convex_rings.hpp"

namespace cfree {

namespace {

constexpr double precision = 0x1p-6;  // share of its radius by which a disc may be smaller than the widest
constexpr int most_rows = 64;         // of squares, at first
constexpr std::size_t most_squares = 4096;
constexpr double kept = 1 - 0x1p-18;  // share of the width that is left when vertices are removed
constexpr int digits = 26;            // of coordinates, relative to the size of the polygon
constexpr std::size_t most_vertices = 64;

struct Disc {
    Vec<double> centre;
    double radius;
};

// Distance from the nearest edge, negative outside.
double depth_at(const std::vector<DoubleRing>& rings, const Vec<double>& p) {
    double square = HUGE_VAL;
    bool is_inside = false;
    for (const DoubleRing& ring : rings)
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Vec<double> &a = ring[k], &b = vertex_after(ring, k), d = point_at(a, b, share_before(a, b, p)) - p;
            square = std::min(square, dot(d, d));
            if ((a.y > p.y) != (b.y > p.y) && (cross(b - a, p - a) > 0) == (b.y > a.y)) is_inside = !is_inside;
        }
    return is_inside ? std::sqrt(square) : -std::sqrt(square);
}

// Disc in the rings that is nearly as large as any: squares that may hold the centre of a larger one are quartered.
Disc widest_disc(const std::vector<DoubleRing>& rings) {
    struct Square {
        Vec<double> middle;
        double half, depth;
        double most() const { return depth + half * 1.5; }  // beyond its corners
        bool operator<(const Square& other) const { return most() < other.most(); }
    };
    Vec<double> low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
    for (const auto& [x, y] : rings.front())
        low = {std::min(low.x, x), std::min(low.y, y)}, high = {std::max(high.x, x), std::max(high.y, y)};
    const double wide = high.x - low.x, tall = high.y - low.y, side = std::max(std::min(wide, tall), std::max(wide, tall) / most_rows);
    std::priority_queue<Square> squares;
    Disc best{rings.front().front(), 0};
    const auto add = [&](const Vec<double>& middle, double half) {
        const double depth = depth_at(rings, middle);
        if (depth > best.radius) best = {middle, depth};
        squares.push({middle, half, depth});
    };
    for (int i = 0; i == 0 || (i < most_rows && i * side < wide); ++i)
        for (int j = 0; j == 0 || (j < most_rows && j * side < tall); ++j) add({low.x + (i + 0.5) * side, low.y + (j + 0.5) * side}, side / 2);
    while (squares.top().most() > best.radius * (1 + precision) && squares.size() < most_squares) {
        const auto [middle, half, _] = squares.top();
        squares.pop();
        const double h = half / 2;
        for (const double x : {middle.x - h, middle.x + h})
            for (const double y : {middle.y - h, middle.y + h}) add({x, y}, h);
    }
    return best;
}

// Convex polygon around a disc in the rings: of each edge, the line through its point nearest to the centre bounds it.
DoubleRing around(const Disc& disc, const std::vector<DoubleRing>& rings, double size) {
    const auto [x, y] = disc.centre;
    DoubleRing found{{x - size, y - size}, {x + size, y - size}, {x + size, y + size}, {x - size, y + size}};
    for (const DoubleRing& ring : rings)
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Vec<double> &a = ring[k], &b = vertex_after(ring, k), e = b - a;
            const double share = share_before(a, b, disc.centre);
            const Vec<double> p = point_at(a, b, share);
            const bool is_beside = 0 < share && share < 1, is_left = cross(e, disc.centre - a) > 0;
            found = cut_off(found, p, !is_beside ? p - disc.centre : is_left ? Vec<double>{e.y, -e.x} : Vec<double>{-e.y, e.x});
        }
    return found;
}

double width_of(const DoubleRing& ring) {
    double least = HUGE_VAL;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec<double> &a = ring[k], e = vertex_after(ring, k) - a;
        const double length = norm(e.x, e.y);
        if (length == 0) continue;
        double most = 0;
        for (const Vec<double>& p : ring) most = std::max(most, cross(e, p - a) / length);
        least = std::min(least, most);
    }
    return least;
}

// With few vertices: those go first that cut off least, and never two neighbours at once.
DoubleRing thinned(DoubleRing ring, double size) {
    for (double least = std::max(size * size * 0x1p-40, 0x1p-1000); ring.size() > most_vertices; least *= 4) {
        DoubleRing rest;
        bool is_gone = false;  // the vertex before
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Vec<double>&a = ring[k ? k - 1 : ring.size() - 1], &b = ring[k], &c = vertex_after(ring, k);
            is_gone = !is_gone && cross(b - a, c - b) < least;
            if (!is_gone) rest.push_back(b);
        }
        ring = std::move(rest);
    }
    return ring;
}

// Without vertices that its width does not need.
DoubleRing simplified(DoubleRing ring) {
    const double least = kept * width_of(ring);
    for (std::size_t k = 0; k < ring.size() && ring.size() > 3;) {
        DoubleRing rest = ring;
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
        if (width_of(rest) >= least) ring = std::move(rest);
        else ++k;
    }
    return ring;
}

// Rings relative to the first vertex, which may be far away.
std::vector<DoubleRing> rings_of(const Polygon& polygon) {
    const auto& v = polygon.vertices;
    std::vector<DoubleRing> rings;
    for (std::size_t r = 0; r + 1 < polygon.offsets.size(); ++r) {
        DoubleRing& ring = rings.emplace_back();
        for (Index k = polygon.offsets[r]; k < polygon.offsets[r + 1]; ++k)
            ring.push_back({nearest(v.X(k) - v.X(0), polygon.denominator), nearest(v.Y(k) - v.Y(0), polygon.denominator)});
    }
    return rings;
}

}  // namespace

std::optional<Inscribed> inscribed(const std::vector<std::shared_ptr<const Polygon>>& polygons, const Ratio& by) {
    const Polygon* outer = nullptr;
    Disc disc{{}, 0};
    std::vector<DoubleRing> rings;
    for (const auto& polygon : polygons) {
        if (polygon->is_thin()) continue;
        auto its = rings_of(*polygon);
        const Disc widest = widest_disc(its);
        if (widest.radius > disc.radius) disc = widest, outer = polygon.get(), rings = std::move(its);
    }
    if (!outer) return {};  // too thin for doubles
    double size = 0;
    for (const auto& [x, y] : rings.front()) size = std::max({size, std::abs(x - disc.centre.x), std::abs(y - disc.centre.y)});
    const DoubleRing ring = simplified(thinned(around(disc, rings, size), size));
    if (ring.size() < 3) return {};
    const int finest = std::ilogb(size) - digits;
    const auto exact = [&](const Int& origin, double c) {
        return reduced(origin, outer->denominator) + power_of_two(finest) * ratio_of(std::nearbyint(std::ldexp(c, -finest)));
    };
    const auto& v = outer->vertices;
    RatioRing points;
    for (const auto& [x, y] : ring) points.push_back({exact(v.X(0), x), exact(v.Y(0), y)});
    try {
        auto found = inset(Polygon({points}), by);
        if (!found || !is_inside(*found, *outer)) return {};
        const Vec<double> middle{disc.centre.x + nearest(v.X(0), outer->denominator), disc.centre.y + nearest(v.Y(0), outer->denominator)};
        return Inscribed{std::move(found), middle, width_of(ring)};
    } catch (const InvalidPolygon&) {  // too thin for the grid
        return {};
    }
}

}  // namespace cfree
