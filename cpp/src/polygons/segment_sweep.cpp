// Sweep edges from left to right, and compare new neighbours; docs/inside-the-core.md.
#include "cfree/polygons/segment_sweep.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace cfree {

RingLinks::RingLinks(const std::vector<Index>& offsets) : next(offsets.back()), previous(next.size()), ring(next.size()) {
    for (std::size_t r = 0; r + 1 < offsets.size(); ++r)
        for (Index k = offsets[r]; k < offsets[r + 1]; ++k) {
            next[k] = k + 1 < offsets[r + 1] ? k + 1 : offsets[r];
            previous[next[k]] = k;
            ring[k] = static_cast<Index>(r);
        }
}

std::vector<Index> swept_order(const Points& points) {
    std::vector<Index> order(static_cast<std::size_t>(points.size()));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index p, Index q) {
        const int by_place = points.compare(p, q);
        return by_place ? by_place < 0 : p < q;
    });
    return order;
}

std::pair<std::size_t, std::size_t> SweepLine::through(Index point) const {
    const auto side = [&](Index e) { return points.orient(start[e], end[e], point); };
    const auto first = std::partition_point(edges.begin(), edges.end(), [&](Index e) { return side(e) > 0; });
    const auto last = std::find_if(first, edges.end(), [&](Index e) { return side(e) != 0; });
    return {first - edges.begin(), last - edges.begin()};
}

void SweepLine::replace(std::pair<std::size_t, std::size_t> range, const std::vector<Index>& leaving) {
    const auto at = [&](std::size_t k) { return edges.begin() + static_cast<std::ptrdiff_t>(k); };
    const std::size_t kept = std::min(range.second - range.first, leaving.size());
    std::copy_n(leaving.begin(), kept, at(range.first));
    if (kept < leaving.size())
        edges.insert(at(range.second), leaving.begin() + static_cast<std::ptrdiff_t>(kept), leaving.end());
    else
        edges.erase(at(range.first + kept), at(range.second));
}

std::vector<Index> SweepLine::from_below(Index point, const std::vector<Index>& leaving) const {
    std::vector<Index> ordered;
    for (const Index e : leaving) {
        const auto place = std::find_if(ordered.begin(), ordered.end(),
                                        [&](Index f) { return points.orient(point, end[f], end[e]) <= 0; });
        ordered.insert(place, e);
    }
    return ordered;
}

namespace {

class Sweep {
public:
    Sweep(const Points& v, const std::vector<Index>& offsets)
        : points(v), links(offsets), start(links.next.size()), end(links.next.size()), line(v, start, end) {
        const std::size_t n = links.next.size();
        nesting.rightward.resize(n), nesting.below.assign(offsets.size() - 1, unknown);
        for (std::size_t e = 0; e < n; ++e) {
            const Index from = static_cast<Index>(e), to = links.next[e];
            nesting.rightward[e] = points.before(from, to);
            start[e] = nesting.rightward[e] ? from : to, end[e] = nesting.rightward[e] ? to : from;
        }
    }

    std::variant<EdgesMeet, Nesting> run() {
        const auto order = swept_order(points);
        for (std::size_t k = 0, beyond; k < order.size(); k = beyond) {
            for (beyond = k + 1; beyond < order.size() && points.same(order[k], order[beyond]);) ++beyond;
            here.assign(order.begin() + static_cast<std::ptrdiff_t>(k), order.begin() + static_cast<std::ptrdiff_t>(beyond));
            if (!pass()) return found;
        }
        return std::move(nesting);
    }

private:
    static constexpr Index unknown = -2;
    const Points& points;
    const RingLinks links;
    std::vector<Index> start, end;  // one per edge, in the order of the sweep
    SweepLine line;
    std::vector<Index> here;  // the coincident points of this event
    EdgesMeet found{};
    Nesting nesting;

    bool ends_here(Index e) const { return points.same(end[e], here[0]); }
    bool report(Index e, Index f) { return found = {std::min(e, f), std::max(e, f)}, false; }

    // Pass the points here; false if edges meet there in a forbidden way.
    bool pass() {
        const Index point = here[0];
        const auto range = line.through(point);
        const auto arriving = std::vector<Index>(line.edges.begin() + static_cast<std::ptrdiff_t>(range.first),
                                                 line.edges.begin() + static_cast<std::ptrdiff_t>(range.second));
        std::vector<Index> passing, leaving;
        for (const Index e : arriving)
            if (!ends_here(e)) passing.push_back(e);
        if (!corners_are_apart(point, passing)) return false;
        std::size_t ended = arriving.size() - passing.size();
        for (const Index k : here)
            for (const Index e : {links.previous[k], k}) {
                if (points.same(start[e], point)) leaving.push_back(e);
                else if (std::find(arriving.begin(), arriving.end(), e) == arriving.end()) lose();
                else --ended;
            }
        if (ended != 0) lose();
        leaving.insert(leaving.end(), passing.begin(), passing.end());
        leaving = line.from_below(point, leaving);
        line.replace(range, leaving);
        if (!are_apart(range.first) || (!leaving.empty() && !are_apart(range.first + leaving.size()))) return false;
        for (std::size_t m = 0; m < leaving.size(); ++m) {
            const Index ring = links.ring[leaving[m]];
            if (nesting.below[ring] != unknown) continue;
            nesting.below[ring] = range.first + m ? line.edges[range.first + m - 1] : -1;
            nesting.order.push_back(ring);
        }
        for (const Index e : passing)
            for (const Index k : here) nesting.touching.emplace_back(e, k);
        return true;
    }

    [[noreturn]] static void lose() { throw BrokenInvariant("the sweep over a polygon's rings lost an edge"); }

    // True if rings that pass through a point neither cross nor overlap there.
    bool corners_are_apart(Index point, const std::vector<Index>& passing) {
        std::vector<std::array<Index, 3>> corners;  // an edge, a point before and a point after
        for (const Index k : here) corners.push_back({k, links.next[k], links.previous[k]});
        for (const Index e : passing) corners.push_back({e, end[e], start[e]});
        for (std::size_t k = 0; k < corners.size(); ++k)
            for (std::size_t m = k + 1; m < corners.size(); ++m) {
                const auto [e, a, b] = corners[k];
                const auto [f, c, d] = corners[m];
                if (links.ring[e] == links.ring[f]) return report(e, f);
                const auto side_c = locate_in_sector(points, point, c, a, b), side_d = locate_in_sector(points, point, d, a, b);
                if (side_c != side_d || side_c == Location::boundary) return report(e, f);
            }
        return true;
    }

    // True if the edges below and above a gap of the line may be neighbours.
    bool are_apart(std::size_t above) {
        if (above == 0 || above >= line.edges.size()) return true;
        const Index e = line.edges[above - 1], f = line.edges[above];
        if (links.next[e] == f || links.next[f] == e) return true;  // share one point only, as there are no spikes
        const Meeting met = meet(points, start[e], end[e], start[f], end[f]);
        return met == Meeting::apart || (met == Meeting::touch && links.ring[e] != links.ring[f]) || report(e, f);
    }
};

}  // namespace

std::variant<EdgesMeet, Nesting> sweep(const Points& points, const std::vector<Index>& offsets) {
    return Sweep(points, offsets).run();
}

std::vector<Index> containers(const Nesting& nesting, const std::vector<Index>& ring_of_edge, const std::vector<char>& counterclockwise) {
    std::vector<Index> container(nesting.below.size(), -1);
    for (const Index ring : nesting.order) {
        const Index edge = nesting.below[ring];
        if (edge < 0) continue;
        const Index other = ring_of_edge[edge];
        container[ring] = nesting.rightward[edge] == counterclockwise[other] ? other : container[other];
    }
    return container;
}

}  // namespace cfree
