// Planner of free motions from start to goal: the poses of a path, with free motions between them, or a proof that there is
// none.
//
// Cheap attempts come first: one motion, then a turn and a straight way. Then a search with random poses and the growth of
// the closed surfaces around the two poses alternate, by counted work: the answer is the same everywhere, in about twice the
// time of the better of both. The first surfaces are those of a slightly smaller robot: they prove that there is no path, or
// lead to one near by. The cells of the free space settle the rest: a walk along a cell's boundary is a path.
#pragma once
#include <deque>
#include <variant>

#include "cfree/planning/insets.hpp"
#include "cfree/planning/narrow_gates.hpp"
#include "cfree/planning/passages.hpp"
#include "cfree/planning/searcher.hpp"

namespace cfree {

class Planner {
public:
    Planner(std::shared_ptr<KnownScene> scene, double angle_scale);

    enum class Refused { start, goal, unclear };  // start, goal: forbidden; unclear: needs more effort
    using Answer = std::variant<Poses, Separation, Refused>;
    enum class Effort { few_surfaces, all };
    // The path from goal to start is the same, backwards. Slides join some neighbours on a path. Several threads may call this.
    Answer plan(const End& start, const End& goal, const Listener& listener, Effort most = Effort::all);

    // Take what a planner of another scene has computed and what holds in this one; before any other call. It waits for a query
    // of the other planner. Paths of that planner answer queries between poses near them, if they are still free, or if searches
    // lead around what is in their way.
    void take(Planner& other);

    // Path along the boundary of the first cell whose closure contains both poses, if there is one.
    std::optional<Poses> walk(const End& start, const End& goal, const Listener& listener);
    // Poses of a path between free poses, if simple ways or searches find one; these make about so many guesses of motions.
    std::optional<Poses> quick(const End& start, const End& goal, std::optional<int> guesses = {}) const;

    const std::shared_ptr<KnownScene> scene;
    const double angle_scale;  // length per radian: the robot's radius about its reference point
    const std::shared_ptr<FoundSlides> slides;  // slides on all paths so far

private:
    using Found = std::variant<Poses, Separation>;
    class Turns;
    // Motions that a search may guess about: these take about as long as the free space does.
    int most_guesses() const;
    // Decide by few surfaces: search alone, then by narrow gates, then in turns with the surfaces of a smaller robot, then with the
    // robot's own.
    std::optional<Found> by_few(const End& start, const End& goal, const Listener& listener);
    std::optional<Separation> by_narrow_gates(const std::shared_ptr<KnownScene>& smaller_scene, Connecting& joined, Turns& turns);
    std::optional<Found> by_smaller_robot(const std::shared_ptr<KnownScene>& smaller_scene, Connecting& joined, Turns& turns) const;
    std::optional<Found> by_robot_itself(Connecting& joined, Turns& turns) const;
    std::optional<Poses> way_along(const Connecting& joined, const std::shared_ptr<FoundSlides>& slides_on_it) const;
    std::optional<Poses> in_a_cell(const End& start, const End& goal, const Listener& listener);
    Found by_all(const End& start, const End& goal, const Listener& listener);
    std::optional<Poses> simple_way(const RationalPose& start, const RationalPose& goal) const;
    std::optional<Poses> former_way(const End& start, const End& goal);
    std::optional<Poses> mended(const Poses& way, int& left) const;
    std::optional<Poses> searched_near(const RationalPose& from, const RationalPose& to) const;
    void remember(const Poses& way);
    Poses straightened(const Poses& way) const;
    std::optional<Poses> searched(const End& start, const End& goal, int most, const Growth& growth = {}) const;
    const std::shared_ptr<const BoundaryWalker>& walker(const Listener& listener);
    Passages& passages(const Listener& listener);
    Insets& insets();
    NarrowGates& narrow_gates();

    std::mutex working;  // one thread at a time does more than a search
    std::shared_ptr<const BoundaryWalker> walks;
    std::unique_ptr<Passages> fits;
    std::unique_ptr<Insets> smaller;
    std::unique_ptr<NarrowGates> gates;
    std::mutex remembering;
    std::deque<Poses> ways;    // the last answers, the last first
    std::deque<Poses> former;  // those of planners of other scenes
};

// Reversed path, with as many motions; half a turn, which could go on either side, becomes two.
Poses reversed(const Poses& way);

}  // namespace cfree
