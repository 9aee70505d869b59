// Isolate roots, at which signs change, in doubles, then in balls, then exactly; theory, "Degrees".
#include <stdexcept>

#include "predicates/isolation.hpp"
#include "predicates/round_orders.hpp"

namespace cfree {

// Interval around a simple root near its double, with certain, opposite signs.
std::optional<std::array<double, 2>> straddling(const Coefficients<Ball>& p, double t) {
    double delta = 2 * u * std::max(1.0, std::abs(t));
    for (int k = 0; k < 32 && std::isfinite(t); ++k, delta *= 2) {
        const auto below = sign_at(p, t - delta), above = sign_at(p, t + delta);
        if (!below || !above || *below * *above == 0) continue;
        if (*below != *above) return {{t - delta, t + delta}};
        break;
    }
    return {};
}

// Isolate all roots of a quadratic with a certain discriminant: one that counts twice, or two in disjoint intervals with sign
// changes. False if their places are not certain.
bool isolate_quadratic(const Coefficients<Ball>& p, const Ball& discriminant, Brackets& found) {
    const auto leading = certain_sign(p.c[2]);
    if (!leading || *leading == 0) return false;
    const double A = p.c[2].hi, B = 0.5 * p.c[1].hi, C = p.c[0].hi;
    if (certain_sign(discriminant) == 0) {
        const auto root = straddling(derivative(p), -B / A);
        if (root) found.push_back(*root);
        return root.has_value();
    }
    const double s = 0.5 * std::sqrt(discriminant.hi), q = B > 0 ? -(B + s) : s - B;
    const auto first = straddling(p, q / A), second = straddling(p, C / q);
    if (!first || !second) return false;
    const bool in_order = (*first)[1] < (*second)[0];
    if (!in_order && !((*second)[1] < (*first)[0])) return false;
    found.push_back(in_order ? *first : *second), found.push_back(in_order ? *second : *first);
    return true;
}

// Roots of a quadratic, whose touch is the root of its derivative; or of a quartic with simple roots: multiple ones are
// divided out exactly.
std::optional<Predicates::Candidates> Predicates::roots_by_balls(const Feature& first, const Feature& second, double lo,
                                                                 double hi) const {
    const auto p = coefficients<Ball>(first, second);
    Candidates result;
    result.all_zero = true;
    for (int i = 0; i < p.count; ++i) result.all_zero &= certain_sign(p.c[i]) == 0;
    if (result.all_zero) return result;
    Brackets found;
    if (p.count > 3) {
        if (!isolate_around(Balls(p), lo, hi, found) || !are_narrow(found)) return {};
        for (const auto& [below, above] : found) result.at.push_back({first, second, below, above});
        return result;
    }
    const Ball discriminant = p.c[1] * p.c[1] - Ball(4.0) * (p.c[0] * p.c[2]);
    const auto sign = certain_sign(discriminant);
    if (!sign) return {};
    if (*sign < 0) return result;
    if (!isolate_quadratic(p, discriminant, found) || !are_narrow(found)) {
        found = {};
        if (!isolate_around(Balls(*sign == 0 ? derivative(p) : p), lo, hi, found) || !are_narrow(found)) return {};
    }
    for (const auto& [below, above] : found) result.at.push_back({first, second, below, above, -1, *sign == 0});
    return result;
}

bool Predicates::isolates(const Event& x, int place) const {
    if (place == 0 && x.lo < x.hi) {
        const Form f = form(x);
        int sign[5];
        f.signs(x.lo, x.hi, sign);
        if (roots_inside(sign, f.degree) == Found::one) return true;
    }
    const Poly p = polynomial(x.first, x.second);
    if (p.size() < 2) return false;
    const Sturm sturm(squarefree(p));
    const Dyadic lo = Dyadic::from(x.lo), hi = Dyadic::from(x.hi);
    const auto is_root = [&](const Dyadic& t) { return cfree::sign_at(sturm.polynomial(), t) == 0; };
    if (place > 0) return sturm.roots_in(lo, hi) >= place;
    return x.lo == x.hi ? is_root(lo) : !is_root(lo) && !is_root(hi) && sturm.roots_in(lo, hi) == 1;
}

Predicates::Candidates Predicates::roots_exactly(const Feature& first, const Feature& second, double lo, double hi) {
    Candidates result;
    const Poly p = polynomial(first, second);
    result.all_zero = p.empty();
    if (p.empty() || (p.size() == 3 && p[1] * p[1] < 4 * p[0] * p[2])) return result;
    const Poly simple = primitive(squarefree(p));  // so that digits do not depend on the common denominator
    const auto is_touch = [&](const Dyadic& below, const Dyadic& above) {
        if (simple.size() == p.size()) return false;
        RealRoot root{simple, below, above};
        return sign_before(p, root) == sign_after(p, root);
    };
    Brackets found;
    // simple quartics have just been tried
    if ((p.size() <= 3 || simple.size() < p.size()) && isolate_around(Balls(simple), lo, hi, found) && are_narrow(found)) {
        const bool may_touch = simple.size() < p.size();
        for (const auto& [l, h] : found)  // between certain signs: no root is at an end
            result.at.push_back({first, second, l, h, -1, may_touch && cfree::sign_at(p, Dyadic::from(l)) == cfree::sign_at(p, Dyadic::from(h))});
        return result;
    }
    const Sturm sturm(simple);
    const Dyadic lowest = Dyadic::from(std::nextafter(lo, -2)), highest = Dyadic::from(std::nextafter(hi, 2));
    for (auto [below, above] : isolate(sturm, lowest, highest, 56)) {
        const auto sign = [&](const Dyadic& t) { return cfree::sign_at(sturm.polynomial(), t); };
        while (sign(below) == 0) {  // the root before this one
            const Dyadic mid = Dyadic::middle(below, above);
            (sturm.roots_in(mid, above) == 1 ? below : above) = mid;
        }
        double l = below.rounded_down(), h = above.rounded_up();
        if (sign(above) == 0) below = above;
        // doubles around it, with no root at their ends; a finer interval if there is a second one between them
        while (sign(Dyadic::from(l)) == 0) l = std::nextafter(l, -2);
        while (sign(Dyadic::from(h)) == 0) h = std::nextafter(h, 2);
        Event x{first, second, l, h, -1, is_touch(below, above)};
        if (sturm.roots_in(Dyadic::from(l), Dyadic::from(h)) != 1) {
            x.fine = static_cast<Index>(fine.size());
            fine.push_back({below, above});
        }
        result.at.push_back(x);
    }
    return result;
}

Predicates::Roots Predicates::roots(const Form& f, const Feature& first, const Feature& second, const Event& from,
                                    const Event& to) {
    Candidates all;
    Brackets found;
    bool is_around = true;  // all roots a little beyond the two angles are known
    const bool is_isolated = scene.is_round ? round_orders().isolate(first, second, from.lo, to.hi, found)
                                            : isolate_around(f, from.lo, to.hi, found) || double_only;
    if (is_isolated) {
        ++counters.filter;
        for (const auto& [below, above] : found) all.at.push_back({first, second, below, above});
    } else {
        all = settled(counters, [&]<class T>() -> std::optional<Candidates> {
            if constexpr (std::is_same_v<T, Ball>) return roots_by_balls(first, second, from.lo, to.hi);
            is_around = false;
            return scene.is_round ? roots_exactly_round(first, second, from.lo, to.hi) : roots_exactly(first, second, from.lo, to.hi);
        });
    }
    Roots result;
    result.all_zero = all.all_zero;
    const double outside = from.lo - 0.5 * margin;
    for (const Event& x : all.at) {
        is_around &= x.hi < outside || outside < x.lo;
        if (order(from, x) < 0) {
            if (order(x, to) < 0) result.at.push_back(x);
        } else if (x.lo > outside && !x.is_touch) {
            ++result.passed;
        }
    }
    if (is_around) result.outside = outside;
    return result;
}

Predicates::Roots Predicates::offset_roots(Index s, Index v, const Filtered& f, const Event& from, const Event& to) {
    return roots(Form{{2, f, {}, {}, {}}}, {Kind::vertex_vertex, s, v}, {}, from, to);
}

// Surfaces that share a helix cross where the helix meets the line, and where their own lines are parallel.
Predicates::Roots Predicates::crossings(const Form& f, const Feature& p, const Feature& q, const Event& from,
                                        const Event& to) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    if (p.kind == Kind::vertex_vertex || q.kind == Kind::vertex_vertex) return roots(f, p, q, from, to);
    if (p.kind == Kind::edge_vertex && q.kind == Kind::vertex_edge) return crossings(f, q, p, from, to);
    const auto end_of = [](const Shape& s, Index vertex, Index e) {
        return s.point[vertex] == s.point[s.v[e]] || s.point[vertex] == s.point[s.w[e]];
    };
    const auto shared_end = [&](const Shape& s, Index e, Index g) {
        return end_of(s, s.v[e], g) ? s.v[e] : end_of(s, s.w[e], g) ? s.w[e] : -1;
    };
    Index a = -1, b = -1;
    if (p.kind != q.kind) {  // v-e and e-v
        if (end_of(A, p.robot, q.robot) && end_of(O, q.obstacle, p.obstacle)) a = p.robot, b = q.obstacle;
    } else if (p.kind == Kind::vertex_edge) {
        if (A.point[p.robot] == A.point[q.robot]) a = p.robot, b = shared_end(O, p.obstacle, q.obstacle);
    } else if (O.point[p.obstacle] == O.point[q.obstacle]) {
        a = shared_end(A, p.robot, q.robot), b = p.obstacle;
    }
    if (a < 0 || b < 0) return roots(f, p, q, from, to);
    // one line both ways is one curve
    const bool on_one_line = p.kind == q.kind && (p.kind == Kind::vertex_edge ? O.direction[p.obstacle] == O.direction[q.obstacle]
                                                                             : A.direction[p.robot] == A.direction[q.robot]);
    if (on_one_line) return {{}, true};
    Roots result = offset_roots(a, b, offset(a, b), from, to);
    if (result.all_zero || p.kind == q.kind) return result;
    const Roots parallel = parallel_roots(q.robot, p.obstacle, from, to);
    for (const Event& x : parallel.at) {
        int at = result.at.size();
        while (at > 0 && order(x, result.at[at - 1]) < 0) --at;
        if (at == 0 || order(x, result.at[at - 1]) != 0) result.at.insert(at, x);
        else result.alternates = false;
    }
    result.outside = {};
    return result;
}

Predicates::Order Predicates::compare(const Curve& p, const Curve& q, const Event& from, const Event& to) {
    Order result;
    const auto constant = [&](int s) {
        result.sign[0] = s;
        return result;
    };
    if (p.code == q.code) return ++counters.identity, constant(0);
    if (scene.is_round) return compare_round(p.feature, q.feature, from, to);
    const Form f = form(p, q);
    int each[5];
    f.signs(from.lo, to.hi, each);
    const int first = each[0], last_sign = each[f.degree], inside = each[1];
    if (inside != 0 && std::all_of(each + 1, each + f.degree, [&](int s) { return s == inside; })) {
        result.strict = first == inside && last_sign == inside;
        if (result.strict) return ++counters.filter, constant(inside);
        // a root that is known at an end is the only one there, as in `sign_between`
        const auto cross_at = [&](const Event& e) {
            if (e.first.kind == Kind::none || e.second.kind == Kind::none) return false;
            const Code x = code(scene, e.first), y = code(scene, e.second);
            return (x == p.code && y == q.code) || (x == q.code && y == p.code);
        };
        if ((first == inside || cross_at(from)) && (last_sign == inside || cross_at(to))) return ++counters.identity, constant(inside);
    }
    const Roots r = crossings(f, p.feature, q.feature, from, to);
    if (r.all_zero) return constant(0);
    const int flip = p.flipped != q.flipped ? -1 : 1, last = r.at.size();
    const auto sign_here = [&](const Sample& at) {
        const auto value = f.at(at.tau);
        return flip * sign_at(flip * value.v, value.err, p.feature, q.feature, at);
    };
    const auto before = [&](int k) -> const Event& { return k == 0 ? from : r.at[k - 1]; };
    const auto after = [&](int k) -> const Event& { return k == last ? to : r.at[k]; };
    const auto sign_of = [&](int k) {
        for (int attempt = 0; attempt < most_attempts; ++attempt)  // a sample may be where the curves touch
            if (const int sign = sign_here(between(before(k), after(k), attempt))) return sign;
        throw std::logic_error("two different curves are equal at every sample");
    };
    result.at = r.at;
    if (!r.alternates) {
        for (int k = 0; k <= last; ++k) result.sign[k] = sign_of(k);
        return result;
    }
    // one sample, where angles are far apart
    const auto gap = [&](int k) { return after(k).lo - before(k).hi; };
    int known = 0;
    for (int k = 1; k <= last; ++k)
        if (gap(k) > gap(known)) known = k;
    if (gap(known) < narrow && r.outside) {
        known = 0;
        result.sign[0] = sign_here({*r.outside, {}}) * (r.passed % 2 == 0 ? 1 : -1);
    }
    if (result.sign[known] == 0) result.sign[known] = sign_of(known);
    const auto across = [&](int k) { return r.at[k].is_touch ? 1 : -1; };
    for (int k = known; k > 0; --k) result.sign[k - 1] = across(k - 1) * result.sign[k];
    for (int k = known; k < last; ++k) result.sign[k + 1] = across(k) * result.sign[k];
    return result;
}

bool Predicates::are_limits(const Feature& lower, const Feature& upper, const Event& from, const Event& to) {
    const Sample middle = between(from, to);
    const auto limit = [&](const Feature& f) -> std::optional<Curve> {  // needs D > 0
        Curve result = curve(f);
        const Feature& on = surface.contact;
        if (f.kind != Kind::vertex_vertex && f.kind != on.kind) {
            const bool on_edge = on.kind == Kind::vertex_edge;
            if (!parallel_roots(on_edge ? f.robot : on.robot, on_edge ? on.obstacle : f.obstacle, from, to).at.empty()) return {};
        }
        const int sign = cfree::sign_at(polynomial(curve_trig<Int>(scene, surface.contact, f)[1]), middle.exact());
        if (sign < 0) result.N = -result.N, result.D = -result.D, result.flipped = true;
        return sign == 0 ? std::nullopt : std::optional(result);
    };
    const auto ordered = [&](const std::optional<Curve>& p, const std::optional<Curve>& q) {
        if (!p || !q) return false;
        const Order found = compare(*p, *q, from, to);
        return std::all_of(found.sign, found.sign + found.at.size() + 1, [](int s) { return s <= 0; });
    };
    const auto low = limit(lower), high = limit(upper);
    return ordered(limit(end_helix(scene, surface.contact, 0)), low) && ordered(low, high) &&
           ordered(high, limit(end_helix(scene, surface.contact, 1)));
}

}  // namespace cfree
