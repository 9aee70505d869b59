// Shorter paths, by random shortcuts that keep the requirements of the way.
#pragma once
#include "cfree/search/random.hpp"
#include "cfree/search/way.hpp"

namespace cfree {

class Shortcut {
public:
    Shortcut(Way way, Marked path, std::uint64_t seed);
    // Check about so many motions.
    void run(int checks);
    // Turn less if the way has a center; then replace neighbours by one motion, or two, from start to goal.
    void merge();
    void turn_less();
    const Route& path() const { return route; }
    double length() const { return at.back(); }

private:
    void attempt();
    void straighten();
    void steer();
    bool replace(std::size_t i, std::size_t last, Route fresh);

    const Way way;
    Route route;
    std::vector<double> mark, at;  // one per pose; costs up to each pose
    Random random;
    int left = 0;
};

}  // namespace cfree
