// Boxes around pieces, in a tree; theory, "The trimmed boundary".
#include "forbidden/pillar_index.hpp"

namespace cfree {

PillarIndex::PillarIndex(const Scene& s)
    : scene(s), boxes(piece_boxes(s.obstacles)), tree(boxes), robot_diagonal(diagonal(s.robot)) {}

void PillarIndex::near(Index j, std::vector<Index>& out) const {
    const Box contact = edge_box(scene.obstacles, j);
    out.clear();
    tree.query(grown(contact, robot_diagonal), [&](Index k) { out.push_back(k); });
    const double x = contact.x0 + contact.x1, y = contact.y0 + contact.y1;
    const auto distance = [&](Index k) {
        const double dx = boxes[k].x0 + boxes[k].x1 - x, dy = boxes[k].y0 + boxes[k].y1 - y;
        return dx * dx + dy * dy;
    };
    std::sort(out.begin(), out.end(), [&](Index p, Index q) {
        const double dp = distance(p), dq = distance(q);
        return dp < dq || (dp == dq && p < q);
    });
}

}  // namespace cfree
