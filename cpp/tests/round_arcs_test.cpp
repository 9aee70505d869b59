// Boundaries of shapes with convex and with concave arcs: closed surfaces, and cells against exact tests of poses.
#include <cmath>

#include "cfree/arcs/pose_checker.hpp"
#include "cfree/forbidden/boundary.hpp"
#include "cfree/forbidden/cell_complex.hpp"
#include "cfree/free/free_space.hpp"
#include "rounded.hpp"

namespace {

// A corner, and the centre of the arc from it to the next one, if that is no line; and the points beyond it if it is concave.
struct Corner {
    long x, y;
    std::optional<std::pair<long, long>> centre = {};
    std::optional<std::array<std::pair<long, long>, 2>> beyond = {};
};
struct Part {
    std::vector<Corner> ring;
    Ratio grown = {0, 1};
};

long root(long square) { return std::lround(std::sqrt(static_cast<double>(square))); }

Part moved(Part part, long dx, long dy, long factor = 1) {
    for (Corner& c : part.ring) {
        c.x = factor * c.x + dx, c.y = factor * c.y + dy;
        if (c.centre) c.centre = {factor * c.centre->first + dx, factor * c.centre->second + dy};
        if (c.beyond)
            for (auto& [x, y] : *c.beyond) x = factor * x + dx, y = factor * y + dy;
    }
    return part;
}

Rounding rounding(const Part& part) {
    Rounding result{part.grown, {}};
    for (std::size_t k = 0; k < part.ring.size(); ++k) {
        const Corner &from = part.ring[k], &to = part.ring[(k + 1) % part.ring.size()];
        if (!from.centre) continue;
        const auto [x, y] = *from.centre;
        const long radius = root((from.x - x) * (from.x - x) + (from.y - y) * (from.y - y));
        result.arcs.push_back({{{from.x, 1}, {from.y, 1}}, {{to.x, 1}, {to.y, 1}}, {{x, 1}, {y, 1}}, {radius, 1}});
        if (!from.beyond) continue;
        const auto point = [](const std::pair<long, long>& p) { return RatioPoint{{p.first, 1}, {p.second, 1}}; };
        result.arcs.back().beyond = {point((*from.beyond)[0]), point((*from.beyond)[1])};
    }
    return result;
}
Polygon chords(const Part& part) {
    std::vector<std::pair<long, long>> points;
    for (const Corner& c : part.ring) {
        points.push_back({c.x, c.y});
        if (c.beyond) points.push_back((*c.beyond)[0]);
    }
    return polygon(points);
}
ArcShape arc_shape_of(const Part& part) {
    std::vector<RoundEdge> ring;
    const Int scale = part.grown.d;
    for (std::size_t k = 0; k < part.ring.size(); ++k) {
        const Corner &from = part.ring[k], &to = part.ring[(k + 1) % part.ring.size()];
        RoundEdge edge{{from.x * scale, from.y * scale}, {to.x * scale, to.y * scale}, {0, 0}, 0};
        if (from.centre) edge.center = {from.centre->first * scale, from.centre->second * scale}, edge.turn = from.beyond ? -1 : 1;
        ring.push_back(edge);
    }
    return arc_shape({ring}, part.grown.n, scale, false);
}

struct ByHand {
    std::string name;
    std::vector<Part> robot, obstacles;
    int euler = 0, components = 1;
};

// Sampled poses that the cells have on the wrong side.
int wrong_cells(const ByHand& scene, const SharedBoundary& b, const CellComplex& cells) {
    auto exact = std::make_shared<ArcScene>();
    for (const Part& p : scene.robot) exact->robot.push_back(arc_shape_of(p));
    for (const Part& p : scene.obstacles) exact->obstacles.push_back(arc_shape_of(p));
    const ArcPoseChecker checker(exact);
    const auto space = FreeSpace::of(cells);
    const Scene& s = *b->scene;
    std::mt19937 random(7);
    const auto between = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
    double reach = 0;
    for (const Shape* shape : {&s.robot, &s.obstacles})
        for (std::size_t k = 0; k < shape->xy.size(); ++k) reach = std::max(reach, std::abs(shape->xy[k]));
    int wrong = 0;
    for (int n = 0; n < 400; ++n) {
        const double x = between(-1.6 * reach, 1.6 * reach), y = between(-1.6 * reach, 1.6 * reach), tau = between(-1, 1);
        const int chart = n % 2;
        double theta = 2 * std::atan(tau) + chart * std::acos(-1.0);
        if (theta < 0) theta += 2 * std::acos(-1.0);
        const Verdict verdict = checker.look(x, y, theta);
        if (verdict == Verdict::uncertain) continue;
        const Index cell = space->locate(ExactPose::from(x, y, chart, tau, s.scale));
        if ((cell >= 0) == (verdict == Verdict::free)) continue;
        ++wrong;
        if (wrong < 4) std::printf("  pose %.17g %.17g %.17g chart %d: %s, cell %d\n", x, y, tau, chart, verdict == Verdict::free ? "free" : "forbidden", cell);
    }
    return wrong;
}

bool check(const ByHand& scene) {
    SceneShapes shapes;
    for (const Part& p : scene.robot) shapes.robot.push_back(shared(chords(p))), shapes.robot_rounding.push_back(rounding(p));
    for (const Part& p : scene.obstacles) shapes.obstacles.push_back(shared(chords(p))), shapes.obstacle_rounding.push_back(rounding(p));
    try {
        const SceneFeatures made = scene_features(shapes);
        const SharedBoundary b = compute_boundary(made.scene);
        const auto cells = glue(b, 1);
        const int euler = cells->vertices - static_cast<int>(cells->twin.size() / 2) + static_cast<int>(b->trapezoids.size());
        const int wrong = wrong_cells(scene, b, *cells);
        const bool is_good = euler == scene.euler && cells->components == scene.components && wrong == 0;
        std::printf("%s: %zu trapezoids, Euler number %d (%d), surfaces %d (%d), %d wrong\n", scene.name.c_str(), b->trapezoids.size(), euler, scene.euler,
                    cells->components, scene.components, wrong);
        std::fflush(stdout);
        return is_good;
    } catch (const std::exception& error) {
        std::printf("%s: %s\n", scene.name.c_str(), error.what());
        std::fflush(stdout);
        return false;
    }
}

std::pair<long, long> at(long x, long y) { return {x, y}; }

// A corner from which a concave quarter circle leads to another place; its tangents meet in a third one.
Corner concave(long x, long y, std::pair<long, long> centre, std::pair<long, long> to) {
    const auto beyond = [&](long share) {
        return std::pair{x + to.first - centre.first + (x + to.first - 2 * centre.first) / (2 * share),
                         y + to.second - centre.second + (y + to.second - 2 * centre.second) / (2 * share)};
    };
    return {x, y, centre, std::array{beyond(8), beyond(4)}};
}

}  // namespace

int main(int argc, char** argv) {
    const Part half{{{5, 0, at(0, 0)}, {0, 5, at(0, 0)}, {-5, 0}}};
    const Part dome{{{4, 3, at(0, 0)}, {0, 5, at(0, 0)}, {-4, 3}}};
    const Part sector{{{0, 0}, {5, 0, at(0, 0)}, {3, 4}}};
    const Part lens{{{0, -4, at(-3, 0)}, {2, 0, at(-3, 0)}, {0, 4, at(3, 0)}, {-2, 0, at(3, 0)}}};
    const Part corners{{{2, 0}, {9, 0, at(9, 1)}, {10, 1}, {10, 5, at(7, 5)}, {7, 8}, {0, 8}, {0, 2, at(2, 2)}}};
    const Part hat{{{-6, -3}, {6, -3}, {6, 0}, {5, 0, at(0, 0)}, {0, 5, at(0, 0)}, {-5, 0}, {-6, 0}}};
    const Part triangle{{{0, 0}, {3, 1}, {1, 2}}}, square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}, bar{{{-3, -1}, {3, -1}, {3, 1}, {-3, 1}}};
    const Part bay{{{-80, -80}, {80, -80}, {80, 48}, concave(48, 48, at(0, 48), at(0, 0)), concave(0, 0, at(0, 48), at(-48, 48)), {-48, 48}, {-80, 48}}};
    const Part bracket{{{0, 0}, {144, 0}, {144, 32}, concave(80, 32, at(80, 80), at(32, 80)), {32, 80}, {32, 144}, {0, 144}}};
    const auto large = [](const Part& p) { return moved(p, 0, 0, 16); };
    const auto grown = [](Part p, long n, long d) {
        p.grown = {n, d};
        return p;
    };
    const std::vector<ByHand> scenes{
        {"point-like square, half", {square}, {half}},
        {"grown square, half", {grown(square, 1, 2)}, {half}},
        {"half, square", {half}, {square}},
        {"sector, grown triangle", {sector}, {grown(triangle, 1, 3)}},
        {"lens, lens", {lens}, {lens}},
        {"corners, triangle", {corners}, {triangle}},
        {"triangle, corners", {triangle}, {corners}},
        {"hat, square", {hat}, {square}},
        {"square, hat", {square}, {hat}},
        {"dome, grown hat", {dome}, {grown(hat, 1, 4)}},
        {"hat, hat", {hat}, {hat}},
        {"square, bay", {large(square)}, {bay}},
        {"grown triangle, bay", {grown(large(triangle), 4, 1)}, {bay}},
        {"wide square, bay", {grown(large(square), 48, 1)}, {bay}},
        {"square, bracket", {large(square)}, {bracket}},
        {"bracket, grown square", {bracket}, {grown(large(square), 8, 1)}},
        {"bay, bracket", {bay}, {bracket}},
        {"bay, grown bracket", {bay}, {grown(bracket, 16, 1)}},
        {"half, bay", {large(half)}, {bay}},
        {"narrow half, bay", {moved(half, 0, 0, 4)}, {bay}},
        {"lens, bay", {moved(lens, 0, 0, 8)}, {bay}},
        {"dome, bracket", {moved(dome, 0, 0, 4)}, {bracket}},
        {"grown sector, bay", {grown(moved(sector, 0, 0, 4), 8, 1)}, {bay}},
        {"bay, half", {bay}, {moved(half, 0, 0, 6)}},
        {"bracket, grown hat", {bracket}, {grown(moved(hat, 0, 0, 3), 4, 1)}},
        {"bay with a bump", {moved(corners, 0, 0, 4)}, {grown(bay, 4, 1)}},
        {"two parts", {grown(square, 1, 2), moved(sector, 1, 0)}, {half, moved(triangle, 4, -4)}, 4, 3},
    };
    int good = 0, count = 0;
    for (const ByHand& s : scenes) {
        if (argc > 1 && s.name != argv[1]) continue;
        good += check(s), ++count;
    }
    std::printf("%d of %d\n", good, count);
    CHECK(good == count);
    return failures > 0;
}
