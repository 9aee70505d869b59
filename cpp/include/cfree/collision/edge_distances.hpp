// Distances of the robot's edges from those of obstacles and workspace, at poses and along motions, in doubles; theory, "Paths".
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "cfree/exact/number.hpp"

namespace cfree {

class BoxTree;

// A pose as it is measured: cosine and sine are those of the orientation itself, theta is rounded.
struct MeasuredPose {
    double x, y, theta, c, s;
};

// Motion of the robot from one pose to another: straight; about a pole, the ends (x, y) apart, by an angle; or along a slide,
// (x, y) / d in the tangent of half the angle turned, where no vertex travels farther than `reach`.
struct Straight {};
struct Turning {
    double x, y, pole_x, pole_y, angle;
};
struct Sliding {
    std::array<double, 5> x, y, d;
    double angle, reach;
};
struct MeasuredMotion {
    MeasuredPose from, to;
    std::variant<Straight, Turning, Sliding> kind;
};

// The least distance of a path, or a lower bound of it; and where the least was found: motion, share of it, the two edges.
struct LeastDistance {
    double least, found;
    int motion;
    double share;
    Index edge, other;
};

class EdgeDistances {
public:
    struct Segment {
        double x0, y0, x1, y1;
    };
    // The robot's edges at rest, and the others.
    EdgeDistances(std::vector<Segment> robot, std::vector<Segment> others);
    ~EdgeDistances();
    EdgeDistances(const EdgeDistances&) = delete;
    EdgeDistances& operator=(const EdgeDistances&) = delete;

    bool is_alone() const { return others.empty(); }
    double radius() const { return reach * unit; }  // the robot's, about its reference point
    // Along free motions. The bound is at most the tolerance below the truth, if that does not take too many parts.
    LeastDistance least(const std::vector<MeasuredMotion>& motions, double tolerance) const;

private:
    struct Nearest {
        double distance;
        Index line, other;
    };
    Nearest nearest(const std::vector<Segment>& lines, double within) const;
    std::vector<Segment> placed(double x, double y, double c, double s) const;
    std::vector<Segment> at(const MeasuredMotion& motion, double share) const;
    double travel(const MeasuredMotion& motion) const;
    struct Found {
        double distance;
        int motion;
        double share;
        Index edge, other;
    };
    double swept(const std::vector<MeasuredMotion>& motions, Found& best) const;

    double unit;  // a power of two near the size of all: lengths here are in it, so that squares are doubles
    std::vector<Segment> robot, others;
    double reach = 0, size = 0;  // the robot's reach; the largest coordinate of the others
    std::unique_ptr<BoxTree> tree;
};

}  // namespace cfree
