// The trapezoids glued into closed surfaces: every side finds its partner by what it is, never by where it is.
//
// A trapezoid is a face. Its boundary runs counter-clockwise in (t, theta): the side at its first angle, the upper curve, the side
// at its last angle, the lower curve; each is cut into half-edges where its neighbours change. Two half-edges that bound one
// free sector are twins. At a geometric edge where more than two faces meet, they are sorted around it.
#pragma once
#include "cfree/forbidden/boundary.hpp"

namespace cfree {

enum class Side : std::uint8_t { first, upper, last, lower };

struct CellComplex {
    SharedBoundary boundary;
    // half-edges, face after face in the order of their loops
    std::vector<Index> face, twin, edge, vertex;  // vertex: where it starts
    std::vector<std::uint8_t> side;
    std::vector<Index> first;      // half-edges of face k: first[k] .. first[k + 1]
    std::vector<Index> component;  // of each face
    std::vector<double> xy, theta;  // of each vertex, rounded; in the user's units, from `Scene::frame`
    Index edges = 0, vertices = 0, components = 0;
};

// Half-edges along each edge at which more than two faces meet.
std::vector<std::vector<Index>> pinched(const CellComplex& cells);

// The same for any number of threads. A side without a partner, as a message that names trapezoids, is thrown as
// std::logic_error.
std::shared_ptr<const CellComplex> glue(const SharedBoundary& boundary, int threads = 1);

// Closed surfaces of a boundary of which only some patches are trimmed: those that hold the seeds. `whole` says of each
// trapezoid whether all trapezoids that its sides meet are there. If the surfaces go on over one that is not, it is missing, and
// there is no complex; but with a target that is reached there is one of those that are whole, its sides to others without twin.
struct GluedPart {
    std::shared_ptr<const CellComplex> complex;
    std::vector<Index> faces, missing;  // whole ones of the surfaces, and others
};
GluedPart glue_part(const SharedBoundary& boundary, std::vector<char> whole, const std::vector<Index>& seeds, Index target = -1);

// Some trapezoids of a part of a boundary, with all others that their sides and ends meet: sides of those alone may be without twin.
// Components are of the own ones, joined over sides that two of them share; of others it is -1.
std::shared_ptr<const CellComplex> glue_own(const SharedBoundary& boundary, const std::vector<char>& own, int threads = 1);

}  // namespace cfree
