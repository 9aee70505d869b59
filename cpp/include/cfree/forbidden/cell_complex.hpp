// Trapezoids glued into closed surfaces: every side finds its partner by its name, never by its position.
//
// A trapezoid is a face. Its boundary runs counter-clockwise in (t, theta): the side at its first angle, the upper curve, the
// side at its last angle, the lower curve. Each is cut into half-edges where its neighbours change. Two half-edges that bound
// one free sector are twins. If more than two faces meet at a geometric edge, they are sorted around it.
#pragma once
#include "cfree/forbidden/boundary.hpp"

namespace cfree {

enum class Side : std::uint8_t { first, upper, last, lower };

// Vertices of a complex, rounded; in the user's units, from `Scene::frame`.
struct VertexPlaces {
    std::vector<double> xy, theta;
};

struct CellComplex {
    SharedBoundary boundary;
    // half-edges, face after face in the order of their loops
    std::vector<Index> face, twin, edge, vertex;  // edge: numbered in the order of its first half-edge; vertex: at its start
    std::vector<std::uint8_t> side;
    std::vector<Index> first;      // half-edges of face k: first[k] .. first[k + 1]
    std::vector<Index> component;  // each face's component
    Index edges = 0, vertices = 0, components = 0;
    // Computed at the first call. If faces of another complex were taken all are glued for it, as last digits depend on all faces.
    const VertexPlaces& places() const;

    struct Placing {
        std::once_flag once;
        VertexPlaces places;
        std::function<VertexPlaces()> later;
    };
    std::shared_ptr<Placing> placing = std::make_shared<Placing>();
};

// Half-edges along each edge at which more than two faces meet.
std::vector<std::vector<Index>> pinched(const CellComplex& cells);

// Glue the sides of a boundary, with the same result for any number of threads. Throws std::logic_error, with a message that
// names trapezoids, if a side has no partner.
std::shared_ptr<const CellComplex> glue(const SharedBoundary& boundary, int threads = 1);

// The same complex, with faces of that of another boundary where all that their sides meet is the same.
std::shared_ptr<const CellComplex> glue(const SharedBoundary& boundary, const CellComplex& reuse, int threads = 1);

// Closed surfaces that hold the seeds, of a boundary with only some patches trimmed. `whole` is true for a trapezoid if all
// trapezoids that its sides meet are there. If the surfaces continue over one that is not whole, it is missing, and there is
// no complex. But if a target is reached, there is a complex of the whole ones; its sides to others have no twin.
struct GluedPart {
    std::shared_ptr<const CellComplex> complex;
    std::vector<Index> faces, missing;  // whole trapezoids of the surfaces, and the others
};
GluedPart glue_part(const SharedBoundary& boundary, std::vector<char> whole, const std::vector<Index>& seeds, Index target = -1);

// Glue some (own) trapezoids of a part of a boundary, with all others that their sides and ends meet. Only sides of the
// others may be without twin. Components join own trapezoids over shared sides; the others have -1.
std::shared_ptr<const CellComplex> glue_own(const SharedBoundary& boundary, const std::vector<char>& own, int threads = 1);

}  // namespace cfree
