// Parts of trapezoids' sides, between two changes of their neighbours, as gluing finds them.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cfree/forbidden/cell_complex.hpp"

namespace cfree {

// Columns: there are several for each trapezoid. Those of one side come in its order along t or theta, or all `backwards`.
struct Parts {
    std::vector<Index> trapezoid, twin, edge;
    std::vector<std::uint8_t> side, backwards;
    std::vector<double> start;  // of the half-edge: t at a critical angle; along a curve the rank of the angle
    Index edges = 0;

    Index size() const { return static_cast<Index>(trapezoid.size()); }
    // Along the edge that was begun last.
    Index add(Index of, Side on, bool is_backwards, double at) {
        trapezoid.push_back(of), twin.push_back(-1), edge.push_back(edges - 1);
        side.push_back(static_cast<std::uint8_t>(on)), backwards.push_back(is_backwards), start.push_back(at);
        return size() - 1;
    }
    void pair(Index p, Index q) { twin[p] = q, twin[q] = p; }
};

// Of each trapezoid, whether all that its sides meet are there.
using Whole = std::vector<char>;

// What must not be at a trapezoid that is whole; elsewhere something is missing.
inline void fail_to_glue(const std::string& what, Index trapezoid, const Whole& whole) {
    if (whole[trapezoid]) throw std::logic_error(what + " at trapezoid " + std::to_string(trapezoid));
}

// Whether a half-edge on that side runs as t or theta do.
inline bool is_forwards(Side side) { return side == Side::first || side == Side::upper; }

}  // namespace cfree
