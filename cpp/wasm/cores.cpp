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
constexpr int finest_fillets = 8, finest_widening = 6;  // the same where some are concave; points are 2^-k beyond tangents

using Ring = std::vector<GivenCurve>;

RatioPoint vertex(const Polygon& polygon, Index k) {
    return {reduced(polygon.vertices.X(k), polygon.denominator), reduced(polygon.vertices.Y(k), polygon.denominator)};
}

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

// Lines and quarters of arcs, the shape on their left; nothing if there are others, or cusps.
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
        if (cross(before, after) == zero && dot(before, after) < zero) return {};
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
    const auto key = [](const RatioPoint& p, const RatioPoint& q) { return std::array{p.x, p.y, q.x, q.y}; };
    std::set<std::array<Ratio, 4>> chords;
    for (std::size_t r = 0; r + 1 < core->offsets.size(); ++r)
        for (Index k = core->offsets[r]; k < core->offsets[r + 1]; ++k)
            chords.insert(key(vertex(*core, k), vertex(*core, k + 1 < core->offsets[r + 1] ? k + 1 : core->offsets[r])));
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

// A line, or an arc in a triangle with its chord; see src/cfree/scene/hull_triangles.py.
struct HullTriangle {
    RatioRing corners;
    std::optional<std::array<RatioPoint, 2>> beyond = {};
};

HullTriangle hull_triangle(const GivenCurve& side, const Ratio& wider) {
    if (side.turn == 0) return {{side.start, side.end}};
    const RatioPoint first = side.start - side.center, last = side.end - side.center;
    const Ratio square = dot(first, first), share = square / (square + dot(first, last)), half{1, 2};
    const RatioPoint tangents = side.center + times(first + last, share);
    if (side.turn > 0) return {{side.start, side.end, tangents}};
    const auto beyond = [&](const Ratio& by) { return tangents + times(tangents - times(side.start + side.end, half), by); };
    const RatioPoint far = beyond(wider);
    return {{side.start, side.end, far}, std::array{beyond(wider * half), far}};
}

bool are_apart(const RatioRing& p, const RatioRing& q, const RatioPoint& at, const RatioPoint& along) {
    const auto sides = [&](const RatioRing& points) {
        std::vector<Ratio> all;
        for (const RatioPoint& x : points) all.push_back(cross(along, x - at));
        return std::pair{*std::min_element(all.begin(), all.end()), *std::max_element(all.begin(), all.end())};
    };
    const auto [least, most] = sides(p);
    const auto [other_least, other_most] = sides(q);
    return most < other_least || other_most < least;
}

// True if two convex sets have at most one corner in common, and are apart otherwise.
bool meet_in_a_corner(const RatioRing& p, const RatioRing& q) {
    const auto is_same = [](const RatioPoint& a, const RatioPoint& b) { return a.x == b.x && a.y == b.y; };
    RatioRing common;
    for (const RatioPoint& x : p)
        if (std::any_of(q.begin(), q.end(), [&](const RatioPoint& y) { return is_same(x, y); })) common.push_back(x);
    if (common.size() > 1) return false;
    if (common.empty()) {
        for (const RatioRing* ring : {&p, &q}) {
            for (std::size_t i = 0; i < ring->size(); ++i)
                for (std::size_t j = i + 1; j < ring->size(); ++j) {
                    const RatioPoint along = (*ring)[j] - (*ring)[i];
                    if (are_apart(p, q, (*ring)[i], along)) return true;
                    if (ring->size() == 2)  // across it, at both ends
                        for (const RatioPoint& end : *ring)
                            if (are_apart(p, q, end, to_left(along))) return true;
                }
        }
        return false;
    }
    const auto others = [&](const RatioRing& points) {
        RatioRing rest;
        for (const RatioPoint& x : points)
            if (!is_same(x, common.front())) rest.push_back(x - common.front());
        return rest;
    };
    const RatioRing rest = others(p), more = others(q);
    for (const RatioRing* ring : {&rest, &more})
        for (const RatioPoint& along : *ring)
            for (const int sign : {1, -1}) {
                const auto side = [&](const RatioPoint& x) { return sign * cross(along, x).n.sign(); };
                int least = 1, most = -1;
                for (const RatioPoint& x : rest) least = std::min(least, side(x));
                for (const RatioPoint& x : more) most = std::max(most, side(x));
                if ((least >= 0 && most < 0) || (least > 0 && most <= 0)) return true;
            }
    return rest.size() == 1 && more.size() == 1 && cross(rest[0], more[0]) == zero && dot(rest[0], more[0]) < zero;
}

// The numbers of those that have more in common with another one than one corner of both.
std::set<std::size_t> meeting(const std::vector<HullTriangle>& triangles) {
    struct Box {
        double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL;
    };
    std::vector<Box> boxes;
    for (const HullTriangle& triangle : triangles) {
        Box& box = boxes.emplace_back();
        double most = 0;
        for (const RatioPoint& p : triangle.corners) {
            const double x = near(p.x), y = near(p.y);
            box = {std::min(box.x0, x), std::max(box.x1, x), std::min(box.y0, y), std::max(box.y1, y)};
            most = std::max({most, std::abs(x), std::abs(y)});
        }
        const double slack = 0x1p-40 * most;
        box = {box.x0 - slack, box.x1 + slack, box.y0 - slack, box.y1 + slack};
    }
    std::set<std::size_t> found;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t j = i + 1; j < triangles.size(); ++j) {
            const Box &a = boxes[i], &b = boxes[j];
            if (a.x0 > b.x1 || b.x0 > a.x1 || a.y0 > b.y1 || b.y0 > a.y1) continue;
            if (!meet_in_a_corner(triangles[i].corners, triangles[j].corners)) found.insert({i, j});
        }
    return found;
}

// The fraction nearest to a number whose denominator is not larger than some.
Ratio with_denominator(const Ratio& x, const Int& most) {
    if (x.d <= most) return x;
    Int p0 = 0, q0 = 1, p1 = 1, q1 = 0, n = x.n, d = x.d;
    for (;;) {
        const Int a = floor_divide(n, d), q2 = q0 + a * q1;
        if (q2 > most) break;
        const Int p2 = p0 + a * p1, rest = n - a * d;
        p0 = p1, q0 = q1, p1 = p2, q1 = q2, n = d, d = rest;
    }
    const Int k = (most - q0) / q1;
    const Ratio one_bound = reduced(p0 + k * p1, q0 + k * q1), other = reduced(p1, q1);
    const auto apart = [&](const Ratio& y) {
        const Ratio difference = y - x;
        return difference.n < 0 ? -difference : difference;
    };
    return apart(one_bound) < apart(other) ? one_bound : other;
}

// A part of an arc, from one of its points to another one, less than half a turn.
GivenCurve part_of(const GivenCurve& arc, const RatioPoint& start, const RatioPoint& end) {
    const RatioPoint u = start - arc.center, w = end - arc.center;
    Ratio tangent = cross(u, w) / (dot(u, u) + dot(u, w));
    if (tangent.n < 0) tangent = -tangent;
    GivenCurve part{start, end, arc.center, arc.turn, 0, tangent};
    if (tangent >= one) part.quarters = 1, part.rest = zero;
    return part;
}

struct CutSide {
    std::size_t ring;
    int cuts;
    GivenCurve side;
};

std::vector<CutSide> halves(const CutSide& of) {
    const double tangent_there = tangent(sweep_of(of.side) / 4);
    const Int most = std::max<long long>(8, static_cast<long long>(std::ceil(2 / tangent_there)));
    const RatioPoint middle = point_of(of.side, 0, with_denominator(ratio_of(tangent_there), most));
    return {{of.ring, of.cuts + 1, part_of(of.side, of.side.start, middle)}, {of.ring, of.cuts + 1, part_of(of.side, middle, of.side.end)}};
}

RoundedShape with_fillets(const std::vector<CutSide>& sides, const std::vector<HullTriangle>& triangles, std::size_t rings) {
    std::vector<RatioRing> corners(rings);
    Rounding rounding{zero, {}};
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const GivenCurve& side = sides[k].side;
        RatioRing& ring = corners[sides[k].ring];
        ring.push_back(side.start);
        if (side.turn == 0) continue;
        if (triangles[k].beyond) ring.push_back((*triangles[k].beyond)[0]);
        rounding.arcs.push_back({side.start, side.end, side.center, *radius_of(side), triangles[k].beyond});
    }
    return {std::make_shared<const Polygon>(std::move(corners)), std::move(rounding)};
}

// The polygon of chords of convex arcs, and of lines beyond concave ones. Arcs are cut in halves while their triangles meet
// others; nothing if they are as fine as may be.
std::optional<RoundedShape> on_hulls(const std::vector<Ring>& rings) try {
    std::vector<CutSide> sides;
    for (std::size_t r = 0; r < rings.size(); ++r)
        for (const GivenCurve& side : rings[r]) sides.push_back({r, 0, side});
    for (;;) {
        std::set<std::size_t> found;
        for (int k = 2; k <= finest_widening; ++k) {
            std::vector<HullTriangle> triangles;
            for (const CutSide& cut_side : sides) triangles.push_back(hull_triangle(cut_side.side, power_of_two(-k)));
            found = meeting(triangles);
            if (found.empty()) return with_fillets(sides, triangles, rings.size());
        }
        std::vector<CutSide> finer;
        for (std::size_t k = 0; k < sides.size(); ++k) {
            if (!found.contains(k) || sides[k].side.turn == 0 || sides[k].cuts >= finest_fillets) finer.push_back(sides[k]);
            else
                for (CutSide& half : halves(sides[k])) finer.push_back(std::move(half));
        }
        if (finer.size() == sides.size()) return {};
        sides = std::move(finer);
    }
} catch (const InvalidPolygon&) {
    return {};
}

// A shape of lines and arcs, as a polygon of chords, and of lines beyond concave arcs; nothing if it is none.
std::optional<RoundedShape> with_arcs(const GivenShape& shape) {
    std::vector<Ring> rings;
    for (const Ring& ring : shape.rings) {
        auto sides = sides_of(ring, !rings.empty());
        if (!sides) return {};
        rings.push_back(std::move(*sides));
    }
    for (const Ring& ring : rings)
        if (std::any_of(ring.begin(), ring.end(), [](const GivenCurve& side) { return side.turn < 0; })) return on_hulls(rings);
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

namespace {

// The box of a shape, too large by a part of its arcs' circles.
struct Extent {
    double x0 = HUGE_VAL, y0 = HUGE_VAL, x1 = -HUGE_VAL, y1 = -HUGE_VAL, reach = 0;
    void add(const RatioPoint& p, double r) {
        const double x = near(p.x), y = near(p.y);
        x0 = std::min(x0, x - r), x1 = std::max(x1, x + r), y0 = std::min(y0, y - r), y1 = std::max(y1, y + r);
        reach = std::max(reach, std::hypot(x, y) + r);
    }
    void add(const GivenShape& shape) {
        const double grown = near(shape.grown);
        for (const auto& ring : shape.rings)
            for (const GivenCurve& curve : ring) {
                const RatioPoint u = curve.start - curve.center;
                add(curve.start, grown);
                if (curve.turn != 0) add(curve.center, std::sqrt(near(dot(u, u))) + grown);
            }
        if (!shape.polygon) return;
        for (Index k = 0; k < shape.polygon->vertices.size(); ++k) add(vertex(*shape.polygon, k), grown);
    }
};

}  // namespace

std::vector<GivenShape> complement(const GivenScene& scene) {
    constexpr double fineness = 8;  // steps of the frame's rim in its width
    if (!scene.workspace || !scene.workspace->has_arcs()) return {};
    Extent box, robot;
    box.add(*scene.workspace);
    for (const GivenShape& obstacle : scene.obstacles) box.add(obstacle);
    for (const GivenShape& part : scene.robot) robot.add(part);
    if (scene.bounds) box.add({(*scene.bounds)[0], (*scene.bounds)[1]}, 0), box.add({(*scene.bounds)[2], (*scene.bounds)[3]}, 0);
    const double thickness = 4 * robot.reach, width = std::max(box.x1 - box.x0, box.y1 - box.y0) + thickness;
    const double step = std::exp2(std::floor(std::log2(width))) / fineness;
    const auto below = [&](double x) { return ratio_of(std::floor((x - thickness) / step) * step); };
    const auto above = [&](double x) { return ratio_of(std::ceil((x + thickness) / step) * step); };
    const Ratio x0 = below(box.x0), y0 = below(box.y0), x1 = above(box.x1), y1 = above(box.y1);
    const RatioPoint corners[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    GivenShape frame;
    frame.is_round = true;
    auto& rim = frame.rings.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) rim.push_back({corners[k], corners[(k + 1) % 4]});
    frame.rings.push_back(scene.workspace->rings.front());
    std::vector<GivenShape> result{std::move(frame)};
    for (std::size_t r = 1; r < scene.workspace->rings.size(); ++r) {
        GivenShape hole;
        hole.is_round = true;
        hole.rings.push_back(scene.workspace->rings[r]);
        result.push_back(std::move(hole));
    }
    return result;
}

}  // namespace cfree
