// One exact sweep over the edges of rings finds crossings, places where rings touch, and the nesting of rings.
//
// Shamos and Hoey's sweep from left to right (the vertical line leans, so that points are met in the order of their pairs
// of coordinates). It keeps the edges it cuts in their order from below to above; edges that cross are neighbours there
// just before they do, so testing new neighbours finds a crossing if there is one. O(n log n) exact comparisons.
//
//     edge k goes from point k to the next point of its ring
#pragma once
#include <utility>
#include <variant>
#include <vector>

#include "cfree/polygons/points.hpp"

namespace cfree {

// Links of rings: ring r holds the points offsets[r] to offsets[r + 1] - 1.
struct RingLinks {
    explicit RingLinks(const std::vector<Index>& offsets);
    std::vector<Index> next, previous, ring;
};

// Two edges that cross or overlap, or touch without being neighbours in one ring; the first is the lesser.
struct EdgesMeet {
    Index first, second;
};

// Nesting of rings that do not cross.
struct Nesting {
    std::vector<Index> order;     // rings, from left to right
    std::vector<Index> below;     // the edge right below each ring's first point, -1 if there is none
    std::vector<char> rightward;  // true for each edge along which the sweep runs from its start to its end
    std::vector<std::pair<Index, Index>> touching;  // edge, and a point of another ring inside it
};

// Rings without repeated or collinear neighbours and without spikes.
std::variant<EdgesMeet, Nesting> sweep(const Points& points, const std::vector<Index>& offsets);

// Innermost ring around each ring, -1 if there is none.
std::vector<Index> containers(const Nesting& nesting, const std::vector<Index>& ring_of_edge, const std::vector<char>& counterclockwise);

// Indices of points in the order of the sweep; equal points are ordered by index.
std::vector<Index> swept_order(const Points& points);

// Edges that the sweep line cuts, from below to above.
class SweepLine {
public:
    SweepLine(const Points& v, const std::vector<Index>& starts, const std::vector<Index>& ends)
        : points(v), start(starts), end(ends) {}
    std::vector<Index> edges;
    // The edges through a point, those from `first` to `last` - 1.
    std::pair<std::size_t, std::size_t> through(Index point) const;
    // Replace them by `leaving`, from below to above.
    void replace(std::pair<std::size_t, std::size_t> range, const std::vector<Index>& leaving);
    // Edges that leave a point rightwards, sorted by slope: few, so each is inserted in turn.
    std::vector<Index> from_below(Index point, const std::vector<Index>& leaving) const;

private:
    const Points& points;
    const std::vector<Index>&start, &end;
};

}  // namespace cfree
