// Name angles by the features that meet there; compare them by intervals, then exactly; theory, "Surfaces that coincide".
#include "cfree/forbidden/critical_angle.hpp"

#include <algorithm>
#include <cmath>

namespace cfree {

CriticalAngle::Name CriticalAngle::name(const Scene& scene) const {
    if (is_chart_end()) return {0, 0, lo < 0 ? 0u : 1u};
    if (scene.is_round) return name_among_grown(scene);
    const Code a = code(scene, first), b = code(scene, second), own = code(scene, surface.contact);
    Name names{own, a, b};
    if (first.kind == Kind::edge_edge) names = {a, 0, 0};
    else if (second.kind == Kind::none) names = {own, a, 0};
    else if (first.kind == Kind::vertex_vertex || second.kind == Kind::vertex_vertex) names = {a, b, 0};  // a helix on it
    std::sort(names.begin(), names.end());
    return names;
}

// The polynomial of three surfaces is the same for all their branches and quadrants.
CriticalAngle::Name CriticalAngle::name_among_grown(const Scene& scene) const {
    if (first.kind == Kind::edge_edge) return {0, 0, code(scene, first)};
    const auto surface_of = [&](Feature f) {
        if (f.kind != Kind::seam) f.branch = 0;
        return code(scene, f);
    };
    Name names{surface_of(surface.contact), surface_of(first), surface_of(second)};
    if (second.kind == Kind::none) names[1] = code(scene, first);  // a touch on one side
    std::sort(names.begin(), names.end());
    return names;
}

// True if a vertex is certainly on the line of an edge.
static bool is_on_line(const Shape& s, Index v, Index e) {
    if (v == s.v[e] || v == s.w[e]) return true;
    const Approx off = cross(edge<Approx>(s, e), difference<Approx>(s, v, s.v[e]));
    if (std::abs(off.v) > coefficient_error * off.m + tiny) return false;
    return certain_sign(cross(edge<Ball>(s, e), difference<Ball>(s, v, s.v[e]))) == 0;
}

// Name by the chord: a surface, and another surface or a helix that puts a second vertex on its edge's line. They do so at the
// angle if the chord certainly becomes parallel to the edge in its interval: the polynomial is zero there, and has no other
// root in the interval.
std::optional<CriticalAngle::Name> CriticalAngle::chord(const Scene& scene, const Feature& x, const Feature& y) const {
    const bool on_edge = x.kind == Kind::vertex_edge;
    if (y.kind != x.kind && y.kind != Kind::vertex_vertex) return {};
    const Shape &own = on_edge ? scene.robot : scene.obstacles, &other = on_edge ? scene.obstacles : scene.robot;
    const auto [v, e] = on_edge ? std::pair(x.robot, x.obstacle) : std::pair(x.obstacle, x.robot);
    const auto [w, f] = on_edge ? std::pair(y.robot, y.obstacle) : std::pair(y.obstacle, y.robot);
    if (own.point[v] == own.point[w]) return {};
    const bool is_along = y.kind == x.kind ? other.direction[f] == other.direction[e] && is_on_line(other, other.v[f], e)
                                           : is_on_line(other, f, e);
    if (!is_along || !Predicates(scene, surface).turns_parallel(on_edge, v, w, e, lo, hi)) return {};
    if (own.w[v] == w || own.w[w] == v) {  // an edge
        const Index along = own.w[v] == w ? v : w;
        return Name{0, 0, code(scene, {Kind::edge_edge, on_edge ? along : e, on_edge ? e : along})};
    }
    const auto [p, q] = std::minmax(own.point[v], own.point[w]);
    return Name{0, packed({x.kind, p, q}), packed({Kind::edge_edge, 0, other.direction[e]})};
}

std::optional<CriticalAngle::Name> CriticalAngle::chord(const Scene& scene) const {
    if (place != 0 || !(-1 < lo && hi < 1)) return {};
    if (first.kind == Kind::edge_edge) return Name{0, 0, code(scene, first)};
    if (scene.is_round) return {};
    std::optional<Name> found;
    const auto look = [&](const Feature& x, const Feature& y) {
        const auto name = x.kind == Kind::vertex_vertex ? chord(scene, y, x) : chord(scene, x, y);
        if (name && (!found || *name < *found)) found = name;
    };
    look(surface.contact, first);
    if (second.kind != Kind::none) look(surface.contact, second), look(first, second);
    return found;
}

CriticalAngle::ShortName CriticalAngle::short_name(const Scene& scene) const {
    const auto found = chord(scene);
    return {found ? *found : name(scene), found.has_value()};
}

// The intervals that begin first and end last hold all others. If they overlap, no root is between them. If signs change around both,
// and around the two together, they have one root in all: two would change them back.
bool CriticalAngle::are_one(const Scene& scene, const ShortName& name, const std::vector<CriticalAngle>& same) {
    if (same[0].is_chart_end() || name.second) return true;
    if (std::any_of(same.begin(), same.end(), [](const CriticalAngle& x) { return x.place != 0; })) return false;
    const auto &first = *std::min_element(same.begin(), same.end(), [](const auto& x, const auto& y) { return x.lo < y.lo; }),
               &last = *std::max_element(same.begin(), same.end(), [](const auto& x, const auto& y) { return x.hi < y.hi; });
    if (first.hi == last.hi || first.lo == last.lo) return true;
    const auto changes_sign = [&](const CriticalAngle& x, double low, double high) {
        return Predicates(scene, x.surface).changes_sign({x.first, x.second, x.lo, x.hi}, low, high);
    };
    return last.lo <= first.hi && changes_sign(first, first.lo, last.hi) && changes_sign(first, first.lo, first.hi) &&
           changes_sign(last, last.lo, last.hi);
}

const RealRoot& CriticalAngle::exact(const Scene& scene) const {
    if (root) return *root;
    root = std::make_shared<RealRoot>();
    if (is_chart_end()) {
        root->lo = root->hi = Dyadic::from(lo);
        return *root;
    }
    Predicates predicates(scene, surface);
    *root = predicates.root_of(event(predicates), bracket(scene));
    // axis-parallel scenes have thousands of names for one number of few digits
    const Dyadic simple = Dyadic::from(Predicates::of_few_digits_near(lo));
    if (compare(root->lo, simple) <= 0 && compare(simple, root->hi) <= 0 && sign_at(root->p, simple) == 0)
        root->lo = root->hi = simple;
    return *root;
}

LongRoot& CriticalAngle::exact_among_grown(const Scene& scene) const {
    if (long_root) return *long_root;
    Predicates predicates(scene, surface);
    long_root = std::make_shared<LongRoot>(predicates.long_root_of(event(predicates)));
    return *long_root;
}

const std::optional<Predicates::Bracket>& CriticalAngle::bracket(const Scene& scene) const {
    if (!narrow && (is_chart_end() || place != 0)) narrow.emplace();
    if (!narrow) narrow = Predicates(scene, surface).bracket({first, second, lo, hi});
    return *narrow;
}

void know(Junction& at, const Scene& scene, const CriticalAngle& angle) {
    if (angle.first.kind == Kind::edge_edge) at.know_parallel(angle.first.robot, angle.first.obstacle);
    else at.know(angle.name(scene));
}

// Order of two angles as balls prove it, without exact roots.
static std::optional<int> order_by_balls(const Scene& scene, const CriticalAngle& x, const CriticalAngle& y) {
    const auto is_root = [](const CriticalAngle& a) { return !a.is_chart_end() && a.place == 0; };
    if (is_root(x) && is_root(y)) {
        const Predicates on_y(scene, y.on());
        if (Predicates(scene, x.on()).are_one({x.first, x.second, x.lo, x.hi}, on_y, {y.first, y.second, y.lo, y.hi})) return 0;
    }
    const auto &p = x.bracket(scene), &q = y.bracket(scene);
    if (!p || !q) return {};
    if (is_below((*p)[1], (*q)[0])) return -1;
    if (is_below((*q)[1], (*p)[0])) return 1;
    return {};
}

int CriticalAngle::narrowing_order(const Scene& scene, CriticalAngle& other) {
    if (hi < other.lo) return -1;
    if (lo > other.hi) return 1;
    if (const auto known = order_by_balls(scene, *this, other)) return *known;
    if (scene.is_round) return compare(exact_among_grown(scene), other.exact_among_grown(scene));
    exact(scene), other.exact(scene);
    return compare(*root, *other.root);
}

int order(const Scene& scene, const CriticalAngle& x, const CriticalAngle& y) {
    if (x.hi < y.lo) return -1;
    if (x.lo > y.hi) return 1;
    if (const auto name = x.short_name(scene); name == y.short_name(scene) && CriticalAngle::are_one(scene, name, {x, y})) return 0;
    if (const auto known = order_by_balls(scene, x, y)) return *known;
    if (scene.is_round) return compare(x.exact_among_grown(scene), y.exact_among_grown(scene));
    RealRoot p = x.exact(scene), q = y.exact(scene);
    return compare(p, q);
}

Surface surface_of(const Patches& patches, const Trapezoids& t, Index k) {
    return {patches.contact(t.patch[k]), t.chart[k]};
}

CriticalAngle angle_from(const Surface& on, const Trapezoids& t, Index k) {
    return {on, {unpacked(t.from_first[k]), unpacked(t.from_second[k]), t.from_lo[k], t.from_hi[k]}, t.from_place[k]};
}

CriticalAngle angle_from(const Patches& patches, const Trapezoids& t, Index k) { return angle_from(surface_of(patches, t, k), t, k); }

CriticalAngle angle_to(const Surface& on, const Trapezoids& t, Index k) {
    return {on, {unpacked(t.to_first[k]), unpacked(t.to_second[k]), t.to_lo[k], t.to_hi[k]}, t.to_place[k]};
}

CriticalAngle angle_to(const Patches& patches, const Trapezoids& t, Index k) { return angle_to(surface_of(patches, t, k), t, k); }

}  // namespace cfree
