// Verdicts of poses by grids, then in doubles with a bound, then in integers; theory, "Poses, exactly".
#include "cfree/collision/pose_checker.hpp"

#include <cmath>
#include <limits>
#include <numeric>

#include "cfree/exact/radians.hpp"
#include "cfree/exact/ratio.hpp"
#include "cfree/support/elementary.hpp"
#include "collision/placed_robot.hpp"
#include "collision/pose_grid.hpp"
#include "support/parallel.hpp"

namespace cfree {

namespace {
constexpr std::size_t chunk = 1024;
constexpr double farthest = 0x1p+997;  // larger distances count as this

double rounded(const Ratio& x) {
    const bool is_large = !x.n.is_zero() && msb(abs(x.n)) > msb(x.d) + 1000;
    return is_large ? std::copysign(farthest, x.n.sign()) : std::clamp(nearest(x.n, x.d), -farthest, farthest);
}
}  // namespace

void PoseChecker::check(const double* poses, std::size_t count, int threads, Verdict* out) const {
    Grid& g = near(count);
    std::atomic<bool> stop = false;
    std::atomic<std::size_t> next = 0;
    const auto chunks = static_cast<int>(std::min<std::size_t>((count + chunk - 1) / chunk, 1 << 20));
    in_parallel(std::min(threads, chunks), stop, [&] {  // no thread for less than a chunk
        Placed placed(robot);
        std::vector<std::size_t> slots(chunk), open(chunk);
        for (std::size_t begin; (begin = next.fetch_add(chunk)) < count && !stop;) {
            heed_stop();
            const std::size_t end = std::min(count, begin + chunk);
            for (std::size_t k = begin; k < end; ++k) {
                const double* q = poses + 3 * k;
                const bool is_inside = is_within(q[0], q[1]);
                out[k] = is_inside ? Verdict::free : Verdict::forbidden;
                const std::size_t slot = is_inside ? g.slot(q[0], q[1], q[2]) : outside;
                slots[k - begin] = slot;
                if (slot != outside) __builtin_prefetch(&g.known[slot]);
            }
            std::size_t count_open = 0;  // counts without unpredictable branches
            for (std::size_t k = begin; k < end; ++k) {
                const std::size_t slot = slots[k - begin];
                const State state = slot == outside ? State::free : g.known[slot].load(std::memory_order_relaxed);
                out[k] = state == State::forbidden ? Verdict::forbidden : out[k];
                open[count_open] = k;
                if (slot != outside) __builtin_prefetch(&g.start[slot / sectors]);
                count_open += state != State::forbidden && state != State::free;
            }
            for (std::size_t n = 0; n < count_open; ++n)
                out[open[n]] = verdict(g, slots[open[n] - begin], poses + 3 * open[n], placed);
        }
    });
}

PoseChecker::Looks::Looks(std::shared_ptr<const PoseChecker> of) : checker(std::move(of)), placed(std::make_unique<Placed>(checker->robot)) {}
PoseChecker::Looks::~Looks() = default;

bool PoseChecker::Looks::is_forbidden(double x, double y, double theta) {
    if (!checker->is_within(x, y)) return true;
    if (left-- == 0) grid = &checker->near(chunk), left = chunk - 1;
    const std::size_t slot = grid->slot(x, y, theta);
    if (slot == outside) return false;
    const State state = grid->known[slot].load(std::memory_order_relaxed);
    if (state == State::forbidden || state == State::free) return state == State::forbidden;
    const double pose[3] = {x, y, theta};
    return checker->verdict(*grid, slot, pose, *placed) == Verdict::forbidden;
}

// Halve the sweep until all poses of a part, which are around its middle, have one verdict. The slack covers the rounding of
// the middle, and of distances if the robot is farther away than `margin` allows for.
bool PoseChecker::sweep_is_free(const std::array<double, 3>& from, const std::array<double, 3>& by) const {
    constexpr double rounding = 0x1p-44;
    constexpr int deepest = 20;
    if (!is_within(from[0], from[1]) || !is_within(from[0] + by[0], from[1] + by[1])) return false;
    const double length = norm(by[0], by[1]) * (1 + rounding), angle = std::abs(by[2]) * (1 + rounding);
    const double slack = rounding * (std::abs(from[0]) + std::abs(from[1]) + length), turned = rounding * (std::abs(from[2]) + angle);
    std::vector<Index> all(static_cast<std::size_t>(obstacles.count()));
    std::iota(all.begin(), all.end(), 0);
    Placed placed(robot);
    std::vector<std::pair<double, int>> parts{{0.5, 1}};  // middle, and how often halved
    while (!parts.empty()) {
        const auto [u, depth] = parts.back();
        parts.pop_back();
        const double half = std::ldexp(1, -depth), theta = from[2] + u * by[2];
        placed.place({from[0] + u * by[0], from[1] + u * by[1], cosine(theta), sine(theta)});
        const Verdict all_of_it = against(placed, all.data(), all.size(), {half * length + slack, half * angle + turned},
                                          [](Index, Index) { return Verdict::uncertain; });
        if (all_of_it == Verdict::free) continue;
        if (all_of_it == Verdict::forbidden || depth == deepest) return false;
        parts.emplace_back(u - half / 2, depth + 1);
        parts.emplace_back(u + half / 2, depth + 1);
    }
    return true;
}

// Decide by known poses around, else by this one in doubles, else exactly: `exact` makes the pose only then.
template <class Exact>
bool PoseChecker::decide(double x, double y, double theta, Exact&& exact) const {
    Grid& g = near(1);
    const std::size_t slot = g.slot(x, y, theta);
    if (slot == outside) return true;
    const State state = g.known[slot].load(std::memory_order_relaxed);
    if (state == State::forbidden || state == State::free) return state == State::free;
    Placed placed(robot);
    const double pose[3] = {x, y, theta};
    if (const Verdict v = verdict(g, slot, pose, placed); v != Verdict::uncertain) return v == Verdict::free;
    const ExactPlacement at = exact();  // the robot is still placed there
    const std::size_t cell = slot / sectors;
    const auto count = static_cast<std::size_t>(g.start[cell + 1] - g.start[cell]);
    return against(placed, &g.member[g.start[cell]], count, {}, [&](Index i, Index j) {
        return overlap(at, i, j) ? Verdict::forbidden : Verdict::free;
    }) == Verdict::free;
}

ExactPlacement GivenPose::exact() const {
    const Int unit = common_multiple(x.d, y.d);
    return {q * q - p * p, 2 * p * q, q * q + p * p, x.n * (unit / x.d), y.n * (unit / y.d), unit};
}

// A limit is rounded inwards: what is rounded to a number beyond the next double is beyond it, what is rounded to one further
// in is within.
std::optional<bool> PoseChecker::is_free(const GivenPose& pose, bool is_known_within) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double x = rounded(pose.x), y = rounded(pose.y);
    if (!is_known_within) {
        const auto [x0, y0, x1, y1] = limits;
        const auto is_less = [](double a, double b) { return a < std::nextafter(b, -infinity); };
        if (is_less(x, x0) || is_less(y, y0) || is_less(x1, x) || is_less(y1, y)) return false;
        if (!(x0 < x && y0 < y && x < x1 && y < y1)) return {};
    }
    return decide(x, y, pose.theta, [&] { return pose.exact(); });
}

std::optional<bool> PoseChecker::is_free(double x, double y, double theta) const {
    if (!is_within(x, y)) return false;
    const auto is_in_a_turn = [](double angle) { return 0 <= angle && angle < two_pi; };
    double angle = is_in_a_turn(theta) ? theta : in_a_turn(theta);
    if (!is_in_a_turn(angle)) {  // it is next to 0, or large
        const auto read = read_radians(theta);
        if (!read) return {};
        angle = read->theta;
    }
    return decide(x, y, angle, [&] {
        const auto read = *read_radians(theta);
        return GivenPose{ratio_of(x), ratio_of(y), read.q, read.p, angle}.exact();
    });
}

}  // namespace cfree
