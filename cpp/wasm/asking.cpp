// Answers to a page; everything is decided by the core.
#include "asking.hpp"

#include <numbers>
#include <set>

#include "cfree/planning/connecting_way.hpp"
#include "cfree/search/rrt_connect.hpp"
#include "cfree/search/shortcut.hpp"
#include "cfree/support/elementary.hpp"
#include "shown.hpp"

namespace cfree {

namespace {

constexpr int quick = 1000, checks_per_trapezoid = 3, attempts = 400;

Motion still(const World& world, const RationalPose& pose) {
    const auto at = pose.configuration(*world.scene);
    return motion_between(at, at);
}

bool is_outside(const World& world, const RationalPose& pose) {
    if (!world.limits) return false;
    const auto& [x0, y0, x1, y1] = *world.limits;
    return pose.x < x0 || pose.x > x1 || pose.y < y0 || pose.y > y1;
}

// Whose a convex piece is: a polygon's number, or bounds or workspace.
Index owner_of(const Shape& shape, const Owners& owners, Index piece) {
    const auto first = static_cast<std::size_t>(shape.piece_vertex[static_cast<std::size_t>(shape.piece[static_cast<std::size_t>(piece)])]);
    if (first < owners.polygon.size()) return owners.polygon[first];
    return shape.piece_layer[static_cast<std::size_t>(piece)] == reference_layer ? bounds_owner : workspace_owner;
}

// What a pose overlaps: a part of the robot and an obstacle, bounds or workspace.
std::optional<std::array<Index, 2>> overlap(const World& world, const RationalPose& pose) {
    if (is_outside(world, pose)) return std::array<Index, 2>{-1, world.shapes.bounds ? bounds_owner : workspace_owner};
    const auto found = world.checker->first_collision(still(world, pose));
    if (!found) return {};
    return std::array<Index, 2>{owner_of(world.scene->robot, world.features.robot, found->robot_piece),
                                owner_of(world.scene->obstacles, world.features.obstacles, found->obstacle_piece)};
}

class Searching {
public:
    Searching(const World& of, const RationalPose& start, const RationalPose& goal) : world(of), unit(of.scene->unit()) {
        for (double& c : area_of(start, goal)) area.push_back(c / unit);
        const double side = std::max(area[2] - area[0], area[3] - area[1]);
        std::frexp(side > 0 ? side : 1, &extent);
    }
    Configuration configuration(const RationalPose& pose) const {
        Configuration q = pose.configuration(*world.scene);
        const Place at = pose.place();
        q.px = at.x / unit, q.py = at.y / unit, q.theta = wrapped(at.theta);
        return q;
    }
    RationalPose pose(const Configuration& q) const {
        const Int whole = q.unit * world.scene->scale, common = gcd(q.hx, q.hy);
        HalfAngle half{q.hx / common, q.hy / common};
        if (half.q < 0 || (half.q.is_zero() && half.p < 0)) half.q = -half.q, half.p = -half.p;
        return {reduced(q.x, whole), reduced(q.y, whole), half};
    }
    RrtConnect search(const RationalPose& start, const RationalPose& goal) const {
        const auto joins = [this](const Configuration& a, const Configuration& b) { return world.checker->is_free(motion_between(a, b)); };
        return {joins, grid(24, 20), {area[0], area[1], area[2], area[3]}, weight(), configuration(start), configuration(goal), 0};
    }
    Poses shortened(const Poses& way) const {
        Route route;
        for (const auto& q : way) route.push_back(configuration(q));
        const std::vector<double> marks(route.size());
        Shortcut shortcut({*world.checker, nullptr, grid(40, 36), {}, {weight()}}, {std::move(route), marks}, 0);
        shortcut.run(attempts);
        return poses(shortcut.path());
    }
    Poses poses(const Route& route) const {
        Poses found;
        for (const auto& q : route) found.push_back(pose(q));
        return found;
    }

private:
    Grid grid(int place_bits, int angle_bits) const { return {world.scene->shift, place_bits - extent, angle_bits}; }
    double weight() const { return world.radius / unit; }
    // Of positions to try: bounds, else around the workspace, else with room around obstacles and poses.
    std::array<double, 4> area_of(const RationalPose& start, const RationalPose& goal) const {
        std::array<double, 4> box{};
        if (world.shapes.bounds) {
            for (std::size_t k = 0; k < 4; ++k) box[k] = nearest((*world.shapes.bounds)[k].n, (*world.shapes.bounds)[k].d);
            return box;
        }
        const Place p = start.place(), q = goal.place();
        box = {std::min(p.x, q.x), std::min(p.y, q.y), std::max(p.x, q.x), std::max(p.y, q.y)};
        const auto take = [&](const Polygon& of) {
            for (Index k = 0; k < of.vertices.size(); ++k) {
                const double x = nearest(of.vertices.X[k], of.denominator), y = nearest(of.vertices.Y[k], of.denominator);
                box = {std::min(box[0], x), std::min(box[1], y), std::max(box[2], x), std::max(box[3], y)};
            }
        };
        if (world.shapes.workspace) take(*world.shapes.workspace);
        else for (const auto& obstacle : world.shapes.obstacles) take(*obstacle);
        const double margin = world.shapes.workspace ? 0 : 2 * world.radius;
        return {box[0] - margin, box[1] - margin, box[2] + margin, box[3] + margin};
    }

    const World& world;
    const double unit;
    std::vector<double> area;
    int extent = 0;
};

struct Found {
    Connection::Verdict verdict = Connection::Verdict::open;
    Poses way;
    std::shared_ptr<const CellComplex> surface;
    std::vector<ContactSlide> slides = {};
};

Found find(World& world, const RationalPose& start, const RationalPose& goal) {
    using enum Connection::Verdict;
    const auto slides = std::make_shared<FoundSlides>();
    const FreeMotions motions(*world.scene, *world.checker, *slides);
    const RationalPose turned{start.x, start.y, goal.half}, moved{goal.x, goal.y, start.half};
    if (auto way = motions.first_free({{start, turned, goal}, {start, moved, goal}, {start, goal}})) {
        way->erase(std::unique(way->begin(), way->end()), way->end());
        return {joined, *way, {}};
    }
    const Searching searching(world, start, goal);
    auto search = searching.search(start, goal);
    if (const auto route = search.run(quick); !route.empty()) return {joined, searching.poses(route), {}};
    Connecting connecting(world.around, start, goal);
    for (Index most = 64;; most *= 2) {
        connecting.run(most);
        if (connecting.found().verdict != open) break;
        if (const auto route = search.run(checks_per_trapezoid * most); !route.empty()) return {joined, searching.poses(route), {}};
    }
    const Connection& found = connecting.found();
    if (found.verdict != joined) return {found.verdict, {}, found.surface};
    const Poses way = connecting_way(*world.around, found, world.radius, slides);
    return {joined, way, {}, slides->along(way)};
}

// Where a slide is when it has turned by 2 atan(t).
Place along(const ContactSlide& slide, double t, double theta) {
    const auto at = [&](const std::array<Int, 5>& p) {
        double value = 0;
        for (std::size_t k = 5; k-- > 0;) value = value * t + ratio(p[k], slide.d[0]);
        return value;
    };
    const Place from = slide.from.place();
    const double d = at(slide.d);
    return {from.x + at(slide.x) / d, from.y + at(slide.y) / d, theta + 2 * arc_tangent(t)};
}

// The slide from one pose to another, and whether it is taken backwards.
std::pair<const ContactSlide*, bool> slide_between(const std::vector<ContactSlide>& slides, const RationalPose& a, const RationalPose& b) {
    for (const auto& slide : slides) {
        if (slide.from == a && slide.to == b) return {&slide, false};
        if (slide.from == b && slide.to == a) return {&slide, true};
    }
    return {nullptr, false};
}

// Throws std::logic_error where a motion is not free.
void check(const World& world, const Poses& way, const std::vector<ContactSlide>& slides) {
    for (std::size_t k = 1; k < way.size(); ++k) {
        const auto [slide, _] = slide_between(slides, way[k - 1], way[k]);
        const bool is_free = slide ? world.checker->is_free(slide->motion(*world.scene))
                                   : world.checker->is_free(motion_between(way[k - 1].configuration(*world.scene), way[k].configuration(*world.scene)));
        if (!is_free) throw std::logic_error("a path is not free");
    }
}

// Poses along a path for the eye, their angles without jumps; and its measures.
void show_path(const World& world, const Poses& way, const std::vector<ContactSlide>& slides, Reply& reply) {
    std::vector<double> samples;
    std::vector<Index> motion;
    std::string words;
    double length = 0, turning = 0;
    Configuration before;
    for (std::size_t k = 0; k < way.size(); ++k) {
        const Place at = way[k].place();
        Configuration q = way[k].configuration(*world.scene);
        q.px = at.x, q.py = at.y, q.theta = at.theta;
        words += words_of(way[k]) + "\n";
        if (const auto [slide, is_back] = k > 0 ? slide_between(slides, way[k - 1], way[k]) : std::pair{nullptr, false}; slide) {
            const double end = nearest(slide->tau.n, slide->tau.d), first = before.theta - (is_back ? 2 * arc_tangent(end) : 0);
            constexpr int steps = 24;
            double x = before.px, y = before.py;
            for (int s = 1; s <= steps; ++s) {
                const double share = static_cast<double>(s) / steps;
                const Place p = along(*slide, end * (is_back ? 1 - share : share), first);
                samples.insert(samples.end(), {p.x, p.y, p.theta}), motion.push_back(static_cast<Index>(k) - 1);
                length += norm(p.x - x, p.y - y), x = p.x, y = p.y;
            }
            turning += 2 * std::abs(arc_tangent(end));
            q.theta = samples.back();
        } else if (k > 0) {
            double turn = turn_between(before, q);
            const bool is_half = std::abs(std::abs(turn) - std::numbers::pi) < 1e-9;
            if (is_half) q.theta = before.theta + std::numbers::pi - 1e-9, turn = turn_between(before, q);  // counter-clockwise
            const double travel = travel_between(before, q);
            length += travel, turning += std::abs(turn);
            const int steps = 1 + static_cast<int>(48 * (std::abs(turn) / 3 + travel / (4 * world.radius)));
            for (int s = 1; s <= steps; ++s) {
                const Place p = along(before, q, static_cast<double>(s) / steps);
                samples.insert(samples.end(), {p.x, p.y, p.theta}), motion.push_back(static_cast<Index>(k) - 1);
            }
            q.theta = before.theta + turn;
        } else samples.insert(samples.end(), {at.x, at.y, at.theta}), motion.push_back(0);
        before = q;
    }
    reply.text("poses", words);
    reply.add("samples", samples), reply.add("motion", motion);
    reply.add("length", length), reply.add("turning", turning), reply.add("motions", static_cast<double>(way.size()) - 1);
}

void show_proof(const World& world, const std::shared_ptr<const CellComplex>& surface, Reply& reply) {
    std::set<Index> obstacles;
    const auto& owners = world.features.obstacles.polygon;
    for (const Index patch : surface->boundary->trapezoids.patch) {
        const Index j = surface->boundary->patches.contact(patch).obstacle;
        obstacles.insert(owners[static_cast<std::size_t>(j)]);
    }
    reply.add("obstacles", std::vector<Index>(obstacles.begin(), obstacles.end()));
    show_surface(world, *surface, world.radius / 20, reply);
}

}  // namespace

void ask_pose(const World& world, const RationalPose& pose, Reply& reply) {
    const auto pair = overlap(world, pose);
    reply.add("free", pair ? 0.0 : 1.0);
    const Place at = pose.place();
    reply.add("place", std::vector{at.x, at.y, at.theta});
    if (pair) return reply.add("pair", std::vector<Index>(pair->begin(), pair->end()));
    if (!world.space) return;
    const ExactPose exact = pose.exact(*world.scene);
    reply.add("cells", world.space->cells_at(exact));
    std::set<Index> patches;
    Named touching;
    for (const Index trapezoid : world.space->points().nearby(exact).on) {
        const Index patch = world.boundary->trapezoids.patch[static_cast<std::size_t>(trapezoid)];
        if (patches.insert(patch).second) touching.add(world, world.boundary->patches.contact(patch));
    }
    touching.put("touching", reply);
}

void ask_stop(const World& world, const RationalPose& from, const RationalPose& to, Reply& reply) {
    FoundSlides none;
    const FreeMotions motions(*world.scene, *world.checker, none);
    const Ratio dx = to.x - from.x, dy = to.y - from.y;
    const auto share = motions.free_share(from, dx, dy);
    const Ratio u = share.value_or(Ratio{1, 1});
    reply.text("pose", words_of({from.x + u * dx, from.y + u * dy, from.half}));
    reply.add("share", nearest(u.n, u.d));
}

void ask_walk(const World& world, std::string_view lines, Reply& reply) {
    Poses way;
    for (std::size_t at = 0; at < lines.size();) {
        const auto end = std::min(lines.find('\n', at), lines.size());
        if (end > at) way.push_back(pose_of(lines.substr(at, end - at)));
        at = end + 1;
    }
    FoundSlides none;
    if (way.empty() || !FreeMotions(*world.scene, *world.checker, none).join(way)) throw std::invalid_argument("the path given is not free");
    reply.text("verdict", "path");
    show_path(world, way, {}, reply);
}

void ask_way(World& world, const RationalPose& start, const RationalPose& goal, Reply& reply) {
    for (const auto& [pose, name] : {std::pair{&start, "start"}, {&goal, "goal"}})
        if (const auto pair = overlap(world, *pose)) {
            reply.text("verdict", std::string(name) + " forbidden");
            return reply.add("pair", std::vector<Index>(pair->begin(), pair->end()));
        }
    auto found = find(world, start, goal);
    if (!found.way.empty()) {
        reply.text("verdict", "path");
        const bool may_shorten = found.way.size() > 2 && found.slides.empty();
        const Poses way = may_shorten ? Searching(world, start, goal).shortened(found.way) : found.way;
        check(world, way, found.slides);
        return show_path(world, way, found.slides, reply);
    }
    reply.text("verdict", found.surface ? "apart" : "unclear");
    if (found.surface) show_proof(world, found.surface, reply);
}

}  // namespace cfree
