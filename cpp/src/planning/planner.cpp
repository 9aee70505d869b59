// Alternate simple ways, search and surfaces, then use all of the free space; theory, "Paths" and "One surface alone".
#include "cfree/planning/planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "cfree/planning/connecting_way.hpp"
#include "cfree/planning/off_contacts.hpp"
#include "cfree/support/phase.hpp"

namespace cfree {

namespace {

constexpr int search_guesses = 40000;  // most guesses of motions, if there are not many patches
constexpr int patches_each = 2;        // else one guess for as many
constexpr int all_guesses = 1 << 21;   // in any case: trees take memory
constexpr int quick_guesses = 4000;    // guesses before any exact work
constexpr int round_guesses = 16000;   // among round shapes
constexpr int straight_guesses = 500;  // there, of motions without turns, which come first
constexpr int first_trees = 20000;     // guesses in turns that trees need for most ways that are not narrow
constexpr int guesses_each = 25;       // of these for each patch that the surfaces meet
// Later the trees make one guess a patch for so many patches of the scene: few patches decide sooner than trees go through narrow
// places.
constexpr int scene_patches_each = 500, least_each = 6, most_each = 500;
// A pair of trees may go astray: one in eight took ten times the guesses of others of other seeds. So where surfaces take long,
// new trees begin then, each of twice as many guesses as the one before, up to a limit.
constexpr int each_in_many_patches = 50, least_trees = 4000, most_trees = 16000;
constexpr std::size_t most_ways = 16;  // paths that are kept for planners of other scenes
constexpr int nodes_near = 4;          // poses of such a path to which a motion is tried
constexpr int mending_guesses = 1000;  // guesses to lead such a path around what is in its way, each time
constexpr double mending_room = 3;     // beside it, in radii of the robot
constexpr double most_longer = 1.25;   // times the cost of such a path, around what is in its way, without another search
constexpr int most_mended = 8;         // times for one query
constexpr int most_off_contacts = 64;  // the same where a path along contacts of a smaller robot is in the way
constexpr std::size_t checks_each = 4, most_checks = 600;  // motions checked to straighten such a path, for each of its own
constexpr Index inner_steps = 16;       // times as many trapezoids of the polygon inside the robot
constexpr std::size_t little_room = 3;  // parts of the configuration space that a search reaches
constexpr double most_few = 0.75;      // greatest share of all patches in the phase with few patches

bool is_before(const RationalPose& a, const RationalPose& b) {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    if (a.half.q.is_zero() || b.half.q.is_zero()) return !a.half.q.is_zero() && b.half.q.is_zero();
    return Ratio{a.half.p, a.half.q} < Ratio{b.half.p, b.half.q};
}

// Pose half-way between a pose and one half a turn away: a quarter turn about their middle.
RationalPose half_way(const RationalPose& from, const RationalPose& to) {
    const Ratio half{1, 2}, x = half * (from.x + to.x), y = half * (from.y + to.y), u = from.x - x, v = from.y - y;
    return {x - v, y + u, HalfAngle::along(from.half.q - from.half.p, from.half.q + from.half.p)};
}

double apart(const Place& a, const Place& b, double angle_scale) {
    return norm(a.x - b.x, a.y - b.y) + angle_scale * std::abs(std::remainder(a.theta - b.theta, 2 * std::numbers::pi));
}

double cost_of(const Poses& way, double angle_scale) {
    double sum = 0;
    for (std::size_t k = 1; k < way.size(); ++k) sum += apart(way[k - 1].place(), way[k].place(), angle_scale);
    return sum;
}

}  // namespace

Poses reversed(const Poses& way) {
    Poses back{way.back()};
    for (auto after = way.rbegin(), pose = after + 1; pose != way.rend(); ++after, ++pose) {
        const HalfAngle &a = pose->half, &b = after->half;
        if (Int(a.q * b.q + a.p * b.p).is_zero()) back.push_back(half_way(*pose, *after));
        back.push_back(*pose);
    }
    return back;
}

Planner::Planner(std::shared_ptr<KnownScene> of, double radius)
    : scene(std::move(of)), angle_scale(radius), slides(std::make_shared<FoundSlides>()) {}

Planner::Answer Planner::plan(const End& start, const End& goal, const Listener& listener, Effort most) {
    const bool is_forth = !is_before(goal.pose, start.pose);
    const End &first = is_forth ? start : goal, &last = is_forth ? goal : start;
    std::optional<Poses> way;
    {
        const Phase phase(listener, "simple ways");
        if (!scene->is_free(start.pose)) return Refused::start;
        if (!scene->is_free(goal.pose)) return Refused::goal;
        if (start.pose == goal.pose) return Poses{start.pose};
        way = simple_way(first.pose, last.pose);
        if (!way) way = former_way(first, last);
        const auto built = scene->built();
        if (!way && built && built->common_cell(first.pose, last.pose) >= 0) way = searched(first, last, quick_guesses);
    }
    if (!way) {
        const std::lock_guard guard(working);
        std::optional<Found> found;
        const bool is_built = scene->built() != nullptr;
        if (!is_built) found = by_few(first, last, listener);
        if (!found && (is_built || most == Effort::all)) found = in_a_cell(first, last, listener);
        if (!found && most == Effort::all) found = by_all(first, last, listener);
        if (!found) return Refused::unclear;
        if (auto* proof = std::get_if<Separation>(&*found)) return std::move(*proof);
        way = std::get<Poses>(std::move(*found));
        remember(*way);
    }
    return is_forth ? *way : reversed(*way);
}

std::optional<Poses> Planner::simple_way(const RationalPose& start, const RationalPose& goal) const {
    const FreeMotions motions(scene->scene(), *scene->checker, *slides);
    const RationalPose turned{start.x, start.y, goal.half}, moved{goal.x, goal.y, start.half};
    auto way = motions.first_free({{start, turned, goal}, {start, moved, goal}, {start, goal}});
    if (way) way->erase(std::unique(way->begin(), way->end()), way->end());
    return way;
}

void Planner::remember(const Poses& way) {
    const std::lock_guard guard(remembering);
    ways.push_front(way);
    if (ways.size() > most_ways) ways.pop_back();
}

// Path along one of another scene; motions join both poses to it, and searches lead around what is in its way here.
std::optional<Poses> Planner::former_way(const End& start, const End& goal) {
    const FreeMotions motions(scene->scene(), *scene->checker, *slides);
    const auto nearest_of = [&](const Poses& on, const RationalPose& pose) -> std::optional<std::size_t> {
        const Place from = pose.place();
        std::vector<std::pair<double, std::size_t>> near;
        for (std::size_t k = 0; k < on.size(); ++k) near.push_back({apart(on[k].place(), from, angle_scale), k});
        std::sort(near.begin(), near.end());
        for (std::size_t n = 0; n < std::min<std::size_t>(nodes_near, near.size()); ++n)
            if (motions.join({pose, on[near[n].second]})) return near[n].second;
        return {};
    };
    int left = most_mended;
    for (const Poses& on : former) {
        const auto from = nearest_of(on, start.pose), to = from ? nearest_of(on, goal.pose) : std::nullopt;
        if (!to) continue;
        Poses along{start.pose};
        for (std::size_t k = *from; k != *to; k = k < *to ? k + 1 : k - 1) along.push_back(on[k]);
        along.push_back(on[*to]), along.push_back(goal.pose);
        along.erase(std::unique(along.begin(), along.end()), along.end());
        auto found = mended(along, left);
        if (!found) continue;
        const double cost = cost_of(*found, angle_scale);
        if (cost > most_longer * cost_of(along, angle_scale)) {
            auto other = searched(start, goal, quick_guesses);
            if (other && cost_of(*other, angle_scale) < cost) found = std::move(other);
        }
        if (*found != along) remember(*found);
        return found;
    }
    return {};
}

// Path with the free motions of a way, and searches in place of the others; each takes one from `left`.
std::optional<Poses> Planner::mended(const Poses& way, int& left) const {
    const FreeMotions motions(scene->scene(), *scene->checker, *slides);
    Poses found{way.front()};
    for (std::size_t k = 1; k < way.size(); ++k) {
        if (motions.join({way[k - 1], way[k]})) {
            found.push_back(way[k]);
            continue;
        }
        // on to the next free motion
        while (k + 1 < way.size() && !motions.join({way[k], way[k + 1]})) ++k;
        if (left-- <= 0) return {};
        const auto around = searched_near(found.back(), way[k]);
        if (!around) return {};
        found.insert(found.end(), around->begin() + 1, around->end());
    }
    return found;
}

std::optional<Poses> Planner::searched_near(const RationalPose& from, const RationalPose& to) const {
    const std::array ends{from.place(), to.place()};
    const Searcher searcher(scene, ends, {angle_scale});
    const Route around = searcher.search_near({from, ends[0]}, {to, ends[1]}, mending_room * angle_scale).run(mending_guesses);
    if (around.empty()) return {};
    return searcher.poses(around);
}

// The same path with fewer motions: one along contacts has hundreds, and any change is in the way of some.
Poses Planner::straightened(const Poses& way) const {
    std::vector<End> ends;
    for (const RationalPose& pose : way) ends.push_back({pose, pose.place()});
    const std::array outer{ends.front().place, ends.back().place};
    const Searcher searcher(scene, outer, {angle_scale});
    Shortcut shorter = searcher.shortener(ends);
    shorter.run(static_cast<int>(std::min<std::size_t>(most_checks, checks_each * way.size())));
    shorter.merge();
    return searcher.poses(shorter.path());
}

void Planner::take(Planner& other) {
    const std::lock_guard guard(other.working);
    scene->take(*other.scene);
    if (other.smaller) insets().take(*other.smaller);
    if (other.gates && other.gates->has_results() && !scene->scene().is_round) narrow_gates().take(*other.gates);
    const std::lock_guard ways_guard(other.remembering);
    for (const Poses& way : other.ways) former.push_back(straightened(way));
    for (const Poses& way : other.former)
        if (former.size() < most_ways) former.push_back(way);
}

std::optional<Poses> Planner::quick(const End& start, const End& goal, std::optional<int> guesses) const {
    const int most = guesses.value_or(most_guesses());
    if (auto way = simple_way(start.pose, goal.pose)) return way;
    if (!scene->round) return searched(start, goal, most);
    // looks at round shapes cost little: there is time for more searches
    if (auto way = searched(start, goal, std::min(straight_guesses, most / 4), without_turns)) return way;
    if (auto way = searched(start, goal, most / 4)) return way;
    return searched(start, goal, most - most / 4, by_short_steps);
}

std::optional<Poses> Planner::searched(const End& start, const End& goal, int most, const Growth& growth) const {
    const std::array ends{start.place, goal.place};
    const Searcher searcher(scene, ends, {angle_scale});
    const Route route = searcher.search(start, goal, 0, growth).run(most);
    if (route.empty()) return {};
    return searcher.poses(route);
}

int Planner::most_guesses() const {
    if (scene->round) return round_guesses;
    return static_cast<int>(std::min<std::int64_t>(search_guesses, quick_guesses + 8 * scene->patches()));
}

// A search with random poses and a decision by surfaces, in turns: for each patch that the surfaces meet, the search makes some
// guesses.
class Planner::Turns {
public:
    Turns(const Planner& planner, const End& from, const End& until, const Listener& to)
        : start(from), goal(until), listener(to), deadline(to),
          searcher(planner.scene, std::array{from.place, until.place}, {planner.angle_scale}), search(searcher.search(start, goal)) {
        const std::int64_t patches = planner.scene->patches();
        later_each = static_cast<int>(std::clamp<std::int64_t>(patches / scene_patches_each, least_each, most_each));
        left = static_cast<int>(std::clamp<std::int64_t>(patches / patches_each, search_guesses, all_guesses));
    }

    std::optional<Poses> search_alone() { return guess(quick_guesses); }

    // Go on until the surfaces decide, or the search finds a way.
    Connection::Verdict decide(Connecting& joined) {
        std::size_t trimmed = joined.around->trimmed_patches(), met = joined.around->met_patches();
        return joined.decide([&](Index) {
            const std::size_t before = std::exchange(trimmed, joined.around->trimmed_patches());
            const std::size_t met_before = std::exchange(met, joined.around->met_patches());
            const auto more = static_cast<std::int64_t>(met - met_before);
            const std::int64_t first = std::clamp<std::int64_t>(first_trees - made, 0, guesses_each * more);
            const auto guesses = static_cast<int>(std::min<std::int64_t>(left, std::max(first, later_each * more)));
            left -= guesses, made += guesses;
            way = in_turn(guesses);
            if (way) return false;
            joined.compare_cells(search.reached());
            deadline.heed();
            if (listener.spend) listener.spend(static_cast<std::int64_t>(trimmed - before));
            return true;
        });
    }

    // The same without the search. Surfaces of a polygon inside the robot, if any, grow faster, as their patches cost less.
    void decide_alone(Connecting& joined, Connecting* inner) {
        const auto grows = [&](Connecting& by, Index most) {
            const std::size_t before = by.around->trimmed_patches();
            by.run(most);
            deadline.heed();
            heed_stop();
            if (listener.spend) listener.spend(static_cast<std::int64_t>(by.around->trimmed_patches() - before));
            return by.found().verdict == Connection::Verdict::open;
        };
        joined.compare_cells(search.reached());
        if (inner) inner->compare_cells(search.reached());
        Index inner_most = Connecting::first_step;
        for (Index most = inner_most; most < Connecting::last_step / inner_steps; most *= 2) {
            for (; inner && inner_most <= inner_steps * most; inner_most *= 2)
                if (!grows(*inner, inner_most)) return;
            if (!grows(joined, most)) return;
        }
    }

    // True if both poses have been found to have some room.
    bool have_room() const { return std::min(search.reached()[0], search.reached()[1]) > little_room; }

    const End start, goal;
    std::optional<Poses> way;  // the search's

private:
    std::optional<Poses> guess(int guesses) { return poses(search.run_on(guesses)); }

    // The first trees go on. Once they have had their time, others get as much, from new seeds.
    std::optional<Poses> in_turn(int guesses) {
        if (auto found = guess(guesses)) return found;
        if (made <= first_trees || later_each < each_in_many_patches) return {};
        for (int rest = guesses; rest > 0;) {
            if (of_others <= 0) {
                others.emplace(searcher.search(start, goal, ++seed));
                of_others = size, size = std::min(2 * size, most_trees);
            }
            const int part = std::min(rest, of_others);
            rest -= part, of_others -= part;
            if (auto found = poses(others->run_on(part))) return found;
        }
        return {};
    }

    std::optional<Poses> poses(const Route& route) const {
        if (route.empty()) return {};
        return searcher.poses(route);
    }

    const Listener& listener;
    const Deadline deadline;
    const Searcher searcher;
    RrtConnect search;
    std::optional<RrtConnect> others;
    std::uint64_t seed = 0;
    int later_each, left, made = 0, of_others = 0, size = least_trees;
};

std::optional<Planner::Found> Planner::by_few(const End& start, const End& goal, const Listener& listener) {
    Turns turns(*this, start, goal, listener);
    {
        const Phase phase(listener, "search");
        if (auto way = turns.search_alone()) return std::move(*way);
    }
    const Phase phase(listener, "surfaces around the two poses");
    if (const auto inner = insets().scene(insets().first())) {
        Connecting joined = inner->connecting(start.pose, goal.pose);
        if (auto proof = by_narrow_gates(inner, joined, turns)) return std::move(*proof);
        if (auto answer = by_smaller_robot(inner, joined, turns)) return answer;
        if (static_cast<double>(joined.around->met_patches()) > most_few * static_cast<double>(scene->patches())) return {};
    }
    Connecting joined = scene->connecting(start.pose, goal.pose);
    return by_robot_itself(joined, turns);
}

// Prove by surfaces alone that there is no path, if gates are too narrow: trees would not get through. The surface around a pose
// without room is small; around the polygon inside the robot it may be large.
std::optional<Separation> Planner::by_narrow_gates(const std::shared_ptr<KnownScene>& smaller_scene, Connecting& joined, Turns& turns) {
    if (scene->scene().is_round || scene->round || !narrow_gates().part(turns.start.place, turns.goal.place)) return {};
    std::optional<Connecting> inner;
    if (turns.have_room() && gates->inner()) inner.emplace(gates->inner()->connecting(turns.start.pose, turns.goal.pose));
    turns.decide_alone(joined, inner ? &*inner : nullptr);
    const auto is_proof = [](const Connecting& by) { return by.found().verdict == Connection::Verdict::apart; };
    if (is_proof(joined)) return Separation{barrier_of(*joined.found().surface), smaller_scene, true};
    if (inner && is_proof(*inner)) return Separation{barrier_of(*inner->found().surface), gates->inner(), true};
    return {};
}

// The surfaces of a smaller robot prove that there is no path. A way along them mostly is a path a little off them.
std::optional<Planner::Found> Planner::by_smaller_robot(const std::shared_ptr<KnownScene>& smaller_scene, Connecting& joined,
                                                        Turns& turns) const {
    const auto verdict = turns.decide(joined);
    if (turns.way) return std::move(*turns.way);
    if (verdict == Connection::Verdict::apart) return Separation{barrier_of(*joined.found().surface), smaller_scene, true};
    if (verdict != Connection::Verdict::joined) return {};
    const auto hugging = way_along(joined, std::make_shared<FoundSlides>());
    if (!hugging) return {};
    int left = most_off_contacts;
    auto way = off_contacts(*hugging, FreeMotions(scene->scene(), *scene->checker, *slides),
                            [&](const RationalPose& from, const RationalPose& to) -> std::optional<Poses> {
                                if (left-- <= 0) return {};
                                return searched_near(from, to);
                            });
    if (!way) return {};
    return std::move(*way);
}

// Use the robot's own surfaces to find a way. If they part the two poses, the cells decide: a fit without width may join them.
std::optional<Planner::Found> Planner::by_robot_itself(Connecting& joined, Turns& turns) const {
    const auto verdict = turns.decide(joined);
    if (turns.way) return std::move(*turns.way);
    if (verdict != Connection::Verdict::joined) return {};
    auto way = way_along(joined, slides);
    if (!way) return {};
    return std::move(*way);
}

// Find a way along these surfaces; nothing if there is none.
std::optional<Poses> Planner::way_along(const Connecting& joined, const std::shared_ptr<FoundSlides>& slides_on_it) const {
    try {
        return connecting_way(*joined.around, joined.found(), angle_scale, slides_on_it);
    } catch (const std::logic_error&) {
        return {};
    }
}

std::optional<Poses> Planner::walk(const End& start, const End& goal, const Listener& listener) {
    const std::lock_guard guard(working);
    return in_a_cell(start, goal, listener);
}

std::optional<Poses> Planner::in_a_cell(const End& start, const End& goal, const Listener& listener) {
    const auto built = scene->build(listener);
    const Phase phase(listener, "path in a cell");
    const Index cell = built->common_cell(start.pose, goal.pose);
    if (cell < 0) return {};
    return walker(listener)->walk(start, goal, cell);
}

// Plan between two poses in different cells, or in none.
Planner::Found Planner::by_all(const End& start, const End& goal, const Listener& listener) {
    const int first = insets().first();
    {
        const Phase phase(listener, "proof");
        if (auto proof = insets().closed(start.pose, goal.pose, first, listener)) return std::move(*proof);
    }
    {
        const Phase phase(listener, "exact fits");
        if (auto way = passages(listener).path(start.pose, goal.pose, false)) return std::move(*way);
    }
    std::vector<int> others = insets().powers;
    std::erase(others, first);
    Separation proof{};
    {
        const Phase phase(listener, "closer proofs");
        proof = separation(scene, *scene->built(), insets(), start.pose, goal.pose, others, listener);
    }
    if (proof.is_closed) return proof;
    const Phase phase(listener, "other exact fits");
    if (auto way = passages(listener).path(start.pose, goal.pose, true)) return std::move(*way);
    return proof;
}

const std::shared_ptr<const BoundaryWalker>& Planner::walker(const Listener& listener) {
    const auto built = scene->build(listener);
    if (!walks) walks = std::make_shared<const BoundaryWalker>(built->space, built->surfaces, scene->checker, angle_scale, slides);
    return walks;
}

Passages& Planner::passages(const Listener& listener) {
    const auto& boundary = scene->build(listener)->boundary;
    const auto slits = [&] { return may_have_slits(scene->scene()) ? glue(boundary, listener.threads) : nullptr; };
    if (!fits) fits = std::make_unique<Passages>(walker(listener), slits());
    return *fits;
}

Insets& Planner::insets() {
    if (!smaller) smaller = std::make_unique<Insets>(scene->shapes());
    return *smaller;
}

NarrowGates& Planner::narrow_gates() {
    if (!gates) gates = std::make_unique<NarrowGates>(*scene, power_of_two(insets().size + insets().first()));
    return *gates;
}

}  // namespace cfree
