// Sides of trapezoids matched by what they are: along curves, then at critical angles; theory, "Closed surfaces".
#include "cfree/forbidden/cell_complex.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

#include "cfree/contact/contact_line.hpp"
#include "cfree/forbidden/curve_hash.hpp"
#include "cfree/predicates/junction.hpp"
#include "cfree/support/stop.hpp"

namespace cfree {

namespace {

// A part of a trapezoid's side, between two changes of its neighbours.
struct Part {
    Index trapezoid;
    Side side;
    Index order;  // along theta or t
    Index edge;
    Index from, to;    // ranks of angles, one and the same at a critical angle
    double first, last;  // t at a critical angle
    Index twin = -1;
};

class Gluer {
public:
    // `whole`: of each trapezoid, whether all that its sides meet is there.
    Gluer(const Boundary& b, std::vector<char> are_whole)
        : scene(b.scene->near()), patches(b.patches), trapezoids(b.trapezoids), angles(b.angles()), whole(std::move(are_whole)) {
        glue_curves();
        glue_levels();
    }

    // Trapezoids from some of them over sides: those that are whole, and beyond them those that are not.
    std::array<std::vector<Index>, 2> from(const std::vector<Index>& seeds) const;
    // Of closed surfaces, renumbered: face k is trapezoid faces[k].
    CellComplex build(const std::vector<Index>& faces);

private:
    Index add(const Part& part) {
        parts.push_back(part);
        return static_cast<Index>(parts.size()) - 1;
    }
    void pair(Index p, Index q) { parts[p].twin = q, parts[q].twin = p; }
    // What must not be at a trapezoid that is whole; elsewhere something is missing.
    void fail(const std::string& what, Index trapezoid) const {
        if (whole[trapezoid]) throw std::logic_error(what + " at trapezoid " + std::to_string(trapezoid));
    }
    Junction junction(Index rank, int chart) {
        return {scene, chart, angles.lo(rank, chart), angles.hi(rank, chart),
                [this, rank, chart] { return exact(rank, chart); }};
    }
    RealRoot exact(Index rank, int chart) {
        if (!recent || recent->first != std::pair(rank, chart)) recent = {{rank, chart}, angles.critical(rank, chart)};
        return recent->second.exact(scene);
    }
    Feature contact(Index trapezoid) const { return surface_of(patches, trapezoids, trapezoid).contact; }
    NamedCurve curve(Index k, bool upper) const {
        return {contact(k), unpacked((upper ? trapezoids.upper : trapezoids.lower)[k])};
    }

    // --- curves: at every angle between two critical ones, segments of a slice end in a point of the curve ---

    struct CurveSide {
        CurveHash curve;
        Index from, to, trapezoid;
        bool is_upper;
    };
    void glue_curves();
    void glue_curve(CurveSide* begin, CurveSide* end);
    void pair_around_point(Index from, Index to, const std::vector<Index>& live);

    // --- levels: sides at one critical angle ---

    struct Level {
        Index trapezoid;
        bool is_above;
        Spot low, high;   // its ends in the order of its own line
        int along = 1;    // direction of its line against the group's
        Index first, last;  // numbers of its ends among the group's places
    };
    void glue_levels();
    void glue_junction(std::vector<Level>& levels, Junction& at);
    void glue_line(std::vector<Level*>& line, Junction& at);
    void pair_around_line(const std::vector<std::pair<const Level*, Index>>& live, const Spot& p, const Spot& q, Junction& at);

    struct Start {
        Index trapezoid;
        double tau, t;
    };
    Start start_of(const Part& part);
    void place_vertex(const Start& start, CellComplex& result) const;

    const Scene& scene;
    const Patches& patches;
    const Trapezoids& trapezoids;
    const AngleTable& angles;
    const std::vector<char> whole;
    std::optional<std::pair<std::pair<Index, int>, CriticalAngle>> recent;  // the last that was asked for exactly
    std::vector<Part> parts;
    Index edges = 0;
};

void Gluer::glue_curves() {
    const auto n = static_cast<Index>(trapezoids.patch.size());
    std::vector<CurveSide> sides;
    sides.reserve(2 * static_cast<std::size_t>(n));
    const CurveHashes hashes(scene, 2 * static_cast<std::size_t>(n),
                              [&](std::size_t k) { return curve(static_cast<Index>(k / 2), k % 2 != 0); });
    for (Index k = 0; k < n; ++k)
        for (const bool upper : {false, true})
            sides.push_back({hashes[2 * static_cast<std::size_t>(k) + upper], angles.from[k], angles.to[k], k, upper});
    std::sort(sides.begin(), sides.end(), [](const CurveSide& x, const CurveSide& y) {
        if (x.curve != y.curve) return x.curve < y.curve;
        return x.from < y.from || (x.from == y.from && x.trapezoid < y.trapezoid);
    });
    for (std::size_t begin = 0, end; begin < sides.size(); begin = end) {
        heed_stop();
        Index reach = sides[begin].to;  // runs that overlap in theta
        for (end = begin + 1; end < sides.size() && sides[end].curve == sides[begin].curve && sides[end].from < reach; ++end)
            reach = std::max(reach, sides[end].to);
        glue_curve(&sides[begin], &sides[begin] + (end - begin));
    }
}

// Sides with one hash: first those on the first's curve, then others.
void Gluer::glue_curve(CurveSide* begin, CurveSide* end) {
    if (std::none_of(begin, end, [&](const CurveSide& s) { return whole[s.trapezoid]; })) return;
    const NamedCurve first = curve(begin->trapezoid, begin->is_upper);
    CurveSide* others = std::stable_partition(begin + 1, end, [&](const CurveSide& s) {
        return is_same_curve(scene, first, curve(s.trapezoid, s.is_upper));
    });
    if (others != end) glue_curve(others, end);
    end = others;
    std::vector<Index> ranks;
    for (const CurveSide* s = begin; s != end; ++s) ranks.push_back(s->from), ranks.push_back(s->to);
    std::sort(ranks.begin(), ranks.end());
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    std::vector<Index> live;
    for (std::size_t r = 0; r + 1 < ranks.size(); ++r) {
        heed_stop();
        live.clear();
        for (const CurveSide* s = begin; s != end; ++s)
            if (s->from <= ranks[r] && ranks[r + 1] <= s->to)
                live.push_back(add({s->trapezoid, s->is_upper ? Side::upper : Side::lower, static_cast<Index>(r), edges, ranks[r],
                                    ranks[r + 1], 0, 0}));
        if (live.empty()) continue;
        ++edges;
        if (live.size() == 2 && parts[live[0]].side != parts[live[1]].side) pair(live[0], live[1]);
        else pair_around_point(ranks[r], ranks[r + 1], live);
    }
}

// Rays from the point, counter-clockwise: after a segment that arrives (an upper end) there is a free sector.
void Gluer::pair_around_point(Index from, Index to, const std::vector<Index>& live) {
    const int chart = trapezoids.chart[parts[live[0]].trapezoid];
    const Dyadic tau = angles.between(from, to, chart).exact();
    const auto R = rotation_by(chart, tau.n, Int(1) << tau.k);
    struct Ray {
        Vec<Int> d;
        bool arrives;
        Index part;
        int half() const { return d.y.sign() > 0 || (d.y.is_zero() && d.x.sign() > 0) ? 0 : 1; }
    };
    std::vector<Ray> rays;
    for (const Index k : live) {
        const Feature f = contact(parts[k].trapezoid);
        const auto d = ContactLine<Int>(scene, f, CoreUnits<Int>{}).direction(R);
        const bool arrives = parts[k].side == Side::upper;
        rays.push_back({arrives ? -d : d, arrives, k});
    }
    std::sort(rays.begin(), rays.end(), [](const Ray& x, const Ray& y) {
        if (x.half() != y.half()) return x.half() < y.half();
        const int turn = cross(x.d, y.d).sign();
        return turn != 0 ? turn > 0 : x.arrives > y.arrives;  // between two sheets of one slit there is no width, but free
    });
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const Ray &x = rays[k], &y = rays[(k + 1) % rays.size()];
        if (x.arrives == y.arrives || rays.size() % 2 != 0)
            fail("a curve with " + std::to_string(rays.size()) + " sides that do not alternate", parts[x.part].trapezoid);
        if (x.arrives) pair(x.part, y.part);
    }
}

void Gluer::glue_levels() {
    const auto n = static_cast<Index>(trapezoids.patch.size());
    // trapezoids by the angle where they end, or begin
    const Index ranks = angles.last;
    const auto round = [&](Index rank) { return rank == angles.last ? 0 : rank; };
    std::vector<Index> start(static_cast<std::size_t>(ranks) + 1, 0), member(2 * static_cast<std::size_t>(n));
    for (Index k = 0; k < n; ++k) ++start[round(angles.from[k]) + 1], ++start[round(angles.to[k]) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<Index> place(start.begin(), start.end() - 1);
    for (Index k = 0; k < n; ++k)
        member[place[round(angles.from[k])]++] = 2 * k, member[place[round(angles.to[k])]++] = 2 * k + 1;
    std::vector<Level> levels;
    for (Index rank = 0; rank < ranks; ++rank) {
        heed_stop();
        if (std::none_of(&member[start[rank]], &member[0] + start[rank + 1], [&](Index m) { return whole[m / 2]; })) continue;
        Junction at = junction(rank, rank > angles.middle ? 1 : 0);
        levels.clear();
        for (Index m = start[rank]; m < start[rank + 1]; ++m) {
            const Index k = member[m] / 2;
            at.know((member[m] % 2 == 0 ? angle_from : angle_to)(patches, trapezoids, k).name(scene));
            Level level{k, member[m] % 2 == 0, at.spot(contact(k), unpacked(trapezoids.lower[k])),
                      at.spot(contact(k), unpacked(trapezoids.upper[k])), 1, 0, 0};
            if (at.order(contact(k), level.low, level.high) != 0) levels.push_back(std::move(level));
        }
        glue_junction(levels, at);
    }
}

void Gluer::glue_junction(std::vector<Level>& levels, Junction& at) {
    std::vector<Level*> all;
    for (Level& w : levels) all.push_back(&w);
    std::vector<Level*> line;
    while (!all.empty()) {  // one direction after another
        const Feature front = contact(all[0]->trapezoid);
        std::vector<Level*> parallel, others;
        for (Level* w : all) {
            w->along = at.parallel(front, contact(w->trapezoid));
            (w->along != 0 ? parallel : others).push_back(w);
        }
        // y's line left of x's, seen along the first
        const auto offset = [&](const Level* x, const Level* y) {
            return at.side(contact(x->trapezoid), contact(y->trapezoid)) * x->along;
        };
        std::stable_sort(parallel.begin(), parallel.end(), [&](const Level* x, const Level* y) { return offset(x, y) > 0; });
        for (std::size_t begin = 0, end; begin < parallel.size(); begin = end) {
            line.clear();
            for (end = begin; end < parallel.size() && (end == begin || offset(parallel[begin], parallel[end]) == 0); ++end)
                line.push_back(parallel[end]);
            glue_line(line, at);
        }
        all = std::move(others);
    }
}

void Gluer::glue_line(std::vector<Level*>& line, Junction& at) {
    if (std::none_of(line.begin(), line.end(), [&](const Level* w) { return whole[w->trapezoid]; })) return;
    const Feature ref = contact(line[0]->trapezoid);
    const int along = line[0]->along;
    for (Level* w : line) w->along *= along;
    std::vector<const Spot*> places;
    for (const Level* w : line) places.push_back(&w->low), places.push_back(&w->high);
    std::stable_sort(places.begin(), places.end(), [&](const Spot* p, const Spot* q) { return at.order(ref, *p, *q) < 0; });
    places.erase(std::unique(places.begin(), places.end(),
                             [&](const Spot* p, const Spot* q) { return at.order(ref, *p, *q) == 0; }),
                 places.end());
    const auto number = [&](const Spot& spot) {
        return static_cast<Index>(std::partition_point(places.begin(), places.end(),
                                                       [&](const Spot* p) { return at.order(ref, *p, spot) < 0; }) -
                                  places.begin());
    };
    for (Level* w : line) {
        w->first = number(w->low), w->last = number(w->high);
        if (w->along < 0) std::swap(w->first, w->last);
        if (w->first >= w->last) fail("a side that runs backwards", w->trapezoid);
    }
    std::vector<std::pair<const Level*, Index>> live;
    for (Index k = 0; k + 1 < static_cast<Index>(places.size()); ++k) {
        heed_stop();
        live.clear();
        for (const Level* w : line) {
            if (w->first > k || k + 1 > w->last) continue;
            const auto t = [&](Index place) { return at.value(contact(w->trapezoid), *places[place]); };
            const bool forwards = w->along > 0;
            const Index own = w->is_above ? angles.from[w->trapezoid] : angles.to[w->trapezoid];
            live.push_back({w, add({w->trapezoid, w->is_above ? Side::first : Side::last, forwards ? k : -k, edges,
                                    own, own, t(forwards ? k : k + 1), t(forwards ? k + 1 : k)})});
        }
        if (live.empty()) continue;
        ++edges;
        pair_around_line(live, *places[k], *places[k + 1], at);
    }
}

// Around the line, seen along it: theta upwards, the line's left to the right. Counter-clockwise from there.
void Gluer::pair_around_line(const std::vector<std::pair<const Level*, Index>>& live, const Spot& p, const Spot& q,
                             Junction& at) {
    auto around = live;
    const auto is_left = [&](const Level* x, const Level* y) {  // x further left than y, of two above or two below
        const int s = at.across(contact(x->trapezoid), contact(y->trapezoid), p, q, x->is_above) * y->along;
        return s != 0 ? s > 0 : x->along > y->along;  // one slit: what is left of its left sheet is forbidden
    };
    // stable: a merge stays within its arrays whatever sheets from outside say of their order
    std::stable_sort(around.begin(), around.end(), [&](const auto& x, const auto& y) {
        if (x.second == y.second) return false;
        if (x.first->is_above != y.first->is_above) return x.first->is_above;
        return x.first->is_above ? is_left(x.first, y.first) : is_left(y.first, x.first);
    });
    // forbidden is on the left of a segment
    const auto free_after = [](const Level* w) { return w->is_above == (w->along > 0); };
    for (std::size_t k = 0; k < around.size(); ++k) {
        const auto &x = around[k], &y = around[(k + 1) % around.size()];
        if (around.size() % 2 != 0 || free_after(x.first) == free_after(y.first))
            fail("a line with " + std::to_string(around.size()) + " sides that do not alternate", x.first->trapezoid);
        if (free_after(x.first)) pair(x.second, y.second);
    }
}

// Where a part starts, in doubles.
Gluer::Start Gluer::start_of(const Part& part) {
    const bool forwards = part.side == Side::first || part.side == Side::upper;
    const int chart = trapezoids.chart[part.trapezoid];
    const auto tau_of = [&](Index rank) { return 0.5 * (angles.lo(rank, chart) + angles.hi(rank, chart)); };
    const Index rank = forwards ? part.from : part.to;
    const double tau = tau_of(rank);
    if (part.from == part.to) return {part.trapezoid, tau, forwards ? part.first : part.last};
    const NamedCurve c = curve(part.trapezoid, part.side == Side::upper);
    const Junction at = junction(rank, chart);
    return {part.trapezoid, tau, at.value(c.on, at.spot(c.on, c.other))};
}

void Gluer::place_vertex(const Start& start, CellComplex& result) const {
    const Surface on = surface_of(patches, trapezoids, start.trapezoid);
    const double tau = start.tau, t = start.t;
    const auto R = rotation_by(on.chart, tau);
    const Shape &A = scene.robot, &O = scene.obstacles;
    const auto placed = [&](Index a, Index b) {
        return Vec<double>{O.x[b], O.y[b]} - R(Vec<double>{A.x[a], A.y[a]});
    };
    const Feature first = end_helix(scene, on.contact, 0), last = end_helix(scene, on.contact, 1);
    const auto p = placed(first.robot, first.obstacle), q = placed(last.robot, last.obstacle);
    result.xy.push_back(p.x + t * (q.x - p.x)), result.xy.push_back(p.y + t * (q.y - p.y));
    result.theta.push_back(2 * std::atan(tau) + on.chart * std::numbers::pi);
}

std::array<std::vector<Index>, 2> Gluer::from(const std::vector<Index>& seeds) const {
    std::vector<Index> first(whole.size() + 1, 0), own(parts.size());
    for (const Part& p : parts) ++first[p.trapezoid + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Index> place(first.begin(), first.end() - 1);
    for (std::size_t k = 0; k < parts.size(); ++k) own[place[parts[k].trapezoid]++] = static_cast<Index>(k);
    std::array<std::vector<Index>, 2> found;
    std::vector<char> seen(whole.size(), 0);
    std::vector<Index> stack;
    const auto see = [&](Index trapezoid) {
        if (seen[trapezoid]++) return;
        found[whole[trapezoid] ? 0 : 1].push_back(trapezoid);
        if (whole[trapezoid]) stack.push_back(trapezoid);
    };
    for (const Index seed : seeds) see(seed);
    while (!stack.empty()) {
        const Index k = stack.back();
        stack.pop_back();
        for (Index x = first[k]; x < first[k + 1]; ++x) {
            if (parts[own[x]].twin < 0) fail("a side without a partner", k);
            see(parts[parts[own[x]].twin].trapezoid);
        }
    }
    for (auto& list : found) std::sort(list.begin(), list.end());
    return found;
}

CellComplex Gluer::build(const std::vector<Index>& faces) {
    const auto n = static_cast<Index>(faces.size());
    std::vector<Index> face_of(whole.size(), -1), order, number(parts.size());
    for (Index f = 0; f < n; ++f) face_of[faces[f]] = f;
    for (std::size_t k = 0; k < parts.size(); ++k)
        if (face_of[parts[k].trapezoid] >= 0) order.push_back(static_cast<Index>(k));
    std::sort(order.begin(), order.end(), [&](Index x, Index y) {
        const Part &p = parts[x], &q = parts[y];
        if (p.trapezoid != q.trapezoid) return p.trapezoid < q.trapezoid;
        if (p.side != q.side) return p.side < q.side;
        const bool forwards = p.side == Side::first || p.side == Side::upper;
        return forwards ? p.order < q.order : p.order > q.order;
    });
    const auto count = static_cast<Index>(order.size());
    std::vector<Index> edge_of(static_cast<std::size_t>(edges) + 1, 0);  // those that are there, in their order
    for (const Index x : order) edge_of[parts[x].edge + 1] = 1;
    std::partial_sum(edge_of.begin(), edge_of.end(), edge_of.begin());
    CellComplex result;
    result.edges = edge_of[edges];
    result.first.assign(static_cast<std::size_t>(n) + 1, 0);
    for (Index k = 0; k < count; ++k) number[order[k]] = k;
    for (const Index x : order) {
        const Part& p = parts[x];
        if (p.twin < 0) fail("a side without a partner", p.trapezoid);
        result.face.push_back(face_of[p.trapezoid]), result.side.push_back(static_cast<std::uint8_t>(p.side));
        result.edge.push_back(edge_of[p.edge]), result.twin.push_back(number[p.twin]);
        ++result.first[face_of[p.trapezoid] + 1];
    }
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    // vertices: around the start of a half-edge, over twins
    const auto before = [&](Index h) {
        const Index f = result.face[h];
        return h == result.first[f] ? result.first[f + 1] - 1 : h - 1;
    };
    result.vertex.assign(count, -1);
    for (Index h = 0; h < count; ++h) {
        if (result.vertex[h] >= 0) continue;
        heed_stop();
        Index best = h;  // levels know their ends
        for (Index x = h; result.vertex[x] < 0; x = result.twin[before(x)]) {
            result.vertex[x] = result.vertices;
            if (parts[order[x]].from == parts[order[x]].to) best = x;
        }
        place_vertex(start_of(parts[order[best]]), result);
        ++result.vertices;
    }
    result.component.assign(n, -1);
    std::vector<Index> stack;
    for (Index f = 0; f < n; ++f) {
        if (result.component[f] >= 0) continue;
        result.component[f] = result.components;
        stack.push_back(f);
        while (!stack.empty()) {
            const Index g = stack.back();
            stack.pop_back();
            for (Index h = result.first[g]; h < result.first[g + 1]; ++h) {
                const Index neighbour = result.face[result.twin[h]];
                if (result.component[neighbour] >= 0) continue;
                result.component[neighbour] = result.components;
                stack.push_back(neighbour);
            }
        }
        ++result.components;
    }
    return result;
}

}  // namespace

namespace {

std::shared_ptr<const CellComplex> shared(CellComplex&& built, const SharedBoundary& boundary) {
    auto result = std::make_shared<CellComplex>(std::move(built));
    result->boundary = boundary;
    const double unit = boundary->scene->near().unit();
    for (double& c : result->xy) c *= unit;
    return result;
}

}  // namespace

std::shared_ptr<const CellComplex> glue(const SharedBoundary& boundary) {
    std::vector<Index> all(boundary->trapezoids.size());
    std::iota(all.begin(), all.end(), 0);
    return shared(Gluer(*boundary, std::vector<char>(all.size(), 1)).build(all), boundary);
}

GluedPart glue_part(const SharedBoundary& boundary, std::vector<char> whole, const std::vector<Index>& seeds) {
    Gluer gluer(*boundary, std::move(whole));
    auto [faces, missing] = gluer.from(seeds);
    if (!missing.empty()) return {nullptr, std::move(missing)};
    Trapezoids rows;
    for (const Index k : faces) rows.push_row(boundary->trapezoids, k);
    return {shared(gluer.build(faces), std::make_shared<const Boundary>(boundary->scene, boundary->patches, boundary->trimmed,
                                                                        std::move(rows), IsolatedParts{})), {}};
}

}  // namespace cfree
