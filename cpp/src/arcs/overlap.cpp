// Boundaries are cut where they meet; then one point of each part is located. Theory, "Segments and arcs".
#include "arcs/overlap.hpp"

#include <algorithm>

#include "arcs/vectors.hpp"
#include "cfree/exact/surd.hpp"

namespace cfree {

namespace {

Int square_of_radius(const RoundEdge& arc) { return square(arc.start - arc.center); }
const Ratio zero{0, 1}, one{1, 1};

// Around the triangle of the ends and the intersection of the end tangents.
Box box_around(const RoundEdge& curve, int shift) {
    const auto rounded = [&](const Vec<Int>& p) { return Vec<double>{ball(p.x, shift).hi, ball(p.y, shift).hi}; };
    Box box;
    const Vec<double> p = rounded(curve.start), q = rounded(curve.end);
    box.add(p.x, p.y), box.add(q.x, q.y);
    if (curve.turn != 0) {
        const Vec<double> u = rounded(curve.start - curve.center), w = rounded(curve.end - curve.center);
        const double tangent = cross(u, w) / (dot(u, u) + dot(u, w));  // of half the turn, with its sign
        box.add(p.x - u.y * tangent, p.y + u.x * tangent);
    }
    return grown(box);
}

// True if a direction is in the cone of an arc's radii.
bool is_in_cone(const RoundEdge& arc, const Vec<Int>& d) {
    const Vec<Int> u = arc.start - arc.center, w = arc.end - arc.center;
    return cross(u, d).sign() * arc.turn >= 0 && cross(d, w).sign() * arc.turn >= 0 && dot(d, u).sign() + dot(d, w).sign() > 0;
}

// Parameter of a point of the curve.
Ratio parameter_of(const RoundEdge& curve, const Vec<Int>& point) {
    if (curve.turn == 0) {
        const Vec<Int> e = curve.end - curve.start;
        return reduced(dot(e, point - curve.start), square(e));
    }
    const Vec<Int> u = curve.start - curve.center, w = point - curve.center;
    return reduced(cross(u, w) * curve.turn, square(u) + dot(u, w));
}

// Polynomial of the parameter of a that is zero where a meets the line or circle of b; all zero if they are the same.
std::array<Int, 3> meeting(const RoundEdge& a, const RoundEdge& b) {
    if (a.turn == 0) {
        const Vec<Int> e = a.end - a.start;
        if (b.turn == 0) {
            const Vec<Int> f = b.end - b.start;
            return {cross(f, a.start - b.start), cross(f, e), 0};
        }
        const Vec<Int> d = a.start - b.center;
        return {square(d) - square_of_radius(b), 2 * dot(e, d), square(e)};
    }
    const Vec<Int> u = a.start - a.center, t = a.turn > 0 ? turned(u) : -turned(u);
    Int middle, along, across;  // the value at the center, and its growth along u and t
    if (b.turn == 0) {
        const Vec<Int> f = b.end - b.start;
        middle = cross(f, a.center - b.start), along = cross(f, u), across = cross(f, t);
    } else {
        const Vec<Int> d = a.center - b.center;
        middle = square(u) + square(d) - square_of_radius(b), along = 2 * dot(u, d), across = 2 * dot(t, d);
    }
    return {middle + along, 2 * across, middle - along};
}

bool is_shorter(const Vec<Int>& v, const Int& distance) { return square(v) < distance * distance; }

// True if a point is closer than a distance to an inner point of a curve that is nearest to it, or farthest.
bool is_closer(const Vec<Int>& p, const RoundEdge& b, const Int& distance) {
    if (b.turn == 0) {
        const Vec<Int> e = b.end - b.start, d = p - b.start;
        const Int along = dot(e, d), across = cross(e, d), length = square(e);
        return along.sign() > 0 && along < length && across * across < distance * distance * length;
    }
    const Vec<Int> d = p - b.center;
    if (!is_in_cone(b, d)) return false;
    const Int far = square(d), radius = square_of_radius(b);  // squares; (sqrt(far) - sqrt(radius))^2 < distance^2
    return (RootSum(far + radius - distance * distance) - RootSum(2) * RootSum::root(far * radius)).sign() < 0;
}

// The same for the common normals of a line and an arc, and of two arcs.
bool line_is_closer(const RoundEdge& a, const RoundEdge& b, const Int& distance) {
    const Vec<Int> e = a.end - a.start, d = b.center - a.start;
    const Int along = dot(e, d), offset = cross(e, d), length = square(e), radius = square_of_radius(b);
    if (along.sign() <= 0 || along >= length) return false;
    const RootSum sum(offset * offset + radius * length - distance * distance * length);
    const RootSum twice = RootSum(2 * offset) * RootSum::root(radius * length);
    const Vec<Int> normal = turned(e);
    return (is_in_cone(b, normal) && (sum + twice).sign() < 0) || (is_in_cone(b, -normal) && (sum - twice).sign() < 0);
}
bool arc_is_closer(const RoundEdge& a, const RoundEdge& b, const Int& distance) {
    const Vec<Int> d = b.center - a.center;
    if (d.x.is_zero() && d.y.is_zero()) return false;  // an end of one is as near
    const RootSum apart = RootSum::root(square(d)), r = RootSum::root(square_of_radius(a)), s = RootSum::root(square_of_radius(b));
    for (const int i : {1, -1}) {
        if (!is_in_cone(a, i > 0 ? d : -d)) continue;
        for (const int j : {1, -1}) {
            if (!is_in_cone(b, j > 0 ? d : -d)) continue;
            const RootSum gap = apart + RootSum(j) * s - RootSum(i) * r;
            if ((gap - RootSum(distance)).sign() < 0 && (gap + RootSum(distance)).sign() > 0) return true;
        }
    }
    return false;
}

bool are_closer(const RoundEdge& a, const RoundEdge& b, const Int& distance) {
    for (const auto* p : {&a.start, &a.end}) {
        for (const auto* q : {&b.start, &b.end})
            if (is_shorter(*p - *q, distance)) return true;
        if (is_closer(*p, b, distance)) return true;
    }
    for (const auto* q : {&b.start, &b.end})
        if (is_closer(*q, a, distance)) return true;
    if (a.turn == 0 && b.turn == 0) return false;
    if (a.turn == 0) return line_is_closer(a, b, distance);
    if (b.turn == 0) return line_is_closer(b, a, distance);
    return arc_is_closer(a, b, distance);
}

// Parameters strictly inside a at which it meets the lines and circles of other curves, or these end on it.
std::vector<QuadraticRoot> cuts(const RoundEdge& a, const std::vector<const RoundEdge*>& others) {
    const Ratio last = last_parameter(a);
    std::vector<QuadraticRoot> found;
    for (const RoundEdge* b : others) {
        const auto [c, d, e] = meeting(a, *b);
        if (!c.is_zero() || !d.is_zero() || !e.is_zero()) {
            add_roots({RootSum(c), RootSum(d), RootSum(e)}, zero, last, found);
            continue;
        }
        for (const auto* p : {&b->start, &b->end}) {
            if (a.turn != 0 && !is_in_cone(a, *p - a.center)) continue;
            const Ratio at = parameter_of(a, *p);
            add_roots({RootSum(-at.n), RootSum(at.d), RootSum(0)}, zero, last, found);
        }
    }
    return found;
}

// True if two curves that share a part run in the same direction there.
bool run_alike(const RoundEdge& a, const RoundEdge& b) {
    return a.turn == 0 ? dot(a.end - a.start, b.end - b.start).sign() > 0 : a.turn == b.turn;
}

HomogeneousPoint spot_of(const Vec<Int>& p) { return {p.x, p.y, 1}; }

bool is_inside(const PlacedShape& b, const RoundEdge& a, const HomogeneousPoint& spot) {
    Index met = 0;
    const auto turns = turns_about(b, 0, static_cast<Index>(b.curves.size()), spot, &met);
    if (!turns) return run_alike(a, b.curves[static_cast<std::size_t>(met)]);
    return *turns + (b.is_outside ? 1 : 0) != 0;
}

// True if a part of a's rings is inside of b, or runs along a ring of b with both insides on one side. Parts of a ring far from
// b's rings are where its other parts are.
bool enters(const PlacedShape& a, const PlacedShape& b) {
    for (std::size_t k = 0; k + 1 < a.ring->size(); ++k) {
        bool is_near = false;
        const auto first = static_cast<std::size_t>((*a.ring)[k]), last = static_cast<std::size_t>((*a.ring)[k + 1]);
        for (std::size_t i = first; i < last; ++i) {
            std::vector<const RoundEdge*> near;
            for (std::size_t j = 0; j < b.curves.size(); ++j)
                if (a.boxes[i].meets(b.boxes[j])) near.push_back(&b.curves[j]);
            if (near.empty()) continue;
            is_near = true;
            auto roots = cuts(a.curves[i], near);
            for (const Ratio& sample : samples_between(roots, zero, last_parameter(a.curves[i])))
                if (is_inside(b, a.curves[i], point_at(a.curves[i], sample))) return true;
        }
        if (!is_near && first < last && is_inside(b, a.curves[first], spot_of(a.curves[first].start))) return true;
    }
    return false;
}

}  // namespace

PlacedShape::PlacedShape(const ArcShape& shape, std::vector<RoundEdge> placed, int shift_of_boxes)
    : ring(&shape.ring), is_outside(shape.is_outside), curves(std::move(placed)), shift(shift_of_boxes) {
    for (const RoundEdge& curve : curves) boxes.push_back(box_around(curve, shift));
}

int shift_for(const std::vector<RoundEdge>& a, const std::vector<RoundEdge>& b) {
    int bits = 0;
    for (const auto* curves : {&a, &b})
        for (const RoundEdge& curve : *curves)
            for (const auto* p : {&curve.start, &curve.center}) bits = std::max({bits, bits_of(p->x), bits_of(p->y)});
    return bits;
}

std::optional<int> turns_about(const PlacedShape& shape, Index first, Index last, const HomogeneousPoint& spot, Index* met) {
    const int shift = shape.shift + bits_of(spot.w);
    const double scale = ball(spot.w, bits_of(spot.w)).hi;
    const double x = ball(spot.x, shift).hi / scale, y = ball(spot.y, shift).hi / scale;
    int turns = 0;
    for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) {
        const Box& box = shape.boxes[k];
        if (y < box.y0 || y > box.y1 || x > box.x1) continue;
        const RoundEdge& curve = shape.curves[k];
        const Vec<Int> at{spot.x, spot.y};
        const auto seen = [&](const Vec<Int>& p) { return Vec<Int>{p.x * spot.w - at.x, p.y * spot.w - at.y}; };
        const Vec<Int> p = seen(curve.start), q = seen(curve.end);
        const int side = cross(p, q).sign();  // above 0: the spot is left of the chord
        if (curve.turn == 0) {
            if (side == 0 && dot(p, q).sign() <= 0) {
                if (met) *met = static_cast<Index>(k);
                return {};
            }
        } else {
            const Vec<Int> c = seen(curve.center);
            const int depth = Int(square(p - c) - square(c)).sign();  // above 0: it is in the disc
            if (depth == 0 && side * curve.turn <= 0) {
                if (met) *met = static_cast<Index>(k);
                return {};
            }
            // a spot on the chord counts as moved a little to the right, and less up, as for the ray below
            const Vec<Int> e = q - p;
            const int beside = side != 0 ? side : e.y.is_zero() ? e.x.sign() : -e.y.sign();
            if (depth > 0 && beside * curve.turn < 0) turns += curve.turn;
        }
        // chords that cross the ray to the right
        if (p.y.sign() <= 0 && q.y.sign() > 0 && side > 0) ++turns;
        if (q.y.sign() <= 0 && p.y.sign() > 0 && side < 0) --turns;
    }
    return turns;
}

Ratio last_parameter(const RoundEdge& curve) { return curve.turn == 0 ? one : parameter_of(curve, curve.end); }

HomogeneousPoint point_at(const RoundEdge& curve, const Ratio& s) {
    if (curve.turn == 0) {
        const Vec<Int> e = curve.end - curve.start;
        return {curve.start.x * s.d + e.x * s.n, curve.start.y * s.d + e.y * s.n, s.d};
    }
    const Vec<Int> u = curve.start - curve.center, t = curve.turn > 0 ? turned(u) : -turned(u);
    const Int c = s.d * s.d - s.n * s.n, d = 2 * s.d * s.n, w = s.d * s.d + s.n * s.n;
    return {curve.center.x * w + u.x * c + t.x * d, curve.center.y * w + u.y * c + t.y * d, w};
}

CommonScale::CommonScale(const ArcShape& robot, const ArcShape& obstacle)
    : whole(common_multiple(robot.scale, obstacle.scale)), of_robot(whole / robot.scale), of_obstacle(whole / obstacle.scale) {}

bool overlap(const PlacedShape& a, const PlacedShape& b, const Int& distance) {
    if (distance.sign() > 0) {
        const double by = ball(distance, a.shift).hi;
        for (std::size_t i = 0; i < a.curves.size(); ++i) {
            const Box around = grown(a.boxes[i], by);
            for (std::size_t j = 0; j < b.curves.size(); ++j)
                if (around.meets(b.boxes[j]) && are_closer(a.curves[i], b.curves[j], distance)) return true;
        }
    }
    return enters(a, b) || enters(b, a);
}

}  // namespace cfree
