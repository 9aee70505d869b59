// Mitre corners in doubles, and check the result exactly; theory, "Separations".
#include "cfree/polygons/inset.hpp"

#include <algorithm>

#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

constexpr double least_share = 0x1p-30;  // limit of a mitre: corners that are sharper move no farther
constexpr int finer = 12;  // bits of an inset that the rounding of its polygons leaves

// Exponent k with 2^(k - 1) <= x < 2^k, x > 0.
int exponent_of(const Ratio& x) {
    const int k = static_cast<int>(msb(x.n)) - static_cast<int>(msb(x.d));
    return x < power_of_two(k) ? k : k + 1;
}

// Nearest multiple, the even one of two.
Ratio snapped(const Ratio& x, const Ratio& grid) {
    const Ratio steps = x / grid;
    Int floor, rest;
    divide_qr(steps.n, steps.d, floor, rest);
    if (rest.sign() < 0) floor -= 1, rest += steps.d;
    const int half = Int(2 * rest).compare(steps.d);
    if (half > 0 || (half == 0 && bit_test(floor.sign() < 0 ? Int(-floor) : floor, 0))) floor += 1;
    return Ratio{floor, 1} * grid;
}

Vec<double> unit(const Polygon& polygon, Index from, Index to) {
    const auto& v = polygon.vertices;
    const double x = nearest(v.X(to) - v.X(from), polygon.denominator), y = nearest(v.Y(to) - v.Y(from), polygon.denominator);
    const double length = norm(x, y);
    return {x / length, y / length};
}

// Rings with edges moved inwards, up to the rounding of directions of vertices; none if an edge turns.
std::vector<RatioRing> mitred(const Polygon& polygon, const Ratio& by) {
    const auto& v = polygon.vertices;
    std::vector<RatioRing> rings;
    for (std::size_t r = 0; r + 1 < polygon.offsets.size(); ++r) {
        const Index first = polygon.offsets[r], n = polygon.offsets[r + 1] - first;
        const auto at = [&](Index k) { return first + (k + n) % n; };
        RatioRing& ring = rings.emplace_back();
        for (Index k = 0; k < n; ++k) {
            const Vec<double> in = unit(polygon, at(k - 1), at(k)), out = unit(polygon, at(k), at(k + 1));
            const double share = std::max(1 + ((-in.y) * (-out.y) + in.x * out.x), least_share);
            const double dx = ((-in.y) + (-out.y)) / share, dy = (in.x + out.x) / share;
            ring.push_back({reduced(v.X(at(k)), polygon.denominator) + by * ratio_of(dx),
                            reduced(v.Y(at(k)), polygon.denominator) + by * ratio_of(dy)});
        }
        for (Index k = 0; k < n; ++k) {
            const RatioPoint &p = ring[static_cast<std::size_t>(k)], &q = ring[static_cast<std::size_t>((k + 1) % n)];
            const Ratio u{v.X(at(k + 1)) - v.X(at(k)), 1}, w{v.Y(at(k + 1)) - v.Y(at(k)), 1};
            if (((q.x - p.x) * u + (q.y - p.y) * w).n.sign() <= 0) return {};
        }
    }
    return rings;
}

std::shared_ptr<const Polygon> within(std::vector<RatioRing> rings, const Polygon& outer) {
    try {
        auto found = std::make_shared<const Polygon>(std::move(rings));
        if (is_inside(*found, outer)) return found;
    } catch (const InvalidPolygon&) {  // not simple, or too thin for the grid
    }
    return nullptr;
}

}  // namespace

std::shared_ptr<const Polygon> inset(const Polygon& polygon, const Ratio& by) {
    const std::vector<RatioRing> rings = mitred(polygon, by);
    if (rings.empty()) return nullptr;
    const Ratio grid = power_of_two(exponent_of(by) - finer);
    std::vector<RatioRing> rounded = rings;
    for (RatioRing& ring : rounded)
        for (RatioPoint& p : ring) p = {snapped(p.x, grid), snapped(p.y, grid)};
    auto found = within(std::move(rounded), polygon);
    return found ? found : within(rings, polygon);
}

}  // namespace cfree
