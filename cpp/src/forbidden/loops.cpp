// Read lists of parts once, column by column; theory, "Closed surfaces".
#include "forbidden/loops.hpp"

#include <algorithm>
#include <numeric>

#include "cfree/contact/contact_line.hpp"
#include "cfree/support/elementary.hpp"
#include "forbidden/junction_at.hpp"
#include "predicates/round_junction.hpp"
#include "support/free_memory.hpp"

namespace cfree {

// Loops of the parts of all lists; their columns are freed as soon as they have been read.
Loops loops_of(std::size_t faces, std::vector<Parts>&& lists) {
    Loops result;
    result.first.assign(faces + 1, 0);
    for (const Parts& list : lists)
        for (const Index f : list.trapezoid) ++result.first[f + 1];
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    const auto count = static_cast<std::size_t>(result.first.back());
    std::vector<Index> number(count);  // each part's half-edge
    {
        std::vector<Index> order(count), next(result.first.begin(), result.first.end() - 1);
        std::vector<std::uint8_t> kind;  // twice its side, 1 more if its side's come in reverse
        kind.reserve(count);
        for (Parts& list : lists) {
            for (Index k = 0; k < list.size(); ++k) {
                order[next[list.trapezoid[k]]++] = static_cast<Index>(kind.size());
                const Side side = list.side(k);
                kind.push_back(static_cast<std::uint8_t>(2 * static_cast<int>(side) + (is_forwards(side) == list.is_backwards(k))));
            }
            free_memory(list.trapezoid);
        }
        result.kind.reserve(count);
        for (std::size_t f = 0; f < faces; ++f) {
            std::sort(order.begin() + result.first[f], order.begin() + result.first[f + 1], [&](Index x, Index y) {
                return kind[x] != kind[y] ? kind[x] < kind[y] : (kind[x] % 2 == 0) == (x < y) && x != y;
            });
            for (Index h = result.first[f]; h < result.first[f + 1]; ++h)
                number[order[h]] = h, result.kind.push_back(kind[order[h]]);
        }
    }
    const auto for_each_part = [&](auto&& take, auto&& release) {
        for (auto at = number.begin(); Parts& list : lists) {
            for (Index k = 0; k < list.size(); ++k) take(list, k, at);
            at += list.size();
            release(list);
        }
        give_back_memory(faces);
    };
    result.twin.resize(count);
    for_each_part([&](const Parts& list, Index k, auto at) { result.twin[at[k]] = list.twin[k] < 0 ? -1 : at[list.twin[k]]; },
                  [](Parts& list) { free_memory(list.twin); });
    result.edge.resize(count);
    for_each_part([&](const Parts& list, Index k, auto at) {
        result.edges += list.begins_edge(k);
        result.edge[at[k]] = result.edges - 1;
    }, [](Parts&) {});
    result.start.resize(count);
    for_each_part([&](const Parts& list, Index k, auto at) { result.start[at[k]] = list.start[k]; }, [](Parts& list) { list = {}; });
    free_memory(number);
    result.face.reserve(count);
    for (std::size_t f = 0; f < faces; ++f) result.face.resize(static_cast<std::size_t>(result.first[f + 1]), static_cast<Index>(f));
    return result;
}

// Start of a half-edge, in doubles.
PlacedPose place_of(const Boundary& boundary, Index k, Side side, double start) {
    const Scene& scene = boundary.scene->near();
    const Trapezoids& trapezoids = boundary.trapezoids;
    const AngleTable& angles = boundary.angles();
    const auto [contact, chart] = surface_of(boundary.patches, trapezoids, k);
    const Index rank = side == Side::first  ? angles.from[k]
                       : side == Side::last ? angles.to[k]
                                               : static_cast<Index>(start);
    const double lo = angles.lo(rank, chart), hi = angles.hi(rank, chart), tau = 0.5 * (lo + hi);
    double t = start;
    if (side == Side::upper || side == Side::lower) {
        const Feature curve = unpacked((side == Side::upper ? trapezoids.upper : trapezoids.lower)[k]);
        if (scene.is_round) {
            auto at = junction_at<RoundJunction>(scene, angles, rank, chart);
            t = at.value(contact, at.spot(contact, curve, rank == angles.from[k]));
        } else {
            const auto at = junction_at<Junction>(scene, angles, rank, chart);
            t = at.value(contact, at.spot(contact, curve));
        }
    }
    return {place_on(scene, {contact, chart}, tau, t), theta_of(chart, tau)};
}

Vec<double> place_on(const Scene& scene, const Surface& surface, double tau, double t) {
    const auto R = rotation_by(surface.chart, tau);
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Feature& contact = surface.contact;
    const Index i = contact.robot, j = contact.obstacle;
    const auto placed = [&](Index a, Index b) { return Vec<double>{O.x[b], O.y[b]} - R(Vec<double>{A.x[a], A.y[a]}); };
    const double rho = sum_of_radii(scene, contact);
    if (is_circle(contact)) {
        const Vec<double> p = placed(i, j), unit = on_quadrant(contact.branch, rho, t);
        return {p.x + rho * unit.x, p.y + rho * unit.y};
    }
    const bool on_edge = contact.kind == Kind::vertex_edge;
    auto p = on_edge ? placed(i, O.v[j]) : placed(A.v[i], j);
    const auto U = (on_edge ? placed(i, O.w[j]) : placed(A.w[i], j)) - p;
    p = {p.x + t * U.x, p.y + t * U.y};
    if (rho == 0) return p;
    const double scale = rho / std::sqrt(dot(U, U));
    return {p.x + scale * U.y, p.y - scale * U.x};
}

}  // namespace cfree
