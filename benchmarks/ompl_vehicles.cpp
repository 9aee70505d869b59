// OMPL's RRTConnect for a car, its states tested by cfree's own exact check of poses: no calls from Python.
//
// Input, a word and its numbers a line:
//   robot, robot-hole, obstacle, hole, workspace x y x y ...    rings in exact numbers; a hole is in the polygon before it,
//                                  and rings of the workspace after the first are holes
//   bounds x0 y0 x1 y1             exact limits of the reference point
//   car radius ax ay heading       the axle in the robot's frame, in doubles
//   space x0 y0 x1 y1 fraction     limits of the axle point, and the step of tests as a share of the space's extent
//   start and goal x y heading     poses of the axle
//   forward                        Dubins instead of Reeds and Shepp, RRT instead of RRTConnect
//   first seed seconds             one run until the first path
//   best seed seconds              runs with seeds from this one, each simplified, until the time is over
//
// Output for each of the last two: processor seconds until the first path, -1 for none; states tested; paths; those of them
// that clip, looked at again by steps a hundred times finer; length and cusps of the cheapest that does not, -1 for none.
//
// Each run begins with polygons: convex pieces and tables are made within its time.

#include <cfree/collision/pose_checker.hpp>
#include <cfree/scene/features.hpp>

#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>

#include <cmath>
#include <ctime>
#include <iostream>
#include <limits>
#include <numbers>
#include <sstream>

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Row = std::array<double, 3>;

static constexpr double finer = 100;

struct Question {
    std::vector<std::vector<cfree::RatioRing>> robot, obstacles;
    std::vector<cfree::RatioRing> workspace;
    std::vector<cfree::Ratio> bounds;
    std::array<double, 4> car{};
    std::array<double, 5> space{};
    Row start{}, goal{};
    bool forward = false;
};

static cfree::RatioRing ring(std::istream& line)
{
    cfree::RatioRing points;
    for (std::string x, y; line >> x >> y;) points.push_back({cfree::ratio_of(x).value(), cfree::ratio_of(y).value()});
    return points;
}

static std::shared_ptr<const cfree::PoseChecker> checker_of(const Question& q)
{
    cfree::SceneShapes shapes;
    for (const auto& rings : q.robot) shapes.robot.push_back(std::make_shared<const cfree::Polygon>(rings));
    for (const auto& rings : q.obstacles) shapes.obstacles.push_back(std::make_shared<const cfree::Polygon>(rings));
    if (!q.workspace.empty()) shapes.workspace = std::make_shared<const cfree::Polygon>(q.workspace);
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 4> limits{-far, -far, far, far};
    if (q.bounds.size() == 4) {
        shapes.bounds = {q.bounds[0], q.bounds[1], q.bounds[2], q.bounds[3]};
        for (std::size_t k = 0; k < 4; ++k) limits[k] = cfree::ratio(q.bounds[k].n, q.bounds[k].d);
    }
    return std::make_shared<const cfree::PoseChecker>(cfree::scene_features(shapes).scene, limits);
}

static double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

static Row row_of(const ob::State* state)
{
    const auto* pose = state->as<ob::SE2StateSpace::StateType>();
    return {pose->getX(), pose->getY(), pose->getYaw()};
}

// Changes of gear on a path of Reeds and Shepp.
static int cusps(const ob::ReedsSheppStateSpace* space, og::PathGeometric& path)
{
    int found = 0;
    double last = 0;
    if (!space) return 0;
    for (std::size_t k = 0; k + 1 < path.getStateCount(); ++k)
        for (const double length : space->reedsShepp(path.getState(k), path.getState(k + 1)).length_) {
            if (std::abs(length) < 1e-9) continue;
            found += last * length < 0;
            last = length;
        }
    return found;
}

class Rival {
public:
    explicit Rival(const Question& question) : q(question)
    {
        if (q.forward) space = std::make_shared<ob::DubinsStateSpace>(q.car[0]);
        else space = std::make_shared<ob::ReedsSheppStateSpace>(q.car[0]);
        ob::RealVectorBounds limits(2);
        for (unsigned k = 0; k < 2; ++k) limits.setLow(k, q.space[k]), limits.setHigh(k, q.space[k + 2]);
        space->as<ob::SE2StateSpace>()->setBounds(limits);
        space->setLongestValidSegmentFraction(q.space[4]);
    }

    void first(unsigned seed, double most)
    {
        begun();
        auto setup = solved(seed, most);
        if (setup->haveExactSolutionPath()) {
            first_found = seconds() - begin;
            take(setup->getSolutionPath());
        }
        report();
    }

    void best(unsigned seed, double most)
    {
        begun();
        for (double left = most; left > 0.01; left = most - (seconds() - begin)) {
            auto setup = solved(seed++, left);
            if (!setup->haveExactSolutionPath()) continue;
            if (paths == 0) first_found = seconds() - begin;
            if (left = most - (seconds() - begin); left > 0) setup->simplifySolution(left);
            const double looking = seconds();
            take(setup->getSolutionPath());
            begin += seconds() - looking;  // not the rival's work
        }
        report();
    }

private:
    const ob::ReedsSheppStateSpace* reversing() const { return dynamic_cast<const ob::ReedsSheppStateSpace*>(space.get()); }

    void begun()
    {
        looked = 0, paths = 0, clipped = 0, least_length = -1, least_cusps = -1, first_found = -1;
        least = std::numeric_limits<double>::infinity();
        begin = seconds();
        checker = checker_of(q);
    }

    bool is_free(const ob::State* state) const
    {
        const auto [x, y, yaw] = row_of(state);
        const double c = std::cos(q.car[3]), s = std::sin(q.car[3]), ax = q.car[1], ay = q.car[2];
        const double rx = -(c * ax + s * ay), ry = s * ax - c * ay;  // the reference point, seen from the axle
        const double u = std::cos(yaw), v = std::sin(yaw);
        return checker->is_free(x + u * rx - v * ry, y + v * rx + u * ry, yaw - q.car[3]).value_or(false);
    }

    std::shared_ptr<og::SimpleSetup> solved(unsigned seed, double most)
    {
        ompl::RNG::setSeed(seed);
        auto setup = std::make_shared<og::SimpleSetup>(space);
        setup->setStateValidityChecker([this](const ob::State* state) {
            ++looked;
            return space->satisfiesBounds(state) && is_free(state);
        });
        ob::ScopedState<ob::SE2StateSpace> start(space), goal(space);
        start->setXY(q.start[0], q.start[1]), start->setYaw(q.start[2]);
        goal->setXY(q.goal[0], q.goal[1]), goal->setYaw(q.goal[2]);
        setup->setStartAndGoalStates(start, goal);
        if (q.forward) setup->setPlanner(std::make_shared<og::RRT>(setup->getSpaceInformation()));
        else setup->setPlanner(std::make_shared<og::RRTConnect>(setup->getSpaceInformation()));
        const double until = seconds() + most;
        setup->setup();
        setup->solve(ob::plannerOrTerminationCondition(
            ob::PlannerTerminationCondition([until] { return seconds() > until; }),
            ob::exactSolnPlannerTerminationCondition(setup->getProblemDefinition())));
        return setup;
    }

    void take(og::PathGeometric& path)
    {
        ++paths;
        og::PathGeometric dense(path);
        const double step = q.space[4] * space->getMaximumExtent() / finer;
        dense.interpolate(static_cast<unsigned>(std::min(1e6, path.length() / step)) + 2);
        bool clips = false;
        for (std::size_t k = 0; k < dense.getStateCount() && !clips; ++k) clips = !is_free(dense.getState(k));
        clipped += clips;
        const int its = cusps(reversing(), path);
        if (const double cost = path.length() + q.car[0] * its; !clips && cost < least)
            least = cost, least_length = path.length(), least_cusps = its;
    }

    void report() const
    {
        std::cout << first_found << ' ' << looked << ' ' << paths << ' ' << clipped << ' ' << least_length << ' ' << least_cusps
                  << std::endl;
    }

    const Question& q;
    std::shared_ptr<const cfree::PoseChecker> checker;
    ob::StateSpacePtr space;
    long long looked = 0;
    int paths = 0, clipped = 0, least_cusps = -1;
    double begin = 0, first_found = -1, least = 0, least_length = -1;
};

int main()
{
    std::cout.precision(17);
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
    Question q;
    std::unique_ptr<Rival> rival;
    for (std::string text; std::getline(std::cin, text);) {
        std::istringstream line(text);
        std::string word;
        line >> word;
        const auto read = [&](auto& values) {
            for (double& value : values) line >> value;
        };
        if (word == "robot") q.robot.push_back({ring(line)});
        if (word == "robot-hole") q.robot.back().push_back(ring(line));
        if (word == "obstacle") q.obstacles.push_back({ring(line)});
        if (word == "hole") q.obstacles.back().push_back(ring(line));
        if (word == "workspace") q.workspace.push_back(ring(line));
        if (word == "bounds")
            for (const auto& [x, y] : ring(line)) q.bounds.push_back(x), q.bounds.push_back(y);
        if (word == "car") read(q.car);
        if (word == "space") read(q.space);
        if (word == "start") read(q.start);
        if (word == "goal") read(q.goal);
        if (word == "forward") q.forward = true;
        if (word == "first" || word == "best") {
            if (!rival) rival = std::make_unique<Rival>(q);
            unsigned seed;
            double most;
            line >> seed >> most;
            if (word == "first") rival->first(seed, most);
            else rival->best(seed, most);
        }
    }
}
