// Trimmed patches of grown shapes: at random places live where no pillar is, by distances in long doubles.
#include "forbidden/coincident_surfaces.hpp"
#include "forbidden/round_trim.hpp"

#include <cstdlib>
#include <map>

#include "forbidden/coincident_surfaces.hpp"
#include "forbidden/round_names.hpp"
#include "rounded.hpp"

// Distance of two convex pieces, 0 if they overlap.
static Real distance_of(const std::vector<Point>& p, const std::vector<Point>& q) {
    const auto to_segment = [](const Point& x, const Point& a, const Point& b) {
        const Point d = b - a, w = x - a;
        const Real square = dot(d, d), t = square > 0 ? std::clamp(dot(w, d) / square, Real(0), Real(1)) : 0;
        const Point r{w.x - t * d.x, w.y - t * d.y};
        return std::sqrt(dot(r, r));
    };
    const auto crosses = [](const Point& a, const Point& b, const Point& c, const Point& d) {
        const auto side = [](const Point& x, const Point& y, const Point& z) { return cross(y - x, z - x); };
        return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
    };
    const auto contains = [](const std::vector<Point>& v, const Point& x) {
        if (v.size() < 3) return false;
        for (std::size_t k = 0; k < v.size(); ++k)
            if (cross(v[(k + 1) % v.size()] - v[k], x - v[k]) < 0) return false;
        return true;
    };
    if (contains(p, q[0]) || contains(q, p[0])) return 0;
    Real least = INFINITY;
    for (std::size_t k = 0; k < p.size(); ++k)
        for (std::size_t l = 0; l < q.size(); ++l) {
            const Point &a = p[k], &b = p[(k + 1) % p.size()], &c = q[l], &d = q[(l + 1) % q.size()];
            if (crosses(a, b, c, d)) return 0;
            least = std::min({least, to_segment(a, c, d), to_segment(c, a, b)});
        }
    return least;
}

struct Counts {
    int places = 0, live = 0, trapezoids = 0, wrong = 0, sides = 0, alone = 0;
    std::vector<std::pair<Feature, Trapezoid>> found;  // of one scene
};

static void check_patch(const Scene& s, const Feature& x, int chart, const Event& from, const Event& to, Counts& counts) {
    const Shape &A = s.robot, &O = s.obstacles;
    const std::vector<Index> edges = CoincidentSurfaces(s, false).edges_at(x.obstacle);
    RoundTrimmer trimmer(s, {x, chart}, from, to, edges);
    Slices slices;
    slices.cut(from.lo, to.hi, chart);
    for (Index p = 0; p < A.pieces(); ++p)
        for (Index k = 0; k < O.pieces(); ++k) trimmer.cover(p, k, slices, {0, slices.count - 1, false});
    std::vector<Trapezoid> live, thin;
    trimmer.finish(0, live, thin);
    counts.trapezoids += static_cast<int>(live.size());
    for (const Trapezoid& z : live) {
        counts.found.push_back({x, z});
        counts.found.back().second.chart = chart;
    }
    const Real half_turn = std::acos(Real(-1));
    const auto piece = [](const Shape& shape, Index k, auto place) {
        std::vector<Point> result;
        for (Index v = shape.piece[k]; v < shape.piece[k + 1]; ++v)
            result.push_back(place(Point{Real(shape.X[shape.piece_vertex[v]]), Real(shape.Y[shape.piece_vertex[v]])}));
        return result;
    };
    for (int n = 0; n < 12; ++n) {
        const double tau = from.hi + (to.lo - from.hi) * std::uniform_real_distribution<double>(0, 1)(random_numbers);
        const Real theta = 2 * std::atan(Real(tau)) + chart * half_turn;
        const Place on = placed(s, x, theta);
        Point at;
        Real t = std::uniform_real_distribution<double>(0, 1)(random_numbers);
        bool is_free = true;
        if (on.is_line) {
            at = {on.at.x + t * on.along.x, on.at.y + t * on.along.y};
        } else {
            t *= half_turn / 2;
            const Real psi = t + x.branch * half_turn / 2;
            at = {on.at.x + on.rho * std::cos(psi), on.at.y + on.rho * std::sin(psi)};
            const Point u{std::cos(psi), std::sin(psi)};
            const auto in_cone = [&](const Feature& first, const Feature& last) {
                const Place a = placed(s, first, theta), b = placed(s, last, theta);
                return dot(u, a.along) >= 0 && dot(u, b.along) <= 0;  // counter-clockwise from one normal to the other
            };
            if (O.has_extent(x.obstacle))
                is_free &= in_cone({Kind::vertex_edge, x.robot, O.previous[x.obstacle]}, {Kind::vertex_edge, x.robot, x.obstacle});
            if (A.has_extent(x.robot))
                is_free &= in_cone({Kind::edge_vertex, A.previous[x.robot], x.obstacle}, {Kind::edge_vertex, x.robot, x.obstacle});
        }
        const Real c = std::cos(theta), d = std::sin(theta);
        for (Index p = 0; p < A.pieces(); ++p) {
            const auto robot = piece(A, p, [&](const Point& v) { return Point{at.x + c * v.x - d * v.y, at.y + d * v.x + c * v.y}; });
            for (Index k = 0; k < O.pieces(); ++k) {
                const Real rho = Real(A.radii[A.vertex_radius[A.piece_vertex[A.piece[p]]]].exact) + Real(O.radii[O.vertex_radius[O.piece_vertex[O.piece[k]]]].exact);
                const Real gap = distance_of(robot, piece(O, k, [](const Point& v) { return v; })) - rho;
                is_free &= gap > -1e-9L;
            }
        }
        bool is_live = false, is_near = false;
        for (const Trapezoid& z : live) {
            if (!(z.from.hi <= tau && tau <= z.to.lo)) continue;
            const Real lower = value(s, x, z.lower, theta), upper = value(s, x, z.upper, theta);
            is_live |= lower <= t && t <= upper;
            is_near |= std::abs(t - lower) < 1e-8L || std::abs(t - upper) < 1e-8L;
        }
        if (is_near) continue;
        ++counts.places, counts.live += is_live;
        if (is_live != is_free) {
            ++counts.wrong;
            if (std::getenv("SHOW")) {
                for (const Trapezoid& z : live)
                    std::printf("  %g..%g lower %d b%d (%d,%d) %.4Lf upper %d b%d (%d,%d) %.4Lf\n", z.from.lo, z.to.hi, int(z.lower.kind), int(z.lower.branch), z.lower.robot, z.lower.obstacle, value(s,x,z.lower,theta), int(z.upper.kind), int(z.upper.branch), z.upper.robot, z.upper.obstacle, value(s,x,z.upper,theta));
                std::printf("patch kind %d branch %d (%d, %d) chart %d tau %.6f t %.6Lf: live %d free %d of %zu trapezoids\n", int(x.kind),
                            int(x.branch), int(x.robot), int(x.obstacle), chart, tau, t, is_live, is_free, live.size());
            }
        }
    }
}

// At an orientation each curve is the lower side of one segment and the upper side of another, by name.
static void check_names(const Scene& s, Counts& counts) {
    for (int n = 0; n < 16; ++n) {
        const double tau = std::uniform_real_distribution<double>(-1, 1)(random_numbers);
        const int chart = n % 2;
        std::map<CurveName, std::array<int, 2>> sides;
        for (const auto& [x, z] : counts.found) {
            if (z.chart != chart || !(z.from.hi < tau && tau < z.to.lo)) continue;
            ++sides[curve_name(s, x, z.lower)][0], ++sides[curve_name(s, x, z.upper)][1];
        }
        for (const auto& [name, times] : sides) counts.sides += times[0] + times[1], counts.alone += times[0] != 1 || times[1] != 1;
    }
    counts.found.clear();
}

// Surfaces of a scene that coincide have no owner here, and their curves no pairs.
static void check_scene(const Scene& s, Counts& counts, bool have_pairs = true) {
    const Shape &A = s.robot, &O = s.obstacles;
    Counters decisions;
    const Event begin{{}, {}, -1, -1}, end{{}, {}, 1, 1};
    for (Index j = 0; j < O.ring_vertices; ++j)
        for (Index i = 0; i < A.ring_vertices; ++i)
            for (const Kind kind : {Kind::vertex_edge, Kind::edge_vertex}) {
                if (kind == Kind::vertex_edge ? !O.has_extent(j) || !A.convex[i] : !A.has_extent(i) || !O.convex[j]) continue;
                const Range range = range_of(s, {kind, i, j}, decisions);
                for (int r = 0; r < range.count; ++r) check_patch(s, {kind, i, j}, range.chart[r], range.from[r], range.to[r], counts);
            }
    for (Index j = 0; j < O.ring_vertices; ++j)
        for (Index i = 0; i < A.ring_vertices; ++i) {
            if (!O.convex[j] || !A.convex[i]) continue;
            for (int chart = 0; chart < 2; ++chart)
                for (int quadrant = 0; quadrant < 4; ++quadrant) check_patch(s, {Kind::vertex_vertex, i, j, quadrant}, chart, begin, end, counts);
        }
    if (have_pairs) check_names(s, counts);
    counts.found.clear();
}

// Scenes with ties, in units of 1/60: equal discs on a lattice, gaps and corridors just as wide as the robot, coaxial stadiums,
// lines that coincide with different radii, exact fits.
static void check_ties(Counts& counts) {
    using Ring = std::vector<std::pair<long, long>>;
    const auto box = [](long w, long h, long x = 0, long y = 0) { return Ring{{x - w, y - h}, {x + w, y - h}, {x + w, y + h}, {x - w, y + h}}; };
    const auto frame = [](long a, long b) {
        return std::vector<Ring>{{{-b, -b}, {b, -b}, {a, -a}, {-a, -a}}, {{b, -b}, {b, b}, {a, a}, {a, -a}},
                                 {{b, b}, {-b, b}, {-a, a}, {a, a}}, {{-b, b}, {-b, -b}, {-a, -a}, {-a, a}}};
    };
    struct Tie {
        const char* name;
        Ring robot;
        long r;
        std::vector<Ring> obstacles;
        std::vector<long> radii;  // one for all, or one each
        bool coincide = false;    // surfaces do
    };
    const Ring L{{-18, -18}, {42, -18}, {42, 12}, {12, 12}, {12, 42}, {-18, 42}};
    const Ring U{{0, 0}, {180, 0}, {180, 120}, {120, 120}, {120, 60}, {60, 60}, {60, 120}, {0, 120}};
    const std::vector<Ring> lattice{{{0, 0}}, {{60, 0}}, {{0, 60}}, {{60, 60}}};
    const std::vector<Tie> ties{
        {"touching discs", {{0, 0}}, 15, lattice, {15}},
        {"overlapping discs", {{0, 0}}, 18, lattice, {18}},
        {"three discs through one point", {{0, 0}}, 0, {{{-180, 0}}, {{180, 0}}, {{0, 0}}}, {300, 300, 240}},
        {"rod among discs", {{0, 0}, {60, 0}}, 6, lattice, {6}},
        {"square and two discs", box(30, 30), 6, {{{0, 0}}, {{60, 0}}}, {6}},
        {"square and its equal", box(30, 30), 6, {box(30, 30)}, {0}},
        {"slot of the robot's width", box(30, 30), 6, {box(30, 30), box(30, 30, 132, 0)}, {0}},
        {"corridor as wide as the disc", {{0, 0}}, 15, {box(30, 30, 30, 30), box(30, 30, 120, 30)}, {0}},
        {"one offset line of two radii", box(30, 30), 6, {box(60, 30, -90, -30), box(60, 36, 90, -24)}, {12, 0}},
        {"a length that just fits", box(30, 12), 6, frame(36, 60), {0}, true},
        {"an exact fit", box(30, 30), 6, frame(36, 60), {0}, true},
        {"a mouth just closed", {{-90, -90}, {90, -90}, {90, 30}, {30, 30}, {30, -30}, {-30, -30}, {-30, 30}, {-90, 30}}, 6, {{{0, 0}}}, {24}, true},
        {"equal circles at one angle", {{-90, -60}, {90, -60}, {90, 60}, {30, 60}, {30, 0}, {-30, 0}, {-30, 60}, {-90, 60}}, 6, {{{0, 0}}, {{120, 0}}}, {0}},
        {"walls that meet at one angle", {{-90, -60}, {90, -60}, {90, 60}, {30, 60}, {30, 0}, {-30, 0}, {-30, 60}, {-90, 60}}, 6, {{{0, 0}, {48, 0}}}, {0}},
        {"one large disc behind a thin wall", {{0, 0}, {36, 0}}, 3, {{{0, 0}}, box(120, 3, 0, 54)}, {60, 0}},
        {"rod among discs of three radii", {{0, 0}, {60, 0}}, 6, {{{0, 0}}, {{78, 0}}, {{156, 0}}}, {0, 12, 24}},
        {"L in U", L, 3, {U}, {0}},
    };
    for (const Tie& tie : ties) {
        std::vector<Polygon> obstacles;
        std::vector<Ratio> radii;
        for (std::size_t k = 0; k < tie.obstacles.size(); ++k) {
            obstacles.push_back(polygon(tie.obstacles[k]));
            radii.push_back({tie.radii.size() > 1 ? tie.radii[k] : tie.radii[0], 1});
        }
        const SceneFeatures made = scene_of(polygon(tie.robot), {tie.r, 1}, std::move(obstacles), std::move(radii));
        const int before = counts.wrong, alone = counts.alone;
        try {
            check_scene(*made.scene, counts, !tie.coincide);
        } catch (const std::exception& fault) {
            std::printf("%s: %s\n", tie.name, fault.what()), ++failures;
        }
        if (counts.wrong > before) std::printf("%s: %d wrong\n", tie.name, counts.wrong - before);
        if (counts.alone > alone) std::printf("%s: %d names without a pair\n", tie.name, counts.alone - alone);
    }
}

int main(int argc, char** argv) {
    const int first = argc > 1 ? std::atoi(argv[1]) : 0, count = argc > 2 ? std::atoi(argv[2]) : 4;
    Counts counts;
    if (argc < 2) check_ties(counts);
    for (int k = first; k < first + count; ++k) {
        random_numbers.seed(static_cast<unsigned>(k));
        const SceneFeatures made = random_scene(k % 2 == 0);
        const int before = counts.wrong, alone = counts.alone;
        try {
            check_scene(*made.scene, counts);
        } catch (const std::exception& fault) {
            std::printf("scene %d: %s\n", k, fault.what()), ++failures;
        }
        if (counts.wrong > before) std::printf("scene %d: %d wrong\n", k, counts.wrong - before);
        if (counts.alone > alone) std::printf("scene %d: %d names without a pair\n", k, counts.alone - alone);
    }
    std::printf("%d places, %d live, %d trapezoids; %d sides, %d names without a pair\n", counts.places, counts.live, counts.trapezoids,
                counts.sides, counts.alone);
    CHECK(counts.wrong == 0 && counts.alone == 0 && counts.live > 0 && counts.sides > 0);
    return failures > 0;
}
