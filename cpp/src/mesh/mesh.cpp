// Closed meshes: edges sampled once for all faces, then each face triangulated by itself; theory, "Meshes".
#include "cfree/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "cfree/mesh/face_mesher.hpp"
#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

using std::numbers::pi;
constexpr double most_turn = pi / 4;  // greatest turn between two samples of a curve
constexpr double shorter = 0.9;       // share of a chord's step that is tried next, if the bound of a face forbids the chord
constexpr int most_tries = 16;        // then doubles tell too little of the curve: the face's triangles will show that
constexpr double nearest_part = 0.05;    // share of a layout's step: an end of an edge so near to a point replaces it

bool is_curve(std::uint8_t side) { return side == 1 || side == 3; }

template <class Face>
class Mesher {
public:
    Mesher(const CellComplex& cells, double most_error, double scale, bool off_surface = false)
        : in(cells), trapezoids(cells.boundary->trapezoids), patches(cells.boundary->patches), scene(*cells.boundary->scene),
          error(most_error), angle_scale(scale), faces(static_cast<Index>(cells.component.size())),
          half_edges(static_cast<Index>(cells.face.size())), filler(most_error, off_surface) {
        for (Index v = 0; v < in.vertices; ++v) {  // the robot unchanged, the obstacles from their origin
            const auto [c, s] = cosine_sine(in.places().theta[v]);
            const double a = scene.frame[2], b = scene.frame[3];
            places.emplace_back(in.places().xy[2 * v] + (0 - (c * a - s * b)), in.places().xy[2 * v + 1] + (0 - (s * a + c * b)));
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
    // Samples of a pair of twins: `count` vertices from `begin` on in that direction; a side at the seam has them twice.
    struct Run {
        Index begin = 0, count = 0;
        bool forwards = true;
    };

    static constexpr bool is_round = std::is_same_v<Face, RoundFace>;

    Face sheet_of(Index f) const {
        const Feature on = patches.contact(trapezoids.patch[f]);
        double from = 0, to = 0;
        for (Index h = in.first[f]; h < in.first[f + 1]; ++h) {
            const double phi = angle(h);
            from = h == in.first[f] ? phi : std::min(from, phi), to = h == in.first[f] ? phi : std::max(to, phi);
        }
        return {{scene}, on, unpacked(trapezoids.lower[f]), unpacked(trapezoids.upper[f]), from, to, error, angle_scale};
    }
    Index after(Index h) const { return h + 1 == in.first[in.face[h] + 1] ? in.first[in.face[h]] : h + 1; }
    bool on_seam(Index v) const { return std::abs(in.places().theta[v] - 0.5 * pi) > pi - 1e-12; }
    bool is_late(Index h) const { return trapezoids.chart[in.face[h]] == 1; }
    // start of the half-edge, by its face's equations
    double angle(Index h) const {
        const Index v = in.vertex[h];
        return on_seam(v) ? (is_late(h) ? 1.5 * pi : -0.5 * pi) : in.places().theta[v];
    }
    Complex place(Index h) const { return places[in.vertex[h]]; }

    void lay_out();
    std::optional<Wanted> wanted_by_neighbours(Index f) const;
    bool is_of_digon(Index edge) const;  // a face with two sides has it
    Samples samples_of_curve(Index edge) const;
    Samples samples_of_side(Index edge) const;
    Samples samples_of_round_curve(Index edge) const;
    Samples samples_of_round_side(Index edge) const;
    Complex sampled(Index h, double sample) const;
    std::vector<Samples> samples_of_edges() const;
    bool part_equal_edges();
    Index vertex_of(Index h);
    Index add_vertex(double x, double y, double theta);
    void add_run(Index h, Index first_half_edge, const Samples& samples);
    Rim rim_of(Index f);
    void triangulate(Index f);

    const CellComplex& in;
    const Trapezoids& trapezoids;
    const Patches& patches;
    const Scene& scene;
    const double error, angle_scale;
    const Index faces, half_edges;
    std::vector<Complex> places;  // places of the complex's vertices
    std::vector<Face> mesh_faces;
    std::vector<Index> order, start;  // half-edges by edge
    std::vector<Index> early, late;   // mesh vertices of the complex's vertices; late ones at 3 pi / 2
    std::vector<Run> runs;            // one per half-edge
    Mesh out;
    Index rim_vertices = 0;
    std::vector<Layout> layouts;
    FaceMesher<Face> filler;
};

template <class Face>
bool Mesher<Face>::is_of_digon(Index edge) const {
    return std::any_of(order.begin() + start[edge], order.begin() + start[edge + 1], [&](Index h) {
        const Index f = in.face[h];
        return in.first[f + 1] - in.first[f] == 2;
    });
}

// Samples of a curve: angles at which the rows of one of the faces end, with others between them if the curve bends too much,
// or if a face's bound forbids the chord, and so every triangle with it.
template <class Face>
typename Mesher<Face>::Samples Mesher<Face>::samples_of_curve(Index edge) const {
    const Index first = order[start[edge]];
    const double a = std::min(angle(first), angle(after(first))), b = std::max(angle(first), angle(after(first)));
    Samples stops;
    for (Index k = start[edge]; k < start[edge + 1]; ++k) {
        const Index f = in.face[order[k]];
        Samples ends;
        const auto& of = layouts[f].stops[in.side[order[k]] == 1];
        const double near_by = nearest_part * (mesh_faces[f].to - mesh_faces[f].from) / static_cast<double>(of.size() + 1);
        for (const double angle : of)
            if (angle > a + near_by && angle < b - near_by) ends.push_back(angle);
        if (ends.size() > stops.size()) stops = std::move(ends);
    }
    const auto bend = [&](double from, double to) {
        double most = 0;
        for (Index k = start[edge]; k < start[edge + 1]; ++k)
            for (const ContactCurve& c : mesh_faces[in.face[order[k]]].curves) most = std::max(most, c.bend_near(from, to));
        return most;
    };
    const bool rises = angle(first) < angle(after(first));
    const Complex at_a = place(rises ? first : after(first)), at_b = place(rises ? after(first) : first);
    const auto is_close = [&](double from, double to) {
        return std::all_of(order.begin() + start[edge], order.begin() + start[edge + 1], [&](Index h) {
            const Face& sheet = mesh_faces[in.face[h]];
            if (sheet.is_thin()) return true;
            const bool upper = in.side[h] == 1;
            const auto corner = [&](double phi) {
                const Complex x = phi == a ? at_a : phi == b ? at_b : sheet.curves[upper].at(phi);
                MeshPoint p = sheet.point(sheet.position(x, phi), phi);
                p.inward[upper] = 0;
                return p;
            };
            const MeshPoint p = corner(from), q = corner(to);
            return sheet.excess({&p, &q, &p}) <= 1 - 1e-9;
        });
    };
    Samples samples;
    stops.push_back(b);
    double at = a;
    for (const double stop : stops) {
        while (at < stop - 1e-9) {
            double step = stop - at;
            for (int tries = 0;;) {
                double most = std::min(most_turn, std::sqrt(8 * on_curves * error / std::max(bend(at, at + step), 1e-300)));
                if (step <= most * (1 + 1e-9)) {
                    if (is_close(at, at + step < stop ? at + step : stop) || ++tries > most_tries) break;
                    most = shorter * step;
                }
                step = std::max((stop - at) / std::ceil((stop - at) / most), 0.5 * step);
                if (step < 1e-12) break;
            }
            if (at + step >= b - 1e-12) break;
            samples.push_back(at += step);
        }
    }
    if (samples.empty() && is_of_digon(edge)) samples.push_back(0.5 * (a + b));
    return samples;
}

// The same among rounded shapes: angles between which all faces' bounds allow the chord.
template <class Face>
typename Mesher<Face>::Samples Mesher<Face>::samples_of_round_curve(Index edge) const {
    const Index first = order[start[edge]];
    const bool rises = angle(first) < angle(after(first));
    const Index low = rises ? first : after(first), high = rises ? after(first) : first;
    const double a = angle(low), b = angle(high);
    const auto is_close = [&](double from, double to) {
        return std::all_of(order.begin() + start[edge], order.begin() + start[edge + 1], [&](Index h) {
            const Face& sheet = mesh_faces[in.face[h]];
            if (sheet.is_thin()) return true;
            const bool upper = in.side[h] == 1;
            const auto corner = [&](double phi) {
                const double s = phi == a   ? sheet.position(place(low), phi)
                                 : phi == b ? sheet.position(place(high), phi)
                                            : sheet.curves[upper].position(phi);
                return sheet.point(s, phi);
            };
            return sheet.is_close(corner(from), corner(to), upper);
        });
    };
    Samples samples;
    constexpr double least_step = 1e-11;  // then doubles tell too little of the curve
    double step = std::min(most_turn, b - a);
    for (double at = a; at < b;) {
        heed_stop();
        step = std::min(2 * step, most_turn);
        if (step > b - at - least_step) step = b - at;
        while (step > least_step && !is_close(at, step < b - at ? at + step : b)) step *= shorter;
        if (step >= b - at - least_step) break;
        samples.push_back(at += std::max(step, least_step));
    }
    if (samples.empty() && is_of_digon(edge)) samples.push_back(0.5 * (a + b));
    return samples;
}

// Samples of a side: as many parts as a row there has, or as the points next to the side need, in all faces of its patch.
template <class Face>
typename Mesher<Face>::Samples Mesher<Face>::samples_of_side(Index edge) const {
    const Index first = order[start[edge]];
    const Complex p = place(first), q = place(after(first));
    Samples best;
    for (Index k = start[edge]; k < start[edge + 1]; ++k) {
        const Index f = in.face[order[k]];
        const Face& sheet = mesh_faces[f];
        if (layouts[f].is_empty()) continue;
        std::vector<Wall> walls;
        for (Index m = start[edge]; m < start[edge + 1]; ++m)
            if (const Index g = in.face[order[m]]; trapezoids.patch[g] == trapezoids.patch[f])
                walls.push_back({&mesh_faces[g], angle(order[m]), &layouts[g].ends[in.side[order[m]] == 2]});
        const double phi = angle(order[k]), s = sheet.position(p, phi), t = sheet.position(q, phi);
        const double from = sheet.u(std::min(s, t)), to = sheet.u(std::max(s, t));
        Samples found = wall_points(walls, error, from, to);
        if (const int parts = layouts[f].parts[in.side[order[k]] == 2]; parts > 0) {
            const auto steps = static_cast<int>(std::lround(parts * (to - from) / sheet.width_u(phi)));
            found.clear();
            for (int j = 1; j < steps; ++j) found.push_back(from + (to - from) * j / steps);
        }
        for (double& each : found) each = (sheet.s(each) - s) / (t - s);
        if (s > t) std::reverse(found.begin(), found.end());
        if (found.size() > best.size()) best = std::move(found);
    }
    return best;
}

// Samples of a side among rounded shapes: a straight line needs none, an arc equal steps.
template <class Face>
typename Mesher<Face>::Samples Mesher<Face>::samples_of_round_side(Index edge) const {
    const Index first = order[start[edge]];
    const Face& sheet = mesh_faces[in.face[first]];
    const double phi = angle(first), wide = std::abs(sheet.position(place(after(first)), phi) - sheet.position(place(first), phi));
    const auto steps = static_cast<int>(std::ceil(wide / sheet.side_step()));
    Samples samples;
    for (int j = 1; j < steps; ++j) samples.push_back(static_cast<double>(j) / steps);
    return samples;
}

template <class Face>
Index Mesher<Face>::add_vertex(double x, double y, double theta) {
    out.xyz.insert(out.xyz.end(), {x, y, theta});
    return static_cast<Index>(out.xyz.size() / 3) - 1;
}

template <class Face>
Index Mesher<Face>::vertex_of(Index h) {
    const Index v = in.vertex[h];
    Index& id = (on_seam(v) && is_late(h) ? late : early)[v];
    if (id < 0) id = add_vertex(places[v].real(), places[v].imag(), angle(h));
    return id;
}

// Point of a sample on a half-edge, which is the first of its edge.
template <class Face>
Complex Mesher<Face>::sampled(Index h, double sample) const {
    const Complex p = place(h), q = place(after(h));
    const Face& sheet = mesh_faces[in.face[h]];
    const bool curve = is_curve(in.side[h]), upper = in.side[h] == 1;
    if (curve && sheet.is_thin()) return 0.5 * (p + q);
    if constexpr (is_round) {
        if (curve) return sheet.at(sheet.curves[upper].position(sample), sample);
        if (!sheet.is_circle) return p + sample * (q - p);
        const double phi = angle(h), s = sheet.position(p, phi);
        return sheet.at(s + sample * (sheet.position(q, phi) - s), phi);
    } else {
        return curve ? sheet.curves[upper].at(sample) : p + sample * (q - p);
    }
}

// Add vertices for the samples of a half-edge and its twin; the other half-edges of the edge do not share them.
template <class Face>
void Mesher<Face>::add_run(Index h, Index first_half_edge, const Samples& samples) {
    const Index twin = in.twin[h], count = static_cast<Index>(samples.size());
    const bool curve = is_curve(in.side[h]);
    const Complex p = place(first_half_edge), q = place(after(first_half_edge));
    const auto forwards = [&](Index x) {
        if (curve) return in.side[x] == 1;
        return std::abs(place(x) - p) < std::abs(place(x) - q);
    };
    const auto add = [&](Index x) {
        const Index begin = static_cast<Index>(out.xyz.size() / 3);
        for (const double sample : samples) {
            const Complex z = sampled(first_half_edge, sample);
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

// Points of the four sides, in the order of the loop, without the half-edges' last ends.
template <class Face>
Rim Mesher<Face>::rim_of(Index f) {
    const Face& sheet = mesh_faces[f];
    Rim rim;
    for (Index h = in.first[f]; h < in.first[f + 1]; ++h) {
        const auto add = [&](Index vertex, Complex x, double phi) {
            MeshPoint p = sheet.point(sheet.position(x, phi), phi);
            if (in.side[h] == 1) p.inward[1] = 0;
            if (in.side[h] == 3) p.inward[0] = 0;
            p.vertex = vertex;
            rim[in.side[h]].push_back(p);
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

// Add the triangles of a face, and its inner points as vertices.
template <class Face>
void Mesher<Face>::triangulate(Index f) {
    const Face& sheet = mesh_faces[f];
    if constexpr (is_round) out.least += sheet.least();
    else out.least += least_triangles(sheet, error);
    filler.fill(sheet, rim_of(f), is_round ? Layout{} : layouts[f], f);
    for (const Triangle& t : filler.net.triangles) {
        for (const Index c : t.corner) {
            MeshPoint& p = filler.points[c];
            if (p.vertex < 0) {
                const Complex x = [&] {
                    if constexpr (is_round) return sheet.at(p.s, p.phi);
                    else return sheet.at(p.s, p.phi, p.off);
                }();
                p.vertex = add_vertex(x.real(), x.imag(), p.phi);
            }
            out.corners.push_back(p.vertex);
        }
        out.face.push_back(f);
    }
}

// Samples of all edges; of edges without samples between the same two vertices, all but one get a sample.
template <class Face>
std::vector<typename Mesher<Face>::Samples> Mesher<Face>::samples_of_edges() const {
    std::vector<Samples> samples(static_cast<std::size_t>(in.edges));
    std::vector<std::array<Index, 3>> plain;
    for (Index e = 0; e < in.edges; ++e) {
        const Index first = order[start[e]];
        heed_stop();
        const bool curve = is_curve(in.side[first]);
        if constexpr (is_round) samples[e] = curve ? samples_of_round_curve(e) : samples_of_round_side(e);
        else samples[e] = curve ? samples_of_curve(e) : samples_of_side(e);
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

// Cut inner edges in the middle if two faces have them between the same two points of their rims.
template <class Face>
bool Mesher<Face>::part_equal_edges() {
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

// Lay out large faces first; others take the same points on common curves, if that is cheap.
template <class Face>
void Mesher<Face>::lay_out() {
    std::vector<double> least;
    for (const Face& sheet : mesh_faces) least.push_back(least_triangles(sheet, error));
    std::vector<Index> by_size(static_cast<std::size_t>(faces));
    std::iota(by_size.begin(), by_size.end(), 0);
    std::stable_sort(by_size.begin(), by_size.end(), [&](Index f, Index g) { return least[f] > least[g]; });
    layouts.resize(static_cast<std::size_t>(faces));
    for (const Index f : by_size)
        if (least[f] > few_triangles) layouts[f] = best_layout(mesh_faces[f], error, wanted_by_neighbours(f));
}

// Points that neighbours want, at equal steps, by the neighbour that shares most.
template <class Face>
std::optional<Wanted> Mesher<Face>::wanted_by_neighbours(Index f) const {
    std::optional<Wanted> result;
    double most = 0;
    for (Index h = in.first[f]; h < in.first[f + 1]; ++h) {
        const double high = std::abs(angle(after(h)) - angle(h));
        const Index twin = in.twin[h];
        const auto& stops = layouts[in.face[twin]].stops[in.side[twin] == 1];
        if (!is_curve(in.side[h]) || high <= most || stops.size() < 3) continue;
        const double step = (stops.back() - stops.front()) / static_cast<double>(stops.size() - 1);
        if (std::abs(stops[1] - stops[0] - step) > 1e-3 * step) continue;
        most = high, result = Wanted{in.side[h] == 1, stops.front(), step, high / step};
    }
    return result;
}

template <class Face>
Mesh Mesher<Face>::run() {
    early.assign(static_cast<std::size_t>(in.vertices), -1), late = early;
    runs.resize(static_cast<std::size_t>(half_edges));
    if constexpr (!is_round) lay_out();
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

template <class Face>
MeshEstimate Mesher<Face>::estimate() const {
    MeshEstimate result{static_cast<double>(half_edges), 0};
    for (const Face& sheet : mesh_faces) {
        if (sheet.is_thin()) continue;
        if constexpr (is_round) {
            result.triangles += sheet.estimate();
        } else {
            const double high = sheet.to - sheet.from;
            result.triangles += 1.3 * least_triangles(sheet, error);
            for (const ContactCurve& c : sheet.curves) {
                const double bend = c.bend(sheet.from + 0.25 * high, sheet.to - 0.25 * high);
                result.triangles += high * std::sqrt(bend / (8 * on_curves * error));
            }
        }
    }
    result.triangles += result.coarsest;
    return result;
}

}  // namespace

MeshEstimate estimate_mesh(const CellComplex& cells, double error, double angle_scale) {
    if (cells.boundary->scene->is_round) return Mesher<RoundFace>(cells, error, angle_scale).estimate();
    return Mesher<MeshFace>(cells, error, angle_scale).estimate();
}
Mesh mesh(const CellComplex& cells, double error, double angle_scale, bool off_surface) {
    if (cells.boundary->scene->is_round) return Mesher<RoundFace>(cells, error, angle_scale).run();
    return Mesher<MeshFace>(cells, error, angle_scale, off_surface).run();
}

}  // namespace cfree
