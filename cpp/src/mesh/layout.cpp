// Choose the layout of a face; common parts of all layouts.
#include "cfree/mesh/layout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cfree {

namespace {
constexpr double spared = 1;  // triangles per point that a neighbour also wants
}

double rim_step(const MeshFace& face, double error, double phi, int which) {
    constexpr double most_turn = std::numbers::pi / 4;
    double step = std::min(most_turn, face.to - face.from);
    for (int tries = 0; tries < 3; ++tries) {
        const double end = std::min(phi + step, face.to), bend = face.curves[which].bend_near(std::min(phi, end), end);
        step = std::min(step, std::sqrt(8 * on_curves * error / std::max(bend, 1e-300)));
    }
    return step;
}
double rim_step(const MeshFace& face, double error, double phi) {
    return std::min(rim_step(face, error, phi, 0), rim_step(face, error, phi, 1));
}

Layout best_layout(const MeshFace& face, double error, const std::optional<Wanted>& wanted) {
    if (!face.is_saddle || face.is_thin()) return {};
    Layout rows = rows_across(face, error), columns = columns_along(face, error);
    Layout& best = rows.is_empty() || (!columns.is_empty() && columns.triangles < rows.triangles) ? columns : rows;
    const double lattice = triangles_of_lattice(face, error);
    if (wanted) {
        Layout same = columns_along(face, error, *wanted);
        if (!same.is_empty() && same.triangles < std::min(best.triangles, lattice) + spared * wanted->points) return same;
    }
    return best.triangles < lattice ? std::move(best) : Layout{};
}

}  // namespace cfree
