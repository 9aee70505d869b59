// Polygons: an outer ring and holes, with exact coordinates and the interior on the left of every edge.
//
// Vertices are numbered over all rings, the outer ring first. Edge i goes from vertex i to the next of its ring. Rings are
// checked once, exactly, when a polygon is made: it is simple, its outer ring runs counter-clockwise and its holes
// clockwise, and no vertex is straight. A thin polygon, a point or a segment, is the core of a disc or a stadium: scenes take
// it with a radius only.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "cfree/exact/ratio.hpp"
#include "cfree/polygons/points.hpp"

namespace cfree {

// Rings that do not bound a polygon: ring 0 is the outer one, k + 1 is hole k. Edge k of a ring goes from its input point k
// to the next point that is a vertex.
struct InvalidPolygon : std::invalid_argument {
    explicit InvalidPolygon(const std::string& message) : std::invalid_argument(message) {}
    InvalidPolygon(Index ring_at_fault, const std::string& message, std::vector<Index> edges_at_fault = {});
    Index ring = -1;  // -1: no ring is at fault
    std::vector<Index> edges;
};

// A point of the input that is not a vertex: the same as the one before, or on the line of its neighbours.
struct Removed {
    Index ring, index;
    bool repeated;
};

struct RatioPoint {
    Ratio x, y;
    friend bool operator==(const RatioPoint&, const RatioPoint&) = default;
};
using RatioRing = std::vector<RatioPoint>;

using Pieces = std::vector<std::vector<Index>>;

class Polygon {
public:
    // Rings in either direction, the outer one first; a last point equal to the first is dropped.
    explicit Polygon(std::vector<RatioRing> rings);
    // Rings of integers over a denominator.
    Polygon(std::vector<Points> rings, const Int& denominator);
    // A point; or a segment, by its two different ends: a ring of two edges there and back.
    static Polygon thin(const RatioRing& points);

    Points vertices;  // times the denominator, the least that makes them whole
    Int denominator = 1;
    std::vector<Index> offsets;  // ring r holds the vertices offsets[r] to offsets[r + 1] - 1
    std::vector<char> convex;    // true for each vertex with an interior angle below pi
    std::vector<Removed> removed;
    bool is_convex() const { return is_convex_ring; }
    bool is_thin() const { return vertices.size() < 3; }

    // Convex pieces that cover the polygon and do not overlap, computed at the first call; not for two threads at once.
    const Pieces& pieces() const;

private:
    Polygon() = default;
    bool is_convex_ring = false;
    mutable Pieces found_pieces;
    void check(std::vector<Points>&& rings, bool is_least);  // is_least: the denominator is the least
};

// True if all of a polygon, its boundary included, is in the interior of another.
bool is_inside(const Polygon& inner, const Polygon& outer);

}  // namespace cfree
