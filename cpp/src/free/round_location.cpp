// Rays from poses among grown shapes; theory, "Rounded shapes".
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "cfree/contact/contact_line.hpp"
#include "free/round_view.hpp"
#include "predicates/round_points.hpp"

namespace cfree {

// A line or a quadrant, between two angles, in intervals.
PointLocation::Extent PointLocation::extent_among_grown(Index k, double from, double to) const {
    const auto [contact, chart] = surface_of(patches, trapezoids, k);
    const double first = std::max(from, trapezoids.from_lo[k]), last = std::min(to, trapezoids.to_hi[k]);
    const Reach reach = RoundPoints(scene, chart).reach({contact, {}}, first, last);
    return {reach.y0, reach.y1, reach.x0, 0, k};
}

namespace {

// Doubles around p / r.
std::array<double, 2> around(const Int& p, const Int& r) {
    const double tau = ratio(p, r);
    const Dyadic d = Dyadic::from(tau);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (d.n * r == p << d.k) return {tau, tau};
    return {std::nextafter(std::nextafter(tau, -infinity), -infinity), std::nextafter(std::nextafter(tau, infinity), infinity)};
}

// The pose of two balls' middles, in doubles' unit.
ExactPose exact_pose(const Ball& x, const Ball& y, int shift, int chart, const Dyadic& tau) {
    unsigned digits = 0;
    for (const double part : {x.hi, x.lo, y.hi, y.lo}) digits = std::max(digits, Dyadic::from(part).k);
    const auto whole = [&](double part) -> Int {
        const Dyadic d = Dyadic::from(part);
        return d.n << (digits - d.k + static_cast<unsigned>(shift));
    };
    return {whole(x.hi) + whole(x.lo), whole(y.hi) + whole(y.lo), Int(1) << digits, chart, tau.n, Int(1) << tau.k};
}

}  // namespace

// An end of a piece that is as high as the pose counts as below it, for all pieces: as for a ray just above.
PointLocation::Nearby PointLocation::look_among_grown(const ExactPose& q) const {
    Nearby seen;
    const std::array<double, 2> interval = around(q.p, q.r);
    const double tau_lo = interval[0], tau_hi = interval[1];
    RoundView view(scene, q, tau_lo, tau_hi);
    const Index part = index.part_of(q.chart, 0.5 * (tau_lo + tau_hi));
    const Int W = q.W << static_cast<unsigned>(scene.shift);
    const auto order = [&](bool is_end, Index k) {
        const double lo = is_end ? trapezoids.to_lo[k] : trapezoids.from_lo[k], hi = is_end ? trapezoids.to_hi[k] : trapezoids.from_hi[k];
        if (hi < tau_lo) return -1;
        if (lo > tau_hi) return 1;
        if (lo == hi && tau_lo == tau_hi) return 0;
        return view.order((is_end ? angle_to(patches, trapezoids, k) : angle_from(patches, trapezoids, k)).exact_among_grown(scene));
    };
    const double x = ratio(q.X, W), y = ratio(q.Y, W);
    stab(tree(part), x + std::abs(x) * 0x1p-50 + tiny, y, [&](Index k) {
        heed_stop();
        if (trapezoids.from_lo[k] > tau_hi || trapezoids.to_hi[k] < tau_lo) return;
        const int from = order(false, k), to = order(true, k);
        if (from > 0 || to < 0) return;
        if (from == 0 || to == 0) seen.generic = false;
        const Feature contact = surface_of(patches, trapezoids, k).contact;
        const Feature lower = unpacked(trapezoids.lower[k]), upper = unpacked(trapezoids.upper[k]);
        const int side = view.side(contact);
        if (side == 0 && view.is_between(contact, lower, upper, to != 0)) {
            seen.on.push_back(k), seen.end.push_back(from == 0 ? -1 : to == 0 ? 1 : 0);
            return;
        }
        if (to == 0) return;  // it ends here
        const int first = view.height(contact, lower, true), last = view.height(contact, upper, true);
        if ((first > 0) == (last > 0)) return;
        if (is_line(contact) ? side == (last > 0 ? -1 : 1) : view.is_right_of(contact)) seen.crossed.push_back(k);
    });
    return seen;
}

PointLocation::Nearby PointLocation::nearby_among_grown(const ExactPose& q) const {
    Nearby seen = look_among_grown(q);
    if (q.p != -q.r) return seen;
    // trapezoids of the other chart that end here
    const Nearby before = look_among_grown({q.X, q.Y, q.W, 1 - q.chart, 1, 1});
    for (std::size_t k = 0; k < before.on.size(); ++k)
        if (before.end[k] > 0) seen.on.push_back(before.on[k]), seen.end.push_back(1);
    return seen;
}

std::optional<std::pair<PointLocation::Ray, ExactPose>> PointLocation::beside(Index k, int attempt, int closer) const {
    const Surface surface = surface_of(patches, trapezoids, k);
    Predicates predicates(scene, surface);
    const Event from = angle_from(patches, trapezoids, k).event(predicates), to = angle_to(patches, trapezoids, k).event(predicates);
    const Dyadic tau = predicates.between(from, to, attempt).exact();
    const RoundPoints points(scene, surface.chart);
    const auto low = points.near({surface.contact, unpacked(trapezoids.lower[k])}, tau);
    const auto high = points.near({surface.contact, unpacked(trapezoids.upper[k])}, tau);
    const Ball rise = high.y - low.y, y = low.y + Ball(0.5 + (attempt % 5 - 2) * 0.125) * rise;
    if (rise.hi == 0) return {};
    const Ball x = points.crossing(surface.contact, low, high, y, tau);
    const auto pose_at = [&](double by) {
        return exact_pose(x + Ball(by), y, scene.shift, surface.chart, tau);
    };
    double step = (std::abs((high.x - low.x).hi) + std::abs(rise.hi)) * std::ldexp(0.25, -2 * closer);
    for (int smaller = closer; smaller < 50; ++smaller, step *= 0.25) {
        const ExactPose before = pose_at(-step), beyond = pose_at(step);
        const Nearby left = look_among_grown(before), right = look_among_grown(beyond);
        if (!left.generic || !left.on.empty() || !right.generic || !right.on.empty()) continue;
        std::vector<Index> same = left.crossed, more = right.crossed, passed;
        std::sort(same.begin(), same.end()), std::sort(more.begin(), more.end());
        std::set_difference(more.begin(), more.end(), same.begin(), same.end(), std::back_inserter(passed));
        if (same.size() + passed.size() != more.size()) continue;
        if (passed == std::vector{k}) return std::pair(Ray{before, k, rise.hi > 0, std::move(same)}, beyond);
    }
    return {};
}

// Rays beside each face. Where none of these is in general position, as all faces are thinner than balls can tell, none will be.
constexpr int rays_tried = 10;

std::vector<PointLocation::Ray> PointLocation::rays_among_grown() const {
    const auto n = static_cast<Index>(component.size());
    const Index components = n ? *std::max_element(component.begin(), component.end()) + 1 : 0;
    std::vector<std::vector<Index>> of_component(static_cast<std::size_t>(components));
    for (Index k = 0; k < n; ++k) of_component[component[k]].push_back(k);
    const auto width = [&](Index k) { return trapezoids.to_lo[k] - trapezoids.from_hi[k]; };
    std::vector<Ray> result;
    for (auto& faces : of_component) {
        heed_stop();
        std::stable_sort(faces.begin(), faces.end(), [&](Index p, Index q) { return width(p) > width(q); });
        std::optional<std::pair<Ray, ExactPose>> found;
        for (int attempt = 0; attempt < rays_tried && !found; ++attempt)
            for (std::size_t k = 0; k < faces.size() && !found; ++k) found = beside(faces[k], attempt, 0);
        if (!found) throw std::logic_error("no ray in general position");
        result.push_back(std::move(found->first));
    }
    return result;
}

}  // namespace cfree
