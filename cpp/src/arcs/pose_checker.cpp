// Poses among segments and arcs: doubles with a margin, cells of poses that are decided together, then integers; theory,
// "Segments and arcs".
#include "cfree/arcs/pose_checker.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "arcs/near_shape.hpp"
#include "arcs/overlap.hpp"
#include "cfree/exact/radians.hpp"
#include "cfree/support/elementary.hpp"
#include "collision/pose_grid.hpp"
#include "support/parallel.hpp"

namespace cfree {

namespace {
constexpr std::size_t chunk = 256;
constexpr std::size_t enough_for_grid = 1 << 14;  // poses: making it takes about as long as these
constexpr double cells_in_reach = 8, most_cells = 1 << 14;
constexpr double far = 1;  // beyond it nothing is near, as all coordinates of shapes are below a sixteenth

std::atomic<std::size_t> checkers = 0;

double rounded(const Ratio& x) {
    const bool is_large = !x.n.is_zero() && msb(abs(x.n)) > msb(x.d) + 1000;
    return is_large ? std::copysign(0x1p1000, x.n.sign()) : nearest(x.n, x.d);
}
}  // namespace

// Parts of the robot in a pose, and the pairs of parts and obstacles that doubles leave open there.
struct ArcPoseChecker::Placed {
    std::size_t checker = 0;  // its number
    std::vector<NearShape> part;
    std::vector<std::pair<std::size_t, std::size_t>> open;
};

ArcPoseChecker::ArcPoseChecker(std::shared_ptr<const ArcScene> s) : scene(std::move(s)), near(std::make_unique<NearScene>(scene)), number(++checkers),
      limits{-HUGE_VAL, -HUGE_VAL, HUGE_VAL, HUGE_VAL} {
    if (!scene->bounds) return;
    for (std::size_t k = 0; k < 4; ++k) {
        const Ratio& bound = (*scene->bounds)[k];
        limits[k] = rounded(bound);  // to the nearest double; from there to the next if it is outside
        if (k < 2 ? ratio_of(limits[k]) < bound : ratio_of(limits[k]) > bound)
            limits[k] = std::nextafter(limits[k], k < 2 ? HUGE_VAL : -HUGE_VAL);
    }
}
ArcPoseChecker::~ArcPoseChecker() = default;

// Boxes of poses: cells of positions times sectors of a turn. A cell has the numbers of the obstacles within the robot's reach;
// or it is forbidden all around. A box is decided when a second pose falls into it; two threads may do so, with one result.
struct ArcPoseChecker::Grid {
    enum class State : std::uint8_t { unseen, once, free, forbidden, mixed };
    double x0, y0, side;
    std::size_t nx, ny;
    std::vector<std::atomic<State>> known;
    std::vector<Index> start, member;
    std::vector<char> is_blocked;

    explicit Grid(const NearScene& scene) {
        Box all;
        for (const NearShape& obstacle : scene.obstacles)
            if (!obstacle.curves.empty()) all.add(cfree::grown(obstacle.around, obstacle.radius));
        if (!(all.x0 <= all.x1)) all.add(0, 0);
        all = cfree::grown(all, scene.reach);
        const double width = all.x1 - all.x0, height = all.y1 - all.y0;
        side = std::max({scene.reach / cells_in_reach, std::sqrt(width * height / most_cells), width / most_cells, height / most_cells});
        x0 = all.x0, y0 = all.y0, nx = static_cast<std::size_t>(width / side) + 1, ny = static_cast<std::size_t>(height / side) + 1;
        known = std::vector<std::atomic<State>>(nx * ny * sectors);
        fill(scene);
    }
    double around() const { return std::sqrt(0.5) * side * (1 + 0x1p-20) + margin; }  // radius of a disc around a cell
    Vec<double> middle(std::size_t cell) const {
        return {x0 + (static_cast<double>(cell % nx) + 0.5) * side, y0 + (static_cast<double>(cell / nx) + 0.5) * side};
    }
    void fill(const NearScene& scene) {
        double core = -HUGE_VAL;  // radius of a disc in the robot around its reference point; of one elsewhere, less its distance from there
        for (const NearShape& part : scene.robot)
            if (part.disc.radius > 0) core = std::max(core, part.disc.radius - norm(part.disc.center.x, part.disc.center.y));
        is_blocked.assign(nx * ny, false);
        std::vector<std::pair<std::size_t, Index>> found;
        const auto index = [&](double offset, std::size_t count) {
            return static_cast<std::size_t>(std::clamp(offset / side, 0.0, static_cast<double>(count - 1)));
        };
        for (std::size_t j = 0; j < scene.obstacles.size(); ++j) {
            const NearShape& o = scene.obstacles[j];
            if (o.curves.empty() && !o.is_outside) continue;
            const Box box = o.is_outside ? Box{x0, y0, x0 + static_cast<double>(nx) * side, y0 + static_cast<double>(ny) * side}
                                         : cfree::grown(o.around, o.radius + scene.reach + around());
            for (std::size_t row = index(box.y0 - y0, ny); row <= index(box.y1 - y0, ny); ++row)
                for (std::size_t column = index(box.x0 - x0, nx); column <= index(box.x1 - x0, nx); ++column) {
                    const std::size_t cell = row * nx + column;
                    const double apart = o.distance(middle(cell)) - o.radius;
                    if (apart + around() + margin < core) is_blocked[cell] = true;
                    if (apart < scene.reach + around() + margin) found.emplace_back(cell, static_cast<Index>(j));
                }
        }
        std::sort(found.begin(), found.end());
        start.assign(nx * ny + 1, 0);
        for (const auto& [cell, j] : found) ++start[cell + 1], member.push_back(j);
        std::partial_sum(start.begin(), start.end(), start.begin());
    }
    std::span<const Index> near(std::size_t cell) const {
        return {member.data() + start[cell], static_cast<std::size_t>(start[cell + 1] - start[cell])};
    }
    // Box of a pose, or `outside`.
    std::size_t slot(double x, double y, double theta) const {
        const double column = (x - x0) / side, row = (y - y0) / side;
        if (!(0 <= column && column < static_cast<double>(nx) && 0 <= row && row < static_cast<double>(ny))) return outside;
        const auto sector = std::min(static_cast<std::size_t>(theta * (sectors / two_pi)), sectors - 1);
        return (static_cast<std::size_t>(row) * nx + static_cast<std::size_t>(column)) * sectors + sector;
    }
};

ArcPoseChecker::Grid* ArcPoseChecker::grid(std::size_t poses) const {
    if (asked.fetch_add(poses, std::memory_order_relaxed) + poses < enough_for_grid) return nullptr;
    std::call_once(made, [&] { boxes = std::make_unique<Grid>(*near); });
    return boxes.get();
}

Verdict ArcPoseChecker::verdict(Placed& placed, double x, double y, double c, double s, double slack, std::optional<Numbers> among) const {
    placed.open.clear();
    if (!(std::abs(x) < far && std::abs(y) < far))
        return std::any_of(near->obstacles.begin(), near->obstacles.end(), [](const NearShape& o) { return o.is_outside; })
                   ? Verdict::forbidden
                   : Verdict::free;
    placed.part.resize(near->robot.size());
    Verdict all = Verdict::free;
    for (std::size_t i = 0; i < near->robot.size(); ++i) {
        const NearShape& still = near->robot[i];
        if (still.curves.empty()) continue;
        const auto move = [&](const Vec<double>& p) { return Vec<double>{x + (c * p.x - s * p.y), y + (s * p.x + c * p.y)}; };
        const Box& box = still.around;
        const Vec<double> middle = move({0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1)});
        const double half = 0.5 * norm(box.x1 - box.x0, box.y1 - box.y0) + still.radius + slack + margin;
        bool is_placed = false;
        const auto look = [&](Index k) {
            if (all == Verdict::forbidden) return;
            const auto j = static_cast<std::size_t>(k);
            const NearShape& obstacle = near->obstacles[j];
            const InnerDisc& disc = obstacle.disc;  // seen from the robot: then its curves need not be placed
            const Vec<double> d{disc.center.x - x, disc.center.y - y};
            Verdict v = by_disc({{c * d.x + s * d.y, c * d.y - s * d.x}, disc.radius, disc.is_all}, still, slack);
            if (v == Verdict::uncertain && !disc.is_all) {
                v = by_disc({move(still.disc.center), still.disc.radius, still.disc.is_all}, obstacle, slack);
                if (v == Verdict::uncertain && !still.disc.is_all) {
                    if (!is_placed) near->place(i, x, y, c, s, placed.part[i]);
                    is_placed = true;
                    v = verdict_by_curves(placed.part[i], obstacle, still.radius + obstacle.radius, slack);
                }
            }
            if (v == Verdict::free) return;
            if (v == Verdict::uncertain) placed.open.emplace_back(i, j);
            all = v;
        };
        const Box reached{middle.x - half, middle.y - half, middle.x + half, middle.y + half};
        if (!among) near->near(reached, margin, look);
        else
            for (const Index k : *among) {
                const NearShape& obstacle = near->obstacles[static_cast<std::size_t>(k)];
                if (obstacle.is_outside || cfree::grown(obstacle.around, obstacle.radius).meets(reached)) look(k);
            }
        if (all == Verdict::forbidden) return all;
    }
    return placed.open.empty() ? all : Verdict::uncertain;
}

bool ArcPoseChecker::decide(const Placed& placed, const ExactPlacement& at) const {
    for (const auto& [i, j] : placed.open) {
        const ArcShape &a = scene->robot[i], &b = scene->obstacles[j];
        const CommonScale scale(a, b);
        const Int dx = at.x * scale.whole * at.w, dy = at.y * scale.whole * at.w, own = at.unit * scale.of_robot;
        const Int unit = at.w * at.unit * scale.of_obstacle;
        const auto place = [&](const Vec<Int>& p) {
            return Vec<Int>{(at.c * p.x - at.s * p.y) * own + dx, (at.s * p.x + at.c * p.y) * own + dy};
        };
        std::vector<RoundEdge> moved, still;
        for (const RoundEdge& k : a.curves) moved.push_back({place(k.start), place(k.end), place(k.center), k.turn});
        for (const RoundEdge& k : b.curves)
            still.push_back({{k.start.x * unit, k.start.y * unit}, {k.end.x * unit, k.end.y * unit}, {k.center.x * unit, k.center.y * unit}, k.turn});
        const int shift = shift_for(moved, still);
        if (overlap({a, std::move(moved), shift}, {b, std::move(still), shift}, (a.radius * scale.of_robot * at.w * at.unit + b.radius * unit))) return false;
    }
    return true;
}

Verdict ArcPoseChecker::decided(Placed& placed, double x, double y, double theta, double slack, std::optional<Numbers> among) const {
    const auto [c, s] = cosine_sine(theta);
    return verdict(placed, x, y, c, s, slack, among);
}

Verdict ArcPoseChecker::boxed(Placed& placed, Grid* cells, double px, double py, double theta) const {
    using State = Grid::State;
    if (!is_within(px, py)) return Verdict::forbidden;
    const double x = px * near->unit, y = py * near->unit;
    const std::size_t slot = cells ? cells->slot(x, y, theta) : outside;
    if (slot == outside) return decided(placed, x, y, theta, 0, {});
    const std::size_t cell = slot / sectors;
    if (cells->is_blocked[cell]) return Verdict::forbidden;
    const Numbers among = cells->near(cell);
    if (among.empty()) return Verdict::free;
    std::atomic<State>& known = cells->known[slot];
    State state = known.load(std::memory_order_relaxed);
    if (state == State::unseen) known.store(State::once, std::memory_order_relaxed);
    if (state == State::once) {
        const Vec<double> place = cells->middle(cell);
        const double middle = (static_cast<double>(slot % sectors) + 0.5) * (two_pi / sectors);
        const double slack = cells->around() + near->reach * (two_pi / sectors / 2) * (1 + 0x1p-20);
        const Verdict all = decided(placed, place.x, place.y, middle, slack, among);
        state = all == Verdict::free ? State::free : all == Verdict::forbidden ? State::forbidden : State::mixed;
        known.store(state, std::memory_order_relaxed);
    }
    return state == State::free ? Verdict::free : state == State::forbidden ? Verdict::forbidden : decided(placed, x, y, theta, 0, among);
}

void ArcPoseChecker::check(const double* poses, std::size_t count, int threads, Verdict* out) const {
    Grid* cells = grid(count);
    std::atomic<bool> stop = false;
    std::atomic<std::size_t> next = 0;
    const auto chunks = static_cast<int>(std::min<std::size_t>((count + chunk - 1) / chunk, 1 << 20));
    in_parallel(std::min(threads, chunks), stop, [&] {
        Placed placed;
        for (std::size_t begin; (begin = next.fetch_add(chunk)) < count && !stop;) {
            heed_stop();
            for (std::size_t k = begin; k < std::min(count, begin + chunk); ++k) {
                const double* q = poses + 3 * k;
                out[k] = boxed(placed, cells, q[0], q[1], q[2]);
            }
        }
    });
}

Verdict ArcPoseChecker::look(double x, double y, double theta) const { return boxed(own(), grid(1), x, y, theta); }

ArcPoseChecker::Placed& ArcPoseChecker::own() const {
    thread_local Placed placed;
    if (placed.checker != number) placed = {number, {}, {}};
    return placed;
}

bool ArcPoseChecker::is_free(const GivenPose& pose) const {
    if (scene->bounds) {
        const auto& [x0, y0, x1, y1] = *scene->bounds;
        if (pose.x < x0 || x1 < pose.x || pose.y < y0 || y1 < pose.y) return false;
    }
    Placed& placed = own();
    const auto [c, s] = cosine_sine(pose.theta);
    const Verdict v = verdict(placed, rounded(pose.x) * near->unit, rounded(pose.y) * near->unit, c, s, 0);
    return v == Verdict::uncertain ? decide(placed, pose.exact()) : v == Verdict::free;
}

std::optional<bool> ArcPoseChecker::is_free(double x, double y, double theta) const {
    const auto read = read_radians(theta);
    if (!read) return {};
    return is_free({ratio_of(x), ratio_of(y), read->q, read->p, read->theta});
}

DistanceBounds ArcPoseChecker::distance(const GivenPose& pose, double most) const {
    const ExactPlacement at = pose.exact();
    const double farthest = std::min(most * near->unit, 4.0);
    Gap least{farthest, farthest};
    const double x = rounded(pose.x) * near->unit, y = rounded(pose.y) * near->unit;
    if (!(std::abs(x) < far && std::abs(y) < far)) return {0, HUGE_VAL};
    NearShape part;
    for (std::size_t i = 0; i < near->robot.size(); ++i) {
        part = near->robot[i];
        near->place(i, x, y, ratio(at.c, at.w), ratio(at.s, at.w), part);
        near->near(part.around, least.high + part.radius, [&](Index j) {
            const auto [low, high] = distance_of(part, near->obstacles[static_cast<std::size_t>(j)], least.high);
            least = {std::min(least.low, low), std::min(least.high, high)};
        });
    }
    return {std::max(0.0, least.low - 2 * margin) / near->unit, least.high < farthest ? (least.high + 2 * margin) / near->unit : HUGE_VAL};
}

}  // namespace cfree
