// Exact rays from poses: trees of heights find the trapezoids that they may cross, signs decide; theory, "Cells".
#include "cfree/free/point_location.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "cfree/contact/contact_line.hpp"
#include "free/lines.hpp"
#include "predicates/form.hpp"
#include "support/parallel.hpp"

namespace cfree {

namespace {

// Bound of the roundings in any sign below: at most 40 in a row.
constexpr double sign_error = 128 * u;

}  // namespace

struct PointLocation::View {
    const ExactPose* pose;
    double tau_lo, tau_hi;  // around p / r
    Evaluation turn;
    Vec<Approx> place;
    View(const ExactPose& q, int shift) : pose(&q) {
        const double tau = ratio(q.p, q.r);
        const Dyadic d = Dyadic::from(tau);
        const bool exact = d.n * q.r == q.p << d.k;
        constexpr double infinity = std::numeric_limits<double>::infinity();
        tau_lo = exact ? tau : std::nextafter(std::nextafter(tau, -infinity), -infinity);
        tau_hi = exact ? tau : std::nextafter(std::nextafter(tau, infinity), infinity);
        const double k = (q.chart ? -1 : 1) / (1 + tau * tau);
        turn = {{(1 - tau * tau) * k, 1}, {2 * tau * k, 1}};
        const Int W = q.W << static_cast<unsigned>(shift);
        const double x = ratio(q.X, W), y = ratio(q.Y, W);
        place = {{x, std::abs(x)}, {y, std::abs(y)}};
    }
    template <class T>
    Line<T> line(const Scene& scene, const Feature& contact) const {
        if constexpr (std::is_same_v<T, Int>) return {scene, contact, {pose->X, pose->Y}, pose->W};
        else return {scene, contact, place, {1, 1}};
    }
    template <class T>
    auto expansion() const {
        if constexpr (std::is_same_v<T, Int>) return Expansion{pose->chart};
        else return turn;
    }
    // Sign of the value that `question` computes in either number type.
    template <class Question>
    int sign(When when, Question&& question) const {
        const Approx quick = question.template operator()<Approx>();
        if (std::abs(quick.v) > sign_error * quick.m + tiny) return quick.v > 0 ? 1 : -1;
        const Poly exact = question.template operator()<Int>();
        return when == When::after ? leading(exact, pose->p, pose->r).sign : value_at(exact, pose->p, pose->r).sign();
    }
};

struct PointLocation::Probe {
    ExactPose pose;
    int rise;  // sign of U_y of the segment that contains it, of U_x if that is 0
    bool is_level;
};

PointLocation::PointLocation(SharedBoundary b, std::vector<Index> of)
    : boundary(std::move(b)), scene(*boundary->scene), patches(boundary->patches), trapezoids(boundary->trapezoids),
      component(std::move(of)), index(trapezoids.chart, trapezoids.from_lo, trapezoids.to_hi, 1),
      parts(std::make_unique<Part[]>(static_cast<std::size_t>(index.count()))) {}

std::span<const PointLocation::Extent> PointLocation::tree(Index part) const {
    Part& own = parts[static_cast<std::size_t>(part)];
    auto& extents = own.extents;
    std::call_once(own.once, [&] {
        const auto members = index.at(part);
        extents.reserve(members.size());
        for (const Index k : members) extents.push_back(extent(k, index.from(part), index.to(part)));
        std::sort(extents.begin(), extents.end(), [](const Extent& x, const Extent& y) {
            return x.low < y.low || (x.low == y.low && x.trapezoid < y.trapezoid);
        });
        plant(extents);
    });
    return extents;
}

// Extent of segments: their ends move on circles, and rise above their heights at both ends of an arc by at most its sagitta.
PointLocation::Extent PointLocation::extent(Index k, double from, double to) const {
    if (scene.is_round) return extent_among_grown(k, from, to);
    constexpr double rounding = 0x1p-40;
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Feature contact = surface_of(patches, trapezoids, k).contact;
    const bool on_edge = contact.kind == Kind::vertex_edge;
    const auto turn = [&](double tau) {
        const auto R = rotation_by(trapezoids.chart[k], tau);
        return Vec<double>{R.c, R.s};
    };
    const auto first = turn(std::max(from, trapezoids.from_lo[k])), last = turn(std::min(to, trapezoids.to_hi[k]));
    const double sagitta = 1 - std::sqrt(std::max(0.0, 0.5 + 0.5 * dot(first, last)));
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Extent result{infinity, -infinity, infinity, 0, k};
    for (const bool is_end : {false, true}) {
        const Index i = on_edge ? contact.robot : (is_end ? A.w : A.v)[contact.robot];
        const Index j = on_edge ? (is_end ? O.w : O.v)[contact.obstacle] : contact.obstacle;
        const Vec<double> a{A.x[i], A.y[i]}, b{O.x[j], O.y[j]};
        const double size = std::abs(a.x) + std::abs(a.y);
        const double slack = sagitta * size + rounding * (size + std::abs(b.x) + std::abs(b.y)) + tiny;
        for (const auto& r : {first, last}) {
            const double x = b.x - dot(Vec<double>{r.x, -r.y}, a), y = b.y - dot(Vec<double>{r.y, r.x}, a);
            result.low = std::min(result.low, y - slack), result.high = std::max(result.high, y + slack);
            result.left = std::min(result.left, x - slack);
        }
    }
    return result;
}

double PointLocation::plant(std::span<Extent> extents) {
    if (extents.empty()) return -std::numeric_limits<double>::infinity();
    const std::size_t middle = extents.size() / 2;
    Extent& x = extents[middle];
    return x.top = std::max({x.high, plant(extents.first(middle)), plant(extents.subspan(middle + 1))});
}

std::array<Dyadic, 2> PointLocation::angle(Index k, bool last, unsigned bits) const {
    const auto critical = last ? angle_to(patches, trapezoids, k) : angle_from(patches, trapezoids, k);
    if (critical.is_chart_end()) return {Dyadic::from(critical.lo), Dyadic::from(critical.lo)};
    const auto narrowed = [&](auto x) -> std::array<Dyadic, 2> {
        const Dyadic widest{1, bits};
        const auto width = [&] { return Dyadic{(x.hi.n << x.lo.k) - (x.lo.n << x.hi.k), x.lo.k + x.hi.k}; };
        while (!x.is_dyadic() && cfree::compare(width(), widest) > 0) x.halve();
        return {x.lo, x.hi};
    };
    return scene.is_round ? narrowed(critical.exact_among_grown(scene)) : narrowed(critical.exact(scene));
}

// Sign of an angle of a trapezoid minus that of the pose, of one chart.
int PointLocation::order(bool of_end, Index k, const View& q) const {
    const double lo = of_end ? trapezoids.to_lo[k] : trapezoids.from_lo[k];
    const double hi = of_end ? trapezoids.to_hi[k] : trapezoids.from_hi[k];
    if (hi < q.tau_lo) return -1;
    if (lo > q.tau_hi) return 1;
    if (lo == hi && q.tau_lo == q.tau_hi) return 0;
    RealRoot root = (of_end ? angle_to(patches, trapezoids, k) : angle_from(patches, trapezoids, k)).exact(scene);
    return sign_at(Poly{-q.pose->p, q.pose->r}, root);
}

bool PointLocation::may_be_on(const Feature& contact, const View& q) const {
    const Approx side = q.turn(q.line<Approx>(scene, contact).side());
    return !(std::abs(side.v) > sign_error * side.m + tiny);
}

// True if a pose on its line is within the limits of a trapezoid. If a curve ends at a pole of N / D, its limit counts.
bool PointLocation::is_on(Index k, const View& q, bool is_end) const {
    const Feature contact = surface_of(patches, trapezoids, k).contact;
    const auto line = q.line<Int>(scene, contact);
    const auto expand = q.expansion<Int>();
    if (!value_at(expand(line.side()), q.pose->p, q.pose->r).is_zero()) return false;
    const auto beyond = [&](std::uint64_t curve) {  // sign of t minus the curve's
        const auto [N, D] = Predicates::curve_trig<Int>(scene, contact, unpacked(curve));
        const Poly denominator = expand(D);
        const auto f = leading(two_products(expand(line.along()), denominator, expand(N), expand(line.length())),
                               q.pose->p, q.pose->r);
        const auto d = leading(denominator, q.pose->p, q.pose->r);
        if (f.order < 0 || f.order > d.order) return 0;
        return f.sign * d.sign * (is_end && (f.order - d.order) % 2 != 0 ? -1 : 1);
    };
    return beyond(trapezoids.lower[k]) >= 0 && beyond(trapezoids.upper[k]) <= 0;
}

namespace {

// Ranges of p and p - q, and a bound of their errors.
struct Spread {
    double low, high, err;
};
Spread spread(Approx p, Approx q) {
    const Approx other = p - q;
    return {std::min(p.v, other.v), std::max(p.v, other.v), sign_error * other.m + tiny};
}

}  // namespace

PointLocation::Nearby PointLocation::look(const View& q, When when, Index own, By by) const {
    Nearby seen;
    const Index part = index.part_of(q.pose->chart, 0.5 * (q.tau_lo + q.tau_hi));
    const auto look_at = [&](Index k) {
        heed_stop();
        if (trapezoids.from_lo[k] > q.tau_hi || trapezoids.to_hi[k] < q.tau_lo) return;
        const Feature contact = surface_of(patches, trapezoids, k).contact;
        const auto here = q.line<Approx>(scene, contact);
        const auto [low, high, err] = spread(q.turn(here.height()), q.turn(here.down()));
        const auto [left, right, error] = spread(q.turn(here.distance()), q.turn(here.back()));
        if (low > err || high < -err || left > error) return;  // above, below or right of the pose
        const int from = order(false, k, q), to = order(true, k, q);
        if (from > 0 || to < 0) return;
        if (from == 0 || to == 0) seen.generic = false;
        if (k == own) return;
        if (may_be_on(contact, q) && is_on(k, q, to == 0)) {
            seen.on.push_back(k), seen.end.push_back(from == 0 ? -1 : to == 0 ? 1 : 0);
            return;
        }
        if (to == 0) return;  // it ends here
        const int side = q.sign(when, [&]<class T>() { return q.expansion<T>()(q.line<T>(scene, contact).side()); });
        const auto is_above = [&](std::uint64_t code) {  // P_y + t U_y > 0, t = N / D
            const Feature f = unpacked(code);
            const int d = q.sign(when, [&]<class T>() { return q.expansion<T>()(Predicates::curve_trig<T>(scene, contact, f)[1]); });
            return d * q.sign(when, [&]<class T>() {
                const auto line = q.line<T>(scene, contact);
                const auto expand = q.expansion<T>();
                const auto [N, D] = Predicates::curve_trig<T>(scene, contact, f);
                return two_products(expand(line.height()), expand(D), expand(N), expand(line.down()));
            }) > 0;
        };
        const bool begins_above = is_above(trapezoids.lower[k]), ends_above = is_above(trapezoids.upper[k]);
        if (begins_above != ends_above && side == (ends_above ? -1 : 1)) seen.crossed.push_back(k);
    };
    if (by == By::tree) {
        stab(tree(part), q.place.x.v, q.place.y.v, look_at);
    } else {
        const auto members = index.at(part);
        std::for_each(members.begin(), members.end(), look_at);
    }
    return seen;
}

// Find trapezoids that hold the pose, and end there.
void PointLocation::look_on(const View& q, Nearby& seen) const {
    const Index part = index.part_of(q.pose->chart, 1);
    stab(tree(part), q.place.x.v, q.place.y.v, [&](Index k) {
        if (trapezoids.to_hi[k] < q.tau_lo || order(true, k, q) != 0) return;
        if (may_be_on(surface_of(patches, trapezoids, k).contact, q) && is_on(k, q, true))
            seen.on.push_back(k), seen.end.push_back(1);
    });
}

// A pose on a trapezoid, strictly between its angles and its curves.
std::optional<PointLocation::Probe> PointLocation::probe(Index k, int attempt) const {
    const Surface surface = surface_of(patches, trapezoids, k);
    Predicates predicates(scene, surface);
    const Event from = angle_from(patches, trapezoids, k).event(predicates), to = angle_to(patches, trapezoids, k).event(predicates);
    const Dyadic tau = predicates.between(from, to, attempt).exact();
    const Int p = tau.n, r = Int(1) << tau.k;
    const Rotation<Int> R = rotation_by(surface.chart, p, r);
    const auto curve = [&](std::uint64_t code) {
        const auto [N, D] = Predicates::curve_trig<Int>(scene, surface.contact, unpacked(code));
        std::array<Int, 2> t{N.a * R.w + N.b * R.c + N.c * R.s, D.a * R.w + D.b * R.c + D.c * R.s};
        if (t[1] < 0) t = {-t[0], -t[1]};
        return t;
    };
    const auto low = curve(trapezoids.lower[k]), high = curve(trapezoids.upper[k]);
    if (low[1].is_zero() || high[1].is_zero() || low[0] * high[1] >= high[0] * low[1]) return {};
    for (unsigned bits = 2 + static_cast<unsigned>(attempt);; ++bits) {
        // the first multiple of 2^-bits above the lower end, which is at least 0; later ones if there are
        const Int m = ((low[0] << bits) / low[1]) + 1 + attempt % 3;
        if (m * high[1] >= high[0] << bits) continue;
        const ContactLine<Int> line(scene, surface.contact, CoreUnits<Int>{});
        const Vec<Int> P = line.start(R), U = line.direction(R);
        const Int one = Int(1) << bits;
        Probe result{{P.x * one + m * U.x, P.y * one + m * U.y, R.w * one, surface.chart, p, r}, U.y.sign(), U.y.is_zero()};
        if (result.is_level) result.rise = U.x.sign();
        return result;
    }
}

std::optional<std::pair<ExactPose, bool>> PointLocation::pose_on(Index k, int attempt) const {
    const auto q = probe(k, attempt);
    if (!q || q->is_level) return {};
    return std::pair(q->pose, q->rise < 0);
}

std::optional<std::vector<PointLocation::Passage>> PointLocation::passages(const ExactPose& q, Index own) const {
    const Nearby seen = look(View(q, scene.shift), When::at, own);
    if (!seen.generic || !seen.on.empty()) return {};
    const Rotation<Int> R = rotation_by(q.chart, q.p, q.r);
    std::vector<Passage> found;
    for (const Index k : seen.crossed) {
        const ContactLine<Int> line(scene, surface_of(patches, trapezoids, k).contact, CoreUnits<Int>{});
        const Vec<Int> P = line.start(R), U = line.direction(R);
        found.push_back({k, P.x * U.y * q.W + (q.Y * R.w - P.y * q.W) * U.x, U.y * q.W * R.w, U.y.sign() < 0});
    }
    return found;
}

std::vector<PointLocation::Ray> PointLocation::rays() const {
    if (scene.is_round) return rays_among_grown();
    const auto n = static_cast<Index>(component.size());
    const Index components = n ? *std::max_element(component.begin(), component.end()) + 1 : 0;
    std::vector<Index> widest(components, -1);
    const auto width = [&](Index k) { return trapezoids.to_lo[k] - trapezoids.from_hi[k]; };
    for (Index k = 0; k < n; ++k)
        if (Index& best = widest[component[k]]; best < 0 || width(k) > width(best)) best = k;
    std::vector<Ray> result;
    for (const Index k : widest) {
        heed_stop();
        for (int attempt = 0;; ++attempt) {
            if (attempt == Predicates::most_attempts) throw std::logic_error("no ray in general position");
            const auto q = probe(k, attempt);
            if (!q) continue;
            Nearby seen = look(View(q->pose, scene.shift), When::at, k, By::list);
            if (!seen.generic || !seen.on.empty()) continue;
            // the ray starts just left of the surface, or above it if it is level: forbidden if the surface rises
            result.push_back({q->pose, k, q->rise > 0, std::move(seen.crossed)});
            break;
        }
    }
    return result;
}

PointLocation::Nesting PointLocation::nesting() const {
    Nesting result;
    result.start.push_back(0);
    for (const Ray& ray : rays()) {
        const auto crossed = surfaces(ray.crossed);
        bool is_inside = false;
        for (std::size_t i = 0, j; i < crossed.size(); i = j) {
            for (j = i; j < crossed.size() && crossed[j] == crossed[i];) ++j;
            if ((j - i) % 2 == 0) continue;
            if (crossed[i] == component[ray.from]) is_inside = true;
            else result.around.push_back(crossed[i]);
        }
        result.free_inside.push_back(is_inside != ray.is_on_left);
        result.start.push_back(static_cast<Index>(result.around.size()));
    }
    return result;
}

ExactPose ExactPose::from(double x, double y, int chart, double tau, const Int& scale) {
    const auto parts = [](double value) {  // value = n 2^e
        int e;
        const double n = std::ldexp(std::frexp(value, &e), 53);
        return std::pair<Int, int>(n, e - 53);
    };
    const auto [m, e] = parts(x);
    const auto [n, f] = parts(y);
    const int low = std::min({e, f, 0});
    const Dyadic t = Dyadic::from(tau);
    return {scale * m << static_cast<unsigned>(e - low), scale * n << static_cast<unsigned>(f - low),
            Int(1) << static_cast<unsigned>(-low), chart, t.n, Int(1) << t.k};
}

void PointLocation::locate(const double* xy, const int* chart, const double* tau, std::size_t count, int threads,
                           const Cells& cells, Index* out) const {
    constexpr std::size_t chunk = 64;
    std::atomic<bool> stop = false;
    std::atomic<std::size_t> next = 0;
    in_parallel(threads, stop, [&] {
        for (std::size_t begin; (begin = next.fetch_add(chunk)) < count && !stop;)
            for (std::size_t k = begin; k < std::min(count, begin + chunk); ++k)
                heed_stop(), out[k] = locate(ExactPose::from(xy[2 * k], xy[2 * k + 1], chart[k], tau[k], scene.scale), cells);
    });
}

// Surfaces of trapezoids, in order.
std::vector<Index> PointLocation::surfaces(const std::vector<Index>& crossed) const {
    std::vector<Index> result;
    for (const Index k : crossed) result.push_back(component[k]);
    std::sort(result.begin(), result.end());
    return result;
}

PointLocation::Nearby PointLocation::nearby(const ExactPose& pose) const {
    ExactPose q = pose;
    if (q.p == q.r) q.chart = 1 - q.chart, q.p = -1, q.r = 1;
    if (scene.is_round) return nearby_among_grown(q);
    Nearby seen = look(View(q, scene.shift), When::after, -1);
    if (q.p == -q.r) {
        const ExactPose before{q.X, q.Y, q.W, 1 - q.chart, 1, 1};
        look_on(View(before, scene.shift), seen);
    }
    return seen;
}

std::vector<Index> PointLocation::at_height_of(const ExactPose& pose) const {
    const View q(pose, scene.shift);
    const Index part = index.part_of(pose.chart, q.tau_lo);
    std::vector<Index> found;
    stab(tree(part), q.place.x.v, q.place.y.v, [&](Index k) { found.push_back(k); });
    return found;
}

Index PointLocation::locate(const ExactPose& pose, const Cells& cells) const { return cells_at(pose, cells).front(); }

std::vector<Index> PointLocation::cells_at(const ExactPose& pose, const Cells& cells) const {
    const Nearby seen = nearby(pose);
    std::vector<Index> found;
    for (const Index k : seen.on) found.push_back(cells.cell[component[k]]);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    if (!found.empty()) return found;
    const auto crossed = surfaces(seen.crossed);
    Index deepest = -1;
    for (std::size_t i = 0, j; i < crossed.size(); i = j) {
        for (j = i; j < crossed.size() && crossed[j] == crossed[i];) ++j;
        const Index x = crossed[i];
        if ((j - i) % 2 == 1 && (deepest < 0 || cells.depth[x] > cells.depth[deepest])) deepest = x;
    }
    if (deepest < 0) return {cells.outside};
    return {cells.free_inside[deepest] ? cells.cell[deepest] : -1};
}

}  // namespace cfree
