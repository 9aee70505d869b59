// Cells of the free space: the closed surfaces of a boundary, which of them is inside which, and what they bound.
#pragma once
#include "cfree/free/point_location.hpp"

namespace cfree {

// What is known of the closed surfaces, one row each; of trapezoids: `component` and `lift`.
struct Surfaces {
    std::vector<Index> component;           // the closed surface of each trapezoid
    std::vector<Index> parent;              // the next surface around, or -1
    std::vector<std::uint8_t> free_inside;  // just inside it: it is the outer boundary of a cell, else of an island
    std::vector<Index> turns;               // how often its loops go round in theta: the greatest common divisor
    std::vector<Index> lift;                // full turns of each trapezoid against the first of its surface, along some path
};

// How often loops on each component go round in theta, and by how many turns its faces are lifted; over sides that two of its
// faces share.
struct Turns {
    std::vector<Index> turns, lift;
};
Turns turns_of(const CellComplex& cells);

class FreeSpace {
public:
    FreeSpace(SharedBoundary boundary, Surfaces surfaces);
    FreeSpace(SharedBoundary boundary, Surfaces surfaces, PointLocation location);
    // Throws std::logic_error if surfaces are inside each other as none can be.
    static std::shared_ptr<const FreeSpace> of(const CellComplex& cells);

    const SharedBoundary boundary;
    const Surfaces surfaces;
    const Index outside;              // the cell where nothing is around: 0, the unbounded one, or -1
    const std::vector<Index> cell_of; // the cell that each surface bounds; those bounded in the order of the surfaces around them
    const std::vector<Index> depth;   // how many surfaces are around each
    Index cells() const;
    const PointLocation& points() const { return location; }
    Index locate(const ExactPose& q) const { return location.locate(q, table()); }
    std::vector<Index> cells_at(const ExactPose& q) const { return location.cells_at(q, table()); }
    void locate(const double* xy, const int* chart, const double* tau, std::size_t count, int threads, Index* out) const {
        location.locate(xy, chart, tau, count, threads, table(), out);
    }

private:
    PointLocation::Cells table() const { return {depth, cell_of, surfaces.free_inside, outside}; }
    PointLocation location;
};

// Of each closed surface the next around it: free and forbidden sides alternate, or something is wrong.
std::vector<Index> parents(const PointLocation::Nesting& nesting, bool is_bounded);

}  // namespace cfree
