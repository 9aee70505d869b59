// Exact fits among grown shapes: parts without width that are on no trapezoid, each once; theory, "Exact fits".
//
// Between two critical angles of the rows near a curve it is on a trapezoid everywhere or nowhere, so one sample decides. At a critical
// angle points and segments are compared with the trapezoids that reach it.
#include <algorithm>
#include <map>

#include "cfree/forbidden/isolated.hpp"
#include "collision/box_tree.hpp"
#include "forbidden/equal_radii.hpp"
#include "forbidden/junction_at.hpp"
#include "forbidden/patch_trimming.hpp"
#include "forbidden/round_names.hpp"
#include "predicates/round_junction.hpp"
#include "predicates/round_orders.hpp"
#include "predicates/round_points.hpp"
#include "support/parallel.hpp"

namespace cfree {

namespace {

using Spot = RoundSpot;

// Curve on a patch between two critical angles, by their ranks in the table.
struct RoundRidge {
    Index patch;
    Feature curve;
    int chart;
    Index from, to;
};
// Segment at one angle, from low to high along the line of a patch; or a point.
struct RoundFlat {
    Index patch, rank;
    Spot low, high;
    bool is_point;
};

class RoundFinder {
public:
    // thin: parts without width, so many of them of trimming.
    RoundFinder(const Scene& s, const Patches& p, const Trapezoids& l, const Trapezoids& t, std::size_t of_trimming, int thread_count)
        : scene(s), patches(p), live(l), thin(t), first_fit(static_cast<Index>(l.size() + of_trimming)), threads(thread_count), first_patch(first_patches(s, p)), rows(joined(l, t)),
          angles(s, p, rows, thread_count), live_count(static_cast<Index>(l.size())), boxes(boxes_of_rows()),
          tree({boxes.begin(), boxes.begin() + live_count}) {}

    IsolatedParts run() {
        std::vector<std::vector<RoundRidge>> found_ridges(thin.size());
        std::vector<std::vector<RoundFlat>> found_flats(thin.size());
        for_each_in_parallel(threads, thin.size(), [&](std::size_t n) {
            heed_stop();
            const auto k = live_count + static_cast<Index>(n);
            if (angles.from[k] == angles.to[k]) found_flats[n] = flats_of(k);
            else found_ridges[n] = ridges_of(k);
        });
        for (const auto& found : found_ridges)
            for (const RoundRidge& r : found) add_ridge(r);
        join_ridges();
        std::map<Index, std::vector<RoundFlat>> by_rank;
        for (const auto& found : found_flats)
            for (const RoundFlat& f : found) by_rank[f.rank].push_back(f);
        for (auto& [rank, all] : by_rank) {
            std::stable_sort(all.begin(), all.end(), [](const RoundFlat& x, const RoundFlat& y) { return x.is_point < y.is_point; });
            RoundJunction at = junction(rank, chart_of(rank));
            const std::size_t start = flats.size();
            for (const RoundFlat& f : all)
                if (!f.is_point || !is_listed(f, start, at)) add_flat(f, start, at);
        }
        return list();
    }

private:
    static Trapezoids joined(const Trapezoids& live, const Trapezoids& thin) {
        Trapezoids result = live;
        for (Index k = 0; k < static_cast<Index>(thin.size()); ++k) result.push_row(thin, k);
        return result;
    }
    Feature contact(Index patch) const { return patches.contact(patch); }
    Feature on(Index row) const { return contact(rows.patch[row]); }
    Feature lower(Index row) const { return unpacked(rows.lower[row]); }
    Feature upper(Index row) const { return unpacked(rows.upper[row]); }
    RoundJunction junction(Index rank, int chart) const {
        return junction_at<RoundJunction>(scene, angles, chart == 0 && rank == angles.last ? 0 : chart == 1 && rank == 0 ? angles.last : rank, chart);
    }
    RoundJunction junction_between(Index from, Index to, int chart) const {
        const Sample at = angles.between(from, to, chart);
        const Dyadic tau = at.exact();
        return {scene, chart, tau.rounded_down(), tau.rounded_up(), [tau] { return LongRoot{LongPoly{-tau.n, Int(1) << tau.k}, tau, tau}; },
                [tau]() -> std::optional<Predicates::Bracket> {
                    const Ball number = ball(tau.n, static_cast<int>(tau.k));
                    return Predicates::Bracket{number, number};
                }};
    }
    int chart_of(Index rank) const { return rank <= angles.middle ? 0 : 1; }
    Index rounded(Index rank) const { return rank == angles.last ? 0 : rank; }
    bool reaches(Index row, Index rank) const {
        return (angles.from[row] <= rank && rank <= angles.to[row]) || (rank == 0 && angles.to[row] == angles.last);
    }

    std::vector<Box> boxes_of_rows() const {
        std::vector<Box> result;
        for (Index k = 0; k < static_cast<Index>(rows.size()); ++k) {
            const CurveOf part{on(k), k >= live_count && rows.lower[k] == rows.upper[k] ? lower(k) : Feature{}};
            const Reach reach = RoundPoints(scene, rows.chart[k]).reach(part, rows.from_lo[k], rows.to_hi[k]);
            result.push_back(grown({reach.x0, reach.y0, reach.x1, reach.y1}));
        }
        return result;
    }

    // True if a place is in trapezoid k, at an angle that it reaches.
    bool is_in(Index k, const Spot& p, bool is_first, RoundJunction& at) const {
        const Feature surface = on(k);
        if (at.outside(surface, p) != 0) return false;
        return at.is_between(surface, at.spot(surface, lower(k), is_first), at.spot(surface, upper(k), is_first), p);
    }

    // --- along theta ---

    // False if a helix of equal radii is on the surface of trapezoid k at single angles only; of other curves a sample decides.
    bool may_hold(Index k, Index row) const {
        const Feature own = on(row);
        if (!is_circle(own) || !have_equal_radii(scene, own.robot, own.obstacle)) return true;
        Feature other = on(k);
        other.branch = 1;
        const Surface helix{own, rows.chart[row]};
        if (Predicates(scene, helix).event_sign_on(other, {}, rows.from_lo[row], rows.to_hi[row]) != 0) return false;
        return RoundOrders(scene, helix).exactly(other, {}).norm.empty();
    }

    std::vector<RoundRidge> ridges_of(Index row) const {
        const Index from = angles.from[row], to = angles.to[row];
        const int chart = rows.chart[row];
        std::vector<Index> near, cuts{from, to};
        const CurveName name = curve_name(scene, on(row), lower(row));
        std::vector<Index> sides;  // trapezoids that have the curve as a side, by its name
        tree.query(boxes[row], [&](Index k) {
            if (angles.from[k] >= to || angles.to[k] <= from || rows.chart[k] != chart) return;
            if (!may_hold(k, row)) return;
            near.push_back(k);
            for (const Index end : {angles.from[k], angles.to[k]})
                if (from < end && end < to) cuts.push_back(end);
            if (name == curve_name(scene, on(k), lower(k)) || name == curve_name(scene, on(k), upper(k))) sides.push_back(k);
        });
        std::sort(near.begin(), near.end());
        std::sort(cuts.begin(), cuts.end());
        cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
        std::vector<RoundRidge> result;
        for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
            const auto is_there = [&](Index k) { return angles.from[k] <= cuts[c] && cuts[c + 1] <= angles.to[k]; };
            if (std::any_of(sides.begin(), sides.end(), is_there)) continue;
            RoundJunction at = junction_between(cuts[c], cuts[c + 1], chart);
            const Spot place = at.spot(on(row), lower(row), false);
            if (std::any_of(near.begin(), near.end(), [&](Index k) { return is_there(k) && is_in(k, place, false, at); })) continue;
            if (!result.empty() && result.back().to == cuts[c]) result.back().to = cuts[c + 1];
            else result.push_back({rows.patch[row], lower(row), chart, cuts[c], cuts[c + 1]});
        }
        return result;
    }

    bool are_one(const RoundRidge& x, const RoundRidge& y, Index from, Index to) const {
        RoundJunction at = junction_between(from, to, x.chart);
        return at.are_one_place(at.spot(contact(x.patch), x.curve, false), at.spot(contact(y.patch), y.curve, false));
    }

    // Add what is not listed of a curve.
    void add_ridge(const RoundRidge& whole) {
        std::vector<RoundRidge> left{whole}, next;
        const std::size_t listed = ridges.size();
        for (std::size_t k = 0; k < listed && !left.empty(); ++k) {
            const RoundRidge& other = ridges[k];
            next.clear();
            for (const RoundRidge& r : left) {
                const Index from = std::max(r.from, other.from), to = std::min(r.to, other.to);
                if (r.chart != other.chart || from >= to || !are_one(r, other, from, to)) {
                    next.push_back(r);
                    continue;
                }
                if (r.from < from) next.push_back({r.patch, r.curve, r.chart, r.from, from});
                if (to < r.to) next.push_back({r.patch, r.curve, r.chart, to, r.to});
            }
            left.swap(next);
        }
        ridges.insert(ridges.end(), left.begin(), left.end());
    }

    // Join pieces of one curve on one patch that meet at an angle.
    void join_ridges() {
        std::stable_sort(ridges.begin(), ridges.end(), [](const RoundRidge& x, const RoundRidge& y) { return x.from < y.from; });
        std::vector<RoundRidge> result;
        for (const RoundRidge& r : ridges) {
            const auto before = std::find_if(result.begin(), result.end(), [&](const RoundRidge& x) {
                return x.patch == r.patch && x.chart == r.chart && x.to == r.from && x.curve == r.curve;
            });
            if (before == result.end()) result.push_back(r);
            else before->to = r.to;
        }
        ridges.swap(result);
    }

    // --- at one angle ---

    std::vector<RoundFlat> flats_of(Index row) const {
        const Index rank = rounded(angles.from[row]), patch = rows.patch[row];
        const Feature own = on(row);
        RoundJunction at = junction(rank, rows.chart[row]);
        const Spot low = at.spot(own, lower(row), false), high = at.spot(own, upper(row), false);
        if (low.jumps || high.jumps) return {};  // a limit of curves: others name the place
        const bool is_point = at.order(own, low, high) == 0;
        if (!is_point && is_circle(own) && row < first_fit) return {};  // space beyond an arc is free, or the fit is found by itself
        if (is_point) return is_in_any(row, rank, low, at) || is_inside_at_one_circle(own, low, at) ? std::vector<RoundFlat>{} : std::vector{RoundFlat{patch, rank, low, low, true}};
        std::vector<RoundFlat> left{{patch, rank, low, high, false}}, next;
        tree.query(boxes[row], [&](Index k) {
            const Feature other = on(k);
            if (left.empty() || !reaches(k, rank)) return;
            const int along = direction_on(own, other, at);
            if (along == 0) return;
            const bool is_first = rounded(angles.from[k]) == rank;
            Spot first = at.spot(other, lower(k), is_first), last = at.spot(other, upper(k), is_first);
            if (along < 0) std::swap(first, last);
            next.clear();
            for (const RoundFlat& f : left) {
                if (at.order(own, first, f.high) >= 0 || at.order(own, last, f.low) <= 0) {
                    next.push_back(f);
                    continue;
                }
                if (at.order(own, f.low, first) < 0) next.push_back({f.patch, f.rank, f.low, first, false});
                if (at.order(own, last, f.high) < 0) next.push_back({f.patch, f.rank, last, f.high, false});
            }
            left.swap(next);
        });
        return left;
    }

    // Direction of a surface that is on the line, or on the quadrant, of another one; 0 of others.
    int direction_on(const Feature& own, const Feature& other, RoundJunction& at) const {
        if (is_line(own) != is_line(other)) return 0;
        if (is_circle(own)) return !at.are_one_circle(own, other) ? 0 : is_concave(scene, own) == is_concave(scene, other) ? 1 : -1;
        const int along = at.parallel(own, other);
        return along != 0 && at.side(own, other) == 0 ? along : 0;
    }

    bool is_in_any(Index row, Index rank, const Spot& p, RoundJunction& at) const {
        bool is_found = false;
        tree.query(boxes[row], [&](Index k) {
            is_found = is_found || (reaches(k, rank) && is_in(k, p, rounded(angles.from[k]) == rank, at));
        });
        return is_found;
    }

    // True if a place on a circle is inside a pillar that has the same circle at this angle alone: not in the arc of it. Trimming
    // takes nothing of a patch there.
    bool is_inside_at_one_circle(const Feature& own, const Spot& p, RoundJunction& at) const {
        if (!is_circle(own)) return false;
        const Shape &A = scene.robot, &O = scene.obstacles;
        for (Index x = 0; x < static_cast<Index>(A.piece_vertex.size()); ++x)
            for (Index y = 0; y < static_cast<Index>(O.piece_vertex.size()); ++y) {
                const Feature other{Kind::vertex_vertex, A.piece_vertex[x], O.piece_vertex[y], own.branch};
                if (code(scene, other) == code(scene, own)) continue;
                const Index i = piece_of(A, x), j = piece_of(O, y);
                if (A.piece_layer[i] != O.piece_layer[j] || !at.are_one_circle(own, other)) continue;
                if (!is_in_cone(A, i, x, own, other, p, at) || !is_in_cone(O, j, y, own, other, p, at)) return true;
            }
        return false;
    }
    static Index piece_of(const Shape& s, Index place) {
        return static_cast<Index>(std::upper_bound(s.piece.begin(), s.piece.end(), place) - s.piece.begin()) - 1;
    }
    // True if the direction to a place on a circle is between the edges before and after a vertex of a piece.
    bool is_in_cone(const Shape& s, Index piece, Index place, const Feature& circle, const Feature& vertices, const Spot& p, RoundJunction& at) const {
        const Index begin = s.piece[piece], end = s.piece[piece + 1];
        if (end - begin < 2) return true;
        const auto line = [&](Index edge) {
            return &s == &scene.robot ? Feature{Kind::edge_vertex, edge, vertices.obstacle} : Feature{Kind::vertex_edge, vertices.robot, edge};
        };
        const Index before = s.piece_edge[place > begin ? place - 1 : end - 1], after = s.piece_edge[place];
        return at.ahead(line(before), circle, p) >= 0 && at.ahead(line(after), circle, p) <= 0;
    }

    // Add a segment, united with those of its line that it meets.
    void add_flat(RoundFlat f, std::size_t start, RoundJunction& at) {
        for (std::size_t k = start; k < flats.size() && !f.is_point;) {
            const Feature own = contact(f.patch), other = contact(flats[k].patch);
            const int along = direction_on(own, other, at);
            Spot low = flats[k].low, high = flats[k].high;
            if (along < 0) std::swap(low, high);
            if (along == 0 || at.order(own, low, f.high) > 0 || at.order(own, high, f.low) < 0) {
                ++k;
                continue;
            }
            if (at.order(own, low, f.low) < 0) f.low = low;
            if (at.order(own, high, f.high) > 0) f.high = high;
            flats.erase(flats.begin() + static_cast<std::ptrdiff_t>(k));
            k = start;
        }
        flats.push_back(f);
    }

    bool is_listed(const RoundFlat& point, std::size_t start, RoundJunction& at) const {
        for (std::size_t k = start; k < flats.size(); ++k) {
            const Feature other = contact(flats[k].patch);
            if (flats[k].is_point ? at.are_one_place(flats[k].low, point.low)
                                  : at.outside(other, point.low) == 0 && at.is_between(other, flats[k].low, flats[k].high, point.low))
                return true;
        }
        return std::any_of(ridges.begin(), ridges.end(), [&](const RoundRidge& r) {
            const bool is_first = rounded(r.from) == point.rank;
            if (!(is_first || (r.from <= point.rank && point.rank <= r.to) || (point.rank == 0 && r.to == angles.last))) return false;
            const Spot end = at.spot(contact(r.patch), r.curve, is_first);
            return !end.jumps && at.are_one_place(end, point.low);
        });
    }

    // --- the list ---

    // Patch of a surface.
    Index patch_of(const Feature& surface) const {
        for (Index p = first_patch[surface.obstacle]; p < first_patch[surface.obstacle + 1]; ++p)
            if (contact(p) == surface) return p;
        throw std::logic_error("an angle on no patch");
    }

    IsolatedParts list() const {
        IsolatedParts result;
        const auto put = [&](Index patch, int chart, const Feature& first, const Feature& last, Index from, Index to) {
            const CriticalAngle x = angles.critical(from, chart), y = angles.critical(to, chart);
            const auto event = [](const CriticalAngle& e) { return Event{e.first, e.second, e.lo, e.hi}; };
            result.parts.push_back({patch, chart, first, last, event(x), event(y), x.place, y.place});
            result.from_patch.push_back(x.is_chart_end() ? patch : patch_of(x.on().contact));
            result.to_patch.push_back(y.is_chart_end() ? patch : patch_of(y.on().contact));
        };
        const auto put_ends = [&](const Spot& first, Index from, const Spot& last, Index to, int chart) {
            result.lower_patch.push_back(patch_of(first.on)), result.upper_patch.push_back(patch_of(last.on));
            result.first_t.push_back(junction(from, chart).value(first.on, first));
            result.last_t.push_back(junction(to, chart).value(last.on, last));
        };
        for (const RoundRidge& r : ridges) {
            put(r.patch, r.chart, r.curve, r.curve, r.from, r.to);
            const Feature own = contact(r.patch);
            put_ends(junction(r.from, r.chart).spot(own, r.curve, true), r.from, junction(r.to, r.chart).spot(own, r.curve, false), r.to, r.chart);
        }
        for (const RoundFlat& f : flats) {
            put(f.patch, chart_of(f.rank), f.low.curve, f.high.curve, f.rank, f.rank);
            put_ends(f.low, f.rank, f.high, f.rank, chart_of(f.rank));
        }
        return result;
    }

    const Scene& scene;
    const Patches& patches;
    const Trapezoids &live, &thin;
    const Index first_fit;  // among the rows, of those without width that trimming does not give
    const int threads;
    const std::vector<Index> first_patch;
    const Trapezoids rows;  // trapezoids, then parts without width
    const AngleTable angles;
    const Index live_count;
    const std::vector<Box> boxes;  // of the rows
    const BoxTree tree;            // of the trapezoids
    std::vector<RoundRidge> ridges;
    std::vector<RoundFlat> flats;
};

}  // namespace

IsolatedParts isolated_round_parts(const Scene& scene, const Patches& patches, const Trapezoids& live, const Trapezoids& thin, int threads) {
    Trapezoids all = thin;
    add_fits_of_arcs(scene, patches, threads, all);
    if (all.size() == 0) return {};
    return RoundFinder(scene, patches, live, all, thin.size(), threads).run();
}

}  // namespace cfree
