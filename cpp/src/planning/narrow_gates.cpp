// Look for a closed way over obstacles and narrow gates around one place; theory, "One surface alone".
#include "cfree/planning/narrow_gates.hpp"

#include <algorithm>
#include <cmath>

#include "cfree/support/elementary.hpp"
#include "collision/box_tree.hpp"
#include "polygons/convex_rings.hpp"
#include "support/union_find.hpp"

namespace cfree {

namespace {

constexpr double certainly = 1 - 0x1p-16;  // share of the polygon's width that narrow gates have at most
constexpr std::size_t pairs_each = 64;      // pairs for each piece: if there are more, the robot is far larger than what is around it

Vec<double> middle_of(const DoubleRing& ring) {
    Vec<double> sum{0, 0};
    for (const auto& [x, y] : ring) sum.x += x, sum.y += y;
    const auto count = static_cast<double>(ring.size());
    return {sum.x / count, sum.y / count};
}

// Common part of two convex rings.
DoubleRing common(DoubleRing ring, const DoubleRing& other) {
    for (std::size_t k = 0; k < other.size() && !ring.empty(); ++k) {
        const Vec<double>&p = other[k], e = vertex_after(other, k) - p;
        ring = cut_off(ring, p, {e.y, -e.x});
    }
    return ring;
}

// Vertex of one of two rings and point of an edge of the other that are nearest, on the first and on the second.
std::array<Vec<double>, 2> nearest_points(const DoubleRing& first, const DoubleRing& second) {
    std::array<Vec<double>, 2> found{};
    double least = HUGE_VAL;
    const auto compare = [&](const DoubleRing& ring, const DoubleRing& points, bool is_first) {
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Vec<double> &a = ring[k], &b = vertex_after(ring, k);
            for (const Vec<double>& p : points) {
                const Vec<double> q = point_at(a, b, share_before(a, b, p)), d = p - q;
                if (!(dot(d, d) < least)) continue;
                least = dot(d, d);
                found = is_first ? std::array{q, p} : std::array{p, q};
            }
        }
    };
    compare(first, second, true), compare(second, first, false);
    return found;
}

// Points of two convex rings, nearer to each other than a width or the same, if there are any.
std::optional<std::array<Vec<double>, 2>> near_points(const DoubleRing& first, const DoubleRing& second, double width) {
    const auto [p, q] = nearest_points(first, second);
    if (dot(q - p, q - p) < width * width) return {{p, q}};
    const DoubleRing both = common(first, second);  // the edges of large ones may cross far from all vertices
    if (both.empty()) return {};
    return {{middle_of(both), middle_of(both)}};
}

Box box_of(const DoubleRing& ring) {
    Box box;
    for (const auto& [x, y] : ring) box.add(x, y);
    return box;
}

// True if the way crosses the line from s to g an odd number of times.
bool crosses(const std::array<Vec<double>, 4>& way, const Vec<double>& s, const Vec<double>& g) {
    bool is_odd = false;
    for (std::size_t k = 1; k < way.size(); ++k) {
        const Vec<double> &p = way[k - 1], &q = way[k];
        const auto is_left = [](const Vec<double>& a, const Vec<double>& b, const Vec<double>& c) { return cross(b - a, c - a) > 0; };
        is_odd ^= is_left(s, g, p) != is_left(s, g, q) && is_left(p, q, s) != is_left(p, q, g);
    }
    return is_odd;
}

// Rings in the user's units of all that the robot's body must not meet.
std::vector<DoubleRing> rings_of(const Scene& scene) {
    const Shape& O = scene.obstacles;
    const double unit = scene.unit();
    std::vector<DoubleRing> rings;
    for (Index k = 0; k < O.pieces(); ++k) {
        if (O.piece_layer[k] != body_layer || O.piece[k + 1] - O.piece[k] < 3) continue;
        DoubleRing& ring = rings.emplace_back();
        for (Index n = O.piece[k]; n < O.piece[k + 1]; ++n) ring.push_back({O.x[O.piece_vertex[n]] * unit, O.y[O.piece_vertex[n]] * unit});
    }
    return rings;
}

}  // namespace

NarrowGates::NarrowGates(const KnownScene& scene, const Ratio& by) : within(inscribed(scene.shapes().robot, by)), shapes(scene.shapes()) {
    Index vertices = 0;
    for (const auto& part : shapes.robot) vertices += part->vertices.size();
    shapes.robot.clear();
    if (!within) return;
    find_gates(scene);
    if (within->polygon->vertices.size() < vertices) shapes.robot = {within->polygon};
    enlarge_bounds(shapes, by);
}

const std::shared_ptr<KnownScene>& NarrowGates::inner() {
    if (!smaller && !shapes.robot.empty()) smaller = KnownScene::of(shapes);
    return smaller;
}

void NarrowGates::take(const NarrowGates& other) {
    if (inner()) smaller->take(*other.smaller);
}

void NarrowGates::find_gates(const KnownScene& scene) {
    std::vector<DoubleRing> rings = rings_of(scene.scene());
    const double width = certainly * within->width;
    if (scene.shapes().bounds) {  // a gate beside them is half as wide: the middle stays as far from them as from the reference point
        const double far = norm(within->middle.x, within->middle.y) + width / 2;
        const auto bound = [&](std::size_t k) { return nearest((*scene.shapes().bounds)[k].n, (*scene.shapes().bounds)[k].d); };
        const double x0 = bound(0) - far, y0 = bound(1) - far, x1 = bound(2) + far, y1 = bound(3) + far;
        const auto add = [&](double l, double b, double r, double t) { rings.push_back({{l, b}, {r, b}, {r, t}, {l, t}}); };
        add(x0 - far, y0 - far, x0, y1 + far), add(x1, y0 - far, x1 + far, y1 + far);
        add(x0 - far, y0 - far, x1 + far, y0), add(x0 - far, y1, x1 + far, y1 + far);
    }
    pieces = static_cast<Index>(rings.size());
    std::vector<Box> boxes;
    for (const DoubleRing& ring : rings) boxes.push_back(box_of(ring));
    const BoxTree tree(boxes);
    std::size_t pairs = 0;
    for (Index k = 0; k < pieces; ++k) {
        heed_stop();
        tree.query(grown(boxes[k], width), [&](Index other) {
            if (other <= k) return;
            ++pairs;
            if (const auto near = near_points(rings[k], rings[other], width))
                gates.push_back({k, other, {middle_of(rings[k]), (*near)[0], (*near)[1], middle_of(rings[other])}});
        });
        if (pairs > pairs_each * rings.size()) return gates.clear();
    }
}

// A closed way over pieces and gates that crosses the line from start to goal an odd number of times has one of the two inside.
// Each piece is there twice, reached after an even and an odd number of crossings: on such a way these two are joined.
bool NarrowGates::part(const Place& start, const Place& goal) const {
    if (gates.empty()) return false;
    const auto middle_at = [&](const Place& at) {
        const auto [c, s] = cosine_sine(at.theta);
        const auto& [x, y] = within->middle;
        return Vec<double>{at.x + c * x - s * y, at.y + s * x + c * y};
    };
    const Vec<double> first = middle_at(start), last = middle_at(goal);
    UnionFind reached(2 * static_cast<std::size_t>(pieces));
    for (const auto& [p, q, way] : gates) {
        const Index odd = crosses(way, first, last) ? 1 : 0;
        reached.unite(2 * p, 2 * q + odd), reached.unite(2 * p + 1, 2 * q + 1 - odd);
        if (reached.find(2 * p) == reached.find(2 * p + 1)) return true;
    }
    return false;
}

}  // namespace cfree
