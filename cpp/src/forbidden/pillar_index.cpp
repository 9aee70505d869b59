// Boxes around what a pillar and a patch sweep; theory, "The trimmed boundary".
#include "forbidden/pillar_index.hpp"

#include <array>
#include <cmath>

namespace cfree {

namespace {

Box grown(const Box& b, double by) {
    const double size = std::max({std::abs(b.x0), std::abs(b.x1), std::abs(b.y0), std::abs(b.y1)});
    const double d = by + (size + by) * 0x1p-40;
    return {b.x0 - d, b.y0 - d, b.x1 + d, b.y1 + d};
}

std::vector<Box> piece_boxes(const Shape& s) {
    std::vector<Box> result(s.pieces());
    for (Index k = 0; k < s.pieces(); ++k) {
        Box box;
        for (Index v = s.piece[k]; v < s.piece[k + 1]; ++v) box.add(s.x[s.piece_vertex[v]], s.y[s.piece_vertex[v]]);
        result[k] = grown(box, 0);
    }
    return result;
}

}  // namespace

PillarIndex::PillarIndex(const Scene& s) : scene(s), boxes(piece_boxes(s.obstacles)), tree(boxes) {
    Box robot;
    for (std::size_t v = 0; v < s.robot.x.size(); ++v) robot.add(s.robot.x[v], s.robot.y[v]);
    reach = std::hypot(robot.x1 - robot.x0, robot.y1 - robot.y0);
}

void PillarIndex::near(Index j, std::vector<Index>& out) const {
    const Shape& O = scene.obstacles;
    Box contact;
    contact.add(O.x[O.v[j]], O.y[O.v[j]]), contact.add(O.x[O.w[j]], O.y[O.w[j]]);
    out.clear();
    tree.query(grown(contact, reach), [&](Index k) { out.push_back(k); });
    const double x = contact.x0 + contact.x1, y = contact.y0 + contact.y1;
    const auto distance = [&](Index k) {
        return std::hypot(boxes[k].x0 + boxes[k].x1 - x, boxes[k].y0 + boxes[k].y1 - y);
    };
    std::sort(out.begin(), out.end(), [&](Index p, Index q) {
        const double dp = distance(p), dq = distance(q);
        return dp < dq || (dp == dq && p < q);
    });
}

Box PillarIndex::swept(const Feature& contact, Index p, int chart, double lo, double hi) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Feature ends[2] = {end_helix(scene, contact, 0), end_helix(scene, contact, 1)};
    const int different = ends[0].robot == ends[1].robot ? 1 : 2;
    // every arc lies in the polygon of its end points and the tangents' meeting points
    std::array<Vec<double>, 17> turn;
    int turns = 0;
    const double from = 2 * std::atan(lo), width = 2 * std::atan(hi) - from;
    const int arcs = 1 + static_cast<int>(width / 0.5);
    const double half = 0.5 * width / arcs, out = 1 / std::cos(half), sign = chart ? -1 : 1;
    for (int k = 0; k <= 2 * arcs; ++k) {
        const double angle = from + k * half, r = sign * (k % 2 ? out : 1);
        turn[turns++] = {r * std::cos(angle), r * std::sin(angle)};
    }
    Box box;
    for (Index k = A.piece[p]; k < A.piece[p + 1]; ++k)
        for (int e = 0; e < different; ++e) {
            const Index a = ends[e].robot;
            const double dx = A.x[A.piece_vertex[k]] - A.x[a], dy = A.y[A.piece_vertex[k]] - A.y[a];
            for (int t = 0; t < turns; ++t) box.add(turn[t].x * dx - turn[t].y * dy, turn[t].y * dx + turn[t].x * dy);
        }
    Box touched;
    for (const Feature& end : ends) touched.add(O.x[end.obstacle], O.y[end.obstacle]);
    return grown({box.x0 + touched.x0, box.y0 + touched.y0, box.x1 + touched.x1, box.y1 + touched.y1}, 0);
}

}  // namespace cfree
