// Pillars that cover a point of a patch are never away from it by their octagons.
#include <algorithm>

#include "forbidden/round_shadows.hpp"
#include "rounded.hpp"

// Distance of a point and a segment, and of two convex polygons, which may be points or segments; 0 if they overlap.
static Real distance(const Point& p, const Point& a, const Point& b) {
    const Point d = b - a, e = p - a;
    const Real square = dot(d, d), t = square == 0 ? 0 : std::clamp(dot(d, e) / square, Real(0), Real(1));
    const Point rest{e.x - t * d.x, e.y - t * d.y};
    return std::sqrt(dot(rest, rest));
}
static Real distance(const std::vector<Point>& x, const std::vector<Point>& y) {
    Real least = 1e9L;
    const auto add = [&](const std::vector<Point>& points, const std::vector<Point>& ring) {
        for (const Point& p : points) {
            bool is_inside = ring.size() > 2;
            for (std::size_t k = 0; k < ring.size(); ++k) {
                const Point &a = ring[k], &b = ring[(k + 1) % ring.size()];
                least = std::min(least, distance(p, a, b)), is_inside &= cross(b - a, p - a) >= 0;
            }
            if (is_inside) least = 0;
        }
    };
    add(x, y), add(y, x);
    const auto crosses = [](const Point& a, const Point& b, const Point& c, const Point& d) {
        return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
    };
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t k = 0; k < y.size(); ++k)
            if (crosses(x[i], x[(i + 1) % x.size()], y[k], y[(k + 1) % y.size()])) least = 0;
    return least;
}

static void pillars_over_a_patch_are_not_rejected() {
    const Real half_turn = std::acos(Real(-1));
    int covered = 0, rejected = 0;
    for (int k = 0; k < 3000; ++k) {
        const SceneFeatures made = random_scene();
        const Scene& s = *made.scene;
        const Shape &A = s.robot, &O = s.obstacles;
        Feature contact = random_feature(s);
        contact.branch = is_circle(contact) ? static_cast<std::int8_t>(random_between(0, 3)) : std::int8_t(0);
        std::vector<Index> pieces;
        for (Index n = 0; n < O.pieces(); ++n) pieces.push_back(n);
        RoundShadows shadows(s, contact, pieces);
        const int chart = static_cast<int>(random_between(0, 1));
        const double from = std::ldexp(double(random_between(-16, 14)), -4), to = from + std::ldexp(double(random_between(1, 16)), -4);
        shadows.cut(chart, from, std::min(to, 1.0));
        for (int n = 0; n < 40; ++n) {
            const int slice = static_cast<int>(random_between(0, shadows.slices.count - 1));
            const double share = static_cast<double>(random_between(0, 64)) / 64;
            const double tau = shadows.slices.at[slice] + share * (shadows.slices.at[slice + 1] - shadows.slices.at[slice]);
            const Real theta = 2 * std::atan(Real(tau)) + chart * half_turn, t = Real(random_between(0, 64)) / 64;
            const Place on = placed(s, contact, theta);
            const Real psi = (contact.branch + t) * half_turn / 2;
            const Point x = on.is_line ? Point{on.at.x + t * on.along.x, on.at.y + t * on.along.y}
                                       : Point{on.at.x + on.rho * std::cos(psi), on.at.y + on.rho * std::sin(psi)};
            for (std::size_t near = 0; near < pieces.size(); ++near) {
                std::vector<Point> robot, obstacle;
                for (Index v = A.piece[0]; v < A.piece[1]; ++v) {
                    const Real ax = Real(A.X[A.piece_vertex[v]]), ay = Real(A.Y[A.piece_vertex[v]]);
                    robot.push_back({x.x + std::cos(theta) * ax - std::sin(theta) * ay, x.y + std::sin(theta) * ax + std::cos(theta) * ay});
                }
                for (Index v = O.piece[pieces[near]]; v < O.piece[pieces[near] + 1]; ++v)
                    obstacle.push_back({Real(O.X[O.piece_vertex[v]]), Real(O.Y[O.piece_vertex[v]])});
                const Real rho = Real(A.radii[A.vertex_radius[A.piece_vertex[0]]].exact) +
                                 Real(O.radii[O.vertex_radius[O.piece_vertex[O.piece[pieces[near]]]]].exact);
                const auto part = shadows.part(0, near);
                const bool is_away = slice < part.first || part.last < slice;
                if (distance(robot, obstacle) < rho) {
                    ++covered;
                    if (!shadows.is_own(0, near)) CHECK(!is_away);
                    else CHECK(distance(robot, obstacle) > rho * (1 - 1e-9L) || !is_away);
                }
                rejected += is_away;
            }
        }
    }
    CHECK(covered > 10000 && rejected > 10000);
}

int main() {
    pillars_over_a_patch_are_not_rejected();
    return failures > 0;
}
