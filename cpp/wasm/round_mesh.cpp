// Sides are sampled once for both faces; each face is zipped between its curves, and gets a grid over theta and t, or psi.
#include "round_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "cfree/forbidden/limits.hpp"
#include "cfree/mesh/triangulation.hpp"
#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

using std::numbers::pi;
constexpr double most_turn = pi / 12;    // greatest step of theta and psi: light changes smoothly
constexpr double on_curves = 0.5;        // share of the error that chords of curves may take
constexpr double least_angle = 1e-7;     // steps of theta below it are not divided
constexpr std::size_t most_rows = 2000;  // of a grid over a face, and points in a row

// Parts of about a step, the same for sizes that are equal up to rounding.
int parts(double size, double step) { return static_cast<int>(std::min<double>(most_rows, std::ceil(size / step - 1e-9))); }

using Xy = Vec<double>;
struct Sample {
    double theta;
    Xy at;
};

// A face and its surface, from the scene's frame.
class Sheet {
public:
    Sheet(const CellComplex& cells, const Limits& by, Index which, double error)
        : limits(by), face(which), chart(cells.boundary->trapezoids.chart[static_cast<std::size_t>(which)]) {
        const Boundary& boundary = *cells.boundary;
        const Scene& scene = boundary.scene->near();
        const auto k = static_cast<std::size_t>(which);
        contact = boundary.patches.contact(boundary.trapezoids.patch[k]);
        from = theta_of(chart, boundary.trapezoids.tau_from(which)), to = theta_of(chart, boundary.trapezoids.tau_to(which));
        const UserUnits of;
        const auto reach = [&](Index v) { return norm(of.vertex(boundary.scene->robot, v).x, of.vertex(boundary.scene->robot, v).y); };
        const Limits::Line line = limits.line(contact, rotation(from));
        const bool turns = contact.kind == Kind::edge_vertex;
        const double arm = turns ? std::max(reach(scene.robot.v[contact.robot]), reach(scene.robot.w[contact.robot])) : reach(contact.robot);
        const auto step = [&](double radius) { return std::min(most_turn, std::sqrt(4 * error / std::max(radius, 1e-300))); };
        turn = step(arm);
        length = norm(line.u.x, line.u.y);
        across = line.is_circle() ? step(line.radius) : turns ? 2 * error / turn : HUGE_VAL;
    }

    Rotation<double> rotation(double theta) const {
        const auto [c, s] = cosine_sine(theta);
        return {c, s, 1};
    }
    Limits::Line line(double theta) const { return limits.line(contact, rotation(theta)); }
    // Coordinate on the surface: a length on a line, psi on a circle.
    double u(double t) const { return is_circle() ? 2 * arc_tangent(t) : length * t; }
    double u(const Xy& p, double theta) const {
        const Limits::Line on = line(theta);
        Xy d{p.x - on.p.x, p.y - on.p.y};
        if (!on.is_circle()) return (d.x * on.u.x + d.y * on.u.y) / length;
        for (int k = 0; k < on.quadrant; ++k) d = {d.y, -d.x};
        return arc_tangent(d.y, d.x);
    }
    Xy at(double u, double theta) const {
        const Limits::Line on = line(theta);
        return on.at(is_circle() ? tangent(0.5 * u) : u / length);
    }
    std::array<double, 2> ends(double theta) const {
        const auto [lower, upper] = limits.meetings(face, theta);
        return {u(lower.t), u(upper.t)};
    }
    Sample on_curve(bool is_upper, double theta) const { return {theta, at(ends(theta)[is_upper], theta)}; }
    bool is_circle() const { return contact.kind == Kind::vertex_vertex; }

    const Limits& limits;
    const Index face;
    const int chart;
    Feature contact;
    double from, to, length;
    double turn, across;  // steps of theta and of u
};

class RoundMesher {
public:
    RoundMesher(const CellComplex& cells, double most_error, double scale, double most)
        : in(cells), scene(*cells.boundary->scene), limits(*cells.boundary), error(most_error), angle_scale(scale), most_triangles(most) {
        for (Index f = 0; f < static_cast<Index>(in.component.size()); ++f) sheets.emplace_back(in, limits, f, error);
    }

    std::optional<Mesh> run() {
        for (Index f = 0; f < static_cast<Index>(sheets.size()); ++f) {
            fill(f);
            if (static_cast<double>(out.face.size()) > most_triangles) return {};
        }
        const auto& [bx, by, ax, ay] = scene.frame;
        for (std::size_t k = 0; k < out.xyz.size(); k += 3) {
            const auto [c, s] = cosine_sine(out.xyz[k + 2]);
            out.xyz[k] += bx - (c * ax - s * ay), out.xyz[k + 1] += by - (s * ax + c * ay), out.xyz[k + 2] *= angle_scale;
        }
        return std::move(out);
    }

private:
    struct Point {
        Index vertex;
        double u, theta;
    };
    // Vertices of an edge: of a curve by theta, of others from a place on. Half-edges of an edge may have other vertices at its ends.
    struct Run {
        Index begin, count;
        Xy from;
    };

    bool is_curve(Index h) const { return static_cast<Side>(in.side[h]) == Side::upper || static_cast<Side>(in.side[h]) == Side::lower; }
    Index after(Index h) const { return h + 1 == in.first[in.face[h] + 1] ? in.first[in.face[h]] : h + 1; }
    bool is_late(Index h) const { return sheets[in.face[h]].chart == 1; }
    bool on_seam(Index v) const { return std::abs(in.theta[v] - 0.5 * pi) > pi - 1e-12; }
    // Start of a half-edge, by its face's equations.
    double angle(Index h) const {
        const Index v = in.vertex[h];
        return on_seam(v) ? (is_late(h) ? 1.5 * pi : -0.5 * pi) : in.theta[v];
    }
    Xy place(Index h) const { return {in.xy[2 * in.vertex[h]], in.xy[2 * in.vertex[h] + 1]}; }

    Index add_vertex(const Sample& p) {
        out.xyz.insert(out.xyz.end(), {p.at.x, p.at.y, p.theta});
        return static_cast<Index>(out.xyz.size() / 3) - 1;
    }
    Index vertex_of(Index h) {
        const std::pair key{in.vertex[h], on_seam(in.vertex[h]) && is_late(h)};
        const auto [found, is_new] = vertices.try_emplace(key, 0);
        if (is_new) found->second = add_vertex({angle(h), place(h)});
        return found->second;
    }

    // Samples between two points of a curve.
    void bisect(const Sheet& sheet, bool is_upper, const Sample& p, const Sample& q, double turn, std::vector<Sample>& into) const {
        const Sample m = sheet.on_curve(is_upper, 0.5 * (p.theta + q.theta));
        const double w = angle_scale, dx = q.at.x - p.at.x, dy = q.at.y - p.at.y, dz = w * (q.theta - p.theta);
        const double x = m.at.x - p.at.x, y = m.at.y - p.at.y, z = w * (m.theta - p.theta);
        const double share = (x * dx + y * dy + z * dz) / (dx * dx + dy * dy + dz * dz);
        const double off = norm(norm(x - share * dx, y - share * dy), z - share * dz);
        if (q.theta - p.theta <= turn && (off <= on_curves * error || q.theta - p.theta < least_angle)) return;
        bisect(sheet, is_upper, p, m, turn, into);
        into.push_back(m);
        bisect(sheet, is_upper, m, q, turn, into);
    }
    std::vector<Sample> samples_of_curve(Index h) const {
        const Sheet& sheet = sheets[in.face[h]];
        const Index twin = in.twin[h];
        const double turn = twin < 0 ? sheet.turn : std::min(sheet.turn, sheets[in.face[twin]].turn);
        std::vector<Sample> samples;
        const Sample start{angle(h), place(h)}, end{angle(after(h)), place(after(h))};
        const bool is_upper = static_cast<Side>(in.side[h]) == Side::upper;
        bisect(sheet, is_upper, is_upper ? start : end, is_upper ? end : start, turn, samples);
        return samples;
    }
    std::vector<Sample> samples_of_level(Index h) const {
        const Sheet& sheet = sheets[in.face[h]];
        const Index twin = in.twin[h];
        const double step = twin < 0 ? sheet.across : std::min(sheet.across, sheets[in.face[twin]].across);
        const double theta = angle(h), first = sheet.u(place(h), theta), last = sheet.u(place(after(h)), theta);
        const int count = parts(std::abs(last - first), step);
        std::vector<Sample> samples;
        for (int k = 1; k < count; ++k) samples.push_back({theta, sheet.at(first + (last - first) * k / count, theta)});
        return samples;
    }

    // Vertices of a half-edge, its start first, in its direction.
    void add_side(Index h, std::vector<Point>& into) {
        const Sheet& sheet = sheets[in.face[h]];
        const bool is_upper = static_cast<Side>(in.side[h]) == Side::upper;
        const auto put = [&](Index vertex) {
            const double theta = out.xyz[3 * static_cast<std::size_t>(vertex) + 2];
            const Xy p{out.xyz[3 * static_cast<std::size_t>(vertex)], out.xyz[3 * static_cast<std::size_t>(vertex) + 1]};
            into.push_back({vertex, is_curve(h) ? sheet.ends(theta)[is_upper] : sheet.u(p, theta), theta});
        };
        const std::pair key{in.edge[h], !is_curve(h) && on_seam(in.vertex[h]) && is_late(h)};
        auto found = runs.find(key);
        if (found == runs.end()) {
            const auto samples = is_curve(h) ? samples_of_curve(h) : samples_of_level(h);
            const auto begin = static_cast<Index>(out.xyz.size() / 3);
            for (const Sample& sample : samples) add_vertex(sample);
            found = runs.emplace(key, Run{begin, static_cast<Index>(samples.size()), place(h)}).first;
        }
        put(vertex_of(h));
        const Run run = found->second;
        const auto from_there = [&](const Xy& p) { return norm(p.x - run.from.x, p.y - run.from.y); };
        const bool is_forward = is_curve(h) ? is_upper : from_there(place(h)) < from_there(place(after(h)));
        for (Index k = 0; k < run.count; ++k) put(run.begin + (is_forward ? k : run.count - 1 - k));
    }

    void fill(Index f) {
        const Sheet& sheet = sheets[f];
        std::array<std::vector<Point>, 4> rim;
        for (Index h = in.first[f]; h < in.first[f + 1]; ++h) add_side(h, rim[in.side[h]]);
        Triangulation net;
        std::vector<Point> points;
        const double wide = sheet.is_circle() ? sheet.across : std::min(sheet.across, sheet.length);
        const auto add = [&](const Point& p) {
            points.push_back(p);
            net.places.push_back({p.u / wide, p.theta / sheet.turn});
            return static_cast<Index>(points.size()) - 1;
        };
        std::array<std::vector<Index>, 4> sides;
        for (std::size_t side = 0; side < 4; ++side)
            for (const Point& p : rim[side]) sides[side].push_back(add(p));
        const auto corner = [&](std::size_t side) {  // lower left, lower right, upper right, upper left
            for (std::size_t k = 0; k < 4; ++k)
                if (!sides[(side + k) % 4].empty()) return sides[(side + k) % 4].front();
            return Index(-1);
        };
        std::vector<Index> left = sides[3], right = sides[1];
        left.push_back(corner(0)), right.push_back(corner(2));
        std::reverse(left.begin(), left.end());
        net.zip(left, right);
        for (const std::size_t side : {0, 2})
            for (std::size_t k = 1; k < sides[side].size(); ++k) net.split_rim(sides[side][k - 1], corner(side + 1), sides[side][k]);
        net.make_delaunay();
        const int rows = parts(sheet.to - sheet.from, sheet.turn);
        for (int row = 1; row < rows; ++row) {
            const double theta = sheet.from + (sheet.to - sheet.from) * row / rows;
            const auto [low, high] = sheet.ends(theta);
            const int columns = parts(high - low, sheet.across);
            for (int k = 1; k < columns; ++k) {
                const Index id = add({-1, low + (high - low) * k / columns, theta});
                if (!net.insert(id)) points.pop_back(), net.places.pop_back();
            }
        }
        net.make_delaunay();
        for (const Triangle& t : net.triangles) {
            for (const Index c : t.corner) {
                Point& p = points[static_cast<std::size_t>(c)];
                if (p.vertex < 0) p.vertex = add_vertex({p.theta, sheet.at(p.u, p.theta)});
                out.corners.push_back(p.vertex);
            }
            out.face.push_back(f);
        }
    }

    const CellComplex& in;
    const Scene& scene;
    const Limits limits;
    const double error, angle_scale, most_triangles;
    std::vector<Sheet> sheets;
    std::map<std::pair<Index, bool>, Index> vertices;  // of the complex, apart at the end of the last chart
    std::map<std::pair<Index, bool>, Run> runs;        // by edges, also apart there
    Mesh out;
};

}  // namespace

std::optional<Mesh> round_mesh(const CellComplex& cells, double error, double angle_scale, double most) {
    return RoundMesher(cells, error, angle_scale, most).run();
}

}  // namespace cfree
