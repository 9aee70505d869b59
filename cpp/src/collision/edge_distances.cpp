// Distances along motions: translations by the area they sweep, others halved until no part can be nearer than the least one.
#include "cfree/collision/edge_distances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cfree/support/elementary.hpp"
#include "collision/box_tree.hpp"

namespace cfree {

namespace {

using Segment = EdgeDistances::Segment;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t most_parts = 1 << 12;  // most parts of motions at once; if more are needed, the distance bounded so far is the answer
constexpr double rounding = 0x1p-40;         // share of the coordinates: a thousand times what placing and measuring round away
constexpr double nothing = 0x1p-48;          // share of the coordinates: a distance that may be nothing but rounding

double from_point(double x, double y, const Segment& s) {
    const double ux = s.x1 - s.x0, uy = s.y1 - s.y0, vx = x - s.x0, vy = y - s.y0, square = ux * ux + uy * uy;
    const double along = vx * ux + vy * uy;
    if (!(along > 0)) return norm(vx, vy);
    if (along >= square) return norm(x - s.x1, y - s.y1);
    return std::abs(vy * ux - vx * uy) / std::sqrt(square);
}

bool cross_each_other(const Segment& a, const Segment& b) {
    const auto side = [](const Segment& s, double x, double y) { return (s.x1 - s.x0) * (y - s.y0) - (s.y1 - s.y0) * (x - s.x0); };
    const double p = side(a, b.x0, b.y0), q = side(a, b.x1, b.y1), r = side(b, a.x0, a.y0), t = side(b, a.x1, a.y1);
    return ((p < 0 && q > 0) || (p > 0 && q < 0)) && ((r < 0 && t > 0) || (r > 0 && t < 0));
}

double between(const Segment& a, const Segment& b) {
    if (cross_each_other(a, b)) return 0;
    return std::min(std::min(from_point(a.x0, a.y0, b), from_point(a.x1, a.y1, b)),
                    std::min(from_point(b.x0, b.y0, a), from_point(b.x1, b.y1, a)));
}

Box box_of(const Segment& s) {
    Box box;
    box.add(s.x0, s.y0), box.add(s.x1, s.y1);
    return box;
}

// Share of the first segment at which the second is nearest.
double nearest_share(const Segment& s, const Segment& other) {
    const double ux = s.x1 - s.x0, uy = s.y1 - s.y0, square = ux * ux + uy * uy;
    if (square == 0) return 0;
    const auto share_of = [&](double x, double y) { return std::clamp(((x - s.x0) * ux + (y - s.y0) * uy) / square, 0.0, 1.0); };
    double best = infinite, share = 0;
    const auto take = [&](double at, double distance) {
        if (distance < best) best = distance, share = at;
    };
    take(0, from_point(s.x0, s.y0, other));
    take(1, from_point(s.x1, s.y1, other));
    take(share_of(other.x0, other.y0), from_point(other.x0, other.y0, s));
    take(share_of(other.x1, other.y1), from_point(other.x1, other.y1, s));
    return share;
}

}  // namespace

EdgeDistances::EdgeDistances(std::vector<Segment> robot_edges, std::vector<Segment> other_edges)
    : robot(std::move(robot_edges)), others(std::move(other_edges)) {
    const auto largest = [](const std::vector<Segment>& segments) {
        double most = 0;
        for (const auto& [x0, y0, x1, y1] : segments) most = std::max({most, std::abs(x0), std::abs(y0), std::abs(x1), std::abs(y1)});
        return most;
    };
    const double most = std::max(largest(robot), largest(others));
    unit = most > 0 ? std::ldexp(1, std::ilogb(most)) : 1;
    for (auto* segments : {&robot, &others})
        for (Segment& s : *segments) s = {s.x0 / unit, s.y0 / unit, s.x1 / unit, s.y1 / unit};
    for (const Segment& s : robot) reach = std::max({reach, norm(s.x0, s.y0), norm(s.x1, s.y1)});
    size = largest(others);
    std::vector<Box> boxes;
    for (const Segment& s : others) boxes.push_back(box_of(s));
    tree = std::make_unique<BoxTree>(std::move(boxes));
}
EdgeDistances::~EdgeDistances() = default;

// The first line, and the first of the others, of several that are as near. None within the distance: infinite.
EdgeDistances::Nearest EdgeDistances::nearest(const std::vector<Segment>& lines, double within) const {
    double far = size;
    for (const auto& [x0, y0, x1, y1] : lines) far = std::max({far, std::abs(x0), std::abs(y0), std::abs(x1), std::abs(y1)});
    far = std::min(within, 4 * far);  // nothing is farther away
    Nearest best{infinite, 0, 0};
    for (double limit = std::min(far, reach);; limit = std::min(far, 4 * limit)) {
        for (std::size_t k = 0; k < lines.size(); ++k) {
            const auto line = static_cast<Index>(k);
            const double d = std::min(limit, best.distance);
            tree->query(grown(box_of(lines[k]), d), [&](Index j) {
                const double distance = between(lines[k], others[j]);
                if (distance > limit || distance > best.distance) return;
                if (distance < best.distance || (line == best.line && j < best.other)) best = {distance, line, j};
            });
        }
        if (best.distance < infinite || limit >= far) return best;
    }
}

std::vector<Segment> EdgeDistances::placed(double x, double y, double c, double s) const {
    std::vector<Segment> lines;
    lines.reserve(robot.size());
    for (const auto& [x0, y0, x1, y1] : robot)
        lines.push_back({x + (c * x0 - s * y0), y + (s * x0 + c * y0), x + (c * x1 - s * y1), y + (s * x1 + c * y1)});
    return lines;
}

std::vector<Segment> EdgeDistances::at(const MeasuredMotion& m, double share) const {
    const auto& [x, y, theta, c, s] = m.from;
    if (std::holds_alternative<Straight>(m.kind))
        return placed((x + share * (m.to.x - x)) / unit, (y + share * (m.to.y - y)) / unit, c, s);
    if (const auto* turn = std::get_if<Turning>(&m.kind)) {
        // the chord of a share: shorter by the ratio of sines, and back by half of what is left of the angle
        const double half = 0.5 * turn->angle, scale = half != 0 ? sine(share * half) / sine(half) : share;
        const auto [cc, ss] = cosine_sine((share - 1) * half);
        const auto [c1, s1] = cosine_sine(theta + share * turn->angle);
        const double a = scale * cc, b = scale * ss;
        return placed((x + a * turn->x - b * turn->y) / unit, (y + b * turn->x + a * turn->y) / unit, c1, s1);
    }
    const auto& slide = std::get<Sliding>(m.kind);
    const double t = tangent(0.5 * slide.angle * share);
    const auto value = [t](const std::array<double, 5>& f) { return (((f[4] * t + f[3]) * t + f[2]) * t + f[1]) * t + f[0]; };
    const auto [c1, s1] = cosine_sine(theta + share * slide.angle);
    return placed((x + value(slide.x) / value(slide.d)) / unit, (y + value(slide.y) / value(slide.d)) / unit, c1, s1);
}

// No vertex of the robot travels farther.
double EdgeDistances::travel(const MeasuredMotion& m) const {
    if (const auto* slide = std::get_if<Sliding>(&m.kind)) return slide->reach / unit;
    if (std::holds_alternative<Straight>(m.kind)) return norm(m.to.x - m.from.x, m.to.y - m.from.y) / unit;
    const auto& turn = std::get<Turning>(m.kind);
    double most = 0;
    for (const Segment& s : placed((m.from.x - turn.pole_x) / unit, (m.from.y - turn.pole_y) / unit, m.from.c, m.from.s))
        most = std::max({most, norm(s.x0, s.y0), norm(s.x1, s.y1)});
    return most * std::abs(turn.angle);
}

// The region that a free robot sweeps as it moves straight has no obstacle in it, and its rim is part of the edges at both ends
// and of the vertices' tracks.
double EdgeDistances::swept(const std::vector<MeasuredMotion>& motions, Found& best) const {
    double least = infinite;
    const auto count = static_cast<Index>(robot.size());
    for (std::size_t k = 0; k < motions.size(); ++k) {
        const MeasuredMotion& m = motions[k];
        if (!std::holds_alternative<Straight>(m.kind)) continue;
        auto lines = placed(m.from.x / unit, m.from.y / unit, m.from.c, m.from.s);
        const bool moves = m.from.x != m.to.x || m.from.y != m.to.y;
        if (moves) {
            const auto last = placed(m.to.x / unit, m.to.y / unit, m.from.c, m.from.s);
            lines.insert(lines.end(), last.begin(), last.end());
            for (Index e = 0; e < count; ++e) lines.push_back({lines[e].x0, lines[e].y0, last[e].x0, last[e].y0});
        }
        const Nearest near = nearest(lines, least);
        if (!(near.distance < least)) continue;
        least = near.distance;
        const Index part = near.line / count;
        const double share = part < 2 ? part : nearest_share(lines[near.line], others[near.other]);
        const Nearest there = nearest(at(m, share), infinite);
        best = {there.distance, static_cast<int>(k), share, there.line, there.other};
    }
    return least;
}

LeastDistance EdgeDistances::least(const std::vector<MeasuredMotion>& motions, double allowed) const {
    const double tolerance = allowed / unit;
    double extent = size, least, farthest = 0, places = 0;
    std::vector<double> travels;
    for (const MeasuredMotion& m : motions) {
        travels.push_back(travel(m)), farthest = std::max(farthest, travels.back());
        for (const auto* q : {&m.from, &m.to}) places = std::max({places, std::abs(q->x) / unit, std::abs(q->y) / unit});
    }
    extent = std::max(extent, places + reach + farthest);
    Found best{infinite, 0, 0, 0, 0};
    least = swept(motions, best);
    struct Part {
        std::size_t motion;
        double low, high;
    };
    std::vector<Part> parts, open;
    for (std::size_t k = 0; k < motions.size(); ++k)
        if (!std::holds_alternative<Straight>(motions[k].kind)) parts.push_back({k, 0, 1});
    while (!parts.empty()) {
        double widest = 0;
        for (const Part& p : parts) widest = std::max(widest, travels[p.motion] * (p.high - p.low));
        const double within = best.distance + widest;  // farther ones change nothing
        std::vector<double> bounds;
        for (const Part& p : parts) {
            const double middle = 0.5 * (p.low + p.high);
            const Nearest near = nearest(at(motions[p.motion], middle), within);
            if (near.distance < best.distance) best = {near.distance, static_cast<int>(p.motion), middle, near.line, near.other};
            bounds.push_back(near.distance - 0.5 * travels[p.motion] * (p.high - p.low));
        }
        open.clear();
        const auto is_open = [&](std::size_t k) { return bounds[k] < best.distance - tolerance; };
        std::size_t count = 0;
        for (std::size_t k = 0; k < parts.size(); ++k) count += is_open(k);
        for (std::size_t k = 0; k < parts.size(); ++k) {
            if (count > most_parts || !is_open(k)) {
                least = std::min(least, bounds[k]);
                continue;
            }
            const auto [motion, low, high] = parts[k];
            open.push_back({motion, low, 0.5 * (low + high)}), open.push_back({motion, 0.5 * (low + high), high});
        }
        std::swap(parts, open);
    }
    const double found = best.distance > nothing * extent ? unit * best.distance : 0;
    return {unit * std::max(0.0, least - rounding * extent), found, best.motion, best.share, best.edge, best.other};
}

}  // namespace cfree
