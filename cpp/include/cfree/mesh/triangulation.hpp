// Triangulation of one face, built up from its rim: insert points, split and flip edges. Coordinates decide only which
// triangle is better; for any coordinates, the result is a disc with the given rim.
#pragma once
#include <array>
#include <vector>

#include "cfree/exact/number.hpp"

namespace cfree {

// Corners counter-clockwise; across[k] is the triangle across the edge opposite corner k, -1 at the rim.
struct Triangle {
    std::array<Index, 3> corner, across;
};

class Triangulation {
public:
    struct Place {
        double x, y;
    };
    std::vector<Place> places;
    double flat = 1e-9;  // areas this small, against the square of the longest side, decide nothing
    std::vector<Triangle> triangles;
    std::vector<Index> changed;  // triangles made or flipped by Delaunay steps

    // Fills the region between two chains by their heights y; chains may share their first or last point.
    void zip(const std::vector<Index>& left, const std::vector<Index>& right);
    // Fills the same region without leaving it, if both chains rise and do not cross.
    void fill_between(const std::vector<Index>& left, const std::vector<Index>& right);
    // Puts point p on a rim edge from a; its other part, from p, can be split again.
    void split_rim(Index a, Index b, Index p);
    // Puts point p on the edge opposite corner k of triangle t.
    void split_edge(Index t, int k, Index p);
    void split_triangle(Index t, Index p);
    // Flips the edges across from p, and on, where they are not Delaunay, unless they are of the rim.
    void make_delaunay_around(Index p);
    // Insert point p if it is well inside a triangle, and make the edges around it Delaunay.
    bool insert(Index p);
    void make_delaunay();
    int longest_inner_edge(Index t) const;  // its opposite corner, -1 if all are on the rim

    // Around an inner point, counter-clockwise: triangle k has the corners p, link[k] and the next of the link.
    struct Star {
        std::vector<Index> triangles, link;
    };
    void star_of(Index p, Index t, Star& star) const;
    bool can_fan(const Star& star, std::size_t from) const;  // all triangles from link[from] to the rest are upright
    void fan(const Star& star, std::size_t from);            // replaces the star; its first and last triangles are dropped
    void sweep_dropped();

    bool can_flip(Index t, int k) const;  // to the other diagonal of a convex quadrilateral
    void flip(Index t, int k);
    Index opposite(Index t, int k) const;  // the corner across the edge

private:
    double area(Index p, Index q, Index r) const;
    void find_neighbours();
    double square_distance(Index p, Index q) const;
    int across_from(Index t, Index neighbour) const;
    void replace_neighbour(Index t, Index old, Index now);
    void make_stacked_delaunay();
    bool is_outside_circle(Index t, int k) const;
    std::vector<std::array<Index, 2>> stack;  // corners and triangles: the opposite edges may not be Delaunay
    Index last = 0;
};

}  // namespace cfree
