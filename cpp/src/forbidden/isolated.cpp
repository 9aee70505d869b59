// List parts without width that are on no trapezoid, each once; theory, "Exact fits".
#include "cfree/forbidden/isolated.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "cfree/forbidden/critical_angle.hpp"
#include "cfree/forbidden/curve_hashes.hpp"
#include "cfree/predicates/junction.hpp"
#include "cfree/support/elementary.hpp"
#include "collision/shape_boxes.hpp"
#include "forbidden/patch_trimming.hpp"
#include "support/parallel.hpp"

namespace cfree {

namespace {

// End of a segment, with the patch whose surface names its curve.
struct End {
    Spot spot;
    Index patch;
};
// Part at one angle, from low to high along the line of a patch's surface. A point has low = high.
struct Flat {
    Index patch;
    CriticalAngle angle;
    Index angle_patch;
    End low, high;
    bool is_point;
};
// Curve on a patch's surface between two angles.
struct Ridge {
    Index patch;
    Feature curve;
    CriticalAngle from, to;
    Index from_patch, to_patch;
};

class Finder {
public:
    Finder(const Scene& s, const Patches& p, const Trapezoids& l, const Trapezoids& t)
        : scene(s), patches(p), live(l), thin(t),
          hashes(s, t.patch.size(), [&](std::size_t k) { return NamedCurve{contact(t.patch[k]), unpacked(t.lower[k])}; }, 1),
          tree(edge_boxes(s.obstacles)), reach(reach_of(s.robot)), first_patch(first_patches(s, p)) {
        first_live.assign(p.kind.size() + 1, 0);
        for (const Index k : l.patch) ++first_live[k + 1];
        std::partial_sum(first_live.begin(), first_live.end(), first_live.begin());
    }

    IsolatedParts run(int threads, std::atomic<bool>& stop) {
        const auto count = static_cast<Index>(thin.patch.size());
        std::vector<std::vector<Flat>> found_flats(count);
        std::vector<std::vector<Ridge>> found_ridges(count);
        std::atomic<Index> next{0};
        const auto work = [&] {
            Near near;
            for (Index k = next++; k < count && !stop; k = next++) {
                const CriticalAngle from = angle_from(patches, thin, k), to = angle_to(patches, thin, k);
                const Index patch = thin.patch[k];
                const Feature lower = unpacked(thin.lower[k]), upper = unpacked(thin.upper[k]);
                if (order(scene, from, to) == 0) found_flats[k] = flats_of(patch, {from, to}, lower, upper, near);
                else found_ridges[k] = ridges_of({patch, lower, from, to, patch, patch}, hashes[k], near);
            }
        };
        in_parallel(std::min(threads, count / 64 + 1), stop, work);
        for (const auto& found : found_flats) flats.insert(flats.end(), found.begin(), found.end());
        unite_ridges(found_ridges);
        unite_flats();
        return list();
    }

private:
    Feature contact(Index patch) const { return patches.contact(patch); }
    Junction junction(const CriticalAngle& angle) const {
        return {scene, angle.chart(), angle.lo, angle.hi, [&] { return angle.exact(scene); }, [&] { return angle.bracket(scene); }};
    }

    // Patches with live trapezoids whose obstacle feature is within twice the robot's reach of another; cached for repeats.
    struct Near {
        Index obstacle = -1;
        std::vector<Index> list;
    };
    const std::vector<Index>& patches_near(Index patch, Near& near) const {
        const Index obstacle = patches.obstacle[patch];
        if (near.obstacle == obstacle) return near.list;
        near.obstacle = obstacle, near.list.clear();
        tree.query(grown(edge_box(scene.obstacles, obstacle), 2 * reach), [&](Index j) {
            for (Index p = first_patch[j]; p < first_patch[j + 1]; ++p)
                if (first_live[p] < first_live[p + 1]) near.list.push_back(p);
        });
        return near.list;
    }

    // True if a trapezoid reaches an angle, ends included; chart ends are in both charts.
    bool may_reach(Index k, const CriticalAngle& at) const {
        if (live.chart[k] == at.chart()) return live.to_hi[k] >= at.lo && live.from_lo[k] <= at.hi;
        return at.is_chart_end() && (at.lo > 0 ? live.from_hi[k] == -1 : live.to_lo[k] == 1);
    }
    bool reaches(Index k, const CriticalAngle& at) const {
        if (!may_reach(k, at)) return false;
        if (live.chart[k] != at.chart() || (live.from_hi[k] < at.lo && live.to_lo[k] > at.hi)) return true;
        return order(scene, angle_from(patches, live, k), at) <= 0 && order(scene, at, angle_to(patches, live, k)) <= 0;
    }

    // --- at one angle ---

    // Parts of a trapezoid that begins and ends at one angle, of two names.
    std::vector<Flat> flats_of(Index patch, const std::array<CriticalAngle, 2>& names, const Feature& lower, const Feature& upper,
                               Near& near) const {
        const CriticalAngle& angle = names[0];
        Junction at = junction(angle);
        for (const CriticalAngle& name : names) know(at, scene, name);
        const Feature own = contact(patch);
        Spot low = at.spot(own, lower), high = at.spot(own, upper);
        const bool is_point = at.order(own, low, high) == 0;
        const Interval on_low = at.reading(own, low).t, on_high = at.reading(own, high).t;
        std::vector<Flat> left{{patch, angle, patch, {low, patch}, {high, patch}, is_point}}, next;
        const auto take_away = [&](Index p, Index k, const Feature& other, int along) {
            if (!reaches(k, angle)) return;
            End first{at.spot(other, unpacked(live.lower[k])), p}, last{at.spot(other, unpacked(live.upper[k])), p};
            if (along == 0) {  // a point, and a line across
                const Spot here{own};
                if (at.order(other, first.spot, here) <= 0 && at.order(other, here, last.spot) <= 0) left.clear();
                return;
            }
            if (along < 0) std::swap(first, last);
            next.clear();
            for (const Flat& f : left) {
                const int a = at.order(own, first.spot, f.high.spot), b = at.order(own, last.spot, f.low.spot);
                if (is_point ? a > 0 || b < 0 : a >= 0 || b <= 0) {
                    next.push_back(f);
                } else if (!is_point) {
                    if (at.order(own, f.low.spot, first.spot) < 0)
                        next.push_back({f.patch, f.angle, f.angle_patch, f.low, first, false});
                    if (at.order(own, last.spot, f.high.spot) < 0)
                        next.push_back({f.patch, f.angle, f.angle_patch, last, f.high, false});
                }
            }
            left.swap(next);
        };
        // no place of the other surface is beside a place between low and high
        const auto is_beyond = [&](const Feature& other) {
            const Interval x = at.beside(own, end_helix(scene, other, 0)), y = at.beside(own, end_helix(scene, other, 1));
            return std::max(x.hi, y.hi) < std::min(on_low.lo, on_high.lo) || std::min(x.lo, y.lo) > std::max(on_low.hi, on_high.hi);
        };
        for (const Index p : patches_near(patch, near)) {
            Index k = first_live[p];
            const Index end = first_live[p + 1];
            while (k < end && !may_reach(k, angle)) ++k;
            if (k == end) continue;
            const Feature other = contact(p);
            if (is_beyond(other)) continue;
            const int along = at.parallel(own, other);
            if (along != 0 ? at.side(own, other) != 0 : !is_point || at.side(other, own, low) != 0) continue;
            for (; k < end; ++k) {
                take_away(p, k, other, along);
                if (left.empty()) return left;
            }
        }
        for (Flat& f : left)  // the end of one chart is the start of the other
            if (angle.is_chart_end() && angle.chart() == 1) f.angle = CriticalAngle(0, angle.lo > 0 ? -1 : 1);
        return left;
    }

    // --- along theta ---

    std::vector<Ridge> ridges_of(const Ridge& whole, const CurveHash& hash, Near& near) const {
        std::vector<Ridge> left{whole}, next;
        const NamedCurve curve{contact(whole.patch), whole.curve};
        const auto may_meet = [&](Index k) {
            return live.chart[k] == whole.from.chart() && live.to_hi[k] >= whole.from.lo && live.from_lo[k] <= whole.to.hi;
        };
        const auto take_away = [&](Index p, Index k) {
            for (const auto& [from, to] : stays_in(k, contact(p), curve)) {
                next.clear();
                for (const Ridge& r : left) {
                    if (order(scene, to, r.from) <= 0 || order(scene, r.to, from) <= 0) {
                        next.push_back(r);
                        continue;
                    }
                    if (order(scene, r.from, from) < 0) next.push_back({r.patch, r.curve, r.from, from, r.from_patch, p});
                    if (order(scene, to, r.to) < 0) next.push_back({r.patch, r.curve, to, r.to, p, r.to_patch});
                }
                left.swap(next);
            }
        };
        for (const Index p : patches_near(whole.patch, near)) {
            Index k = first_live[p];
            const Index end = first_live[p + 1];
            while (k < end && !may_meet(k)) ++k;
            if (k == end || !hashes.may_lie_on(contact(p), hash) || !lies_on(scene, curve, contact(p))) continue;
            for (; k < end; ++k) {
                if (may_meet(k)) take_away(p, k);
                if (left.empty()) return left;
            }
        }
        return left;
    }

    // Intervals of angles in which a curve on the surface of trapezoid k is in it.
    std::vector<std::pair<CriticalAngle, CriticalAngle>> stays_in(Index k, const Feature& on, const NamedCurve& curve) const {
        const Feature c = code(scene, on) == code(scene, curve.other) ? curve.on : curve.other;
        const Feature lower = unpacked(live.lower[k]), upper = unpacked(live.upper[k]);
        const Surface surface{on, live.chart[k]};
        Predicates here(scene, surface);
        const Event from = angle_from(patches, live, k).event(here), to = angle_to(patches, live, k).event(here);
        std::vector<Event> events{from, to};
        const auto add = [&](const Predicates::Order& order) { events.insert(events.end(), order.at.begin(), order.at.end()); };
        add(here.compare(here.curve(lower), here.curve(c), from, to)), add(here.compare(here.curve(upper), here.curve(c), from, to));
        if (c.kind != Kind::vertex_vertex && c.kind != on.kind) {  // excludes angles without a place on the surface
            const auto roots = on.kind == Kind::vertex_edge ? here.parallel_roots(c.robot, on.obstacle, from, to)
                                                            : here.parallel_roots(on.robot, c.obstacle, from, to);
            events.insert(events.end(), roots.at.begin(), roots.at.end());
        }
        std::sort(events.begin(), events.end(), [&](const Event& x, const Event& y) { return here.order(x, y) < 0; });
        const auto angle = [&](const Event& x) { return CriticalAngle(surface, x, here.place(x)); };
        std::vector<std::pair<CriticalAngle, CriticalAngle>> result;
        for (std::size_t e = 0; e + 1 < events.size(); ++e) {
            if (here.order(events[e], events[e + 1]) == 0) continue;
            const Sample at = here.between(events[e], events[e + 1]);
            if (here.order_at(lower, c, at) <= 0 && here.order_at(c, upper, at) <= 0)
                result.push_back({angle(events[e]), angle(events[e + 1])});
        }
        return result;
    }

    // --- each once ---

    void unite_ridges(const std::vector<std::vector<Ridge>>& found) {
        // the first thin trapezoid on each curve; one hash may be of several
        std::map<CurveHash, std::vector<std::size_t>> curves;
        std::vector<std::pair<std::size_t, Ridge>> named;
        const auto name = [&](std::size_t k) { return NamedCurve{contact(thin.patch[k]), unpacked(thin.lower[k])}; };
        for (std::size_t k = 0; k < found.size(); ++k) {
            if (found[k].empty()) continue;
            auto& firsts = curves[hashes[k]];
            auto first = std::find_if(firsts.begin(), firsts.end(),
                                      [&](std::size_t x) { return is_same_curve(scene, name(x), name(k)); });
            if (first == firsts.end()) first = firsts.insert(first, k);
            for (const Ridge& r : found[k]) named.emplace_back(*first, r);
        }
        std::stable_sort(named.begin(), named.end(), [&](const auto& x, const auto& y) {
            if (x.first != y.first) return x.first < y.first;
            if (x.second.from.chart() != y.second.from.chart()) return x.second.from.chart() < y.second.from.chart();
            return order(scene, x.second.from, y.second.from) < 0;
        });
        for (std::size_t k = 0; k < named.size(); ++k) {
            const Ridge& r = named[k].second;
            if (k > 0 && named[k].first == named[k - 1].first && r.from.chart() == ridges.back().from.chart() &&
                order(scene, r.from, ridges.back().to) <= 0) {
                if (order(scene, ridges.back().to, r.to) < 0) ridges.back().to = r.to, ridges.back().to_patch = r.to_patch;
            } else {
                ridges.push_back(r);
            }
        }
    }

    void unite_flats() {
        std::stable_sort(flats.begin(), flats.end(), [&](const Flat& x, const Flat& y) {
            if (x.angle.chart() != y.angle.chart()) return x.angle.chart() < y.angle.chart();
            const int o = order(scene, x.angle, y.angle);
            return o != 0 ? o < 0 : x.is_point < y.is_point;
        });
        std::vector<Flat> kept;
        for (std::size_t begin = 0, end; begin < flats.size(); begin = end) {
            for (end = begin + 1; end < flats.size() && flats[end].angle.chart() == flats[begin].angle.chart() &&
                                  order(scene, flats[end].angle, flats[begin].angle) == 0;)
                ++end;
            Junction at = junction(flats[begin].angle);
            const std::size_t start = kept.size();
            for (std::size_t k = begin; k < end; ++k) {
                if (flats[k].is_point ? !is_listed(flats[k], kept, start, at) : true) add(flats[k], kept, start, at);
            }
        }
        flats.swap(kept);
    }

    // Add a segment, united with those of its line that it meets.
    void add(Flat f, std::vector<Flat>& kept, std::size_t start, Junction& at) {
        for (std::size_t k = start; k < kept.size() && !f.is_point;) {
            const Feature own = contact(f.patch), other = contact(kept[k].patch);
            const int along = at.parallel(own, other);
            End low = kept[k].low, high = kept[k].high;
            if (along < 0) std::swap(low, high);
            if (along == 0 || at.side(own, other) != 0 || at.order(own, low.spot, f.high.spot) > 0 ||
                at.order(own, high.spot, f.low.spot) < 0) {
                ++k;
                continue;
            }
            if (at.order(own, low.spot, f.low.spot) < 0) f.low = low;
            if (at.order(own, high.spot, f.high.spot) > 0) f.high = high;
            kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(k));
            k = start;
        }
        kept.push_back(f);
    }

    bool is_listed(const Flat& point, const std::vector<Flat>& kept, std::size_t start, Junction& at) const {
        const Feature own = contact(point.patch);
        const Spot &p = point.low.spot, crossing{own};
        // the point as a place on another line
        const auto place_on = [&](const Feature& other) { return at.parallel(own, other) != 0 ? p : crossing; };
        for (std::size_t k = start; k < kept.size(); ++k) {
            const Feature other = contact(kept[k].patch);
            if (at.side(other, own, p) != 0) continue;
            const Spot here = place_on(other);
            if (at.order(other, kept[k].low.spot, here) <= 0 && at.order(other, here, kept[k].high.spot) <= 0) return true;
        }
        const CriticalAngle& angle = point.angle;
        for (const Ridge& r : ridges) {
            if (r.from.chart() == angle.chart() ? order(scene, angle, r.from) < 0 || order(scene, r.to, angle) < 0
                                                : !angle.is_chart_end() || (angle.lo > 0 ? r.from.hi != -1 : r.to.lo != 1))
                continue;
            const Feature other = contact(r.patch);
            if (at.side(other, own, p) == 0 && at.order(other, place_on(other), at.spot(other, r.curve)) == 0) return true;
        }
        return false;
    }

    IsolatedParts list() const {
        IsolatedParts result;
        const auto put = [&](Index patch, const Feature& lower, const Feature& upper, const CriticalAngle& from,
                             const CriticalAngle& to) {
            const auto event = [](const CriticalAngle& x) { return Event{x.first, x.second, x.lo, x.hi}; };
            result.parts.push_back({patch, from.chart(), lower, upper, event(from), event(to), from.place, to.place});
        };
        const auto put_ends = [&](const CriticalAngle& from, const End& first, const CriticalAngle& to, const End& last) {
            result.lower_patch.push_back(first.patch), result.upper_patch.push_back(last.patch);
            result.first_t.push_back(junction(from).value(contact(first.patch), first.spot));
            result.last_t.push_back(junction(to).value(contact(last.patch), last.spot));
        };
        for (const Ridge& r : ridges) {
            const Feature own = contact(r.patch);
            put(r.patch, r.curve, r.curve, r.from, r.to);
            put_ends(r.from, {junction(r.from).spot(own, r.curve), r.patch}, r.to, {junction(r.to).spot(own, r.curve), r.patch});
            result.from_patch.push_back(r.from_patch), result.to_patch.push_back(r.to_patch);
        }
        for (const Flat& f : flats) {
            const End& high = f.is_point ? f.low : f.high;
            put(f.patch, f.low.spot.curve, high.spot.curve, f.angle, f.angle);
            put_ends(f.angle, f.low, f.angle, high);
            result.from_patch.push_back(f.angle_patch), result.to_patch.push_back(f.angle_patch);
        }
        return result;
    }

    const Scene& scene;
    const Patches& patches;
    const Trapezoids &live, &thin;
    CurveHashes hashes;
    BoxTree tree;
    double reach;  // the robot's
    std::vector<Index> first_patch, first_live;
    std::vector<Flat> flats;
    std::vector<Ridge> ridges;
};

}  // namespace

IsolatedParts isolated_parts(const Scene& scene, const Patches& patches, const Trapezoids& live, const Trapezoids& thin,
                             int threads, std::atomic<bool>& stop) {
    return Finder(scene, patches, live, thin).run(threads, stop);
}

}  // namespace cfree
