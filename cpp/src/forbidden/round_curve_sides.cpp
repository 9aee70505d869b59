// Match sides along curves of grown shapes by their names; theory, "Rounded shapes".
#include <algorithm>
#include <numeric>

#include "collision/box_tree.hpp"
#include "forbidden/curve_sides.hpp"
#include "forbidden/round_names.hpp"
#include "predicates/round_points.hpp"
#include "support/union_find.hpp"

namespace cfree {

namespace {

struct NamedSide {
    CurveName name;
    Index from, to;
    std::uint32_t side;  // twice the trapezoid, 1 more for its upper curve
    Index trapezoid() const { return static_cast<Index>(side / 2); }
    Side on() const { return side % 2 != 0 ? Side::upper : Side::lower; }
};

// Sides of one name that overlap in theta.
struct Run {
    std::vector<NamedSide>::iterator begin, end;
    Index from, to;
};

class RoundCurveGluer {
public:
    RoundCurveGluer(const Boundary& b, const Whole& w, Around a)
        : boundary(b), scene(b.scene->near()), trapezoids(b.trapezoids), angles(b.angles()), whole(w), around(a) {}
    Parts run();

private:
    void list_sides();
    std::vector<std::vector<Index>> one_curve(const std::vector<Run>& runs) const;
    void glue(std::vector<NamedSide>& sides_of_curve);
    int compare_bends(const NamedSide& x, const NamedSide& y) const;
    void pair_around_point(const std::vector<const NamedSide*>& there, Index from, Index to);
    Index add(const NamedSide& s, Index from, Index to) {
        return parts.add(s.trapezoid(), s.on(), false, is_forwards(s.on()) ? from : to);
    }
    CurveOf curve(const NamedSide& s) const {
        const Index k = s.trapezoid();
        return {surface_of(boundary.patches, trapezoids, k).contact, unpacked((s.on() == Side::upper ? trapezoids.upper : trapezoids.lower)[k])};
    }
    int chart(Index from) const { return from >= angles.middle ? 1 : 0; }

    const Boundary& boundary;
    const Scene& scene;
    const Trapezoids& trapezoids;
    const AngleTable& angles;
    const Whole& whole;
    const Around around;
    std::vector<NamedSide> sides;
    Parts parts;
};

void RoundCurveGluer::list_sides() {
    for (Index k = 0; k < static_cast<Index>(trapezoids.size()); ++k)
        for (const bool is_upper : {false, true}) {
            NamedSide side{{}, angles.from[k], angles.to[k], static_cast<std::uint32_t>(2 * k + is_upper)};
            const auto [on, other] = curve(side);
            side.name = curve_name(scene, on, other);
            sides.push_back(side);
        }
    std::sort(sides.begin(), sides.end(), [](const NamedSide& x, const NamedSide& y) {
        if (x.name != y.name) return x.name < y.name;
        return x.from < y.from || (x.from == y.from && x.side < y.side);
    });
}

Parts RoundCurveGluer::run() {
    list_sides();
    std::vector<Run> runs;
    for (auto first = sides.begin(), next = first; first != sides.end(); first = next) {
        Index reach = first->to;
        for (next = first + 1; next != sides.end() && next->name == first->name && next->from < reach; ++next)
            reach = std::max(reach, next->to);
        runs.push_back({first, next, first->from, reach});
    }
    for (const auto& group : one_curve(runs)) {
        heed_stop();
        std::vector<NamedSide> all;
        for (const Index r : group) all.insert(all.end(), runs[r].begin, runs[r].end);
        glue(all);
    }
    parts.finish();
    return std::move(parts);
}

// Group runs whose curves are one where they overlap: several surfaces may go through one curve, or touch along it.
std::vector<std::vector<Index>> RoundCurveGluer::one_curve(const std::vector<Run>& runs) const {
    std::vector<Box> boxes;
    for (const Run& r : runs) {
        const int in = chart(r.from);
        const Reach reach = RoundPoints(scene, in).reach(curve(*r.begin), angles.lo(r.from, in), angles.hi(r.to, in));
        boxes.push_back(grown({reach.x0, reach.y0, reach.x1, reach.y1}));
    }
    const BoxTree tree(boxes);
    UnionFind joined(runs.size());
    for (std::size_t k = 0; k < runs.size(); ++k) {
        heed_stop();
        tree.query(boxes[k], [&](Index other) {
            const Run &x = runs[k], &y = runs[other];
            const Index from = std::max(x.from, y.from), to = std::min(x.to, y.to);
            if (other <= static_cast<Index>(k) || from >= to) return;
            const int in = chart(from);
            const RoundPoints points(scene, in);
            const Dyadic tau = angles.between(from, from + 1, in).exact();
            if (points.may_be_one(curve(*x.begin), curve(*y.begin), tau) && points.are_one(curve(*x.begin), curve(*y.begin), tau))
                joined.unite(static_cast<Index>(k), other);
        });
    }
    std::vector<Index> number;
    std::vector<std::vector<Index>> groups(static_cast<std::size_t>(joined.number(number)));
    for (std::size_t k = 0; k < runs.size(); ++k) groups[number[k]].push_back(static_cast<Index>(k));
    return groups;
}

void RoundCurveGluer::glue(std::vector<NamedSide>& all) {
    if (std::none_of(all.begin(), all.end(), [&](const NamedSide& s) { return whole[s.trapezoid()]; })) return;
    std::vector<Index> ranks;
    for (const NamedSide& s : all) ranks.push_back(s.from), ranks.push_back(s.to);
    std::sort(ranks.begin(), ranks.end());
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    std::vector<const NamedSide*> there;
    for (std::size_t r = 0; r + 1 < ranks.size(); ++r) {
        const Index from = ranks[r], to = ranks[r + 1];
        there.clear();
        for (const NamedSide& s : all)
            if (s.from <= from && to <= s.to) there.push_back(&s);
        if (!there.empty()) pair_around_point(there, from, to);
    }
}

// Sign of the difference of curvatures to the left, along two rays away from a point: 1 / rho on a circle of a side that leaves, less
// than 0 on one that arrives.
int RoundCurveGluer::compare_bends(const NamedSide& x, const NamedSide& y) const {
    const auto radius = [&](const NamedSide& s) -> Int {  // 0 on a line
        const Feature on = curve(s).on;
        if (!is_circle(on)) return 0;
        const Int rho = scene.robot.radius_of(on.robot).exact + scene.obstacles.radius_of(on.obstacle).exact;
        return s.on() == Side::upper ? Int(-rho) : rho;
    };
    const Int r = radius(x), s = radius(y);
    if (r.is_zero() || s.is_zero()) return r.sign() - s.sign();
    return Int(s - r).sign() * r.sign() * s.sign();
}

// Pair rays from the point, counter-clockwise: after a segment that arrives (an upper end) there is a free sector.
void RoundCurveGluer::pair_around_point(const std::vector<const NamedSide*>& there, Index from, Index to) {
    parts.begin_edge();
    struct Ray {
        const NamedSide* side;
        Index part;
        bool arrives() const { return side->on() == Side::upper; }
    };
    std::vector<Ray> rays;
    for (const NamedSide* s : there) rays.push_back({s, add(*s, from, to)});
    if (rays.size() == 2 && rays[0].arrives() != rays[1].arrives()) return parts.pair(rays[0].part, rays[1].part);
    if (around == Around::all && rays.size() <= 2) return parts.pair(rays.front().part, rays.back().part);
    const int in = chart(from);
    const RoundPoints points(scene, in);
    const Dyadic tau = angles.between(from, to, in).exact();
    const CurveOf at = curve(*there[0]);
    const auto turn = [&](const Ray& x, const Ray& y) {  // of the rays
        auto signs = points.turn(at, curve(*x.side).on, curve(*y.side).on, tau);
        if (x.arrives() != y.arrives()) signs = {-signs[0], -signs[1]};
        return signs;
    };
    // angles from the first ray: 0, in the left half, opposite, in the right half
    std::vector<std::array<int, 2>> from_first;
    const auto half = [](const std::array<int, 2>& signs) { return signs[0] == 0 ? (signs[1] > 0 ? 0 : 2) : signs[0] > 0 ? 1 : 3; };
    for (const Ray& ray : rays) from_first.push_back(turn(rays[0], ray));
    std::vector<Index> order(rays.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index p, Index q) {
        if (p == q) return false;
        const int first = half(from_first[p]), second = half(from_first[q]);
        if (first != second) return first < second;
        if (first == 1 || first == 3)
            if (const int side = turn(rays[p], rays[q])[0]; side != 0) return side > 0;
        if (const int bend = compare_bends(*rays[p].side, *rays[q].side); bend != 0) return bend < 0;
        // space between two rays of one direction and curvature is free, a slit
        if (rays[p].arrives() != rays[q].arrives()) return rays[p].arrives();
        return p < q;
    });
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Ray &x = rays[order[k]], &y = rays[order[(k + 1) % order.size()]];
        if (around == Around::all) {
            parts.twin[x.part] = y.part;
            continue;
        }
        if (x.arrives() == y.arrives() || rays.size() % 2 != 0)
            fail_to_glue("a curve with " + std::to_string(rays.size()) + " sides that do not alternate", x.side->trapezoid(), whole);
        if (x.arrives()) parts.pair(x.part, y.part);
    }
}

}  // namespace

Parts glue_round_curves(const Boundary& boundary, const Whole& whole, Around around) {
    return RoundCurveGluer(boundary, whole, around).run();
}

}  // namespace cfree
