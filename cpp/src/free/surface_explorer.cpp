// Trapezoids found by their neighbours' sides in doubles, closed surfaces by gluing exactly; theory, "One surface alone".
#include "cfree/free/surface_explorer.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "cfree/contact/contact_line.hpp"
#include "free/touching_patches.hpp"

namespace cfree {

namespace {

// Where a segment of a trapezoid begins and ends at an angle: rounded.
using Ends = std::array<Vec<double>, 2>;

double apart(const Vec<double>& p, const Vec<double>& q) { return std::hypot(p.x - q.x, p.y - q.y); }

}  // namespace

struct SurfaceExplorer::State {
    State(std::shared_ptr<const Scene> s, bool regularized)
        : given(std::move(s)), scene(given->near()), one(scene, regularized), touching(*given, one), names(scene),
          faces_of(one.patches.size(), {-1, -1}), trimmed(one.patches.size(), 0) {
        for (std::size_t v = 0; v < scene.robot.x.size(); ++v)
            nearness = std::max({nearness, std::abs(scene.robot.x[v]), std::abs(scene.robot.y[v])});
        nearness *= 1e-7;
    }

    void trim(Index patch);
    void trim(std::vector<Index>& patches);
    void explore(Index k, std::vector<Index>& found);
    Ends ends(Index k, double tau) const;
    double value(Index k, std::uint64_t curve, double tau) const;
    bool shares_curve(Index k, bool upper, Index other) const;
    bool shares_level(Index k, bool last, Index other) const;
    SharedBoundary boundary() const {
        return std::make_shared<const Boundary>(given, one.patches, trimmed, rows, IsolatedParts{});
    }

    const std::shared_ptr<const Scene> given;
    const Scene& scene;
    PatchTrimming one;
    TouchingPatches touching;
    const Representatives names;
    Trapezoids rows;                               // of patches in the order they were trimmed in
    std::vector<std::array<Index, 2>> faces_of;    // each patch: its rows
    std::vector<std::uint8_t> trimmed;
    std::vector<char> whole;                       // of each row, whether all that its sides meet is trimmed
    std::map<Index, std::vector<Index>> growing;   // by seed: rows that are to be explored
    double nearness = 0;                           // of points that may be one; it decides what is looked at first
    Index pillars_of = -1;
    std::vector<Index> pillars;
    Tally tally;
};

void SurfaceExplorer::State::trim(Index patch) {
    if (trimmed[patch]) return;
    if (const Index feature = one.patches.obstacle[patch]; feature != pillars_of) {
        one.pillars_near(feature, pillars);
        pillars_of = feature;
    }
    std::vector<Trapezoid> found, thin;
    one.trim(patch, pillars, found, thin, tally);
    trimmed[patch] = 1;
    const std::size_t before = rows.size();
    for (const Trapezoid& x : found) rows.push_back(x);
    for (auto* column : rows.features())
        for (std::size_t k = before; k < rows.size(); ++k) (*column)[k] = named(names, (*column)[k]);
    whole.resize(rows.size(), 0);
    faces_of[patch] = {static_cast<Index>(before), static_cast<Index>(rows.size())};
}

void SurfaceExplorer::State::trim(std::vector<Index>& patches) {
    std::sort(patches.begin(), patches.end());
    patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
    for (const Index patch : patches) trim(patch);
}

double SurfaceExplorer::State::value(Index k, std::uint64_t curve, double tau) const {
    const Feature on = one.patches.contact(rows.patch[k]), f = unpacked(curve);
    const Curve c = Predicates(scene, {on, rows.chart[k]}).curve(f);
    return c.N.polar(tau, tau) / c.D.polar(tau, tau);
}

Ends SurfaceExplorer::State::ends(Index k, double tau) const {
    const Feature on = one.patches.contact(rows.patch[k]);
    const auto R = rotation_by(rows.chart[k], tau);
    const auto place = [&](const Feature& helix) {
        const Vec<double> a{scene.robot.x[helix.robot], scene.robot.y[helix.robot]};
        return Vec<double>{scene.obstacles.x[helix.obstacle], scene.obstacles.y[helix.obstacle]} - R(a);
    };
    const auto P = place(end_helix(scene, on, 0)), U = place(end_helix(scene, on, 1)) - P;
    const auto at = [&](double t) { return Vec<double>{P.x + t * U.x, P.y + t * U.y}; };
    return {at(value(k, rows.lower[k], tau)), at(value(k, rows.upper[k], tau))};
}

// Whether another trapezoid's side may be on the curve of a side of this one.
bool SurfaceExplorer::State::shares_curve(Index k, bool upper, Index other) const {
    if (rows.chart[k] != rows.chart[other]) return false;
    const double from = std::max(rows.from_lo[k], rows.from_lo[other]), to = std::min(rows.to_hi[k], rows.to_hi[other]);
    if (from > to) return false;
    const double tau = 0.5 * (from + to);
    const Vec<double> p = ends(k, tau)[upper];
    const Ends q = ends(other, tau);
    return apart(p, q[0]) <= nearness || apart(p, q[1]) <= nearness;
}

// Whether another trapezoid begins or ends on the line where this one does, beside it.
bool SurfaceExplorer::State::shares_level(Index k, bool last, Index other) const {
    const double tau = last ? rows.tau_to(k) : rows.tau_from(k);
    const bool is_chart_end = std::abs(tau) == 1;
    if (rows.chart[k] != rows.chart[other] && !is_chart_end) return false;
    const double there = rows.chart[k] == rows.chart[other] ? tau : -tau;
    constexpr double same_angle = 1e-9;
    if (std::abs(rows.tau_from(other) - there) > same_angle && std::abs(rows.tau_to(other) - there) > same_angle) return false;
    const Ends p = ends(k, tau), q = ends(other, there);
    const Vec<double> U = p[1] - p[0];
    const double length = std::hypot(U.x, U.y);
    if (length <= nearness) return apart(p[0], q[0]) <= nearness || apart(p[0], q[1]) <= nearness;
    for (const auto& x : q)
        if (std::abs(cross(U, x - p[0])) > nearness * length) return false;
    double low = dot(U, q[0] - p[0]), high = dot(U, q[1] - p[0]);
    if (low > high) std::swap(low, high);
    return low < length * (length - nearness) && high > nearness * length;
}

void SurfaceExplorer::State::explore(Index k, std::vector<Index>& found) {
    const Surface on = surface_of(one.patches, rows, k);
    const double middle = 0.5 * (rows.tau_from(k) + rows.tau_to(k));
    std::vector<Index> patches;
    const auto look = [&](auto&& shares) {
        trim(patches);
        for (const Index patch : patches)
            for (Index other = faces_of[patch][0]; other < faces_of[patch][1]; ++other)
                if (other != k && !whole[other] && shares(other)) found.push_back(other);
        patches.clear();
    };
    for (const bool upper : {false, true}) {
        touching.on_curve(on, unpacked((upper ? rows.upper : rows.lower)[k]), middle, patches);
        look([&](Index other) { return shares_curve(k, upper, other); });
    }
    for (const bool last : {false, true}) {
        const auto& [lo, hi] = last ? std::pair{rows.to_lo[k], rows.to_hi[k]} : std::pair{rows.from_lo[k], rows.from_hi[k]};
        touching.on_line(on, lo, hi, patches);
        look([&](Index other) { return shares_level(k, last, other); });
    }
    whole[k] = 1;
}

SurfaceExplorer::SurfaceExplorer(std::shared_ptr<const Scene> scene, bool regularized)
    : state(std::make_unique<State>(std::move(scene), regularized)) {}
SurfaceExplorer::~SurfaceExplorer() = default;

std::size_t SurfaceExplorer::trimmed_patches() const {
    return static_cast<std::size_t>(std::count(state->trimmed.begin(), state->trimmed.end(), 1));
}

std::optional<Index> SurfaceExplorer::trapezoid_at(const Feature& contact, const ExactPose& pose) {
    std::vector<Index> patches;
    state->touching.at_pose(contact, pose, patches);
    const Code own = code(state->scene, contact);
    for (const Index patch : patches)
        if (code(state->scene, state->one.patches.contact(patch)) != own) return {};
    state->trim(patches);
    const SharedBoundary boundary = state->boundary();
    const auto seen = PointLocation(boundary, std::vector<Index>(boundary->trapezoids.size(), 0)).nearby(pose);
    if (seen.on.size() != 1 || seen.end[0] != 0) return {};
    return seen.on[0];
}

std::shared_ptr<const CellComplex> SurfaceExplorer::grow(Index seed, Index most) {
    State& s = *state;
    auto& queue = s.growing.try_emplace(seed, 1, seed).first->second;
    for (std::size_t next = 0;; ++next) {
        heed_stop();
        if (next == queue.size()) {
            GluedPart part = glue_part(s.boundary(), s.whole, {seed});
            if (part.complex) return part.complex;
            queue = std::move(part.missing), next = 0;
        }
        if (s.whole[queue[next]]) continue;
        if (most-- == 0) {
            queue.erase(queue.begin(), queue.begin() + static_cast<std::ptrdiff_t>(next));
            return nullptr;
        }
        s.explore(queue[next], queue);
    }
}

}  // namespace cfree
