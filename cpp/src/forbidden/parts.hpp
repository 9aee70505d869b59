// Parts of trapezoids' sides, between two changes of their neighbours, in the order of gluing.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cfree/forbidden/cell_complex.hpp"

namespace cfree {

// Small columns: a large scene has hundreds of millions of parts. Parts of one edge are consecutive. Parts of one side of a
// trapezoid are in its order along t or theta, or all backwards.
class Parts {
public:
    std::vector<Index> trapezoid, twin;
    std::vector<double> start;  // start of the half-edge: t at a critical angle; along a curve the rank of the angle

    Index size() const { return static_cast<Index>(traits.size()); }
    Side side(Index k) const { return static_cast<Side>(traits[k] & 3); }
    bool is_backwards(Index k) const { return (traits[k] & 4) != 0; }
    bool begins_edge(Index k) const { return (traits[k] & 8) != 0; }

    void begin_edge() { begins = true; }
    Index add(Index of, Side on, bool backwards, double at) {
        trapezoid.push_back(of), twin.push_back(-1), start.push_back(at);
        traits.push_back(static_cast<std::uint8_t>(static_cast<int>(on) | backwards << 2 | begins << 3));
        begins = false;
        return size() - 1;
    }
    void pair(Index p, Index q) { twin[p] = q, twin[q] = p; }
    void finish() { trapezoid.shrink_to_fit(), twin.shrink_to_fit(), start.shrink_to_fit(), traits.shrink_to_fit(); }

private:
    std::vector<std::uint8_t> traits;
    bool begins = false;
};

template <class T>
void free_memory(std::vector<T>& of) { std::vector<T>().swap(of); }

// Groups at an edge: pairs that bound one free sector; or all in one circle, counter-clockwise when viewed along the edge as
// theta grows, or along its line: `twin` is then the next.
enum class Around { free_sectors, all };

// One per trapezoid: 1 if all trapezoids that its sides meet are there, 0 if not, 2 if its sides are matched as far as possible.
using Whole = std::vector<char>;

// Fail at a whole trapezoid; elsewhere something is just missing.
inline void fail_to_glue(const std::string& what, Index trapezoid, const Whole& whole) {
    if (whole[trapezoid] == 1) throw std::logic_error(what + " at trapezoid " + std::to_string(trapezoid));
}

// True if a half-edge on that side runs in the direction of t or theta.
inline bool is_forwards(Side side) { return side == Side::first || side == Side::upper; }

}  // namespace cfree
