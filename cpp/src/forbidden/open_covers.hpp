// What may cover a place among grown shapes: pillars of two convex pieces, and fillets with a vertex, all of them open sets.
#pragma once
#include <cmath>
#include <functional>
#include <vector>

#include "forbidden/pillar_index.hpp"
#include "predicates/round_junction.hpp"

namespace cfree {

// By the correctly rounded square root, the same on every machine.
inline double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

inline Feature on_branch(Feature f, int branch) {
    f.branch = static_cast<std::int8_t>(branch);
    return f;
}
inline Feature contact_line_of(bool of_robot, Index edge, Index vertex) {
    return of_robot ? Feature{Kind::edge_vertex, edge, vertex} : Feature{Kind::vertex_edge, vertex, edge};
}
inline Feature contact_circle_of(bool of_robot, Index own, Index other) {
    return of_robot ? Feature{Kind::vertex_vertex, own, other, 1} : Feature{Kind::vertex_vertex, other, own, 1};
}

// Something that covers places: its surfaces, and whether a place is in its open inside.
struct OpenCover {
    std::vector<Feature> surfaces;
    std::function<bool(RoundJunction&, const RoundSpot&)> has;
};

// All that may cover the places at which the vertices of a pair are as far apart as the sum of their radii, or less.
class OpenCovers {
public:
    explicit OpenCovers(const Scene& s) : scene(s), index(s) {}

    double reach() const { return index.reach(); }
    std::vector<OpenCover> near(const Feature& pair) const;

private:
    bool is_near(const Feature& pair, const Index* a, Index n, const Index* b, Index m) const;
    const Scene& scene;
    const PillarIndex index;
};

}  // namespace cfree
