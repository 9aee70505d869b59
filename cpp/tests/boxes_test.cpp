// Boxes of a car without reverse gear: what it drives stays in them, and a goal that it cannot get to is in none.
#include "cfree/vehicles/boxes.hpp"

#include <cmath>
#include <numbers>

#include "cfree/search/random.hpp"
#include "check.hpp"

using namespace cfree;

static Convex rectangle(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

// A car 2 long and 1 wide, with its axle a quarter from behind, in a room 12 long and 4 wide.
static ForwardCar car_in_a_room(bool is_closed) {
    ForwardCar car;
    car.robot = {rectangle(-0.5, -0.5, 1.5, 0.5)};
    if (is_closed) car.obstacles = {rectangle(-9, -9, 0, 13), rectangle(12, -9, 21, 13), rectangle(-9, -9, 21, 0), rectangle(-9, 4, 21, 13)};
    car.left = 3, car.right = 4;
    return car;
}

static bool is_free(const Place& q) {
    const double c = std::cos(q.theta), s = std::sin(q.theta);
    for (const auto& p : rectangle(-0.5, -0.5, 1.5, 0.5)) {
        const double x = q.x + c * p[0] - s * p[1], y = q.y + s * p[0] + c * p[1];
        if (x < 0 || x > 12 || y < 0 || y > 4) return false;
    }
    return true;
}

int main() {
    Random random(1);
    const BoxGrid grid{-2, -2, 0.125, 0.75, 128, 64, 96};
    for (const bool is_closed : {true, false}) {
        const ForwardCar car = car_in_a_room(is_closed);
        const Place start{3, 2, 0}, ahead{8, 2, 0}, turned{3, 2, std::numbers::pi}, behind{1, 2, 0};
        Boxes reached(car, grid, start, ahead), round(car, grid, start, turned), back(car, grid, start, behind);
        CHECK(!reached.run(1));
        for (Boxes* boxes : {&reached, &round, &back}) CHECK(boxes->run(1'000'000'000));
        CHECK(reached.meets_goal());
        CHECK(round.meets_goal() != is_closed && back.meets_goal() != is_closed);
        CHECK(reached.count() == round.count() && reached.count() > 0);
        long long ones = 0;
        for (const std::uint8_t byte : reached.bits())
            for (int bit = 0; bit < 8; ++bit) ones += byte >> bit & 1;
        CHECK(ones == reached.count());
        // random controls: after each step, and at any time from the first step on, counted from where it began
        int stayed = 0;
        for (int run = 0; run < 300; ++run) {
            Place q = start;
            double until = random() * grid.step, curvature = 0;
            for (bool on = true; on;) {
                const int parts = 20;
                for (int k = 0; k < parts && on; ++k) {
                    if (random() < 0.2) curvature = -0.25 + random() * (1.0 / 3 + 0.25);
                    const double travel = until / parts, middle = q.theta + 0.5 * curvature * travel;
                    q = {q.x + travel * std::cos(middle), q.y + travel * std::sin(middle), q.theta + curvature * travel};
                    on = is_closed ? is_free(q) : q.x > -1 && q.x < 13 && q.y > -1 && q.y < 5;
                }
                if (!on) break;
                until = grid.step, ++stayed;
                CHECK(reached.steps_to(q) >= 0);
            }
        }
        CHECK(stayed > 300);
    }
    return failures > 0;
}
