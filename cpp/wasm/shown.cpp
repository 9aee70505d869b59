// Columns for the eye: doubles of what was decided exactly.
#include "shown.hpp"

#include <numbers>
#include <numeric>
#include <set>
#include <unordered_map>

#include "cfree/free/cell_facts.hpp"
#include "cfree/geometry/local_geometry.hpp"
#include "cfree/mesh/mesh.hpp"
#include "cfree/support/elementary.hpp"
#include "reading.hpp"

namespace cfree {

namespace {

constexpr double pi = std::numbers::pi;

void show_polygons(const std::string& prefix, const std::vector<std::shared_ptr<const Polygon>>& polygons, Reply& reply) {
    std::vector<double> xy;
    std::vector<Index> ring{0}, polygon{0};
    for (const auto& of : polygons) {
        const Index base = ring.back();
        for (Index k = 0; k < of->vertices.size(); ++k)
            for (const Int& c : {of->vertices.X(k), of->vertices.Y(k)}) xy.push_back(nearest(c, of->denominator));
        for (std::size_t r = 1; r < of->offsets.size(); ++r) ring.push_back(base + of->offsets[r]);
        polygon.push_back(static_cast<Index>(ring.size()) - 1);
    }
    reply.add(prefix + ".xy", xy), reply.add(prefix + ".ring", ring), reply.add(prefix + ".polygon", polygon);
}

void show_outlines(const std::string& prefix, const std::vector<GivenShape>& shapes, Reply& reply) {
    Outlines outlines;
    for (const GivenShape& shape : shapes) outlines.add(shape);
    reply.add(prefix + ".xy", outlines.xy), reply.add(prefix + ".ring", outlines.ring), reply.add(prefix + ".polygon", outlines.shape);
    reply.add(prefix + ".bend", outlines.bend);
}

// Outlines with arcs; and the error of polygons around shapes that are not rounded.
void show_rounds(const World& world, Reply& reply) {
    const GivenScene& scene = world.rounds->scene;
    show_outlines("robot", scene.robot, reply), show_outlines("obstacles", scene.obstacles, reply);
    if (scene.workspace) show_outlines("workspace", std::vector{*scene.workspace}, reply);
    if (!world.near->inexact.empty()) reply.add("around", world.near->error), reply.add("around.shapes", world.near->inexact);
}

Vec<double> point(const Shape& shape, Index v) { return UserUnits{}.vertex(shape, v); }

bool is_circle(const Feature& contact) { return contact.kind == Kind::vertex_vertex; }
double sum_of(const Scene& scene, const Feature& contact) { return sum_of_radii(scene, contact) * scene.unit(); }

// The line of a contact, moved outwards where shapes are grown.
ContactLine<double> line_of(const Scene& scene, const Feature& contact) {
    ContactLine<double> line(scene, contact, UserUnits{});
    if (const double rho = sum_of(scene, contact); rho > 0) move_outwards(line, rho);
    return line;
}

// Center of the circle of a contact.
Vec<double> center_of(const Scene& scene, const Feature& contact, double theta) {
    const auto [c, s] = cosine_sine(theta);
    return point(scene.obstacles, contact.obstacle) - Rotation<double>{c, s, 1}(point(scene.robot, contact.robot));
}

// Position of a pose along the line of a contact; on a circle the angle psi of the normal, which points to a concave arc's center.
double t_at(const Scene& scene, const Feature& contact, double x, double y, double theta) {
    if (is_circle(contact)) {
        const Vec<double> center = center_of(scene, contact, theta);
        const double side = sum_of_radii(scene, contact) < 0 ? -1 : 1;
        return in_a_turn(arc_tangent(side * (y - center.y), side * (x - center.x)));
    }
    const auto [c, s] = cosine_sine(theta);
    const ContactLine<double> line = line_of(scene, contact);
    const Vec<double> p = line.start({c, s, 1}), u = line.direction({c, s, 1});
    return ((x - p.x) * u.x + (y - p.y) * u.y) / (u.x * u.x + u.y * u.y);
}

struct AtPoint {
    std::array<double, 3> normal;
    double K, H;
};

// On a circle by the formulas of src/cfree/geometry/arcs.py.
AtPoint geometry_at(const Scene& scene, const Feature& contact, double t, double theta, double length) {
    if (is_circle(contact)) {
        const double w = length, rho = sum_of(scene, contact);
        const auto [ux, uy] = cosine_sine(t);
        const auto [cosine, sine] = cosine_sine(theta);
        const Vec<double> a = Rotation<double>{cosine, sine, 1}(point(scene.robot, contact.robot));
        const double c = a.x * ux + a.y * uy, s = ux * a.y - uy * a.x, D = norm(w, s), square = a.x * a.x + a.y * a.y + w * w;
        return {{w * ux / D, w * uy / D, -s / D}, -w * w * c / (rho * D * D * D * D), w * (rho * c - square) / (2 * rho * D * D * D)};
    }
    const ContactLine<double> of = line_of(scene, contact);
    const Vec<double> still = of.on_edge ? of.E : Vec<double>{0, 0}, turning = of.on_edge ? Vec<double>{0, 0} : of.E;
    const LocalGeometry local = local_geometry({of.b.x, of.b.y, still.x, still.y, of.a.x, of.a.y, turning.x, turning.y}, t, theta, length);
    return {{local.frame[6], local.frame[7], local.frame[8]}, local.K, local.H};
}

Feature contact_of(const Boundary& boundary, Index trapezoid) {
    return boundary.patches.contact(boundary.trapezoids.patch[static_cast<std::size_t>(trapezoid)]);
}

// Vertices of robot and obstacles that meet at the ends of a contact.
std::vector<std::pair<Index, Index>> ends_of(const Scene& scene, const Feature& contact) {
    std::vector<std::pair<Index, Index>> names;
    for (const int end : {0, 1}) {
        const Feature helix = end_helix(scene, contact, end);
        names.emplace_back(scene.robot.point[helix.robot], scene.obstacles.point[helix.obstacle]);
    }
    return names;
}

enum class Line : std::uint8_t { crossing, helix, segment, joint };
// None between two quadrants of one circle.
std::optional<Line> line_kind(const Scene& scene, const Feature& first, const Feature& second, bool is_level) {
    const bool are_circles[] = {is_circle(first), is_circle(second)};
    if (are_circles[0] && are_circles[1]) {
        const bool are_one = scene.robot.point[first.robot] == scene.robot.point[second.robot] &&
                             scene.obstacles.point[first.obstacle] == scene.obstacles.point[second.obstacle];
        if (are_one) return std::nullopt;
        // an arc and its end
        const bool is_joint = (scene.robot.point[first.robot] == scene.robot.point[second.robot] && scene.obstacles.stub_between(first.obstacle, second.obstacle) >= 0) ||
                              (scene.obstacles.point[first.obstacle] == scene.obstacles.point[second.obstacle] && scene.robot.stub_between(first.robot, second.robot) >= 0);
        return is_joint ? Line::joint : Line::crossing;
    }
    if (are_circles[0] || are_circles[1]) {
        const Feature &line = are_circles[0] ? second : first, &circle = are_circles[0] ? first : second;
        for (const auto& [robot, obstacle] : ends_of(scene, line))
            if (robot == scene.robot.point[circle.robot] && obstacle == scene.obstacles.point[circle.obstacle]) return Line::joint;
        return Line::crossing;
    }
    if (is_level) return Line::segment;
    if (sum_of_radii(scene, first) > 0 || sum_of_radii(scene, second) > 0) return Line::crossing;
    for (const auto& p : ends_of(scene, first))
        for (const auto& q : ends_of(scene, second))
            if (p == q) return Line::helix;
    return Line::crossing;
}

// Radii of the vertices of a contact, or of those at the start of its edge.
struct Radii {
    double robot, obstacle;
};
Radii radii_of(const Scene& scene, const Feature& contact) {
    if (!scene.is_round) return {0, 0};
    const auto radius = [&](const Shape& of, Index v) { return of.radius_of(v).about.hi * scene.unit(); };
    const Shape &A = scene.robot, &O = scene.obstacles;
    return {radius(A, contact.kind == Kind::edge_vertex ? A.v[contact.robot] : contact.robot),
            radius(O, contact.kind == Kind::vertex_edge ? O.v[contact.obstacle] : contact.obstacle)};
}
std::uint8_t grown_of(const Scene& scene, const Feature& contact) {
    const Radii radii = radii_of(scene, contact);
    return static_cast<std::uint8_t>((radii.robot != 0 ? 1 : 0) + (radii.obstacle != 0 ? 2 : 0));
}

std::uint8_t kind_of(const Feature& contact) { return is_circle(contact) ? 2 : contact.kind == Kind::vertex_edge ? 0 : 1; }

struct SurfaceColumns {
    std::vector<double> xyz, normal, lines, gaussian, mean;  // curvatures without units
    std::vector<Index> corners, face, cell, owner;  // owner: the obstacle, or bounds or workspace
    std::vector<std::uint8_t> kind, line_kind, grown;  // grown: 1 for an arc of the robot, and 2 for one of an obstacle; empty among polygons
};

SurfaceColumns surface_of(const SceneFeatures& features, const CellComplex& cells, const Mesh& mesh, double length,
                          const FreeSpace* space) {
    const Boundary& boundary = *cells.boundary;
    const auto& owners = features.obstacles.polygon;
    SurfaceColumns out;
    std::unordered_map<std::uint64_t, Index> seen;              // a vertex of a patch
    std::unordered_map<std::uint64_t, std::pair<Index, Index>> edges;  // edges of the mesh, their triangle and its corner
    const auto key = [](Index p, Index q) { return static_cast<std::uint64_t>(p) << 32 | static_cast<std::uint32_t>(q); };
    const auto patch = [&](Index t) { return boundary.trapezoids.patch[static_cast<std::size_t>(mesh.face[static_cast<std::size_t>(t)])]; };
    for (std::size_t t = 0; t < mesh.face.size(); ++t) {
        const Index face = mesh.face[t];
        const Feature contact = contact_of(boundary, face);
        const Index* v = &mesh.corners[3 * t];
        for (int k = 0; k < 3; ++k) {
            const auto [at, is_new] = seen.try_emplace(key(v[k], patch(static_cast<Index>(t))), static_cast<Index>(out.kind.size()));
            if (is_new) {
                const double* p = &mesh.xyz[3 * static_cast<std::size_t>(v[k])];
                const double theta = p[2] / length, t_there = t_at(*features.scene, contact, p[0], p[1], theta);
                const AtPoint local = geometry_at(*features.scene, contact, t_there, theta, length);
                out.xyz.insert(out.xyz.end(), {p[0], p[1], p[2] / length});
                out.normal.insert(out.normal.end(), local.normal.begin(), local.normal.end());
                out.gaussian.push_back(local.K * length * length), out.mean.push_back(local.H * length);
                out.kind.push_back(kind_of(contact));
                if (features.scene->is_round) out.grown.push_back(grown_of(*features.scene, contact));
                out.owner.push_back(owners[static_cast<std::size_t>(contact.obstacle)]);
                out.cell.push_back(space ? space->cell_of[static_cast<std::size_t>(cells.component[static_cast<std::size_t>(face)])] : -1);
            }
            out.corners.push_back(at->second);
            const Index p = v[k], q = v[(k + 1) % 3];
            const auto name = key(std::min(p, q), std::max(p, q));
            const auto [other, first] = edges.try_emplace(name, static_cast<Index>(t), p);
            if (first) continue;
            const Index before = other->second.first;
            const Feature neighbour = contact_of(boundary, mesh.face[static_cast<std::size_t>(before)]);
            const bool of_bounds = owners[static_cast<std::size_t>(contact.obstacle)] == bounds_owner &&
                                   owners[static_cast<std::size_t>(neighbour.obstacle)] == bounds_owner;
            if (patch(before) != patch(static_cast<Index>(t)) && !of_bounds) {
                const double *a = &mesh.xyz[3 * static_cast<std::size_t>(p)], *b = &mesh.xyz[3 * static_cast<std::size_t>(q)];
                const auto found = line_kind(*features.scene, contact, neighbour, a[2] == b[2]);
                if (!found) continue;
                for (const double* c : {a, b}) out.lines.insert(out.lines.end(), {c[0], c[1], c[2] / length});
                out.line_kind.push_back(static_cast<std::uint8_t>(*found));
            }
        }
        out.face.push_back(face);
    }
    return out;
}

void put(const SurfaceColumns& columns, Reply& reply) {
    reply.add("xyz", columns.xyz), reply.add("normal", columns.normal), reply.add("corners", columns.corners);
    reply.add("face", columns.face), reply.add("kind", columns.kind), reply.add("cell", columns.cell), reply.add("owner", columns.owner);
    reply.add("gaussian", columns.gaussian), reply.add("mean", columns.mean);
    reply.add("lines", columns.lines), reply.add("line_kind", columns.line_kind);
    if (!columns.grown.empty()) reply.add("grown", columns.grown);
}

// Ends of an edge that is moved outwards, or of the arc about a vertex; both are the vertex if it has no arc, or a whole circle.
void mark(std::vector<double>& xy, const Shape& shape, Index which, bool is_edge, double radius) {
    const auto beside = [&](Index edge, const Vec<double>& p) {
        const Vec<double> d = UserUnits{}.edge(shape, edge);
        const double length = norm(d.x, d.y), scale = length > 0 ? radius / length : 0;
        return Vec<double>{p.x + scale * d.y, p.y - scale * d.x};
    };
    const Vec<double> p = point(shape, is_edge ? shape.v[which] : which);
    const Vec<double> first = beside(is_edge ? which : shape.previous[which], p);
    const Vec<double> last = beside(which, is_edge ? point(shape, shape.w[which]) : p);
    xy.insert(xy.end(), {first.x, first.y, last.x, last.y});
}

// A pose on a grid, exactly in contact; next to it where an edge of irrational length is moved outwards.
RationalPose pose_in_contact(const Scene& scene, const Feature& contact, double t, double theta) {
    const HalfAngle half = half_angle_of(theta, false);
    const auto r = half.rotation();
    const auto over = [](const Vec<Int>& p, const Int& d) { return RatioPoint{reduced(p.x, d), reduced(p.y, d)}; };
    const auto on_grid = [](double share) { return Ratio{Int(std::llround(std::clamp(share, 0.0, 1.0) * 0x1p20)), Int(1) << 20}; };
    const auto radius = [&](const Shape& s, Index v) { return scene.is_round ? s.radius_of(v).exact : Int(0); };
    const Int whole = r.w * scene.scale;
    const auto moved = [&](const RatioPoint& p, const RatioPoint& by, const Ratio& factor) {
        return RationalPose{p.x + factor * by.x, p.y + factor * by.y, half};
    };
    if (is_circle(contact)) {
        const CoreUnits<Int> of;
        const Vec<Int> b = of.vertex(scene.obstacles, contact.obstacle), a = r(of.vertex(scene.robot, contact.robot));
        const Ratio q = on_grid(tangent(0.5 * (t - 0.5 * pi * contact.branch))), one{1, 1}, square = one + q * q;
        RatioPoint u{(one - q * q) / square, (q + q) / square};
        for (int k = 0; k < contact.branch; ++k) u = {-u.y, u.x};
        const Int rho = radius(scene.robot, contact.robot) + radius(scene.obstacles, contact.obstacle);
        return moved(over({r.w * b.x - a.x, r.w * b.y - a.y}, whole), u, reduced(rho, scene.scale));
    }
    const ContactLine<Int> exact(scene, contact, CoreUnits<Int>{});
    const RatioPoint start = over(exact.start(r), whole), along = over(exact.direction(r), whole);
    const Ratio share = on_grid(t);
    const RationalPose on = moved(start, along, share);
    const Int rho = radius(scene.robot, exact.on_edge ? contact.robot : scene.robot.v[contact.robot]) +
                    radius(scene.obstacles, exact.on_edge ? scene.obstacles.v[contact.obstacle] : contact.obstacle);
    if (rho.is_zero()) return on;
    const Int square = exact.E.x * exact.E.x + exact.E.y * exact.E.y, root = sqrt(square);
    const Ratio length = root * root == square ? Ratio{root, 1} : ratio_of(std::sqrt(nearest(square, 1)) * (1 - 0x1p-40));
    return moved({on.x, on.y}, {along.y, -along.x}, Ratio{rho, 1} / length);
}

// Chart and coordinate of an angle.
std::pair<int, double> chart_of(double theta) {
    const HalfAngle half = half_angle_of(theta, true);
    const Ratio tau = half.tau();
    return {half.chart(), nearest(tau.n, tau.d)};
}

}  // namespace

void Named::add(const World& world, const Feature& contact) {
    const bool on_edge = contact.kind == Kind::vertex_edge, turns = contact.kind == Kind::edge_vertex;
    const Shape &A = world.scene->robot, &O = world.scene->obstacles;
    const auto owner = [](const Owners& of, Index v) {
        const auto k = static_cast<std::size_t>(v);
        return k < of.polygon.size() ? std::pair{of.polygon[k], of.vertex[k]} : std::pair{Index{-1}, Index{0}};
    };
    const Index i = contact.robot, j = contact.obstacle;
    kind.push_back(kind_of(contact));
    const auto [part, vertex] = owner(world.features.robot, i);
    robot_part.push_back(part), robot_vertex.push_back(vertex);
    const auto [polygon, corner] = owner(world.features.obstacles, j);
    obstacle.push_back(polygon), obstacle_vertex.push_back(corner);
    const Radii radii = radii_of(*world.scene, contact);
    robot_radius.push_back(radii.robot), obstacle_radius.push_back(radii.obstacle);
    mark(robot_xy, A, i, turns, robot_radius.back());
    mark(obstacle_xy, O, j, on_edge, obstacle_radius.back());
}

void Named::put(const std::string& prefix, Reply& reply) const {
    reply.add(prefix + ".kind", kind);
    reply.add(prefix + ".robot_part", robot_part), reply.add(prefix + ".robot_vertex", robot_vertex);
    reply.add(prefix + ".obstacle", obstacle), reply.add(prefix + ".obstacle_vertex", obstacle_vertex);
    reply.add(prefix + ".robot_xy", robot_xy), reply.add(prefix + ".obstacle_xy", obstacle_xy);
    reply.add(prefix + ".robot_radius", robot_radius), reply.add(prefix + ".obstacle_radius", obstacle_radius);
}

void show_robot(const Rounds& rounds, const std::string& prefix, Reply& reply) { show_outlines(prefix, rounds.scene.robot, reply); }

void show_scene(const World& world, Reply& reply) {
    if (world.rounds) show_rounds(world, reply);
    else {
        show_polygons("robot", world.shapes.robot, reply);
        show_polygons("obstacles", world.shapes.obstacles, reply);
        if (world.shapes.workspace) show_polygons("workspace", {world.shapes.workspace}, reply);
    }
    if (world.features.rim) reply.add("rim", std::vector<double>(world.features.rim->begin(), world.features.rim->end()));
    if (world.shapes.bounds) {
        std::vector<double> bounds;
        for (const Ratio& x : *world.shapes.bounds) bounds.push_back(nearest(x.n, x.d));
        reply.add("bounds", bounds);
    }
    reply.add("radius", world.radius);
}

void show_counts(const World& world, Reply& reply) {
    const auto count = [&](const char* name, auto value) { reply.add(name, static_cast<double>(value)); };
    count("patches", world.boundary->patches.size());
    count("trapezoids", world.boundary->trapezoids.size());
    count("isolated", world.boundary->isolated.parts.size());
    count("surfaces", world.cells->components);
    count("cells", world.space->cells());
}

void show_columns(World& world, Reply& reply) {
    world.need_space();
    const Boundary& b = *world.boundary;
    const Trapezoids& t = b.trapezoids;
    reply.add("patches.kind", b.patches.kind), reply.add("patches.robot", b.patches.robot);
    reply.add("patches.obstacle", b.patches.obstacle), reply.add("trimmed", b.trimmed);
    reply.add("patch", t.patch), reply.add("chart", t.chart), reply.add("lower", t.lower), reply.add("upper", t.upper);
    reply.add("from_first", t.from_first), reply.add("from_second", t.from_second), reply.add("to_first", t.to_first);
    reply.add("to_second", t.to_second), reply.add("from_lo", t.from_lo), reply.add("from_hi", t.from_hi);
    reply.add("to_lo", t.to_lo), reply.add("to_hi", t.to_hi), reply.add("from_place", t.from_place), reply.add("to_place", t.to_place);
    const CellComplex& c = *world.cells;
    reply.add("face", c.face), reply.add("twin", c.twin), reply.add("edge", c.edge), reply.add("vertex", c.vertex);
    reply.add("side", c.side), reply.add("first", c.first), reply.add("component", c.component);
    reply.add("xy", c.places().xy), reply.add("theta", c.places().theta);
    const Surfaces& s = world.space->surfaces;
    reply.add("parent", s.parent), reply.add("free_inside", s.free_inside);
    const Turns& turns = world.found_turns();
    reply.add("turns", turns.turns), reply.add("lift", turns.lift);
    reply.add("cell_of", world.space->cell_of), reply.add("depth", world.space->depth);
}

void show_mesh(const World& world, double error, double most, Reply& reply) {
    world.need_space();
    MeshEstimate estimate = estimate_mesh(*world.cells, error, world.radius);
    if (estimate.coarsest > most) error = std::max(error, world.radius);
    while (error < world.radius && estimate.triangles > most) error *= 2, estimate = estimate_mesh(*world.cells, error, world.radius);
    put(surface_of(world.features, *world.cells, mesh(*world.cells, error, world.radius), world.radius, world.space.get()), reply);
    reply.add("error", error);
}

void show_surface(const SceneFeatures& features, const CellComplex& cells, double length, Reply& reply) {
    put(surface_of(features, cells, mesh(cells, length / 20, length), length, nullptr), reply);
}

void show_slice(const World& world, double theta, Reply& reply) {
    world.need_boundary();
    const auto [chart, tau] = chart_of(theta);
    const auto rings = world.slicer->rings(std::array{chart}, std::array{tau});
    reply.add("xy", rings.xy), reply.add("start", rings.start), reply.add("shell", rings.shell), reply.add("bend", rings.bend);
    const auto segments = world.slicer->segments(chart, tau);
    std::vector<std::uint8_t> kind;
    for (const Index k : segments.trapezoid) {  // v-e, e-v, arcs, bounds
        const Feature contact = contact_of(*world.boundary, k);
        const bool of_bounds = world.features.obstacles.polygon[static_cast<std::size_t>(contact.obstacle)] == bounds_owner;
        kind.push_back(of_bounds ? 3 : kind_of(contact));
    }
    std::vector<double> bend;
    for (const auto& arc : segments.arcs) bend.push_back(arc.radius);
    reply.add("segments", segments.xy), reply.add("kind", kind), reply.add("trapezoid", segments.trapezoid);
    reply.add("segments.bend", bend);
}

void show_contact(const World& world, Index trapezoid, const Place& at, Reply& reply) {
    world.need_space();
    const Trapezoids& table = world.boundary->trapezoids;
    if (trapezoid < 0 || static_cast<std::size_t>(trapezoid) >= table.size()) throw std::invalid_argument("no such trapezoid");
    const Feature contact = contact_of(*world.boundary, trapezoid);
    Named named;
    named.add(world, contact);
    named.put("contact", reply);
    const double t = t_at(*world.scene, contact, at.x, at.y, at.theta);
    const AtPoint local = geometry_at(*world.scene, contact, t, at.theta, 1);
    reply.add("t", t), reply.add("phi", at.theta), reply.add("K", local.K), reply.add("H", local.H);
    reply.text("pose", words_of(pose_in_contact(*world.scene, contact, t, at.theta)));
    // all of the contact that is left, from and to in angles: one patch, or some quadrants of a circle
    const auto named_by = [](const Feature& f) { return std::array{static_cast<Index>(f.kind), f.robot, f.obstacle}; };
    const auto of_patch = [&](Index k) { return named_by(contact_of(*world.boundary, k)); };
    std::vector<double> range;
    std::vector<Index> same;
    for (std::size_t k = 0; k < table.size(); ++k) {
        if (of_patch(static_cast<Index>(k)) != named_by(contact)) continue;
        const Index which = static_cast<Index>(k);
        same.push_back(which);
        range.push_back(theta_of(table.chart[k], table.tau_from(which)));
        range.push_back(theta_of(table.chart[k], table.tau_to(which)));
    }
    reply.add("same", same), reply.add("range", range);
    // parts of its sides in common with other patches
    const CellComplex& c = *world.cells;
    std::set<Index> others;
    std::set<std::array<Index, 3>> seen{named_by(contact)};
    for (std::size_t side = 0; side < c.face.size(); ++side) {
        const Index twin = c.twin[side];
        if (twin < 0 || of_patch(c.face[side]) != named_by(contact)) continue;
        const Index other = c.face[static_cast<std::size_t>(twin)];
        if (seen.insert(of_patch(other)).second) others.insert(table.patch[static_cast<std::size_t>(other)]);
    }
    Named trims;
    for (const Index other : others) trims.add(world, world.boundary->patches.contact(other));
    trims.put("trims", reply);
    const Index component = world.cells->component[static_cast<std::size_t>(trapezoid)];
    reply.add("cell", static_cast<double>(world.space->cell_of[static_cast<std::size_t>(component)]));
}

void show_cell(World& world, Index cell, Reply& reply) {
    world.need_space();
    if (cell < 0 || cell >= world.space->cells()) throw std::invalid_argument("no such cell");
    const auto k = static_cast<std::size_t>(cell);
    if (world.volumes.empty()) world.volumes = volumes(*world.space).values;
    const std::vector<Index>& turns_of_component = world.found_turns().turns;
    reply.add("volume", world.volumes[k]);
    reply.add("caged", caged(*world.space, world.features.obstacles.polygon)[k] ? 1.0 : 0.0);
    reply.add("bounded", cell == world.space->outside ? 0.0 : 1.0);
    Index turns = 0;
    for (std::size_t of = 0; of < world.space->cell_of.size(); ++of)
        if (world.space->cell_of[of] == cell) turns = std::gcd(turns, turns_of_component[of]);
    reply.add("turns", cell == world.space->outside ? 1.0 : static_cast<double>(turns));
}

}  // namespace cfree
