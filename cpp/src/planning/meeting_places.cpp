// Candidates for places without width, and their holders; theory, "Paths", "Exact fits".
#include "cfree/planning/meeting_places.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "cfree/forbidden/critical_angle.hpp"
#include "cfree/planning/clusters.hpp"
#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"
#include "collision/box_tree.hpp"

namespace cfree {

namespace {

constexpr double turn = 2 * std::numbers::pi;

// Walker with each closed surface as a cell of its own: it joins any two poses on one along it.
std::unique_ptr<const BoundaryWalker> walker_on_slits(const BoundaryWalker& walker, std::shared_ptr<const CellComplex> cells) {
    if (!cells) return nullptr;
    const auto count = static_cast<std::size_t>(cells->components);
    Surfaces surfaces{cells->component, std::vector<Index>(count, -1), std::vector<std::uint8_t>(count, 1)};
    auto space = std::make_shared<const FreeSpace>(cells->boundary, std::move(surfaces));
    return std::make_unique<const BoundaryWalker>(std::move(space), std::move(cells), walker.checker, walker.angle_scale, walker.slides);
}

std::vector<ThinPart> thin_parts(const Boundary& boundary) {
    std::vector<ThinPart> parts;
    for (Index k = 0; k < static_cast<Index>(boundary.isolated.parts.size()); ++k) {
        heed_stop();
        parts.emplace_back(boundary, k);
    }
    return parts;
}

double largest(const CellComplex& cells) {
    double size = 0;
    for (const Shape* shape : {&cells.boundary->scene->robot, &cells.boundary->scene->obstacles})
        for (const double c : shape->xy) size = std::max(size, std::abs(c));
    for (Index v = 0; v < cells.vertices; ++v) {
        const auto [x, y] = position(cells, v);
        size = std::max({size, std::abs(x), std::abs(y)});
    }
    return size > 0 ? size : 1;
}

void append(Poses& found, const Poses& more) { found.insert(found.end(), more.begin(), more.end()); }

// Orientations within a face at which an end of a curve's edge only touches the surface: double roots of quadratics, so rational.
std::vector<Ratio> touches(const Boundary& boundary, Index face, const Feature& curve) {
    std::vector<Ratio> found;
    if (curve.kind == Kind::vertex_vertex) return found;
    const Scene& scene = *boundary.scene;
    const Trapezoids& table = boundary.trapezoids;
    Predicates on(scene, surface_of(boundary.patches, table, face));
    const Event from = angle_from(boundary.patches, table, face).event(on), to = angle_to(boundary.patches, table, face).event(on);
    for (const int end : {0, 1})
        for (const Event& x : on.event_roots(end_helix(scene, curve, end), {}, from, to).at)
            if (x.is_touch) found.push_back(*rational_value(on.root_of(x)));
    return found;
}

std::vector<Index> sorted(const std::set<Index>& numbers) { return {numbers.begin(), numbers.end()}; }

}  // namespace

MeetingPlaces::MeetingPlaces(std::shared_ptr<const BoundaryWalker> of, std::shared_ptr<const CellComplex> with_slits)
    : walker(std::move(of)), slits(walker_on_slits(*walker, std::move(with_slits))),
      parts(thin_parts(*on_faces().space->boundary)), size(largest(*walker->cells)) {
    const CellComplex& cells = *on_faces().cells;
    first_at.assign(static_cast<std::size_t>(cells.vertices) + 1, 0);
    for (const Index v : cells.vertex) ++first_at[v + 1];
    for (Index v = 0; v < cells.vertices; ++v) first_at[v + 1] += first_at[v];
    face_at.resize(cells.vertex.size());
    auto next = first_at;
    for (std::size_t h = 0; h < cells.vertex.size(); ++h) face_at[next[cells.vertex[h]]++] = cells.face[h];
    met = find_encounters();
    if (parts.empty()) return;
    std::vector<Box> around, at;
    for (const ThinPart& part : parts) around.push_back(part.box(not_told_apart * size));
    for (Index v = 0; v < cells.vertices; ++v) {
        const auto [x, y] = position(cells, v);
        at.push_back({x, y, x, y});
    }
    tree = std::make_unique<const BoxTree>(std::move(around)), vertices = std::make_unique<const BoxTree>(std::move(at));
}
MeetingPlaces::~MeetingPlaces() = default;

std::vector<Holder> MeetingPlaces::holders(const RationalPose& pose) const {
    const ExactPose exact = pose.exact(*walker->space->boundary->scene);
    std::vector<Holder> found;
    const auto add = [&](const Holder& holder) {
        if (std::find(found.begin(), found.end(), holder) == found.end()) found.push_back(holder);
    };
    for (const Index face : walker->space->points().nearby(exact).on) add({Holder::Of::cell, walker->cell_at(face)});
    if (found.empty())
        if (const Index cell = walker->space->locate(exact); cell >= 0) return {{Holder::Of::cell, cell}};
    if (slits)
        for (const Index face : slits->space->points().nearby(exact).on) add({Holder::Of::surface, slits->cell_at(face)});
    const Place at = pose.place();
    for (const Index k : parts_near({at.x, at.y, at.x, at.y}))
        if (parts[k].holds(pose)) found.push_back({Holder::Of::part, k});
    return found;
}

std::optional<Poses> MeetingPlaces::way(const RationalPose& start, const RationalPose& goal, const Holder& holder) const {
    if (holder.of == Holder::Of::part) return parts[holder.index].way(start, goal, walker->motions());
    const BoundaryWalker& on = holder.of == Holder::Of::surface ? *slits : *walker;
    return on.walk({start, start.place()}, {goal, goal.place()}, holder.index);
}

std::vector<Index> MeetingPlaces::parts_near(const Box& box) const {
    std::vector<Index> found;
    if (tree) tree->query(box, [&](Index k) { found.push_back(k); });
    std::sort(found.begin(), found.end());
    return found;
}

Poses MeetingPlaces::candidates() const {
    Poses found;
    std::set<Index> seen;
    const bool needs_corners = !slits;  // else `on_surfaces` adds those of all faces
    const auto add_corners = [&](const std::vector<Index>& faces) {
        for (const Index face : faces)
            if (seen.insert(face).second) append(found, corners(*walker, face));
    };
    if (needs_corners)
        for (const Encounter& encounter : encounters()) add_corners(encounter.faces);
    at_edges(*walker, found);
    at_touches(*walker, found);
    for (const ThinPart& part : parts) {
        at_part(part, found);
        if (needs_corners) add_corners(faces_near(part));
    }
    on_surfaces(found);
    return found;
}

// Add candidates on surfaces with slits: a pose well within each face, its corners, and contacts of surfaces.
void MeetingPlaces::on_surfaces(Poses& found) const {
    if (!slits) return;
    for (Index face = 0; face < static_cast<Index>(slits->cells->component.size()); ++face) {
        heed_stop();
        const Sheet sheet = slits->sheet(face);
        const Ratio tau = simple_middle(sheet.low, sheet.high);
        found.push_back(sheet.pose(sheet.middle(tau), tau));
        append(found, corners(*slits, face));
    }
    at_edges(*slits, found);
    at_touches(*slits, found);
}

// --- at vertices ---

std::vector<Encounter> MeetingPlaces::find_encounters() const {
    const CellComplex& cells = *on_faces().cells;
    std::vector<std::array<double, 4>> points;
    std::vector<double> thetas;
    const auto add = [&](double x, double y, double theta) {
        const auto [c, s] = cosine_sine(theta);
        points.push_back({x / size, y / size, c, s});
        thetas.push_back(theta);
    };
    for (Index v = 0; v < cells.vertices; ++v) {
        const auto [x, y] = position(cells, v);
        add(x, y, cells.places().theta[v]);
    }
    for (const ThinPart& part : parts)
        for (const Place& end : part.rounded) add(end.x, end.y, end.theta);
    const bool has_several = on_faces().space->cells() > 1;
    std::vector<Encounter> found;
    for (const auto& group : clusters(points, not_told_apart)) {
        std::set<Index> of_cells, of_parts, faces;
        for (const Index k : group) {
            if (k >= cells.vertices) {
                of_parts.insert((k - cells.vertices) / 2);
                continue;
            }
            of_cells.insert(on_faces().cell_at(face_at[first_at[k]]));
            faces.insert(face_at.begin() + first_at[k], face_at.begin() + first_at[k + 1]);
        }
        if (has_several && group.front() < cells.vertices)
            for (const Index face : faces_beside(group.front(), of_cells)) of_cells.insert(on_faces().cell_at(face)), faces.insert(face);
        if (of_cells.size() + of_parts.size() > 1) found.push_back({sorted(faces), sorted(of_parts), thetas[group.front()]});
    }
    return found;
}

// Faces of other cells that contain a vertex.
std::vector<Index> MeetingPlaces::faces_beside(Index vertex, const std::set<Index>& of_cells) const {
    const Boundary& boundary = *on_faces().space->boundary;
    const Scene& scene = *boundary.scene;
    const Trapezoids& table = boundary.trapezoids;
    const auto [x, y] = position(*on_faces().cells, vertex);
    const double theta = on_faces().cells->places().theta[vertex];
    const Limits limits(boundary);
    std::vector<Index> found;
    for (const int chart : {0, 1}) {
        const double tau = tangent(std::remainder(theta - chart * std::numbers::pi, turn) / 2);
        if (std::abs(tau) > 1 + not_told_apart) continue;
        const auto pose = ExactPose::from(x, y, chart, std::clamp(tau, -1.0, 1.0), scene.scale);
        for (const Index face : on_faces().space->points().at_height_of(pose)) {
            const double from = table.tau_from(face), to = table.tau_to(face);
            if (tau < from - not_told_apart || tau > to + not_told_apart || of_cells.contains(on_faces().cell_at(face))) continue;
            const Feature contact = boundary.patches.contact(table.patch[face]);
            const auto [low, high] = limits.of(face, tau);
            const Place first = position_on(scene, contact, low, theta), last = position_on(scene, contact, high, theta);
            const Vec<double> along{last.x - first.x, last.y - first.y}, to_it{x - first.x, y - first.y};
            const double share = dot(along, to_it) / std::max(dot(along, along), 0x1p-1000);
            const double near = std::clamp(share, 0.0, 1.0);
            if (norm(to_it.x - near * along.x, to_it.y - near * along.y) <= not_told_apart * size) found.push_back(face);
        }
    }
    return found;
}

// Corners of a face, at its first and last orientations if these are rational.
Poses MeetingPlaces::corners(const BoundaryWalker& on, Index face) {
    heed_stop();
    const Sheet sheet = on.sheet(face);
    Poses found;
    for (const bool last : {false, true}) {
        const auto tau = rational_angle(*on.space->boundary, face, last);
        if (!tau) continue;
        const auto [lower, upper] = sheet.limits(*tau);
        for (const Ratio& t : {lower, upper}) found.push_back(sheet.pose(t, *tau));
    }
    return found;
}

// --- along edges ---

// Add candidates within curves along which cells touch.
void MeetingPlaces::at_edges(const BoundaryWalker& on, Poses& found) const {
    for (const auto& coedges : pinched(*on.cells)) {
        const auto side = static_cast<Side>(on.cells->side[coedges[0]]);
        if (side != Side::lower && side != Side::upper) continue;
        std::vector<Sheet> sheets;
        std::set<Index> of_cells;
        for (const Index h : coedges) {
            sheets.push_back(on.sheet(on.cells->face[h]));
            of_cells.insert(on.cell_at(on.cells->face[h]));
        }
        if (of_cells.size() < 2) continue;
        std::vector<Sheet*> all;
        for (Sheet& sheet : sheets) all.push_back(&sheet);
        const Ratio tau = common_tau(all);
        const auto [lower, upper] = sheets[0].limits(tau);
        found.push_back(sheets[0].pose(side == Side::upper ? upper : lower, tau));
    }
}

// --- within edges ---

// Add poses within the curves of faces at which a pillar beside them only touches their surface: there it parts no faces.
void MeetingPlaces::at_touches(const BoundaryWalker& on, Poses& found) const {
    const Boundary& boundary = *on.space->boundary;
    const Trapezoids& table = boundary.trapezoids;
    for (Index face = 0; !boundary.scene->is_round && face < static_cast<Index>(table.size()); ++face) {
        heed_stop();
        for (const bool upper : {false, true})
            for (const Ratio& tau : touches(boundary, face, unpacked((upper ? table.upper : table.lower)[face]))) {
                const Sheet sheet = on.sheet(face);
                const auto limits = sheet.limits(tau);
                found.push_back(sheet.pose(upper ? limits.second : limits.first, tau));
            }
    }
}

// --- on isolated parts ---

// Add the ends of a part, and its crossings with others.
void MeetingPlaces::at_part(const ThinPart& part, Poses& found) const {
    heed_stop();
    for (const auto& end : part.ends)
        if (end) found.push_back(*end);
    for (const Index k : parts_near(part.box(not_told_apart * size)))
        if (k != part.number)
            if (const auto pose = part.crossing(parts[k])) found.push_back(*pose);
}

// Faces with a vertex near a part.
std::vector<Index> MeetingPlaces::faces_near(const ThinPart& part) const {
    const double low = part.rounded[0].theta - not_told_apart, high = part.rounded[1].theta + not_told_apart;
    std::set<Index> faces;
    vertices->query(part.box(not_told_apart * size), [&](Index v) {
        const double after = on_faces().cells->places().theta[v] - low;
        if (after - turn * std::floor(after / turn) <= high - low)
            faces.insert(face_at.begin() + first_at[v], face_at.begin() + first_at[v + 1]);
    });
    return sorted(faces);
}

}  // namespace cfree
