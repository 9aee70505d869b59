// Ways between poses and the boundary of their cell; theory, "Paths".
#include "cfree/planning/landing.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

constexpr std::array<std::array<int, 2>, 8> directions{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

Ratio times(const Ratio& x, int k) { return reduced(x.n * k, x.d); }

RationalPose shifted(const RationalPose& q, const Ratio& share, const Ratio& dx, const Ratio& dy) {
    return {q.x + share * dx, q.y + share * dy, q.half};
}

// Try orientations within, closer and closer to the beginning of a way, until one has a free way.
template <class F>
RationalPose shortened(const Ratio& tau, Ratio far, F&& way) {
    for (int k = 0; k < most_halvings; ++k) {
        heed_stop();
        far = simple_middle(std::min(tau, far), std::max(tau, far));
        if (std::optional<RationalPose> found = way(far)) return *found;
    }
    throw std::logic_error("no way onto a trapezoid");
}

}  // namespace

Extent::Extent(const CellComplex& cells, const Ratio& of_robot) : reach(of_robot) {
    Vec<double> low{}, high{};
    for (Index v = 0; v < cells.vertices; ++v) {
        const Vec<double> p = position(cells, v);
        if (v == 0) low = high = p;
        low = {std::min(low.x, p.x), std::min(low.y, p.y)}, high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const double size = std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)});
    const Ratio rounding = ratio_of(size * 0x1p-40);  // exceeds the error of doubles
    length = ratio_of(2 * ((high.x - low.x) + (high.y - low.y))) + times(reach, 2) + rounding;
    far = ratio_of(low.x) - times(reach, 2) - rounding;
}

Landings::Landings(const FreeSpace& of, const Extent& sizes, const FreeMotions& by) : space(of), extent(sizes), motions(by) {}

RationalPose Landings::off(const Sheet& sheet, const Ratio& t, const Ratio& tau) const {
    const HalfAngle half = HalfAngle::of(sheet.chart, tau);
    const RationalPose pose = sheet.pose(t, half);
    const Vec<Int> U = sheet.at(half).U;
    const Int length = abs(U.x) + abs(U.y);
    // off the contact: to the right of U
    const Ratio dx = reduced(extent.reach.n * U.y, extent.reach.d * length);
    const Ratio dy = reduced(-extent.reach.n * U.x, extent.reach.d * length);
    const auto found = motions.free_share(pose, dx, dy);
    const Ratio room = found ? *found : Ratio{1};
    if (room.n.is_zero()) return pose;
    return shifted(pose, simple_middle(room / Ratio{4}, times(room, 3) / Ratio{4}), dx, dy);
}

// --- ways off a pose: enter every cell whose closure contains it ---

std::vector<Landing> Landings::departures(const RationalPose& pose, Index cell) const {
    std::vector<Landing> found;
    const auto nearby = space.points().nearby(pose.exact(*space.boundary->scene));
    for (std::size_t k = 0; k < nearby.on.size(); ++k) {
        const Index face = nearby.on[k];
        if (space.cell_of[space.surfaces.component[face]] == cell)
            found.push_back({face, inwards(sheet(face), pose, nearby.end[k])});
    }
    return found;
}

// Poses from a pose on a trapezoid, which begins (-1) or ends (1) at its orientation or does not (0), to one within: by a
// rotation about the point of contact, or, without width, by a motion along one of its curves.
Poses Landings::inwards(const Sheet& sheet, const RationalPose& pose, int end) const {
    if (end == 0) return {pose};
    const Ratio tau = pose.half.tau_in(sheet.chart);
    const auto [lower, upper] = sheet.limits(tau);
    Ratio t = sheet.t_of(pose, tau);
    if (lower < upper && !(lower < t && t < upper)) t = simple_middle(lower, upper);
    const RationalPose begin = sheet.pose(t, tau);
    Poses way{pose};
    if (begin != pose) way.push_back(begin);
    const bool is_wide = lower < upper;
    const auto turned = [&](const Ratio& to) -> std::optional<RationalPose> {
        const auto [low, high] = sheet.limits(to);
        const RationalPose last = sheet.pose(t, to);
        if (t < low || high < t || !motions.join({begin, last})) return {};
        return last;
    };
    const auto along = [&](const Ratio& to) -> std::optional<RationalPose> {
        const auto [low, high] = sheet.limits(to);
        for (const std::size_t side : {0u, 1u}) {
            const RationalPose last = sheet.pose(side ? high : low, to);
            if (motions.along_curve(begin, last, sheet, side)) return last;
        }
        return {};
    };
    way.push_back(shortened(tau, end > 0 ? sheet.low : sheet.high, [&](const Ratio& to) { return is_wide ? turned(to) : along(to); }));
    return way;
}

std::vector<Landing> Landings::of(const RationalPose& pose, Index cell) const {
    auto found = departures(pose, cell);
    if (!found.empty()) return found;
    for (const auto [x, y] : directions)
        for (auto& landing : straight(pose, x, y, cell)) found.push_back(std::move(landing));
    return found;
}

// Landings of a straight way; a way far away leads to the left.
std::vector<Landing> Landings::straight(const RationalPose& pose, int x, int y, Index cell) const {
    const RationalPose there_far{extent.far, pose.y, pose.half};
    const bool is_left = x < 0 && y == 0;
    const Ratio length = is_left ? std::max(extent.length, pose.x - extent.far) : extent.length;
    const Ratio dx = times(length, x), dy = times(length, y);
    const auto share = motions.free_share(pose, dx, dy);
    if (!share) {
        if (is_left && motions.join({pose, there_far})) return {{far_away, {pose, there_far}}};
        return {};
    }
    auto found = departures(shifted(pose, *share, dx, dy), cell);
    for (Landing& landing : found) landing.way.insert(landing.way.begin(), pose);
    return found;
}

// --- links ---

std::vector<Link> Landings::links(Index cell) const {
    const auto& component = space.surfaces.component;
    const Trapezoids& table = space.boundary->trapezoids;
    std::map<Index, Index> widest;  // one per island
    const auto width = [&](Index k) { return table.tau_to(k) - table.tau_from(k); };
    for (Index k = 0; k < static_cast<Index>(component.size()); ++k) {
        const Index of = component[k];
        if (space.cell_of[of] != cell || space.surfaces.free_inside[of]) continue;
        const auto [it, is_new] = widest.emplace(of, k);
        if (!is_new && width(k) > width(it->second)) it->second = k;
    }
    std::vector<Link> found;
    for (const auto& [of, face] : widest) link(face, cell, found);
    return found;
}

void Landings::link(Index widest, Index cell, std::vector<Link>& found) const {
    const Sheet f = sheet(widest);
    const Scene& scene = *space.boundary->scene;
    for (Ratio tau = simple_middle(f.low, f.high);; tau = simple_middle(tau, f.high)) {
        heed_stop();
        const Ratio t = f.middle(tau);
        const RationalPose pose = off(f, t, tau);
        const auto nearby = space.points().nearby(pose.exact(scene));
        if (!nearby.generic || !nearby.on.empty()) continue;
        std::set<Ratio> crossed{extent.far};
        bool is_level = false;
        for (const Index face : nearby.crossed) {
            const auto x = crossing(face, pose);
            if (x) crossed.insert(*x);
            else is_level = true;
        }
        if (is_level) continue;
        const auto left = straight(pose, -1, 0, cell);
        if (!left.empty()) found.push_back({{f.face, {pose, f.pose(t, tau)}}, left.front()});
        // from right to left
        for (auto it = crossed.rbegin(); std::next(it) != crossed.rend(); ++it) {
            const RationalPose middle{(*it + *std::next(it)) / Ratio{2}, pose.y, pose.half};
            if (space.locate(middle.exact(scene)) != cell) continue;
            const auto right = straight(middle, 1, 0, cell), to_left = straight(middle, -1, 0, cell);
            if (!right.empty() && !to_left.empty()) found.push_back({right.front(), to_left.front()});
        }
        return;
    }
}

// Place of a trapezoid's line at a pose's height and orientation; nothing if the line is level there.
std::optional<Ratio> Landings::crossing(Index face, const RationalPose& pose) const {
    const auto [P, U, w] = sheet(face).at(pose.half);
    if (U.y.is_zero()) return {};
    // x + (y of the pose - y) / v u, all of them over w and the scale
    const Int by = w * space.boundary->scene->scale;
    return reduced(P.x * U.y * pose.y.d + (pose.y.n * by - P.y * pose.y.d) * U.x, by * U.y * pose.y.d);
}

}  // namespace cfree
