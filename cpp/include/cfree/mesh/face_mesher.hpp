// Triangles of one face within a given rim.
#pragma once
#include <type_traits>

#include "cfree/mesh/layout.hpp"
#include "cfree/mesh/round_face.hpp"
#include "cfree/mesh/triangulation.hpp"

namespace cfree {

using Rim = std::array<std::vector<MeshPoint>, 4>;  // points by side, in loop order

// Of a MeshFace, or of a RoundFace without layouts.
template <class Face>
class FaceMesher {
public:
    // Inner points may be off the surface if `free` is set.
    FaceMesher(double most_error, bool free) : error(most_error), may_leave(free) {}

    // Fill `net` with triangles, their corners among `points`; of two layouts of inner points, take the one with fewer. Throws
    // std::logic_error, with the face's number `which`, if the bounds cannot be met.
    void fill(const Face& face, const Rim& rim, const Layout& layout, Index which);

    Triangulation net;
    std::vector<MeshPoint> points;

private:
    static constexpr bool has_layouts = std::is_same_v<Face, MeshFace>;
    MeshPoint inner_point(double s, double phi) const;
    void fill(const Rim& rim, const Layout& layout);
    void place(const Rim& rim);
    Index add_point(const MeshPoint& p);
    void insert(double u, double phi, double off);
    template <std::size_t n>
    Index add_middle(const std::array<Index, n>& of);
    void improve(std::size_t most);
    bool flip_to_better(Index t);
    void simplify(Index rim, Index inner);
    double excess(Index p, Index q, Index r) const { return face->excess({&points[p], &points[q], &points[r]}); }
    double excess(Index t) const {
        const auto& c = net.triangles[t].corner;
        return excess(c[0], c[1], c[2]);
    }

    const double error;
    const bool may_leave;
    const Face* face = nullptr;
    Index number = 0;
    double stretch = 1, lean = 0;  // coordinates of `net`: ((u - lean * phi) / stretch, stretch * phi)
    double origin = 0;             // from which phi counts there
    Triangulation::Star star;
};

}  // namespace cfree
