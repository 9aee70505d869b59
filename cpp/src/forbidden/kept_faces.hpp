// Faces of one complex that are the same in the complex of another boundary, with all that their sides meet.
#pragma once
#include "cfree/forbidden/cell_complex.hpp"

namespace cfree {

struct KeptFaces {
    std::vector<Index> before, now;   // each trapezoid's number in the other boundary, and back; -1: it is in one only
    std::vector<char> is_inner;       // true for each trapezoid whose sides meet only trapezoids of both boundaries
    std::vector<char> is_border_edge; // true for each edge of the other complex that a trapezoid of both meets which is not inner
    std::vector<Index> chosen;        // trapezoids that are not inner, and all that their sides meet, in order
};

// None if nothing is the same.
std::optional<KeptFaces> kept_faces(const CellComplex& other, const Boundary& boundary);

}  // namespace cfree
