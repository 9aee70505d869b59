// Answers to a page; everything is decided by the core.
#include "asking.hpp"

#include <numbers>
#include <set>

#include "cfree/support/elementary.hpp"
#include "driving.hpp"
#include "missing.hpp"
#include "shown.hpp"

namespace cfree {

namespace {

constexpr int attempts = 400, dear = 3;  // to shorten a path; so many times as many with preferences
// Among round shapes: errors of polygons, in parts of the robot's size; guesses of a search before and after the first proof is
// tried; the work of all proofs.
constexpr double shares[] = {0x1p-6, 0x1p-9, 0x1p-12};
constexpr double share_to_drive = 0x1p-10;
constexpr int few_guesses = 2000, many_guesses = 20'000;
constexpr std::int64_t most_patches = 60'000, few_patches = 20'000;  // in all; of a scene whose boundary is computed

struct OutOfWork {};

Motion still(const World& world, const RationalPose& pose) {
    const auto at = pose.configuration(*world.scene);
    return motion_between(at, at);
}

// Whose a convex piece is: a polygon's number, or bounds or workspace.
Index owner_of(const Shape& shape, const Owners& owners, Index piece) {
    const auto first = static_cast<std::size_t>(shape.piece_vertex[static_cast<std::size_t>(shape.piece[static_cast<std::size_t>(piece)])]);
    if (first < owners.polygon.size()) return owners.polygon[first];
    return shape.piece_layer[static_cast<std::size_t>(piece)] == reference_layer ? bounds_owner : workspace_owner;
}

// A motion in the user's units.
Motion in_units(const World& world, Motion motion) {
    motion.unit *= world.scene->scale;
    return motion;
}

std::array<Index, 2> pair_of(const Rounds& rounds, const ArcCollision& collision) {
    const Index owner = rounds.owner(collision.obstacle);
    return {owner == bounds_owner ? Index{-1} : collision.part, owner};
}

// Overlap of a pose: a part of the robot and an obstacle, bounds or workspace.
std::optional<std::array<Index, 2>> overlap(const World& world, const RationalPose& pose) {
    if (world.rounds) {
        const auto collision = world.rounds->motions->first_collision(in_units(world, still(world, pose)));
        return collision ? std::optional(pair_of(*world.rounds, *collision)) : std::nullopt;
    }
    if (!world.known->is_within_limits(pose)) return std::array<Index, 2>{-1, world.shapes.bounds ? bounds_owner : workspace_owner};
    const auto found = world.checker->first_collision(still(world, pose));
    if (!found) return {};
    return std::array<Index, 2>{owner_of(world.scene->robot, world.features.robot, found->robot_piece),
                                owner_of(world.scene->obstacles, world.features.obstacles, found->obstacle_piece)};
}

Poses shortened(const World& world, const Poses& way, const Costs& costs) {
    std::vector<End> ends;
    std::vector<Place> places;
    for (const auto& pose : way) ends.push_back({pose, pose.place()}), places.push_back(pose.place());
    const Searcher searcher(world.planner->scene, places, costs);
    Shortcut shortcut = searcher.shortener(ends);
    shortcut.run((costs.prefer() ? dear : 1) * attempts);
    shortcut.merge();
    return searcher.poses(shortcut.path());
}

// Pose of a slide that has turned by 2 atan(t).
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
    std::vector<double> clearance;
    for (std::size_t k = 0; k < samples.size(); k += 3) clearance.push_back(world.clearance({samples[k], samples[k + 1], samples[k + 2]}));
    reply.add("clearance", clearance);
    reply.text("poses", words);
    reply.add("samples", samples), reply.add("motion", motion);
    reply.add("length", length), reply.add("turning", turning), reply.add("motions", static_cast<double>(way.size()) - 1);
}

// Gears of the motions.
void show_gears(const World& world, const GivenVehicle& vehicle, const Poses& way, Reply& reply) {
    const std::vector<Index> gears = gears_of(world, vehicle, way);
    int cusps = 0, last = 0;
    for (const Index gear : gears)
        if (gear != 0) cusps += gear == -last, last = gear;
    reply.add("gear", gears), reply.add("cusps", static_cast<double>(cusps));
}

const char* words_of(DrivenWay::Verdict verdict) {
    using enum DrivenWay::Verdict;
    switch (verdict) {
        case path: return "path";
        case start_touches: return "start touches";
        case goal_touches: return "goal touches";
        case contacts: return "contacts";
        case narrow: return "narrow";
        case manoeuvres: return "manoeuvres";
        case forward: return "forward";
    }
    return "unclear";
}

void show_proof(const World& world, const Separation& proof, Reply& reply) {
    const SharedBoundary& boundary = proof.surface.boundary;
    const auto glued = glue_part(boundary, std::vector<char>(boundary->trapezoids.size(), 1), proof.surface.faces);
    if (!glued.complex) throw std::logic_error("a surface that separates is not closed");
    const SceneFeatures& features = *proof.of->features;
    std::set<Index> obstacles;
    for (const Index patch : glued.complex->boundary->trapezoids.patch)
        obstacles.insert(world.obstacle(features.obstacles.polygon[static_cast<std::size_t>(glued.complex->boundary->patches.contact(patch).obstacle)]));
    reply.add("obstacles", std::vector<Index>(obstacles.begin(), obstacles.end()));
    reply.add("closed", proof.is_closed ? 1.0 : 0.0);
    show_surface(features, *glued.complex, world.radius, reply);
}

// The share of a translation among round shapes that is free: up to the contact, if it is at a short fraction, or nearly so.
std::optional<Ratio> free_share(const World& world, const RationalPose& from, const RationalPose& to) {
    const auto collision = world.rounds->motions->first_collision(in_units(world, motion_between(from.configuration(*world.scene), to.configuration(*world.scene))));
    if (!collision) return {};
    const Ratio simple = simplest_between(collision->low, collision->high);
    const RationalPose end{from.x + simple * (to.x - from.x), from.y + simple * (to.y - from.y), from.half};
    return world.checker->is_free(motion_between(from.configuration(*world.scene), end.configuration(*world.scene))) ? simple : collision->low;
}

// A path among round shapes: a simple one, or that of a search with some guesses.
std::optional<Poses> searched(const World& world, const End& start, const End& goal, int most) {
    if (start.pose == goal.pose) return Poses{start.pose};
    FoundSlides none;
    const FreeMotions motions(*world.scene, *world.checker, none);
    const RationalPose turned{start.pose.x, start.pose.y, goal.pose.half}, moved{goal.pose.x, goal.pose.y, start.pose.half};
    if (auto way = motions.first_free({{start.pose, goal.pose}, {start.pose, turned, goal.pose}, {start.pose, moved, goal.pose}})) {
        way->erase(std::unique(way->begin(), way->end()), way->end());
        return way;
    }
    const std::array ends{start.place, goal.place};
    const Searcher searcher(world.known, ends, {world.radius});
    const Route route = searcher.search(start, goal).run(most);
    if (route.empty()) return {};
    return searcher.poses(route);
}

struct Undecided {};
using Decided = std::variant<Undecided, Poses, Separation>;

Decided planned(const World& world, const End& start, const End& goal) {
    auto answer = world.planner->plan(start, goal, {});
    if (auto* way = std::get_if<Poses>(&answer)) return std::move(*way);
    if (auto* proof = std::get_if<Separation>(&answer)) return std::move(*proof);
    return Undecided{};
}

// A path among the polygons inside of round shapes, or one beside it, if it is free among these; else nothing.
std::optional<Poses> mended(const World& world, const Poses& way) {
    FoundSlides none;
    const FreeMotions motions(*world.scene, *world.checker, none);
    if (motions.join(way)) return way;
    Poses beside = balanced(world, way, {world.radius});
    return motions.join(beside) ? std::optional(std::move(beside)) : std::nullopt;
}

// A path among round shapes, or a proof among smaller rounded shapes or among polygons inside, or neither. The world's polygons
// become finer.
Decided decided(World& world, const End& start, const End& goal) {
    std::int64_t left = most_patches;
    Listener counted;
    counted.spend = [&](std::int64_t patches) {
        if ((left -= patches) < 0) throw OutOfWork();
    };
    for (std::size_t k = 0; k < std::size(shares); ++k) {
        std::optional<World> finer;
        if (k > 0) finer.emplace(world.rounds, world.rounds->polygons(shares[k], false), false);
        World& here = finer ? *finer : world;
        if (k == 0) {
            if (auto way = searched(here, start, goal, few_guesses)) return std::move(*way);
            if (!world.by_cells) world.by_cells = RoundCells::of(*world.rounds);
            if (world.by_cells)
                if (auto proof = world.by_cells->proof(start.pose, goal.pose)) {
                    world.proved = world.by_cells->smaller;
                    return std::move(*proof);
                }
        }
        try {
            const auto known = KnownScene::of(here.shapes);
            const auto effort = known->patches() <= few_patches ? Planner::Effort::all : Planner::Effort::few_surfaces;
            auto answer = Planner(known, here.radius).plan(start, goal, counted, effort);
            if (auto* proof = std::get_if<Separation>(&answer)) {
                world.proved = here.near;
                return std::move(*proof);
            }
            if (const auto* way = std::get_if<Poses>(&answer))
                if (auto better = mended(here, *way)) return std::move(*better);
        } catch (const OutOfWork&) {
            return Undecided{};
        }
        if (k == 0)
            if (auto way = searched(here, start, goal, many_guesses)) return std::move(*way);
    }
    return Undecided{};
}

}  // namespace

void ask_pose(const World& world, const World& drawn, const RationalPose& pose, Reply& reply) {
    const auto pair = overlap(world, pose);
    reply.add("free", pair ? 0.0 : 1.0);
    const Place at = pose.place();
    reply.add("place", std::vector{at.x, at.y, at.theta});
    if (pair) return reply.add("pair", std::vector<Index>(pair->begin(), pair->end()));
    reply.add("clearance", world.clearance(at));
    if (world.rounds) {
        std::vector<Index> touched = world.rounds->touched(in_units(world, still(world, pose)));
        if (const auto& bounds = world.shapes.bounds) {
            const auto& [x0, y0, x1, y1] = *bounds;
            if (pose.x == x0 || pose.x == x1 || pose.y == y0 || pose.y == y1) touched.push_back(bounds_owner);
        }
        reply.add("touched", touched);
    }
    if (!drawn.space || !drawn.is_exact()) return;
    const ExactPose exact = pose.exact(*drawn.scene);
    reply.add("cells", drawn.space->cells_at(exact));
    std::set<std::array<Index, 3>> contacts;
    Named touching;
    for (const Index trapezoid : drawn.space->points().nearby(exact).on) {
        const Feature contact = drawn.boundary->patches.contact(drawn.boundary->trapezoids.patch[static_cast<std::size_t>(trapezoid)]);
        if (contacts.insert({static_cast<Index>(contact.kind), contact.robot, contact.obstacle}).second) touching.add(drawn, contact);
    }
    touching.put("touching", reply);
}

void ask_joined(const World& drawn, const RationalPose& start, const RationalPose& goal, Reply& reply) {
    drawn.need_space();
    if (!drawn.is_exact()) return;
    const Built built{drawn.boundary, drawn.cells, drawn.space};
    reply.add("joined", built.common_cell(start, goal) >= 0 ? 1.0 : 0.0);
}

void ask_stop(const World& world, const RationalPose& from, const RationalPose& to, Reply& reply) {
    FoundSlides none;
    const FreeMotions motions(*world.scene, *world.checker, none);
    const Ratio dx = to.x - from.x, dy = to.y - from.y;
    const auto share = world.rounds ? free_share(world, from, to) : motions.free_share(from, dx, dy);
    const Ratio u = share.value_or(Ratio{1, 1});
    reply.text("pose", words_of({from.x + u * dx, from.y + u * dy, from.half}));
    reply.add("share", nearest(u.n, u.d));
}

void ask_missing(const World& world, const RationalPose& start, const RationalPose& goal, Reply& reply) {
    const End first{start, start.place()}, last{goal, goal.place()};
    const auto found = missing(world, [&](World& with_less) {
        if (const auto joined = with_less.rounds ? joined_by_cells(*with_less.rounds, start, goal) : std::nullopt)
            return *joined ? Joined::yes : Joined::no;
        const auto answer = with_less.rounds ? decided(with_less, first, last) : planned(with_less, first, last);
        return std::holds_alternative<Poses>(answer) ? Joined::yes : std::holds_alternative<Separation>(answer) ? Joined::no : Joined::unclear;
    });
    // a robot of which nothing is left by any inset has arcs as sides, or a part without an inside
    if (!found) return reply.text("verdict", smaller(world, ratio_of(world.radius * 0x1p-40)) ? "none" : "unknown");
    const auto show = [&](const char* name, const Ratio& by) { reply.add(name, nearest(by.n, by.d)); };
    show("lo", found->lo), show("hi", found->hi);
    reply.add("proved", found->is_proved ? 1.0 : 0.0);
}

void ask_walk(World& world, std::string_view lines, const std::optional<GivenVehicle>& vehicle, Reply& reply) {
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
    if (vehicle) show_gears(world, *vehicle, way, reply);
    world.answer = {way.front(), way.back(), way, {}, vehicle};
}

void ask_way(World& world, const RationalPose& start, const RationalPose& goal, const std::optional<GivenVehicle>& vehicle, int attempts,
             const Wishes& wishes, Reply& reply) {
    world.answer.reset();
    for (const auto& [pose, name] : {std::pair{&start, "start"}, {&goal, "goal"}})
        if (const auto pair = overlap(world, *pose)) {
            reply.text("verdict", std::string(name) + " forbidden");
            return reply.add("pair", std::vector<Index>(pair->begin(), pair->end()));
        }
    if (world.rounds && world.rounds->asked.clearance.n > 0) show_robot(*world.rounds, "grown", reply);
    const End first{start, start.place()}, last{goal, goal.place()};
    const auto answer = world.rounds ? decided(world, first, last) : planned(world, first, last);
    if (const auto* proof = std::get_if<Separation>(&answer)) {
        reply.text("verdict", "apart");
        world.answer = {start, goal, *proof, {}, {}};
        return show_proof(world, *proof, reply);
    }
    if (std::holds_alternative<Undecided>(answer)) return reply.text("verdict", world.rounds ? "round" : "unclear");
    const Poses& found = std::get<Poses>(answer);
    if (vehicle) {
        std::optional<World> finer;  // a vehicle keeps more than the error of polygons
        if (world.rounds) finer.emplace(world.rounds, world.rounds->polygons(share_to_drive, false), false);
        const DrivenWay driving = driven(finer ? *finer : world, *vehicle, found, attempts);
        using enum DrivenWay::Verdict;
        const bool needs_contacts = driving.verdict == start_touches || driving.verdict == goal_touches || driving.verdict == contacts || driving.verdict == narrow;
        if (world.rounds && needs_contacts) return reply.text("verdict", "round");  // the polygons do not tell contacts
        reply.text("verdict", words_of(driving.verdict));
        if (driving.verdict == manoeuvres) reply.add("manoeuvres", driving.manoeuvres);
        if (driving.verdict != path) return;
        check(world, driving.way, {});
        show_path(world, driving.way, {}, reply);
        show_gears(world, *vehicle, driving.way, reply);
        world.answer = {start, goal, driving.way, {}, vehicle};
        return;
    }
    const auto slides = world.planner->slides->along(found);
    reply.text("verdict", "path");
    const Costs costs{world.radius, wishes.sideways, wishes.backward, wishes.turning};
    const bool may_change = slides.empty() && (found.size() > 2 || costs.prefer() || wishes.is_clear);
    const Poses way = !may_change ? found : wishes.is_clear ? balanced(world, found, costs) : shortened(world, found, costs);
    check(world, way, slides);
    show_path(world, way, slides, reply);
    world.answer = {start, goal, way, slides, {}};
}

}  // namespace cfree
