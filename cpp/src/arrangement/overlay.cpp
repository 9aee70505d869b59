// Cut areas of a patch by bands; theory, "Arrangement".
#include "arrangement/overlay.hpp"

#include <algorithm>

#include "cfree/forbidden/critical_angle.hpp"
#include "cfree/predicates/junction.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

void Overlay::begin() {
    has_begun = true;
    for (const Area& area : live) pieces.push_back({area, 0, false});
    for (const Touch& at : touches) touch(at);
}

void Overlay::start(Index of) {
    pair = of;
    for (Piece& x : pieces) x.is_in = false;
}

void Overlay::take(const Band& band) {
    if (!has_begun) return subtract(band);
    if (!cut(band, false, [&](const Piece& x) { return with(x.holders, &Holders::around); })) return;
    for (const Index end : {band.area.from, band.area.to})
        if (!crosses_at(band, end)) grazed.push_back(end);
}

// Pass a state: if the nearest vertex of a pillar stays on the line, the pillar touches the surface along that helix.
void Overlay::pass(const State& state, const Span& span) {
    if (lies_on_line(state.s, state.v) || !vanishes(state.s, state.v)) return;
    const Touch at{span, curve_of({Kind::vertex_vertex, state.s, state.v}, false)};
    if (has_begun) touch(at);
    else touches.push_back(at);
}

// A vertex touches the surface in one point, and leaves it again. A curve through that point makes it a corner.
void Overlay::meet(const State& state, Index event) {
    const bool on_edge = surface.contact.kind == Kind::vertex_edge;
    for (const Index around : on_edge ? state.obstacle_around : state.robot_around) {
        if (around < 0) continue;
        const Feature through = on_edge ? Feature{Kind::vertex_edge, state.s, around} : Feature{Kind::edge_vertex, around, state.v};
        const auto& direction = on_edge ? scene.obstacles.direction : scene.robot.direction;
        if (direction[around] == direction[on_edge ? surface.contact.obstacle : surface.contact.robot]) continue;
        if (!before(event, 1)) return;
        const Touch at{{event, 1}, named(through, decide.between(events[event], events[1]))};
        if (has_begun) touch(at);
        else touches.push_back(at);
        return;
    }
}

bool Overlay::vanishes(Index s, Index v) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = surface.contact.robot, j = surface.contact.obstacle;
    if (surface.contact.kind == Kind::vertex_edge ? A.point[s] != A.point[i] : O.point[v] != O.point[j]) return false;
    return decide.vanishes({Kind::vertex_vertex, s, v}, {});
}

void Overlay::touch(const Touch& at) {
    Area area{at.span.from, at.span.to, at.curve, at.curve, 0, 1};
    bounds(area);
    if (area.t_max < 0 || area.t_min > 1) return;
    cut({area, -1, -1, nullptr}, true, [](const Piece& x) { return x.holders; });
}

void Overlay::share(const Trapezoid& other, With how) {
    const auto angle = [&](const Event& event, int place) { return place == 0 ? event : decide.restored(event, place); };
    const auto tighter = [&](Index own, const Event& event, int later) {
        return decide.order(event, events[own]) * later > 0 ? intern(event) : own;
    };
    const Index from = tighter(0, angle(other.from, other.from_place), 1), to = tighter(1, angle(other.to, other.to_place), -1);
    if (!before(from, to)) return;
    const Sample at = decide.between(events[from], events[to]);
    Feature lower = other.lower, upper = other.upper;
    if (decide.order_at(lower, upper, at) > 0) std::swap(lower, upper);
    Area area{from, to, named(lower, at), named(upper, at), 0, 1};
    bounds(area);
    const Band band{area, -1, -1, nullptr};
    if (how == With::ceded) cut(band, false, [](const Piece&) { return -1; });
    else cut(band, false, [&](const Piece& x) {
        return with(x.holders, how == With::same ? &Holders::same : &Holders::opposite);
    });
}

// Curve of a feature on this surface, with a positive denominator at the sample.
Index Overlay::named(const Feature& feature, const Sample& at) {
    const Feature f = feature.kind == Kind::vertex_vertex ? feature : normal_form(feature);
    return curve_of(f, f.kind != Kind::vertex_vertex && decide.denominator_sign(f, at) < 0);
}

Index Overlay::with(Index holders, std::vector<Index> Holders::* list) {
    const Index which = list == &Holders::around ? 0 : list == &Holders::same ? 1 : 2;
    const auto [at, is_new] = added.try_emplace({holders, pair, which}, static_cast<Index>(all.size()));
    if (is_new) {
        Holders more = all[static_cast<std::size_t>(holders)];
        auto& into = more.*list;
        if (const auto place = std::lower_bound(into.begin(), into.end(), pair); place == into.end() || *place != pair)
            into.insert(place, pair);
        all.push_back(std::move(more));
    }
    return at->second;
}

// Give parts inside the band the result of `into`: holders, or -1 to remove them. Along a curve areas are only cut. False if
// nothing changes.
template <class Into>
bool Overlay::cut(const Band& band, bool along_curve, Into&& into) {
    heed_stop();
    cut_up.clear();
    std::vector<Bit> bits;
    for (const Piece& x : pieces) {
        if ((x.is_in && !along_curve) || !split(x, band, along_curve, bits)) cut_up.push_back(x);
    }
    const bool has_changed_any = cut_up.size() != pieces.size() ||
                                 std::any_of(cut_up.begin(), cut_up.end(), [](const Piece& x) { return x.holders < 0; });
    pieces.swap(cut_up);
    for (Piece& x : pieces)
        if (x.holders < 0) x.holders = into(Piece{x.area, -1 - x.holders, true});
    std::erase_if(pieces, [](const Piece& x) { return x.holders < 0; });
    return has_changed_any;
}

// Record points at which a curve of the band meets one of the piece without crossing it.
void Overlay::note_touch(const Overlap& x) {
    const Area &area = x.area, &band = x.band.area;
    const Index pairs_of[4][2] = {{band.lower, area.upper}, {band.upper, area.lower}, {band.lower, area.lower}, {band.upper, area.upper}};
    for (int w = 0; w < 4; ++w) {
        const Predicates::Order& order = x.orders[w];
        const auto [p, q] = pairs_of[w];
        if (order.sign[0] == 0) continue;  // one curve, or not computed
        for (const Event& at : order.at)
            if (at.is_touch) touched.push_back(intern(at));
        if (order.strict) continue;
        for (const Index end : {x.from, x.to})
            if (before(area.from, end) && before(end, area.to) && order_at(end, p, q) == 0) touched.push_back(end);
    }
}

// Add the parts of a piece to `cut_up`, parts inside the band with negated holders. False if the band does not meet it.
bool Overlay::split(const Piece& piece, const Band& band, bool along_curve, std::vector<Bit>& open_bits) {
    const Area &area = piece.area, &of = band.area;
    Overlap x(area, band);
    const bool meets = may_meet(area, of) && compare(x);
    if (x.to >= 0 && before(x.from, x.to)) note_touch(x);
    if (!meets) return false;
    sort_cuts(x);
    open_bits.clear();
    if (x.from != area.from) open_bits.push_back({area.from, area.lower, area.upper, false});
    const auto go_on_with = [&](Index at, std::initializer_list<Bit> parts, unsigned tips) {
        const std::size_t old = open_bits.size();
        for (Bit bit : parts) {
            const bool is_tip = (tips >> Overlap::lower_to_lower & 1 && bit.lower == area.lower && bit.upper == of.lower) ||
                                (tips >> Overlap::upper_to_upper & 1 && bit.lower == of.upper && bit.upper == area.upper) ||
                                (tips >> Overlap::lower_to_upper & 1 && bit.lower == of.lower && bit.upper == area.upper) ||
                                (tips >> Overlap::upper_to_lower & 1 && bit.lower == area.lower && bit.upper == of.upper);
            for (std::size_t k = 0; k < old && !is_tip; ++k) {
                Bit& was = open_bits[k];
                if (was.from >= 0 && was.lower == bit.lower && was.upper == bit.upper && was.is_in == bit.is_in)
                    bit.from = was.from, was.from = -1;
            }
            open_bits.push_back(bit);
        }
        for (std::size_t k = 0; k < old; ++k) {
            const Bit& was = open_bits[k];
            if (was.from < 0) continue;
            Area part{was.from, at, was.lower, was.upper, 0, 1};
            bounds(part);
            cut_up.push_back({part, was.is_in ? -1 - piece.holders : piece.holders, was.is_in || piece.is_in});
        }
        open_bits.erase(open_bits.begin(), open_bits.begin() + static_cast<std::ptrdiff_t>(old));
    };
    unsigned tips = 0;
    for (int k = 0;;) {
        const Index at = k == 0 ? x.from : x.cuts[k - 1].event;
        const bool below = x.sign(Overlap::lower_to_lower) > 0, above = x.sign(Overlap::upper_to_upper) < 0;
        const Bit low{at, area.lower, of.lower, false}, high{at, of.upper, area.upper, false};
        const Bit inside{at, below ? of.lower : area.lower, above ? of.upper : area.upper, true};
        if (along_curve ? !(below && above) : x.sign(Overlap::lower_to_upper) >= 0 || x.sign(Overlap::upper_to_lower) <= 0)
            go_on_with(at, {{at, area.lower, area.upper, false}}, tips);
        else if (along_curve) go_on_with(at, {low, high}, tips);
        else if (below && above) go_on_with(at, {low, inside, high}, tips);
        else if (below) go_on_with(at, {low, inside}, tips);
        else if (above) go_on_with(at, {inside, high}, tips);
        else go_on_with(at, {inside}, tips);
        if (k == x.cuts.size()) break;
        tips = 0;  // go on to the next angle, over all cuts there
        do tips |= 1u << x.cuts[k].which, ++x.position[x.cuts[k].which], ++k;
        while (k < x.cuts.size() && equal(x.cuts[k].event, x.cuts[k - 1].event));
    }
    if (x.to != area.to) go_on_with(x.to, {{x.to, area.lower, area.upper, false}}, 0);
    go_on_with(area.to, {}, 0);
    return true;
}

// Join neighbours along theta with the same curves and holders, unless a pillar just touches the line between them.
void Overlay::join() {
    const auto is_grazed = [&](Index event) {
        return std::any_of(grazed.begin(), grazed.end(), [&](Index other) { return equal(event, other); });
    };
    const auto key = [](const Piece& x) { return std::array{x.holders, x.area.lower, x.area.upper}; };
    std::sort(pieces.begin(), pieces.end(), [&](const Piece& x, const Piece& y) {
        return key(x) != key(y) ? key(x) < key(y) : before(x.area.from, y.area.from);
    });
    std::size_t count = 0;
    for (const Piece& x : pieces) {
        Area* last = count > 0 && key(pieces[count - 1]) == key(x) ? &pieces[count - 1].area : nullptr;
        if (last != nullptr && equal(last->to, x.area.from) && !is_grazed(last->to) && order_at(last->to, last->lower, last->upper) != 0)
            last->to = x.area.to;
        else
            pieces[count++] = x;
    }
    pieces.resize(count);
}

void Overlay::cut_at_angle(Index event) {
    const std::size_t count = pieces.size();
    for (std::size_t k = 0; k < count; ++k) {
        if (!before(pieces[k].area.from, event) || !before(event, pieces[k].area.to)) continue;
        Piece rest = pieces[k];
        rest.area.from = pieces[k].area.to = event;
        pieces.push_back(rest);
    }
}

void Overlay::put_own(std::vector<Trapezoid>& out) {
    std::vector<Trapezoid> thin_out;
    finish(0, out, thin_out);
}

void Overlay::put(Index patch, std::vector<Trapezoid>& out, std::vector<Holders>& holders) {
    join();
    for (const auto* list : {&pinches, &touched})
        for (const Index event : *list) cut_at_angle(event);
    std::sort(pieces.begin(), pieces.end(), [&](const Piece& x, const Piece& y) {
        if (!equal(x.area.from, y.area.from)) return before(x.area.from, y.area.from);
        return x.area.t_min != y.area.t_min ? x.area.t_min < y.area.t_min : x.area.t_max < y.area.t_max;
    });
    for (const Piece& x : pieces) {
        const Area& a = x.area;
        out.push_back({patch, surface.chart, curves[a.lower].feature, curves[a.upper].feature, events[a.from], events[a.to],
                       decide.place(events[a.from]), decide.place(events[a.to])});
        holders.push_back(all[static_cast<std::size_t>(x.holders)]);
    }
}

}  // namespace cfree
