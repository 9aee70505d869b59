// What a word is to keep is sampled along the path; theory, "Vehicles".
#include "cfree/planning/driving.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cfree {

namespace {

constexpr int word_place_bits = 28, word_angle_bits = 24;  // of poses of words; more in narrow places
constexpr double radii_between_samples = 1.0 / 16;             // radii between the poses at which the path's distance is taken
constexpr double almost_asked = 0.95;                  // of the distance asked is proved

Route route_of(const KnownScene& scene, std::span<const End> path, double unit) {
    Route route;
    for (const End& end : path) {
        Configuration q = end.pose.configuration(scene.scene());
        q.px = end.place.x * unit, q.py = end.place.y * unit, q.theta = std::remainder(end.place.theta, 2 * std::numbers::pi);
        route.push_back(std::move(q));
    }
    return route;
}

}  // namespace

Vehicle vehicle_of(const GivenVehicle& given, const Scene& scene) {
    Vehicle v;
    const Ratio scale{scene.scale, 1};
    v.turns_in_place = given.turns_in_place, v.reverses = given.reverses;
    v.left = given.left * scale, v.right = given.right * scale;
    const Ratio x = given.x * scale, y = given.y * scale;
    v.unit = common_multiple(x.d, y.d), v.ax = x.n * (v.unit / x.d), v.ay = y.n * (v.unit / y.d);
    v.hx = given.heading.q, v.hy = given.heading.p;
    const Ratio& radius = v.left < v.right ? v.right : v.left;
    const auto length = [&](const Ratio& r) { return std::ldexp(ratio(r.n, r.d), -scene.shift); };
    v.radius = length(radius), v.shift = scene.shift;
    v.axle = {length(x), length(y), std::remainder(given.heading.theta(), 2 * std::numbers::pi)};
    return v;
}

Driving::Driving(std::shared_ptr<const KnownScene> of, const GivenVehicle& vehicle, std::span<const End> way, const DrivingWishes& wishes)
    : scene(std::move(of)), unit(nearest(scene->scene().scale, power_of_two(scene->scene().shift).n)),
      path{route_of(*scene, way, unit), {}}, driver(driver_of(vehicle, wishes)) {}

Driver Driving::driver_of(const GivenVehicle& vehicle, const DrivingWishes& wishes) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    const SceneShapes& shapes = scene->shapes();
    std::vector<Place> places;
    for (const Configuration& q : path.route) places.push_back({q.px / unit, q.py / unit, q.theta});
    area = search_area(*scene, places, wishes.radius);
    int extent = 0;
    const double extents = std::max(area.x1 - area.x0, area.y1 - area.y0) * unit;
    std::frexp(extents != 0 ? extents : 1, &extent);
    const Grid grid{scene->scene().shift, word_place_bits - extent, word_angle_bits};
    Area limits{-inf, -inf, inf, inf};
    if (shapes.bounds) {
        const auto at = [&](std::size_t k) { return nearest((*shapes.bounds)[k].n, (*shapes.bounds)[k].d); };
        limits = {at(0) * unit, at(1) * unit, at(2) * unit, at(3) * unit};
    }
    const double weight = wishes.radius * unit;
    Way free{*scene->checker, &scene->nearness(), grid, limits, {weight}};
    path.mark = costs_along(path.route, free.costs);
    // the ridge: the path with more poses, and what is asked there
    Marked ridge;
    std::vector<double> distances;
    const double most = wishes.most_distance * unit / almost_asked, share = wishes.share / almost_asked;
    const double enough = share > 0 ? most / share : 0.25 * weight;
    least = inf;
    const auto add = [&](const Configuration& q, double mark) {
        const double distance = scene->nearness().distance(q.place(), enough);
        least = std::min(least, distance <= scene->nearness().least() ? 0 : distance / unit);
        ridge.route.push_back(q), ridge.mark.push_back(mark);
        distances.push_back(std::min(share * distance, most));
    };
    for (std::size_t k = 0; k < path.route.size(); ++k) {
        if (k > 0) {
            const Configuration &a = path.route[k - 1], &b = path.route[k];
            const double length = path.mark[k] - path.mark[k - 1];
            const int count = static_cast<int>(std::min(4096.0, std::ceil(length / (radii_between_samples * weight))));
            for (int m = 1; m < count; ++m) {
                Configuration q = a;
                const Place p = along(a, b, static_cast<double>(m) / count);
                q.px = p.x, q.py = p.y, q.theta = p.theta;
                add(q, path.mark[k - 1] + length * m / count);
            }
        }
        add(path.route[k], path.mark[k]);
    }
    const Dues dues{wishes.backward, wishes.cusp * unit, wishes.stop * unit, wishes.in_place * unit};
    const MotionGuess seems(scene->looks(), weight, unit);
    Way asking = wishes.share > 0 ? free.asking(std::move(ridge), std::move(distances)) : free;
    return {vehicle_of(vehicle, scene->scene()), std::move(asking), seems, dues, wishes.size * unit};
}

std::optional<Legs> Driving::search_forward(std::uint64_t seed, int count) {
    return cfree::search_forward(driver, path, {area.x0 * unit, area.y0 * unit, area.x1 * unit, area.y1 * unit}, seed, count);
}

std::optional<Legs> Driving::search_in_boxes(const Boxes& boxes, int poses) {
    return cfree::search_in_boxes(driver, path, boxes, unit, poses);
}

Followed Driving::follow(long long most) { return cfree::follow(driver, path, most); }

Poses Driving::poses(const Legs& legs) const {
    Poses result;
    const auto add = [&](const Configuration& axle) {
        const Configuration q = driver.vehicle.robot_of(axle);
        const Int whole = q.unit * scene->scene().scale;
        result.push_back({reduced(q.x, whole), reduced(q.y, whole), HalfAngle::along(q.hx, q.hy)});
    };
    for (const Leg& leg : legs) {
        if (result.empty()) add(leg.begin());
        for (std::size_t k = 1; k < leg.word.joints.size(); ++k) add(leg.word.joints[k]);
    }
    return result;
}

}  // namespace cfree
