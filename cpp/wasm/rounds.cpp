// Exact arcs, and polygons whose vertices are moved off them to a grid; every edge is checked.
#include "rounds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/forbidden/slice.hpp"
#include "cores.hpp"
#include "points.hpp"

namespace cfree {

using namespace rational;

namespace {

constexpr double pi = std::numbers::pi;
constexpr int touch_bits = 80;                       // the growth that finds contacts, relative to the robot's size
constexpr double edges = 0.75, margin = 0.125;       // shares of an error: of the edges, and of vertices moved to the grid
constexpr double most_error = 0.25, most_turn = pi / 4;  // relative to an arc's radius; of one edge
constexpr int finer = 6;                             // divisions of an error by 4, where polygons cross themselves
constexpr double obstacle_share = 1.0 / 16;          // of an obstacle's size, in place of the robot's if it is larger

std::vector<std::vector<GivenCurve>> lines_of(const Polygon& polygon) {
    std::vector<std::vector<GivenCurve>> rings;
    for (std::size_t r = 0; r + 1 < polygon.offsets.size(); ++r) {
        auto& ring = rings.emplace_back();
        const auto point = [&](Index k) {
            return RatioPoint{reduced(polygon.vertices.X(k), polygon.denominator), reduced(polygon.vertices.Y(k), polygon.denominator)};
        };
        for (Index k = polygon.offsets[r]; k < polygon.offsets[r + 1]; ++k)
            ring.push_back({point(k), point(k + 1 < polygon.offsets[r + 1] ? k + 1 : polygon.offsets[r])});
    }
    return rings;
}

ArcShape exact_of(const GivenShape& shape, const Ratio& more, bool is_outside) {
    std::vector<std::vector<GivenCurve>> rings;
    if (shape.polygon) rings = lines_of(*shape.polygon);
    else
        for (const auto& ring : shape.rings) {
            auto& parts = rings.emplace_back();
            for (const auto& curve : ring)
                for (auto& part : quarters_of(curve)) parts.push_back(std::move(part));
        }
    const Ratio radius = shape.grown + more;
    Int scale = radius.d;
    for (const auto& ring : rings)
        for (const auto& curve : ring)
            for (const RatioPoint* p : {&curve.start, &curve.center})
                for (const Ratio* c : {&p->x, &p->y}) scale = common_multiple(scale, c->d);
    const auto whole = [&](const Ratio& c) { return Int(c.n * (scale / c.d)); };
    const auto vector = [&](const RatioPoint& p) { return Vec<Int>{whole(p.x), whole(p.y)}; };
    std::vector<std::vector<RoundEdge>> exact;
    for (const auto& ring : rings) {
        auto& into = exact.emplace_back();
        for (const auto& curve : ring) into.push_back({vector(curve.start), vector(curve.end), vector(curve.center), curve.turn});
    }
    return arc_shape(std::move(exact), whole(radius), scale, is_outside);
}

std::shared_ptr<const ArcScene> arcs_of(const GivenScene& given) {
    auto scene = std::make_shared<ArcScene>();
    for (const auto& part : given.robot) scene->robot.push_back(exact_of(part, zero, false));
    for (const auto& obstacle : given.obstacles) scene->obstacles.push_back(exact_of(obstacle, zero, false));
    if (given.workspace) scene->obstacles.push_back(exact_of(*given.workspace, zero, true));
    scene->bounds = given.bounds;
    return scene;
}

double size_of(const GivenShape& shape) {
    double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL;
    const auto add = [&](double x, double y, double r) {
        x0 = std::min(x0, x - r), x1 = std::max(x1, x + r), y0 = std::min(y0, y - r), y1 = std::max(y1, y + r);
    };
    for (const auto& ring : shape.rings)
        for (const auto& curve : ring)
            for (const auto& part : quarters_of(curve)) add(near(part.start.x), near(part.start.y), near(shape.grown));
    return std::max(x1 - x0, y1 - y0);
}

double size_of(const std::vector<GivenShape>& robot) {
    double most = 0;
    for (const auto& part : robot) most = std::max(most, size_of(part));
    return most;
}

// Vertices beyond or within arcs about one center, checked.
class Chain {
public:
    // Of arcs with the shape on their left, in a row.
    Chain(const RatioPoint& from, const RatioPoint& to, const RatioPoint& about, int by, double angle, bool beyond, bool whole, double error)
        : first(from), last(to), center(about), turn(by), is_beyond(beyond), is_whole(whole) {
        const RatioPoint u = first - center;
        square = dot(u, u);
        radius = std::sqrt(near(square));
        part = std::min(error / radius, most_error);
        const double half = beyond ? std::acos(1 / (1 + edges * part)) : std::acos(1 - edges * part);
        count = std::max({2, static_cast<int>(std::ceil(angle / std::min(2 * half, most_turn)))});
        share = angle / count;
        begin = std::atan2(near(u.y), near(u.x));
        grid = std::exp2(std::floor(std::log2(part * radius / 64)));
    }
    // All vertices but the last end; nothing if doubles are too coarse to make them.
    std::optional<RatioRing> vertices() const {
        RatioRing ring;
        if (!is_whole) ring.push_back(first);
        if (is_beyond) {
            const Ratio tangent = ratio_of(std::ceil(std::ldexp(std::tan(share / 2) * (1 + margin * part), 20)) * 0x1p-20);
            const auto along = [&](const RatioPoint& p, int side) { return p + times(to_left(p - center), {tangent.n * turn * side, tangent.d}); };
            const double far = radius / std::cos(share / 2) * (1 + margin * part);
            for (int k = 0; k < count; ++k)
                ring.push_back(is_whole || (0 < k && k + 1 < count) ? on_grid(k + 0.5, far) : k == 0 ? along(first, 1) : along(last, -1));
        } else
            for (int k = is_whole ? 0 : 1; k < count; ++k) ring.push_back(on_grid(k, radius * (1 - margin * part)));
        return are_right(ring) ? std::optional(ring) : std::nullopt;
    }

private:
    RatioPoint on_grid(double steps, double r) const {
        const double angle = begin + turn * share * steps;
        const auto rounded = [&](const Ratio& middle, double off) { return ratio_of(std::nearbyint((near(middle) + off) / grid) * grid); };
        return {rounded(center.x, r * std::cos(angle)), rounded(center.y, r * std::sin(angle))};
    }
    bool are_right(const RatioRing& ring) const {
        RatioRing all = ring;
        all.push_back(is_whole ? ring.front() : last);
        for (std::size_t k = 0; k + 1 < all.size(); ++k) {
            const RatioPoint p = all[k] - center, q = all[k + 1] - center, d = q - p;
            Ratio area = cross(p, q);
            area.n *= turn;
            if (area.n <= 0) return false;
            if (is_beyond ? area * area < square * dot(d, d) : square < dot(p, p)) return false;
        }
        return true;
    }

    RatioPoint first, last, center;
    int turn;
    bool is_beyond, is_whole;
    Ratio square;
    double radius, part, share, begin, grid;
    int count;
};

// Polygon around a shape of arcs, or inside it; nothing if it crosses itself.
std::shared_ptr<const Polygon> polygon_near(const ArcShape& shape, double error, bool is_outward) try {
    std::vector<RatioRing> rings;
    const auto point = [&](const Vec<Int>& p) { return RatioPoint{reduced(p.x, shape.scale), reduced(p.y, shape.scale)}; };
    for (Index r = 0; r < shape.rings(); ++r) {
        std::vector<RoundEdge> ring(shape.curves.begin() + shape.ring[static_cast<std::size_t>(r)],
                                    shape.curves.begin() + shape.ring[static_cast<std::size_t>(r) + 1]);
        const auto is_same = [](const RoundEdge& a, const RoundEdge& b) {
            return a.turn != 0 && a.turn == b.turn && a.center.x == b.center.x && a.center.y == b.center.y;
        };
        // begin where a circle does
        for (std::size_t k = 1; k < ring.size() && is_same(ring.back(), ring.front()); ++k) std::rotate(ring.begin(), ring.begin() + 1, ring.end());
        auto& into = rings.emplace_back();
        for (std::size_t k = 0; k < ring.size();) {
            std::size_t end = k + 1;
            while (end < ring.size() && is_same(ring[k], ring[end])) ++end;
            const RoundEdge &first = ring[k], &last = ring[end - 1];
            if (first.turn == 0) into.push_back(point(first.start));
            else {
                double angle = 0;
                for (std::size_t i = k; i < end; ++i) {
                    const Vec<Int> u = ring[i].start - ring[i].center, v = ring[i].end - ring[i].center;
                    angle += std::abs(std::atan2(ratio(cross(u, v), dot(u, u)), ratio(dot(u, v), dot(u, u))));
                }
                const bool is_beyond = (first.turn > 0) == is_outward;
                const auto vertices = Chain(point(first.start), point(last.end), point(first.center), first.turn, angle, is_beyond, k == 0 && end == ring.size(), error).vertices();
                if (!vertices) return {};
                into.insert(into.end(), vertices->begin(), vertices->end());
            }
            k = end;
        }
    }
    return std::make_shared<const Polygon>(std::move(rings));
} catch (const InvalidPolygon&) {
    return {};
}

// Convex hull of the sums of two convex polygons' vertices.
RatioRing convex_sum(const RatioRing& one_ring, const RatioRing& other) {
    RatioRing all;
    for (const auto& p : one_ring)
        for (const auto& q : other) all.push_back(p + q);
    std::sort(all.begin(), all.end(), [](const RatioPoint& p, const RatioPoint& q) { return p.x == q.x ? p.y < q.y : p.x < q.x; });
    RatioRing hull;
    for (const bool is_upper : {false, true}) {
        const std::size_t base = hull.size();
        for (const auto& p : all) {
            while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= zero) hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        if (!is_upper) std::reverse(all.begin(), all.end());
    }
    return hull;
}

std::vector<std::shared_ptr<const Polygon>> polygons_near(const GivenShape& shape, double error, bool is_outward) {
    if (!shape.is_round || (shape.polygon && shape.grown == zero)) return {shape.polygon};
    if (!shape.polygon) {
        const ArcShape exact = exact_of(shape, zero, false);
        for (int k = 0; k < finer; ++k, error /= 4)
            if (auto polygon = polygon_near(exact, error, is_outward)) return {polygon};
        return {};
    }
    const RatioPoint east{shape.grown, zero};
    const auto disc = Chain(east, east, {zero, zero}, 1, 2 * pi, is_outward, true, error).vertices();
    if (!disc) return {};
    std::vector<std::shared_ptr<const Polygon>> sums;
    for (const auto& piece : shape.polygon->pieces()) {
        RatioRing corners;
        for (const Index k : piece)
            corners.push_back({reduced(shape.polygon->vertices.X(k), shape.polygon->denominator), reduced(shape.polygon->vertices.Y(k), shape.polygon->denominator)});
        sums.push_back(std::make_shared<const Polygon>(std::vector<RatioRing>{convex_sum(corners, *disc)}));
    }
    return sums;
}

double square_root(double x) { return std::sqrt(std::max(0.0, x)); }

// The outline of a grown polygon, vertex by vertex; false where an edge is too short between two corners that are not convex.
bool add_grown(const Polygon& polygon, double r, Outlines& into) {
    const auto x = [&](Index k) { return nearest(polygon.vertices.X(k), polygon.denominator); };
    const auto y = [&](Index k) { return nearest(polygon.vertices.Y(k), polygon.denominator); };
    for (std::size_t ring = 0; ring + 1 < polygon.offsets.size(); ++ring) {
        const Index first = polygon.offsets[ring], count = polygon.offsets[ring + 1] - first;
        std::vector<double> left(static_cast<std::size_t>(count));  // of each edge, after both corners
        for (Index k = 0; k < count; ++k) left[static_cast<std::size_t>(k)] = std::hypot(x(first + (k + 1) % count) - x(first + k), y(first + (k + 1) % count) - y(first + k));
        const std::vector<double> length = left;
        for (Index k = 0; k < count; ++k) {
            const Index before = (k + count - 1) % count, after = (k + 1) % count;
            const double px = x(first + k), py = y(first + k), l = length[static_cast<std::size_t>(before)], m = length[static_cast<std::size_t>(k)];
            const double ux = (px - x(first + before)) / l, uy = (py - y(first + before)) / l;
            const double vx = (x(first + after) - px) / m, vy = (y(first + after) - py) / m;
            const double c = ux * vx + uy * vy;
            if (ux * vy - uy * vx > 0) {
                into.xy.insert(into.xy.end(), {px + r * uy, py - r * ux, px + r * vy, py - r * vx});
                into.bend.insert(into.bend.end(), {r, 0});
                continue;
            }
            const double cut = r * square_root((1 - c) / (1 + c));
            left[static_cast<std::size_t>(before)] -= cut, left[static_cast<std::size_t>(k)] -= cut;
            into.xy.insert(into.xy.end(), {px + r * (uy + vy) / (1 + c), py - r * (ux + vx) / (1 + c)});
            into.bend.push_back(0);
        }
        if (std::any_of(left.begin(), left.end(), [](double of) { return !(of > 0); })) return false;
        into.ring.push_back(static_cast<Index>(into.bend.size()));
    }
    return true;
}

}  // namespace

RatioPoint point_of(const GivenCurve& arc, int quarters, const Ratio& tangent) {
    RatioPoint u = arc.start - arc.center;
    for (int k = 0; k < quarters; ++k) u = times(to_left(u), {arc.turn, 1});
    const Ratio square = one + tangent * tangent, c = (one - tangent * tangent) / square, s = (tangent + tangent) / square;
    return arc.center + times(u, c) + times(to_left(u), {s.n * arc.turn, s.d});
}

GivenCurve arc_about(const RatioPoint& start, const RatioPoint& center, const RatioPoint& end, bool is_clockwise) {
    const RatioPoint u = start - center, w = end - center;
    const Ratio square = dot(u, u), other = dot(w, w);
    if (square == zero) throw std::invalid_argument("the center of an arc is its beginning; give another");
    if (square != other)
        throw std::invalid_argument("(" + text_of(near(end.x)) + ", " + text_of(near(end.y)) + ") is not on the arc, by a part of " +
                                    text_of(std::abs(near(other / square - one)) / 2) + "; give a point that it goes through instead of the center");
    GivenCurve arc{start, end, center, is_clockwise ? -1 : 1, 0, {}};
    Ratio c = dot(u, w) / square, s = cross(u, w) / square;
    s.n *= arc.turn;
    while (!(zero < c && zero <= s)) {
        const Ratio before = c;
        c = s, s = -before, ++arc.quarters;
    }
    if (arc.quarters == 0 && s == zero) arc.quarters = 4;
    arc.rest = s / (one + c);
    return arc;
}

GivenCurve arc_through(const RatioPoint& p, const RatioPoint& q, const RatioPoint& r) {
    const RatioPoint a = q - p, b = r - p;
    const Ratio side = cross(a, b), twice = side + side, m = dot(a, a), n = dot(b, b);
    if (side == zero) throw std::invalid_argument("three points on one line: there is no arc through them; give others");
    return arc_about(p, p + RatioPoint{(m * b.y - n * a.y) / twice, (n * a.x - m * b.x) / twice}, r, side < zero);
}

std::vector<GivenCurve> quarters_of(const GivenCurve& curve) {
    if (curve.turn == 0) return {curve};
    std::vector<GivenCurve> parts;
    RatioPoint from = curve.start;
    const auto add = [&](const RatioPoint& to, int quarters, const Ratio& rest) {
        parts.push_back({from, to, curve.center, curve.turn, quarters, rest});
        from = to;
    };
    for (int k = 1; k <= curve.quarters; ++k) add(k == curve.quarters && curve.rest == zero ? curve.end : point_of(curve, k, zero), 1, zero);
    if (curve.rest != zero) add(curve.end, 0, curve.rest);
    return parts;
}

std::vector<GivenCurve> circle_about(const RatioPoint& center, const Ratio& radius) {
    if (radius <= zero) throw std::invalid_argument("radius: give a length above 0");
    const RatioPoint east = center + RatioPoint{radius, zero};
    return {{east, east, center, 1, 4, zero}};
}

std::optional<GivenCircle> circle_of(const GivenShape& shape) {
    if (shape.polygon || shape.rings.size() != 1 || shape.rings.front().size() != 1) return {};
    const GivenCurve& circle = shape.rings.front().front();
    const auto radius = rational_root(dot(circle.start - circle.center, circle.start - circle.center));
    return radius ? std::optional(GivenCircle{circle.center, *radius}) : std::nullopt;
}

bool GivenScene::is_round() const {
    const auto is = [](const GivenShape& shape) { return shape.is_round; };
    return clearance.n > 0 || std::any_of(robot.begin(), robot.end(), is) || std::any_of(obstacles.begin(), obstacles.end(), is) || (workspace && workspace->is_round);
}

SceneShapes GivenScene::polygons() const {
    SceneShapes shapes;
    for (const auto& part : robot) shapes.robot.push_back(part.polygon);
    for (const auto& obstacle : obstacles) shapes.obstacles.push_back(obstacle.polygon);
    if (workspace) shapes.workspace = workspace->polygon;
    shapes.bounds = bounds;
    return shapes;
}

namespace {

// The outline of a grown shape: around it a disc is forbidden.
void add_union(const RoundedShape& shape, const Ratio& radius, Outlines& into) {
    SceneShapes shapes;
    shapes.robot.push_back(std::make_shared<const Polygon>(Polygon::thin({{zero, zero}})));
    shapes.robot_rounding.push_back({radius, {}});
    shapes.obstacles.push_back(shape.core);
    shapes.obstacle_rounding.push_back(shape.rounding);
    const Slicer slicer(compute_boundary(scene_features(shapes).scene, {1, false, [](double) { return Wish::go_on; }}));
    const Slicer::Rings rings = slicer.rings(std::array{0}, std::array{0.0});
    for (std::size_t r = 0; r + 1 < rings.start.size(); ++r) {
        for (auto k = static_cast<std::size_t>(rings.start[r]); k < static_cast<std::size_t>(rings.start[r + 1]); ++k) {
            if (rings.bend[k] == Slicer::Rings::in_arc) continue;
            into.xy.insert(into.xy.end(), {rings.xy[2 * k], rings.xy[2 * k + 1]});
            into.bend.push_back(rings.bend[k]);
        }
        into.ring.push_back(static_cast<Index>(into.bend.size()));
    }
}

}  // namespace

void Outlines::add(const GivenShape& of) {
    if (of.polygon) {
        const Outlines before = *this;
        if (of.grown != zero && !add_grown(*of.polygon, near(of.grown), *this)) {
            *this = before;
            add_union({of.polygon, {}}, of.grown, *this);
        }
        if (of.grown == zero)
            for (const auto& lines : lines_of(*of.polygon)) {
                for (const auto& line : lines) xy.insert(xy.end(), {near(line.start.x), near(line.start.y)}), bend.push_back(0);
                ring.push_back(static_cast<Index>(bend.size()));
            }
    } else if (auto form = of.grown == zero ? std::nullopt : rounded(of)) {
        form->rounding.radius = form->rounding.radius - of.grown;
        add_union(*form, of.grown, *this);
    } else
        for (const auto& given : of.rings) {
            for (const auto& curve : given)
                for (const auto& part : quarters_of(curve)) {
                    const RatioPoint u = part.start - part.center;
                    xy.insert(xy.end(), {near(part.start.x), near(part.start.y)});
                    bend.push_back(part.turn * std::sqrt(near(dot(u, u))));
                }
            ring.push_back(static_cast<Index>(bend.size()));
        }
    shape.push_back(static_cast<Index>(ring.size()) - 1);
}

namespace {

GivenScene grown(GivenScene scene) {
    if (scene.clearance.n == 0) return scene;
    for (GivenShape& part : scene.robot) {
        part.is_round = true;
        if (const auto circle = circle_of(part)) part.rings.front() = circle_about(circle->center, circle->radius + scene.clearance);
        else part.grown = part.grown + scene.clearance;
    }
    return scene;
}

}  // namespace

Rounds::Rounds(GivenScene given)
    : asked(std::move(given)), scene(grown(asked)), motions(std::make_shared<const ArcMotionChecker>(arcs_of(scene))), poses(motions->scene), size(size_of(scene.robot)) {
    const Ratio more = ratio_of(size) * power_of_two(-touch_bits);
    std::vector<ArcShape> robot;
    for (const auto& part : scene.robot) robot.push_back(exact_of(part, more, false));
    for (const auto& obstacle : motions->scene->obstacles)
        apart.push_back(std::make_unique<const ArcMotionChecker>(std::make_shared<const ArcScene>(ArcScene{robot, {obstacle}, {}})));
}

std::vector<Index> Rounds::touched(const Motion& still) const {
    std::vector<Index> obstacles;
    for (std::size_t k = 0; k < apart.size(); ++k)
        if (!apart[k]->is_free(still)) obstacles.push_back(owner(static_cast<Index>(k)));
    return obstacles;
}

Index Rounds::owner(Index obstacle) const {
    if (obstacle < 0) return bounds_owner;
    return static_cast<std::size_t>(obstacle) < scene.obstacles.size() ? obstacle : workspace_owner;
}

// Shapes that are added, with their polygons, and the greatest errors of the robot's and of the others.
struct Rounds::Adding {
    const Rounds& rounds;
    double share;
    NearShapes result = {};
    double off[2] = {0, 0};

    std::vector<std::shared_ptr<const Polygon>> around(const GivenShape& shape, bool is_outward, Index owner) {
        const double error = share * std::max(rounds.size, obstacle_share * size_of(shape));
        auto polygons = polygons_near(shape, error, is_outward);
        const bool is_robot = owner == robot_owner;
        if (shape.is_round) {
            const double left_out = shape.polygon ? 0 : near(shape.grown);  // of shapes with arcs
            off[is_robot] = std::max(off[is_robot], error + left_out), result.error = std::max(result.error, error);
            if (result.inexact.empty() || result.inexact.back() != owner) result.inexact.push_back(owner);
        }
        return polygons;
    }
    void add_part(std::shared_ptr<const Polygon> polygon, Index part) {
        result.shapes.robot.push_back(std::move(polygon)), result.part_of.push_back(part);
    }
    void add_obstacle(std::shared_ptr<const Polygon> polygon, Index obstacle) {
        result.shapes.obstacles.push_back(std::move(polygon)), result.obstacle_of.push_back(obstacle);
    }
    void refuse(const std::string& name) const {
        throw std::invalid_argument(name + ": its outline crosses itself, or is too thin for polygons");
    }
    std::size_t add_part_polygons(std::size_t k, bool is_outward) {
        const auto polygons = around(rounds.scene.robot[k], is_outward, robot_owner);
        if (polygons.empty()) refuse("robot");
        for (const auto& polygon : polygons) add_part(polygon, static_cast<Index>(k));
        return polygons.size();
    }
    // Obstacles without a polygon inside are left out.
    std::size_t add_polygons(std::size_t k, bool is_outward) {
        const auto polygons = around(rounds.scene.obstacles[k], is_outward, static_cast<Index>(k));
        if (polygons.empty() && is_outward) refuse("obstacle " + std::to_string(k));
        if (polygons.empty()) off[0] = HUGE_VAL;
        for (const auto& polygon : polygons) add_obstacle(polygon, static_cast<Index>(k));
        return polygons.size();
    }
    NearShapes with_limits(bool is_outward) {
        if (rounds.scene.workspace && result.shapes.frames == 0) {
            const auto polygons = around(*rounds.scene.workspace, !is_outward, workspace_owner);
            if (polygons.empty()) refuse("workspace");
            result.shapes.workspace = polygons.front();
        }
        result.shapes.bounds = rounds.scene.bounds;
        result.off = (off[0] + off[1]) * (1 + 0x1p-40);
        return std::move(result);
    }
};

NearShapes Rounds::polygons(double share, bool is_outward) const {
    Adding adding{*this, share};
    for (std::size_t k = 0; k < scene.robot.size(); ++k) adding.add_part_polygons(k, is_outward);
    for (std::size_t k = 0; k < scene.obstacles.size(); ++k) adding.add_polygons(k, is_outward);
    return adding.with_limits(is_outward);
}

NearShapes Rounds::drawn(double share) const {
    Adding adding{*this, share};
    SceneShapes& shapes = adding.result.shapes;
    std::vector<std::optional<RoundedShape>> robot, obstacles, frames;
    for (const GivenShape& part : scene.robot) robot.push_back(rounded(part));
    for (const GivenShape& obstacle : scene.obstacles) obstacles.push_back(rounded(obstacle));
    for (const GivenShape& part : complement(scene)) frames.push_back(rounded(part));
    if (std::find(frames.begin(), frames.end(), std::nullopt) != frames.end()) frames.clear();
    for (std::size_t k = 0; k < robot.size(); ++k) {
        if (robot[k]) {
            adding.add_part(robot[k]->core, static_cast<Index>(k));
            shapes.robot_rounding.push_back(std::move(robot[k]->rounding));
        } else shapes.robot_rounding.resize(shapes.robot_rounding.size() + adding.add_part_polygons(k, true));
    }
    for (std::size_t k = 0; k < obstacles.size(); ++k) {
        if (obstacles[k]) {
            adding.add_obstacle(obstacles[k]->core, static_cast<Index>(k));
            shapes.obstacle_rounding.push_back(std::move(obstacles[k]->rounding));
        } else shapes.obstacle_rounding.resize(shapes.obstacle_rounding.size() + adding.add_polygons(k, true));
    }
    for (auto& frame : frames) {
        adding.add_obstacle(frame->core, workspace_owner);
        shapes.obstacle_rounding.push_back(std::move(frame->rounding));
    }
    shapes.frames = static_cast<Index>(frames.size());
    return adding.with_limits(true);
}

}  // namespace cfree
