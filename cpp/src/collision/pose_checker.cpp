// Separating axes in doubles with a bound, then in integers; grids cache near pieces; theory, "Poses, exactly".
#include "cfree/collision/pose_checker.hpp"

#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

#include "cfree/exact/radians.hpp"
#include "cfree/exact/ratio.hpp"
#include "cfree/support/elementary.hpp"
#include "support/parallel.hpp"

namespace cfree {

// Error of a distance n . p - h. u = 2^-53; M bounds all compared coordinates, after placing the robot: those of the
// obstacles plus twice the robot's. To first order in u:
//   placed vertex   x + (c a_x - s a_y): 32 u (|a_x| + |a_y|) from c and s, 3 u of that from rounding, 2 u M from x and the
//                   sum; below 72 u M in each coordinate, 102 u M along n
//   edge's normal   3 u in each component (an exact difference, rounded; its length; the quotient), 72 u more when it is
//                   turned; times |p - v| <= 2 M in each coordinate: 300 u M
//   n . p, h and their difference: 10 u M
//   vertex seen from the robot, instead of the first and the turned normal: 142 u M in each coordinate, 201 u M along n;
//                   edge's normal 3 u times at most 4 M, 24 u M; n . p and h 29 u M
// In all below 412 u M; 512 u M is allowed. A range of poses adds its width: a point of the robot moves by at most
// shift + turn |a|, a point b of an obstacle, seen from the robot, by shift + turn |b - r|.
namespace {
constexpr double margin_by_size = 0x1p-44, least_margin = 0x1p-1000, least_square = 0x1p-1022;
constexpr double cells_in_reach = 8;
constexpr Index few = 4;  // vertices of a piece: testing all is faster than choosing
constexpr std::size_t chunk = 1024, sectors = 64, outside = std::numeric_limits<std::size_t>::max();
constexpr double farthest = 0x1p+997;  // larger distances count as this
constexpr double two_pi = 2 * std::numbers::pi, half_sector = two_pi / sectors / 2 * (1 + 0x1p-20);

Vec<double> unit_normal(const Vec<Int>& e) {
    const auto bits = static_cast<int>(std::max(e.x.is_zero() ? 0 : msb(abs(e.x)), e.y.is_zero() ? 0 : msb(abs(e.y))));
    const double dx = ball(e.x, bits).hi, dy = ball(e.y, bits).hi, length = std::sqrt(dx * dx + dy * dy);
    return {dy / length, -dx / length};
}

double rounded(const Ratio& x) {
    const bool is_large = !x.n.is_zero() && msb(abs(x.n)) > msb(x.d) + 1000;
    return is_large ? std::copysign(farthest, x.n.sign()) : std::clamp(nearest(x.n, x.d), -farthest, farthest);
}

double middle_of(std::size_t sector) { return (static_cast<double>(sector) + 0.5) * (two_pi / sectors); }

// Sixteenths of the circle, nearly: by signs and two comparisons, as the tangent of pi / 8 is about 5 / 12.
std::size_t direction_of(const Vec<double>& d) {
    const double x = std::abs(d.x), y = std::abs(d.y), less = std::min(x, y), more = std::max(x, y);
    return std::size_t(d.x < 0) + 2 * std::size_t(d.y < 0) + 4 * std::size_t(y > x) + 8 * std::size_t(12 * less > 5 * more);
}
Vec<double> middle_of_direction(std::size_t k) {
    const double less = tangent((k & 8 ? 3 : 1) * std::numbers::pi / 16);
    const Vec<double> d = k & 4 ? Vec<double>{less, 1} : Vec<double>{1, less};
    return {k & 1 ? -d.x : d.x, k & 2 ? -d.y : d.y};
}
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

PoseChecker::Pieces PoseChecker::pieces_of(const Shape& shape) {
    const auto& xy = shape.xy;
    Pieces p;
    p.first.push_back(0);
    for (Index k = 0; k < shape.pieces(); ++k) {
        const Index begin = shape.piece[k], end = shape.piece[k + 1];
        if (end - begin < 3 || shape.piece_layer[k] != 0) continue;
        p.number.push_back(k);
        for (Index m = begin; m < end; ++m) {
            const Index v = shape.piece_vertex[m], w = shape.piece_vertex[m + 1 < end ? m + 1 : begin];
            const auto n = unit_normal(difference<Int>(shape, w, v));
            p.x.push_back(xy[2 * v]), p.y.push_back(xy[2 * v + 1]);
            p.nx.push_back(n.x), p.ny.push_back(n.y), p.h.push_back(n.x * xy[2 * v] + n.y * xy[2 * v + 1]);
        }
        if ((end - begin) % 2)
            for (auto* values : {&p.x, &p.y, &p.nx, &p.ny, &p.h}) values->push_back(values->back());
        p.first.push_back(static_cast<Index>(p.x.size()));
        auto& far = p.far.emplace_back();
        for (std::size_t d = 0; d < far.size(); ++d) {
            const Vec<double> to = middle_of_direction(d);
            far[d] = p.first[p.first.size() - 2];
            for (Index m = far[d]; m < p.first.back(); ++m)
                if (to.x * p.x[m] + to.y * p.y[m] > to.x * p.x[far[d]] + to.y * p.y[far[d]]) far[d] = m;
        }
    }
    return p;
}

PoseChecker::PoseChecker(std::shared_ptr<const Scene> s, std::array<double, 4> bounds)
    : scene(std::move(s)), limits(bounds), robot(pieces_of(scene->robot)), obstacles(pieces_of(scene->obstacles)) {
    double largest = 0;
    for (std::size_t k = 0; k < robot.x.size(); ++k) reach = std::max(reach, norm(robot.x[k], robot.y[k]));
    for (std::size_t k = 0; k < obstacles.x.size(); ++k)
        largest = std::max({largest, std::abs(obstacles.x[k]), std::abs(obstacles.y[k])});
    margin = margin_by_size * (largest + 4 * reach) + least_margin;
    reach += margin;
    for (Index j = 0; j < obstacles.count(); ++j) {
        const auto [x0, x1] = std::minmax_element(&obstacles.x[obstacles.first[j]], &obstacles.x[0] + obstacles.first[j + 1]);
        const auto [y0, y1] = std::minmax_element(&obstacles.y[obstacles.first[j]], &obstacles.y[0] + obstacles.first[j + 1]);
        box.push_back({*x0 - margin, *y0 - margin, *x1 + margin, *y1 + margin});
    }
}

// Two doubles at once.
using Two = double __attribute__((vector_size(16), aligned(8), may_alias));
using TwoMasks = long long __attribute__((vector_size(16)));
static const Two& two(const double* x) { return *reinterpret_cast<const Two*>(x); }
static Two& two(double* x) { return *reinterpret_cast<Two*>(x); }

// Robot in a pose, in doubles; its memory is reused for the next pose. Vertices of a piece are placed when needed.
struct PoseChecker::Placed {
    const Pieces& at_rest;
    Placement at{};
    std::vector<double> x, y, nx, ny, h;
    std::vector<Ranges> box;  // around the pieces
    std::vector<char> is_placed;
    explicit Placed(const Pieces& p)
        : at_rest(p), x(p.x.size()), y(x), nx(x), ny(x), h(x), box(p.number.size()), is_placed(p.number.size()) {}
    // Place the robot, given its boxes for the pose at the origin.
    void place(const Placement& pose, const Ranges* around) {
        at = pose;
        for (std::size_t i = 0; i < box.size(); ++i) {
            box[i] = {at.x + around[i].x0, at.y + around[i].y0, at.x + around[i].x1, at.y + around[i].y1};
            is_placed[i] = false;
        }
    }
    void place(const Placement& pose) {
        at = pose;
        for (Index i = 0; i < at_rest.count(); ++i) {
            is_placed[i] = false;
            put(i);
            const auto begin = at_rest.first[i], end = at_rest.first[i + 1];
            const auto [x0, x1] = std::minmax_element(x.begin() + begin, x.begin() + end);
            const auto [y0, y1] = std::minmax_element(y.begin() + begin, y.begin() + end);
            box[i] = {*x0, *y0, *x1, *y1};
        }
    }
    void put(Index i) {
        if (is_placed[i]) return;
        is_placed[i] = true;
        for (Index k = at_rest.first[i]; k < at_rest.first[i + 1]; k += 2) {
            const Two ax = two(&at_rest.x[k]), ay = two(&at_rest.y[k]), bx = two(&at_rest.nx[k]), by = two(&at_rest.ny[k]);
            const Two px = at.x + (at.c * ax - at.s * ay), py = at.y + (at.s * ax + at.c * ay);
            const Two qx = at.c * bx - at.s * by, qy = at.s * bx + at.c * by;
            two(&x[k]) = px, two(&y[k]) = py, two(&nx[k]) = qx, two(&ny[k]) = qy, two(&h[k]) = qx * px + qy * py;
        }
    }
    Vec<double> seen_from(const Vec<double>& d) const { return {at.c * d.x + at.s * d.y, at.c * d.y - at.s * d.x}; }
};

// Compare edges begin <= k < end, an even number, of a convex polygon with the vertices of another. Free: all of it is on the
// outer side of one line, by the slack. Forbidden: each line has some of it on its inner side, most likely vertex `far`.
static Verdict beside(const double* nx, const double* ny, const double* h, Index count, double slack, const double* x, const double* y,
                      Index vertices, Index far, bool& is_inside) {
    is_inside = true;
    Verdict all = Verdict::forbidden;
    for (Index k = 0; k < count; k += 2) {
        const Two ax = two(nx + k), ay = two(ny + k), outer = two(h + k) + slack, inner = two(h + k) - slack;
        const TwoMasks is_in = ax * x[far] + ay * y[far] <= inner;
        if (vertices > few && (is_in[0] & is_in[1])) continue;
        is_inside = false;
        TwoMasks some_not_out{}, some_in{};
        for (Index v = 0; v < vertices; ++v) {
            const Two d = ax * x[v] + ay * y[v];
            some_not_out |= d < outer, some_in |= d <= inner;
        }
        if (!(some_not_out[0] & some_not_out[1])) return Verdict::free;
        if (!(some_in[0] & some_in[1])) all = Verdict::uncertain;
    }
    return all;
}

// Verdict on two pieces. The first vertex tried of each reaches far towards the other; if it is inside, the interiors meet.
Verdict PoseChecker::meet(Placed& placed, Index i, Index j, const Range& range) const {
    const Index a = robot.first[i], b = obstacles.first[j], n = robot.first[i + 1] - a, m = obstacles.first[j + 1] - b;
    const Vec<double> towards{0.5 * (box[j].x0 + box[j].x1) - placed.at.x, 0.5 * (box[j].y0 + box[j].y1) - placed.at.y};
    double slack = margin + range.shift + range.turn * reach;
    placed.put(i);
    bool is_inside;
    const Index p = n > few ? robot.far[i][direction_of(placed.seen_from(towards))] - a : 0;
    const Verdict v = beside(&obstacles.nx[b], &obstacles.ny[b], &obstacles.h[b], m, slack, &placed.x[a], &placed.y[a], n, p, is_inside);
    if (v == Verdict::free || is_inside) return v;
    if (range.turn > 0) {  // in the robot's frame, the farthest vertex moves most
        const double dx = std::max(box[j].x1 - placed.at.x, placed.at.x - box[j].x0);
        const double dy = std::max(box[j].y1 - placed.at.y, placed.at.y - box[j].y0);
        slack = margin + range.shift + range.turn * (std::abs(dx) + std::abs(dy));
    }
    const Index q = m > few ? obstacles.far[j][direction_of({-towards.x, -towards.y})] - b : 0;
    const Verdict w = beside(&placed.nx[a], &placed.ny[a], &placed.h[a], n, slack, &obstacles.x[b], &obstacles.y[b], m, q, is_inside);
    return w == Verdict::free || is_inside ? w : std::max(v, w);
}

// Test all pieces of the robot against some of the obstacles', until a pair is forbidden; `decide` settles uncertain pairs.
template <class F>
Verdict PoseChecker::against(Placed& placed, const Index* list, std::size_t count, const Range& range, F&& decide) const {
    Verdict all = Verdict::free;
    const double slack = range.shift + range.turn * reach;
    for (Index i = 0; i < robot.count(); ++i) {
        Ranges r = placed.box[i];
        r.x0 -= slack, r.y0 -= slack, r.x1 += slack, r.y1 += slack;
        for (std::size_t m = 0; m < count; ++m) {
            const Index j = list[m];
            const Ranges& o = box[j];
            if ((r.x0 > o.x1) | (o.x0 > r.x1) | (r.y0 > o.y1) | (o.y0 > r.y1)) continue;
            Verdict v = meet(placed, i, j, range);
            if (v == Verdict::uncertain) v = decide(i, j);
            if (v == Verdict::forbidden) return v;
            if (v == Verdict::uncertain) all = v;
        }
    }
    return all;
}

// Distance of a point from a piece, within the margin; 0 inside. The margin decides which edges count, because of thin
// pieces: ahead of their tips, the distances of lines are small, and may have any sign.
double PoseChecker::distance(const Pieces& p, Index piece, double x, double y) const {
    const Index begin = p.first[piece], end = p.first[piece + 1];
    double least = std::numeric_limits<double>::infinity();
    bool inside = true;
    for (Index k = begin; k < end; ++k) {
        const Index next = k + 1 < end ? k + 1 : begin;
        const double d = p.nx[k] * x + p.ny[k] * y - p.h[k];
        if (d <= -margin) continue;
        inside = false;
        const double ex = p.x[next] - p.x[k], ey = p.y[next] - p.y[k], dx = x - p.x[k], dy = y - p.y[k];
        const double t = std::clamp((dx * ex + dy * ey) / std::max(ex * ex + ey * ey, least_square), 0.0, 1.0);
        least = std::min(least, norm(dx - t * ex, dy - t * ey));
    }
    return inside ? 0 : least;
}

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
    std::sort(found.begin(), found.end(), [](const Near& p, const Near& q) {  // most likely overlaps come first
        return std::tie(p.cell, p.distance, p.piece) < std::tie(q.cell, q.distance, q.piece);
    });
    g.start.assign(blocked.size() + 1, 0);
    for (const Near& near : found) ++g.start[near.cell + 1], g.member.push_back(near.piece);
    std::partial_sum(g.start.begin(), g.start.end(), g.start.begin());
    Placed turned(robot);
    for (std::size_t k = 0; k < sectors; ++k) {
        turned.place({0, 0, cosine(middle_of(k)), sine(middle_of(k))});
        const double r = half_sector * reach + margin;
        for (const Ranges& at : turned.box) g.around.push_back({at.x0 - r, at.y0 - r, at.x1 + r, at.y1 + r});
    }
    g.known = std::vector<std::atomic<State>>(blocked.size() * sectors);
    for (std::size_t c = 0; c < blocked.size(); ++c)
        if (blocked[c] || g.start[c] == g.start[c + 1])
            std::fill_n(&g.known[c * sectors], sectors, blocked[c] ? State::forbidden : State::free);
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

// Everything times scale * w * unit.
bool PoseChecker::overlap(const ExactPlacement& at, Index i, Index j) const {
    using Ring = std::vector<Vec<Int>>;
    const auto ring = [](const Shape& shape, Index piece, auto&& place) {
        Ring r;
        for (Index m = shape.piece[piece]; m < shape.piece[piece + 1]; ++m)
            r.push_back(place(shape.X[shape.piece_vertex[m]], shape.Y[shape.piece_vertex[m]]));
        return r;
    };
    const Int dx = at.x * scene->scale * at.w, dy = at.y * scene->scale * at.w, unit = at.w * at.unit;
    const Ring a = ring(scene->robot, robot.number[i], [&](const Int& x, const Int& y) {
        return Vec<Int>{(at.c * x - at.s * y) * at.unit + dx, (at.s * x + at.c * y) * at.unit + dy};
    });
    const Ring b = ring(scene->obstacles, obstacles.number[j], [&](const Int& x, const Int& y) {
        return Vec<Int>{x * unit, y * unit};
    });
    const auto separates = [](const Ring& own, const Ring& other) {
        for (std::size_t k = 0; k < own.size(); ++k) {
            const Vec<Int>&v = own[k], &w = own[k + 1 < own.size() ? k + 1 : 0], e{w.x - v.x, w.y - v.y};
            if (std::all_of(other.begin(), other.end(),
                            [&](const Vec<Int>& p) { return cross(e, Vec<Int>{p.x - v.x, p.y - v.y}) <= 0; }))
                return true;
        }
        return false;
    };
    return !separates(a, b) && !separates(b, a);
}

}  // namespace cfree
