// Live region of a patch: subtract bands, keep parts without width; theory, "The trimmed boundary".
#include "cfree/forbidden/trim.hpp"

#include <algorithm>
#include <limits>

#include "cfree/forbidden/critical_angle.hpp"
#include "cfree/predicates/junction.hpp"

namespace cfree {

void TrimLists::clear() {
    constexpr std::size_t most_slots = 256;
    for (auto* areas : {&live, &next, &open, &thin, &fresh}) areas->clear();
    events.clear(), curves.clear(), pinches.clear(), todo.clear();
    if (slots.size() > most_slots) slots.clear();
    std::fill(slots.begin(), slots.end(), -1);
}

Trimmer::Trimmer(const Scene& s, const Surface& on, const Event& from, const Event& to, TrimLists lists)
    : TrimLists(std::move(lists)), decide(s, on), scene(s), surface(on), ends{end_helix(s, on.contact, 0), end_helix(s, on.contact, 1)} {
    clear();
    events.push_back(from), events.push_back(to);
    fill();
}

void Trimmer::fill() {
    const Index t0 = curve_of(ends[0], false), t1 = curve_of(ends[1], false);
    live.push_back({0, 1, t0, t1, 0, 1});
}

Index Trimmer::intern(const Event& event) {
    events.push_back(event);
    return static_cast<Index>(events.size()) - 1;
}

// --- curves ----------------------------------------------------------------------------------------------------------

// Name a curve that is an end of the surface, t = 0 or t = 1, by identity of features, as that helix.
Feature Trimmer::normal_form(const Feature& f) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const auto touches = [](const Shape& s, Index e, Index v) {
        return s.point[s.v[e]] == s.point[v] || s.point[s.w[e]] == s.point[v];
    };
    for (const Feature& helix : ends) {
        const bool through = f.kind == Kind::vertex_edge
                                 ? A.point[f.robot] == A.point[helix.robot] && touches(O, f.obstacle, helix.obstacle)
                                 : O.point[f.obstacle] == O.point[helix.obstacle] && touches(A, f.robot, helix.robot);
        if (through) return helix;
    }
    return f;
}

// Look up a curve in a hash table at least twice as large as its content.
Index Trimmer::curve_of(const Feature& f, bool flipped) {
    const Code c = code(scene, f);
    const auto place = [&](Code of, bool is_flipped) {
        return static_cast<std::size_t>((of + is_flipped) * 0x9e3779b97f4a7c15u >> 20) & (slots.size() - 1);
    };
    const auto after = [&](std::size_t slot) { return (slot + 1) & (slots.size() - 1); };
    if (2 * curves.size() >= slots.size()) {
        slots.assign(std::max<std::size_t>(64, 4 * slots.size()), -1);
        for (std::size_t k = 0; k < curves.size(); ++k) {
            std::size_t slot = place(curves[k].code, curves[k].flipped);
            while (slots[slot] >= 0) slot = after(slot);
            slots[slot] = static_cast<Index>(k);
        }
    }
    std::size_t slot = place(c, flipped);
    for (; slots[slot] >= 0; slot = after(slot))
        if (curves[slots[slot]].code == c && curves[slots[slot]].flipped == flipped) return slots[slot];
    slots[slot] = static_cast<Index>(curves.size());
    Curve curve = decide.curve(f);
    if (flipped) curve.N = -curve.N, curve.D = -curve.D, curve.flipped = true;
    curves.push_back(curve);
    return slots[slot];
}

// Bound of t between two angles: of N / D, a rational Bezier function, by its control values, and two ulps outwards for the
// division and the sums.
double Trimmer::extreme(const Curve& c, double lo, double hi, bool want_max) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double best = want_max ? -infinity : infinity;
    const double knots[3][2] = {{lo, lo}, {lo, hi}, {hi, hi}};
    for (const auto& k : knots) {
        const double n = c.N.polar(k[0], k[1]), d = c.D.polar(k[0], k[1]);
        if (!(d > c.D.err)) return want_max ? infinity : -infinity;
        if (want_max) best = std::max(best, n + c.N.err > 0 ? (n + c.N.err) / (d - c.D.err) : (n + c.N.err) / (d + c.D.err));
        else best = std::min(best, n - c.N.err > 0 ? (n - c.N.err) / (d + c.D.err) : (n - c.N.err) / (d - c.D.err));
    }
    return best + (want_max ? 1 : -1) * std::abs(best) * 0x1p-50;
}

void Trimmer::bounds(Area& area) const {
    const double lo = events[area.from].lo, hi = events[area.to].hi;
    area.t_min = extreme(curves[area.lower], lo, hi, false), area.t_max = extreme(curves[area.upper], lo, hi, true);
}

void Slices::cut(double lo, double hi, int chart) {
    constexpr double widest = 0.125;
    kappa = chart ? -1 : 1;
    count = std::clamp(1 + static_cast<int>((hi - lo) / widest), 1, most);
    at[0] = lo, at[count] = hi;  // avoid likely critical angles: halves and quarters
    for (int s = 1; s < count; ++s) at[s] = lo + (s - 0.375) * ((hi - lo) / (count - 0.375));
    std::fill(low, low + count, 0.0), std::fill(high, high + count, 1.0);
}

void Trimmer::left(Slices& slices) {
    if (!has_changed) return;
    has_changed = false;
    for (int s = 0; s < slices.count; ++s) slices.low[s] = 1, slices.high[s] = 0;
    for (const auto* areas : {&live, &thin})
        for (const Area& x : *areas) {
            const double from = events[x.from].lo, to = events[x.to].hi;
            for (int s = 0; s < slices.count; ++s) {
                const double lo = std::max(from, slices.at[s]), hi = std::min(to, slices.at[s + 1]);
                if (lo > hi) continue;
                slices.low[s] = std::min(slices.low[s], std::max(0.0, extreme(curves[x.lower], lo, hi, false)));
                slices.high[s] = std::max(slices.high[s], std::min(1.0, extreme(curves[x.upper], lo, hi, true)));
            }
        }
}

// Along the line, t grows: it enters by an edge with D > 0 and leaves by one with D < 0.
void Trimmer::find_curves(State& state) {
    const Feature l = normal_form(state.lower.feature), u = normal_form(state.upper.feature);
    state.curves[0] = curve_of(l, false), state.curves[1] = curve_of(u, u.kind != Kind::vertex_vertex);
}

void Trimmer::add_band(const State& state, const Span& span, Index p, Index k) {
    Area band{span.from, span.to, state.curves[0], state.curves[1], 0, 1};
    bounds(band);
    if (band.t_max < 0 || band.t_min > 1) return;
    take({band, p, k, &state});
}

void Trimmer::cede(const Feature& owner, const Event& from, const Event& to) {
    const auto tighter = [&](Index end, const Event& other, int later) {
        return decide.order(other, events[end]) * later > 0 ? intern(other) : end;
    };
    const bool of_obstacles = owner.kind == Kind::vertex_edge;
    const Shape& shape = of_obstacles ? scene.obstacles : scene.robot;
    const Index theirs = of_obstacles ? owner.obstacle : owner.robot, own = of_obstacles ? surface.contact.obstacle : surface.contact.robot;
    const bool backwards = shape.line[theirs] != shape.line[own] && dot(edge<Int>(shape, theirs), edge<Int>(shape, own)).sign() < 0;
    const Feature first = end_helix(scene, owner, backwards ? 1 : 0), last = end_helix(scene, owner, backwards ? 0 : 1);
    Area band{tighter(0, from, 1), tighter(1, to, -1), curve_of(first, false), curve_of(last, false), 0, 1};
    if (!before(band.from, band.to)) return;
    bounds(band);
    take({band, -1, -1, nullptr});
}

void Trimmer::split(const Feature& helix) {
    const Index t = curve_of(helix, false);
    Area seam{0, 1, t, t, 0, 1};
    bounds(seam);
    subtract_from_live({seam, -1, -1, nullptr});
}

// True if the band covers the inside of its segment at this one of its angles.
bool Trimmer::covers_at(const Band& band, Index event) {
    if (band.state == nullptr) return true;
    const bool inside = before(band.area.from, event) && before(event, band.area.to);
    return inside || crosses_at(band, event);
}

// True if the line passes through the open pillar at an end of the band: there are vertices on both its sides.
bool Trimmer::crosses_at(const Band& band, Index event) {
    const Event& e = events[event];
    const PillarEdge &l = band.state->lower, &u = band.state->upper;
    const auto certain = [&](Index s, Index v) { return Predicates::sign_on(decide.offset(s, v), e.lo, e.hi); };
    if ((certain(l.s0, l.v0) > 0 || certain(u.s1, u.v1) > 0) && (certain(l.s1, l.v1) < 0 || certain(u.s0, u.v0) < 0)) return true;
    Junction here(scene, surface.chart, e.lo, e.hi, [&] { return decide.narrow_root_of(e); }, [&] { return decide.narrowed(e); });
    bool left = false, right = false;
    const Shape &A = scene.robot, &O = scene.obstacles;
    for (Index x = A.piece[band.p]; x < A.piece[band.p + 1]; ++x)
        for (Index y = O.piece[band.k]; y < O.piece[band.k + 1] && !(left && right); ++y) {
            if (lies_on_line(A.piece_vertex[x], O.piece_vertex[y])) continue;
            const int side = here.side(surface.contact, A.piece_vertex[x], O.piece_vertex[y]);
            left |= side > 0, right |= side < 0;
        }
    return left && right;
}

int Trimmer::order_at(Index event, Index p, Index q) {
    if (curves[p].code == curves[q].code) return 0;
    const Event& e = events[event];
    if (const int certain = decide.order_on(curves[p], curves[q], e.lo, e.hi)) return certain;
    Junction here(scene, surface.chart, e.lo, e.hi, [&] { return decide.narrow_root_of(e); }, [&] { return decide.narrowed(e); });
    const Feature& on = surface.contact;
    if (e.first.kind != Kind::none) here.know(CriticalAngle(surface, e, 0).name(scene));
    return here.order(on, here.spot(on, curves[p].feature), here.spot(on, curves[q].feature));
}

// --- live region -----------------------------------------------------------------------------------------------------

void Trimmer::subtract(const Band& taken) {
    if (!thin.empty()) subtract_from_thin(taken), has_changed = true;
    fresh.clear();
    subtract_from_live(taken);
    thin.insert(thin.end(), fresh.begin(), fresh.end());
}

void Trimmer::subtract_from_live(const Band& taken) {
    std::size_t first = 0;
    while (first < live.size() && !may_meet(live[first], taken.area)) ++first;
    if (first == live.size()) return;
    next.assign(live.begin(), live.begin() + static_cast<std::ptrdiff_t>(first));
    for (std::size_t k = first; k < live.size(); ++k) {
        if (may_meet(live[k], taken.area) && subtract_from(live[k], taken)) has_changed = true;
        else next.push_back(live[k]);
    }
    live.swap(next);
}

// End open areas at an angle, except those that continue; the others begin there. After a tip, with width zero, all are new.
void Trimmer::go_on(Index at, std::initializer_list<std::array<Index, 2>> parts, bool after_tip) {
    const std::size_t old = open.size();
    for (const auto& [lower, upper] : parts) {
        Area part{at, at, lower, upper, 0, 1};
        for (std::size_t k = 0; k < old && !after_tip; ++k)
            if (open[k].lower == lower && open[k].upper == upper) part.from = open[k].from, open[k].from = -1;
        open.push_back(part);
    }
    for (std::size_t k = 0; k < old; ++k) {
        if (open[k].from < 0) continue;
        open[k].to = at;
        bounds(open[k]);
        next.push_back(open[k]);
    }
    open.erase(open.begin(), open.begin() + static_cast<std::ptrdiff_t>(old));
}

// Subtract a band from an area; false if nothing is subtracted.
//
// Between two cuts the four orders are constant: all of the area stays, or its parts below and above the band.
bool Trimmer::subtract_from(const Area& area, const Band& taken) {
    Overlap x(area, taken);
    if (!compare(x)) return false;
    sort_cuts(x);
    open.clear();
    if (x.from != area.from) go_on(area.from, {{area.lower, area.upper}}, false);
    Cover last{};
    for (int k = 0;;) {
        const Index start = k == 0 ? x.from : x.cuts[k - 1].event, end = k == x.cuts.size() ? x.to : x.cuts[k].event;
        const Cover cover{x.sign(Overlap::lower_to_upper) < 0 && x.sign(Overlap::upper_to_lower) > 0,
                          x.sign(Overlap::lower_to_lower) < 0, x.sign(Overlap::upper_to_upper) > 0};
        keep_around(x, start, cover);
        if (taken.state != nullptr) {
            keep_touched_curves(x, start, end, cover);
            if (k > 0) keep_at(x, start, &last, &cover);
            else if (x.from == area.from) keep_at(x, start, nullptr, &cover);
        }
        last = cover;
        if (k == x.cuts.size()) break;
        // go on to the next angle, over all cuts there
        x.low_meets = x.high_meets = false;
        do {
            x.low_meets |= x.cuts[k].which == Overlap::lower_to_lower, x.high_meets |= x.cuts[k].which == Overlap::upper_to_upper;
            ++x.position[x.cuts[k].which], ++k;
        } while (k < x.cuts.size() && equal(x.cuts[k].event, x.cuts[k - 1].event));
    }
    if (taken.state != nullptr && x.to == area.to) keep_at(x, x.to, &last, nullptr);
    if (x.to != area.to) go_on(x.to, {{area.lower, area.upper}}, false);
    go_on(area.to, {}, false);
    return true;
}

bool Trimmer::may_meet(const Area& area, const Area& band) const {
    return band.t_max >= area.t_min && band.t_min <= area.t_max && events[area.to].hi >= events[band.from].lo &&
           events[area.from].lo <= events[band.to].hi;
}

// Find the common angles and the four orders there; false if the band certainly covers nothing of the area.
bool Trimmer::compare(Overlap& x) {
    const Area &area = x.area, &band = x.band.area;
    x.from = before(area.from, band.from) ? band.from : area.from;
    x.to = before(band.to, area.to) ? band.to : area.to;
    if (!before(x.from, x.to)) return false;
    const auto order = [&](Overlap::Which which, const Area::Side& p, const Area::Side& q) {
        Predicates::Order& result = x.orders[which];
        if (p.max < q.min || q.max < p.min) result.sign[0] = p.max < q.min ? -1 : 1, result.strict = true;
        else result = decide.compare(curves[p.curve], curves[q.curve], events[x.from], events[x.to]);
        return result.at.empty() ? result.sign[0] : 2;
    };
    if (const int s = order(Overlap::lower_to_upper, band.low(), area.high()); s == 0 || s == 1) return false;
    if (order(Overlap::upper_to_lower, band.high(), area.low()) <= 0) return false;
    order(Overlap::lower_to_lower, band.low(), area.low());
    order(Overlap::upper_to_upper, band.high(), area.high());
    return true;
}

// Sort the changes of the four orders into one list.
void Trimmer::sort_cuts(Overlap& x) {
    for (int w = 0; w < 4; ++w) {
        for (const Event& at : x.orders[w].at) {
            const Overlap::Cut cut{intern(at), w};
            int k = x.cuts.size();
            while (k > 0 && before(cut.event, x.cuts[k - 1].event)) --k;
            x.cuts.insert(k, cut);
        }
    }
}

// Continue from an angle on with all of the area, or with its parts below and above the band.
void Trimmer::keep_around(const Overlap& x, Index start, const Cover& cover) {
    const Area &area = x.area, &band = x.band.area;
    const bool below = x.sign(Overlap::lower_to_lower) > 0, above = x.sign(Overlap::upper_to_upper) < 0;
    if (!cover.inside) go_on(start, {{area.lower, area.upper}}, false);
    else if (below && above) go_on(start, {{area.lower, band.lower}, {band.upper, area.upper}}, x.low_meets || x.high_meets);
    else if (below) go_on(start, {{area.lower, band.lower}}, x.low_meets);
    else if (above) go_on(start, {{band.upper, area.upper}}, x.high_meets);
    else go_on(start, {}, false);
}

// Keep curves of a covered area that are the band's own: bands are open, so these curves are free.
void Trimmer::keep_touched_curves(const Overlap& x, Index start, Index end, const Cover& cover) {
    if (!cover.inside) return;
    const auto keep = [&](Overlap::Which which, Index end_of_band, Index curve) {
        if (x.sign(which) != 0) return;
        if (goes_on_beyond(end_of_band)) stretch(start, end);
        else add_thin(start, end, curve, curve);
    };
    keep(Overlap::lower_to_lower, x.band.area.lower, x.area.lower), keep(Overlap::upper_to_upper, x.band.area.upper, x.area.upper);
}

// Keep the parts without width that the band leaves of the area at an angle between two covered parts, or at the end of one.
void Trimmer::keep_at(const Overlap& x, Index at, const Cover* before_it, const Cover* after_it) {
    const Area &area = x.area, &band = x.band.area;
    for (const Cover* c : {before_it, after_it})
        if (c != nullptr && !c->inside) return;
    if (!covers_at(x.band, at)) return add_thin(at, at, area.lower, area.upper);
    const auto both = [&](bool Cover::*which) {
        return (before_it == nullptr || before_it->*which) && (after_it == nullptr || after_it->*which);
    };
    const bool is_end = before_it == nullptr || after_it == nullptr;
    const auto meets = [&](Overlap::Which w, Index p, Index q) {
        return is_end && !x.orders[w].strict && order_of_end(at, p, q, w == Overlap::lower_to_lower ? -1 : 1) == 0;
    };
    if (both(&Cover::low) && ((!is_end && x.low_meets) || meets(Overlap::lower_to_lower, band.lower, area.lower)))
        add_thin(at, at, area.lower, area.lower);
    if (both(&Cover::high) && ((!is_end && x.high_meets) || meets(Overlap::upper_to_upper, band.upper, area.upper)))
        add_thin(at, at, area.upper, area.upper);
}

// --- parts without width ---------------------------------------------------------------------------------------------

void Trimmer::subtract_from_thin(const Band& taken) {
    fresh.clear();
    for (const Area& x : thin) {
        if (x.from == x.to) subtract_from_segment(x, taken);
        else subtract_from_curve(x, taken);
    }
    thin.swap(fresh);
}

// Keep what a band leaves of a piece of the line, or of a point: the parts below and above it, and ends that it only touches.
void Trimmer::subtract_from_segment(const Area& segment, const Band& taken) {
    const Area& band = taken.area;
    const Index at = segment.from, lower = segment.lower, upper = segment.upper;
    if (before(at, band.from) || before(band.to, at) || !covers_at(taken, at) || order_of_end(at, band.lower, upper, -1) >= 0 ||
        order_of_end(at, band.upper, lower, 1) <= 0) {
        fresh.push_back(segment);
        return;
    }
    const int low = order_of_end(at, band.lower, lower, -1), high = order_of_end(at, band.upper, upper, 1);
    if (low > 0) add_thin(at, at, lower, band.lower);
    if (high < 0) add_thin(at, at, band.upper, upper);
    if (taken.state == nullptr) return;
    if (low == 0) add_thin(at, at, lower, lower);
    if (high == 0) add_thin(at, at, upper, upper);
}

// Keep all of a curve if the band is at other angles, else the pieces between cuts that the band leaves.
void Trimmer::subtract_from_curve(const Area& curve, const Band& taken) {
    CurveOverlap x(curve, taken);
    if (!compare(x)) {
        fresh.push_back(curve);
        return;
    }
    sort_cuts(x);
    keep_pieces(x);
}

// Set the angles where both are and the two orders there; false if there are no such angles.
bool Trimmer::compare(CurveOverlap& x) {
    const Area &curve = x.curve, &band = x.band.area;
    x.from = before(curve.from, band.from) ? band.from : curve.from;
    x.to = before(band.to, curve.to) ? band.to : curve.to;
    if (!before(x.from, x.to)) return false;
    const auto order = [&](Index p, int beyond) {
        Predicates::Order by_places = decide.compare(curves[p], curves[curve.lower], events[x.from], events[x.to]);
        if (!goes_on_beyond(p)) return by_places;
        if (by_places.is(0)) stretch(x.from, x.to);
        Predicates::Order always;
        always.sign[0] = beyond, always.strict = true;
        return always;
    };
    x.low = order(band.lower, -1), x.high = order(band.upper, 1);
    return true;
}

// Put the changes of the two orders into one list.
void Trimmer::sort_cuts(CurveOverlap& x) {
    using Cut = CurveOverlap::Cut;
    for (const Event& e : x.low.at) x.cuts.push_back({intern(e), true});
    for (const Event& e : x.high.at) x.cuts.push_back({intern(e), false});
    std::stable_sort(x.cuts.begin(), x.cuts.end(), [&](const Cut& p, const Cut& q) { return before(p.event, q.event); });
}

// Go on to the next angle, over all cuts that are there.
Index Trimmer::pass_cuts(CurveOverlap& x) {
    const Index at = x.cuts[x.next].event;
    do (x.cuts[x.next].is_low ? x.low_position : x.high_position) += 1, ++x.next;
    while (x.next < x.cuts.size() && equal(x.cuts[x.next].event, at));
    return at;
}

// Keep the pieces of the curve that are not covered, and points between two covered pieces or at the curve's ends.
void Trimmer::keep_pieces(CurveOverlap& x) {
    const Area& curve = x.curve;
    const bool is_open = x.band.state != nullptr;
    const auto add = [&](Index from, Index to) { add_thin(from, to, curve.lower, curve.lower); };
    Index start = curve.from;  // start of the piece that is kept
    bool keeps = x.from != curve.from, was_covered = false;
    for (Index at = x.from;; at = pass_cuts(x)) {
        const bool is_covered = x.is_covered();
        if (is_covered && keeps) add(start, at);
        if (!is_covered && !keeps) start = at;
        if (is_covered && !keeps && is_open && (was_covered || leaves_point(x, at))) add(at, at);
        keeps = !is_covered, was_covered = is_covered;
        if (x.next == x.cuts.size()) break;
    }
    if (was_covered && x.to == curve.to && is_open && leaves_point(x, x.to)) add(x.to, x.to);
    if (x.to != curve.to && was_covered) start = x.to;
    if (x.to != curve.to || keeps) add(start, curve.to);
}

// True if the curve's point at this angle, an end of a covered piece, is outside the open band or on its border.
bool Trimmer::leaves_point(const CurveOverlap& x, Index event) {
    const Area& band = x.band.area;
    return !covers_at(x.band, event) || order_of_end(event, band.lower, x.curve.lower, -1) == 0 ||
           order_of_end(event, band.upper, x.curve.lower, 1) == 0;
}

// --- what is left ----------------------------------------------------------------------------------------------------

// Neither surface goes on where free space is pinched between two.
void Trimmer::cut_at(Index event) {
    const std::size_t count = live.size();
    for (std::size_t k = 0; k < count; ++k) {
        if (!before(live[k].from, event) || !before(event, live[k].to)) continue;
        Area rest = live[k];
        rest.from = live[k].to = event;
        live.push_back(rest);
    }
}

void Trimmer::finish(Index patch, std::vector<Trapezoid>& out, std::vector<Trapezoid>& thin_out) {
    // join neighbours along theta that have the same curves
    for (std::size_t k = 0; k < live.size(); ++k) {
        for (std::size_t l = 0; l < live.size();) {
            const bool same = l != k && live[l].lower == live[k].lower && live[l].upper == live[k].upper;
            if (same && equal(live[k].to, live[l].from) && order_at(live[k].to, live[k].lower, live[k].upper) != 0) {
                live[k].to = live[l].to;
                live.erase(live.begin() + static_cast<std::ptrdiff_t>(l));
                if (l < k) --k;
                l = 0;
            } else {
                ++l;
            }
        }
    }
    for (const Index pinch : pinches) cut_at(pinch);
    // order by angle, then upwards
    std::sort(live.begin(), live.end(), [&](const Area& x, const Area& y) {
        if (!equal(x.from, y.from)) return before(x.from, y.from);
        return x.t_min < y.t_min;
    });
    const auto put = [&](const std::vector<Area>& areas, std::vector<Trapezoid>& into) {
        for (const Area& x : areas)
            into.push_back({patch, surface.chart, curves[x.lower].feature, curves[x.upper].feature, events[x.from],
                            events[x.to], decide.place(events[x.from]), decide.place(events[x.to])});
    };
    put(live, out), put(thin, thin_out);
}

}  // namespace cfree
