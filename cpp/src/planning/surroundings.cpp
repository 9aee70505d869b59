// Rays from poses to closed surfaces, exact; theory, "One surface alone".
#include "cfree/planning/surroundings.hpp"

#include <algorithm>
#include <array>

#include "cfree/contact/contact_line.hpp"
#include "cfree/search/configuration.hpp"
#include "cfree/support/lookout.hpp"
#include "forbidden/kept_patches.hpp"

namespace cfree {

namespace {

constexpr Index alike = 128;       // steps up to this are the same around both: small surfaces cost little
constexpr double most_slower = 4;  // the pose that reaches more may be in the smaller cell all the same
constexpr int most_attempts = 48;  // places near a pose, closer and closer, from which rays are tried

Int largest(const std::vector<Int>& X, const std::vector<Int>& Y) {
    Int result = 0;
    for (const auto* numbers : {&X, &Y})
        for (const Int& n : *numbers) result = std::max(result, Int(abs(n)));
    return result;
}

}  // namespace

Surroundings::Surroundings(std::shared_ptr<const Scene> s, std::shared_ptr<const MotionChecker> by, bool regularized)
    : scene(std::move(s)), checker(std::move(by)), has_slits(regularized), explorer(scene, regularized) {
    const Shape &A = scene->robot, &O = scene->obstacles;
    const auto [x0, x1] = std::minmax_element(A.X.begin(), A.X.end());
    const auto [y0, y1] = std::minmax_element(A.Y.begin(), A.Y.end());
    size = std::max({Int(*x1 - *x0), Int(*y1 - *y0), Int(1)}), radius = std::max(largest(A.X, A.Y), size);
    left = O.X.empty() ? Int(0) : *std::min_element(O.X.begin(), O.X.end());
}

Surroundings::Search Surroundings::search(const ExactPose& pose) const {
    Search result;
    result.pose = result.from = result.at = pose;
    return result;
}

bool Surroundings::start_again(Search& s) const {
    constexpr std::array<std::array<int, 3>, 8> ways{
        {{3, 1, 1}, {-1, 3, -1}, {-3, -1, 1}, {1, -3, -1}, {-2, 3, 1}, {2, -3, 1}, {3, 2, -1}, {-3, -2, -1}}};
    const auto pose = RationalPose::of(s.pose, *scene);
    while (++s.attempt < most_attempts) {
        const auto [dx, dy, turn] = ways[s.attempt % 8];
        const unsigned bits = 6 + static_cast<unsigned>(s.attempt);
        const Ratio step = reduced(size, Int(scene->scale << bits));
        const RationalPose near{pose.x + Ratio{dx} * step, pose.y + Ratio{dy} * step, pose.half.turned(Int(radius << bits), Int(turn * size))};
        if (!checker->is_free(motion_between(pose.configuration(*scene), near.configuration(*scene)))) continue;
        s.from = s.at = near.exact(*scene);
        s.passed.clear(), s.seed = -1;
        return true;
    }
    return false;
}

// Find the first surface that the ray meets, and store a trapezoid of it.
Surroundings::Met Surroundings::meet(Search& s) {
    const ExactPose& q = s.at;
    const Int length = q.X - far_left() * q.W;  // over W
    if (length <= 0) return Met::nothing;
    Motion ray;
    const auto turn = rotation_by(q.chart, q.p, q.r);
    ray.c = turn.c, ray.s = turn.s, ray.w = turn.w, ray.x = q.X, ray.y = q.Y, ray.unit = q.W;
    ray.turns = false, ray.vx = -length, ray.vy = 0, ray.start = ray.q = 1, ray.p = 0;
    const auto hit = checker->first_collision(ray);
    if (!hit) return Met::nothing;
    if (hit->kind == 0) return Met::unclear;
    const Int zero = hit->at.p[0], slope = hit->at.p[1];  // at u = - zero / slope
    s.contact = {q.X * slope + length * zero, q.Y * slope, q.W * slope, q.chart, q.p, q.r};
    if (s.contact.W < 0) s.contact.X = -s.contact.X, s.contact.Y = -s.contact.Y, s.contact.W = -s.contact.W;
    const Shape& O = scene->obstacles;
    const auto seed = explorer.trapezoid_at(s.contact, O.piece_vertex[O.piece[hit->obstacle_piece]]);
    if (!seed) return Met::unclear;
    s.seed = *seed;
    return Met::surface;
}

// Known surface with a contact, if there is one.
Index Surroundings::known_at(const ExactPose& contact) const {
    for (Index k = 0; k < static_cast<Index>(surfaces.size()); ++k)
        if (!surfaces[k].rays->nearby(contact).on.empty()) return k;
    return -1;
}

// Go on behind a surface that is no outer boundary; false if a crossing of the ray with it is unclear.
bool Surroundings::pass(Search& s, Index surface) const {
    const auto seen = surfaces[surface].rays->nearby(s.from);
    if (!seen.generic || !seen.on.empty()) return false;
    if (seen.crossed.size() % 2 != 0) {
        s.ended = true, s.surface = surface;
        return true;
    }
    const auto at = beyond(s, surfaces[surface], seen.crossed);
    if (!at) return false;
    s.passed.push_back({surfaces[surface].complex, s.contact, *at});
    s.at = *at;
    return true;
}

// Leftmost of the places at which the ray crosses trapezoids.
std::optional<ExactPose> Surroundings::beyond(const Search& s, const Known& surface, const std::vector<Index>& crossed) const {
    const ExactPose& q = s.from;
    const auto R = rotation_by(q.chart, q.p, q.r);
    const Boundary& boundary = *surface.complex->boundary;
    std::optional<ExactPose> result;
    for (const Index k : crossed) {
        const ContactLine<Int> line(*scene, boundary.patches.contact(boundary.trapezoids.patch[k]), CoreUnits<Int>{});
        const auto P = line.start(R), U = line.direction(R);  // times R.w
        if (U.y.is_zero()) return {};
        ExactPose x = q;  // at P + t U, t = (Y / W - P.y) / U.y
        const Int by = R.w * U.y;
        x.X = P.x * q.W * U.y + (q.Y * R.w - P.y * q.W) * U.x, x.Y = q.Y * by, x.W = q.W * by;
        if (x.W < 0) x.X = -x.X, x.Y = -x.Y, x.W = -x.W;
        if (!result || x.X * result->W < result->X * x.W) result = x;
    }
    return result;
}

std::shared_ptr<const CellComplex> Surroundings::advance(Search& s, Index most, Index target) {
    while (!s.ended) {
        bool clear = true;
        if (s.seed < 0) {
            const Met met = meet(s);
            if (met == Met::nothing) {
                s.ended = true, s.failed = scene->is_bounded;
                return nullptr;
            }
            clear = met == Met::surface;
        }
        if (clear) {
            Index known = known_at(s.contact);
            if (known < 0) {
                const auto grown = explorer.grow(s.seed, most, target);
                if (!grown.complex) return nullptr;
                if (!grown.is_closed) return grown.complex;
                keep(grown.complex);
                known = static_cast<Index>(surfaces.size()) - 1;
            }
            clear = pass(s, known);
        }
        s.seed = -1;
        if (!clear && !start_again(s)) s.ended = s.failed = true;
    }
    return nullptr;
}

void Surroundings::keep(std::shared_ptr<const CellComplex> closed) {
    std::vector<Index> one(closed->component.size(), 0);
    auto rays = std::make_unique<const PointLocation>(closed->boundary, std::move(one));
    surfaces.push_back({std::move(closed), std::move(rays)});
}

// Patches that are the same have the same parts; a closed surface of such patches alone is closed here, as no other touches them.
void Surroundings::take(const Surroundings& other) {
    const Scene &before = *other.scene, &now = *scene;
    // integers may have decided the last digits of angles, and places are measured in the frame
    if (has_slits || other.has_slits || before.scale != now.scale || before.shift != now.shift || before.frame != now.frame) return;
    const auto kept = kept_features(before.near(), now.near());
    if (!kept) return;
    explorer.take(other.explorer, *kept);
    for (const Known& known : other.surfaces)
        if (auto closed = explorer.taken(*known.complex, *kept)) keep(std::move(closed));
}

std::optional<bool> Surroundings::is_around(Index surface, const Search& search) const {
    const auto seen = surfaces[surface].rays->nearby(search.from);
    if (!seen.on.empty()) return {};
    return seen.crossed.size() % 2 != 0;
}

// --- two poses ---

Connecting::Connecting(std::shared_ptr<Surroundings> of, const RationalPose& start, const RationalPose& goal)
    : around(std::move(of)), ends{around->search(start.exact(*around->scene)), around->search(goal.exact(*around->scene))} {
    around->begin();
    result.start = start, result.goal = goal;
}

void Connecting::compare_cells(const std::array<std::size_t, 2>& reached) {
    for (const int k : {0, 1}) {
        const double ratio = static_cast<double>(reached[k]) / static_cast<double>(reached[1 - k]);
        slower[k] = std::clamp(ratio * ratio, 1.0, most_slower);
    }
}

void Connecting::run(Index most) {
    for (const int k : {0, 1})
        if (result.verdict == Connection::Verdict::open) look(k, most <= alike ? most : static_cast<Index>(most / slower[k]));
    const bool is_over = ends[0].failed || ends[1].failed || (ends[0].ended && ends[1].ended);
    if (is_over && result.verdict == Connection::Verdict::open) result.verdict = Connection::Verdict::unclear;
}

Connection::Verdict Connecting::decide(const std::function<bool(Index most)>& go_on) {
    for (Index most = first_step;; most = std::min(2 * most, last_step)) {
        run(most);
        if (result.verdict != Connection::Verdict::open || (go_on && !go_on(most))) return result.verdict;
        heed_stop();
    }
}

void Connecting::look(int k, Index most) {
    auto &one = ends[k], &other = ends[1 - k];
    if (const auto common = around->advance(one, most, other.seed)) return join(common);
    if (one.failed || !one.ended) return;
    if (other.ended && !other.failed && one.surface == other.surface)
        return join(one.surface < 0 ? nullptr : around->surface(one.surface));
    if (one.surface < 0) return;
    const auto holds = around->is_around(one.surface, other);
    if (!holds && !around->start_again(other)) other.ended = other.failed = true;
    if (holds && !*holds)
        result.verdict = Connection::Verdict::apart, result.surface = around->surface(one.surface), result.inside = k;
}

// Join over islands, then over a surface or far away, then over other islands.
void Connecting::join(const std::shared_ptr<const CellComplex>& common) {
    result.verdict = Connection::Verdict::joined;
    result.near_start = ends[0].from, result.near_goal = ends[1].from;
    result.stretches = ends[0].passed, result.before = result.stretches.size(), result.is_far = !common;
    if (common) result.stretches.push_back({common, ends[0].contact, ends[1].contact});
    for (auto x = ends[1].passed.rbegin(); x != ends[1].passed.rend(); ++x)
        result.stretches.push_back({x->surface, x->leave, x->enter});
}

}  // namespace cfree
