// Words by cost: those in doubles that seem free are made exact, and proved free; theory, "Vehicles".
#include "cfree/vehicles/driver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

constexpr double nearby = 0x1p-20;      // relative to coordinates: nearer poses are compared exactly
constexpr double same_cost = 1e-9;    // relative
constexpr double same_curvature = 2e-4;  // in reciprocals of the radius: a hundredth of a degree of the wheels
constexpr double short_share = 0.25, cost_of_short = 0.5;  // of the robot's length; of a cusp
constexpr int zigzags = 8;
constexpr double widest_zigzag = 1.4;  // radians

int gear_of(const Piece& p) { return p.travel > 0 ? 1 : p.travel < 0 ? -1 : 0; }

// Place after a piece of a word in doubles; length in radii.
Place after(const Place& q, int kind, double length, double radius) {
    const auto [c, s] = cosine_sine(q.theta);
    if (kind == 0) return {q.x + radius * length * c, q.y + radius * length * s, q.theta};
    const double theta = wrapped(q.theta + kind * length);
    const auto [d, t] = cosine_sine(theta);
    const double r = kind * radius;
    return {q.x + r * (t - s), q.y - r * (d - c), theta};
}

// The motion of the robot along a piece of a word, from the axle's poses: shorter numbers than from the robot's.
Motion motion_of(const Configuration& a, const Configuration& b, const Configuration& robot) {
    Motion axle = motion_between(a, b);
    Motion m;
    m.c = robot.hx * robot.hx - robot.hy * robot.hy, m.s = 2 * robot.hx * robot.hy, m.w = robot.hx * robot.hx + robot.hy * robot.hy;
    m.turns = axle.turns, m.start = axle.start, m.q = axle.q, m.p = axle.p;
    // robot.unit is a multiple of a.unit, and the axle's unit of this, too
    const Int more = robot.unit / a.unit, again = axle.unit / a.unit;
    m.unit = axle.unit * more;
    m.x = robot.x * again, m.y = robot.y * again;
    m.vx = axle.vx * more, m.vy = axle.vy * more;
    return m;
}

}  // namespace

Driver::Driver(Vehicle v, Way w, MotionGuess guess, const Dues& d, double s)
    : vehicle(std::move(v)), way(std::move(w)), dues(d), size(s), seems(std::move(guess)) {}

Configuration Driver::rounded(const Place& axle, int bits) const {
    Grid grid = way.grid;
    grid.place_bits += bits;
    Configuration q = grid.exact(axle.x, axle.y, 0);
    const Half h = simplest_half(wrapped(axle.theta), std::ldexp(1.0, -24 - bits));
    q.hx = h.x, q.hy = h.y, q.theta = angle_of(h);
    return q;
}

double Driver::mark_of(const Configuration& axle, double from, double to) const {
    if (way.ridge.mark.empty()) return from;
    return std::clamp(way.ridge.mark[way.nearest(vehicle.robot_of(axle.place()), from, to)], from, to);
}

double Driver::short_run(double length) const { return length < short_share * size ? cost_of_short * dues.cusp : 0; }

double Driver::cost_of(const Word& word) const {
    double sum = 0, run = 0;
    int gear = 0, changes = 0;
    for (int k = 0; k < word.count; ++k) {
        const double l = word.length[static_cast<std::size_t>(k)], length = std::abs(l) * radius();
        if (std::abs(l) < 1e-10) continue;
        sum += l < 0 ? length * dues.backward : length;
        const int its = l > 0 ? 1 : -1;
        if (gear == -its) {
            sum += dues.cusp + (changes > 0 ? short_run(run) : 0);
            ++changes, run = 0;
        } else if (gear == its) {
            sum += dues.stop;
        }
        gear = its, run += length;
    }
    return sum;
}

void Driver::set_costs(Leg& leg) const {
    leg.cost = 0, leg.first = leg.last = {}, leg.changes = false;
    Run begin;
    for (const Piece& p : leg.word.pieces) {
        const int gear = gear_of(p);
        if (gear == 0) {
            leg.cost += std::abs(p.turn) * dues.in_place + dues.stop;
            continue;
        }
        const double length = std::abs(p.travel), curvature = p.turn / p.travel;
        leg.cost += gear > 0 ? length : length * dues.backward;
        if (leg.last.gear == -gear) {
            leg.cost += dues.cusp + (leg.changes ? short_run(leg.last.length) : 0);
            if (!leg.changes) leg.first = leg.last;
            leg.changes = true, leg.last = {};
        } else if (leg.last.gear == gear) {
            leg.cost += steering(leg.last.curvature, curvature);
        }
        if (begin.gear == 0) begin = {gear, 0, curvature};
        leg.last = {gear, leg.last.length + length, curvature};
    }
    if (!leg.changes) leg.first = leg.last;
    leg.first.curvature = begin.curvature;
}

double Driver::steering(double from, double to) const {
    return vehicle.turns_in_place || std::abs(to - from) * vehicle.radius < same_curvature ? 0 : dues.stop;
}

double Driver::total(std::span<const Leg> legs, Run run, const Run& beyond) const {
    double sum = 0;
    for (const Leg& leg : legs) {
        sum += leg.cost;
        if (leg.first.gear == 0) continue;
        if (run.gear == -leg.first.gear) sum += dues.cusp + short_run(run.length), run = {};
        else if (run.gear != 0) sum += steering(run.curvature, leg.first.curvature);
        run = {leg.first.gear, run.length + leg.first.length, leg.last.curvature};
        if (leg.changes) sum += short_run(run.length), run = leg.last;
    }
    if (run.gear == 0) return sum;
    if (run.gear == -beyond.gear) return sum + dues.cusp + short_run(run.length) + short_run(beyond.length);
    return sum + short_run(run.length + beyond.length) + (beyond.gear != 0 ? steering(run.curvature, beyond.curvature) : 0);
}

bool Driver::seems_free(const Place& from, const Word& word) const {
    std::array<Place, 16> places;
    std::size_t count = 0;
    Place q = from;
    places[count++] = vehicle.robot_of(q);
    for (int k = 0; k < word.count; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const int kind = word.kind[at], parts = kind == 0 ? 1 : static_cast<int>(std::abs(word.length[at]) / most_turn_of_piece) + 1;
        for (int m = 0; m < parts; ++m) {
            q = after(q, kind, word.length[at] / parts, radius());
            places[count++] = vehicle.robot_of(q);
        }
    }
    for (std::size_t k = 1; k < count; ++k)
        if (!seems(places[k - 1], places[k])) return false;
    return true;
}

bool Driver::seems_free(const ExactWord& word) const {
    Place last = vehicle.robot_of(word.joints.front().place());
    for (std::size_t k = 1; k < word.joints.size(); ++k) {
        const Place next = vehicle.robot_of(word.joints[k].place());
        if (!seems(last, next)) return false;
        last = next;
    }
    return true;
}

bool Driver::proved(const ExactWord& word, double from, double to) const {
    heed_stop();
    Route robot;
    for (const Configuration& q : word.joints) robot.push_back(vehicle.robot_of(q));
    const bool asks = way.nearness && !way.ridge.route.empty();
    if (asks && !way.joins(way.marked(robot, from, to))) return false;
    if (asks) return true;
    for (std::size_t k = 1; k < robot.size(); ++k)
        if (!way.checker.is_free(motion_of(word.joints[k - 1], word.joints[k], robot[k - 1]))) return false;
    return true;
}

std::optional<Leg> Driver::leg(ExactWord word, double from, double to) const {
    if (!proved(word, from, to)) return {};
    Leg found{std::move(word), from, to, 0, {}, {}, false};
    set_costs(found);
    return found;
}

void Driver::car_words(const Configuration& a, const Configuration& b) {
    const double r = radius(), dx = b.px - a.px, dy = b.py - a.py, size_of = std::abs(a.px) + std::abs(a.py);
    Place local;
    if (std::abs(dx) + std::abs(dy) > nearby * size_of && std::abs(wrapped(b.theta - a.theta)) > nearby) {
        const auto [c, s] = cosine_sine(a.theta);
        local = {c * dx + s * dy, c * dy - s * dx, wrapped(b.theta - a.theta)};
    } else {
        local = seen_from(a, b);
        local.x = std::ldexp(local.x, -way.grid.shift), local.y = std::ldexp(local.y, -way.grid.shift);
    }
    words.clear();
    if (vehicle.reverses) reeds_shepp_words(local.x / r, local.y / r, local.theta, words);
    else dubins_words(local.x / r, local.y / r, local.theta, words);
    for (const Word& word : words) candidates.push_back({cost_of(word), word, {}});
    if (auto two = biarc(vehicle, way.grid.shift, a, b)) {
        Leg trial{std::move(*two), 0, 0, 0, {}, {}, false};
        set_costs(trial);
        candidates.push_back({trial.cost, {}, std::move(trial.word)});
    }
}

void Driver::drive_words(const Configuration& a, const Configuration& b, bool at_any_scale) {
    const int shift = way.grid.shift;
    const auto put = [&](std::optional<ExactWord> word) {
        if (!word) return;
        Leg trial{std::move(*word), 0, 0, 0, {}, {}, false};
        set_costs(trial);
        candidates.push_back({trial.cost, {}, std::move(trial.word)});
    };
    put(turn_drive_turn(vehicle, shift, a, b, false));
    put(turn_drive_turn(vehicle, shift, a, b, true));
    put(arc_and_turn(vehicle, shift, a, b, false));
    put(arc_and_turn(vehicle, shift, a, b, true));
    if (!at_any_scale) return;
    const Place local = seen_from(a, b);
    const double middle = 0.5 * local.theta, across = std::abs(local.y * cosine(middle) - local.x * sine(middle));
    if (!(std::abs(local.x) + std::abs(local.y) > 0)) return;
    const double best = std::min(widest_zigzag, std::max(1e-12, std::sqrt(std::ldexp(across, -shift) / (2 * size))));
    for (int k = 0; k < zigzags; ++k) put(zigzag(vehicle, shift, a, b, std::min(widest_zigzag, std::ldexp(best, k - 2))));
}

std::optional<Leg> Driver::made(const Configuration& a, const Configuration& b, double from, double to, const Word& word) {
    auto exact = exact_word(vehicle, way.grid.shift, a, b, word, radius());
    if (!exact) return {};
    return leg(std::move(*exact), from, to);
}

std::optional<Leg> Driver::join(const Configuration& a, const Configuration& b, double from, double to, double most, int tries,
                                bool at_any_scale) {
    candidates.clear();
    if (vehicle.turns_in_place) drive_words(a, b, at_any_scale);
    else car_words(a, b);
    std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& p, const Candidate& q) { return p.cost < q.cost; });
    double last = -1;
    for (Candidate& c : candidates) {
        if (!(c.cost < most) || tries <= 0) break;
        if (!c.exact && c.cost <= last * (1 + same_cost)) continue;  // the same word by another formula
        if (!c.exact) last = c.cost;
        --tries, ++looked;
        if (!(c.exact ? seems_free(*c.exact) : seems_free(a.place(), c.word))) continue;
        auto found = c.exact ? leg(std::move(*c.exact), from, to) : made(a, b, from, to, c.word);
        if (found && found->cost < most) return found;
    }
    if (!at_any_scale || vehicle.turns_in_place) return {};
    ++looked;
    auto word = steer(vehicle, way.grid.shift, a, b);
    if (!word || !seems_free(*word)) return {};
    auto found = leg(std::move(*word), from, to);
    return found && found->cost < most ? std::move(found) : std::nullopt;
}

}  // namespace cfree
