// Match four sides a pair of edges, by the names of their helices; theory, "Closed surfaces".
#include "forbidden/parallel_edges.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <utility>

#include "forbidden/partners.hpp"

namespace cfree {

namespace {

// An edge of the robot and one of the obstacles, parallel at this angle, with their interiors on both sides of one line. Below the
// angle two sides in a row reach from where their ends first meet to where they last do, above it two others do.
class SlidingEdges {
public:
    static constexpr std::size_t size = 4;  // sides
    Feature edges;
    Interval offset;  // of the line, from the first one at this angle

    bool read(const Scene& scene, const SideAtAngle& side);
    bool match(Junction& at);
    const Feature& line() const { return sides[0].side->on.contact; }
    void add(const Whole& whole, Junction& at, Parts& parts) const;

private:
    struct EdgeSide {
        const SideAtAngle* side;
        Code lower, upper;  // names of its curves
    };
    struct Row {
        std::array<const EdgeSide*, 2> sides;
        std::size_t count = 0;

        bool join() {
            if (count < sides.size()) return false;
            if (sides[0]->upper != sides[1]->lower) std::swap(sides[0], sides[1]);
            return sides[0]->upper == sides[1]->lower;
        }
        Spot begin() const { return {sides[0]->side->lower, sides[0]->lower, sides[0]->side->on.contact}; }
        Spot middle() const { return {sides[0]->side->upper, sides[0]->upper, sides[0]->side->on.contact}; }
        Spot end() const { return {sides[1]->side->upper, sides[1]->upper, sides[1]->side->on.contact}; }
    };
    std::array<EdgeSide, size> sides;
    std::size_t count = 0;
    std::array<Row, 2> rows;  // below and above; once they are matched the one with the nearer middle is first
};

// True if the contact is that of an end of one of two edges with the other edge. All four lines then have one direction where the
// edges are parallel: such a contact exists only where their interiors are on both sides.
bool is_of_edges(const Scene& scene, const Feature& contact, const Feature& edges) {
    const Shape &robot = scene.robot, &obstacles = scene.obstacles;
    const auto [g, f] = std::array{edges.robot, edges.obstacle};
    if (contact.kind == Kind::vertex_edge) return contact.obstacle == f && (contact.robot == robot.v[g] || contact.robot == robot.w[g]);
    return contact.robot == g && (contact.obstacle == obstacles.v[f] || contact.obstacle == obstacles.w[f]);
}

// Take a side; false if there are too many, or if it ends before its line's end.
bool SlidingEdges::read(const Scene& scene, const SideAtAngle& side) {
    Row& row = rows[side.is_above ? 1 : 0];
    const Feature& contact = side.on.contact;
    if (row.count == row.sides.size() || !is_of_edges(scene, contact, edges)) return false;
    EdgeSide& read = sides[count++];
    read = {&side, code(scene, side.lower), code(scene, side.upper)};
    row.sides[row.count++] = &read;
    return read.lower == code(scene, end_helix(scene, contact, 0)) && read.upper == code(scene, end_helix(scene, contact, 1));
}

// True if the four sides are there, and the edges certainly differ in length.
bool SlidingEdges::match(Junction& at) {
    auto& [x, y] = rows;
    if (!x.join() || !y.join() || x.begin().code != y.begin().code || x.end().code != y.end().code) return false;
    const Interval of_x = at.reading(line(), x.middle()).t, of_y = at.reading(line(), y.middle()).t;
    if (of_y.hi < of_x.lo) std::swap(x, y);
    return of_x.hi < of_y.lo || of_y.hi < of_x.lo;
}

void SlidingEdges::add(const Whole& whole, Junction& at, Parts& parts) const {
    if (std::none_of(sides.begin(), sides.end(), [&](const EdgeSide& x) { return whole[x.side->trapezoid]; })) return;
    const auto& [x, y] = rows;
    const auto place = [](const Spot& spot) { return LinePlace<Junction>{spot, {}, {}, {}}; };
    const std::array places{place(x.begin()), place(x.middle()), place(y.middle()), place(y.end())};
    const std::array<std::array<const EdgeSide*, 2>, 3> pairs{{{x.sides[0], y.sides[0]}, {x.sides[1], y.sides[0]}, {x.sides[1], y.sides[1]}}};
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto [first, last] = std::minmax(pairs[k][0], pairs[k][1]);
        pair_on_piece(level_side(*first->side), level_side(*last->side), places[k], places[k + 1], at, parts);
    }
}

}  // namespace

bool glue_parallel_edges(const Scene& scene, const Whole& whole, std::span<const SideAtAngle> sides, Junction& at, Parts& parts) {
    constexpr std::size_t most = 8;
    if (sides.size() % SlidingEdges::size != 0 || sides.size() > most * SlidingEdges::size || sides[0].first.kind != Kind::edge_edge) return false;
    std::array<SlidingEdges, most> pairs;
    std::array<SlidingEdges*, most> in_order;
    const std::size_t n = sides.size() / SlidingEdges::size;
    const Code direction = code(scene, sides[0].first);
    for (std::size_t k = 0; k < n; ++k) in_order[k] = &pairs[k];
    const auto end = in_order.begin() + n;
    for (const SideAtAngle& side : sides) {
        const auto found = std::find_if(in_order.begin(), end, [&](const auto* x) { return x->edges.kind == Kind::none || x->edges == side.first; });
        if (found == end || side.first.kind != Kind::edge_edge || code(scene, side.first) != direction) return false;
        (*found)->edges = side.first;
        if (!(*found)->read(scene, side)) return false;
    }
    for (auto x = in_order.begin(); x != end; ++x) {
        if (!(*x)->match(at)) return false;
        (*x)->offset = at.offset(pairs[0].line(), (*x)->line());
    }
    std::sort(in_order.begin(), end, [](const auto* x, const auto* y) { return x->offset.lo < y->offset.lo; });
    const auto are_apart = [](const auto* x, const auto* y) { return x->offset.hi < y->offset.lo; };
    if (std::adjacent_find(in_order.begin(), end, std::not_fn(are_apart)) != end) return false;
    for (auto x = in_order.begin(); x != end; ++x) (*x)->add(whole, at, parts);
    return true;
}

}  // namespace cfree
