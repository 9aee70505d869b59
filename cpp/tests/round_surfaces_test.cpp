// Closed surfaces of grown shapes: Euler numbers and numbers of surfaces of scenes made by hand, most of them with ties.
#include <complex>

#include "cfree/forbidden/boundary.hpp"
#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/free/free_space.hpp"
#include "rounded.hpp"

namespace {

using Corners = std::vector<std::complex<double>>;
constexpr double scale = 1200;
constexpr std::complex<double> i(0, 1);

struct Grown {
    Corners points;
    double radius;
};
struct ByHand {
    std::string name;
    std::vector<Grown> robot, obstacles;
    int euler, components;
};

long scaled(double x) { return std::lround(scale * x); }
Polygon polygon_of(const Corners& points) {
    std::vector<std::pair<long, long>> whole;
    for (const auto& p : points) whole.push_back({scaled(p.real()), scaled(p.imag())});
    return polygon(whole);
}
Corners moved(Corners points, std::complex<double> by, double factor = 1) {
    for (auto& p : points) p = factor * p + by;
    return points;
}
Corners rect(double w, double h) { return {{-w, -h}, {w, -h}, {w, h}, {-w, h}}; }
std::vector<Grown> frame(double a, double b, double s = 0) {
    std::vector<Grown> parts;
    const Corners in = rect(a, a), out = rect(b, b);
    for (std::size_t k = 0; k < 4; ++k) parts.push_back({{out[k], out[(k + 1) % 4], in[(k + 1) % 4], in[k]}, s});
    return parts;
}
std::vector<Grown> operator+(std::vector<Grown> x, const std::vector<Grown>& y) {
    x.insert(x.end(), y.begin(), y.end());
    return x;
}
std::vector<Grown> points(const Corners& at, double s) {
    std::vector<Grown> result;
    for (const auto& p : at) result.push_back({{p}, s});
    return result;
}
const Corners U{0, 3, 3.0 + 2.0 * i, 2.0 + 2.0 * i, 2.0 + i, 1.0 + i, 1.0 + 2.0 * i, 2.0 * i};
const Corners square = rect(0.5, 0.5);

// Distance of two convex pieces, or minus 1 if their interiors overlap.
Real distance(const std::vector<Point>& P, const std::vector<Point>& Q) {
    const auto outside = [](const std::vector<Point>& A, const std::vector<Point>& B) {  // an edge of A has B on its right
        for (std::size_t k = 0; A.size() > 1 && k < A.size(); ++k) {
            const Point &a = A[k], &b = A[(k + 1) % A.size()];
            bool all = true;
            for (const Point& q : B) all = all && cross(b - a, q - a) <= 0;
            if (all) return true;
        }
        return false;
    };
    if ((P.size() > 2 || Q.size() > 2) && !(outside(P, Q) || outside(Q, P))) return -1;
    const auto to_segment = [](const Point& q, const Point& a, const Point& b) {
        const Point d = b - a;
        const Real whole = dot(d, d), t = whole > 0 ? std::min(Real(1), std::max(Real(0), dot(q - a, d) / whole)) : 0;
        const Point e = q - Point{a.x + t * d.x, a.y + t * d.y};
        return std::sqrt(dot(e, e));
    };
    Real least = 1e30L;
    for (const auto* pair : {&P, &Q}) {
        const auto &A = *pair, &B = pair == &P ? Q : P;
        for (std::size_t k = 0; k < A.size(); ++k)
            for (const Point& q : B) least = std::min(least, to_segment(q, A[k], A[(k + 1) % A.size()]));
    }
    if (P.size() == 2 && Q.size() == 2) {
        const auto side = [](const std::vector<Point>& A, const Point& q) { return cross(A[1] - A[0], q - A[0]); };
        if (side(P, Q[0]) * side(P, Q[1]) < 0 && side(Q, P[0]) * side(Q, P[1]) < 0) return 0;
    }
    return least;
}

// Room of a pose: the least distance less the radii, negative if it is forbidden.
Real room(const Scene& s, const Point& at, Real theta) {
    const Shape &A = s.robot, &O = s.obstacles;
    Real least = 1e30L;
    const auto corners = [](const Shape& shape, Index k) {
        std::vector<Point> result;
        for (Index v = shape.piece[k]; v < shape.piece[k + 1]; ++v) result.push_back({Real(shape.X[shape.piece_vertex[v]]), Real(shape.Y[shape.piece_vertex[v]])});
        return result;
    };
    for (Index p = 0; p < A.pieces(); ++p) {
        auto P = corners(A, p);
        for (Point& q : P) q = {at.x + std::cos(theta) * q.x - std::sin(theta) * q.y, at.y + std::sin(theta) * q.x + std::cos(theta) * q.y};
        for (Index k = 0; k < O.pieces(); ++k) {
            const Real rho = Real(A.radii[A.vertex_radius[A.piece_vertex[A.piece[p]]]].exact) + Real(O.radii[O.vertex_radius[O.piece_vertex[O.piece[k]]]].exact);
            const Real d = distance(P, corners(O, k));
            least = std::min(least, d < 0 ? -1 - rho : d - rho);
        }
    }
    return least;
}

// Number of sampled poses that the cells have on the wrong side.
int wrong_cells(const SharedBoundary& b, const CellComplex& cells) {
    int wrong = 0;
    const auto space = FreeSpace::of(cells);
    const Scene& s = *b->scene;
    std::mt19937 random(7);
    const auto between = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
    double reach = 0;
    for (const Shape* shape : {&s.robot, &s.obstacles})
        for (std::size_t k = 0; k < shape->x.size(); ++k) reach = std::max({reach, std::abs(shape->x[k]), std::abs(shape->y[k])});
    for (int n = 0; n < 300; ++n) {
        const double x = std::round(between(-2 * reach, 2 * reach)), y = std::round(between(-2 * reach, 2 * reach));
        const double tau = n % 3 == 0 ? std::round(between(-4, 4)) / 4 : between(-1, 1);
        const int chart = n % 2;
        const Real theta = 2 * std::atan(Real(tau)) + chart * std::acos(Real(-1)), least = room(s, {x, y}, theta);
        if (std::abs(least) < 1e-9L * reach) continue;
        const Index cell = space->locate(ExactPose::from(x, y, chart, tau, 1));
        if ((cell >= 0) != (least > 0)) {
            ++wrong;
            std::printf("  pose %g %g %g chart %d: room %Lg, cell %d\n", x, y, tau, chart, least, cell);
        }
    }
    return wrong;
}

bool check(const ByHand& expected) {
    std::vector<Polygon> obstacles;
    std::vector<Ratio> radii;
    for (const auto& [at, s] : expected.obstacles) obstacles.push_back(polygon_of(at)), radii.push_back({scaled(s), 1});
    const SceneFeatures made = scene_of(polygon_of(expected.robot[0].points), {scaled(expected.robot[0].radius), 1}, std::move(obstacles), std::move(radii));
    try {
        const SharedBoundary b = compute_boundary(made.scene);
        const auto cells = glue(b, 1);
        // a pinched edge has more than two half-edges: each pair of them counts
        const int euler = cells->vertices - static_cast<int>(cells->twin.size() / 2) + static_cast<int>(b->trapezoids.size());
        Task regular;
        regular.regularized = true;
        const SharedBoundary bounding = may_have_slits(*made.scene) ? compute_boundary(made.scene, regular) : b;
        const int wrong = wrong_cells(bounding, bounding == b ? *cells : *glue(bounding, 1));
        const bool is_good = euler == expected.euler && cells->components == expected.components && wrong == 0;
        if (!is_good) std::printf("%s: Euler number %d (%d), surfaces %d (%d)\n", expected.name.c_str(), euler, expected.euler, cells->components, expected.components);
        return is_good;
    } catch (const std::exception& error) {
        std::printf("%s: %s\n", expected.name.c_str(), error.what());
        return false;
    }
}

}  // namespace

int main() {
    const Corners corners{0, 1, i, 1.0 + i};
    const Corners U2 = moved(U, -1.5 - 1.0 * i), UC = moved(U, -1.5 - 1.5 * i);
    std::vector<Grown> lattice;
    for (const double a : {0.0, 1.6})
        for (const double b : {0.0, 1.6}) lattice.push_back({moved(square, {a, b}), 0});
    const std::vector<ByHand> scenes{
        {"A1", {{{-1, 1}, 0.25}}, points({0}, 0.25), 0, 1},
        {"A4", {{{0}, 0.25}}, {{U, 0}}, 0, 1},
        {"A5", {{{0}, 0.5}}, frame(1, 1.5), 0, 2},
        {"A9", {{moved(U, -0.75 - 0.5 * i, 0.5), 0.1}}, points({0}, 0.1), 0, 1},
        {"A10", {{U2, 0.1}}, points({0}, 0.45), 0, 1},
        {"A11", {{square, 0.1}}, points({1.0 + i, 1.0 - i, -1.0 + i, -1.0 - i}, 0.1), 0, 4},
        {"B1", {{{0}, 0.25}}, points(corners, 0.25), 0, 2},
        {"B2", {{{0}, 0.3}}, points(corners, 0.3), 0, 2},
        {"B3", {{{0}, 0}}, points({3, -3}, 5) + points({0}, 4), 0, 1},
        {"B3b", {{{1}, 1}}, points({3, -3}, 4) + points({0}, 3), 0, 1},
        {"B3c", {{{0}, 0}}, points({0}, 4) + points({3, -3}, 5), 0, 1},
        {"B5", {{square, 0.1}}, points({0, 1}, 0.1), 0, 1},
        {"B7", {{square, 0.1}}, {{square, 0}}, 0, 1},
        {"B11", {{{0}, 0.25}}, {{square, 0}, {moved(square, 1.5), 0}}, 4, 3},  // a slit in each chart, closed at its ends
        {"B12", {{{0}, 0.25}}, lattice, 0, 4},
        {"B14", {{{0, 4, 3.0 * i}, 0.1}}, points({0, 5.4}, 0.1), 0, 2},
        {"B15", {{{-1, 1}, 0.2}}, points({0, 0.8}, 0.2), 0, 1},
        {"B17", {{UC, 0.1}}, points({0}, 0.4), 4, 3},  // the same: the mouth is as wide as the disc
        {"B26", {{{0, 1}, 0.1}}, points({0, 1}, 0.1), -4, 1},
    };
    int good = 0;
    for (const ByHand& s : scenes) good += check(s);
    std::printf("%d of %zu\n", good, scenes.size());
    CHECK(good == static_cast<int>(scenes.size()));
    return failures > 0;
}
