#include "cfree/angle_table.hpp"

#include <algorithm>
#include <cmath>

namespace cfree {

AngleTable::AngleTable(const Scene& s, const Patches& p, const Trapezoids& t) : scene(s), patches(p), trapezoids(t) {
    from.resize(t.patch.size()), to.resize(t.patch.size());
    sort_chart(0);
    middle = static_cast<Index>(angles.size()) - 1;
    sort_chart(1);
    last = static_cast<Index>(angles.size()) - 2;
}

Surface AngleTable::surface(Index k) const {
    const Index patch = trapezoids.patch[k];
    return {{static_cast<Kind>(patches.kind[patch]), patches.robot[patch], patches.obstacle[patch]}, trapezoids.chart[k]};
}

void AngleTable::sort_chart(int chart) {
    const auto& t = trapezoids;
    std::vector<Angle> ends{{-1, -1, -1, false, {}}, {1, 1, -1, false, {}}};
    for (std::size_t k = 0; k < t.patch.size(); ++k) {
        if (t.chart[k] != chart) continue;
        ends.push_back({t.from_lo[k], t.from_hi[k], static_cast<Index>(k), false, {}});
        ends.push_back({t.to_lo[k], t.to_hi[k], static_cast<Index>(k), true, {}});
    }
    std::sort(ends.begin(), ends.end(), [](const Angle& x, const Angle& y) { return x.lo < y.lo; });
    for (std::size_t begin = 0, end; begin < ends.size(); begin = end) {  // runs of intervals that overlap
        double reach = ends[begin].hi;
        for (end = begin + 1; end < ends.size() && ends[end].lo <= reach; ++end) reach = std::max(reach, ends[end].hi);
        order_cluster(&ends[begin], &ends[begin] + (end - begin), chart);
    }
}

void AngleTable::order_cluster(const Angle* begin, const Angle* end, int chart) {
    // one of each name stands for all that agree with it
    std::vector<std::pair<std::array<Code, 3>, const Angle*>> named;
    for (const Angle* x = begin; x != end; ++x) named.push_back({name(*x), x});
    std::sort(named.begin(), named.end());
    struct Class {
        Angle angle;
        std::vector<const Angle*> members;
    };
    std::vector<Class> classes;
    const auto add = [&](std::vector<const Angle*> same) {
        Angle x = *same[0];
        std::size_t low = 0, high = classes.size();
        while (low < high) {
            const std::size_t mid = (low + high) / 2;
            const int o = order(x, classes[mid].angle);
            if (o == 0) {
                auto& members = classes[mid].members;
                members.insert(members.end(), same.begin(), same.end());
                return;
            }
            (o < 0 ? high : low) = o < 0 ? mid : mid + 1;
        }
        classes.insert(classes.begin() + static_cast<std::ptrdiff_t>(low), {std::move(x), std::move(same)});
    };
    for (std::size_t k = 0, next; k < named.size(); k = next) {
        std::vector<const Angle*> same;
        for (next = k; next < named.size() && named[next].first == named[k].first; ++next) same.push_back(named[next].second);
        if (same.size() == 1 || is_one(same)) add(std::move(same));
        else
            for (const Angle* x : same) add({x});
    }
    for (Class& c : classes) {
        const auto rank = static_cast<Index>(angles.size()) - chart;
        for (const Angle* x : c.members)
            if (x->trapezoid >= 0) (x->is_to ? to : from)[x->trapezoid] = rank;
        angles.push_back(std::move(c.angle));
    }
}

std::array<Feature, 2> AngleTable::features(const Angle& x) const {
    const auto& t = trapezoids;
    const Index k = x.trapezoid;
    if (k < 0) return {};
    if (x.is_to) return {unpacked(t.to_first[k]), unpacked(t.to_second[k])};
    return {unpacked(t.from_first[k]), unpacked(t.from_second[k])};
}

// What meets there, the same whoever says it: three surfaces, a helix and a surface, or two parallel edges.
std::array<Code, 3> AngleTable::name(const Angle& x) const {
    const auto [first, second] = features(x);
    if (first.kind == Kind::none) return {0, 0, x.lo < 0 ? 0u : 1u};
    const Code a = code(scene, first), b = code(scene, second), own = code(scene, surface(x.trapezoid).contact);
    std::array<Code, 3> names{own, a, b};
    if (first.kind == Kind::edge_edge) names = {a, 0, 0};
    else if (second.kind == Kind::none) names = {own, a, 0};
    else if (first.kind == Kind::vertex_vertex || second.kind == Kind::vertex_vertex) names = {a, b, 0};  // a helix on it
    std::sort(names.begin(), names.end());
    return names;
}

// Whether ends of one name are one angle: each has the only root in its interval, of one polynomial; all together have one.
bool AngleTable::is_one(const std::vector<const Angle*>& same) {
    double lo = same[0]->lo, hi = same[0]->hi;
    for (const Angle* x : same) {
        if (features(*x)[0].kind == Kind::none) return true;
        if ((x->is_to ? trapezoids.to_place : trapezoids.from_place)[x->trapezoid] != 0) return false;
        lo = std::min(lo, x->lo), hi = std::max(hi, x->hi);
    }
    Predicates on(scene, surface(same[0]->trapezoid));
    return on.changes_sign(event(*same[0], on), lo, hi);
}

Event AngleTable::event(const Angle& x, Predicates& on) const {
    const auto [first, second] = features(x);
    return on.restored({first, second, x.lo, x.hi},
                       (x.is_to ? trapezoids.to_place : trapezoids.from_place)[x.trapezoid]);
}

int AngleTable::order(Angle& x, Angle& y) {
    if (x.hi < y.lo) return -1;
    if (x.lo > y.hi) return 1;
    return compare(exact(x), exact(y));
}

RealRoot& AngleTable::exact(Angle& x) const {
    if (x.root) return *x.root;
    x.root = std::make_shared<RealRoot>();
    if (x.trapezoid < 0) {
        x.root->lo = x.root->hi = Dyadic::from(x.lo);
        return *x.root;
    }
    Predicates on(scene, surface(x.trapezoid));
    *x.root = on.root_of(event(x, on));
    // axis-parallel scenes have thousands of names for one number of few digits
    const Dyadic simple = Dyadic::from(std::nearbyint(16 * x.lo) / 16);
    if (compare(x.root->lo, simple) <= 0 && compare(simple, x.root->hi) <= 0 && sign_at(x.root->p, simple) == 0)
        x.root->lo = x.root->hi = simple;
    return *x.root;
}

const RealRoot& AngleTable::exact(Index rank, int chart) { return exact(angles[place(rank, chart)]); }

Sample AngleTable::between(Index first, Index second, int chart) {
    if (hi(first, chart) < lo(second, chart)) return Predicates::within(hi(first, chart), lo(second, chart), 0.5);
    RealRoot p = exact(first, chart), q = exact(second, chart);
    while (compare(p.hi, q.lo) >= 0) p.halve(), q.halve();
    const Dyadic at = Dyadic::middle(p.hi, q.lo);
    return {at.rounded_down(), at};
}

}  // namespace cfree
