// Boxes reached from boxes after a step of travel; theory, "Vehicles", "Forward only". Everything is rounded outward: shut
// boxes by too little, those that follow by too much.
#include "cfree/vehicles/boxes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

using std::numbers::pi;
constexpr double relative_slack = 0x1p-30;  // of all lengths: far more than doubles are off
constexpr int most_steps = 0xffff;

// The part of a convex polygon with n . z <= p.
Convex clipped(const Convex& of, double nx, double ny, double p) {
    Convex part;
    for (std::size_t k = 0; k < of.size(); ++k) {
        const auto &a = of[k], &b = of[(k + 1) % of.size()];
        const double u = nx * a[0] + ny * a[1] - p, v = nx * b[0] + ny * b[1] - p;
        if (u <= 0) part.push_back(a);
        if ((u < 0 && v > 0) || (u > 0 && v < 0)) {
            const double t = u / (u - v);
            part.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
        }
    }
    return part;
}

// The points of two convex polygons, one plus the other.
Convex sum_of(const Convex& a, const Convex& b) {
    const auto lowest = [](const Convex& of) {
        return static_cast<std::size_t>(
            std::min_element(of.begin(), of.end(), [](const auto& p, const auto& q) { return p[1] < q[1] || (p[1] == q[1] && p[0] < q[0]); }) -
            of.begin());
    };
    Convex sum;
    std::size_t i = lowest(a), j = lowest(b), m = 0, n = 0;
    while (m < a.size() || n < b.size()) {
        const auto &p = a[i % a.size()], &q = b[j % b.size()], &r = a[(i + 1) % a.size()], &s = b[(j + 1) % b.size()];
        sum.push_back({p[0] + q[0], p[1] + q[1]});
        const double turn = (r[0] - p[0]) * (s[1] - q[1]) - (r[1] - p[1]) * (s[0] - q[0]);
        const bool first = n == b.size() || (m < a.size() && turn >= 0), second = m == a.size() || (n < b.size() && turn <= 0);
        if (first) ++i, ++m;
        if (second) ++j, ++n;
    }
    return sum;
}

}  // namespace

Boxes::Boxes(const ForwardCar& car, const BoxGrid& of, const Place& from, const Place& to)
    : grid(of), left(car.left), right(car.right), start(from), goal(to), half(pi / of.slices),
      words(static_cast<std::size_t>((of.columns + 63) / 64)) {
    double size = grid.step + grid.side * std::max(grid.columns, grid.rows) + std::abs(grid.x) + std::abs(grid.y);
    for (const auto& shapes : {car.robot, car.obstacles})
        for (const Convex& shape : shapes)
            for (const auto& p : shape) size = std::max(size, std::abs(p[0]) + std::abs(p[1]));
    slack = relative_slack * size;
    const std::size_t count = words * static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.slices);
    shut.assign(count, 0), marked.assign(count, 0), fresh.assign(count, 0), steps.assign(64 * count, 0);
    if (const int rest = grid.columns % 64; rest > 0)
        for (std::size_t k = words - 1; k < count; k += words) shut[k] = ~std::uint64_t{0} << rest;
    shut_all(car);
    set_steps();
    begin();
}

// Boxes in whose poses the robot surely overlaps something, or its reference point is beyond its bounds.
void Boxes::shut_all(const ForwardCar& car) {
    double far = 1;
    for (const Convex& part : car.robot)
        for (const auto& p : part) far = std::max(far, std::abs(p[0]) + std::abs(p[1]));
    for (int k = 0; k < grid.slices; ++k) {
        heed_stop();
        const CosineSine ends[2] = {cosine_sine(2 * half * k), cosine_sine(2 * half * (k + 1))};
        const double widen = cosine(half);
        for (const Convex& part : car.robot) {
            // what the robot's part covers at every pose of a box, about the middle of the box
            Convex core{{-far, -far}, {far, -far}, {far, far}, {-far, far}};
            for (std::size_t m = 0; m < part.size() && !core.empty(); ++m) {
                const auto &a = part[m], &b = part[(m + 1) % part.size()];
                const double nx = b[1] - a[1], ny = a[0] - b[0], p = nx * a[0] + ny * a[1], least = p > 0 ? p * widen : p;
                for (const auto& [c, s] : ends) {
                    const double ux = c * nx - s * ny, uy = s * nx + c * ny, size = std::abs(ux) + std::abs(uy);
                    core = clipped(core, ux, uy, least - 0.5 * grid.side * size - slack * size);
                }
            }
            if (core.size() < 3) continue;
            for (auto& p : core) p = {-p[0], -p[1]};
            for (const Convex& obstacle : car.obstacles) shut_between(k, sum_of(obstacle, core));
        }
        if (!car.bounds) continue;
        double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL;
        for (const auto& [c, s] : ends) {
            const double x = c * car.rx - s * car.ry, y = s * car.rx + c * car.ry;
            x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
        }
        const double more = 0.5 * grid.side + slack, out = 1 / widen;
        x0 *= x0 < 0 ? out : 1, y0 *= y0 < 0 ? out : 1, x1 *= x1 > 0 ? out : 1, y1 *= y1 > 0 ? out : 1;
        for (int j = 0; j < grid.rows; ++j) {
            const double y = grid.y + (j + 0.5) * grid.side;
            const bool beyond = y + y1 + more < car.bounds->y0 || y + y0 - more > car.bounds->y1;
            for (int i = 0; i < grid.columns; ++i) {
                const double x = grid.x + (i + 0.5) * grid.side;
                if (beyond || x + x1 + more < car.bounds->x0 || x + x0 - more > car.bounds->x1)
                    shut[index(k, j, i / 64)] |= std::uint64_t{1} << (i % 64);
            }
        }
    }
}

// Shuts the boxes with their middle inside a convex polygon.
void Boxes::shut_between(int slice, const Convex& sum) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const auto& p : sum) low = std::min(low, p[1]), high = std::max(high, p[1]);
    const auto row_above = [&](double y) { return static_cast<int>(std::ceil(std::clamp((y - grid.y) / grid.side - 0.5, -1.0, grid.rows + 1.0))); };
    const int first = std::max(0, row_above(low + slack)), last = std::min(grid.rows, row_above(high - slack));  // one beyond
    if (first >= last) return;
    std::vector<double> from(static_cast<std::size_t>(last - first), -HUGE_VAL), to(from.size(), HUGE_VAL);
    for (std::size_t m = 0; m < sum.size(); ++m) {
        const auto &a = sum[m], &b = sum[(m + 1) % sum.size()];
        const double below = std::min(a[1], b[1]), above = std::max(a[1], b[1]), height = b[1] - a[1];
        if (!(above - below > slack)) continue;  // the neighbours bound these rows
        const int end = std::min(last, row_above(above + slack));
        for (int j = std::max(first, row_above(below - slack)); j < end; ++j) {
            const double y = std::clamp(grid.y + (j + 0.5) * grid.side, below, above), x = a[0] + (y - a[1]) / height * (b[0] - a[0]);
            const auto at = static_cast<std::size_t>(j - first);
            if (height > 0) to[at] = std::min(to[at], x);
            else from[at] = std::max(from[at], x);
        }
    }
    const auto column_above = [&](double x) {
        return static_cast<int>(std::ceil(std::clamp((x - grid.x) / grid.side - 0.5, -1.0, grid.columns + 1.0)));
    };
    for (int j = first; j < last; ++j) {
        const auto at = static_cast<std::size_t>(j - first);
        if (!(from[at] > -HUGE_VAL) || !(to[at] < HUGE_VAL)) continue;
        const int begin = std::max(0, column_above(from[at] + slack)), end = std::min(grid.columns, column_above(to[at] - slack));
        for (int i = begin; i < end;) {
            const int stop = std::min(end, (i / 64 + 1) * 64), count = stop - i;
            const std::uint64_t ones = count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
            shut[index(slice, j, i / 64)] |= ones << (i % 64), i = stop;
        }
    }
}

// Boxes that meet a rectangle, moved along each pose of the box at the origin: of directions (c, s), between `least` and
// `most` along them, and `aside` across.
std::vector<Boxes::Run> Boxes::runs(double c, double s, double least, double most, double aside) const {
    const double d = grid.side, wide = d * (std::abs(c) + std::abs(s)), more = slack;
    std::vector<Run> found;
    const int reach = static_cast<int>(std::ceil((most + aside) / d)) + 2;
    const auto range = [&](double u, double v) {  // of u along + v across
        return std::array{std::min(u * least, u * most) - std::abs(v) * aside, std::max(u * least, u * most) + std::abs(v) * aside};
    };
    const auto x = range(c, -s), y = range(s, c);
    for (int j = -reach; j <= reach; ++j) {
        const double y_at = j * d;
        if (y_at < y[0] - d - more || y_at > y[1] + d + more) continue;
        Run run{j, reach + 1, -reach - 1};
        for (int i = -reach; i <= reach; ++i) {
            const double x_at = i * d, along = c * x_at + s * y_at, across = c * y_at - s * x_at;
            if (x_at < x[0] - d - more || x_at > x[1] + d + more) continue;
            if (along < least - wide - more || along > most + wide + more || std::abs(across) > aside + wide + more) continue;
            run.first = std::min(run.first, i), run.last = std::max(run.last, i);
        }
        if (run.first <= run.last) found.push_back(run);
    }
    return found;
}

namespace {

// Where a piece of travel ends, in the frame that is turned by half of its turn: between `least` and `most` ahead, and
// `aside` to either side.
struct Ends {
    double least, most, aside;
};

// For turns from `from` to `to`, within what the radii allow, and directions of the frame off by up to `off`.
Ends ends_of(double step, double left, double right, double from, double to, double off) {
    const double ahead = 1 / left, back = 1 / right, bend = 0.5 * step * std::max(ahead, back);
    const double best = std::clamp(0.5 * step * (ahead - back), from, to);
    const double area = 0.5 * (best + back * step) * (ahead * step - best) / (ahead + back);
    const double aside = std::max(0.0, area) + step * bend * bend * bend / 6;
    const double short_of = 0.5 * bend * bend + 0.5 * off * off;
    return {step * (1 - short_of) - aside * off, step + aside * off, aside + step * off};
}

}  // namespace

void Boxes::set_steps() {
    const double slice = 2 * half, most_left = grid.step / left, most_right = grid.step / right;
    turns = static_cast<int>(std::ceil(std::max(most_left, most_right) / slice)) + 1;
    following.resize(static_cast<std::size_t>(grid.slices));
    for (int k = 0; k < grid.slices; ++k) {
        auto& by_turn = following[static_cast<std::size_t>(k)];
        for (int q = -turns; q <= turns; ++q) {
            by_turn.emplace_back();
            const double from = std::max((q - 1) * slice - relative_slack, -most_right), to = std::min((q + 1) * slice + relative_slack, most_left);
            if (from > to) continue;
            const auto [c, s] = cosine_sine((2 * k + 1 + q) * half);
            const Ends ends = ends_of(grid.step, left, right, from, to, half);
            by_turn.back() = runs(c, s, ends.least, ends.most, ends.aside);
            for (const Run& run : by_turn.back()) rim = std::max({rim, std::abs(run.row), std::abs(run.first), std::abs(run.last)});
        }
    }
}

// The boxes of all poses within a step from the start.
void Boxes::begin() {
    const double slice = 2 * half, d = grid.side, most_left = grid.step / left, most_right = grid.step / right;
    const int first = static_cast<int>(std::floor((start.theta - most_right) / slice - relative_slack));
    const int last = static_cast<int>(std::floor((start.theta + most_left) / slice + relative_slack));
    for (int q = first; q <= last; ++q) {
        const double from = std::max(q * slice - start.theta - relative_slack, -most_right);
        const double to = std::min((q + 1) * slice - start.theta + relative_slack, most_left);
        if (from > to) continue;
        const auto [c, s] = cosine_sine(0.5 * start.theta + (q + 0.5) * half);
        const Ends ends = ends_of(grid.step, left, right, from, to, 0.5 * half);
        const double least = -ends.aside, wide = 0.5 * d * (std::abs(c) + std::abs(s));
        const int reach = static_cast<int>((ends.most + ends.aside) / d) + 3, k = ((q % grid.slices) + grid.slices) % grid.slices;
        const int i0 = static_cast<int>(std::floor((start.x - grid.x) / d)), j0 = static_cast<int>(std::floor((start.y - grid.y) / d));
        for (int j = std::max(0, j0 - reach); j <= std::min(grid.rows - 1, j0 + reach); ++j)
            for (int i = std::max(0, i0 - reach); i <= std::min(grid.columns - 1, i0 + reach); ++i) {
                const double x = grid.x + (i + 0.5) * d - start.x, y = grid.y + (j + 0.5) * d - start.y;
                const double along = c * x + s * y, across = std::abs(c * y - s * x);
                if (along < least - wide - slack || along > ends.most + wide + slack || across > ends.aside + wide + slack) continue;
                mark(k, j, i / 64, std::uint64_t{1} << (i % 64), 0);
            }
    }
}

void Boxes::mark(int slice, int row, int word, std::uint64_t bits, int its_steps) {
    const std::size_t at = index(slice, row, word);
    std::uint64_t added = bits & ~shut[at] & ~marked[at];
    if (!added) return;
    marked[at] |= added;
    if (!fresh[at]) todo.push_back(at);
    fresh[at] |= added;
    const bool rim_row = row < rim || row >= grid.rows - rim;
    for (; added; added &= added - 1) {
        const int bit = std::countr_zero(added), column = 64 * word + bit;
        steps[64 * at + static_cast<std::size_t>(bit)] = static_cast<std::uint16_t>(std::min(its_steps, most_steps));
        if (rim_row || column < rim || column >= grid.columns - rim) is_outside = true;
    }
}

// Whatever leaves the grid may come back at any of these boxes.
void Boxes::mark_rim(int its_steps) {
    for (int k = 0; k < grid.slices; ++k)
        for (int j = 0; j < grid.rows; ++j)
            for (int i = 0; i < grid.columns; ++i) {
                if (i == rim && j >= rim && j < grid.rows - rim) i = std::max(i, grid.columns - rim);
                if (i < grid.columns) mark(k, j, i / 64, std::uint64_t{1} << (i % 64), its_steps);
            }
}

bool Boxes::run(long long most) {
    const long long until = work + most;
    const auto per_slice = static_cast<std::size_t>(grid.rows) * words;
    while (!todo.empty()) {
        if (is_outside && !is_rim_marked) mark_rim(steps[64 * todo.front()]), is_rim_marked = true;
        if (++work % 256 == 0) heed_stop();
        if (work > until) return false;
        const std::size_t at = todo.front();
        todo.pop_front();
        const std::uint64_t bits = fresh[at];
        fresh[at] = 0;
        const int k = static_cast<int>(at / per_slice), row = static_cast<int>(at % per_slice / words), word = static_cast<int>(at % words);
        const int next = 1 + steps[64 * at + static_cast<std::size_t>(std::countr_zero(bits))];
        const auto& by_turn = following[static_cast<std::size_t>(k)];
        for (int q = -turns; q <= turns; ++q) {
            const int slice = ((k + q) % grid.slices + grid.slices) % grid.slices;
            for (const Run& run : by_turn[static_cast<std::size_t>(q + turns)]) {
                const int j = row + run.row;
                if (j < 0 || j >= grid.rows) continue;
                // the bits moved by all columns of the run, as words from the first that they reach
                for (int i = run.first; i <= run.last; ++i) {
                    const int whole = i >= 0 ? i / 64 : -((63 - i) / 64), by = i - 64 * whole, w = word + whole;
                    if (w >= 0 && w < static_cast<int>(words)) mark(slice, j, w, bits << by, next);
                    if (by > 0 && w + 1 >= 0 && w + 1 < static_cast<int>(words)) mark(slice, j, w + 1, bits >> (64 - by), next);
                }
            }
        }
    }
    return true;
}

bool Boxes::meets_goal() const {
    const double slice = 2 * half;
    const auto near = [&](double at, double unit, double off) {
        return std::array{static_cast<int>(std::floor((at - off) / unit)), static_cast<int>(std::floor((at + off) / unit))};
    };
    // beyond the grid it is reached if anything leaves that
    const double x1 = grid.x + grid.side * grid.columns, y1 = grid.y + grid.side * grid.rows;
    const bool is_within = goal.x - slack > grid.x && goal.x + slack < x1 && goal.y - slack > grid.y && goal.y + slack < y1;
    if (!is_within && is_outside) return true;
    const auto columns = near(goal.x - grid.x, grid.side, slack), rows = near(goal.y - grid.y, grid.side, slack), slices = near(goal.theta, slice, relative_slack);
    for (int k = slices[0]; k <= slices[1]; ++k)
        for (int j = std::max(0, rows[0]); j <= std::min(grid.rows - 1, rows[1]); ++j)
            for (int i = std::max(0, columns[0]); i <= std::min(grid.columns - 1, columns[1]); ++i)
                if (marked[index((k % grid.slices + grid.slices) % grid.slices, j, i / 64)] >> (i % 64) & 1) return true;
    return false;
}

int Boxes::steps_to(const Place& axle) const {
    const double turn = in_a_turn(axle.theta);
    const int i = static_cast<int>(std::floor((axle.x - grid.x) / grid.side)), j = static_cast<int>(std::floor((axle.y - grid.y) / grid.side));
    const int k = static_cast<int>(turn / (2 * half)) % grid.slices;
    if (i < 0 || j < 0 || i >= grid.columns || j >= grid.rows) return -1;
    const std::size_t at = index(k, j, i / 64);
    return marked[at] >> (i % 64) & 1 ? steps[64 * at + static_cast<std::size_t>(i % 64)] : -1;
}

long long Boxes::number_of(const Place& axle) const {
    const auto i = static_cast<long long>(std::floor((axle.x - grid.x) / grid.side)), j = static_cast<long long>(std::floor((axle.y - grid.y) / grid.side));
    return (static_cast<long long>(in_a_turn(axle.theta) / (2 * half)) * grid.rows + j) * grid.columns + i;
}

long long Boxes::count() const {
    long long sum = 0;
    for (const std::uint64_t word : marked) sum += std::popcount(word);
    return sum;
}

std::vector<std::uint8_t> Boxes::bits() const {
    const std::size_t count = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.slices);
    std::vector<std::uint8_t> result((count + 7) / 8, 0);
    std::size_t bit = 0;
    for (int k = 0; k < grid.slices; ++k)
        for (int j = 0; j < grid.rows; ++j)
            for (int i = 0; i < grid.columns; ++i, ++bit)
                if (marked[index(k, j, i / 64)] >> (i % 64) & 1) result[bit / 8] = static_cast<std::uint8_t>(result[bit / 8] | 1u << (bit % 8));
    return result;
}

}  // namespace cfree
