// Free parts of curves in concave arcs. A curve's point enters and leaves the forbidden space on lines and circles of pillars only.
// So it is free or not everywhere between two angles at which it is on one, as at a sample; theory, "Exact fits".
#include "forbidden/equal_radii.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "cfree/contact/contact_line.hpp"
#include "cfree/scene/features.hpp"
#include "forbidden/coincident_surfaces.hpp"
#include "forbidden/open_covers.hpp"
#include "forbidden/sliding_arcs.hpp"
#include "predicates/round_orders.hpp"
#include "support/parallel.hpp"

namespace cfree {

bool have_equal_radii(const Scene& scene, Index i, Index j) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const bool is_pair = A.convex[i] ? O.is_concave(j) : O.convex[j] && A.is_concave(i);
    return is_pair && (A.radius_of(i).exact + O.radius_of(j).exact).is_zero();
}

namespace {

// A curve on a circle's surface in one chart: what is free of it, and where the two arcs touch.
class FreeCurve {
public:
    struct Range {
        Event from, to;
        bool is_one;  // a single angle
    };
    FreeCurve(const Scene& s, const Surface& surface, const Feature& curve) : decide(s, surface), scene(s), on(surface), name(curve) {}

    // True if a surface touches this one at an angle.
    bool vanishes(const Feature& surface, const Event& at) const {
        LongRoot root = decide.long_root_of(at);
        return sign_at(RoundOrders(scene, on).exactly(surface, {}).p, root) == 0;
    }
    // Free closed ranges between two angles, and single angles; `meets` is true where the arcs touch, which changes at these events.
    template <class Meets>
    std::vector<Range> free(const Event& from, const Event& to, std::vector<Event> changes, const Meets& meets, const std::vector<OpenCover>& covers) {
        const bool is_one = decide.order(from, to) == 0;
        if (is_one) return is_free_at(from, meets, covers) ? std::vector<Range>{{from, to, true}} : std::vector<Range>{};
        std::vector<Range> left = without({{from, to, false}}, std::move(changes), [&](RoundJunction& at, const RoundSpot& p) { return !meets(at, p); });
        for (const OpenCover& cover : covers) {
            if (left.empty()) break;
            heed_stop();
            left = without(left, cover);
        }
        return left;
    }
    Predicates decide;

private:
    RoundJunction junction_at(const Event& e) {
        return RoundJunction(scene, on.chart, e.lo, e.hi, [this, e] { return decide.long_root_of(e); }, [this, e] { return decide.narrowed(e); });
    }
    template <class Meets>
    bool is_free_at(const Event& e, const Meets& meets, const std::vector<OpenCover>& covers) {
        heed_stop();
        RoundJunction here = junction_at(e), quick = junction_at(e);
        const RoundSpot place = here.spot(on.contact, name, false);
        quick.ask_doubles_only();
        const auto is_covered = [&](RoundJunction& at) { return std::any_of(covers.begin(), covers.end(), [&](const OpenCover& cover) { return cover.has(at, place); }); };
        return !is_covered(quick) && meets(here, place) && !is_covered(here);
    }

    std::vector<Range> without(const std::vector<Range>& whole, const OpenCover& cover) {
        std::vector<Range> result;
        for (const Range& range : whole) {
            std::vector<Event> changes;
            for (const Feature& surface : cover.surfaces) {
                if (range.is_one) break;
                const bool is_point = name.kind == Kind::seam;
                const Feature first = is_point ? on_branch(surface, 1) : name, second = is_point ? Feature{} : surface;
                if (decide.event_sign_on(first, second, range.from.lo, range.to.hi) != 0) continue;
                const auto roots = decide.event_roots(first, second, range.from, range.to);
                changes.insert(changes.end(), roots.at.begin(), roots.at.end());
            }
            const auto rest = without({range}, std::move(changes), cover.has);
            result.insert(result.end(), rest.begin(), rest.end());
        }
        return result;
    }
    // Ranges without the angles at which a place is covered, an open set but for its ends, which changes at events only.
    template <class Covered>
    std::vector<Range> without(const std::vector<Range>& whole, std::vector<Event> changes, const Covered& is_covered) {
        std::sort(changes.begin(), changes.end(), [&](const Event& x, const Event& y) { return decide.order(x, y) < 0; });
        const auto at_event = [&](const Event& e) {
            RoundJunction here = junction_at(e);
            return is_covered(here, here.spot(on.contact, name, false));
        };
        const auto between = [&](const Event& first, const Event& last) {
            const Dyadic tau = decide.between(first, last).exact();
            RoundJunction here(scene, on.chart, tau.rounded_down(), tau.rounded_up(), [&] { return LongRoot{LongPoly{-tau.n, Int(1) << tau.k}, tau, tau}; },
                               [&]() -> std::optional<Predicates::Bracket> {
                                   const Ball number = ball(tau.n, static_cast<int>(tau.k));
                                   return Predicates::Bracket{number, number};
                               });
            return is_covered(here, here.spot(on.contact, name, false));
        };
        std::vector<Range> result;
        for (const Range& range : whole) {
            if (range.is_one) {
                if (!at_event(range.from)) result.push_back(range);
                continue;
            }
            std::vector<Event> ends{range.from};
            for (const Event& x : changes)
                if (decide.order(ends.back(), x) < 0 && decide.order(x, range.to) < 0) ends.push_back(x);
            ends.push_back(range.to);
            bool is_open = false;  // true if the last range goes on
            for (std::size_t k = 0; k < ends.size(); ++k) {
                const bool goes_on = k + 1 < ends.size() && !between(ends[k], ends[k + 1]);
                const bool is_free = is_open || goes_on || !at_event(ends[k]);
                if (is_open) result.back().to = ends[k];
                else if (is_free) result.push_back({ends[k], ends[k], !goes_on});
                is_open = goes_on;
            }
        }
        return result;
    }

    const Scene& scene;
    const Surface on;
    const Feature name;
};

// Curves of fits in concave arcs, one patch after another.
class FitsOfArcs {
public:
    FitsOfArcs(const Scene& s, const Patches& p) : scene(s), patches(p), covers(s) {}

    bool may_have(Index patch) const {
        const Feature contact = patches.contact(patch);
        return is_circle(contact) && is_concave(scene, contact);
    }
    void add(Index patch, std::vector<Trapezoid>& out) const {
        const Feature contact = patches.contact(patch);
        if (have_equal_radii(scene, contact.robot, contact.obstacle)) {
            const std::vector<OpenCover> near = covers.near(contact);
            for (const int chart : {0, 1}) add_helix({contact, chart}, near, patch, out);
            return;
        }
        const std::vector<Held> held = held_on(contact);
        const std::vector<Feature> touching = facing(contact);
        const std::vector<OpenCover> near = covers.near(contact);
        const std::vector<Feature> opposite = opposite_circles(scene, contact, covers.reach());
        for (const int chart : {0, 1}) {
            for (const Held& curve : held) add_held({contact, chart}, curve, near, patch, out);
            for (const Feature& surface : touching) add_touch({contact, chart}, surface, touching, near, patch, out);
            const HollowQuadrant quadrant{{contact, chart}, cones(contact), near};
            for (const Feature& circle : opposite) add_sliding_arcs(scene, quadrant, circle, patch, out);
        }
    }

private:
    // A surface that covers a circle but for one point at all angles.
    struct Held {
        Feature surface;
        Vec<Int> normal;  // outward normal u of the obstacle there, in the plane of the obstacles, or of the robot with the opposite sign
        bool turns;       // true in that of the robot
    };

    static Event chart_end(double side) { return {{}, {}, side, side}; }
    std::array<Feature, 2> cone(bool of_robot, const Feature& pair) const {  // first and last edge beside a vertex
        const Shape& s = of_robot ? scene.robot : scene.obstacles;
        const Index own = of_robot ? pair.robot : pair.obstacle, other = of_robot ? pair.obstacle : pair.robot;
        std::array<Feature, 2> result{contact_line_of(of_robot, s.previous[own], other), contact_line_of(of_robot, own, other)};
        if (s.is_concave(own)) std::swap(result[0], result[1]);
        return result;
    }
    std::vector<std::array<Feature, 2>> cones(const Feature& pair) const {  // of vertices that have one
        std::vector<std::array<Feature, 2>> result;
        if (scene.robot.has_extent(pair.robot)) result.push_back(cone(true, pair));
        if (scene.obstacles.has_extent(pair.obstacle)) result.push_back(cone(false, pair));
        return result;
    }
    static void put(FreeCurve& free, const std::vector<FreeCurve::Range>& ranges, Index patch, const Surface& on, const Feature& curve, std::vector<Trapezoid>& out) {
        for (const auto& [from, to, is_one] : ranges)
            out.push_back({patch, on.chart, curve, curve, from, to, free.decide.place(from), free.decide.place(to)});
    }

    void add_helix(const Surface& on, const std::vector<OpenCover>& near, Index patch, std::vector<Trapezoid>& out) const {
        const Feature& pair = on.contact;
        const Feature end{Kind::seam, pair.robot, pair.obstacle, pair.branch};
        FreeCurve free(scene, on, end);
        const Event first = chart_end(-1), last = chart_end(1);
        std::vector<Event> changes;
        const bool has_cones = scene.robot.has_extent(pair.robot) && scene.obstacles.has_extent(pair.obstacle);
        const auto mine = has_cones ? cone(true, pair) : std::array<Feature, 2>{}, other = has_cones ? cone(false, pair) : std::array<Feature, 2>{};
        for (const Feature& x : mine)
            for (const Feature& y : other) {
                if (!has_cones) break;
                const auto roots = free.decide.parallel_roots(x.robot, y.obstacle, first, last);
                changes.insert(changes.end(), roots.at.begin(), roots.at.end());
            }
        // of two ranges of directions that meet, one begins in the other
        const auto meets = [&](RoundJunction& at, const RoundSpot&) {
            return !has_cones || (at.turn(mine[0], other[0]) >= 0 && at.turn(mine[1], other[0]) <= 0) ||
                   (at.turn(other[0], mine[0]) >= 0 && at.turn(other[1], mine[0]) <= 0);
        };
        put(free, free.free(first, last, std::move(changes), meets, near), patch, on, end, out);
    }

    void add_held(const Surface& on, const Held& held, const std::vector<OpenCover>& near, Index patch, std::vector<Trapezoid>& out) const {
        FreeCurve free(scene, on, held.surface);
        const Feature& pair = on.contact;
        std::vector<Event> ends{chart_end(-1)};
        const auto in_order = [&](const Event& x, const Event& y) { return free.decide.order(x, y) < 0; };
        if (held.turns) {
            for (const int end : {0, 1}) {
                const Feature seam{Kind::seam, pair.robot, pair.obstacle, (pair.branch + end) & 3};
                const auto roots = free.decide.event_roots(held.surface, seam, chart_end(-1), chart_end(1));
                ends.insert(ends.end(), roots.at.begin(), roots.at.end());
            }
            std::sort(ends.begin() + 1, ends.end(), in_order);
        }
        ends.push_back(chart_end(1));
        std::vector<Event> changes;
        const auto ranges = cones(pair);
        for (const auto& edges : ranges)
            for (const Feature& edge : edges) {
                const auto roots = free.decide.event_roots(held.surface, on_branch(edge, 0), chart_end(-1), chart_end(1));
                changes.insert(changes.end(), roots.at.begin(), roots.at.end());
            }
        const auto meets = [&](RoundJunction& at, const RoundSpot& p) { return has_normal(at, ranges, pair, p); };
        for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
            if (free.decide.order(ends[k], ends[k + 1]) == 0) continue;
            Vec<Int> normal = held.normal;
            if (held.turns) {
                const Dyadic tau = free.decide.between(ends[k], ends[k + 1]).exact();
                const auto R = rotation_by(on.chart, tau.n, Int(1) << tau.k);
                const Vec<Int> turned = R(normal);
                normal = {-turned.x, -turned.y};
            }
            for (int turns = pair.branch; turns > 0; --turns) normal = {normal.y, -normal.x};  // the quadrant becomes the first
            if (normal.x.sign() < 0 || normal.y.sign() < 0) continue;
            put(free, free.free(ends[k], ends[k + 1], changes, meets, near), patch, on, held.surface, out);
        }
    }

    // Surfaces that may touch the circle at some angles with the opposite normal.
    std::vector<Feature> facing(const Feature& pair) const {
        const Shape &A = scene.robot, &O = scene.obstacles;
        const Box near = grown(edge_box(O, pair.obstacle), covers.reach());
        const Int radius = A.radius_of(pair.robot).exact + O.radius_of(pair.obstacle).exact;
        // circles of one radius, one convex and one concave, are one where they touch
        const auto are_opposite = [&](Index i, Index j) { return Int(radius + A.radius_of(i).exact + O.radius_of(j).exact).is_zero(); };
        std::vector<Feature> result;
        const auto add = [&](Feature f) {
            f.branch = static_cast<std::int8_t>(is_circle(f) && is_below_zero(RoundSurfaces<Approx>(scene).rho(f)) ? 1 : -1);
            result.push_back(f);
        };
        for (Index j = 0; j < O.ring_vertices; ++j) {
            if (!O.emit[j] || !near.meets(edge_box(O, j))) continue;
            for (Index i = 0; i < A.ring_vertices; ++i) {
                if (A.layer[i] != O.layer[j] || A.layer[i] != body_layer) continue;
                if (A.convex[i] && O.makes_surfaces(j)) add({Kind::vertex_edge, i, j});
                if (O.convex[j] && A.makes_surfaces(i)) add({Kind::edge_vertex, i, j});
                if (makes_circles(scene, i, j) && !(i == pair.robot && j == pair.obstacle) && !are_opposite(i, j)) add({Kind::vertex_vertex, i, j});
            }
        }
        return result;
    }

    // The points where a surface touches a circle, in one quadrant of it.
    void add_touch(const Surface& on, const Feature& surface, const std::vector<Feature>& others, const std::vector<OpenCover>& near, Index patch,
                   std::vector<Trapezoid>& out) const {
        FreeCurve free(scene, on, surface);
        const RoundOrders& orders = free.decide.round_orders();
        const Feature& pair = on.contact;
        const auto roots = free.decide.event_roots(surface, {}, chart_end(-1), chart_end(1));
        if (roots.all_zero) return;
        std::vector<Event> events{chart_end(-1), chart_end(1)};
        events.insert(events.end(), roots.at.begin(), roots.at.end());
        const auto ranges = cones(pair);
        for (const Event& e : events) {
            const bool is_end = e.first.kind == Kind::none;
            const auto turned = orders.turned_to(0.5 * (e.lo + e.hi));
            const NearTouch touch = touch_in_doubles(orders, pair, surface, ranges, turned);
            if (!touch.is_there) continue;
            if (!is_end && !e.is_touch && touch.is_known && !may_be_held(orders, pair, surface, touch, others, turned)) continue;
            if (is_end && (free.decide.event_sign_on(surface, {}, e.lo, e.hi) != 0 || !free.vanishes(surface, e))) continue;
            const auto meets = [&](RoundJunction& at, const RoundSpot& p) {
                const auto seam = [&](int turns) { return at.spot(pair, {Kind::seam, pair.robot, pair.obstacle, turns & 3}, false); };
                const Quadrant ends = quadrant_of(scene, pair);
                return at.is_between(pair, seam(ends.begin), seam(ends.end), p) && has_normal(at, ranges, pair, p);
            };
            put(free, free.free(e, e, {}, meets, near), patch, on, surface, out);
        }
    }
    // A touch with the opposite normal in doubles: the unit vector from the circle's centre to the place, if they tell it.
    struct NearTouch {
        double x, y;
        bool is_known, is_there;  // the second is false if the surface does not reach it, or the normal is in another quadrant or in no cone
    };
    static constexpr double hair = 0x1p-20;
    NearTouch touch_in_doubles(const RoundOrders& orders, const Feature& pair, const Feature& surface, const std::vector<std::array<Feature, 2>>& cones,
                               const RoundOrders::Turned& here) const {
        const RoundSurfaces<Approx> of(scene);
        const auto site = orders.to_centre(surface, here);
        const double size = -of.rho(pair).v, radius = of.rho(surface).v;
        NearTouch touch{0, 0, false, true};
        if (is_line(surface)) {
            const auto V = orders.along(surface, here);
            const double length = length_of(V.x, V.y), t = ((size * V.y / length - site.x) * V.x - (size * V.x / length + site.y) * V.y) / (length * length);
            if (0x1p-40 * (site.m + size) > hair * length) return touch;
            touch = {V.y / length, -V.x / length, true, t > -hair && t < 1 + hair};
        } else {
            const double apart = size - radius;
            if (0x1p-40 * (site.m + size) > hair * std::abs(apart)) return touch;
            touch = {site.x / apart, site.y / apart, true, true};
        }
        double u = -touch.x, v = -touch.y;  // the normal, turned into the first quadrant
        for (int k = 0; k < (pair.branch & 3); ++k) std::tie(u, v) = std::pair(v, -u);
        touch.is_there &= u > -hair && v > -hair;
        for (const auto& edges : cones) {
            const auto ahead = [&](const Feature& edge) {
                const auto V = orders.along(edge, here);
                return (V.x * touch.x + V.y * touch.y) / length_of(V.x, V.y);
            };
            touch.is_there &= ahead(edges[0]) < hair && ahead(edges[1]) > -hair;
        }
        return touch;
    }
    // True if a third surface may go through a touch: without one there is room beside it at the angles on one side.
    bool may_be_held(const RoundOrders& orders, const Feature& pair, const Feature& surface, const NearTouch& touch, const std::vector<Feature>& others,
                     const RoundOrders::Turned& here) const {
        const RoundSurfaces<Approx> of(scene);
        const double size = -of.rho(pair).v;
        const auto is_one = [&](const Feature& f, const Feature& g) {  // the same circle, of another arc
            return is_circle(f) && is_circle(g) && scene.robot.point[f.robot] == scene.robot.point[g.robot] &&
                   scene.obstacles.point[f.obstacle] == scene.obstacles.point[g.obstacle] &&
                   scene.robot.vertex_radius[f.robot] == scene.robot.vertex_radius[g.robot] &&
                   scene.obstacles.vertex_radius[f.obstacle] == scene.obstacles.vertex_radius[g.obstacle];
        };
        return std::any_of(others.begin(), others.end(), [&](const Feature& f) {
            if (f == surface || is_one(f, surface) || is_one(f, pair)) return false;
            const auto site = orders.to_centre(f, here);
            const double x = size * touch.x - site.x, y = size * touch.y - site.y, radius = of.rho(f).v;
            double away;
            if (is_line(f)) {
                const auto V = orders.along(f, here);
                away = (V.x * y - V.y * x) / length_of(V.x, V.y) + radius;
            } else {
                away = length_of(x, y) - std::abs(radius);
            }
            return std::abs(away) <= hair * (size + std::abs(radius)) + 0x1p-40 * site.m;
        });
    }
    // All surfaces that do so: of the same place of the convex vertex's shape, with features of the other one; or of the centre of the
    // arc, with features of the convex vertex's shape.
    std::vector<Held> held_on(const Feature& pair) const {
        const bool of_robot = scene.robot.is_concave(pair.robot);
        const Shape &s = of_robot ? scene.robot : scene.obstacles, &t = of_robot ? scene.obstacles : scene.robot;
        const Index arc = of_robot ? pair.robot : pair.obstacle, vertex = of_robot ? pair.obstacle : pair.robot;
        std::vector<Held> result;
        for (Index w = 0; w < t.ring_vertices; ++w)
            if (is_at(t, w, vertex)) add_held_by(s, arc, t, w, of_robot, pair, result);
        for (Index j = 0; j < s.ring_vertices; ++j)
            if (is_at(s, j, arc) && (j == arc || s.vertex_radius[j] != s.vertex_radius[arc])) add_held_by(t, vertex, s, j, !of_robot, pair, result);
        return result;
    }
    static bool is_at(const Shape& s, Index v, Index other) { return s.X[v] == s.X[other] && s.Y[v] == s.Y[other] && s.layer[v] == s.layer[other] && s.emit[v]; }

    // The same about one place, a vertex `at` of a shape: with features of the other shape, of which `own` is the pair's.
    void add_held_by(const Shape& s, Index own, const Shape& other, Index at, bool of_robot, const Feature& pair, std::vector<Held>& out) const {
        const Int size = -(scene.robot.radius_of(pair.robot).exact + scene.obstacles.radius_of(pair.obstacle).exact), &radius = other.radius_of(at).exact;
        // in doubles, whether two lengths may be equal
        const double size_near = -(scene.robot.radius_of(pair.robot).about.hi + scene.obstacles.radius_of(pair.obstacle).about.hi);
        const double radius_near = other.radius_of(at).about.hi, most = size_near + std::abs(radius_near) + std::abs(s.x[own]) + std::abs(s.y[own]);
        const auto may_be_one = [&](double x, double y) { return std::abs(x - y) <= 0x1p-30 * (std::abs(x) + std::abs(y) + most); };
        for (Index v = 0; v < s.ring_vertices; ++v) {
            if (s.layer[v] != s.layer[own] || !s.emit[v]) continue;
            const double sigma_near = s.radius_of(v).about.hi + radius_near;
            if (may_be_one(length_of(s.x[v] - s.x[own], s.y[v] - s.y[own]), sigma_near < 0 ? size_near - sigma_near : sigma_near - size_near)) {
                const Int sigma = s.radius_of(v).exact + radius, between = sigma.sign() < 0 ? size - sigma : sigma - size;
                const Vec<Int> d = difference<Int>(s, v, own);
                const Feature circle = contact_circle_of(of_robot, v, at);
                if (makes_circles(scene, circle.robot, circle.obstacle) && between.sign() > 0 && dot(d, d) == between * between)
                    out.push_back({circle, sigma.sign() < 0 ? Vec<Int>{-d.x, -d.y} : d, of_robot});
            }
            if (!s.makes_surfaces(v) || !other.convex[at]) continue;
            const Index start = s.v[v];
            const double ex = s.x[s.w[v]] - s.x[start], ey = s.y[s.w[v]] - s.y[start];
            const double away = (ex * (s.y[own] - s.y[start]) - ey * (s.x[own] - s.x[start])) / length_of(ex, ey);
            if (!may_be_one(away, size_near - (s.radius_of(start).about.hi + radius_near))) continue;
            const Vec<Int> E = edge<Int>(s, v);
            const Int height = cross(E, difference<Int>(s, own, start)), wanted = size - (s.radius_of(start).exact + radius);
            if (height.sign() == wanted.sign() && height * height == wanted * wanted * dot(E, E))
                out.push_back({on_branch(contact_line_of(of_robot, v, at), 1), {-E.y, E.x}, of_robot});
        }
    }

    const Scene& scene;
    const Patches& patches;
    const OpenCovers covers;
};

}  // namespace

void add_fits_of_arcs(const Scene& scene, const Patches& patches, int threads, Trapezoids& thin) {
    if (!scene.robot.has_concave() && !scene.obstacles.has_concave()) return;
    const FitsOfArcs fits(scene, patches);
    std::vector<Index> chosen;
    for (Index k = 0; k < static_cast<Index>(patches.size()); ++k)
        if (fits.may_have(k)) chosen.push_back(k);
    std::vector<std::vector<Trapezoid>> parts(chosen.size());
    for_each_in_parallel(threads, chosen.size(), [&](std::size_t n) { fits.add(chosen[n], parts[n]); });
    for (const auto& list : parts)
        for (const Trapezoid& part : list) thin.push_back(part);
}

}  // namespace cfree
