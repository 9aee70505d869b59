// Curves on lines and circles of grown shapes: their orders and where these change, against long doubles.
#include "rounded.hpp"

// A circle at an end of a line, on the same branch if that has one.
static Feature neighbour(const Scene& s, const Feature& f) {
    const int branch = f.branch != 0 ? f.branch : random_between(0, 1) ? 1 : -1;
    if (f.kind == Kind::vertex_edge) return {Kind::vertex_vertex, f.robot, random_between(0, 1) ? s.obstacles.v[f.obstacle] : s.obstacles.w[f.obstacle], branch};
    if (f.kind == Kind::edge_vertex) return {Kind::vertex_vertex, random_between(0, 1) ? s.robot.v[f.robot] : s.robot.w[f.robot], f.obstacle, branch};
    return random_feature(s);
}

static void orders_agree_with_long_doubles() {
    int compared = 0, changes = 0;
    for (int k = 0; k < 6000; ++k) {
        const SceneFeatures made = random_scene();
        const Scene& s = *made.scene;
        Feature x = random_feature(s);
        x.branch = x.kind == Kind::vertex_vertex ? static_cast<std::int8_t>(random_between(0, 3)) : std::int8_t(0);
        const Surface surface{x, static_cast<int>(random_between(0, 1))};
        const RoundOrders orders(s, surface);
        const auto random_curve = [&]() -> Feature {
            if (is_circle(x) && random_between(0, 5) == 0) return {Kind::seam, x.robot, x.obstacle, static_cast<int>(x.branch + random_between(0, 1)) & 3};
            Feature f = random_feature(s);
            if ((is_line(x) && is_line(f)) || is_smooth(s, x, f) || is_smooth(s, f, x)) f.branch = 0;
            return f;
        };
        const Feature p = random_curve(), q = random_between(0, 2) > 0 ? random_curve() : neighbour(s, p);
        if (code(s, x) == code(s, p) || code(s, x) == code(s, q) || code(s, p) == code(s, q)) continue;
        // at the angles from `lo` to `hi` both exist, and on a circle are in the quadrant
        const Real quarter = std::acos(Real(-1)) / 2;
        const auto here = [&](const Feature& f, Real tau) {
            const Real v = value(s, x, f, 2 * std::atan(tau) + surface.chart * 2 * quarter);
            const bool is_far = is_circle(x) ? v < -1e-15L || v > quarter + 1e-15L : std::abs(v) > 50;
            return is_far ? Real(std::nan("")) : v;
        };
        const auto exist = [&](double tau) { return std::abs(tau) <= 1 && std::isfinite(here(p, tau)) && std::isfinite(here(q, tau)); };
        double lo = std::ldexp(double(random_between(-1024, 1024)), -10), hi = lo;
        if (!exist(lo)) continue;
        const auto is_near = [&](const Feature& f, double tau, double next) {  // not across a pole
            return std::abs(here(f, tau) - here(f, next)) < 1 && std::abs(here(f, (tau + next) / 2) - here(f, next)) < 1;
        };
        const auto goes_on = [&](double tau, double next) { return exist(next) && is_near(p, tau, next) && is_near(q, tau, next); };
        while (goes_on(lo, lo - 0x1p-9)) lo -= 0x1p-9;
        while (goes_on(hi, hi + 0x1p-9)) hi += 0x1p-9;
        if (lo == hi) continue;
        Predicates decide(s, surface);
        const Curve first{p, code(s, p), false, false, false, {}, {}}, second{q, code(s, q), false, false, false, {}, {}};
        const Event begin{{}, {}, lo, lo}, end{{}, {}, hi, hi};
        const auto found = decide.compare(first, second, begin, end);
        ++compared, changes += found.at.size();
        for (int n = 1; n < 64; ++n) {
            const double tau = lo + (hi - lo) * n / 64;
            const Real difference = here(p, tau) - here(q, tau);
            if (!(std::abs(difference) > 1e-12L)) continue;  // also where circles touch all the time, by rounding
            const int sign = difference > 0 ? 1 : -1;
            int piece = 0;
            while (piece < found.at.size() && found.at[piece].hi < tau) ++piece;
            if (piece < found.at.size() && found.at[piece].lo <= tau) continue;
            CHECK(found.sign[piece] == sign);
            if (n % 16 == 0) {
                CHECK(orders.order_at(p, q, Sample{tau, {}}) == sign);
                const auto in_balls = orders.order_in_balls(p, q, Ball(tau));
                CHECK(!in_balls || *in_balls == sign);
            }
        }
    }
    std::printf("%d pairs of curves, %d changes of order\n", compared, changes);
    CHECK(compared > 200 && changes > 40);
}

static Curve curve_of(const Scene& s, const Feature& f) { return {f, code(s, f), false, false, false, {}, {}}; }
static const Event chart_begin{{}, {}, -1, -1}, chart_end{{}, {}, 1, 1};

// A disc touches discs about 0, 6 and 3 + 3i, all of radius 3 with its own: the three circles meet in 3 at all angles.
static void circles_that_always_meet_in_a_point_are_tied() {
    const SceneFeatures made = scene_of(polygon({{0, 0}}), {1, 1}, {polygon({{0, 0}}), polygon({{6, 0}}), polygon({{3, 3}})},
                                        {{2, 1}, {2, 1}, {2, 1}});
    const Scene& s = *made.scene;
    for (int quadrant : {0, 3}) {
        Predicates decide(s, {{Kind::vertex_vertex, 0, 0, quadrant}, 0});
        for (int b : {-1, 1})
            for (int c : {-1, 1}) {
                if (quadrant == 3 && c == 1) continue;  // at 90 degrees
                const auto order = decide.compare(curve_of(s, {Kind::vertex_vertex, 0, 1, b}), curve_of(s, {Kind::vertex_vertex, 0, 2, c}),
                                                  chart_begin, chart_end);
                // circle 1 touches at 0 degrees; circle 2 is met at 0 and at 90 degrees
                CHECK(order.at.empty() && order.sign[0] == (c == -1 ? 0 : -1));
            }
    }
}

// A line and the circle at its end are met by another line in their joint, and do not cross there.
static void smooth_neighbours_touch_in_their_joint() {
    const SceneFeatures made = scene_of(polygon({{0, 0}, {7, 1}}), {1, 2}, {polygon({{0, 0}, {4, 0}, {4, 3}})}, {{1, 3}});
    const Scene& s = *made.scene;
    int touches = 0;
    for (const int chart : {0, 1}) {
        Predicates decide(s, {{Kind::edge_vertex, 0, 0}, chart});
        for (int b : {-1, 1}) {
            const Curve line = curve_of(s, {Kind::vertex_edge, 1, 1}), circle = curve_of(s, {Kind::vertex_vertex, 1, 2, b});
            const Surface on{{Kind::edge_vertex, 0, 0}, chart};
            const auto p = RoundOrders(s, on).in_balls(line.feature, circle.feature);
            CHECK(p.count == 3);  // the joint's quadratic, not its square
            // at angles at which the robot's line cuts the disc
            for (double lo = -1; lo < 1; lo += 0x1p-5) {
                const double hi = lo + 0x1p-5;
                const auto cuts = [&](double tau) {
                    return std::isfinite(value(s, on.contact, circle.feature, 2 * std::atan(Real(tau)) + chart * std::acos(Real(-1))));
                };
                if (!cuts(lo) || !cuts(hi) || !cuts(lo + 0x1p-6)) continue;
                const auto order = decide.compare(line, circle, {{}, {}, lo, lo}, {{}, {}, hi, hi});
                touches += order.at.size();
                for (int k = 0; k < order.at.size(); ++k) CHECK(order.at[k].is_touch && order.sign[k] == order.sign[k + 1]);
            }
        }
    }
    CHECK(touches == 2);
}

// Angles of several curves on one surface, in order: by their intervals, and equal where two names mean one angle.
static void angles_are_ordered() {
    for (int k = 0; k < 60; ++k) {
        const SceneFeatures made = random_scene();
        const Scene& s = *made.scene;
        Feature x = random_feature(s);
        x.branch = 0;
        Predicates decide(s, {x, 0});
        std::vector<Event> events;
        for (int n = 0; n < 12; ++n) {
            const Feature p = random_feature(s), q = random_feature(s);
            if (code(s, {p.kind, p.robot, p.obstacle}) == code(s, {q.kind, q.robot, q.obstacle})) continue;
            for (const Feature& f : {p, q})
                if (code(s, {f.kind, f.robot, f.obstacle}) == code(s, {x.kind, x.robot, x.obstacle})) goto next;
            for (const Event& e : decide.event_roots(p, q, chart_begin, chart_end).at) events.push_back(e);
            for (const Event& e : decide.event_roots(q, p, chart_begin, chart_end).at) events.push_back(e);
        next:;
        }
        for (const Event& e : events)
            for (const Event& f : events) {
                const int order = decide.order(e, f);
                CHECK(order == -decide.order(f, e));
                if (e.hi < f.lo) CHECK(order == -1);
                if (order != 0) continue;
                CHECK(e.lo <= f.hi && f.lo <= e.hi);
            }
        for (std::size_t n = 0; n + 1 < events.size(); n += 2)
            for (std::size_t m = n + 1; m < events.size(); ++m)
                if (events[n].first.robot == events[m].second.robot && events[n].first.obstacle == events[m].second.obstacle &&
                    events[n].lo == events[m].lo && events[n].first.kind == events[m].second.kind &&
                    events[n].second.kind == events[m].first.kind && events[n].second.robot == events[m].first.robot &&
                    events[n].second.obstacle == events[m].first.obstacle)
                    CHECK(decide.order(events[n], events[m]) == 0);
    }
}

static Surface random_surface(const Scene& s) {
    Feature x = random_feature(s);
    x.branch = is_circle(x) ? static_cast<std::int8_t>(random_between(0, 3)) : std::int8_t(0);
    return {x, static_cast<int>(random_between(0, 1))};
}

// Signs in doubles at an angle, and everywhere between two, are those of the exact polynomials.
static void certain_signs_in_doubles_are_exact() {
    int certain = 0, everywhere = 0, joints = 0, turns = 0;
    constexpr unsigned bits[] = {0, 60, 130};  // coordinates are doubles, sums of two, or rounded
    for (int k = 0; k < 3000; ++k) {
        const SceneFeatures made = random_scene(false, bits[k % 3]);
        const Scene& s = *made.scene;
        const Surface on = random_surface(s);
        const RoundOrders orders(s, on);
        const Feature p = random_feature(s), q = random_between(0, 2) == 0 ? Feature{} : random_feature(s);
        const auto bare = [&](const Feature& f) { return code(s, {f.kind, f.robot, f.obstacle}); };
        if (bare(p) == bare(q) || bare(p) == bare(on.contact) || bare(q) == bare(on.contact)) continue;
        const RoundForm form = orders.form(p, q);
        const SurdPoly exact = orders.exactly(p, q).p;
        const double lo = std::ldexp(double(random_between(-1024, 1000)), -10), width = std::ldexp(1.0, -static_cast<int>(random_between(2, 40)));
        const double hi = std::min(1.0, lo + width);
        int signs[7];  // of the coefficients of Bernstein's basis
        form.signs(lo, hi, signs);
        const bool is_one = std::all_of(signs, signs + form.degree, [&](int sign) { return sign == signs[form.degree]; });
        const int common = is_one ? signs[0] : 0;
        for (const double tau : {lo, 0.5 * (lo + hi), hi}) {
            const int sign = sign_at(exact, Dyadic::from(tau)), quick = form.sign(tau);
            if (quick != 0) CHECK(quick == sign);
            if (common != 0) CHECK(common == sign);
            certain += quick != 0, everywhere += common != 0;
        }
        const Feature circle = neighbour(s, p);
        if (is_line(p) && is_smooth(s, p, circle) && !is_smooth(s, on.contact, circle)) {
            const auto turned = orders.turned_to(lo);
            const auto along = [&](const Feature& f) { return is_line(f) ? orders.along(f, turned) : RoundOrders::Vector{}; };
            const int quick = orders.joint_sign(p, along(p), circle, orders.to_centre(circle, turned), along(on.contact));
            if (quick != 0) CHECK(quick == sign_at(orders.exactly(p, circle).p, Dyadic::from(lo)));
            joints += quick != 0;
        }
        if (!is_line(p)) continue;
        for (int quadrant = 0; quadrant < 4; ++quadrant) {  // the outward normal of a line against an axis
            const Sample at{lo, {}};
            const int found = orders.turn(orders.direction({Kind::seam, 0, 0, quadrant}, at), orders.direction(p, at), at);
            const Place line = placed(s, p, 2 * std::atan(Real(lo)) + on.chart * std::acos(Real(-1)));
            const Point normal{line.along.y, -line.along.x}, axis{Real(quadrant == 0) - (quadrant == 2), Real(quadrant == 1) - (quadrant == 3)};
            const Real value = cross(axis, normal);
            if (!(std::abs(value) > 1e-12L * std::sqrt(dot(normal, normal)))) continue;
            CHECK(found == (value > 0 ? 1 : -1));
            ++turns;
        }
    }
    CHECK(certain > 3000 && everywhere > 1000 && joints > 300 && turns > 3000);
}

// A joint of a line that is parallel to the surface's is on it where its circle touches it: one angle by two names.
static void proportional_quadratics_are_one_angle() {
    const SceneFeatures made = scene_of(polygon({{0, 0}, {7, 1}, {3, 9}}), {1, 2}, {polygon({{0, 0}, {4, 0}, {4, 3}}), polygon({{5, 6}, {9, 7}})}, {{1, 3}, {1, 3}});
    const Scene& s = *made.scene;
    int equal = 0;
    for (const int chart : {0, 1})
        for (Index v = 0; v < s.obstacles.ring_vertices; ++v)
            for (Index w = 0; w < s.obstacles.ring_vertices; ++w)
                for (Index g = 0; g < 3 && v != w; ++g) {
                    const Surface on{{Kind::edge_vertex, g, v}, chart};
                    Predicates decide(s, on);
                    const Feature circle{Kind::vertex_vertex, s.robot.v[g], w, 0};
                    for (const int side : {-1, 1}) {
                        const auto touches = decide.event_roots({circle.kind, circle.robot, circle.obstacle, side}, {}, chart_begin, chart_end);
                        const auto joints = decide.event_roots({Kind::edge_vertex, g, w}, circle, chart_begin, chart_end);
                        for (const Event& x : touches.at)
                            for (const Event& y : joints.at) {
                                const bool overlap = x.lo <= y.hi && y.lo <= x.hi;
                                CHECK((decide.order(x, y) == 0) == overlap);
                                equal += overlap;
                            }
                    }
                }
    CHECK(equal > 20);
}

// A vertex of the robot, (a, b) from one on the floor, is highest at a + b i times -i: on both sides of that angle it touches a disc
// that is as high, by a hair. The two angles are in one interval of doubles; each comes back from its place among them.
static void close_angles_come_back_from_their_places() {
    const long sides[][3] = {{3, 4, 5}, {5, 12, 13}, {20, 21, 29}, {4, 3, 5}};
    int fine = 0;
    for (const auto& [a, b, c] : sides)
        for (unsigned n = 90; n < 240; n += 3) {
            const Int one = Int(1) << n;
            const SceneFeatures made = scene_of(polygon({{0, 0}, {a, b}}), {1, 1}, {polygon({{0, 0}, {4, 0}, {0, 4}}), polygon({{9, 0}})},
                                                {{1, 1}, {(c - 3) * one - 1, one}});
            Predicates decide(*made.scene, {{Kind::vertex_edge, 0, 0}, 0});
            const auto touches = decide.event_roots({Kind::vertex_vertex, 1, 3, 1}, {}, chart_begin, chart_end);
            CHECK(touches.at.size() == 2);
            for (const Event& x : touches.at) {
                const int place = decide.place(x);
                fine += place > 0;
                const Event back = decide.restored({x.first, x.second, x.lo, x.hi}, place);
                for (const Event& y : touches.at) CHECK(decide.order(back, y) == decide.order(x, y));
            }
        }
    CHECK(fine > 200);
}

int main() {
    certain_signs_in_doubles_are_exact();
    proportional_quadratics_are_one_angle();
    orders_agree_with_long_doubles();
    circles_that_always_meet_in_a_point_are_tied();
    smooth_neighbours_touch_in_their_joint();
    angles_are_ordered();
    close_angles_come_back_from_their_places();
    return failures > 0;
}
