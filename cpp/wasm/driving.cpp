// A path of the robot that keeps its distance is followed by words, which are then shortened; all motions are proved free.
#include "driving.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

constexpr long long words = 20'000, few_words = 3000;  // tried along one path, and along one that begins or ends in contact
constexpr double shares[] = {0.5, 0.25, 0.125, 0};  // of the path's distance that is kept
constexpr double most_kept = 0.05, stop = 0.25, back = 1.5;  // of the robot's length, as a cusp costs; factor of going back
constexpr double sideways = 10, turning = 3;     // costs of a path that is easily driven
constexpr int few_cusps = 1, block = 50, idle = 400;
constexpr int checks = 50, most_poses = 300, dear = 3;  // of balanced paths
constexpr std::uint64_t seeds = 2;                      // random numbers for each path that is followed
constexpr int searches = 3, search_poses = 8000;        // without reverse gear

bool is_free(const World& world, const Poses& way) {
    for (std::size_t k = 1; k < way.size(); ++k)
        if (!world.checker->is_free(motion_between(way[k - 1].configuration(*world.scene), way[k].configuration(*world.scene)))) return false;
    return true;
}

std::vector<End> ends_of(const Poses& way) {
    std::vector<End> ends;
    for (const auto& pose : way) ends.push_back({pose, pose.place()});
    return ends;
}

// The longer side of the box around the robot along the vehicle's forward direction.
double length_of(const World& world, const GivenVehicle& vehicle) {
    const auto [c, s] = cosine_sine(vehicle.heading.theta());
    double u0 = HUGE_VAL, u1 = -HUGE_VAL, v0 = HUGE_VAL, v1 = -HUGE_VAL;
    for (const auto& part : world.shapes.robot)
        for (Index k = 0; k < part->vertices.size(); ++k) {
            const double x = nearest(part->vertices.X(k), part->denominator), y = nearest(part->vertices.Y(k), part->denominator);
            const double u = c * x + s * y, v = c * y - s * x;
            u0 = std::min(u0, u), u1 = std::max(u1, u), v0 = std::min(v0, v), v1 = std::max(v1, v);
        }
    return std::max(u1 - u0, v1 - v0);
}

struct Wheels {
    const World& world;
    const GivenVehicle& vehicle;
    const double length;

    // Costs of a path of the robot that is easily driven.
    Costs easy() const {
        const Place axle{nearest(vehicle.x.n, vehicle.x.d), nearest(vehicle.y.n, vehicle.y.d), std::remainder(vehicle.heading.theta(), 2 * std::numbers::pi)};
        return {world.radius, sideways, 1, turning, axle};
    }
    std::shared_ptr<Driving> along(const Poses& way, double share) const {
        const DrivingWishes wishes{back, length, stop * length, world.radius, length, world.radius, share, most_kept * length};
        return std::make_shared<Driving>(world.known, vehicle, ends_of(way), wishes);
    }
    // True if the robot keeps a distance all along, and its reference point is within the bounds.
    bool has_room(const Poses& way) const {
        const auto& bounds = world.shapes.bounds;
        const auto is_within = [&](const RationalPose& pose) {
            return !bounds || ((*bounds)[0] < pose.x && (*bounds)[1] < pose.y && pose.x < (*bounds)[2] && pose.y < (*bounds)[3]);
        };
        return std::all_of(way.begin(), way.end(), is_within) && along(way, 0)->distance() > 0;
    }
};

struct Drive {
    std::shared_ptr<Driving> by;
    Shortening path;
};

void shorten(Drive& drive, int attempts) {
    for (; attempts > 0 && drive.path.without_gain() <= idle; attempts -= block) drive.path.run(std::min(block, attempts));
}

// Words along the path that keep the greatest share of its distance, to be shortened with several random numbers; or none, with
// the share of the path that is reached, and the poses there.
std::vector<Drive> followed(const Wheels& wheels, const Poses& guide, long long most, std::pair<double, std::size_t>& reached) {
    for (const double share : shares) {
        const auto by = wheels.along(guide, share);
        Followed found = by->follow(most);
        if (found.is_whole) {
            std::vector<Drive> drives;
            for (std::uint64_t seed = 0; seed < seeds; ++seed) drives.push_back({by, by->shortening(found.legs, seed)});
            return drives;
        }
        reached = std::max(reached, std::pair{found.share, by->poses(found.legs).size()});
    }
    return {};
}

}  // namespace

Poses balanced(const World& world, const Poses& way, const Costs& costs) {
    const std::vector<End> ends = ends_of(way);
    std::vector<Place> places;
    for (const End& end : ends) places.push_back(end.place);
    const Searcher searcher(world.known, places, costs);
    Shortcut better = searcher.balanced(ends);
    better.run((costs.prefer() ? dear : 1) * checks * static_cast<int>(better.path().size() + std::min<std::size_t>(most_poses, way.size())));
    better.merge();
    Poses found = searcher.poses(better.path());
    return found.front() == way.front() && found.back() == way.back() && is_free(world, found) ? found : way;
}

DrivenWay driven(const World& world, const GivenVehicle& vehicle, const Poses& way, int attempts) {
    using enum DrivenWay::Verdict;
    const Wheels wheels{world, vehicle, length_of(world, vehicle)};
    if (way.front() == way.back()) return {path, {way.front()}};
    const bool begins = !wheels.has_room({way.front()}), ends = !wheels.has_room({way.back()}), touches = begins || ends;
    const Poses roomy = balanced(world, way, {world.radius});
    if (!touches && !wheels.has_room(roomy)) return {!world.rounds && world.known->barrier(way.front(), way.back(), {}) ? contacts : narrow};
    std::vector<Drive> drives;
    std::pair<double, std::size_t> reached{};
    for (const bool is_easy : {false, true}) {
        const Poses guide = is_easy ? balanced(world, roomy, wheels.easy()) : roomy;
        for (Drive& drive : followed(wheels, guide, touches ? few_words : words, reached)) drives.push_back(std::move(drive));
        if (!drives.empty() && drives.front().path.cusps() <= few_cusps) break;
    }
    if (!vehicle.reverses)
        for (std::uint64_t seed = 0; drives.empty() && seed < searches; ++seed) {
            const auto by = wheels.along(roomy, 0);
            if (auto legs = by->search_forward(seed, search_poses)) drives.push_back({by, by->shortening(std::move(*legs), seed)});
        }
    if (drives.empty() && touches) return {begins ? start_touches : goal_touches};
    if (drives.empty()) {
        const auto& [share, poses] = reached;
        return vehicle.reverses ? DrivenWay{manoeuvres, {}, share > 0 ? std::ceil(static_cast<double>(poses) / share) : 0} : DrivenWay{forward};
    }
    for (Drive& drive : drives) drive.path.join_far(), shorten(drive, attempts / 2);
    Drive& best = *std::min_element(drives.begin(), drives.end(), [](const Drive& a, const Drive& b) { return a.path.cost() / a.by->unit < b.path.cost() / b.by->unit; });
    shorten(best, attempts / 2);
    return {path, best.by->poses(best.path.legs())};
}

// A line or an arc leads along the mean of the headings at its ends, forward or backward.
std::vector<Index> gears_of(const World& world, const GivenVehicle& given, const Poses& way) {
    const Vehicle vehicle = vehicle_of(given, *world.scene);
    const auto axle_at = [&](std::size_t k) { return vehicle.axle_of(way[k].configuration(*world.scene)); };
    const auto refuse = [](std::size_t k, const char* why) {
        throw std::invalid_argument("motion " + std::to_string(k) + " of the path " + why);
    };
    std::vector<Index> gears;
    for (std::size_t k = 0; k + 1 < way.size(); ++k) {
        const Configuration a = axle_at(k), b = axle_at(k + 1);
        Half turn = conjugate(half_of(a)) * half_of(b), mean = half_of(a) * half_of(b);
        if (turn.x.is_zero()) refuse(k, "turns by half a turn at once");
        if (turn.x < 0) turn = {-turn.x, -turn.y}, mean = {-mean.x, -mean.y};
        const Int dx = b.x * a.unit - a.x * b.unit, dy = b.y * a.unit - a.y * b.unit, unit = a.unit * b.unit;
        if (dx.is_zero() && dy.is_zero()) {
            if (!vehicle.turns_in_place && !turn.y.is_zero()) refuse(k, "turns in place");
            gears.push_back(0);
            continue;
        }
        if (mean.x * dy != mean.y * dx) refuse(k, "moves the axle point sideways");
        const Int ahead = mean.x * dx + mean.y * dy;
        if (!vehicle.reverses && ahead < 0) refuse(k, "goes backward");
        // the chord is 2 r sin(turn / 2)
        const Ratio& least = (ahead < 0) == (turn.y < 0) ? vehicle.left : vehicle.right;
        const Int chord = least.d * least.d * (dx * dx + dy * dy) * (turn.x * turn.x + turn.y * turn.y);
        if (const Int limit = least.n * turn.y * unit; chord < 4 * limit * limit) refuse(k, "turns too narrowly");
        gears.push_back(ahead < 0 ? -1 : 1);
    }
    return gears;
}

}  // namespace cfree
