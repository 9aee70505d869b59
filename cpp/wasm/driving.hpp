// The way of a vehicle beside a path of the robot, as src/cfree/planning/vehicles.py finds it.
#pragma once
#include "cfree/planning/driving.hpp"
#include "world.hpp"

namespace cfree {

struct DrivenWay {
    // Why there is no way here: an end touches something, and no few words lead from it; the robot gets there along contacts
    // only, or through passages too narrow for doubles; too many manoeuvres; none was found without reverse gear.
    enum class Verdict { path, start_touches, goal_touches, contacts, narrow, manoeuvres, forward };
    Verdict verdict;
    Poses way = {};
    double manoeuvres = 0;  // needed, about
};

// The ways are shortened by so many attempts each.
DrivenWay driven(const World& world, const GivenVehicle& vehicle, const Poses& way, int attempts);

// The path beside this one that keeps its distance, if it is free.
Poses balanced(const World& world, const Poses& way, const Costs& costs);

// Gear of each motion: 1 forward, -1 backward, 0 in place. Throws std::invalid_argument where the vehicle cannot do a motion.
std::vector<Index> gears_of(const World& world, const GivenVehicle& vehicle, const Poses& way);

}  // namespace cfree
