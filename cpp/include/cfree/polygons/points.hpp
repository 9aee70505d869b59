// Points with exact integer coordinates, and the signs that check and cut polygons.
//
// Coordinates of at most 62 bits, which nearly all are, are kept and compared in machine integers: a tenth of the memory of
// those of any size. Longer ones are compared in doubles with a proven bound first, then exactly.
#pragma once
#include <array>
#include <memory>
#include <stdexcept>
#include <vector>

#include "cfree/exact/number.hpp"

namespace cfree {

// A bug in the core.
struct BrokenInvariant : std::logic_error {
    using std::logic_error::logic_error;
};

class Points {
public:
    Points() = default;
    Points(std::vector<Int> exact_x, std::vector<Int> exact_y);
    Index size() const { return static_cast<Index>(large ? large->X.size() : small.size()); }
    Int X(Index k) const { return large ? large->X[k] : Int(small[k].x); }
    Int Y(Index k) const { return large ? large->Y[k] : Int(small[k].y); }
    std::array<std::vector<Int>, 2> coordinates() const;  // all along x, all along y
    std::array<Int, 4> box() const;  // least x, least y, greatest x, greatest y; of points that there are
    Points chosen(const std::vector<Index>& which) const;

    int compare(Index p, Index q) const;  // order by x, then by y: -1, 0 or 1
    bool before(Index p, Index q) const { return compare(p, q) < 0; }
    bool same(Index p, Index q) const { return compare(p, q) == 0; }

    int turn(Index p, Index q, Index r, Index s) const;  // sign of (q - p) x (s - r): 1 if rs turns left of pq
    int orient(Index p, Index q, Index r) const { return turn(p, q, p, r); }  // 1 if r is left of pq, 0 if on its line
    int along(Index p, Index q, Index r, Index s) const;  // sign of (q - p) . (s - r)
    bool is_upper(Index p, Index q) const;                // true if the angle of q - p is in [0, pi)
    int compare_lengths(Index p, Index q, Index r, Index s) const;  // pq against rs: -1, 0 or 1

    bool are_small() const { return !large; }
    std::int64_t small_x(Index k) const { return small[k].x; }
    std::int64_t small_y(Index k) const { return small[k].y; }

private:
    struct Large {
        std::vector<Int> X, Y;
        std::vector<double> about_x, about_y;  // times a power of two, rounded
    };
    std::vector<Vec<std::int64_t>> small;  // if all have at most 62 bits
    std::shared_ptr<const Large> large;    // else
    Vec<Approx> about(Index from, Index to) const;
    template <bool is_dot>
    int sign(Index p, Index q, Index r, Index s) const;
};

enum class Meeting { apart, cross, touch, overlap };
Meeting meet(const Points& v, Index p, Index q, Index r, Index s);  // intersection of the segments pq and rs

// Location of a direction in the sector swept counter-clockwise from `start` to `end`; all directions are from the point o
// towards points. Two equal directions bound the whole turn, slit along them.
enum class Location { inside, boundary, outside };
Location locate_in_sector(const Points& v, Index o, Index towards, Index start, Index end);

}  // namespace cfree
