// The closed surface around a pose, without the rest of the boundary: a ray towards -x meets a surface, which is grown until it
// is closed. Met from inside it is the outer boundary of the pose's cell. An island of the cell is met from outside: where the
// ray leaves it for the last time it is in the cell again, and goes on. theory, "One surface alone".
#pragma once
#include <functional>

#include "cfree/free/surface_explorer.hpp"
#include "cfree/planning/rational_pose.hpp"

namespace cfree {

// A part of a way on one surface: from one pose of contact to another.
struct Stretch {
    std::shared_ptr<const CellComplex> surface;
    ExactPose enter, leave;
};

class Surroundings {
public:
    Surroundings(std::shared_ptr<const Scene> scene, std::shared_ptr<const MotionChecker> checker, bool regularized);

    // What is known of the cell of a pose.
    struct Search {
        ExactPose pose;
        bool ended = false;
        bool failed = false;  // ended without an answer: the pose is too close to contacts, or touches all around
        Index surface = -1;   // ended: the outer boundary of its cell; -1 if nothing is around it
        ExactPose from, at;   // near the pose, where the ray starts, and where it goes on
        std::vector<Stretch> passed;  // islands on the ray: where it meets and where it leaves them
        ExactPose contact;    // what it has met last
        Index seed = -1;      // there, of a surface that grows
    private:
        friend class Surroundings;
        int attempt = 0;
    };
    Search search(const ExactPose& free_pose) const;
    // Go on with it, by about so many trapezoids, of a surface that grows towards a seed of another search, if there is one.
    // What of it has reached that.
    std::shared_ptr<const CellComplex> advance(Search& search, Index most, Index target);

    // From another place near the pose, joined to it by one free motion; false if there is none any more.
    bool start_again(Search& search) const;

    // Whether a surface is around where the ray of a search starts; nothing if that is on it.
    std::optional<bool> is_around(Index surface, const Search& search) const;
    const std::shared_ptr<const CellComplex>& surface(Index k) const { return surfaces[k].complex; }

    std::size_t trimmed_patches() const { return explorer.trimmed_patches(); }
    // An x, in the scene's integers, where the robot is to the left of everything.
    Int far_left() const { return left - 4 * radius; }

    const std::shared_ptr<const Scene> scene;
    const std::shared_ptr<const MotionChecker> checker;

private:
    struct Known {
        std::shared_ptr<const CellComplex> complex;
        std::unique_ptr<const PointLocation> rays;
    };
    enum class Met { surface, nothing, unclear };
    Met meet(Search& search);
    Index known_at(const ExactPose& contact) const;
    bool pass(Search& search, Index surface) const;
    std::optional<ExactPose> beyond(const Search& search, const Known& surface, const std::vector<Index>& crossed) const;

    SurfaceExplorer explorer;
    std::vector<Known> surfaces;
    Int size, radius, left;  // of the robot, of it about its reference point, of the smallest x of what is an obstacle
};

// Two free poses: in one cell, with a way from one to the other, or apart.
struct Connection {
    enum class Verdict { open, unclear, apart, joined };  // open: not yet known
    Verdict verdict = Verdict::open;
    std::shared_ptr<const CellComplex> surface;  // apart: it is around one of them and not the other
    int inside = 0;                              // then: that one
    // Joined: the way goes to the first of two poses near these, straight to stretches one after another, and so to the goal.
    // After the first `before` of them it may be far away to the left.
    RationalPose start, goal;
    ExactPose near_start, near_goal;
    std::vector<Stretch> stretches;
    bool is_far = false;
    std::size_t before = 0;
};

// Finds it out from both at once.
class Connecting {
public:
    Connecting(std::shared_ptr<Surroundings> around, const RationalPose& start, const RationalPose& goal);
    // Go on by about so many trapezoids around each.
    void run(Index most);
    // Go on to the end, by twice as many each time, as long as whoever is asked then, with the number, wants to.
    Connection::Verdict decide(const std::function<bool(Index most)>& go_on = {});
    const Connection& found() const { return result; }
    const std::shared_ptr<Surroundings> around;

private:
    void look(int k, Index most);
    void join(const std::shared_ptr<const CellComplex>& common);
    std::array<Surroundings::Search, 2> ends;
    Connection result;
};

}  // namespace cfree
