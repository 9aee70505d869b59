// A* over the sides of faces: what is left is at least as long as the straight way; theory, "Paths".
#include "cfree/planning/face_graph.hpp"

#include <cmath>
#include <numbers>
#include <queue>
#include <tuple>
#include <unordered_map>

#include "cfree/contact/surface.hpp"
#include "cfree/support/stop.hpp"

namespace cfree {

namespace {

constexpr double pi = std::numbers::pi;

// How far positions are from those of the frame.
Vec<double> moved(const Scene& scene, double theta) {
    const auto [x, y, a, b] = scene.frame;
    if (x == 0 && y == 0 && a == 0 && b == 0) return {0, 0};
    const double c = std::cos(theta), s = std::sin(theta);
    return {x - (c * a - s * b), y - (s * a + c * b)};
}

Place surface_at(const Scene& scene, const Feature& contact, double t, double theta) {
    const ContactLine<double> l(scene, contact, UserUnits{});
    const Vec<double> q = l.on_edge ? l.E : Vec<double>{0, 0}, g = l.on_edge ? Vec<double>{0, 0} : l.E;
    double at[2];
    evaluate_points({l.b.x, l.b.y, q.x, q.y, l.a.x, l.a.y, g.x, g.y}, &t, &theta, 1, at);
    return {at[0], at[1], theta};
}

}  // namespace

Vec<double> position(const CellComplex& cells, Index v) {
    const Vec<double> by = moved(*cells.boundary->scene, cells.theta[v]);
    return {cells.xy[2 * v] + by.x, cells.xy[2 * v + 1] + by.y};
}

FaceGraph::FaceGraph(std::shared_ptr<const CellComplex> of, double scale)
    : cells(std::move(of)), scene(cells->boundary->scene->near()), limits(*cells->boundary), angle_scale(scale) {}

Place FaceGraph::middle(Index h) const {
    const Trapezoids& table = cells->boundary->trapezoids;
    const Index face = cells->face[h], first = cells->first[face], after = h + 1 == cells->first[face + 1] ? first : h + 1;
    const auto theta_of = [&](double tau) { return 2 * std::atan(tau) + table.chart[face] * pi; };
    const double low = theta_of(table.tau_from(face)), high = theta_of(table.tau_to(face));
    const Index ends[2] = {cells->vertex[h], cells->vertex[after]};
    const auto side = static_cast<Side>(cells->side[h]);
    Place result{};
    if (side == Side::first || side == Side::last) {
        result.theta = side == Side::first ? low : high;
        for (const Index v : ends) {
            const Vec<double> end = position(*cells, v);
            result.x += end.x, result.y += end.y;
        }
        result.x /= 2, result.y /= 2;
        return result;
    }
    for (const Index v : ends) {
        const double theta = cells->theta[v];
        const double turned = theta + 2 * pi * std::nearbyint(((low + high) / 2 - theta) / (2 * pi));
        result.theta += std::min(std::max(turned, low), high);
    }
    result.theta /= 2;
    const auto t = limits.of(face, std::tan((result.theta - table.chart[face] * pi) / 2));
    const Feature contact = cells->boundary->patches.contact(table.patch[face]);
    const Place at = surface_at(scene, contact, t[side == Side::upper], result.theta);
    const Vec<double> by = moved(*cells->boundary->scene, result.theta);
    return {at.x + by.x, at.y + by.y, at.theta};
}

double FaceGraph::apart(const Place& a, const Place& b) const {
    return std::hypot(b.x - a.x, b.y - a.y) + angle_scale * std::abs(std::remainder(b.theta - a.theta, 2 * pi));
}

std::vector<FaceGraph::Step> FaceGraph::shortest(const Place& start, std::span<const Mark> starts, const Place& goal,
                                                 std::span<const Mark> goals, std::span<const Mark> links) const {
    const auto base = static_cast<Index>(cells->face.size()), last = static_cast<Index>(base + links.size());
    const auto place_of = [&](Index h) { return h < base ? middle(h) : h < last ? links[h - base].at : goal; };
    std::unordered_multimap<Index, Index> at_face;  // ends of links
    for (Index h = last; h-- > base;) at_face.emplace(links[h - base].face, h);
    struct Entry {
        double whole, cost;
        Index by, before, face;
        bool operator>(const Entry& o) const {
            return std::tie(whole, cost, by, before, face) > std::tie(o.whole, o.cost, o.by, o.before, o.face);
        }
    };
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    constexpr Index unseen = -2;
    struct Came {
        Index before, face;  // the half-edge before, and the face after that
    };
    std::vector<Came> came(static_cast<std::size_t>(last) + 1, {unseen, 0});

    const auto relax = [&](double cost, Index face, const Place& at, Index before) {
        const auto reach = [&](Index h) {
            if (came[h].before != unseen) return;
            const Place place = place_of(h);
            const double there = cost + apart(at, place);
            open.push({there + apart(place, goal), there, h, before, face});
        };
        if (face != far_away)
            for (Index h = cells->first[face]; h < cells->first[face + 1]; ++h) reach(h);
        const auto [from, to] = at_face.equal_range(face);
        for (auto it = from; it != to; ++it) reach(it->second);
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
        if (came[h].before != unseen) continue;
        came[h] = {before, face};
        if (h == last) {
            std::vector<Step> way;
            for (Index by = h; by >= 0; by = came[by].before) way.push_back({came[by].face, by});
            return {way.rbegin(), way.rend()};
        }
        if (h < base) {
            const Index twin = cells->twin[h];
            if (twin < 0) continue;
            came[twin] = {before, face};
            relax(cost, cells->face[twin], place_of(h), h);
        } else {
            const Index other = base + ((h - base) ^ 1);
            const Mark& end = links[other - base];
            relax(cost + apart(links[h - base].at, end.at), end.face, end.at, h);
        }
    }
    return {};
}

}  // namespace cfree
