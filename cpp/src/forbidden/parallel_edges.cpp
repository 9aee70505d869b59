// Match four sides by the names of their helices; theory, "Closed surfaces".
#include "forbidden/parallel_edges.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace cfree {

namespace {

struct EdgeSide {
    const SideAtAngle* side;
    Code lower, upper;
};

// Two sides in a row on one line, both below the angle or both above it.
struct Row {
    std::array<const EdgeSide*, 2> sides{};
    std::size_t count = 0;

    bool is_full() const { return count == sides.size(); }
    bool join() {
        if (sides[0]->upper != sides[1]->lower) std::swap(sides[0], sides[1]);
        return sides[0]->upper == sides[1]->lower;
    }
    Code begin() const { return sides[0]->lower; }
    Code middle() const { return sides[0]->upper; }
    Code end() const { return sides[1]->upper; }
};

// True if the contact is that of an end of one of two edges with the other edge. All four lines then have one direction where the
// edges are parallel: elsewhere than with their interiors on both sides such a contact does not exist.
bool is_of_edges(const Scene& scene, const Feature& contact, const Feature& edges) {
    const Shape &robot = scene.robot, &obstacles = scene.obstacles;
    const auto [g, f] = std::array{edges.robot, edges.obstacle};
    if (contact.kind == Kind::vertex_edge) return contact.obstacle == f && (contact.robot == robot.v[g] || contact.robot == robot.w[g]);
    return contact.robot == g && (contact.obstacle == obstacles.v[f] || contact.obstacle == obstacles.w[f]);
}

}  // namespace

bool glue_parallel_edges(const Scene& scene, const Whole& whole, std::span<const SideAtAngle> sides, Junction& at, Parts& parts) {
    std::array<EdgeSide, 4> all;
    if (sides.size() != all.size() || sides[0].first.kind != Kind::edge_edge) return false;
    std::array<Row, 2> rows;  // below, above
    for (std::size_t k = 0; k < all.size(); ++k) {
        const SideAtAngle& s = sides[k];
        if (s.first != sides[0].first || !is_of_edges(scene, s.on.contact, s.first)) return false;
        const auto end = [&](int which) { return code(scene, end_helix(scene, s.on.contact, which)); };
        all[k] = {&s, code(scene, s.lower), code(scene, s.upper)};
        Row& row = rows[s.is_above ? 1 : 0];
        if (row.is_full() || all[k].lower != end(0) || all[k].upper != end(1)) return false;
        row.sides[row.count++] = &all[k];
    }
    auto& [below, above] = rows;
    if (!below.is_full() || !above.is_full() || !below.join() || !above.join()) return false;
    if (below.begin() != above.begin() || below.end() != above.end()) return false;
    // the longer edge's line is met by three of the four: the two places between the ends are apart
    const Feature& line = sides[0].on.contact;
    const auto spot = [](const SideAtAngle& of, bool is_upper) {
        return Spot{is_upper ? of.upper : of.lower, 0, of.on.contact};
    };
    const std::array middles{spot(*below.sides[0]->side, true), spot(*above.sides[0]->side, true)};
    const Interval x = at.range(line, middles[0]), y = at.range(line, middles[1]);
    if (!(x.hi < y.lo || y.hi < x.lo)) return false;
    const std::size_t nearer = x.hi < y.lo ? 0 : 1;
    const std::array<Spot, 4> places{spot(*below.sides[0]->side, false), middles[nearer], middles[1 - nearer],
                                     spot(*below.sides[1]->side, true)};
    for (std::size_t k = 0; k < 3; ++k) {
        const EdgeSide* x = rows[nearer].sides[k == 0 ? 0 : 1];
        const EdgeSide* y = rows[1 - nearer].sides[k == 2 ? 1 : 0];
        if (x > y) std::swap(x, y);
        parts.begin_edge();
        const auto add = [&](const SideAtAngle& of) {
            const Side side = of.is_above ? Side::first : Side::last;
            return parts.add(of.trapezoid, side, false, at.value(of.on.contact, places[is_forwards(side) ? k : k + 1]));
        };
        const Index first = add(*x->side);
        parts.pair(first, add(*y->side));
    }
    return true;
}

}  // namespace cfree
