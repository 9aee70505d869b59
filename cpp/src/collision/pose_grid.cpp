// Grids of poses: obstacle pieces near the poses of a cell, and verdicts on all poses of a box.
#include "collision/pose_grid.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "cfree/support/elementary.hpp"
#include "collision/placed_robot.hpp"

namespace cfree {

namespace {
constexpr double cells_in_reach = 8;
constexpr double half_sector = two_pi / sectors / 2 * (1 + 0x1p-20);

double middle_of(std::size_t sector) { return (static_cast<double>(sector) + 0.5) * (two_pi / sectors); }
}  // namespace

// Numbers of poses from which on a grid may have so many cells: making it takes no longer than these poses. All poses of a
// box are decided together after so many single ones: most large boxes are mixed, and finding that out takes long.
struct PoseChecker::Fineness {
    std::size_t poses;
    double most_cells;
    State enough;
};
constexpr std::array<PoseChecker::Fineness, 3> PoseChecker::finenesses{
    {{0, 1 << 8, State::twice}, {1 << 14, 1 << 12, State::twice}, {1 << 16, 1 << 14, State::unseen}}};

void PoseChecker::fill(Grid& g, const Fineness& fineness) const {
    const double most_cells = fineness.most_cells;
    g.enough = fineness.enough;
    Ranges around{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Ranges& b : box) {
        around.x0 = std::min(around.x0, b.x0 - reach), around.x1 = std::max(around.x1, b.x1 + reach);
        around.y0 = std::min(around.y0, b.y0 - reach), around.y1 = std::max(around.y1, b.y1 + reach);
    }
    // limits are rounded inwards: an exact pose within them may be rounded to the next double beyond
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto below = [](double x) { return std::nextafter(x, -infinity); };
    const auto above = [](double x) { return std::nextafter(x, infinity); };
    around = {std::max(around.x0, below(limits[0])), std::max(around.y0, below(limits[1])), std::min(around.x1, above(limits[2])),
              std::min(around.y1, above(limits[3]))};
    const double width = around.x1 - around.x0, height = around.y1 - around.y0;
    if (!(width >= 0 && height >= 0)) return;  // nothing is near
    const double side = std::max({std::sqrt(width / most_cells) * std::sqrt(height), width / most_cells, height / most_cells,
                                  reach / cells_in_reach});
    g.x0 = around.x0, g.y0 = around.y0, g.per_unit = 1 / side;
    // one more than whole cells and the rest: rounding takes a pose on the upper rim, which may be a limit, into it
    g.nx = static_cast<Index>(width / side) + 2, g.ny = static_cast<Index>(height / side) + 2;
    const auto cell = [&](double offset, Index n) {
        return static_cast<Index>(std::clamp(offset * g.per_unit, 0.0, static_cast<double>(n - 1)));
    };
    // radius of a disc around a cell, with poses that rounding moves to the next cell; margin: the error of a distance
    g.side = side;
    const double radius = g.radius = std::sqrt(0.5) * side * (1 + 0x1p-20) + margin;
    double core = 0;  // radius of a disc in the robot, around its reference point
    for (Index i = 0; i < robot.count(); ++i)
        core = std::max(core, *std::min_element(&robot.h[robot.first[i]], robot.h.data() + robot.first[i + 1]) - margin);
    struct Near {
        Index cell, piece;
        double distance;
    };
    std::vector<Near> found;
    std::vector<char> blocked(static_cast<std::size_t>(g.nx) * static_cast<std::size_t>(g.ny));
    for (Index j = 0; j < obstacles.count(); ++j) {
        const Ranges& b = box[j];
        const double r = reach + radius;
        const Index c0 = cell(b.x0 - r - g.x0, g.nx), c1 = cell(b.x1 + r - g.x0, g.nx);
        const Index r0 = cell(b.y0 - r - g.y0, g.ny), r1 = cell(b.y1 + r - g.y0, g.ny);
        for (Index row = r0; row <= r1; ++row)
            for (Index column = c0; column <= c1; ++column) {
                const Index cell_number = row * g.nx + column;
                if (blocked[cell_number]) continue;
                const double x = g.x0 + (column + 0.5) * side, y = g.y0 + (row + 0.5) * side;
                const double d = distance(obstacles, j, x, y);
                if (d + radius < core) blocked[cell_number] = true;
                else if (d < reach + radius) found.push_back({cell_number, j, d});
            }
    }
    std::erase_if(found, [&](const Near& near) { return blocked[near.cell]; });
    g.start.assign(blocked.size() + 1, 0);
    for (const Near& near : found) ++g.start[near.cell + 1];
    std::partial_sum(g.start.begin(), g.start.end(), g.start.begin());
    std::vector<std::pair<double, Index>> by_cell(found.size());  // distances and pieces
    std::vector<Index> next = g.start;
    for (const Near& near : found) by_cell[next[near.cell]++] = {near.distance, near.piece};
    for (std::size_t c = 0; c < blocked.size(); ++c)  // most likely overlaps come first
        std::sort(by_cell.begin() + g.start[c], by_cell.begin() + g.start[c + 1]);
    for (const auto& [distance, piece] : by_cell) g.member.push_back(piece);
    Placed turned(robot);
    for (std::size_t k = 0; k < sectors; ++k) {
        turned.place({0, 0, cosine(middle_of(k)), sine(middle_of(k))});
        const double r = half_sector * reach + margin;
        for (const Ranges& at : turned.box) g.around.push_back({at.x0 - r, at.y0 - r, at.x1 + r, at.y1 + r});
    }
    g.known = std::vector<std::atomic<State>>(blocked.size() * sectors);
    for (std::size_t c = 0; c < blocked.size(); ++c) {
        if (!blocked[c] && g.start[c] != g.start[c + 1]) continue;
        for (std::size_t k = 0; k < sectors; ++k)
            g.known[c * sectors + k].store(blocked[c] ? State::forbidden : State::free, std::memory_order_relaxed);
    }
}

PoseChecker::Grid& PoseChecker::near(std::size_t poses) const {
    const std::size_t all = asked.fetch_add(poses, std::memory_order_relaxed) + poses;
    std::size_t k = levels.size() - 1;
    while (all < finenesses[k].poses) --k;
    Level& level = levels[k];
    std::call_once(level.once, [&] { fill(level.grid, finenesses[k]); });
    return level.grid;
}

// Box of a pose in the grid: its cell times `sectors`, and its sector.
std::size_t PoseChecker::Grid::slot(double x, double y, double theta) const {
    const double column = (x - x0) * per_unit, row = (y - y0) * per_unit;
    if (!(column >= 0 && column < nx && row >= 0 && row < ny)) return outside;
    const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(column);
    return cell * sectors + std::min<std::size_t>(static_cast<std::size_t>(theta * (sectors / two_pi)), sectors - 1);
}

// Cosine and sine of an angle in a sector: those of its middle, turned by series to the 8th power of at most pi / 64, whose
// next terms are below 2^-57. In all within 2^-50; angles of poses are rounded to doubles, and stand for tangents, within 2^-49.
static Vec<double> direction(double theta, std::size_t sector) {
    static const auto middles = [] {
        std::array<Vec<double>, sectors> found;
        for (std::size_t k = 0; k < sectors; ++k) found[k] = {cosine(middle_of(k)), sine(middle_of(k))};
        return found;
    }();
    const double d = theta - middle_of(sector), q = d * d;
    const double s = d * (1 + q * (-1.0 / 6 + q * (1.0 / 120 + q * (-1.0 / 5040))));
    const double c = 1 + q * (-0.5 + q * (1.0 / 24 + q * (-1.0 / 720 + q * (1.0 / 40320))));
    return {middles[sector].x * c - middles[sector].y * s, middles[sector].y * c + middles[sector].x * s};
}

// Verdict of all poses in the box of a pose, if they agree and enough were tested before; else of this one.
Verdict PoseChecker::verdict(Grid& g, std::size_t slot, const double* pose, Placed& placed) const {
    const std::size_t cell = slot / sectors, sector = slot % sectors, width = static_cast<std::size_t>(g.nx);
    const Index* list = &g.member[g.start[cell]];
    const auto count = static_cast<std::size_t>(g.start[cell + 1] - g.start[cell]);
    const auto look = [&](double x, double y, double theta, const Range& range) {
        const auto [c, s] = direction(theta, sector);
        placed.place({x, y, c, s}, &g.around[sector * robot.number.size()]);
        return against(placed, list, count, range, [](Index, Index) { return Verdict::uncertain; });
    };
    std::atomic<State>& known = g.known[slot];
    const State state = known.load(std::memory_order_relaxed);
    if (state < g.enough) {
        known.store(state == State::unseen ? State::once : State::twice, std::memory_order_relaxed);
    } else if (state != State::mixed) {
        const double x = static_cast<double>(cell % width) + 0.5, y = static_cast<double>(cell / width) + 0.5;
        const Verdict all = look(g.x0 + x * g.side, g.y0 + y * g.side, middle_of(sector), {g.radius, half_sector});
        known.store(all == Verdict::free ? State::free : all == Verdict::forbidden ? State::forbidden : State::mixed,
                    std::memory_order_relaxed);
        if (all != Verdict::uncertain) return all;
    }
    return look(pose[0], pose[1], pose[2], {});
}

}  // namespace cfree
