// Triangles of one face within a given rim.
#pragma once
#include "cfree/mesh/rows.hpp"
#include "cfree/mesh/triangulation.hpp"

namespace cfree {

using Rim = std::array<std::vector<MeshPoint>, 4>;  // points by side, in the order of the loop

class FaceMesher {
public:
    // Inner points may be off the surface, if `free` says so.
    FaceMesher(double most_error, double scale, bool free) : error(most_error), angle_scale(scale), lattice(free) {}

    // Triangles of `net`, their corners among `points`; of two ways to place points inside the one that needs fewer. Which face
    // it is, is for the message if the bounds cannot be met, a std::logic_error.
    void fill(const MeshFace& face, const Rim& rim, const Rows& rows, Index which);

    Triangulation net;
    std::vector<MeshPoint> points;

private:
    enum class Pattern { none, lattice, rows };
    void fill(const Rim& rim, const Rows& rows, Pattern pattern);
    void place(const Rim& rim);
    Index add_point(const MeshPoint& p);
    void insert(const MeshPoint& p);
    template <std::size_t n>
    Index add_middle(const std::array<Index, n>& of);
    // The points i (m, n) + j (k, -k), that far off the surface, in units of the error.
    struct Lattice {
        explicit Lattice(bool free);
        double m, n, k, off;
    };
    double side() const { return face->shear < 0 ? -1 : 1; }  // -1: the lattice in a mirror, as helices there lean to the other side
    MeshPoint lifted(MeshPoint p) const;
    void add_lattice();
    void add_rows(const Rows& rows);
    double scale_of_lattice() const;
    void improve(std::size_t most);
    bool flip_to_better(Index t);
    void simplify(Index rim, Index inner);
    double excess(Index p, Index q, Index r) const { return face->excess({&points[p], &points[q], &points[r]}); }
    double excess(Index t) const {
        const auto& c = net.triangles[t].corner;
        return excess(c[0], c[1], c[2]);
    }
    double lattice_unit() const { return 2 * std::sqrt(error / angle_scale); }

    const double error, angle_scale;
    const Lattice lattice;
    const MeshFace* face = nullptr;
    Index number = 0;
    double stretch = 1;  // of the coordinates of `net`: (u / stretch, stretch * phi)
    Triangulation::Star star;
};

// Triangles that the best known density asks for on a face, 0 without twist.
double least_triangles(const MeshFace& face, double error, double angle_scale);

}  // namespace cfree
