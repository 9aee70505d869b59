// Convert input points to rings that bound a polygon: read, clean, check, turn around.
#include "cfree/polygons/polygon.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "cfree/polygons/convex_decomposition.hpp"
#include "cfree/polygons/segment_sweep.hpp"

namespace cfree {

namespace {

std::string name_of(Index ring) { return ring ? "hole " + std::to_string(ring - 1) : "outer ring"; }

// Remaining points of one ring, by their numbers in the input.
struct Cleaned {
    std::vector<Index> source;
    std::vector<Removed> removed;
};

// Leave out repeated and collinear points; refuse rings on a line and spikes.
Cleaned cleaned(Index ring, const Points& v) {
    Cleaned result;
    std::vector<Index> different;
    for (Index k = 0; k < v.size(); ++k) {
        if (v.same(k, k ? k - 1 : v.size() - 1)) result.removed.push_back({ring, k, true});
        else different.push_back(k);
    }
    const std::size_t n = different.size();
    if (n < 3) throw InvalidPolygon(ring, "fewer than 3 different points; give at least 3");
    Index spike = -1;
    for (std::size_t k = 0; k < n; ++k) {
        const Index p = different[k ? k - 1 : n - 1], q = different[k], r = different[k + 1 < n ? k + 1 : 0];
        if (v.orient(p, q, r) != 0) result.source.push_back(q);
        else if (v.along(p, q, q, r) >= 0) result.removed.push_back({ring, q, false});
        else if (spike < 0) spike = q;
    }
    if (result.source.empty())
        throw InvalidPolygon(ring, "its points lie on one line, its area is zero; give points that bound an area");
    if (spike >= 0)
        throw InvalidPolygon(ring, "the angle at point " + std::to_string(spike) + " is zero; remove this spike", {spike});
    std::sort(result.removed.begin(), result.removed.end(), [](const Removed& a, const Removed& b) { return a.index < b.index; });
    return result;
}

// True if a ring without straight vertices turns to one side only, and once round.
bool is_convex_chain(const Points& v) {
    const Index n = v.size();
    const int side = v.orient(n - 1, 0, 1);
    int changes = 0;
    for (Index k = 0; k < n; ++k) {
        const Index p = k ? k - 1 : n - 1, r = k + 1 < n ? k + 1 : 0;
        if (v.orient(p, k, r) != side) return false;
        changes += v.is_upper(p, k) != v.is_upper(k, r);
    }
    return changes == 2;
}

// True if a simple ring without straight vertices, points first to beyond - 1, is counter-clockwise: its extreme corner turns
// like it.
bool is_counterclockwise(const Points& v, Index first, Index beyond) {
    Index k = first;
    for (Index m = first + 1; m < beyond; ++m)
        if (v.before(m, k)) k = m;
    return v.orient(k > first ? k - 1 : beyond - 1, k, k + 1 < beyond ? k + 1 : first) > 0;
}

// Text of a point, exact if that is short.
std::string shown(const Ratio& x, const Ratio& y) {
    const std::string a = text_of(x), b = text_of(y);
    if (a.size() + b.size() <= 24) return "(" + a + ", " + b + ")";
    return "about (" + text_of(nearest(x.n, x.d)) + ", " + text_of(nearest(y.n, y.d)) + ")";
}

// Text of a common point of the edges pq and rs.
std::string common_point(const Points& v, Index p, Index q, Index r, Index s, Meeting met, const Int& denominator) {
    const auto at = [&](Index k) { return shown(reduced(v.X(k), denominator), reduced(v.Y(k), denominator)); };
    if (met == Meeting::touch || met == Meeting::overlap) {
        const bool meet_at_end = met == Meeting::touch;
        for (const Index k : {p, q})
            if (meet_at_end && (v.same(k, r) || v.same(k, s))) return at(k);
        if (!meet_at_end) {  // the first common point
            const Index a = v.before(p, q) ? p : q, b = v.before(r, s) ? r : s;
            return at(v.before(a, b) ? b : a);
        }
    }
    const Vec<Int> u{v.X(q) - v.X(p), v.Y(q) - v.Y(p)}, w{v.X(s) - v.X(r), v.Y(s) - v.Y(r)};
    const Int n = cross(Vec<Int>{v.X(r) - v.X(p), v.Y(r) - v.Y(p)}, w), d = cross(u, w), unit = d * denominator;
    return shown(reduced(v.X(p) * d + n * u.x, unit), reduced(v.Y(p) * d + n * u.y, unit));
}

}  // namespace

InvalidPolygon::InvalidPolygon(Index ring_at_fault, const std::string& message, std::vector<Index> edges_at_fault)
    : std::invalid_argument(name_of(ring_at_fault) + ": " + message), ring(ring_at_fault), edges(std::move(edges_at_fault)) {}

Polygon::Polygon(std::vector<RatioRing> rings) {
    for (std::size_t r = 0; r < rings.size(); ++r) {
        if (rings[r].size() > 1 && rings[r].front() == rings[r].back()) rings[r].pop_back();
        if (rings[r].size() < 3)
            throw InvalidPolygon(static_cast<Index>(r), std::to_string(rings[r].size()) + " points; give at least 3");
    }
    const auto for_each = [&](const auto& use) {
        for (const RatioRing& ring : rings)
            for (const auto& point : ring) use(point.x), use(point.y);
    };
    const auto points = [&](auto&& whole) {
        std::vector<Points> result;
        for (const RatioRing& ring : rings) {
            std::vector<Int> x, y;
            x.reserve(ring.size()), y.reserve(ring.size());
            for (const auto& point : ring) x.push_back(whole(point.x)), y.push_back(whole(point.y));
            result.emplace_back(std::move(x), std::move(y));
        }
        return result;
    };
    const auto refuse_if_long = [](std::size_t bits) {
        if (bits >= 4 * most_digits)
            throw InvalidPolygon("the common denominator of the coordinates is too long; give decimals or fractions of fewer denominators");
    };
    unsigned most = 0;
    bool is_binary = true, is_least = false;  // doubles are
    for_each([&](const Ratio& c) {
        const auto exponent = static_cast<unsigned>(msb(c.d));
        is_binary = is_binary && exponent == lsb(c.d);
        if (exponent > most) most = exponent, is_least = false;
        if (exponent == most && bit_test(abs(c.n), 0)) is_least = true;
    });
    if (is_binary) {
        refuse_if_long(most);
        denominator <<= most;
        check(points([&](const Ratio& c) { return Int(c.n << (most - static_cast<unsigned>(msb(c.d)))); }), is_least);
        return;
    }
    std::map<Int, Int> factors;  // keys: denominators
    const Int* last = nullptr;
    for_each([&](const Ratio& c) {
        if (!last || *last != c.d) last = &factors.try_emplace(c.d).first->first;
    });
    for (const auto& [d, factor] : factors) denominator = lcm(denominator, d);
    refuse_if_long(msb(denominator));
    for (auto& [d, factor] : factors) factor = denominator / d;
    check(points([&, known = factors.begin()](const Ratio& c) mutable {
              if (known->first != c.d) known = factors.find(c.d);
              return Int(c.n * known->second);
          }),
          false);
}

Polygon::Polygon(std::vector<Points> rings, const Int& common) : denominator(common) { check(std::move(rings), false); }

Polygon Polygon::thin(const RatioRing& points) {
    if (points.empty() || points.size() > 2)
        throw InvalidPolygon(std::to_string(points.size()) + " points; give 1 for a point, 2 for a segment");
    if (points.size() == 2 && points[0] == points[1])
        throw InvalidPolygon("the two ends of the segment are the same; give 1 for a point, or another end");
    Polygon result;
    for (const auto& [x, y] : points) result.denominator = lcm(result.denominator, lcm(x.d, y.d));
    std::vector<Int> X, Y;
    for (const auto& [x, y] : points)
        X.push_back(x.n * (result.denominator / x.d)), Y.push_back(y.n * (result.denominator / y.d));
    result.vertices = Points(std::move(X), std::move(Y));
    const Index count = result.vertices.size();
    result.offsets = {0, count};
    result.convex.assign(points.size(), 1);
    result.is_convex_ring = true;
    result.found_pieces.emplace_back(points.size());
    std::iota(result.found_pieces[0].begin(), result.found_pieces[0].end(), 0);
    return result;
}

void Polygon::check(std::vector<Points>&& rings, bool is_least) {
    // clean
    std::vector<Cleaned> kept;
    std::vector<Int> x, y;
    offsets = {0};
    for (std::size_t r = 0; r < rings.size(); ++r) {
        kept.push_back(cleaned(static_cast<Index>(r), rings[r]));
        removed.insert(removed.end(), kept[r].removed.begin(), kept[r].removed.end());
        offsets.push_back(offsets.back() + static_cast<Index>(kept[r].source.size()));
    }
    const std::size_t count = rings.size();
    if (count == 1 && removed.empty()) {
        vertices = std::move(rings[0]);
    } else {
        for (std::size_t r = 0; r < count; ++r)
            for (const Index k : kept[r].source) x.push_back(rings[r].X(k)), y.push_back(rings[r].Y(k));
        vertices = Points(std::move(x), std::move(y));
    }
    is_convex_ring = count == 1 && is_convex_chain(vertices);
    std::vector<char> counterclockwise;
    for (std::size_t r = 0; r < count; ++r) counterclockwise.push_back(is_counterclockwise(vertices, offsets[r], offsets[r + 1]));
    // refuse rings whose edges meet, and holes that are not directly inside the outer ring
    if (!is_convex_ring) {
        const RingLinks links(offsets);
        const auto found = sweep(vertices, offsets);
        if (const auto* meeting = std::get_if<EdgesMeet>(&found)) {
            const auto [e, f] = *meeting;
            const Index q = links.next[e], s = links.next[f], ring = links.ring[e], other_ring = links.ring[f];
            const Index one = kept[ring].source[e - offsets[ring]], other = kept[other_ring].source[f - offsets[other_ring]];
            const Meeting met = meet(vertices, e, q, f, s);
            const std::string at = common_point(vertices, e, q, f, s, met, denominator);
            const std::string verb = met == Meeting::cross ? "cross" : met == Meeting::touch ? "touch" : "overlap";
            if (ring == other_ring)
                throw InvalidPolygon(ring, "edges " + std::to_string(one) + " and " + std::to_string(other) + " " + verb + " at " + at +
                                               "; split it into simple polygons", {one, other});
            throw InvalidPolygon(other_ring, "edge " + std::to_string(other) + " " + verb + (met == Meeting::overlap ? "s" : "es") +
                                                 " edge " + std::to_string(one) + " of " + name_of(ring) + " at " + at +
                                                 "; keep the rings apart", {other, one});
        }
        const auto container = containers(std::get<Nesting>(found), links.ring, counterclockwise);
        for (Index hole = 1; hole < static_cast<Index>(count); ++hole) {
            if (container[0] == hole) throw InvalidPolygon(hole, "it lies around the outer ring; swap the two");
            if (container[hole] < 0) throw InvalidPolygon(hole, "it lies outside the outer ring; move it, or leave it out");
            if (container[hole] > 0)
                throw InvalidPolygon(hole, "it lies inside " + name_of(container[hole]) + "; give it as another polygon");
        }
    }
    // turn around
    std::vector<Index> order(static_cast<std::size_t>(vertices.size()));
    std::iota(order.begin(), order.end(), 0);
    bool turned = false;
    for (std::size_t r = 0; r < count; ++r)
        if ((counterclockwise[r] != 0) != (r == 0)) {
            std::reverse(order.begin() + offsets[r] + 1, order.begin() + offsets[r + 1]);
            turned = true;
        }
    if (turned) vertices = vertices.chosen(order);
    // removed points may leave a common factor
    Int common = is_least && removed.empty() ? Int(1) : denominator;
    for (Index k = 0; k < vertices.size() && common != 1; ++k) common = gcd(gcd(common, vertices.X(k)), vertices.Y(k));
    if (common != 1) {
        auto whole = vertices.coordinates();
        for (auto& axis : whole)
            for (Int& c : axis) c /= common;
        vertices = Points(std::move(whole[0]), std::move(whole[1]));
        denominator /= common;
    }
    convex.assign(static_cast<std::size_t>(vertices.size()), 1);
    if (is_convex_ring) return;
    const RingLinks links(offsets);
    for (Index k = 0; k < vertices.size(); ++k) convex[k] = vertices.orient(links.previous[k], k, links.next[k]) > 0;
}

const Pieces& Polygon::pieces() const {
    if (found_pieces.empty()) found_pieces = convex_pieces(*this);
    return found_pieces;
}

bool is_inside(const Polygon& inner, const Polygon& outer) {
    const Int scale = lcm(inner.denominator, outer.denominator);
    std::vector<Int> x, y;
    std::vector<Index> offsets{0};
    std::vector<char> counterclockwise;
    for (const Polygon* polygon : {&inner, &outer}) {
        const Int factor = scale / polygon->denominator;
        const Index first = offsets.back();
        for (Index k = 0; k < polygon->vertices.size(); ++k)
            x.push_back(polygon->vertices.X(k) * factor), y.push_back(polygon->vertices.Y(k) * factor);
        for (std::size_t r = 1; r < polygon->offsets.size(); ++r)
            offsets.push_back(first + polygon->offsets[r]), counterclockwise.push_back(r == 1);
    }
    const Points points(std::move(x), std::move(y));
    const auto found = sweep(points, offsets);
    const auto* nesting = std::get_if<Nesting>(&found);
    if (!nesting || !nesting->touching.empty()) return false;
    const Index count = inner.vertices.size();
    const auto order = swept_order(points);
    for (std::size_t k = 1; k < order.size(); ++k)
        if ((order[k - 1] < count) != (order[k] < count) && points.same(order[k - 1], order[k])) return false;
    const auto container = containers(*nesting, RingLinks(offsets).ring, counterclockwise);
    const auto mine = std::size_t{0}, its = inner.offsets.size() - 1;  // outer rings
    // holes of the outer polygon are outside the inner one, or in holes of it
    return container[mine] == static_cast<Index>(its) &&
           std::none_of(container.begin() + static_cast<std::ptrdiff_t>(its) + 1, container.end(),
                        [](Index around) { return around == 0; });
}

}  // namespace cfree
