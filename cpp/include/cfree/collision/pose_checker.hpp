// Test that poses are free: convex pieces of the robot against those of near obstacles, by separating axes.
//
// A pose is forbidden if the interiors of two pieces meet. Interiors of convex polygons meet unless an edge of one has all
// of the other on its outer side, or on its line. Doubles give the distance d of an edge's line from the other piece, with
// |error| < margin for every d computed here (separating_axes.cpp): d >= margin separates, d <= -margin for all edges is an
// overlap. Exact integers decide all other cases.
#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

#include "cfree/exact/ratio.hpp"
#include "cfree/scene/scene.hpp"

namespace cfree {

enum class Verdict : std::uint8_t { forbidden, free, uncertain };

// A pose in doubles: x and y correctly rounded, cosine and sine within 2^-48 of those of the pose meant.
struct Placement {
    double x, y, c, s;
};

// The exact pose: cosine c / w, sine s / w, position (x, y) / unit; w, unit > 0.
struct ExactPlacement {
    Int c, s, w, x, y, unit;
};

// A pose with rational numbers: its half-angle tangent is p / q, half a turn 1 / 0; theta is rounded, in [0, 2 pi).
struct GivenPose {
    Ratio x, y;
    Int q, p;
    double theta;
    ExactPlacement exact() const;
};

class PoseChecker {
public:
    // The reference point stays in limits: x0, y0, x1, y1.
    PoseChecker(std::shared_ptr<const Scene> scene, std::array<double, 4> limits);

    // Verdicts of poses x, y and theta in [0, 2 pi], radians.
    void check(const double* poses, std::size_t count, int threads, Verdict* out) const;
    // One pose, exactly. Nothing where it is so near to a limit that doubles do not tell, unless it is known to be within.
    std::optional<bool> is_free(const GivenPose& pose, bool is_known_within) const;
    // Exactly the pose that Python's `Pose` makes of three finite doubles. Nothing for an angle that `read_radians` leaves
    // out.
    std::optional<bool> is_free(double x, double y, double theta) const;

    // True if all poses from + u (by), u in [0, 1], are certainly free: x, y and theta, in radians, change evenly. False may
    // mean that they come too close to decide.
    bool sweep_is_free(const std::array<double, 3>& from, const std::array<double, 3>& by) const;

    // Tests of one pose after another, by one thread.
    class Looks;

private:
    // Convex pieces, edge k from vertex k, with its outward unit normal n and n . vertex.
    struct Pieces {
        std::vector<Index> number, first;  // number in the shape; first of its vertices, and the end
        std::vector<double> x, y, nx, ny, h;
        std::vector<std::array<Index, 16>> far;  // each piece's vertices that reach far in sixteen directions
        Index count() const { return static_cast<Index>(number.size()); }
    };
    struct Ranges {  // ranges of a piece's coordinates
        double x0, y0, x1, y1;
    };
    static Pieces pieces_of(const Shape& shape);
    double distance(const Pieces& p, Index piece, double x, double y) const;
    struct Placed;
    // Poses around one: moved by at most `shift`, turned by at most `turn`. Verdicts hold for all of them.
    struct Range {
        double shift = 0, turn = 0;
    };
    Verdict meet(Placed& robot, Index i, Index j, const Range& range) const;
    template <class F>
    Verdict against(Placed& robot, const Index* near, std::size_t count, const Range& range, F&& decide) const;
    bool overlap(const ExactPlacement& at, Index i, Index j) const;
    bool is_within(double x, double y) const { return limits[0] <= x && x <= limits[2] && limits[1] <= y && y <= limits[3]; }
    template <class Exact>
    bool decide(double x, double y, double theta, Exact&& exact) const;

    // Obstacle pieces within the robot's reach from a cell of a grid. By cell and sector of angles, the verdict for all poses
    // there; two threads may compute it, with the same result.
    enum class State : std::uint8_t { unseen, once, twice, forbidden, free, mixed };  // once, twice: looked at, undecided
    struct Grid {
        double x0 = 0, y0 = 0, side = 0, per_unit = 0, radius = 0;  // radius: a little more than that of a cell
        Index nx = 0, ny = 0;
        State enough{};
        std::vector<Index> start, member;
        std::vector<Ranges> around;  // boxes around each robot piece in each sector, the reference point at the origin
        std::vector<std::atomic<State>> known;
        std::size_t slot(double x, double y, double theta) const;
    };
    // Grid for this many further poses: the more poses in all, the finer. Each grid is made when first needed.
    Grid& near(std::size_t poses) const;
    Verdict verdict(Grid& grid, std::size_t slot, const double* pose, Placed& placed) const;
    struct Fineness;
    static const std::array<Fineness, 3> finenesses;
    void fill(Grid& grid, const Fineness& fineness) const;

    std::shared_ptr<const Scene> scene;
    std::array<double, 4> limits;
    Pieces robot, obstacles;
    std::vector<Ranges> box;       // boxes of the obstacles' pieces
    double reach = 0, margin = 0;  // reach of the robot around its reference point, rounded up; margin: see above
    struct Level {
        std::once_flag once;
        Grid grid;
    };
    mutable std::array<Level, 3> levels;
    mutable std::atomic<std::size_t> asked{0};
};

class PoseChecker::Looks {
public:
    explicit Looks(std::shared_ptr<const PoseChecker> of);
    ~Looks();
    // True if a pose is certainly forbidden; theta in [0, 2 pi].
    bool is_forbidden(double x, double y, double theta);
    const std::shared_ptr<const PoseChecker> checker;

private:
    const std::unique_ptr<Placed> placed;
    Grid* grid = nullptr;
    std::size_t left = 0;  // poses until the grid is chosen anew
};

}  // namespace cfree
