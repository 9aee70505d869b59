// Sort critical angles by their intervals, and exactly if these overlap; theory, "Closed surfaces".
#include "cfree/forbidden/angle_table.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "support/parallel.hpp"

namespace cfree {

AngleTable::AngleTable(const Scene& s, const Patches& p, const Trapezoids& t, int threads)
    : scene(s), patches(p), trapezoids(t) {
    from.resize(t.patch.size()), to.resize(t.patch.size());
    std::array<std::vector<Angle>, 2> ordered;
    for_each_in_parallel(threads, ordered.size(), [&](std::size_t chart) {
        ordered[chart] = order_chart(sorted_ends(static_cast<int>(chart)), (threads + 1) / 2);
    });
    angles = std::move(ordered[0]);
    middle = static_cast<Index>(angles.size()) - 1;
    angles.insert(angles.end(), ordered[1].begin(), ordered[1].end());
    last = static_cast<Index>(angles.size()) - 2;
    for (std::size_t k = 0; k < t.patch.size(); ++k)
        if (t.chart[k] == 1) from[k] += middle, to[k] += middle;
}

CriticalAngle AngleTable::critical(const Angle& x) const {
    if (x.trapezoid < 0) return {0, x.lo < 0 ? -1 : 1};
    return x.is_to ? angle_to(patches, trapezoids, x.trapezoid) : angle_from(patches, trapezoids, x.trapezoid);
}

// Ends of a chart and of its trapezoids, in the order in which their intervals begin: distributed over small parts of the chart, then
// sorted in each.
std::vector<AngleTable::Angle> AngleTable::sorted_ends(int chart) const {
    const auto& t = trapezoids;
    const auto for_each_end = [&](auto&& take) {
        take(Angle{-1, -1, -1, false}), take(Angle{1, 1, -1, false});
        for (std::size_t k = 0; k < t.patch.size(); ++k) {
            if (t.chart[k] != chart) continue;
            take(Angle{t.from_lo[k], t.from_hi[k], static_cast<Index>(k), false});
            take(Angle{t.to_lo[k], t.to_hi[k], static_cast<Index>(k), true});
        }
    };
    constexpr std::size_t per_part = 8;
    const std::size_t parts = t.patch.size() / per_part + 1;
    const auto part = [&](const Angle& x) {
        const double share = std::clamp(0.5 * (x.lo + 1), 0.0, 1.0);
        return static_cast<std::size_t>(share * static_cast<double>(parts));
    };
    std::vector<std::size_t> first(parts + 2, 0);
    for_each_end([&](const Angle& x) { ++first[part(x) + 1]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Angle> ends(first.back());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for_each_end([&](const Angle& x) { ends[next[part(x)]++] = x; });
    const auto at = [&](std::size_t k) { return ends.begin() + static_cast<std::ptrdiff_t>(first[k]); };
    for (std::size_t k = 0; k + 1 < first.size(); ++k)
        std::sort(at(k), at(k + 1), [](const Angle& x, const Angle& y) {
            return std::tie(x.lo, x.trapezoid, x.is_to) < std::tie(y.lo, y.trapezoid, y.is_to);
        });
    return ends;
}

// Angles of a chart in order, and the ranks of its trapezoids among them.
std::vector<AngleTable::Angle> AngleTable::order_chart(const std::vector<Angle>& ends, int threads) {
    const std::size_t block = block_of(ends.size());  // or more: whole clusters, runs of intervals that overlap
    std::vector<std::size_t> clusters, first;  // starts of clusters, and the first clusters of blocks
    double reach = -2;
    for (std::size_t k = 0; k < ends.size(); ++k) {
        if (ends[k].lo > reach) {
            if (first.empty() || k - clusters[first.back()] >= block) first.push_back(clusters.size());
            clusters.push_back(k);
        }
        reach = std::max(reach, ends[k].hi);
    }
    first.push_back(clusters.size()), clusters.push_back(ends.size());
    std::vector<std::vector<Angle>> ordered(first.size() - 1);
    for_each_in_parallel(threads, ordered.size(), [&](std::size_t b) {
        Cluster cluster;
        for (std::size_t c = first[b]; c < first[b + 1]; ++c)
            order_cluster(std::span(ends).subspan(clusters[c], clusters[c + 1] - clusters[c]), cluster, ordered[b]);
    });
    std::vector<Angle> all;
    for (std::size_t b = 0; b < ordered.size(); ++b) {
        const auto before = static_cast<Index>(all.size());
        for (std::size_t k = clusters[first[b]]; k < clusters[first[b + 1]]; ++k)
            if (ends[k].trapezoid >= 0) rank_of(ends[k]) += before;
        all.insert(all.end(), ordered[b].begin(), ordered[b].end());
    }
    return all;
}

// Append the angles of a cluster in order, and rank its members by their places there.
void AngleTable::order_cluster(std::span<const Angle> ends, Cluster& cluster, std::vector<Angle>& ordered) {
    auto& all = cluster.all;
    auto& named = cluster.named;
    all.clear(), named.clear();
    for (const Angle& x : ends) all.push_back(critical(x));
    const auto join_all = [&] {
        for (const Angle& x : ends)
            if (x.trapezoid >= 0) rank_of(x) = static_cast<Index>(ordered.size());
        ordered.push_back(ends[0]);
    };
    const auto name = all[0].name(scene);  // mostly that of all
    const auto has_name = [&](const CriticalAngle& x) { return x.name(scene) == name; };
    if (std::all_of(all.begin() + 1, all.end(), has_name) && (all.size() == 1 || CriticalAngle::are_one(scene, {name, false}, all)))
        return join_all();
    for (std::size_t k = 0; k < ends.size(); ++k) named.push_back({all[k].short_name(scene), &ends[k]});
    const auto is_first = [&](const auto& x) { return x.first == named[0].first; };
    if (std::all_of(named.begin(), named.end(), is_first) && CriticalAngle::are_one(scene, named[0].first, all)) return join_all();
    std::sort(named.begin(), named.end());  // one of each short name represents all that agree with it
    struct Class {
        CriticalAngle angle;
        std::vector<const Angle*> members;
    };
    std::vector<Class> classes;  // in order
    const auto angle = [&](std::size_t k) -> const CriticalAngle& { return all[static_cast<std::size_t>(named[k].second - ends.data())]; };
    const auto add = [&](std::size_t first, std::size_t next) {
        heed_stop();
        CriticalAngle x = angle(first);
        std::size_t low = 0, high = classes.size();
        bool found = false;
        while (low < high && !found) {
            const std::size_t mid = (low + high) / 2;
            const int o = x.narrowing_order(scene, classes[mid].angle);
            found = o == 0;
            if (o == 0) low = mid;
            else (o < 0 ? high : low) = o < 0 ? mid : mid + 1;
        }
        if (!found) classes.insert(classes.begin() + static_cast<std::ptrdiff_t>(low), {x, {}});
        for (std::size_t k = first; k < next; ++k) classes[low].members.push_back(named[k].second);
    };
    std::vector<CriticalAngle> same;
    for (std::size_t k = 0, next; k < named.size(); k = next) {
        same.clear();
        for (next = k; next < named.size() && named[next].first == named[k].first; ++next)
            same.push_back(angle(next));
        if (same.size() == 1 || CriticalAngle::are_one(scene, named[k].first, same)) add(k, next);
        else
            for (std::size_t x = k; x < next; ++x) add(x, x + 1);
    }
    for (const Class& c : classes) {
        for (const Angle* x : c.members)
            if (x->trapezoid >= 0) rank_of(*x) = static_cast<Index>(ordered.size());
        ordered.push_back(*c.members[0]);
    }
}

Sample AngleTable::between(Index first, Index second, int chart) const {
    if (hi(first, chart) < lo(second, chart)) return Predicates::within(hi(first, chart), lo(second, chart));
    const auto middle_of = [](auto p, auto q) -> Sample {
        while (compare(p.hi, q.lo) >= 0) p.halve(), q.halve();
        const Dyadic at = Dyadic::middle(p.hi, q.lo);
        return {at.rounded_down(), at};
    };
    const CriticalAngle x = critical(first, chart), y = critical(second, chart);
    if (scene.is_round) return middle_of(x.exact_among_grown(scene), y.exact_among_grown(scene));
    return middle_of(x.exact(scene), y.exact(scene));
}

}  // namespace cfree
