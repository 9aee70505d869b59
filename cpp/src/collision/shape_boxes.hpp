// Boxes of a shape's parts, in its doubles: the parts may exceed them by the rounding of these.
#pragma once
#include <cmath>

#include "cfree/scene/features.hpp"
#include "cfree/support/elementary.hpp"
#include "collision/box_tree.hpp"

namespace cfree {

inline Box edge_box(const Shape& s, Index e) {  // of an edge of a ring, and of the vertex where it starts
    Box box;
    if (s.has_arcs()) box.add(s.x[e], s.y[e]);
    box.add(s.x[s.v[e]], s.y[s.v[e]]), box.add(s.x[s.w[e]], s.y[s.w[e]]);
    return box;
}

// Boxes of the edges of its rings.
inline std::vector<Box> edge_boxes(const Shape& s) {
    std::vector<Box> boxes;
    for (Index e = 0; e < s.ring_vertices; ++e) boxes.push_back(edge_box(s, e));
    return boxes;
}

// Boxes of its convex pieces, rounded outwards.
inline std::vector<Box> piece_boxes(const Shape& s) {
    std::vector<Box> boxes;
    for (Index k = 0; k < s.pieces(); ++k) {
        Box box;
        for (Index v = s.piece[k]; v < s.piece[k + 1]; ++v) box.add(s.x[s.piece_vertex[v]], s.y[s.piece_vertex[v]]);
        boxes.push_back(grown(box));
    }
    return boxes;
}

// Reach of a shape about its reference point.
inline double reach_of(const Shape& s) {
    double most = 0;
    for (std::size_t v = 0; v < s.x.size(); ++v) most = std::max(most, norm(s.x[v], s.y[v]));
    return most;
}

// Upper bound of the distance of two of its points.
inline double diagonal(const Shape& s) {
    Box box;
    for (std::size_t v = 0; v < s.x.size(); ++v) box.add(s.x[v], s.y[v]);
    return norm(box.x1 - box.x0, box.y1 - box.y0);
}

}  // namespace cfree
