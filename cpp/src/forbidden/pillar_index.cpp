// Boxes around pieces, in a tree; theory, "The trimmed boundary".
#include "forbidden/pillar_index.hpp"

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
    diagonal = std::hypot(robot.x1 - robot.x0, robot.y1 - robot.y0);
}

void PillarIndex::near(Index j, std::vector<Index>& out) const {
    const Shape& O = scene.obstacles;
    Box contact;
    contact.add(O.x[O.v[j]], O.y[O.v[j]]), contact.add(O.x[O.w[j]], O.y[O.w[j]]);
    out.clear();
    tree.query(grown(contact, diagonal), [&](Index k) { out.push_back(k); });
    const double x = contact.x0 + contact.x1, y = contact.y0 + contact.y1;
    const auto distance = [&](Index k) {
        return std::hypot(boxes[k].x0 + boxes[k].x1 - x, boxes[k].y0 + boxes[k].y1 - y);
    };
    std::sort(out.begin(), out.end(), [&](Index p, Index q) {
        const double dp = distance(p), dq = distance(q);
        return dp < dq || (dp == dq && p < q);
    });
}

}  // namespace cfree
