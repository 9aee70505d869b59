// Tree of boxes, for finding near items. Callers round boxes outwards; they decide nothing.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cfree/exact/number.hpp"

namespace cfree {

struct Box {
    double x0 = std::numeric_limits<double>::infinity(), y0 = x0, x1 = -x0, y1 = -x0;
    void add(double x, double y) {
        x0 = std::min(x0, x), y0 = std::min(y0, y), x1 = std::max(x1, x), y1 = std::max(y1, y);
    }
    void add(const Box& b) { add(b.x0, b.y0), add(b.x1, b.y1); }
    bool meets(const Box& b) const { return x0 <= b.x1 && b.x0 <= x1 && y0 <= b.y1 && b.y0 <= y1; }
};

// Box grown by a length, and by the rounding of its coordinates.
inline Box grown(const Box& b, double by = 0) {
    const double size = std::max({std::abs(b.x0), std::abs(b.x1), std::abs(b.y0), std::abs(b.y1)});
    const double d = by + (size + by) * 0x1p-40;
    return {b.x0 - d, b.y0 - d, b.x1 + d, b.y1 + d};
}

// A tree of boxes over items, halved at the median of the longer side.
class BoxTree {
public:
    explicit BoxTree(std::vector<Box> item_boxes) : boxes(std::move(item_boxes)), order(boxes.size()) {
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Index>(k);
        if (!order.empty()) build(0, static_cast<Index>(order.size()));
    }
    template <class F>
    void query(const Box& q, F&& report) const {
        if (!nodes.empty()) visit(0, q, report);
    }

private:
    struct Node {
        Box box;
        Index begin, end, right;  // right = -1: a leaf
    };
    Index build(Index begin, Index end) {
        const auto id = static_cast<Index>(nodes.size());
        nodes.push_back({{}, begin, end, -1});
        Box box;
        for (Index k = begin; k < end; ++k) box.add(boxes[order[k]]);
        nodes[id].box = box;
        if (end - begin > 4) {
            const bool by_x = box.x1 - box.x0 > box.y1 - box.y0;
            const Index mid = (begin + end) / 2;
            std::nth_element(order.begin() + begin, order.begin() + mid, order.begin() + end, [&](Index p, Index q) {
                const double cp = by_x ? boxes[p].x0 + boxes[p].x1 : boxes[p].y0 + boxes[p].y1;
                const double cq = by_x ? boxes[q].x0 + boxes[q].x1 : boxes[q].y0 + boxes[q].y1;
                return cp < cq || (cp == cq && p < q);
            });
            build(begin, mid);
            const Index right = build(mid, end);
            nodes[id].right = right;
        }
        return id;
    }
    template <class F>
    void visit(Index id, const Box& q, F& report) const {
        const Node& node = nodes[id];
        if (!node.box.meets(q)) return;
        if (node.right < 0) {
            for (Index k = node.begin; k < node.end; ++k)
                if (boxes[order[k]].meets(q)) report(order[k]);
            return;
        }
        visit(id + 1, q, report);
        visit(node.right, q, report);
    }
    std::vector<Box> boxes;
    std::vector<Index> order;
    std::vector<Node> nodes;
};

}  // namespace cfree
