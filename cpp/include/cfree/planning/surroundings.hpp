// Closed surface around a pose, without the rest of the boundary: a ray towards -x meets a surface, which is grown until it is
// closed. If met from inside, it is the outer boundary of the pose's cell. If met from outside, it is an island: the ray is in
// the cell again after leaving it for the last time, and goes on. Theory, "One surface alone".
#pragma once
#include <functional>

#include "cfree/free/surface_explorer.hpp"
#include "cfree/planning/rational_pose.hpp"

namespace cfree {

// Part of a path on one surface, from one pose of contact to another.
struct Stretch {
    std::shared_ptr<const CellComplex> surface;
    ExactPose enter, leave;
};

class Surroundings {
public:
    Surroundings(std::shared_ptr<const Scene> scene, std::shared_ptr<const MotionChecker> checker, bool regularized);

    // Search for the cell of a pose.
    struct Search {
        ExactPose pose;
        bool ended = false;
        bool failed = false;  // ended without answer: the pose is too close to contacts, or touches all around
        Index surface = -1;   // ended: the outer boundary of its cell; -1 if there is none
        ExactPose from, at;   // near the pose, start of the ray; and the pose from which it goes on
        std::vector<Stretch> passed;  // islands on the ray, from first to last meeting
        ExactPose contact;    // its last contact
        Index seed = -1;      // seed there of a growing surface
    private:
        friend class Surroundings;
        int attempt = 0;
    };
    Search search(const ExactPose& free_pose) const;
    // Continue a search by about `most` trapezoids, of a surface that grows towards the seed of another search, if any. Returns
    // the part that has reached the seed.
    std::shared_ptr<const CellComplex> advance(Search& search, Index most, Index target);

    // Restart from another place near the pose, joined to it by one free motion; false if there is none left.
    bool start_again(Search& search) const;

    // True if a surface is around the start of a search's ray; nothing if the start is on it.
    std::optional<bool> is_around(Index surface, const Search& search) const;
    const std::shared_ptr<const CellComplex>& surface(Index k) const { return surfaces[k].complex; }

    // Take what the surroundings of another scene have computed and what holds in this one.
    void take(const Surroundings& other);

    // Begin another question.
    void begin() { explorer.begin(); }

    std::size_t trimmed_patches() const { return explorer.trimmed_patches(); }
    std::size_t met_patches() const { return explorer.met_patches(); }
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

    const bool has_slits;
    SurfaceExplorer explorer;
    std::vector<Known> surfaces;
    void keep(std::shared_ptr<const CellComplex> closed);
    Int size, radius, left;  // size of the robot, its radius about the reference point, smallest x of obstacles
};

// Verdict on two free poses: in one cell, with a path from one to the other, or apart.
struct Connection {
    enum class Verdict { open, unclear, apart, joined };  // open: undecided so far
    Verdict verdict = Verdict::open;
    std::shared_ptr<const CellComplex> surface;  // apart: around exactly one of them
    int inside = 0;                              // apart: the pose inside
    // Joined: the path goes to the first of two poses near these, straight to stretches one after another, and so to the goal.
    // After the first `before` of them it may be far away to the left.
    RationalPose start, goal;
    ExactPose near_start, near_goal;
    std::vector<Stretch> stretches;
    bool is_far = false;
    std::size_t before = 0;
};

// Decides the connection from both poses at once.
class Connecting {
public:
    static constexpr Index first_step = 64, last_step = 1 << 29;  // trapezoids around each of the two poses
    Connecting(std::shared_ptr<Surroundings> around, const RationalPose& start, const RationalPose& goal);
    // Take how much of its cell each pose is known to reach. The surface of the smaller cell is closed sooner, so it grows faster.
    void compare_cells(const std::array<std::size_t, 2>& reached);
    // Continue by about `most` trapezoids around each; if these are many, by fewer around a pose in a larger cell.
    void run(Index most);
    // Continue to the end, by twice as many each time, as long as `go_on`, called with the number, returns true.
    Connection::Verdict decide(const std::function<bool(Index most)>& go_on = {});
    const Connection& found() const { return result; }
    const std::shared_ptr<Surroundings> around;

private:
    void look(int k, Index most);
    void join(const std::shared_ptr<const CellComplex>& common);
    std::array<Surroundings::Search, 2> ends;
    std::array<double, 2> slower{1, 1};  // factors of the growth around each
    Connection result;
};

}  // namespace cfree
