// Boxes of poses that hold everything a car without reverse gear can reach; theory, "Vehicles", "Forward only".
#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "cfree/search/way.hpp"

namespace cfree {

// Convex, counterclockwise.
using Convex = std::vector<std::array<double, 2>>;

// A car in doubles: each number may be off by far less than the slack of the boxes.
struct ForwardCar {
    std::vector<Convex> robot;      // in the axle's frame
    std::vector<Convex> obstacles;  // that the robot must not overlap
    std::optional<Area> bounds;     // of the reference point, which is at (rx, ry) of the axle's frame
    double rx = 0, ry = 0;
    double left = 1, right = 1;     // radii
};

// Boxes with sides `side`, `side` and a turn / `slices`; the first begins at (x, y, 0). Box (i, j, k) holds axle poses.
struct BoxGrid {
    double x = 0, y = 0, side = 1, step = 1;  // the step: length of travel from box to box
    int columns = 0, rows = 0, slices = 0;
};

class Boxes {
public:
    Boxes(const ForwardCar& car, const BoxGrid& grid, const Place& start, const Place& goal);

    // Marks boxes that follow, for so many more words of 64 boxes; true if no more follow.
    bool run(long long most);
    // True if a box of the goal is marked, or the goal is beyond the grid, and something leaves that.
    bool meets_goal() const;
    long long count() const;
    long long worked() const { return work; }
    // Steps after which the box of a pose was marked; -1 if it is not.
    int steps_to(const Place& axle) const;
    // Number of the box of a pose, within the grid or not.
    long long number_of(const Place& axle) const;
    // A bit for each box: the columns of a row from the lowest bit on, then the rows, then the slices.
    std::vector<std::uint8_t> bits() const;
    const BoxGrid grid;

private:
    struct Run {
        int row, first, last;  // of the boxes that follow, relative to their origin
    };
    void shut_all(const ForwardCar& car);
    void shut_between(int slice, const Convex& sum);
    std::vector<Run> runs(double cosine, double sine, double least, double most, double aside) const;
    void set_steps();
    void begin();
    void mark(int slice, int row, int word, std::uint64_t bits, int steps);
    void mark_rim(int steps);
    std::size_t index(int slice, int row, int word) const {
        return (static_cast<std::size_t>(slice) * static_cast<std::size_t>(grid.rows) + static_cast<std::size_t>(row)) * words +
               static_cast<std::size_t>(word);
    }

    double left, right;
    Place start, goal;
    double slack, half;  // half of a slice
    std::size_t words;
    int turns = 0, rim = 1;
    std::vector<std::vector<std::vector<Run>>> following;  // by slice, and by the slices turned
    std::vector<std::uint64_t> shut, marked, fresh;
    std::vector<std::uint16_t> steps;
    std::deque<std::size_t> todo;
    bool is_outside = false, is_rim_marked = false;
    long long work = 0;
};

}  // namespace cfree
