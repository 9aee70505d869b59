// A* over the sides of faces: the rest of a path is at least as long as the straight way; theory, "Paths".
#include "cfree/planning/face_graph.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>
#include <unordered_map>

#include "cfree/contact/surface.hpp"
#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

constexpr double pi = std::numbers::pi;

// Offset of positions from those of the frame.
Vec<double> moved(const Scene& scene, double theta) {
    const auto [x, y, a, b] = scene.frame;
    if (x == 0 && y == 0 && a == 0 && b == 0) return {0, 0};
    const auto [c, s] = cosine_sine(theta);
    return {x - (c * a - s * b), y - (s * a + c * b)};
}

}  // namespace

Vec<double> position(const CellComplex& cells, Index v) {
    const Vec<double> by = moved(*cells.boundary->scene, cells.places().theta[v]);
    return {cells.places().xy[2 * v] + by.x, cells.places().xy[2 * v + 1] + by.y};
}

Place position_on(const Scene& scene, const Feature& contact, double t, double theta) {
    const ContactLine<double> l(scene.near(), contact, UserUnits{});
    const Vec<double> q = l.on_edge ? l.E : Vec<double>{0, 0}, g = l.on_edge ? Vec<double>{0, 0} : l.E;
    double at[2];
    evaluate_points({l.b.x, l.b.y, q.x, q.y, l.a.x, l.a.y, g.x, g.y}, &t, &theta, 1, at);
    const Vec<double> by = moved(scene, theta);
    return {at[0] + by.x, at[1] + by.y, theta};
}

FaceGraph::FaceGraph(std::shared_ptr<const CellComplex> of, double scale)
    : cells(std::move(of)), scene(*cells->boundary->scene), limits(*cells->boundary), angle_scale(scale) {}

void FaceGraph::middles(Index face, std::vector<Place>& found) const {
    const Trapezoids& table = cells->boundary->trapezoids;
    const int chart = table.chart[face];
    const double low = theta_of(chart, table.tau_from(face)), high = theta_of(chart, table.tau_to(face));
    const Feature contact = cells->boundary->patches.contact(table.patch[face]);
    const Index first = cells->first[face], end = cells->first[face + 1];
    for (Index h = first; h < end; ++h) {
        const Index ends[2] = {cells->vertex[h], cells->vertex[h + 1 == end ? first : h + 1]};
        const auto side = static_cast<Side>(cells->side[h]);
        Place& result = found.emplace_back(Place{0, 0, 0});
        if (side == Side::first || side == Side::last) {
            result.theta = side == Side::first ? low : high;
            for (const Index v : ends) {
                const Vec<double> at = position(*cells, v);
                result.x += at.x / 2, result.y += at.y / 2;
            }
            continue;
        }
        for (const Index v : ends) {
            const double theta = cells->places().theta[v];
            const double turned = theta + 2 * pi * std::nearbyint(((low + high) / 2 - theta) / (2 * pi));
            result.theta += std::min(std::max(turned, low), high) / 2;
        }
        const auto t = limits.of(face, tangent((result.theta - chart * pi) / 2));
        result = position_on(scene, contact, t[side == Side::upper], result.theta);
    }
}

double FaceGraph::apart(const Place& a, const Place& b) const {
    return norm(b.x - a.x, b.y - a.y) + angle_scale * std::abs(std::remainder(b.theta - a.theta, 2 * pi));
}

std::vector<FaceGraph::Step> FaceGraph::shortest(const Place& start, std::span<const Mark> starts, const Place& goal,
                                                 std::span<const Mark> goals, std::span<const Mark> links) const {
    const auto base = static_cast<Index>(cells->face.size()), last = static_cast<Index>(base + links.size());
    constexpr Index unseen = -2;
    struct Node {
        Place at;
        double left, cost = std::numeric_limits<double>::infinity();  // lower bound of the rest; least known cost
        Index before = unseen, face = far_away;                      // the half-edge before, and the face after it
    };
    // ends of links and of the way, then the sides of faces that have been entered, one after the other
    std::vector<Node> nodes;
    for (const Mark& end : links) nodes.push_back({end.at, apart(end.at, goal)});
    nodes.push_back({goal, 0});
    std::vector<Index> begin(cells->component.size(), -1);
    std::vector<Place> places;
    const auto enter = [&](Index face) {
        if (face == far_away || begin[face] >= 0) return;
        begin[face] = static_cast<Index>(nodes.size());
        places.clear();
        middles(face, places);
        for (const Place& at : places) nodes.push_back({at, apart(at, goal)});
    };
    const auto node = [&](Index h) -> Node& {
        return nodes[h < base ? begin[cells->face[h]] + (h - cells->first[cells->face[h]]) : h - base];
    };
    std::unordered_map<Index, std::vector<Index>> at_face;  // ends of links
    for (Index h = base; h < last; ++h) at_face[links[h - base].face].push_back(h);
    struct Entry {
        double whole, cost;
        Index by, before, face;
        bool operator>(const Entry& o) const {
            return std::tie(whole, cost, by, before, face) > std::tie(o.whole, o.cost, o.by, o.before, o.face);
        }
    };
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;

    const auto relax = [&](double cost, Index face, const Place& at, Index before) {
        const auto reach = [&](Index h, Node& to) {
            if (to.before != unseen) return;
            const double there = cost + apart(at, to.at);
            if (there > to.cost) return;
            to.cost = there;
            open.push({there + to.left, there, h, before, face});
        };
        enter(face);
        if (face != far_away)
            for (Index h = cells->first[face], k = begin[face]; h < cells->first[face + 1]; ++h, ++k) reach(h, nodes[k]);
        if (const auto ends = at_face.find(face); ends != at_face.end())
            for (const Index h : ends->second) reach(h, node(h));
        for (const Mark& landing : goals)
            if (landing.face == face) {
                const double there = cost + apart(at, landing.at) + apart(landing.at, goal);
                open.push({there, there, last, before, face});
            }
    };
    for (const Mark& landing : starts) relax(apart(start, landing.at), landing.face, landing.at, -1);
    while (!open.empty()) {
        heed_stop();
        const auto [whole, cost, h, before, face] = open.top();
        open.pop();
        if (node(h).before != unseen) continue;
        node(h).before = before, node(h).face = face;
        if (h == last) {
            std::vector<Step> way;
            for (Index by = h; by >= 0; by = node(by).before) way.push_back({node(by).face, by});
            return {way.rbegin(), way.rend()};
        }
        const Place at = node(h).at;
        if (h < base) {
            const Index twin = cells->twin[h];
            if (twin < 0) continue;
            enter(cells->face[twin]);
            node(twin).before = before, node(twin).face = face;
            relax(cost, cells->face[twin], at, h);
        } else {
            const Mark& end = links[(h - base) ^ 1];
            relax(cost + apart(at, end.at), end.face, end.at, h);
        }
    }
    return {};
}

}  // namespace cfree
