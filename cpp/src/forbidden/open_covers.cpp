// Pillars that are open, by signs of a place: nothing is computed but whether it is inside.
#include "forbidden/open_covers.hpp"

#include <algorithm>

#include "forbidden/near_fillets.hpp"

namespace cfree {

namespace {

// Pillar of two convex pieces.
class OpenPillar {
public:
    OpenPillar(const Scene& s, Index p, Index k)
        : scene(s), a(&s.robot.piece_vertex[s.robot.piece[p]]), b(&s.obstacles.piece_vertex[s.obstacles.piece[k]]),
          n(s.robot.piece[p + 1] - s.robot.piece[p]), m(s.obstacles.piece[k + 1] - s.obstacles.piece[k]),
          g(n > 1 ? &s.robot.piece_edge[s.robot.piece[p]] : nullptr), f(m > 1 ? &s.obstacles.piece_edge[s.obstacles.piece[k]] : nullptr) {}

    bool is_empty() const { return n == 1 && m == 1 && !has_disc(0, 0); }
    std::vector<Feature> surfaces() const {
        std::vector<Feature> result;
        for (Index x = 0; x < n; ++x)
            for (Index y = 0; y < m; ++y) {
                if (m > 1) result.push_back(on_edge(x, y));
                if (n > 1) result.push_back(of_edge(x, y));
                if (has_disc(x, y)) result.push_back(circle(x, y));
            }
        return result;
    }
    // A place is outside if it is beyond an edge, or from an arc in a direction of both cones and beyond its circle.
    bool has(RoundJunction& at, const RoundSpot& place) const {
        for (Index x = 0; x < n; ++x)
            for (Index y = 0; y < m; ++y) {
                const auto is_beyond = [&](const Feature& surface) { return at.outside(surface, place) >= 0; };
                const auto is_ahead = [&](const Feature& before, const Feature& after) {
                    return at.ahead(before, circle(x, y), place) >= 0 && at.ahead(after, circle(x, y), place) <= 0;
                };
                const auto turns_over = [&](const Feature& before, const Feature& after, const Feature& line) {
                    return at.turn(before, line) >= 0 && at.turn(after, line) <= 0;
                };
                if (m > 1 && is_beyond(on_edge(x, y)) && (n == 1 || turns_over(of_edge(last(x, n), y), of_edge(x, y), on_edge(x, y)))) return false;
                if (n > 1 && is_beyond(of_edge(x, y)) && (m == 1 || turns_over(on_edge(x, last(y, m)), on_edge(x, y), of_edge(x, y)))) return false;
                if (has_disc(x, y) && is_beyond(circle(x, y)) && (m == 1 || is_ahead(on_edge(x, last(y, m)), on_edge(x, y))) &&
                    (n == 1 || is_ahead(of_edge(last(x, n), y), of_edge(x, y))))
                    return false;
            }
        return true;
    }

private:
    static Index last(Index x, Index count) { return (x + count - 1) % count; }
    bool has_disc(Index x, Index y) const {
        return (scene.robot.radius_of(a[x]).exact + scene.obstacles.radius_of(b[y]).exact).sign() > 0;
    }
    Feature circle(Index x, Index y) const { return {Kind::vertex_vertex, a[x], b[y], 1}; }
    Feature on_edge(Index x, Index y) const { return {Kind::vertex_edge, a[x], f[y]}; }
    Feature of_edge(Index x, Index y) const { return {Kind::edge_vertex, g[x], b[y]}; }

    const Scene& scene;
    const Index *a, *b;
    Index n, m;
    const Index *g, *f;
};

}  // namespace

std::vector<OpenCover> OpenCovers::near(const Feature& pair) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    std::vector<OpenCover> result;
    std::vector<Index> pieces;
    index.near(pair.obstacle, pieces);
    for (const Index k : pieces)
        for (Index p = 0; p < A.pieces(); ++p) {
            const Index *a = &A.piece_vertex[A.piece[p]], *b = &O.piece_vertex[O.piece[k]];
            if (A.piece_layer[p] != O.piece_layer[k] || !is_near(pair, a, A.piece[p + 1] - A.piece[p], b, O.piece[k + 1] - O.piece[k])) continue;
            const OpenPillar pillar(scene, p, k);
            if (!pillar.is_empty()) result.push_back({pillar.surfaces(), [pillar](RoundJunction& at, const RoundSpot& place) { return pillar.has(at, place); }});
        }
    for (const auto& [fillet, of_robot, v, directions] : fillets_near(scene, pair, index.reach())) {
        const Index* corners = fillet->vertex.data();
        if (!(of_robot ? is_near(pair, corners, 4, &v, 1) : is_near(pair, &v, 1, corners, 4))) continue;
        OpenCover cover;
        for (const Index edge : fillet->edge) cover.surfaces.push_back(contact_line_of(of_robot, edge, v));
        for (std::size_t k = 0; directions && k < directions->edge.size(); ++k)
            cover.surfaces.push_back(contact_line_of(!of_robot, directions->edge[k], fillet->arc));
        cover.surfaces.push_back(contact_circle_of(of_robot, fillet->arc, v));
        // the open quadrangle outside of the circle, in the open triangle of directions
        cover.has = [all = cover.surfaces](RoundJunction& at, const RoundSpot& place) {
            return std::all_of(all.begin(), all.end(), [&](const Feature& x) { return at.outside(x, place) * (is_line(x) ? -1 : 1) > 0; });
        };
        result.push_back(std::move(cover));
    }
    return result;
}

// False if vertices of the two shapes are certainly too far away at every angle.
bool OpenCovers::is_near(const Feature& pair, const Index* a, Index n, const Index* b, Index m) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const double ax = A.x[pair.robot], ay = A.y[pair.robot], bx = O.x[pair.obstacle], by = O.y[pair.obstacle];
    double reach = 0, own = 0, other = 0, size = std::abs(ax) + std::abs(ay) + std::abs(bx) + std::abs(by);
    Box box;
    for (Index x = 0; x < n; ++x) {
        reach = std::max(reach, length_of(A.x[a[x]] - ax, A.y[a[x]] - ay)), own = std::max(own, std::abs(A.radius_of(a[x]).about.hi));
        size = std::max(size, std::abs(A.x[a[x]]) + std::abs(A.y[a[x]]));
    }
    for (Index y = 0; y < m; ++y) {
        box.add(O.x[b[y]], O.y[b[y]]), other = std::max(other, std::abs(O.radius_of(b[y]).about.hi));
        size = std::max(size, std::abs(O.x[b[y]]) + std::abs(O.y[b[y]]));
    }
    const double dx = std::max({box.x0 - bx, bx - box.x1, 0.0}), dy = std::max({box.y0 - by, by - box.y1, 0.0});
    const double apart = std::abs(A.radius_of(pair.robot).about.hi) + std::abs(O.radius_of(pair.obstacle).about.hi);
    return length_of(dx, dy) <= (reach + own + other + apart) * (1 + 0x1p-40) + size * 0x1p-40;
}

}  // namespace cfree
