// Columns for the eye: doubles of what was decided exactly.
#include "shown.hpp"

#include <numbers>
#include <unordered_map>

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
            for (const Int* c : {&of->vertices.X[k], &of->vertices.Y[k]}) xy.push_back(nearest(*c, of->denominator));
        for (std::size_t r = 1; r < of->offsets.size(); ++r) ring.push_back(base + of->offsets[r]);
        polygon.push_back(static_cast<Index>(ring.size()) - 1);
    }
    reply.add(prefix + ".xy", xy), reply.add(prefix + ".ring", ring), reply.add(prefix + ".polygon", polygon);
}

Vec<double> point(const Shape& shape, Index v) { return UserUnits{}.vertex(shape, v); }

// The line of a contact at an orientation in the user's units, and by what it turns.
struct Turned {
    Rotation<double> by;
    Vec<double> start, direction, touch;  // touch: the vertex that touches, of the robot as it is turned, or of the obstacles
    bool on_edge;

    Turned(const Scene& scene, const Feature& contact, double theta) {
        const auto [c, s] = cosine_sine(theta);
        by = {c, s, 1};
        const ContactLine<double> line(scene, contact, UserUnits{});
        on_edge = line.on_edge;
        start = line.start(by), direction = line.direction(by);
        touch = on_edge ? by(line.a) : line.b;
    }
    // Of the surface in (x, y, length * theta), at a pose of it: the pose turns about the point of contact.
    std::array<double, 3> normal(double x, double y, double length) const {
        const Vec<double> arm = on_edge ? -touch : Vec<double>{x - touch.x, y - touch.y};  // from the point of contact
        const double vx = -arm.y, vy = arm.x, ux = direction.x, uy = direction.y;
        const double n[3] = {uy * length, -ux * length, ux * vy - uy * vx};
        const double size = norm(norm(n[0], n[1]), n[2]);
        return {n[0] / size, n[1] / size, n[2] / size};
    }
    double t(double x, double y) const {
        const Vec<double>& u = direction;
        return ((x - start.x) * u.x + (y - start.y) * u.y) / (u.x * u.x + u.y * u.y);
    }
};

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

enum class Line : std::uint8_t { crossing, helix, segment };
Line line_kind(const Scene& scene, const Feature& first, const Feature& second, bool is_level) {
    if (is_level) return Line::segment;
    for (const auto& p : ends_of(scene, first))
        for (const auto& q : ends_of(scene, second))
            if (p == q) return Line::helix;
    return Line::crossing;
}

struct SurfaceColumns {
    std::vector<double> xyz, normal, lines;
    std::vector<Index> corners, face, cell, owner;  // owner: the obstacle, or bounds or workspace
    std::vector<std::uint8_t> kind, line_kind;
};

SurfaceColumns surface_of(const SceneFeatures& features, const CellComplex& cells, const Mesh& mesh, double length,
                          const FreeSpace* space) {
    const Boundary& boundary = *cells.boundary;
    const auto& owners = features.obstacles.polygon;
    SurfaceColumns out;
    std::unordered_map<std::uint64_t, Index> seen;              // a vertex of a patch
    std::unordered_map<std::uint64_t, std::pair<Index, Index>> edges;  // of the mesh, their triangle and its corner
    const auto key = [](Index p, Index q) { return static_cast<std::uint64_t>(p) << 32 | static_cast<std::uint32_t>(q); };
    const auto patch = [&](Index t) { return boundary.trapezoids.patch[static_cast<std::size_t>(mesh.face[static_cast<std::size_t>(t)])]; };
    for (std::size_t t = 0; t < mesh.face.size(); ++t) {
        const Index face = mesh.face[t];
        const Feature contact = contact_of(boundary, face);
        const Index* v = &mesh.corners[3 * t];
        std::array<double, 3> flat{};
        {
            const double *a = &mesh.xyz[3 * static_cast<std::size_t>(v[0])], *b = &mesh.xyz[3 * static_cast<std::size_t>(v[1])],
                         *c = &mesh.xyz[3 * static_cast<std::size_t>(v[2])];
            const double p[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, q[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
            flat = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
        }
        for (int k = 0; k < 3; ++k) {
            const auto [at, is_new] = seen.try_emplace(key(v[k], patch(static_cast<Index>(t))), static_cast<Index>(out.kind.size()));
            if (is_new) {
                const double* p = &mesh.xyz[3 * static_cast<std::size_t>(v[k])];
                auto n = Turned(*features.scene, contact, p[2] / length).normal(p[0], p[1], length);
                const double side = n[0] * flat[0] + n[1] * flat[1] + n[2] * flat[2] < 0 ? -1 : 1;
                out.xyz.insert(out.xyz.end(), {p[0], p[1], p[2] / length});
                for (const double c : n) out.normal.push_back(side * c);
                out.kind.push_back(contact.kind == Kind::vertex_edge ? 0 : 1);
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
                for (const double* c : {a, b}) out.lines.insert(out.lines.end(), {c[0], c[1], c[2] / length});
                out.line_kind.push_back(static_cast<std::uint8_t>(line_kind(*features.scene, contact, neighbour, a[2] == b[2])));
            }
        }
        out.face.push_back(face);
    }
    return out;
}

void put(const SurfaceColumns& columns, Reply& reply) {
    reply.add("xyz", columns.xyz), reply.add("normal", columns.normal), reply.add("corners", columns.corners);
    reply.add("face", columns.face), reply.add("kind", columns.kind), reply.add("cell", columns.cell), reply.add("owner", columns.owner);
    reply.add("lines", columns.lines), reply.add("line_kind", columns.line_kind);
}

// Chart and coordinate of an angle.
std::pair<int, double> chart_of(double theta) {
    const HalfAngle half = half_angle_of(theta, true);
    const Ratio tau = half.tau();
    return {half.chart(), nearest(tau.n, tau.d)};
}

}  // namespace

void Named::add(const World& world, const Feature& contact) {
    const bool on_edge = contact.kind == Kind::vertex_edge;
    const Shape &A = world.scene->robot, &O = world.scene->obstacles;
    const auto owner = [](const Owners& of, Index v) {
        const auto k = static_cast<std::size_t>(v);
        return k < of.polygon.size() ? std::pair{of.polygon[k], of.vertex[k]} : std::pair{Index{-1}, Index{0}};
    };
    const auto ends = [](std::vector<double>& xy, Vec<double> p, Vec<double> q) { xy.insert(xy.end(), {p.x, p.y, q.x, q.y}); };
    const Index i = contact.robot, j = contact.obstacle;
    kind.push_back(on_edge ? 0 : 1);
    const auto [part, vertex] = owner(world.features.robot, i);
    robot_part.push_back(part), robot_vertex.push_back(vertex);
    const auto [polygon, corner] = owner(world.features.obstacles, j);
    obstacle.push_back(polygon), obstacle_vertex.push_back(corner);
    ends(robot_xy, point(A, on_edge ? i : A.v[i]), point(A, on_edge ? i : A.w[i]));
    ends(obstacle_xy, point(O, on_edge ? O.v[j] : j), point(O, on_edge ? O.w[j] : j));
}

void Named::put(const std::string& prefix, Reply& reply) const {
    reply.add(prefix + ".kind", kind);
    reply.add(prefix + ".robot_part", robot_part), reply.add(prefix + ".robot_vertex", robot_vertex);
    reply.add(prefix + ".obstacle", obstacle), reply.add(prefix + ".obstacle_vertex", obstacle_vertex);
    reply.add(prefix + ".robot_xy", robot_xy), reply.add(prefix + ".obstacle_xy", obstacle_xy);
}

void show_scene(const World& world, Reply& reply) {
    show_polygons("robot", world.shapes.robot, reply);
    show_polygons("obstacles", world.shapes.obstacles, reply);
    if (world.shapes.workspace) show_polygons("workspace", {world.shapes.workspace}, reply);
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

void show_columns(const World& world, Reply& reply) {
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
    reply.add("xy", c.xy), reply.add("theta", c.theta);
    const Surfaces& s = world.space->surfaces;
    reply.add("parent", s.parent), reply.add("free_inside", s.free_inside), reply.add("turns", s.turns), reply.add("lift", s.lift);
    reply.add("cell_of", world.space->cell_of), reply.add("depth", world.space->depth);
}

void show_mesh(const World& world, double error, double most, Reply& reply) {
    world.need_space();
    for (int k = 0; k < 60 && estimate_mesh(*world.cells, error, world.radius).triangles > most; ++k) error *= 1.4;
    put(surface_of(world.features, *world.cells, mesh(*world.cells, error, world.radius), world.radius, world.space.get()), reply);
    reply.add("error", error);
}

void show_surface(const SceneFeatures& features, const CellComplex& cells, double length, Reply& reply) {
    put(surface_of(features, cells, mesh(cells, length / 20, length), length, nullptr), reply);
}

void show_slice(const World& world, double theta, Reply& reply) {
    world.need_space();
    const auto [chart, tau] = chart_of(theta);
    const auto rings = world.slicer->rings(chart, tau);
    reply.add("xy", rings.xy), reply.add("start", rings.start), reply.add("shell", rings.shell);
    const auto segments = world.slicer->segments(chart, tau);
    std::vector<std::uint8_t> kind;
    for (const Index k : segments.trapezoid) {  // v-e, e-v, bounds
        const Feature contact = contact_of(*world.boundary, k);
        const bool of_bounds = world.features.obstacles.polygon[static_cast<std::size_t>(contact.obstacle)] == bounds_owner;
        kind.push_back(of_bounds ? 2 : contact.kind == Kind::vertex_edge ? 0 : 1);
    }
    reply.add("segments", segments.xy), reply.add("kind", kind), reply.add("trapezoid", segments.trapezoid);
}

void show_contact(const World& world, Index trapezoid, const Place& at, Reply& reply) {
    world.need_space();
    const Trapezoids& table = world.boundary->trapezoids;
    if (trapezoid < 0 || static_cast<std::size_t>(trapezoid) >= table.size()) throw std::invalid_argument("no such trapezoid");
    const Feature contact = contact_of(*world.boundary, trapezoid);
    Named named;
    named.add(world, contact);
    named.put("contact", reply);
    const Turned line(*world.scene, contact, at.theta);
    const double t = line.t(at.x, at.y);
    reply.add("t", t), reply.add("phi", at.theta);
    // the same on a grid, exactly in contact
    const HalfAngle half = half_angle_of(at.theta, false);
    const auto r = half.rotation();
    const ContactLine<Int> exact(*world.scene, contact, CoreUnits<Int>{});
    const Vec<Int> start = exact.start(r), along = exact.direction(r);
    const Int share(std::llround(std::clamp(t, 0.0, 1.0) * 0x1p20)), whole = Int(r.w * world.scene->scale) << 20;
    const auto place = [&](const Int& from, const Int& by) { return reduced(Int((from << 20) + share * by), whole); };
    reply.text("pose", words_of({place(start.x, along.x), place(start.y, along.y), half}));
    // all of the patch that is left: from and to in angles
    std::vector<double> range;
    std::vector<Index> same;
    for (std::size_t k = 0; k < table.size(); ++k) {
        if (table.patch[k] != table.patch[static_cast<std::size_t>(trapezoid)]) continue;
        const Index which = static_cast<Index>(k);
        same.push_back(which);
        range.push_back(theta_of(table.chart[k], table.tau_from(which)));
        range.push_back(theta_of(table.chart[k], table.tau_to(which)));
    }
    reply.add("same", same), reply.add("range", range);
    const Index component = world.cells->component[static_cast<std::size_t>(trapezoid)];
    reply.add("cell", static_cast<double>(world.space->cell_of[static_cast<std::size_t>(component)]));
}

}  // namespace cfree
