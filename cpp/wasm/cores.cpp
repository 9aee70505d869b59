// Cores of round shapes; the numbers are those of Python, so that boundaries have the same bytes.
#include "cores.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "cfree/support/elementary.hpp"
#include "points.hpp"

namespace cfree {

using namespace rational;

namespace {

constexpr int finest_cuts = 5;  // of a quarter circle in halves, for chords that meet no other side

using Ring = std::vector<GivenCurve>;

std::optional<Ratio> radius_of(const GivenCurve& arc) {
    const RatioPoint u = arc.start - arc.center;
    return rational_root(dot(u, u));
}

RatioPoint direction(const GivenCurve& curve, bool at_end) {
    if (curve.turn == 0) return curve.end - curve.start;
    return times(to_left((at_end ? curve.end : curve.start) - curve.center), {curve.turn, 1});
}

// A convex ring of lines and of arcs of one radius, all tangent.
std::optional<RoundedShape> convex(const Ring& ring) {
    std::optional<Ratio> square;
    int turn = 0;
    RatioRing centers;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const GivenCurve& curve = ring[k];
        const RatioPoint before = direction(ring[k ? k - 1 : ring.size() - 1], true), after = direction(curve, false);
        if (cross(before, after) != zero || dot(before, after) < zero) return {};
        if (curve.turn == 0) continue;
        const RatioPoint u = curve.start - curve.center;
        if (square && (dot(u, u) != *square || curve.turn != turn)) return {};
        square = dot(u, u), turn = curve.turn;
        if (std::find(centers.begin(), centers.end(), curve.center) == centers.end()) centers.push_back(curve.center);
    }
    const auto radius = square ? rational_root(*square) : std::nullopt;
    if (!radius) return {};
    return RoundedShape{std::make_shared<const Polygon>(centers.size() < 3 ? Polygon::thin(centers) : Polygon({centers})), {*radius, {}}};
}

double sweep_of(const GivenCurve& arc) { return 0.5 * std::numbers::pi * arc.quarters + 2 * arc_tangent(near(arc.rest)); }

// Lines and quarters of convex arcs, the shape on their left; nothing if there are others, or cusps.
std::optional<Ring> sides_of(const Ring& ring, bool is_hole) {
    Ring sides;
    double area = 0;  // twice
    for (const GivenCurve& curve : ring)
        for (const GivenCurve& part : quarters_of(curve)) {
            if (part.turn != 0 && !radius_of(part)) return {};
            area += near(cross(part.start, part.end));
            if (part.turn != 0) {
                const RatioPoint u = part.start - part.center;
                const double sweep = sweep_of(part);
                area += part.turn * (sweep - sine(sweep)) * near(dot(u, u));
            }
            sides.push_back(part);
        }
    if ((area < 0) != is_hole) {
        std::reverse(sides.begin(), sides.end());
        for (GivenCurve& side : sides) std::swap(side.start, side.end), side.turn = -side.turn;
    }
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const RatioPoint before = direction(sides[k ? k - 1 : sides.size() - 1], true), after = direction(sides[k], false);
        if (sides[k].turn < 0 || (cross(before, after) == zero && dot(before, after) < zero)) return {};
    }
    return sides;
}

// The sides, arcs in so many parts.
Ring cut(const Ring& sides, int parts) {
    Ring all;
    for (const GivenCurve& side : sides) {
        if (side.turn == 0 || parts == 1) {
            all.push_back(side);
            continue;
        }
        const double sweep = sweep_of(side);
        GivenCurve part = side;
        for (int k = 1; k <= parts; ++k, part.start = part.end) {
            const Ratio tangent_there{Int(std::llround(tangent(sweep * k / parts / 2) * 256)), 256};
            part.end = k < parts ? point_of(side, 0, reduced(tangent_there.n, tangent_there.d)) : side.end;
            all.push_back(part);
        }
    }
    return all;
}

// The polygon of chords with its arcs; nothing if it is no polygon, or has not all ends of arcs as vertices.
std::optional<RoundedShape> on_chords(const std::vector<Ring>& rings) try {
    std::vector<RatioRing> points;
    for (const Ring& ring : rings) {
        points.emplace_back();
        for (const GivenCurve& side : ring) points.back().push_back(side.start);
    }
    auto core = std::make_shared<const Polygon>(std::move(points));
    const auto vertex = [&](Index k) {
        return RatioPoint{reduced(core->vertices.X[k], core->denominator), reduced(core->vertices.Y[k], core->denominator)};
    };
    const auto key = [](const RatioPoint& p, const RatioPoint& q) { return std::array{p.x, p.y, q.x, q.y}; };
    std::set<std::array<Ratio, 4>> chords;
    for (std::size_t r = 0; r + 1 < core->offsets.size(); ++r)
        for (Index k = core->offsets[r]; k < core->offsets[r + 1]; ++k)
            chords.insert(key(vertex(k), vertex(k + 1 < core->offsets[r + 1] ? k + 1 : core->offsets[r])));
    Rounding rounding{zero, {}};
    for (const Ring& ring : rings)
        for (const GivenCurve& side : ring) {
            if (side.turn == 0) continue;
            if (!chords.contains(key(side.start, side.end))) return {};
            rounding.arcs.push_back({side.start, side.end, side.center, *radius_of(side)});
        }
    return RoundedShape{std::move(core), std::move(rounding)};
} catch (const InvalidPolygon&) {
    return {};
}

// A shape of lines and convex arcs, as the polygon of their chords; nothing if it is none.
std::optional<RoundedShape> with_arcs(const GivenShape& shape) {
    std::vector<Ring> rings;
    for (const Ring& ring : shape.rings) {
        auto sides = sides_of(ring, !rings.empty());
        if (!sides) return {};
        rings.push_back(std::move(*sides));
    }
    for (int cuts = 0; cuts <= finest_cuts; ++cuts) {
        std::vector<Ring> finer;
        for (const Ring& ring : rings) finer.push_back(cut(ring, 1 << cuts));
        if (auto found = on_chords(finer)) return found;
    }
    return {};
}

}  // namespace

std::optional<RoundedShape> rounded(const GivenShape& shape) {
    if (shape.polygon) return RoundedShape{shape.polygon, {shape.grown, {}}};
    auto found = shape.rings.size() > 1 ? std::nullopt : convex(shape.rings.front());
    if (!found) found = with_arcs(shape);
    if (found) found->rounding.radius = found->rounding.radius + shape.grown;
    return found;
}

}  // namespace cfree
