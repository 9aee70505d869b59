// Probes, wedges and quadrangles of arcs that face each other; theory, "Convex arcs in fillets".
#include "scene/facing_arcs.hpp"

#include <algorithm>

namespace cfree {

namespace {

struct Vector {
    Ratio x, y;
};
Vector operator-(const RatioPoint& p, const RatioPoint& q) { return {p.x - q.x, p.y - q.y}; }
RatioPoint moved(const RatioPoint& p, const Ratio& factor, const Vector& v) { return {p.x + factor * v.x, p.y + factor * v.y}; }
Ratio cross(const Vector& v, const Vector& w) { return v.x * w.y - v.y * w.x; }
Ratio dot(const Vector& v, const Vector& w) { return v.x * w.x + v.y * w.y; }

// Enter a number where it belongs in order; false if it is there.
bool enter(std::vector<Ratio>& list, const Ratio& x) {
    const auto at = std::lower_bound(list.begin(), list.end(), x);
    if (at != list.end() && !(x < *at)) return false;
    list.insert(at, x);
    return true;
}

Int ceiling(const Ratio& x) { return -floor_divide(-x.n, x.d); }

// Tangent of half the angle between two vectors, the second one counter-clockwise of the first, of one length.
Ratio half_tangent(const Vector& first, const Vector& last) { return cross(first, last) / (dot(first, first) + dot(first, last)); }

// The greatest tangent of half a step for a concave arc: with the least angle e between its tangent at an end and the side from
// there to the point beyond, a step is 4 e.
Ratio step_for(const Arc& arc) {
    const Ratio one{1, 1};
    const auto tangent_at = [&](const RatioPoint& end, int turn) {
        const Vector from_centre = end - arc.centre, side = (*arc.beyond)[1] - end;
        return dot(side, from_centre) / (Ratio{turn, 1} * cross(from_centre, side));
    };
    const Ratio tangent = std::min(tangent_at(arc.from, -1), tangent_at(arc.to, 1));
    return tangent < one ? std::min(one, Ratio{2, 1} * tangent / (one - tangent * tangent)) : one;
}

// Size of the numbers of a point of a circle at the tangent p / q of half its angle.
Int size_of(const Ratio& t) {
    const Int square = t.n * t.n + t.d * t.d;
    return square % 2 == 0 ? Int(square / 2) : square;
}

}  // namespace

FacingArcs::FacingArcs(const std::vector<Rounding>& other) : discs{{0, 1}} {
    for (const Rounding& rounding : other) add(rounding);
}

bool FacingArcs::add(const Rounding& rounding) {
    bool is_new = enter(discs, rounding.radius);
    const auto set = [&](Ratio& most, const Ratio& value) {
        is_new = true;
        most = value;
    };
    for (const Arc& arc : rounding.arcs) {
        if (!arc.beyond) {
            is_new |= enter(arcs, rounding.radius + arc.radius);
            continue;
        }
        if (rounding.radius < arc.radius) is_new |= enter(hollows, arc.radius - rounding.radius);
        if (const Ratio most = step_for(arc); most < step) set(step, most);
        const auto [x, y] = (*arc.beyond)[1] - arc.centre;
        if (const Ratio away = (std::max(x, -x) + std::max(y, -y)) / arc.radius; farthest < away) set(farthest, away);
    }
    return is_new;
}

std::vector<Quadrangle> quadrangles(const Arc& arc, const Ratio& grown, const FacingArcs& other) {
    std::vector<Quadrangle> result;
    for (const bool is_for_arcs : {false, true})
        for (const Ratio& radius : is_for_arcs ? other.arcs : other.discs) {
            const Ratio room = arc.radius - grown - radius;
            if (room.n.sign() <= 0) break;
            const auto corner = [&](const RatioPoint& p) {
                return is_for_arcs ? moved(arc.centre, room / arc.radius, p - arc.centre) : p;
            };
            result.push_back({radius, is_for_arcs, {arc.centre, corner(arc.to), corner((*arc.beyond)[1]), corner(arc.from)}});
        }
    return result;
}

// The far side is at least 7 / 10 as far from the centre as its ends.
std::vector<Wedge> wedges(const Arc& arc, const Ratio& grown, const FacingArcs& other) {
    std::vector<Wedge> result;
    for (const Ratio& hollow : other.hollows) {
        const Ratio room = hollow - grown - arc.radius;
        if (room.n.sign() <= 0) continue;
        const Ratio times{-ceiling(Ratio{10, 7} * room * other.farthest / arc.radius), 1};
        result.push_back({hollow, {arc.centre, moved(arc.centre, times, arc.from - arc.centre), moved(arc.centre, times, arc.to - arc.centre)}});
    }
    return result;
}

// Of the tangents of half an angle that are at most a step ahead, and at least most of it, that of the simplest point.
std::vector<RatioPoint> probes(const Arc& arc, const Ratio& grown, const FacingArcs& other) {
    std::vector<RatioPoint> result;
    if (!other.has_concave() || other.hollows.back() <= grown + arc.radius) return result;
    const Vector from = arc.from - arc.centre, across{-from.y, from.x};
    const Ratio end = half_tangent(from, arc.to - arc.centre), one{1, 1};
    const auto ahead = [&](const Ratio& t, const Ratio& by) { return (t + by) / (one - t * by); };
    for (Ratio t{0, 1}; ahead(t, other.step) < end;) {
        const Ratio most = ahead(t, other.step), least = ahead(t, other.step * Ratio{3, 5});
        Ratio best = simplest_between(least, most);
        for (Int d = best.d; d <= 4 * best.d; d += 1) {
            const Ratio rounded = reduced(floor_divide(most.n * d, most.d), d);
            if (rounded >= least && size_of(rounded) < size_of(best)) best = rounded;
        }
        t = best;
        const Ratio square = t * t, below = one + square;
        result.push_back(moved(moved(arc.centre, (one - square) / below, from), Ratio{2, 1} * t / below, across));
    }
    return result;
}

}  // namespace cfree
