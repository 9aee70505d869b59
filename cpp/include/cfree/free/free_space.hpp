// Cells of the free space: the closed surfaces of a boundary, their nesting, and the cells that they bound.
#pragma once
#include "cfree/free/point_location.hpp"

namespace cfree {

// Data of the closed surfaces, one row each; and of trapezoids: `component`.
struct Surfaces {
    std::vector<Index> component;           // each trapezoid's closed surface
    std::vector<Index> parent;              // the next surface around, or -1
    std::vector<std::uint8_t> free_inside;  // outer rim of a cell, or an island
};

// Turns in theta, over sides that two faces of a component share.
struct Turns {
    std::vector<Index> turns;  // greatest common divisor of the full turns of loops on each component
    std::vector<Index> lift;   // each face's full turns against the first one of its component, along some path
};
Turns turns_of(const CellComplex& cells);

class FreeSpace {
public:
    FreeSpace(SharedBoundary boundary, Surfaces surfaces);
    FreeSpace(SharedBoundary boundary, Surfaces surfaces, PointLocation location);
    // Throws std::logic_error if the nesting of the surfaces is impossible.
    static std::shared_ptr<const FreeSpace> of(const CellComplex& cells);

    const SharedBoundary boundary;
    const Surfaces surfaces;
    const Index outside;              // the cell inside no surface: 0, the unbounded one, or -1
    const std::vector<Index> cell_of; // each surface's cell; cells with surfaces around are in their order
    const std::vector<Index> depth;   // number of surfaces around each surface
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

// Next surface around each closed surface: free and forbidden sides must alternate.
std::vector<Index> parents(const PointLocation::Nesting& nesting, bool is_bounded);

}  // namespace cfree
