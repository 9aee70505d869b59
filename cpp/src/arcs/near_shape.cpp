// Shapes of segments and arcs in doubles, with a margin for all rounding; theory, "Segments and arcs".
#include "arcs/near_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "arcs/vectors.hpp"
#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double length(const Vec<double>& v) { return std::sqrt(v.x * v.x + v.y * v.y); }
Vec<double> along(const Vec<double>& p, double t, const Vec<double>& d) { return {p.x + t * d.x, p.y + t * d.y}; }

// Where a direction is with respect to the cone of an arc: at least this far inside, times the length, or, below 0, outside.
double depth_in_cone(const NearCurve& arc, const Vec<double>& d) {
    const Vec<double> u = arc.start - arc.center, w = arc.end - arc.center;
    if (dot(u, d) + dot(w, d) <= 0) return -std::max(length(d), margin);
    return std::min(cross(u, d) * arc.turn, cross(d, w) * arc.turn) / arc.radius;
}

double distance_of_point(const Vec<double>& p, const NearCurve& b) {
    if (b.turn == 0) {
        const Vec<double> e = b.end - b.start, d = p - b.start;
        const double square = dot(e, e), t = square > 0 ? std::clamp(dot(e, d) / square, 0.0, 1.0) : 0;
        return length(d - Vec<double>{t * e.x, t * e.y});
    }
    const Vec<double> d = p - b.center;
    if (depth_in_cone(b, d) >= 0) return std::abs(length(d) - b.radius);
    return std::min(length(p - b.start), length(p - b.end));
}

enum class Meeting { none, certain, maybe };

// A place where the lines or circles meet, which is off by at most `error`: is it on both curves?
Meeting at(const Vec<double>& x, double error, const NearCurve& a, const NearCurve& b) {
    Meeting all = Meeting::certain;
    for (const NearCurve* c : {&a, &b}) {
        double depth;
        if (c->turn == 0) {
            const Vec<double> e = c->end - c->start;
            const double size = length(e), t = dot(e, x - c->start) / size;
            depth = std::min(t, size - t);
        } else {
            depth = depth_in_cone(*c, x - c->center);
        }
        if (depth < -error) return Meeting::none;
        if (!(depth > error)) all = Meeting::maybe;
    }
    return all;
}

// The places foot +- sqrt(square) direction; `error` bounds that of the square, `shift` that of the foot.
Meeting at_two(const Vec<double>& foot, const Vec<double>& direction, double square, double error, double shift, const NearCurve& a,
               const NearCurve& b) {
    if (square < -error) return Meeting::none;
    if (square <= 0x1p8 * error) {
        const Meeting one = at(foot, std::sqrt(0x1p9 * error) + shift, a, b);
        return one == Meeting::none ? one : Meeting::maybe;
    }
    const double half = std::sqrt(square), off = error / half + shift;
    const Meeting first = at(along(foot, half, direction), off, a, b);
    if (first == Meeting::certain) return first;
    const Meeting second = at(along(foot, -half, direction), off, a, b);
    return second == Meeting::none ? first : second;
}

Meeting lines_meet(const NearCurve& a, const NearCurve& b) {
    bool is_certain = true;
    for (const auto& [p, q] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        const Vec<double> e = p->end - p->start;
        const double size = length(e), s = cross(e, q->start - p->start) / size, t = cross(e, q->end - p->start) / size;
        if (std::min(s, t) > margin || std::max(s, t) < -margin) return Meeting::none;
        if (!(std::min(std::abs(s), std::abs(t)) > margin)) is_certain = false;
    }
    return is_certain ? Meeting::certain : Meeting::maybe;
}

Meeting line_meets(const NearCurve& a, const NearCurve& b, double& gap) {
    const Vec<double> e = a.end - a.start, d = b.center - a.start;
    const double size = length(e), height = cross(e, d) / size, t = dot(e, d) / size, r = b.radius;
    const Vec<double> unit{e.x / size, e.y / size}, up{-unit.y * height, unit.x * height};
    if (std::abs(height) > r + margin) {
        if (0 <= t && t <= size && depth_in_cone(b, -up) >= 0) gap = std::min(gap, std::abs(height) - r);
        return Meeting::none;
    }
    if (std::max(length(d), length(b.center - a.end)) < r - margin) return Meeting::none;
    return at_two(b.center - up, unit, r * r - height * height, 4 * r * margin, 4 * margin, a, b);
}

Meeting arcs_meet(const NearCurve& a, const NearCurve& b, double& gap) {
    const Vec<double> d = b.center - a.center;
    const double apart = length(d), r = a.radius, s = b.radius;
    if (apart > r + s + margin) {
        if (depth_in_cone(a, d) >= 0 && depth_in_cone(b, -d) >= 0) gap = std::min(gap, apart - r - s);
        return Meeting::none;
    }
    if (apart < std::abs(r - s) - margin) {
        const Vec<double> to = r > s ? d : -d;
        if (depth_in_cone(a, to) >= 0 && depth_in_cone(b, to) >= 0) gap = std::min(gap, std::abs(r - s) - apart);
        return Meeting::none;
    }
    const double from = (apart + (r - s) * (r + s) / apart) / 2, off = 8 * margin * (r + s) / apart;
    if (!(off < r)) return Meeting::maybe;
    const Vec<double> unit{d.x / apart, d.y / apart};
    return at_two(along(a.center, from, unit), {-unit.y, unit.x}, (r - from) * (r + from), 4 * r * off, off, a, b);
}

// The number of units n / scale, times 2^-shift.
double rounded(const Int& n, const Int& scale, int shift) {
    const int bits = bits_of(scale);
    return ball(n, bits + shift).hi / ball(scale, bits).hi;
}

Box box_of(const NearCurve& curve) {
    Box box;
    box.add(curve.start.x, curve.start.y), box.add(curve.end.x, curve.end.y);
    if (curve.turn != 0) box.add(curve.corner.x, curve.corner.y);
    return {box.x0 - margin, box.y0 - margin, box.x1 + margin, box.y1 + margin};
}

bool meet(const Box& a, const Box& b, double by) {
    return a.x0 - by <= b.x1 && b.x0 - by <= a.x1 && a.y0 - by <= b.y1 && b.y0 - by <= a.y1;
}

}  // namespace

double gap_between(const NearCurve& a, const NearCurve& b) {
    double gap = infinity;
    const Meeting found = a.turn == 0 ? b.turn == 0 ? lines_meet(a, b) : line_meets(a, b, gap)
                          : b.turn == 0 ? line_meets(b, a, gap)
                                        : arcs_meet(a, b, gap);
    if (found == Meeting::certain) return -1;
    if (found == Meeting::maybe && meet(box_of(a), box_of(b), 0)) return 0;  // segments on one line may be far apart
    for (const auto* p : {&a.start, &a.end}) gap = std::min(gap, distance_of_point(*p, b));
    for (const auto* p : {&b.start, &b.end}) gap = std::min(gap, distance_of_point(*p, a));
    return gap > margin ? gap : 0;
}

NearShape::NearShape(const ArcShape& shape, int shift) : ring(shape.ring), is_outside(shape.is_outside) {
    const auto rounded = [&](const Vec<Int>& p) {
        return Vec<double>{cfree::rounded(p.x, shape.scale, shift), cfree::rounded(p.y, shape.scale, shift)};
    };
    radius = cfree::rounded(shape.radius, shape.scale, shift);
    for (const RoundEdge& curve : shape.curves) {
        NearCurve c{rounded(curve.start), rounded(curve.end), rounded(curve.center), {}, 0, curve.turn};
        if (curve.turn != 0) {
            const Vec<double> u = rounded(curve.start - curve.center), w = rounded(curve.end - curve.center);
            const double tangent = cross(u, w) / (dot(u, u) + dot(u, w));  // of half the turn, with its sign
            c.corner = {c.start.x - u.y * tangent, c.start.y + u.x * tangent};
            c.radius = length(u);
        }
        curves.push_back(c);
    }
    set_boxes();
    if (!is_outside && !curves.empty()) find_disc(shape);
}

void NearShape::set_boxes() {
    boxes.resize(curves.size());
    around = {};
    for (std::size_t k = 0; k < curves.size(); ++k) around.add(boxes[k] = box_of(curves[k]));
}

// The ray to the right, past chords; a point on the outer side of a chord and in the disc is around it. Each side is taken once,
// so that a point near a chord counts alike in both. A point on a level chord is above it, as the ray's rule has it; beside a
// chord that is not level, rounding keeps the order of the two products, but may make them equal.
bool NearShape::has(const Vec<double>& p) const {
    int turns = 0;
    for (const NearCurve& c : curves) {
        const bool is_up = c.start.y <= p.y && p.y < c.end.y, is_down = c.end.y <= p.y && p.y < c.start.y;
        if (c.turn == 0 && !is_up && !is_down) continue;
        const Vec<double> e = c.end - c.start;
        const double side = cross(e, p - c.start);
        const bool is_left = side != 0 || is_up || is_down ? side > 0 : (p.y < c.start.y) == (e.x < 0);
        if (is_up && is_left) ++turns;
        if (is_down && !is_left) --turns;
        if (c.turn != 0 && is_left == (c.turn < 0)) {
            const Vec<double> d = p - c.center;
            if (dot(d, d) < c.radius * c.radius) turns += c.turn;
        }
    }
    return turns + (is_outside ? 1 : 0) != 0;
}

double NearShape::distance(const Vec<double>& p) const {
    double least = infinity;
    for (const NearCurve& c : curves) least = std::min(least, distance_of_point(p, c));
    return least > margin && has(p) ? 0 : least;
}

// All of a circle; else the best of some places in the box, and then of places nearer and nearer around it.
void NearShape::find_disc(const ArcShape& shape) {
    const RoundEdge& first = shape.curves.front();
    const bool is_circle = shape.rings() == 1 && std::all_of(shape.curves.begin(), shape.curves.end(), [&](const RoundEdge& c) {
        return c.turn == 1 && c.center.x == first.center.x && c.center.y == first.center.y;
    });
    if (is_circle) {
        disc = {curves.front().center, curves.front().radius + radius, true};
        return;
    }
    const double size = std::max(around.x1 - around.x0, around.y1 - around.y0);
    constexpr int places = 6, rounds = 4;
    Vec<double> middle{0.5 * (around.x0 + around.x1), 0.5 * (around.y0 + around.y1)};
    double step = size / places;
    for (int round = 0; round < rounds; ++round, step *= 0.5) {
        const Vec<double> about = middle;
        for (int i = -places / 2; i <= places / 2; ++i)
            for (int j = -places / 2; j <= places / 2; ++j) {
                const Vec<double> p{about.x + i * step, about.y + j * step};
                double least = infinity;
                for (const NearCurve& c : curves) {
                    least = std::min(least, distance_of_point(p, c));
                    if (least <= disc.radius) break;
                }
                if (least > disc.radius && least > 2 * margin && has(p)) disc = {p, least, false}, middle = p;
            }
    }
    disc.radius = disc.radius > 0 ? disc.radius - margin + radius : 0;
}

// A point that is in the disc and in the other shape, or no such point.
Verdict by_disc(const InnerDisc& disc, const NearShape& other, double slack) {
    if (!(disc.radius > 0)) return Verdict::uncertain;
    const double total = disc.radius + other.radius, most = total + slack + 2 * margin;
    const Vec<double>& p = disc.center;
    if (other.disc.radius > 0) {
        const Vec<double> d = p - other.disc.center;
        const double enough = disc.radius + other.disc.radius - slack - 2 * margin;
        if (enough > 0 && dot(d, d) < enough * enough) return Verdict::forbidden;
    }
    if (!other.is_outside) {
        const Box& box = other.around;
        const double x = std::max({box.x0 - p.x, p.x - box.x1, 0.0}), y = std::max({box.y0 - p.y, p.y - box.y1, 0.0});
        if (x * x + y * y > most * most) return disc.is_all ? Verdict::free : Verdict::uncertain;
    }
    const double apart = other.distance(p);
    if (apart < total - slack - 2 * margin) return Verdict::forbidden;
    return disc.is_all && apart > most ? Verdict::free : Verdict::uncertain;
}

Verdict verdict_on(const NearShape& a, const NearShape& b, double within, double slack, CurvePairs* near) {
    for (const auto& [own, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        const Verdict v = by_disc(own->disc, *other, slack);
        if (v == Verdict::free || (v == Verdict::forbidden && !near)) return v;
        if (own->disc.is_all && !near) return v;
    }
    return verdict_by_curves(a, b, within, slack, near);
}

Verdict verdict_by_curves(const NearShape& a, const NearShape& b, double within, double slack, CurvePairs* near) {
    bool is_open = false, is_forbidden = false;
    const double most = within + slack + margin, least = within - slack - margin;
    for (std::size_t i = 0; i < a.curves.size(); ++i) {
        if (!b.is_outside && !meet(a.boxes[i], b.around, most)) continue;
        for (std::size_t j = 0; j < b.curves.size(); ++j) {
            if (!meet(a.boxes[i], b.boxes[j], most)) continue;
            const double gap = gap_between(a.curves[i], b.curves[j]);
            if (gap > most) continue;
            is_open = true;
            if (slack == 0 && gap < 0) is_forbidden = true;
            if (gap != 0 && std::max(gap, 0.0) < least) is_forbidden = true;
            if (near) near->emplace_back(static_cast<Index>(i), static_cast<Index>(j));
            else if (is_forbidden) return Verdict::forbidden;
        }
    }
    if (is_forbidden) return Verdict::forbidden;
    if (is_open) return Verdict::uncertain;
    for (std::size_t k = 0; k + 1 < a.ring.size(); ++k) {
        const Vec<double>& p = a.curves[static_cast<std::size_t>(a.ring[k])].start;
        if ((b.is_outside || b.around.meets({p.x, p.y, p.x, p.y})) && b.has(p)) return Verdict::forbidden;
    }
    for (std::size_t k = 0; k + 1 < b.ring.size(); ++k) {
        const Vec<double>& p = b.curves[static_cast<std::size_t>(b.ring[k])].start;
        if (a.around.meets({p.x, p.y, p.x, p.y}) && a.has(p)) return Verdict::forbidden;
    }
    return Verdict::free;
}

// Distance of some points of two curves that may meet: ends, and points on common normals.
static double distance_of_points(const NearCurve& a, const NearCurve& b) {
    double least = std::min({distance_of_point(a.start, b), distance_of_point(a.end, b), distance_of_point(b.start, a), distance_of_point(b.end, a)});
    if (a.turn != 0 && b.turn != 0) {
        const Vec<double> d = b.center - a.center;
        for (const int i : {1, -1})
            for (const int j : {1, -1})
                if (depth_in_cone(a, i > 0 ? d : -d) >= 0 && depth_in_cone(b, j > 0 ? d : -d) >= 0)
                    least = std::min(least, std::abs(length(d) + j * b.radius - i * a.radius));
        return least;
    }
    if (a.turn == b.turn) return least;
    const NearCurve &line = a.turn == 0 ? a : b, &arc = a.turn == 0 ? b : a;
    const Vec<double> e = line.end - line.start, d = arc.center - line.start;
    const double size = length(e), height = cross(e, d) / size, t = dot(e, d) / size;
    const Vec<double> down{e.y * height, -e.x * height};
    if (0 <= t && t <= size && depth_in_cone(arc, down) >= 0) least = std::min(least, std::abs(std::abs(height) - arc.radius));
    return least;
}

Gap distance_of(const NearShape& a, const NearShape& b, double most) {
    const double grown_by = a.radius + b.radius;
    const Verdict verdict = verdict_on(a, b, grown_by, 0);
    if (verdict == Verdict::forbidden) return {0, 0};
    Gap least{most + grown_by, most + grown_by};
    for (std::size_t i = 0; i < a.curves.size(); ++i)
        for (std::size_t j = 0; j < b.curves.size(); ++j) {
            if (!meet(a.boxes[i], b.boxes[j], least.high)) continue;
            const NearCurve &p = a.curves[i], &q = b.curves[j];
            const double gap = gap_between(p, q);
            least = {std::min(least.low, std::max(gap, 0.0)), std::min(least.high, gap > 0 ? gap : distance_of_points(p, q))};
        }
    const auto shortened = [&](double distance) { return std::max(0.0, distance - grown_by); };
    return {verdict == Verdict::free ? shortened(least.low) : 0, shortened(least.high)};
}

NearScene::NearScene(std::shared_ptr<const ArcScene> of) : scene(std::move(of)) {
    int bits = -(1 << 20);
    for (const auto* shapes : {&scene->robot, &scene->obstacles})
        for (const ArcShape& shape : *shapes) {
            const int own = bits_of(shape.scale) - 1;
            if (!shape.radius.is_zero()) bits = std::max(bits, bits_of(shape.radius) - own);
            for (const RoundEdge& curve : shape.curves)
                for (const auto* p : {&curve.start, &curve.center}) bits = std::max({bits, bits_of(p->x) - own, bits_of(p->y) - own});
        }
    shift = bits + 4;  // the robot turns, radii are at most twice as long, and sums have two of them
    unit = std::ldexp(1.0, -shift);
    for (const ArcShape& shape : scene->robot) robot.emplace_back(shape, shift);
    for (const NearShape& shape : robot)
        for (const NearCurve& c : shape.curves)
            for (const auto* p : {&c.start, &c.end, &c.corner}) reach = std::max(reach, length(*p) + shape.radius + margin);
    std::vector<Box> boxes;
    for (const ArcShape& shape : scene->obstacles) {
        const auto j = static_cast<Index>(obstacles.size());
        const NearShape& near = obstacles.emplace_back(shape, shift);
        if (near.is_outside) outside.push_back(j);
        else if (!near.curves.empty()) inside.push_back(j), boxes.push_back(near.around);
        most_radius = std::max(most_radius, near.radius);
    }
    tree = std::make_unique<BoxTree>(std::move(boxes));
}

void NearScene::place(std::size_t part, double x, double y, double c, double s, NearShape& placed) const {
    const NearShape& still = robot[part];
    if (placed.ring.empty()) placed = still;
    const auto move = [&](const Vec<double>& p) { return Vec<double>{x + (c * p.x - s * p.y), y + (s * p.x + c * p.y)}; };
    placed.disc.center = move(still.disc.center);
    placed.around = {};
    for (std::size_t k = 0; k < still.curves.size(); ++k) {
        const NearCurve& from = still.curves[k];
        NearCurve& to = placed.curves[k];
        to.start = move(from.start), to.end = move(from.end);
        if (from.turn != 0) to.center = move(from.center), to.corner = move(from.corner);
        placed.around.add(placed.boxes[k] = box_of(to));
    }
}

}  // namespace cfree
