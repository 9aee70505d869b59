// Slides along the point where two lines of contact meet, as the robot turns: common factors are divided out, where they coincide at first.
#include "cfree/planning/contact_slide.hpp"

#include <algorithm>

#include "cfree/planning/moving_line.hpp"

namespace cfree {

namespace {

constexpr int degree = 4;  // degree of slides

bool touches(const Scene& scene, const Feature& contact) {
    const Index i = contact.robot, j = contact.obstacle;
    const Shape &A = scene.robot, &O = scene.obstacles;
    if (i >= A.ring_vertices || j >= O.ring_vertices) return false;
    return A.emit[i] && O.emit[j] && A.layer[i] == O.layer[j];  // bounds apply only to the reference point
}

// Bernstein coefficients for t from 0 to tau, times a positive number: they bound the polynomial.
std::vector<Int> control_points(const Poly& f, const Ratio& tau) {
    constexpr int common = 60;  // common multiple of the binomial coefficients up to those of 6
    const int n = std::max(f.size() - 1, 0);
    std::vector<Int> binomial(static_cast<std::size_t>(n) + 1, 1), result(binomial.size(), 0);
    for (int k = 1; k <= n; ++k) binomial[k] = binomial[k - 1] * (n - k + 1) / k;
    Int below = 1, above = 1;
    for (int k = 0; k < n; ++k) below *= tau.d;
    for (int k = 0; k < f.size(); ++k) {
        const Int term = f[k] * above * below * (common / binomial[k]);
        Int ways = 1;  // i over k
        for (int i = k; i <= n; ++i) {
            result[i] += ways * term;
            ways = ways * (i + 1) / (i + 1 - k);
        }
        above *= tau.n, below /= tau.d;
    }
    return result;
}
Int least(const Poly& f, const Ratio& tau) {
    const auto points = control_points(f, tau);
    return *std::min_element(points.begin(), points.end());
}

Poly scaled(Poly f, const Int& by) {
    for (Int& c : f) c *= by;
    f.trim();
    return f;
}

// True if a quotient is certainly between 0 and 1.
bool is_within_edge(const Poly& share, const Poly& whole, const Ratio& tau) {
    std::array<Poly, 2> parts{share, whole};
    cancel(parts);
    const Int sign = parts[1][0].sign();
    const Poly s = scaled(parts[0], sign), w = scaled(parts[1], sign);
    return least(w, tau) > 0 && least(s, tau) >= 0 && least(difference(w, s), tau) >= 0;
}

std::array<Int, degree + 1> five(const Poly& f) {
    std::array<Int, degree + 1> result;
    std::copy(f.begin(), f.end(), result.begin());
    return result;
}

// f(n / r) r^4
Int value_at(const std::array<Int, degree + 1>& f, const Ratio& at) {
    Int value = 0, power = 1;
    for (int k = degree; k >= 0; --k, power *= at.d) value = value * at.n + f[k] * power;
    return value;
}

}  // namespace

Slide ContactSlide::motion(const Scene& scene) const {
    const auto r = from.half.rotation();
    Slide s{r.c, r.s, r.w, tau.d, tau.n, {}, {}, {}};
    const Int unit = lcm(from.x.d, from.y.d);
    const Int X = from.x.n * (unit / from.x.d), Y = from.y.n * (unit / from.y.d), sign = d[0].sign();
    Int power = sign;  // power of tau
    for (int k = 0; k <= degree; ++k, power *= tau.n) {
        Int by = power;
        for (int i = k; i < degree; ++i) by *= tau.d;
        s.x[k] = by * scene.scale * (X * d[k] + unit * x[k]);
        s.y[k] = by * scene.scale * (Y * d[k] + unit * y[k]);
        s.d[k] = by * unit * d[k];
    }
    return s;
}

std::optional<ContactSlide> slide_along(const Scene& scene, const RationalPose& pose, const Feature& first, const Feature& last,
                                        const Ratio& tau) {
    if (!touches(scene, first) || !touches(scene, last)) return {};
    const auto rotation = pose.half.rotation();
    const MovingLine one(ContactLine<Int>(scene, first, CoreUnits<Int>{}), rotation);
    const MovingLine two(ContactLine<Int>(scene, last, CoreUnits<Int>{}), rotation);
    const Poly across = cross(one.U, two.U);
    if (across.empty()) return {};
    // P + s U = Q + r V, s = (Q - P) x V / U x V and r = (Q - P) x U / U x V
    const auto between = difference(two.P, one.P);
    const Poly along = cross(between, two.U);
    if (!is_within_edge(along, across, tau) || !is_within_edge(cross(between, one.U), across, tau)) return {};
    // all over the scene's scale, and the unit of the pose
    const Int unit = lcm(pose.x.d, pose.y.d);
    const Poly whole = product(across, {rotation.w, 0, rotation.w}), d = scaled(whole, scene.scale * unit);
    const auto moved = [&](int k, const Ratio& from) {
        const Poly at = sum(product(one.P[k], across), product(along, one.U[k]));
        return difference(scaled(at, unit), scaled(whole, scene.scale * from.n * (unit / from.d)));
    };
    std::array<Poly, 3> parts{moved(0, pose.x), moved(1, pose.y), d};
    cancel(parts);
    for (const Poly& f : parts)
        if (f.size() > degree + 1) return {};
    const auto begins_elsewhere = [](const Poly& f) { return !f.empty() && !f[0].is_zero(); };
    if (begins_elsewhere(parts[0]) || begins_elsewhere(parts[1])) return {};
    Poly positive = scaled(parts[2], parts[2][0].sign());
    if (positive.empty()) return {};
    positive.resize(degree + 1);
    if (least(positive, tau) <= 0) return {};
    ContactSlide slide{pose, {}, {first, last}, five(parts[0]), five(parts[1]), five(parts[2]), tau};
    const Int end = value_at(slide.d, tau);
    slide.to = {pose.x + reduced(value_at(slide.x, tau), end), pose.y + reduced(value_at(slide.y, tau), end),
                pose.half.turned(tau.d, tau.n)};
    return slide;
}

std::optional<ContactSlide> free_slide(const Scene& scene, const MotionChecker& checker, const RationalPose& from,
                                       const RationalPose& to, const Feature& contact, const Feature& curve) {
    const HalfAngle turn = to.half.turned(from.half.q, -from.half.p);
    if (turn.q.is_zero() || turn.p.is_zero()) return {};
    const Ratio tau{turn.p, turn.q};
    const bool on_edge = curve.kind == Kind::vertex_edge;
    const Shape& shape = on_edge ? scene.obstacles : scene.robot;
    const Index edge = on_edge ? curve.obstacle : curve.robot;
    const Shape& others = on_edge ? scene.robot : scene.obstacles;
    const Index vertex = on_edge ? curve.robot : curve.obstacle;
    // curves have one name for all coinciding features: a vertex of the robot may stand for the reference point
    for (Index e = 0; e < shape.ring_vertices; ++e) {
        if (shape.line[e] != shape.line[edge]) continue;
        for (Index v = 0; v < others.ring_vertices; ++v) {
            if (others.point[v] != others.point[vertex] || others.layer[v] != shape.layer[e]) continue;
            auto found = slide_along(scene, from, contact, on_edge ? Feature{curve.kind, v, e} : Feature{curve.kind, e, v}, tau);
            if (found && found->to == to && checker.is_free(found->motion(scene))) return found;
        }
    }
    return {};
}

void FoundSlides::add(ContactSlide slide) {
    const std::lock_guard guard(lock);
    std::pair ends{slide.from.key(), slide.to.key()};
    found.insert_or_assign(std::move(ends), std::move(slide));
}

std::vector<ContactSlide> FoundSlides::along(const std::vector<RationalPose>& way) const {
    const std::lock_guard guard(lock);
    std::vector<ContactSlide> result;
    for (std::size_t k = 1; k < way.size() && !found.empty(); ++k) {
        auto it = found.find({way[k].key(), way[k - 1].key()});
        if (it == found.end()) it = found.find({way[k - 1].key(), way[k].key()});
        if (it != found.end()) result.push_back(it->second);
    }
    return result;
}

}  // namespace cfree
