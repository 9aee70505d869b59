// Vehicles in a scene: their ways along paths, by rational poses in the user's units.
#pragma once
#include <span>

#include "cfree/planning/searcher.hpp"
#include "cfree/vehicles/driver.hpp"

namespace cfree {

// A vehicle in the user's units.
struct GivenVehicle {
    bool turns_in_place, reverses;
    Ratio left, right, x, y;
    HalfAngle heading;
};
Vehicle vehicle_of(const GivenVehicle& given, const Scene& scene);

// What the driver is to keep and to save; lengths are in the user's units.
struct DrivingWishes {
    double backward = 1, cusp = 0, stop = 0, in_place = 0, size = 1, radius = 1;
    double share = 0, most_distance = 0;  // of the path's distance from obstacles, and the most that is kept
};

// Ways of a vehicle along one path.
class Driving {
public:
    Driving(std::shared_ptr<const KnownScene> scene, const GivenVehicle& vehicle, std::span<const End> path, const DrivingWishes& wishes);

    // The words along the path; at most about so many are tried.
    Followed follow(long long most);
    // The words of a vehicle without reverse gear, if a search with so many poses finds some.
    std::optional<Legs> search_forward(std::uint64_t seed, int poses);
    // The same, within boxes from which the goal may be reached.
    std::optional<Legs> search_in_boxes(const Boxes& boxes, int poses);
    Shortening shortening(Legs legs, std::uint64_t seed) const { return {driver, std::move(legs), seed}; }
    // Robot poses at the joints of all words.
    Poses poses(const Legs& legs) const;
    // A distance that the robot keeps at both ends of the path and at its sampled poses; 0 if it may touch.
    double distance() const { return least; }

    const std::shared_ptr<const KnownScene> scene;
    const double unit;  // from the user's lengths to the doubles of shapes

private:
    Driver driver_of(const GivenVehicle& vehicle, const DrivingWishes& wishes);
    double least = 0;
    Area area{};
    Marked path;
    Driver driver;
};

}  // namespace cfree
