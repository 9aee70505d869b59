// Points on a lattice or in rows, where there is room; more where the bound asks for them, none that are not needed.
#include "cfree/mesh/face_mesher.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "cfree/support/stop.hpp"

namespace cfree {

namespace {

constexpr double rim_gap = 0.1;          // least distance of lattice points from the rim, in units of the lattice
constexpr double lattice_stretch = 1.6;  // where h is large the shear varies less
constexpr double golden = std::numbers::phi;
constexpr double best_density = 0.21650635094610965;  // sqrt(3) / 8: triangles a unit of w du dphi / error

}  // namespace

void FaceMesher::fill(const MeshFace& on, const Rim& rim, const Rows& rows, Index which) {
    face = &on, number = which;
    if (least_triangles(on, error, angle_scale) <= 4) return fill(rim, rows, Pattern::none);
    fill(rim, rows, Pattern::lattice);
    if (rows.rows.empty()) return;
    const auto other_net = net;
    const auto other_points = points;
    fill(rim, rows, Pattern::rows);
    if (net.triangles.size() > other_net.triangles.size()) net = other_net, points = other_points;
}

// From the rim inwards: a disc zipped between the two curves, points of the pattern, more where the bound asks for them.
void FaceMesher::fill(const Rim& rim, const Rows& rows, Pattern pattern) {
    net = {}, points.clear();
    stretch = pattern == Pattern::rows ? rows.stretch : lattice_stretch;
    place(rim);
    const auto rim_end = static_cast<Index>(points.size());
    if (pattern != Pattern::none) net.make_delaunay();
    if (pattern == Pattern::lattice) add_lattice();
    if (pattern == Pattern::rows) add_rows(rows);
    const auto pattern_end = static_cast<Index>(points.size());
    improve(100 * points.size() + 10000);
    if (static_cast<Index>(points.size()) > rim_end) simplify(rim_end, pattern_end);
}

// The face between its curves, then the points of its first and last side put on the rim.
void FaceMesher::place(const Rim& rim) {
    std::array<std::vector<Index>, 4> sides;
    for (std::size_t side = 0; side < 4; ++side)
        for (const MeshPoint& p : rim[side]) sides[side].push_back(add_point(p));
    const auto corner = [&](std::size_t side) {  // lower left, lower right, upper right, upper left
        for (std::size_t k = 0; k < 4; ++k)
            if (!sides[(side + k) % 4].empty()) return sides[(side + k) % 4].front();
        return Index(-1);
    };
    std::vector<Index> left = sides[3], right = sides[1];
    left.push_back(corner(0)), right.push_back(corner(2));
    std::reverse(left.begin(), left.end());
    points[left.front()].inward[0] = points[left.back()].inward[0] = 0;
    points[right.front()].inward[1] = points[right.back()].inward[1] = 0;
    net.zip(left, right);
    const auto split = [&](const std::vector<Index>& side, Index end) {
        for (std::size_t k = 1; k < side.size(); ++k) net.split_rim(side[k - 1], end, side[k]);
    };
    split(sides[0], corner(1)), split(sides[2], corner(3));
}

void FaceMesher::insert(const MeshPoint& p) {
    const Index id = add_point(p);
    if (!net.insert(id)) points.pop_back(), net.places.pop_back();
}

void FaceMesher::add_rows(const Rows& rows) {
    for (std::size_t k = 1; k + 1 < rows.rows.size(); ++k) {
        heed_stop();
        const auto [phi, parts] = rows.rows[k];
        const double low = face->u(face->position(face->curves[0].at(phi), phi)), wide = face->width_u(phi);
        const bool between = k % 2 == 1;
        for (int i = between ? 0 : 1; i < parts; ++i) insert(face->point(face->s(low + wide * (i + (between ? 0.5 : 0.0)) / parts), phi));
    }
}

Index FaceMesher::add_point(const MeshPoint& p) {
    points.push_back(p);
    net.places.push_back({face->is_saddle ? (face->u(p.s) + face->shear * p.phi) / stretch : p.s, stretch * p.phi});
    return static_cast<Index>(points.size()) - 1;
}

// The largest share of the ideal area at which triangles of the lattice fit everywhere.
double FaceMesher::scale_of_lattice() const {
    const double phi = 0.5 * (face->from + face->to), unit = lattice_unit();
    const double low = face->u(face->position(face->curves[0].at(phi), phi)), wide = face->width_u(phi);
    const auto fits = [&](double scale) {
        for (int k = 0; k <= 16; ++k) {
            std::array<MeshPoint, 3> p;
            const double x[] = {0, lattice.m, lattice.n}, y[] = {0, lattice.n, lattice.m};
            for (int c = 0; c < 3; ++c) {
                const double dy = scale * unit * y[c] / stretch;
                const double u = low + wide * k / 16 + side() * stretch * scale * unit * (x[c] - 0.76) - face->shear * dy;
                p[c] = lifted({face->s(u), phi + dy, {0, 0}});
            }
            if (face->excess_inside({&p[0], &p[1], &p[2]}) > 1) return false;
        }
        return true;
    };
    double scale = 1;
    while (scale > 0.5 && !fits(scale)) scale *= 0.985;
    return scale;
}

// Of best triangles. On the surface: edges (1/g, g), (1, -1) and (g, 1/g), g the golden ratio, with |dx dy| = 1; a third of the
// error below it |dx dy| is 2/3 for two of them and 4/3 for the third, (k, -k).
FaceMesher::Lattice::Lattice(bool free)
    : m(free ? 1 - 1 / std::numbers::sqrt3 : 1 / golden), n(free ? 1 + 1 / std::numbers::sqrt3 : golden),
      k(free ? 2 / std::numbers::sqrt3 : 1), off(free ? -1.0 / 3 : 0) {}

MeshPoint FaceMesher::lifted(MeshPoint p) const {
    p.off = side() * lattice.off * error * face->gradient(p.s);
    return p;
}

void FaceMesher::add_lattice() {
    const double unit = lattice_unit() * scale_of_lattice();
    double left = 1e300, right = -1e300;
    for (const auto& p : net.places) left = std::min(left, p.x), right = std::max(right, p.x);
    const double x0 = 0.5 * (left + right), y0 = 0.5 * (face->from + face->to) * stretch, gap = rim_gap * unit;
    const double wide = 0.5 * (right - left) / unit, high = 0.5 * (face->to - face->from) * stretch / unit;
    const auto [m, n, k, off] = lattice;
    const auto rows = static_cast<Index>(std::ceil((wide * n + high * m) / (k * (m + n)))) + 2;
    for (Index j = -rows; j <= rows; ++j) {
        heed_stop();
        const auto from = static_cast<Index>(std::floor((-high + j * k) / n));
        const auto to = static_cast<Index>(std::ceil((high + j * k) / n));
        for (Index i = from; i <= to; ++i) {
            const double x = x0 + side() * unit * (i * m + j * k), phi = (y0 + unit * (i * n - j * k)) / stretch;
            if (x < left || x > right || phi < face->from + gap / stretch || phi > face->to - gap / stretch) continue;
            const double u = stretch * x - face->shear * phi;
            const MeshPoint p = face->point(face->s(u), phi);
            const double low = p.s - p.inward[0], up = p.s + p.inward[1];
            if (u - face->u(low) < gap * stretch || face->u(up) - u < gap * stretch) continue;
            insert(lifted(p));
        }
    }
}

template <std::size_t n>
Index FaceMesher::add_middle(const std::array<Index, n>& of) {
    double x = 0, y = 0;
    for (const Index k : of) x += net.places[k].x / n, y += net.places[k].y / n;
    y /= stretch;
    return add_point(face->point(face->is_saddle ? face->s(stretch * x - face->shear * y) : x, y));
}

// Flips edges and puts points on them until every triangle is close.
void FaceMesher::improve(std::size_t most) {
    auto& open = net.changed;
    open.resize(net.triangles.size());
    std::iota(open.rbegin(), open.rend(), 0);
    while (!open.empty()) {
        heed_stop();
        const Index t = open.back();
        open.pop_back();
        if (excess(t) <= 1 || flip_to_better(t)) continue;
        if (net.triangles.size() > most) throw std::logic_error("no triangles close enough on trapezoid " + std::to_string(number));
        const int k = net.longest_inner_edge(t);
        const auto& x = net.triangles[t].corner;
        if (k < 0) net.split_triangle(t, add_middle(x));
        else net.split_edge(t, k, add_middle(std::array{x[(k + 1) % 3], x[(k + 2) % 3]}));
        net.make_delaunay_around(static_cast<Index>(points.size()) - 1);
    }
}

// The other diagonal where that makes the worse of the two triangles better.
bool FaceMesher::flip_to_better(Index t) {
    int best = -1;
    double least = 1;
    for (int k = 0; k < 3; ++k) {
        if (!net.can_flip(t, k)) continue;
        const auto& x = net.triangles[t];
        const Index a = x.corner[k], b = x.corner[(k + 1) % 3], c = x.corner[(k + 2) % 3], d = net.opposite(t, k);
        const double before = std::max(excess(t), excess(x.across[k]));
        const double now = std::max(excess(a, b, d), excess(d, c, a)) / before;
        if (now < 0.99 * least) least = now, best = k;
    }
    if (best < 0) return false;
    net.changed.push_back(t), net.changed.push_back(net.triangles[t].across[best]);
    net.flip(t, best);
    return true;
}

// Takes out inner points that are not needed; those amid lattice points are.
void FaceMesher::simplify(Index rim, Index inner) {
    std::vector<Index> at(points.size(), -1);
    for (Index t = 0; t < static_cast<Index>(net.triangles.size()); ++t)
        for (const Index c : net.triangles[t].corner) at[c] = t;
    const auto drop = [&](Index p) {
        for (std::size_t from = 0; from < star.link.size(); ++from) {
            const std::size_t n = star.link.size();
            const auto is_fine = [&](std::size_t k) {
                const Index b = star.link[(from + k) % n], c = star.link[(from + k + 1) % n];
                return excess(star.link[from], b, c) <= 1;
            };
            bool fine = net.can_fan(star, from);
            for (std::size_t k = 1; fine && k + 1 < n; ++k) fine = is_fine(k);
            if (!fine) continue;
            net.fan(star, from);
            for (std::size_t k = 1; k + 1 < n; ++k) {
                const Index t = star.triangles[(from + k) % n];
                for (const Index c : net.triangles[t].corner) at[c] = t;
            }
            at[p] = -1;
            return true;
        }
        return false;
    };
    for (bool again = true; again;) {
        again = false;
        for (auto p = static_cast<Index>(points.size()) - 1; p >= rim; --p) {
            if (at[p] < 0) continue;
            net.star_of(p, at[p], star);
            const auto is_plain = [&](Index q) { return q >= rim && q < inner; };
            if (is_plain(p) && std::all_of(star.link.begin(), star.link.end(), is_plain)) continue;
            again = drop(p) || again;
        }
    }
    net.sweep_dropped();
}

// The best known density's integral over the face, by Simpson's rule.
double least_triangles(const MeshFace& face, double error, double angle_scale) {
    if (!face.is_saddle || face.is_thin()) return 0;
    double sum = 0;
    const int parts = 16;
    for (int k = 0; k <= parts; ++k)
        sum += (k == 0 || k == parts ? 1 : k % 2 ? 4 : 2) * face.width_u(face.from + k * (face.to - face.from) / parts);
    return best_density * angle_scale * (face.to - face.from) * sum / (3 * parts) / error;
}

}  // namespace cfree
