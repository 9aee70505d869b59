// Closed meshes: edges sampled once for all faces, then each face triangulated by itself; theory, "Meshes".
#include "cfree/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "cfree/mesh/mesh_face.hpp"
#include "cfree/mesh/triangulation.hpp"
#include "cfree/support/elementary.hpp"
#include "cfree/support/stop.hpp"

namespace cfree {

namespace {

using std::numbers::pi;
constexpr double on_curves = 0.7;     // share of the error that sampled curves may take: strips need it below sqrt(1/2)
constexpr double most_turn = pi / 4;    // between two samples of a curve
constexpr double rim_step = 4;        // greatest step along the rim of a wide e-v face, in units of the lattice
constexpr double rim_gap = 0.1;     // least distance of lattice points from the rim, in the same units
constexpr double stretch = 1.6;       // of the lattice along u: where h is large that is where the shear varies less
constexpr double golden = std::numbers::phi;
constexpr double best_density = 0.21650635094610965;  // sqrt(3) / 8: triangles a unit of w du dphi / error

bool is_curve(std::uint8_t side) { return side == 1 || side == 3; }

class Mesher {
public:
    Mesher(const CellComplex& cells, double most_error, double scale)
        : in(cells), trapezoids(cells.boundary->trapezoids), patches(cells.boundary->patches), scene(*cells.boundary->scene),
          error(most_error), angle_scale(scale), faces(static_cast<Index>(cells.component.size())),
          half_edges(static_cast<Index>(cells.face.size())) {
        for (Index v = 0; v < in.vertices; ++v) {  // the robot as it is, the obstacles from their origin
            const auto [c, s] = cosine_sine(in.theta[v]);
            const double a = scene.frame[2], b = scene.frame[3];
            places.emplace_back(in.xy[2 * v] + (0 - (c * a - s * b)), in.xy[2 * v + 1] + (0 - (s * a + c * b)));
        }
        mesh_faces.reserve(static_cast<std::size_t>(faces));
        for (Index f = 0; f < faces; ++f) mesh_faces.push_back(sheet_of(f));
        order.resize(static_cast<std::size_t>(half_edges));
        start.assign(static_cast<std::size_t>(in.edges) + 1, 0);
        for (Index h = 0; h < half_edges; ++h) ++start[in.edge[h] + 1];
        std::partial_sum(start.begin(), start.end(), start.begin());
        std::vector<Index> place(start.begin(), start.end() - 1);
        for (Index h = 0; h < half_edges; ++h) order[place[in.edge[h]]++] = h;
    }

    MeshEstimate estimate() const;
    Mesh run();

private:
    // Samples between the ends of an edge, in the direction of its first half-edge: angles of a curve, or shares of a side.
    using Samples = std::vector<double>;
    // Those of a pair of twins: `count` vertices from `begin` on in that direction; a side at the seam has them twice.
    struct Run {
        Index begin = 0, count = 0;
        bool forwards = true;
    };

    MeshFace sheet_of(Index f) const {
        const Feature on = patches.contact(trapezoids.patch[f]);
        double from = 0, to = 0;
        for (Index h = in.first[f]; h < in.first[f + 1]; ++h) {
            const double phi = angle(h);
            from = h == in.first[f] ? phi : std::min(from, phi), to = h == in.first[f] ? phi : std::max(to, phi);
        }
        return {{scene}, on, unpacked(trapezoids.lower[f]), unpacked(trapezoids.upper[f]), from, to, error, angle_scale};
    }
    Index after(Index h) const { return h + 1 == in.first[in.face[h] + 1] ? in.first[in.face[h]] : h + 1; }
    bool on_seam(Index v) const { return std::abs(in.theta[v] - 0.5 * pi) > pi - 1e-12; }
    bool is_late(Index h) const { return trapezoids.chart[in.face[h]] == 1; }
    // where the half-edge starts, as its face sees it
    double angle(Index h) const {
        const Index v = in.vertex[h];
        return on_seam(v) ? (is_late(h) ? 1.5 * pi : -0.5 * pi) : in.theta[v];
    }
    Complex place(Index h) const { return places[in.vertex[h]]; }
    double lattice_unit() const { return 2 * std::sqrt(error / angle_scale); }

    Samples samples_of_curve(Index edge) const;
    Samples samples_of_side(Index edge) const;
    double rim_limit(double across, double unit_along) const {  // for a step in u or phi, beside a face so wide in the other
        const double unit = lattice_unit();
        return std::max(rim_step * unit * unit_along, 1.6 * unit * unit / std::max(across, 1e-300));
    }
    std::vector<Samples> samples_of_edges() const;
    bool part_equal_edges();
    Index vertex_of(Index h);
    Index add_vertex(double x, double y, double theta);
    void add_run(Index h, Index first_half_edge, const Samples& samples);
    using Rim = std::array<std::vector<Index>, 4>;  // points by side
    void triangulate(Index f);
    Rim place_rim(Index f);
    void zip(const Rim& rim);
    double ideal_triangles(const MeshFace& sheet) const;
    void put_out(Index f);
    void add_lattice(const MeshFace& sheet);
    void improve(Index f, std::size_t most);
    bool flip_to_better(const MeshFace& sheet, Index t);
    void simplify(const MeshFace& sheet, Index rim, Index lattice);
    double excess(const MeshFace& sheet, Index p, Index q, Index r) const {
        return sheet.excess({&points[p], &points[q], &points[r]});
    }
    double excess(const MeshFace& sheet, Index t) const {
        const auto& c = net.triangles[t].corner;
        return excess(sheet, c[0], c[1], c[2]);
    }
    Index add_point(const MeshFace& sheet, const MeshPoint& p);
    template <std::size_t n>
    Index add_middle(const MeshFace& sheet, const std::array<Index, n>& of) {
        double x = 0, y = 0;
        for (const Index k : of) x += net.places[k].x / n, y += net.places[k].y / n;
        y /= stretch;
        return add_point(sheet, sheet.point(sheet.is_saddle ? angle_scale * std::sinh(stretch * x - sheet.shear * y) : x, y));
    }
    double scale_of_lattice(const MeshFace& sheet) const;

    const CellComplex& in;
    const Trapezoids& trapezoids;
    const Patches& patches;
    const Scene& scene;
    const double error, angle_scale;
    const Index faces, half_edges;
    std::vector<Complex> places;  // of the complex's vertices
    std::vector<MeshFace> mesh_faces;
    std::vector<Index> order, start;  // half-edges by edge
    std::vector<Index> early, late;   // mesh vertices of the complex's vertices; late ones at 3 pi / 2
    std::vector<Run> runs;            // of each half-edge
    Mesh out;
    Index rim_vertices = 0;
    // of the face at hand
    Triangulation net;
    std::vector<MeshPoint> points;
    Triangulation::Star star;
};

Mesher::Samples Mesher::samples_of_curve(Index edge) const {
    const Index first = order[start[edge]];
    const double a = std::min(angle(first), angle(after(first))), b = std::max(angle(first), angle(after(first)));
    double limit = most_turn;
    bool is_digon = false;
    for (Index k = start[edge]; k < start[edge + 1]; ++k) {
        const Index f = in.face[order[k]];
        if (mesh_faces[f].is_saddle) limit = std::min(limit, rim_limit(mesh_faces[f].most_width_u(), 1 / stretch));
        is_digon = is_digon || in.first[f + 1] - in.first[f] == 2;
    }
    const auto bend = [&](double from, double to) {
        double most = 0;
        for (Index k = start[edge]; k < start[edge + 1]; ++k)
            for (const ContactCurve& c : mesh_faces[in.face[order[k]]].curves) most = std::max(most, c.bend(from, to));
        return most;
    };
    Samples samples;
    for (double at = a; at < b - 1e-9;) {
        double step = b - at;
        for (;;) {
            const double most = std::min(limit, std::sqrt(8 * on_curves * error / std::max(bend(at, at + step), 1e-300)));
            if (step <= most * (1 + 1e-9)) break;
            step = std::max((b - at) / std::ceil((b - at) / most), 0.5 * step);
            if (step < 1e-12) break;
        }
        if (at + step >= b - 1e-12) break;
        samples.push_back(at += step);
    }
    if (samples.empty() && is_digon) samples.push_back(0.5 * (a + b));
    return samples;
}

Mesher::Samples Mesher::samples_of_side(Index edge) const {
    const Index first = order[start[edge]];
    const Complex p = place(first), q = place(after(first));
    Samples best;
    for (Index k = start[edge]; k < start[edge + 1]; ++k) {
        const MeshFace& sheet = mesh_faces[in.face[order[k]]];
        if (!sheet.is_saddle) continue;
        const double phi = angle(order[k]), s = sheet.position(p, phi), t = sheet.position(q, phi);
        const double from = sheet.u(s), to = sheet.u(t);
        const auto steps = static_cast<std::size_t>(std::ceil(std::abs(to - from) / rim_limit(sheet.to - sheet.from, stretch)));
        if (steps <= best.size() + 1) continue;
        best.clear();
        for (std::size_t j = 1; j < steps; ++j) {
            const double u = from + (to - from) * static_cast<double>(j) / static_cast<double>(steps);
            best.push_back((angle_scale * std::sinh(u) - s) / (t - s));
        }
    }
    return best;
}

Index Mesher::add_vertex(double x, double y, double theta) {
    out.xyz.insert(out.xyz.end(), {x, y, theta});
    return static_cast<Index>(out.xyz.size() / 3) - 1;
}

Index Mesher::vertex_of(Index h) {
    const Index v = in.vertex[h];
    Index& id = (on_seam(v) && is_late(h) ? late : early)[v];
    if (id < 0) id = add_vertex(places[v].real(), places[v].imag(), angle(h));
    return id;
}

// Vertices for the samples of a half-edge and its twin, which the other half-edges of the edge do not share.
void Mesher::add_run(Index h, Index first_half_edge, const Samples& samples) {
    const Index twin = in.twin[h], count = static_cast<Index>(samples.size());
    const bool curve = is_curve(in.side[h]);
    const Complex p = place(first_half_edge), q = place(after(first_half_edge));
    const auto forwards = [&](Index x) {
        if (curve) return in.side[x] == 1;
        return std::abs(place(x) - p) < std::abs(place(x) - q);
    };
    const auto add = [&](Index x) {
        const Index begin = static_cast<Index>(out.xyz.size() / 3);
        const MeshFace& sheet = mesh_faces[in.face[first_half_edge]];
        for (const double sample : samples) {
            const Complex z = !curve             ? p + sample * (q - p)
                              : sheet.is_thin() ? 0.5 * (p + q)
                                                : sheet.curves[in.side[first_half_edge] == 1].at(sample);
            add_vertex(z.real(), z.imag(), curve ? sample : angle(x));
        }
        runs[x] = {begin, count, forwards(x)};
    };
    add(h);
    if (!curve && std::abs(angle(h) - angle(twin)) > pi) {
        add(twin);
        for (Index k = 0; k < count; ++k) {
            const Index one = runs[h].begin + k, other = runs[twin].begin + k;
            out.seam.push_back(is_late(h) ? other : one), out.seam.push_back(is_late(h) ? one : other);
        }
    } else runs[twin] = {runs[h].begin, count, forwards(twin)};
}

Index Mesher::add_point(const MeshFace& sheet, const MeshPoint& p) {
    points.push_back(p);
    net.places.push_back({sheet.is_saddle ? (sheet.u(p.s) + sheet.shear * p.phi) / stretch : p.s, stretch * p.phi});
    return static_cast<Index>(points.size()) - 1;
}

// The largest share of the ideal area at which triangles of the lattice fit everywhere.
double Mesher::scale_of_lattice(const MeshFace& sheet) const {
    const double phi = 0.5 * (sheet.from + sheet.to), unit = lattice_unit();
    const double low = sheet.u(sheet.position(sheet.curves[0].at(phi), phi)), wide = sheet.width_u(phi);
    const auto fits = [&](double scale) {
        for (int k = 0; k <= 16; ++k) {
            std::array<MeshPoint, 3> p;
            const double x[] = {0, 1 / golden, golden}, y[] = {0, golden, 1 / golden};
            for (int c = 0; c < 3; ++c) {
                const double dy = scale * unit * y[c] / stretch;
                const double u = low + wide * k / 16 + stretch * scale * unit * (x[c] - 0.76) - sheet.shear * dy;
                p[c] = {angle_scale * std::sinh(u), phi + dy, {0, 0}};
            }
            if (sheet.excess_inside({&p[0], &p[1], &p[2]}) > 1) return false;
        }
        return true;
    };
    double scale = 1;
    while (scale > 0.5 && !fits(scale)) scale *= 0.985;
    return scale;
}

// Points of the lattice of best triangles: edges (1/g, g), (1, -1) and (g, 1/g), g the golden ratio, with |dx dy| = 1.
void Mesher::add_lattice(const MeshFace& sheet) {
    const double unit = lattice_unit() * scale_of_lattice(sheet);
    double left = 1e300, right = -1e300;
    for (const auto& p : net.places) left = std::min(left, p.x), right = std::max(right, p.x);
    const double x0 = 0.5 * (left + right), y0 = 0.5 * (sheet.from + sheet.to) * stretch, gap = rim_gap * unit;
    const double wide = 0.5 * (right - left) / unit, high = 0.5 * (sheet.to - sheet.from) * stretch / unit;
    // the point i (1/g, g) + j (1, -1)
    const auto rows = static_cast<Index>(std::ceil(wide * golden + high / golden)) + 2;
    std::vector<std::array<double, 2>> found;
    for (Index j = -rows; j <= rows; ++j) {
        heed_stop();
        const auto from = static_cast<Index>(std::floor((-high + j) / golden));
        const auto to = static_cast<Index>(std::ceil((high + j) / golden));
        for (Index i = from; i <= to; ++i) {
            const double x = x0 + unit * (i / golden + j), phi = (y0 + unit * (i * golden - j)) / stretch;
            if (x < left || x > right || phi < sheet.from + gap / stretch || phi > sheet.to - gap / stretch) continue;
            const double u = stretch * x - sheet.shear * phi;
            const MeshPoint p = sheet.point(angle_scale * std::sinh(u), phi);
            const double low = p.s - p.inward[0], up = p.s + p.inward[1];
            if (u - sheet.u(low) < gap * stretch || sheet.u(up) - u < gap * stretch) continue;
            const Index id = add_point(sheet, p);
            if (!net.insert(id)) points.pop_back(), net.places.pop_back();
        }
    }
}

// Flips edges and puts points on them until every triangle is close.
void Mesher::improve(Index f, std::size_t most) {
    const MeshFace& sheet = mesh_faces[f];
    auto& open = net.changed;
    open.resize(net.triangles.size());
    std::iota(open.rbegin(), open.rend(), 0);
    while (!open.empty()) {
        heed_stop();
        const Index t = open.back();
        open.pop_back();
        if (excess(sheet, t) <= 1 || flip_to_better(sheet, t)) continue;
        if (net.triangles.size() > most) throw std::logic_error("no triangles close enough on trapezoid " + std::to_string(f));
        const int k = net.longest_inner_edge(t);
        const auto& x = net.triangles[t].corner;
        if (k < 0) net.split_triangle(t, add_middle(sheet, x));
        else net.split_edge(t, k, add_middle(sheet, std::array{x[(k + 1) % 3], x[(k + 2) % 3]}));
        net.make_delaunay_around(static_cast<Index>(points.size()) - 1);
    }
}

// The other diagonal where that makes the worse of the two triangles better.
bool Mesher::flip_to_better(const MeshFace& sheet, Index t) {
    int best = -1;
    double least = 1;
    for (int k = 0; k < 3; ++k) {
        if (!net.can_flip(t, k)) continue;
        const auto& x = net.triangles[t];
        const Index a = x.corner[k], b = x.corner[(k + 1) % 3], c = x.corner[(k + 2) % 3], d = net.opposite(t, k);
        const double before = std::max(excess(sheet, t), excess(sheet, x.across[k]));
        const double now = std::max(excess(sheet, a, b, d), excess(sheet, d, c, a)) / before;
        if (now < 0.99 * least) least = now, best = k;
    }
    if (best < 0) return false;
    net.changed.push_back(t), net.changed.push_back(net.triangles[t].across[best]);
    net.flip(t, best);
    return true;
}

// Takes out inner points that are not needed; those amid lattice points are.
void Mesher::simplify(const MeshFace& sheet, Index rim, Index lattice) {
    std::vector<Index> at(points.size(), -1);
    for (Index t = 0; t < static_cast<Index>(net.triangles.size()); ++t)
        for (const Index c : net.triangles[t].corner) at[c] = t;
    const auto drop = [&](Index p) {
        for (std::size_t from = 0; from < star.link.size(); ++from) {
            const std::size_t n = star.link.size();
            const auto is_fine = [&](std::size_t k) {
                const Index b = star.link[(from + k) % n], c = star.link[(from + k + 1) % n];
                return excess(sheet, star.link[from], b, c) <= 1;
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
            const auto is_plain = [&](Index q) { return q >= rim && q < lattice; };
            if (is_plain(p) && std::all_of(star.link.begin(), star.link.end(), is_plain)) continue;
            again = drop(p) || again;
        }
    }
    net.sweep_dropped();
}

// From the rim inwards: a disc zipped between the two curves, points of the lattice where there is room, more where the bound
// asks for them, none that are not needed.
void Mesher::triangulate(Index f) {
    const MeshFace& sheet = mesh_faces[f];
    net.places.clear(), net.triangles.clear(), points.clear();
    zip(place_rim(f));
    const auto rim_end = static_cast<Index>(points.size());
    const double ideal = ideal_triangles(sheet);
    out.least += ideal;
    if (ideal > 4) {
        net.make_delaunay();
        add_lattice(sheet);
    }
    const auto lattice_end = static_cast<Index>(points.size());
    improve(f, 100 * points.size() + 10000);
    if (static_cast<Index>(points.size()) > rim_end) simplify(sheet, rim_end, lattice_end);
    put_out(f);
}

// Points of the four sides, in the order of the loop, without the half-edges' last ends.
Mesher::Rim Mesher::place_rim(Index f) {
    const MeshFace& sheet = mesh_faces[f];
    Rim rim;
    for (Index h = in.first[f]; h < in.first[f + 1]; ++h) {
        const auto add = [&](Index vertex, Complex x, double phi) {
            MeshPoint p = sheet.point(sheet.position(x, phi), phi);
            if (in.side[h] == 1) p.inward[1] = 0;
            if (in.side[h] == 3) p.inward[0] = 0;
            p.vertex = vertex;
            rim[in.side[h]].push_back(add_point(sheet, p));
        };
        add(vertex_of(h), place(h), angle(h));
        const Run& run = runs[h];
        for (Index k = 0; k < run.count; ++k) {
            const Index v = run.begin + (run.forwards ? k : run.count - 1 - k);
            add(v, {out.xyz[3 * v], out.xyz[3 * v + 1]}, out.xyz[3 * v + 2]);
        }
    }
    return rim;
}

// The face between its curves, then the points of its first and last side put on the rim.
void Mesher::zip(const Rim& rim) {
    const auto corner = [&](int side) {  // lower left, lower right, upper right, upper left
        for (int k = 0; k < 4; ++k)
            if (!rim[(side + k) % 4].empty()) return rim[(side + k) % 4].front();
        return Index(-1);
    };
    std::vector<Index> left = rim[3], right = rim[1];
    left.push_back(corner(0)), right.push_back(corner(2));
    std::reverse(left.begin(), left.end());
    points[left.front()].inward[0] = points[left.back()].inward[0] = 0;
    points[right.front()].inward[1] = points[right.back()].inward[1] = 0;
    net.zip(left, right);
    const auto split = [&](const std::vector<Index>& side, Index end) {
        for (std::size_t k = 1; k < side.size(); ++k) net.split_rim(side[k - 1], end, side[k]);
    };
    split(rim[0], corner(1)), split(rim[2], corner(3));
}

// How many triangles the best known density asks for: its integral over the face, by Simpson's rule.
double Mesher::ideal_triangles(const MeshFace& sheet) const {
    if (!sheet.is_saddle || sheet.is_thin()) return 0;
    double sum = 0;
    const int parts = 16;
    for (int k = 0; k <= parts; ++k)
        sum += (k == 0 || k == parts ? 1 : k % 2 ? 4 : 2) * sheet.width_u(sheet.from + k * (sheet.to - sheet.from) / parts);
    return best_density * angle_scale * (sheet.to - sheet.from) * sum / (3 * parts) / error;
}

// The triangles of a face, and its inner points as vertices.
void Mesher::put_out(Index f) {
    for (const Triangle& t : net.triangles) {
        for (const Index c : t.corner) {
            MeshPoint& p = points[c];
            if (p.vertex < 0) {
                const Complex x = mesh_faces[f].at(p.s, p.phi);
                p.vertex = add_vertex(x.real(), x.imag(), p.phi);
            }
            out.corners.push_back(p.vertex);
        }
        out.face.push_back(f);
    }
}

// Samples of all edges; of those between the same two vertices, without samples, all but one get one.
std::vector<Mesher::Samples> Mesher::samples_of_edges() const {
    std::vector<Samples> samples(static_cast<std::size_t>(in.edges));
    std::vector<std::array<Index, 3>> plain;
    for (Index e = 0; e < in.edges; ++e) {
        const Index first = order[start[e]];
        heed_stop();
        samples[e] = is_curve(in.side[first]) ? samples_of_curve(e) : samples_of_side(e);
        for (Index k = start[e]; samples[e].empty() && k < start[e + 1]; ++k) {
            const auto [p, q] = std::minmax(in.vertex[order[k]], in.vertex[after(order[k])]);
            if (order[k] < in.twin[order[k]]) plain.push_back({p, q, e});
        }
    }
    std::sort(plain.begin(), plain.end());
    for (std::size_t k = 1; k < plain.size(); ++k) {
        const auto &x = plain[k - 1], &y = plain[k];
        const Index first = order[start[y[2]]];
        if (x[0] == y[0] && x[1] == y[1] && samples[y[2]].empty())
            samples[y[2]].push_back(is_curve(in.side[first]) ? 0.5 * (angle(first) + angle(after(first))) : 0.5);
    }
    return samples;
}

// Two faces may have inner edges between the same two points of their rims: such edges are cut in the middle.
bool Mesher::part_equal_edges() {
    struct Edge {
        Index p, q, triangle, face;
        auto key() const { return std::array{p, q, face}; }
    };
    std::vector<Edge> found;
    const auto count = static_cast<Index>(out.face.size());
    for (Index t = 0; t < count; ++t)
        for (int k = 0; k < 3; ++k) {
            const auto [p, q] = std::minmax(out.corners[3 * t + k], out.corners[3 * t + (k + 1) % 3]);
            if (q < rim_vertices) found.push_back({p, q, t, out.face[t]});
        }
    std::sort(found.begin(), found.end(), [](const Edge& x, const Edge& y) { return x.key() < y.key(); });
    std::vector<char> is_cut(static_cast<std::size_t>(count), 0);
    bool any = false;
    for (std::size_t begin = 0, end; begin < found.size(); begin = end) {
        for (end = begin; end < found.size() && found[end].p == found[begin].p && found[end].q == found[begin].q;) ++end;
        for (std::size_t k = begin; end - begin > 2 && k + 1 < end; ++k) {
            const Edge &x = found[k], &y = found[k + 1];
            if (x.face != y.face || is_cut[x.triangle] || is_cut[y.triangle]) continue;
            const auto middle = [&](int c) { return 0.5 * (out.xyz[3 * x.p + c] + out.xyz[3 * x.q + c]); };
            const Index m = add_vertex(middle(0), middle(1), middle(2));
            for (const Index t : {x.triangle, y.triangle}) {
                is_cut[t] = 1, any = true;
                int c = 0;  // the corner off the edge
                while (out.corners[3 * t + c] == x.p || out.corners[3 * t + c] == x.q) ++c;
                const auto corner = [&](int step) { return out.corners[3 * t + (c + step) % 3]; };
                const Index a = corner(0), p = corner(1), q = corner(2);
                out.corners[3 * t] = a, out.corners[3 * t + 1] = p, out.corners[3 * t + 2] = m;
                out.corners.insert(out.corners.end(), {a, m, q});
                out.face.push_back(x.face);
            }
        }
    }
    return any;
}

Mesh Mesher::run() {
    early.assign(static_cast<std::size_t>(in.vertices), -1), late = early;
    runs.resize(static_cast<std::size_t>(half_edges));
    const auto samples = samples_of_edges();
    for (Index e = 0; e < in.edges; ++e)
        for (Index k = start[e]; !samples[e].empty() && k < start[e + 1]; ++k)
            if (order[k] < in.twin[order[k]]) add_run(order[k], order[start[e]], samples[e]);
    for (Index h = 0; h < half_edges; ++h) vertex_of(h);
    rim_vertices = static_cast<Index>(out.xyz.size() / 3);
    for (Index f = 0; f < faces; ++f) triangulate(f);
    while (part_equal_edges()) {}
    for (Index v = 0; v < in.vertices; ++v)
        if (early[v] >= 0 && late[v] >= 0) out.seam.push_back(early[v]), out.seam.push_back(late[v]);
    for (std::size_t k = 0; k < out.xyz.size(); k += 3)
        out.xyz[k] += scene.frame[0], out.xyz[k + 1] += scene.frame[1], out.xyz[k + 2] *= angle_scale;
    return std::move(out);
}

MeshEstimate Mesher::estimate() const {
    MeshEstimate result{static_cast<double>(half_edges), 0};
    for (Index f = 0; f < faces; ++f) {
        const MeshFace& sheet = mesh_faces[f];
        const double high = sheet.to - sheet.from;
        if (sheet.is_thin()) continue;
        if (sheet.is_saddle) result.triangles += 1.1 * best_density * angle_scale * high * sheet.most_width_u() / error;
        for (const ContactCurve& c : sheet.curves) {
            const double bend = c.bend(sheet.from + 0.25 * high, sheet.to - 0.25 * high);
            result.triangles += high * std::sqrt(bend / (8 * on_curves * error));
        }
    }
    result.triangles += result.coarsest;
    return result;
}

}  // namespace

MeshEstimate estimate_mesh(const CellComplex& cells, double error, double angle_scale) {
    return Mesher(cells, error, angle_scale).estimate();
}
Mesh mesh(const CellComplex& cells, double error, double angle_scale) { return Mesher(cells, error, angle_scale).run(); }

}  // namespace cfree
