// Mesh a face: points of the layout where there is room, more where the bound needs them, none without need.
#include "cfree/mesh/face_mesher.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

constexpr double least_flat = 1e-13;  // where curves touch a side, faces are as thin as steps from there
constexpr double doubt = 1.3;  // factor of doubt in estimated numbers of triangles

}  // namespace

template <class Face>
void FaceMesher<Face>::fill(const Face& on, const Rim& rim, const Layout& layout, Index which) {
    face = &on, number = which;
    if constexpr (!has_layouts) {
        fill(rim, layout);
    } else {
        if (least_triangles(on, error) <= few_triangles) return fill(rim, {});
        const Layout lattice = lattice_over(on, error, may_leave);
        if (layout.is_empty()) return fill(rim, lattice);
        fill(rim, layout);
        if (lattice.triangles > doubt * layout.triangles) return;
        const auto first_net = std::exchange(net, {});
        const auto first_points = std::exchange(points, {});
        fill(rim, lattice);
        if (net.triangles.size() >= first_net.triangles.size()) net = first_net, points = first_points;
    }
}

// Fill from the rim inwards: a disc zipped between the two curves, points of the layout, more where the bound needs them.
template <class Face>
void FaceMesher<Face>::fill(const Rim& rim, const Layout& layout) {
    net = {}, points.clear();
    if constexpr (!has_layouts) net.flat = least_flat;
    const bool bare = layout.is_empty();
    origin = has_layouts ? 0 : face->from;
    stretch = bare ? usual_stretch : layout.stretch, lean = bare ? -face->shear : layout.lean;
    place(rim);
    const auto rim_end = static_cast<Index>(points.size());
    if (!bare || !has_layouts) net.make_delaunay();
    for (const auto [u, phi, off] : layout.inside) insert(u, phi, off);
    const auto layout_end = static_cast<Index>(points.size());
    improve(100 * points.size() + 10000);
    if (static_cast<Index>(points.size()) > rim_end) simplify(rim_end, layout_end);
}

// Zip the face between its curves, then put the points of its first and last side on the rim.
template <class Face>
void FaceMesher<Face>::place(const Rim& rim) {
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
    if constexpr (has_layouts) net.zip(left, right);
    else net.fill_between(left, right);  // its bound holds within the face alone
    const auto split = [&](const std::vector<Index>& side, Index end) {
        for (std::size_t k = 1; k < side.size(); ++k) net.split_rim(side[k - 1], end, side[k]);
    };
    split(sides[0], corner(1)), split(sides[2], corner(3));
}

template <class Face>
void FaceMesher<Face>::insert(double u, double phi, double off) {
    heed_stop();
    MeshPoint p = inner_point(face->s(u), phi);
    p.off = off;
    if (off != 0 && face->excess({&p, &p, &p}) > 1) p.off = 0;  // too near a side, where the offset counts in full
    const Index id = add_point(p);
    if (!net.insert(id)) points.pop_back(), net.places.pop_back();
}

template <class Face>
MeshPoint FaceMesher<Face>::inner_point(double s, double phi) const {
    if constexpr (has_layouts) return face->point_inside(s, phi);
    else return face->point(s, phi);  // on an edge or in a triangle of the net, which is in the plane of s and phi
}

template <class Face>
Index FaceMesher<Face>::add_point(const MeshPoint& p) {
    points.push_back(p);
    const double phi = p.phi - origin;
    net.places.push_back({face->is_saddle ? (face->u(p.s) - lean * phi) / stretch : p.s, stretch * phi});
    return static_cast<Index>(points.size()) - 1;
}

template <class Face>
template <std::size_t n>
Index FaceMesher<Face>::add_middle(const std::array<Index, n>& of) {
    double x = 0, y = 0;
    for (const Index k : of) x += net.places[k].x / n, y += net.places[k].y / n;
    y /= stretch;
    const double s = face->is_saddle ? face->s(stretch * x + lean * y) : x;
    return add_point(inner_point(s, origin + y));
}

// Flip edges and put points on them until every triangle is close.
template <class Face>
void FaceMesher<Face>::improve(std::size_t most) {
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

// Flip to the other diagonal if that makes the worse of the two triangles better.
template <class Face>
bool FaceMesher<Face>::flip_to_better(Index t) {
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

// Remove inner points that are not needed; those amid lattice points are needed.
template <class Face>
void FaceMesher<Face>::simplify(Index rim, Index inner) {
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

template class FaceMesher<MeshFace>;
template class FaceMesher<RoundFace>;

}  // namespace cfree
