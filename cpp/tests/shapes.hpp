// Scenes of convex polygons with small integer coordinates; identities found by comparing all with all.
#pragma once
#include <memory>
#include <numeric>
#include <vector>

#include "cfree/scene/scene.hpp"

using Ring = std::vector<std::pair<long, long>>;  // convex, counter-clockwise

inline cfree::Shape shape_of(const std::vector<Ring>& rings) {
    cfree::Shape s;
    std::vector<cfree::Int> x, y;
    s.piece.push_back(0);
    for (const Ring& ring : rings) {
        const auto first = static_cast<cfree::Index>(x.size()), n = static_cast<cfree::Index>(ring.size());
        for (cfree::Index k = 0; k < n; ++k) {
            x.push_back(ring[k].first), y.push_back(ring[k].second);
            s.v.push_back(first + k), s.w.push_back(first + (k + 1) % n), s.previous.push_back(first + (k + n - 1) % n);
            s.convex.push_back(1), s.emit.push_back(1), s.layer.push_back(0);
            s.piece_vertex.push_back(first + k), s.piece_edge.push_back(first + k);
        }
        s.piece.push_back(first + n), s.piece_layer.push_back(0);
    }
    s.set_coordinates(x, y);
    s.ring_vertices = static_cast<cfree::Index>(x.size());
    const auto classes = [&](auto same) {
        std::vector<cfree::Index> result;
        for (cfree::Index k = 0; k < s.ring_vertices; ++k) {
            cfree::Index first = 0;
            while (!same(first, k)) ++first;
            result.push_back(first);
        }
        return result;
    };
    s.point = classes([&](cfree::Index p, cfree::Index q) { return x[p] == x[q] && y[p] == y[q]; });
    s.direction = classes([&](cfree::Index e, cfree::Index f) {
        return cross(cfree::edge<cfree::Int>(s, e), cfree::edge<cfree::Int>(s, f)).is_zero();
    });
    s.line = classes([&](cfree::Index e, cfree::Index f) {
        const auto E = cfree::edge<cfree::Int>(s, e), F = cfree::edge<cfree::Int>(s, f);
        return cross(E, F).is_zero() && dot(E, F).sign() > 0 &&
               cross(E, cfree::difference<cfree::Int>(s, f, e)).is_zero();
    });
    s.vertex_rank.resize(x.size());
    std::iota(s.vertex_rank.begin(), s.vertex_rank.end(), 0);
    s.edge_rank = s.vertex_rank;
    return s;
}

inline std::shared_ptr<const cfree::Scene> scene_of(const std::vector<Ring>& robot, const std::vector<Ring>& obstacles) {
    return std::make_shared<const cfree::Scene>(cfree::Scene{shape_of(robot), shape_of(obstacles)});
}
