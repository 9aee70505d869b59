// Orders of curves and of angles where shapes are grown: in intervals, in balls, exactly; theory, "Rounded shapes".
#include <algorithm>
#include <stdexcept>
#include <vector>

#include "predicates/isolation.hpp"
#include "predicates/round_orders.hpp"

namespace cfree {

const RoundOrders& Predicates::round_orders() const {
    if (!made_orders) made_orders = std::make_unique<const RoundOrders>(scene, surface);
    return *made_orders;
}

// Roots in the interval and a little beyond it, where certain signs in balls do not suffice.
Predicates::Candidates Predicates::roots_exactly_round(const Feature& first, const Feature& second, double lo, double hi) {
    Candidates result;
    const NormedPoly& form = round_orders().exactly(first, second);
    result.all_zero = form.norm.empty();
    if (result.all_zero) return result;
    constexpr unsigned digits = 56;  // a few more than a double has
    for (SurdRoot& root : roots_between(form, Dyadic::from(std::nextafter(lo, -2)), Dyadic::from(std::nextafter(hi, 2)))) {
        while (!root.at.is_dyadic() && root.at.digits() < digits) root.at.narrow();
        const double below = root.at.lo.rounded_down(), above = root.at.hi.rounded_up();
        Event x{first, second, below, above, static_cast<Index>(fine.size()), !root.changes_sign};
        fine.push_back({root.at.lo, root.at.hi});
        result.at.push_back(x);
    }
    return result;
}

int Predicates::event_sign(const Feature& first, const Feature& second, const Sample& at) {
    if (!at.fine)
        if (const int sign = round_orders().sign(first, second, at.tau); sign != 0) return ++counters.filter, sign;
    return settled(counters, [&]<class T>() -> std::optional<int> {
        if constexpr (std::is_same_v<T, Ball>) return cfree::sign_at(coefficients<Ball>(first, second), at.ball());
        else return cfree::sign_at(round_orders().exactly(first, second).p, at.exact());
    });
}
Predicates::Roots Predicates::event_roots(const Feature& first, const Feature& second, const Event& from, const Event& to) {
    return roots({}, first, second, from, to);
}

int Predicates::event_sign_on(const Feature& first, const Feature& second, double lo, double hi) const {
    if (const int sign = round_orders().sign_on(first, second, lo, hi); sign != 0) return sign;
    constexpr double wide = 0x1p-30;  // balls then rarely decide: there is a root near an end
    if (hi - lo > wide) return 0;
    const Balls p(coefficients<Ball>(first, second));
    int sign[7];
    p.signs(lo, hi, sign);
    return common_sign(sign, p.degree);
}

LongRoot Predicates::long_root_of(const Event& x) const {
    if (x.fine < 0 && x.lo < x.hi) return round_orders().root_between(x.first, x.second, x.lo, x.hi);
    const Dyadic lo = x.fine >= 0 ? fine[x.fine][0] : Dyadic::from(x.lo), hi = x.fine >= 0 ? fine[x.fine][1] : Dyadic::from(x.hi);
    if (cfree::compare(lo, hi) == 0) return {LongPoly{-lo.n, Int(1) << lo.k}, lo, hi};
    auto roots = roots_between(round_orders().exactly(x.first, x.second), lo, hi);
    if (roots.size() != 1) throw std::logic_error("an angle is not the only root in its interval");
    return roots[0].at;
}

// All roots of an event's polynomial in its interval of doubles, ends included.
std::vector<SurdRoot> Predicates::roots_around(const Event& x) const {
    return roots_between(round_orders().exactly(x.first, x.second), Dyadic::from(std::nextafter(x.lo, -2)),
                         Dyadic::from(std::nextafter(x.hi, 2)));
}

// True if a root is in an interval that holds one root of its polynomial. Intervals of neighbours may overlap: the sign tells them
// apart, as each root is the only one in its own.
static bool is_within(const LongRoot& x, const Dyadic& lo, const Dyadic& hi) {
    const Dyadic from = cfree::compare(x.lo, lo) < 0 ? lo : x.lo, to = cfree::compare(x.hi, hi) < 0 ? x.hi : hi;
    return cfree::compare(from, to) <= 0 && cfree::sign_at(x.p, from) * cfree::sign_at(x.p, to) <= 0;
}

int Predicates::place_round(const Event& x) const {
    const auto roots = roots_around(x);
    const auto& [lo, hi] = fine[x.fine];
    for (std::size_t k = 0; k < roots.size(); ++k)
        if (is_within(roots[k].at, lo, hi)) return static_cast<int>(k) + 1;
    throw std::logic_error("an angle is not among the roots of its polynomial");
}
Event Predicates::restored_round(Event x, int place) {
    const auto roots = roots_around(x);
    if (place > static_cast<int>(roots.size())) throw std::logic_error("an angle has a place among fewer roots");
    const LongRoot& root = roots[static_cast<std::size_t>(place - 1)].at;
    x.fine = static_cast<Index>(fine.size());
    fine.push_back({root.lo, root.hi});
    return x;
}

// Sense of a line in which it is parallel to another one of its kind at every angle; 0 if it is not, or if doubles do not tell.
static int sense_along(const Scene& scene, const Feature& f, const Feature& g) {
    if (!is_line(f) || f.kind != g.kind) return 0;
    const bool of_robot = f.kind == Kind::edge_vertex;
    const Shape& s = of_robot ? scene.robot : scene.obstacles;
    const Index e = of_robot ? f.robot : f.obstacle, other = of_robot ? g.robot : g.obstacle;
    if (s.direction[e] != s.direction[other]) return 0;
    const Approx along = dot(close_edge<Approx>(s, e), close_edge<Approx>(s, other));
    return std::abs(along.v) > coefficient_error * along.m ? (along.v > 0 ? 1 : -1) : 0;
}

// Name of an angle at which parallel lines become one, each the surface's or smooth with a circle that it touches there: on a line
// the other line, on a circle the line, with the side of the touch.
static std::optional<Feature> touch_of_parallels(const Scene& scene, const Feature& on, const Event& e) {
    const auto side = [&](const Feature& circle, int sense) {  // of the circle's joint, seen from the line
        const double r = RoundSurfaces<Approx>(scene).rho(circle).v;
        return r > 0 ? -sense : r < 0 ? sense : 0;
    };
    if (is_circle(on)) {
        for (const auto& [line, joint] : {std::pair{&e.first, &e.second}, std::pair{&e.second, &e.first}}) {
            const int sense = sense_along(scene, *line, *joint);
            if (sense == 0 || !is_smooth(scene, *joint, on)) continue;
            Feature result = *line;
            result.branch = static_cast<std::int8_t>(side(on, sense));
            return result.branch != 0 ? std::optional(result) : std::nullopt;
        }
        return {};
    }
    const auto bare = [](Feature line) {
        line.branch = 0;
        return line;
    };
    if (is_line(e.first) && is_circle(e.second) && !is_center(e.second) && is_smooth(scene, e.first, e.second) && sense_along(scene, e.first, on) != 0)
        return bare(e.first);
    if (!is_circle(e.first) || e.second.kind != Kind::none) return {};
    const bool of_robot = on.kind == Kind::edge_vertex;
    const Shape& s = of_robot ? scene.robot : scene.obstacles;
    const Index vertex = of_robot ? e.first.robot : e.first.obstacle;
    if (vertex >= s.ring_vertices) return {};
    for (const Index edge : {vertex, s.previous[vertex]}) {
        const Feature line = of_robot ? Feature{on.kind, edge, e.first.obstacle} : Feature{on.kind, e.first.robot, edge};
        const int sense = sense_along(scene, line, on);
        if (sense != 0 && is_smooth(scene, line, e.first) && side(e.first, sense) == e.first.branch) return line;
    }
    return {};
}

// True if two angles are roots of one polynomial: by their names, in which branches of curves do not matter, or as their quadratics
// are equal up to a factor.
bool Predicates::is_same_round(const Event& x, const Event& y) const {
    struct Names {
        Code first, second;
    };
    const auto names = [&](const Event& e) -> Names {
        if (const auto touch = touch_of_parallels(scene, surface.contact, e)) return {code(scene, *touch), 0};
        Feature first = e.first, second = e.second;
        if (second.kind != Kind::none && !is_center(second)) {
            if (first.kind != Kind::seam) first.branch = 0;
            if (second.kind != Kind::seam) second.branch = 0;
        }
        return {code(scene, first), code(scene, second)};
    };
    const Names p = names(x), q = names(y);
    if (p.first == q.first && p.second == q.second) return true;
    const bool are_curves = x.second.kind != Kind::none && y.second.kind != Kind::none;
    if (are_curves && p.first == q.second && p.second == q.first) return true;
    return round_orders().are_proportional(x, y);
}

// True if two curves meet at a root of the polynomial of the three surfaces: if another branch does, they do not.
bool Predicates::meet_at(const Feature& p, const Feature& q, const Event& x) const {
    const RoundOrders& orders = round_orders();
    if (const auto line = line_of_joint(scene, p, q)) {
        const Feature& circle = is_circle(p) ? p : q;
        auto branch = x.fine < 0 ? orders.joint_branch(*line, circle, x.lo, x.hi) : std::nullopt;
        if (!branch) {
            LongRoot root = long_root_of(x);
            branch = orders.joint_branch(*line, circle, root);
        }
        return orders.are_on(*branch, p, q);
    }
    if (x.fine < 0 && orders.order_on(p, q, x.lo, x.hi) != 0) return false;
    LongRoot root = long_root_of(x);
    return orders.meet_at(p, q, root);
}

// A branch of the one curve may meet a branch of the other at every angle. Which does changes only where surfaces touch, or where
// all that the curves have in common with the surface is two points. These angles are in order.
std::vector<Event> Predicates::changes_of_branch(const Feature& p, const Feature& q, const Event& from, const Event& to) {
    std::vector<Event> found;
    const auto add = [&](Feature first, int branch, const Feature& second) {
        first.branch = static_cast<std::int8_t>(branch);
        const Roots roots = event_roots(first, second, from, to);
        found.insert(found.end(), roots.at.begin(), roots.at.end());
    };
    for (const Feature& f : {p, q}) {
        if (!(is_circle(f) || is_circle(surface.contact)) || f.kind == Kind::seam || line_of_joint(scene, f, surface.contact)) continue;
        add(f, 1, {}), add(f, -1, {});
    }
    if (is_circle(p) || is_circle(q)) {
        const Feature &first = is_circle(q) ? p : q, &center = is_circle(q) ? q : p;
        if (is_circle(first) || is_circle(surface.contact)) add(first, 0, {Kind::vertex_vertex, center.robot, center.obstacle, 2});
    }
    std::sort(found.begin(), found.end(), [&](const Event& x, const Event& y) { return order(x, y) < 0; });
    return found;
}

Predicates::Order Predicates::compare_round(const Feature& p, const Feature& q, const Event& from, const Event& to) {
    const RoundOrders& orders = round_orders();
    Order result;
    if (const int sign = orders.order_on(p, q, from.lo, to.hi); sign != 0) {
        result.sign[0] = sign, result.strict = true;
        return ++counters.filter, result;
    }
    const Roots all = roots({}, p, q, from, to);
    const auto sign_at_sample = [&](const Sample& at) {
        if (!at.fine)
            if (const int sign = orders.order_on(p, q, at.tau, at.tau); sign != 0) return ++counters.filter, sign;
        if (const auto sign = orders.order_in_balls(p, q, at.ball())) return ++counters.interval, *sign;
        return ++counters.exact, orders.order_exactly(p, q, at);
    };
    int last = 0;
    if (all.all_zero) {
        std::vector<Event> cuts = changes_of_branch(p, q, from, to);
        cuts.push_back(to);
        for (std::size_t k = 0; k < cuts.size(); ++k) {
            const Event& before = k == 0 ? from : cuts[k - 1];
            if (k > 0 && order(before, cuts[k]) == 0) continue;
            int sign = 0;
            for (int attempt = 0; attempt < 3 && sign == 0; ++attempt) sign = sign_at_sample(between(before, cuts[k], attempt));
            if (k > 0 && sign != last) result.at.push_back(before);
            result.sign[result.at.size()] = last = sign;
        }
        return result;
    }
    for (int k = 0; k <= all.at.size(); ++k) {
        const Event &before = k == 0 ? from : all.at[k - 1], &after = k == all.at.size() ? to : all.at[k];
        int sign = 0;
        for (int attempt = 0; sign == 0; ++attempt) {
            if (attempt == most_attempts) throw std::logic_error("two different curves are equal at every sample");
            sign = sign_at_sample(between(before, after, attempt));
        }
        if (k > 0 && (sign != last || meet_at(p, q, before))) {
            result.at.push_back(before);
            result.at[result.at.size() - 1].is_touch = sign == last;
        }
        result.sign[result.at.size()] = last = sign;
    }
    return result;
}

}  // namespace cfree
