// Octagons of rounded pieces along and across a patch; theory, "Rounded shapes".
#include "forbidden/round_shadows.hpp"

#include <algorithm>
#include <cmath>

#include "cfree/scene/lengths.hpp"
#include "cfree/support/elementary.hpp"
#include "predicates/round_surfaces.hpp"

namespace cfree {

namespace {

constexpr double eighth_turn = 0.4375;  // a little more than the tangent of half of it

bool has(const std::vector<Index>& list, const std::vector<Index>& start, Index piece, Index what) {
    const auto begin = list.begin() + start[piece], end = list.begin() + start[piece + 1];
    return std::find(begin, end, what) != end;
}

}  // namespace

// From one vertex to another.
Vec<double> RoundShadows::seen(const Shape& s, Index from, Index to) {
    size = std::max(size, std::abs(s.x[from]) + std::abs(s.y[from]) + std::abs(s.x[to]) + std::abs(s.y[to]));
    const Vec<double> d{s.x[to] - s.x[from], s.y[to] - s.y[from]};
    return {dot(direction, d), cross(direction, d)};
}

RoundShadows::RoundShadows(const Scene& s, const Feature& on, const std::vector<Index>& pieces, const std::vector<Sum>& more)
    : scene(s), contact(on), near_pieces(pieces), rows(s.robot.pieces() + static_cast<Index>(more.size())) {
    const Shape &A = s.robot, &O = s.obstacles;
    const Index a = on.kind == Kind::edge_vertex ? A.v[on.robot] : on.robot, b = on.kind == Kind::vertex_edge ? O.v[on.obstacle] : on.obstacle;
    const double rho = A.radius_of(a).about.hi + O.radius_of(b).about.hi;
    Octagon patch;
    std::vector<Vec<double>> patch_turning{{0, 0}};  // of the robot, with the opposite sign
    if (on.kind == Kind::vertex_edge) {  // a segment on the right of its line
        const Vec<double> E = seen(O, b, O.w[on.obstacle]);
        const double length = norm(E.x, E.y);
        direction = {E.x / length, E.y / length};
        patch.add(0, -rho), patch.add(length, -rho);
    } else if (on.kind == Kind::edge_vertex) {
        const Vec<double> E = seen(A, a, A.w[on.robot]);
        const double length = norm(E.x, E.y);
        patch.add(0, 0);
        patch_turning = {{-rho * E.y / length, rho * E.x / length}, {-rho * E.y / length - E.x, rho * E.x / length - E.y}};
    } else {  // an arc, in the hull of its ends and of points of its tangents
        const auto axis = [&](int turns) { return Vec<double>{turns % 2 == 0 ? 1.0 - turns : 0.0, turns % 2 == 0 ? 0.0 : 2.0 - turns}; };
        const Vec<double> first = axis(on.branch & 3), last = axis((on.branch + 1) & 3);
        for (const auto& [x, y] : {std::pair{1.0, 0.0}, std::pair{1.0, eighth_turn}, std::pair{eighth_turn, 1.0}, std::pair{0.0, 1.0}})
            patch.add(rho * (x * first.x + y * last.x), rho * (x * first.y + y * last.y));
    }
    const auto less_the_patch = [&](Octagon around) {
        for (int i = 0; i < 4; ++i) {
            const double low = around.low[i] - patch.high[i];
            around.high[i] -= patch.low[i], around.low[i] = low;
        }
        still.push_back(around);
    };
    for (const Index k : pieces) {
        Octagon around;
        for (Index n = O.piece[k]; n < O.piece[k + 1]; ++n) {
            const Vec<double> at = seen(O, b, O.piece_vertex[n]);
            around.add(at.x, at.y, O.radius_of(O.piece_vertex[n]).about.hi);
        }
        less_the_patch(around);
    }
    for (std::size_t n = 0; n < more.size(); ++n) {
        Octagon around;
        for (const Index v : more[n][0]) {
            const Vec<double> at = seen(O, b, v);
            around.add(at.x, at.y);
        }
        less_the_patch(around);
        for (const Index v : more[n][1])
            for (const Vec<double>& turned_too : patch_turning) {
                const Vec<double> d = seen(A, a, v);
                turning.push_back({A.pieces() + static_cast<Index>(n), {d.x + turned_too.x, d.y + turned_too.y}, 0});
            }
    }
    for (Index p = 0; p < A.pieces(); ++p)
        for (Index n = A.piece[p]; n < A.piece[p + 1]; ++n)
            for (const Vec<double>& more : patch_turning) {
                const Vec<double> d = seen(A, a, A.piece_vertex[n]);
                turning.push_back({p, {d.x + more.x, d.y + more.y}, A.radius_of(A.piece_vertex[n]).about.hi});
            }
    size += A.largest_radius() + O.largest_radius();
}

// All values are at most 8 sizes, and within 200 u of that.
void RoundShadows::cut(int chart, double lo, double hi) {
    slices.cut(lo, hi, chart);
    const double slack = 0x1p-42 * size + tiny;
    const auto count = static_cast<std::size_t>(rows);
    turned.assign(count * static_cast<std::size_t>(slices.count), {});
    for (int s = 0; s < slices.count; ++s) {
        const double from = slices.at[s], to = slices.at[s + 1];
        Octagon* around = &turned[static_cast<std::size_t>(s) * count];
        for (const auto& [x, y] : {std::pair{from, from}, std::pair{from, to}, std::pair{to, to}}) {
            const auto [cosine, sine] = slices.corner(x, y);
            for (const Vertex& v : turning)
                around[v.piece].add(cosine * v.at.x - sine * v.at.y, cosine * v.at.y + sine * v.at.x, v.radius + slack);
        }
    }
}

bool RoundShadows::is_own(Index p, std::size_t near) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index k = near_pieces[near];
    return has(contact.kind == Kind::edge_vertex ? A.piece_edge : A.piece_vertex, A.piece, p, contact.robot) &&
           has(contact.kind == Kind::vertex_edge ? O.piece_edge : O.piece_vertex, O.piece, k, contact.obstacle);
}

Slices::Part RoundShadows::part(Index p, std::size_t near) const {
    Slices::Part result{slices.count, -1, false};
    const Octagon* around = &turned[static_cast<std::size_t>(p)];
    for (int s = 0; s < slices.count; ++s, around += rows) {
        bool meets = true;
        for (int i = 0; i < 4; ++i) meets &= still[near].low[i] <= around->high[i] && around->low[i] <= still[near].high[i];
        if (meets) result.first = std::min(result.first, s), result.last = s;
    }
    return result;
}

}  // namespace cfree
