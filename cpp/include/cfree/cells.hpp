// Which closed surfaces of a boundary are around a pose: those that the ray from it towards -x, at its orientation, crosses an
// odd number of times. Exact: every crossing is the sign of a polynomial in tau at a rational number.
#pragma once
#include <optional>

#include "cfree/cell_complex.hpp"

namespace cfree {

// Position (X, Y) / W in the scene's integers, and the orientation tau = p / r in [-1, 1] of a chart; W, r > 0.
struct ExactPose {
    Int X, Y, W;
    int chart;
    Int p, r;
};

class Rays {
public:
    // shift: that of the scene's coordinates
    Rays(Scene scene, int shift, Patches patches, Trapezoids trapezoids, std::vector<Index> component);

    // Of every component: those around it, in order, and whether space is free just inside it.
    struct Nesting {
        std::vector<Index> start, around;
        std::vector<std::uint8_t> free_inside;
    };
    Nesting nesting() const;

    // The cell of a pose, -1 if it is forbidden, by what bounds which cell. On the boundary: the first cell that it bounds.
    struct Cells {
        std::vector<Index> depth, cell;  // of each component: how many are around it, the cell it bounds
        std::vector<std::uint8_t> free_inside;
        Index outside;                   // where nothing is around
    };
    Index locate(const ExactPose& q, const Cells& cells) const;

private:
    struct Seen;
    struct View;
    enum class When { at, after };  // at the orientation, or just after it
    Seen look(const View& q, When when, Index own) const;
    void look_on(const View& q, Seen& seen) const;
    bool may_be_on(const Feature& contact, const View& q) const;
    bool is_on(Index k, const View& q, bool is_end) const;
    int order(bool of_end, Index k, const View& q) const;
    struct Probe;
    std::optional<Probe> probe(Index k, int attempt) const;
    Index part_of(int chart, double tau) const;

    Scene scene;
    int shift;
    Patches patches;
    Trapezoids trapezoids;
    std::vector<Index> component;
    Index parts = 1;
    std::vector<Index> part_start, part_member;  // trapezoids by chart and part of [-1, 1]
};

// How often closed surfaces go round in theta: the greatest common divisor of the turns of all loops on each, and by how many
// turns each face is lifted from the first of its surface, along some path. `steps` are the turns made on leaving by a coedge.
struct Turns {
    std::vector<Index> divisor, lift;
};
Turns turns(const std::vector<Index>& first, const std::vector<Index>& face, const std::vector<Index>& twin,
            const std::vector<Index>& component, const std::vector<std::int8_t>& steps, Index components);

}  // namespace cfree
