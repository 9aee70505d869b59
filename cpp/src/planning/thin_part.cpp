// Exact poses on parts without width; theory, "Paths", "Exact fits".
#include "cfree/planning/thin_part.hpp"

#include <algorithm>
#include <tuple>

#include "cfree/forbidden/critical_angle.hpp"
#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"
#include "collision/box_tree.hpp"

namespace cfree {

namespace {

constexpr int samples = 8;             // samples of a curve
constexpr std::size_t most_parts = 64; // parts of a curve: one slide suffices if its formula is proved to be defined

std::optional<Ratio> rational_angle(const Scene& scene, const CriticalAngle& x) {
    return x.lo == x.hi ? ratio_of(x.lo) : rational_value(x.exact(scene.near()));
}

// First or last angle of a part.
CriticalAngle angle_of(const Boundary& boundary, Index k, bool last) {
    const IsolatedParts& all = boundary.isolated;
    const Surface on{boundary.patches.contact((last ? all.to_patch : all.from_patch)[k]), all.parts.chart[k]};
    return last ? angle_to(on, all.parts, k) : angle_from(on, all.parts, k);
}

// True if a part has more than one orientation.
bool turns(const Boundary& boundary, Index k) {
    const auto from = angle_of(boundary, k, false), to = angle_of(boundary, k, true);
    const auto said = [](const CriticalAngle& x) { return std::tuple(packed(x.on().contact), packed(x.first), packed(x.second), x.lo, x.hi, x.place); };
    return said(from) != said(to);
}

Vec<Ratio> to(const RationalPose& from, const RationalPose& pose) { return {pose.x - from.x, pose.y - from.y}; }

}  // namespace

std::optional<Ratio> rational_angle(const Boundary& boundary, Index k, bool last) {
    const auto& [patches, table] = std::tie(boundary.patches, boundary.trapezoids);
    return rational_angle(*boundary.scene, last ? angle_to(patches, table, k) : angle_from(patches, table, k));
}

ThinPart::ThinPart(const Boundary& boundary, Index k)
    : number(k), is_curve(turns(boundary, k)), sheet(Sheet::isolated(boundary, k)) {
    const IsolatedParts& all = boundary.isolated;
    const Trapezoids& table = all.parts;
    for (const bool last : {false, true}) {
        const Feature curve_on = boundary.patches.contact((last ? all.upper_patch : all.lower_patch)[k]);
        const double middle = last ? table.tau_to(k) : table.tau_from(k);
        const double theta = theta_of(sheet.chart, middle);
        rounded[last] = position_on(*boundary.scene, curve_on, (last ? all.last_t : all.first_t)[k], theta);
        tau[last] = rational_angle(*boundary.scene, angle_of(boundary, k, last));
        if (!tau[last]) continue;
        if (is_curve) {
            ends[last] = at(*tau[last]);
        } else {
            const auto code = sheet.curves[last];
            const Sheet end(*boundary.scene, curve_on, sheet.chart, {code, code}, *tau[last], *tau[last]);
            ends[last] = end.pose(end.limits(*tau[last]).first, *tau[last]);
        }
    }
}

Box ThinPart::box(double margin) const {
    Box box;
    for (const Place& end : rounded) box.add(end.x, end.y);
    if (is_curve) {
        const Ratio step = (sheet.high - sheet.low) / Ratio{samples};
        for (int k = 1; k < samples && sheet.low < sheet.high; ++k) {
            const Place p = at(sheet.low + Ratio{k} * step).place();
            box.add(p.x, p.y);
        }
        margin += ((box.x1 - box.x0) + (box.y1 - box.y0)) / 8;
    }
    return {box.x0 - margin, box.y0 - margin, box.x1 + margin, box.y1 + margin};
}

std::optional<Ratio> ThinPart::local(const RationalPose& pose) const {
    const Ratio own = pose.half.tau();
    if (pose.half.chart() == sheet.chart) return own;
    if (abs(own.n) == own.d) return -own;
    return {};
}

bool ThinPart::holds(const RationalPose& pose) const {
    const auto there = local(pose);
    if (!there) return false;
    if (is_curve) {
        const Ratio &low = tau[0] ? *tau[0] : sheet.low, &high = tau[1] ? *tau[1] : sheet.high;
        return low <= *there && *there <= high && at(*there) == pose;
    }
    if (!ends[0] || !ends[1] || *there != *tau[0]) return false;
    const auto along = to(*ends[0], *ends[1]), beside = to(*ends[0], pose);
    const Ratio share = dot(along, beside);
    return cross(along, beside).n.is_zero() && share.n.sign() >= 0 && share <= dot(along, along);
}

std::optional<RationalPose> ThinPart::crossing(const ThinPart& other) const {
    if (is_curve || !tau[0] || !ends[0] || !ends[1]) return {};
    if (other.is_curve) {
        const auto there = other.local(*ends[0]);
        if (!there || !(other.sheet.low < *there && *there < other.sheet.high)) return {};
        const RationalPose pose = other.at(*there);
        return holds(pose) ? std::optional(pose) : std::nullopt;
    }
    if (!other.ends[0] || !other.ends[1] || other.ends[0]->half != ends[0]->half) return {};
    const auto U = to(*ends[0], *ends[1]), V = to(*other.ends[0], *other.ends[1]);
    const Ratio d = cross(U, V);
    if (d.n.is_zero()) return {};
    const Ratio t = cross(to(*ends[0], *other.ends[0]), V) / d;
    const RationalPose pose{ends[0]->x + t * U.x, ends[0]->y + t * U.y, ends[0]->half};
    return holds(pose) && other.holds(pose) ? std::optional(pose) : std::nullopt;
}

std::optional<Poses> ThinPart::way(const RationalPose& start, const RationalPose& goal, const FreeMotions& motions) const {
    if (!is_curve) return motions.first_free({{start, goal}});
    const Ratio last = *local(goal);
    Poses way{start};
    std::vector<Ratio> ahead{last};
    while (!ahead.empty()) {
        heed_stop();
        if (ahead.size() + way.size() >= most_parts) return {};
        const Ratio to = ahead.back(), from = *local(way.back());
        const RationalPose end = to == last ? goal : at(to);
        if (motions.along_curve(way.back(), end, sheet, 0)) {
            way.push_back(end);
            ahead.pop_back();
        } else {
            ahead.push_back(simple_middle(std::min(from, to), std::max(from, to)));
        }
    }
    return way;
}

}  // namespace cfree
