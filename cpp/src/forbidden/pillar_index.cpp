// Boxes around pieces, in a tree; theory, "The trimmed boundary".
#include "forbidden/pillar_index.hpp"

#include <algorithm>

namespace cfree {

PillarIndex::PillarIndex(const Scene& s)
    : scene(s), boxes(piece_boxes(s.obstacles)), tree(boxes), robot_diagonal(diagonal(s.robot)) {
    for (const Shape* shape : {&s.robot, &s.obstacles})  // twice, rounded up: of both pieces, or of both vertices
        if (s.is_round) robot_diagonal += (2 + 0x1p-20) * shape->largest_radius();
}

void PillarIndex::near(Index j, std::vector<Index>& out) const {
    const Box contact = edge_box(scene.obstacles, j);
    out.clear();
    tree.query(grown(contact, robot_diagonal), [&](Index k) { out.push_back(k); });
    const double x = contact.x0 + contact.x1, y = contact.y0 + contact.y1;
    const auto distance = [&](Index k) {
        const double dx = boxes[k].x0 + boxes[k].x1 - x, dy = boxes[k].y0 + boxes[k].y1 - y;
        return dx * dx + dy * dy;
    };
    // equal distances: by the places of their vertices, not by the order of input
    const Shape& O = scene.obstacles;
    const auto is_lower = [&](Index p, Index q) {
        const auto begin = O.piece_vertex.begin();
        return std::lexicographical_compare(
            begin + O.piece[p], begin + O.piece[p + 1], begin + O.piece[q], begin + O.piece[q + 1],
            [&](Index v, Index w) { return O.x[v] != O.x[w] ? O.x[v] < O.x[w] : O.y[v] < O.y[w]; });
    };
    std::sort(out.begin(), out.end(), [&](Index p, Index q) {
        const double dp = distance(p), dq = distance(q);
        if (dp != dq) return dp < dq;
        return is_lower(p, q) || (p < q && !is_lower(q, p));
    });
}

}  // namespace cfree
