// Whole translations and rotations among segments and arcs: doubles leave out what keeps its distance, then the contacts are
// isolated, and one pose between each two is decided; theory, "Segments and arcs".
#include "cfree/arcs/motion_checker.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "arcs/near_shape.hpp"
#include "arcs/overlap.hpp"
#include "arcs/vectors.hpp"
#include "cfree/exact/surd.hpp"
#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

constexpr int most_halvings = 12;
constexpr int most_looks = 256;  // pairs of shapes that doubles look at, along one motion
constexpr unsigned width_of_contact = 60;  // the parameter of a contact is in an interval of 2^-60

using Terms = std::array<Int, 3>;  // coefficients of powers of u


// The motion of a shape past another one. Points are seen from the pole, if it turns, and all of them times one integer. Then a
// point of the first shape is at (C + S J) a / W, or else at a + u v.
struct Course {
    bool turns;
    Vec<Int> by;
    Terms C, S, W;

    Course(const Motion& m, const Int& scale) : turns(m.turns), by{m.w * m.vx * scale, m.w * m.vy * scale}, C{1, 0, 0}, S{0, 0, 0}, W{1, 0, 0} {
        if (!turns) return;
        const Int &q0 = m.start, q1 = m.q - m.start, &p1 = m.p;
        C = {q0 * q0, 2 * q0 * q1, q1 * q1 - p1 * p1}, S = {0, 2 * q0 * p1, 2 * q1 * p1};
        W = {C[0], C[1], q1 * q1 + p1 * p1};
    }
    Terms mixed(const Int& c, const Int& s, const Int& w) const {
        Terms f;
        for (std::size_t k = 0; k < 3; ++k) f[k] = c * C[k] + s * S[k] + w * W[k];
        return f;
    }
    // W e x (point a - b), of a direction at rest; W g x (b - point a), of a direction g that moves with a; W |point a - b|^2.
    Terms beside(const Vec<Int>& e, const Vec<Int>& a, const Vec<Int>& b) const {
        if (!turns) return {cross(e, a - b), cross(e, by), 0};
        return mixed(cross(e, a), dot(e, a), -cross(e, b));
    }
    Terms beside_moving(const Vec<Int>& g, const Vec<Int>& a, const Vec<Int>& b) const {
        if (!turns) return {cross(g, b - a), -cross(g, by), 0};
        return mixed(cross(g, b), -dot(g, b), -cross(g, a));
    }
    Terms apart(const Vec<Int>& a, const Vec<Int>& b) const {
        if (!turns) return {square(a - b), 2 * dot(by, a - b), square(by)};
        return mixed(-2 * dot(a, b), -2 * cross(a, b), square(a) + square(b));
    }
    // Point a at n / d, and b, times the same integer; that integer.
    Int weight(const Ratio& u) const { return turns ? value(W, u) : u.d; }
    Vec<Int> placed(const Vec<Int>& a, const Ratio& u) const {
        if (!turns) return {a.x * u.d + by.x * u.n, a.y * u.d + by.y * u.n};
        const Int c = value(C, u), s = value(S, u);
        return {c * a.x - s * a.y, s * a.x + c * a.y};
    }
    static Int value(const Terms& f, const Ratio& u) { return (f[2] * u.n + f[1] * u.d) * u.n + f[0] * u.d * u.d; }
};

// The parameters in an interval at which two curves are exactly at a distance, or touch.
class Contacts {
public:
    Contacts(const Course& along, const Int& distance, const Ratio& from, const Ratio& to, std::vector<QuadraticRoot>& into)
        : course(along), rho(distance), lo(from), hi(to), roots(into) {}

    void add(const RoundEdge& a, const RoundEdge& b) {
        const Int square_of_rho = rho * rho;
        for (const auto* p : {&a.start, &a.end}) {
            if (rho.sign() > 0)
                for (const auto* q : {&b.start, &b.end}) equal(course.apart(*p, *q), RootSum(square_of_rho));
            if (b.turn == 0) offset(course.beside(b.end - b.start, *p, b.start), square(b.end - b.start));
            else circle(course.apart(*p, b.center), square(b.start - b.center));
        }
        for (const auto* q : {&b.start, &b.end})
            if (a.turn == 0) offset(course.beside_moving(a.end - a.start, a.start, *q), square(a.end - a.start));
            else circle(course.apart(a.center, *q), square(a.start - a.center));
        if (a.turn == 0 && b.turn != 0)
            tangent(course.beside_moving(a.end - a.start, a.start, b.center), square(a.end - a.start), square(b.start - b.center));
        if (a.turn != 0 && b.turn == 0)
            tangent(course.beside(b.end - b.start, a.center, b.start), square(b.end - b.start), square(a.start - a.center));
        if (a.turn != 0 && b.turn != 0) {
            const RootSum r = RootSum::root(square(a.start - a.center)), s = RootSum::root(square(b.start - b.center));
            const Terms f = course.apart(a.center, b.center);
            for (const RootSum& sum : {r + s, r - s})
                for (const RootSum& reach : either(sum, RootSum(rho))) equal(f, reach * reach);
        }
    }

private:
    std::vector<RootSum> either(const RootSum& x, const RootSum& y) const {
        if (rho.is_zero()) return {x};
        return {x + y, x - y};
    }
    void equal(const Terms& f, const RootSum& value) {
        QuadraticRoot::Terms g;
        for (std::size_t k = 0; k < 3; ++k) g[k] = RootSum(f[k]) - value * RootSum(course.W[k]);
        add_roots(g, lo, hi, roots);
    }
    void offset(const Terms& f, const Int& square_of_length) {
        if (rho.is_zero()) return equal(f, RootSum(0));
        const RootSum far = RootSum(rho) * RootSum::root(square_of_length);
        equal(f, far), equal(f, -far);
    }
    void circle(const Terms& f, const Int& square_of_radius) {
        for (const RootSum& reach : either(RootSum::root(square_of_radius), RootSum(rho))) equal(f, reach * reach);
    }
    void tangent(const Terms& f, const Int& square_of_length, const Int& square_of_radius) {
        const RootSum far = RootSum::root(square_of_length * square_of_radius);
        for (const RootSum& reach : either(far, RootSum(rho) * RootSum::root(square_of_length))) equal(f, reach), equal(f, -reach);
    }

    const Course& course;
    const Int& rho;
    const Ratio &lo, &hi;
    std::vector<QuadraticRoot>& roots;
};

// The motion in doubles, scaled.
class NearCourse {
public:
    NearCourse(const Motion& m, const NearScene& scene) : turns(m.turns) {
        const auto scaled = [&](const Int& n, const Int& d) {
            const int bits = bits_of(d);
            return ball(n, bits + scene.shift).hi / ball(d, bits).hi;
        };
        x = scaled(m.x, m.unit), y = scaled(m.y, m.unit), vx = scaled(m.vx, m.unit), vy = scaled(m.vy, m.unit);
        c = ratio(m.c, m.w), s = ratio(m.s, m.w);
        const int bits = std::max(bits_of(m.q), bits_of(m.p));
        start = ball(m.start, bits).hi, q = ball(m.q, bits).hi, p = ball(m.p, bits).hi;
        reach = turns ? norm(x - vx, y - vy) + scene.reach : norm(vx, vy);
        const double most = std::max({std::abs(x), std::abs(y), std::abs(x) + std::abs(vx), std::abs(y) + std::abs(vy), reach});
        is_known = most < 16;
    }
    struct At {
        double x, y, c, s;
    };
    At at(double u) const {
        if (!turns) return {x + u * vx, y + u * vy, c, s};
        const double h = (1 - u) * start + u * q, k = u * p, w = h * h + k * k, cu = (h - k) * (h + k) / w, su = 2 * h * k / w;
        const double dx = x - vx, dy = y - vy;
        return {vx + (cu * dx - su * dy), vy + (su * dx + cu * dy), cu * c - su * s, su * c + cu * s};
    }
    // Bound of the way of each point of the robot between two parameters.
    double way(double from, double to) const {
        if (!turns) return reach * (to - from) * (1 + 0x1p-40) + margin;
        const auto half = [&](double u) { return arc_tangent(std::abs(u * p), (1 - u) * start + u * q); };
        return reach * 2 * (half(to) - half(from)) * (1 + 0x1p-40) + 2 * margin;
    }
    bool is_known;  // where doubles are near enough to the truth

private:
    bool turns;
    double x, y, vx, vy, c, s, start, q, p, reach;
};

}  // namespace

class ArcMotionChecker::Run {
public:
    Run(const ArcMotionChecker& of, const Motion& m, bool only_whether)
        : scene(*of.scene), near(*of.near), motion(m), doubles(m, near), stops(only_whether) {}

    std::optional<ArcCollision> first;

    void run() {
        bounds();
        if (done()) return;
        if (doubles.is_known) halve();
        else for (Index i = 0; i < static_cast<Index>(scene.robot.size()); ++i)
            for (Index j = 0; j < static_cast<Index>(scene.obstacles.size()); ++j) left[{i, j}] = {{{0, 1}, {1, 1}, {}, true}};
        for (auto& [pair, spans] : left)
            for (const Span& span : merged(spans)) {
                if (done()) return;
                heed_stop();
                decide(pair.first, pair.second, span);
            }
        if (first)
            while (first->low != first->high && at) {
                if ((first->high - first->low) * power_of_two(width_of_contact) <= Ratio{1, 1}) break;
                const Ratio middle = (first->low + first->high) * Ratio{1, 2};
                const int sign = at->against(middle);
                if (sign >= 0) first->low = middle;
                if (sign <= 0) first->high = middle;
            }
    }

private:
    using Pair = std::pair<Index, Index>;
    struct Span {  // an interval in which some pairs of curves come near each other, or all may
        Ratio lo, hi;
        CurvePairs curves;
        bool all = false;
    };
    bool done() const { return stops && first; }

    void found(const Ratio& from, QuadraticRoot* root, Index part, Index obstacle) {
        if (!root) {
            if (first && (at ? at->against(from) <= 0 : first->low <= from)) return;
            first = ArcCollision{from, from, part, obstacle}, at.reset();
            return;
        }
        if (first && (at ? root->against(*at) >= 0 : root->against(first->low) >= 0)) return;
        first = ArcCollision{root->low, root->high, part, obstacle}, at = *root;
    }

    // The reference point at samples between the roots at which it is on a limit.
    void bounds() {
        if (!scene.bounds) return;
        const auto& b = *scene.bounds;
        const Course course(motion, Int(1));
        const Int w = motion.w * motion.unit;
        std::vector<QuadraticRoot> roots;
        const Vec<Int> pole{motion.vx * motion.w, motion.vy * motion.w}, start{motion.x * motion.w, motion.y * motion.w};
        const Vec<Int> a = course.turns ? start - pole : start;
        // the coordinate times W, less the limit
        const auto beyond = [&](std::size_t k) {
            const bool is_x = k % 2 == 0;
            const Ratio limit = b[k] * Ratio{w, 1};  // in the integers of the course
            Terms f = course.turns ? (is_x ? course.mixed(a.x, -a.y, pole.x) : course.mixed(a.y, a.x, pole.y))
                                   : Terms{is_x ? a.x : a.y, is_x ? course.by.x : course.by.y, 0};
            for (std::size_t i = 0; i < 3; ++i) {
                f[i] = f[i] * limit.d - limit.n * course.W[i];
                if (k > 1) f[i] = -f[i];
            }
            return f;
        };
        std::array<Terms, 4> limits;
        for (std::size_t k = 0; k < 4; ++k) {
            limits[k] = beyond(k);
            add_roots({RootSum(limits[k][0]), RootSum(limits[k][1]), RootSum(limits[k][2])}, {0, 1}, {1, 1}, roots);
        }
        const auto samples = samples_between(roots, {0, 1}, {1, 1});
        const auto is_beyond = [&](const Ratio& u) {
            return std::any_of(limits.begin(), limits.end(), [&](const Terms& f) { return Course::value(f, u).sign() < 0; });
        };
        if (is_beyond({0, 1})) return found({0, 1}, nullptr, 0, -1);
        for (std::size_t k = 0; k < samples.size(); ++k)
            if (is_beyond(samples[k])) return found({0, 1}, k == 0 ? nullptr : &roots[k - 1], 0, -1);
    }

    // Halve [0, 1], leaving out pairs that certainly keep apart. What remains is decided exactly.
    void halve() {
        struct Part {
            double lo, hi;
            std::vector<Pair> pairs;
        };
        std::vector<Part> level{{0, 1, {}}}, next;
        double horizon = 1;  // nothing after it matters
        int looks = 0;
        std::vector<NearShape> placed(near.robot.size());
        for (int depth = 0; !level.empty(); ++depth) {
            const bool is_last = depth == most_halvings || looks > most_looks;
            next.clear();
            for (Part& part : level) {
                heed_stop();
                if (part.lo >= horizon) continue;
                const double middle = 0.5 * (part.lo + part.hi);
                const auto [x, y, c, s] = doubles.at(middle);
                const double way = std::max(doubles.way(part.lo, middle), doubles.way(middle, part.hi));
                for (std::size_t i = 0; i < placed.size(); ++i) near.place(i, x, y, c, s, placed[i]);
                if (depth == 0)
                    for (std::size_t i = 0; i < placed.size(); ++i)
                        near.near(placed[i].around, way + placed[i].radius + margin, [&](Index j) { part.pairs.emplace_back(i, j); });
                std::vector<Pair> open;
                bool is_forbidden = false;
                for (const Pair& pair : part.pairs) {
                    const NearShape &a = placed[static_cast<std::size_t>(pair.first)], &b = near.obstacles[static_cast<std::size_t>(pair.second)];
                    const double within = a.radius + b.radius;
                    ++looks;
                    CurvePairs curves;
                    const Verdict v = verdict_on(a, b, within, way, is_last ? &curves : nullptr);
                    if (v == Verdict::free) continue;
                    if (v == Verdict::forbidden || verdict_on(a, b, within, 0) == Verdict::forbidden) {
                        is_forbidden = true;
                        if (stops) return found({0, 1}, nullptr, pair.first, pair.second);
                    }
                    open.push_back(pair);
                    if (is_last) left[pair].push_back({ratio_of(part.lo), ratio_of(part.hi), std::move(curves)});
                }
                if (is_forbidden) horizon = std::min(horizon, middle);
                if (!open.empty() && !is_last) next.push_back({part.lo, middle, open}), next.push_back({middle, part.hi, open});
            }
            std::swap(level, next);
            if (is_last) break;
        }
    }

    // Join intervals that follow each other.
    static std::vector<Span> merged(std::vector<Span>& spans) {
        std::sort(spans.begin(), spans.end(), [](const Span& x, const Span& y) { return x.lo < y.lo; });
        std::vector<Span> result;
        for (Span& span : spans) {
            if (result.empty() || result.back().hi != span.lo) {
                result.push_back(std::move(span));
                continue;
            }
            result.back().hi = span.hi, result.back().all = result.back().all || span.all;
            result.back().curves.insert(result.back().curves.end(), span.curves.begin(), span.curves.end());
        }
        for (Span& span : result) {
            std::sort(span.curves.begin(), span.curves.end());
            span.curves.erase(std::unique(span.curves.begin(), span.curves.end()), span.curves.end());
        }
        return result;
    }

    void decide(Index part, Index obstacle, const Span& span) {
        const ArcShape &A = scene.robot[static_cast<std::size_t>(part)], &B = scene.obstacles[static_cast<std::size_t>(obstacle)];
        const CommonScale scale(A, B);
        const Course course(motion, scale.whole);
        const Int whole = motion.w * motion.unit * scale.of_obstacle, own = motion.unit * scale.of_robot, w = motion.w * scale.whole;
        const Vec<Int> pole = course.turns ? Vec<Int>{motion.vx * w, motion.vy * w} : Vec<Int>{0, 0};
        const Vec<Int> from = Vec<Int>{motion.x * w, motion.y * w} - pole;
        const auto moving = [&](const Vec<Int>& p) {
            return Vec<Int>{(motion.c * p.x - motion.s * p.y) * own + from.x, (motion.s * p.x + motion.c * p.y) * own + from.y};
        };
        const auto still = [&](const Vec<Int>& p) { return times(whole, p) - pole; };
        std::vector<RoundEdge> a, b;
        for (const RoundEdge& k : A.curves) a.push_back({moving(k.start), moving(k.end), moving(k.center), k.turn});
        for (const RoundEdge& k : B.curves) b.push_back({still(k.start), still(k.end), still(k.center), k.turn});
        const Int distance = A.radius * own * motion.w + B.radius * whole;
        std::vector<QuadraticRoot> roots;
        Contacts contacts(course, distance, span.lo, span.hi, roots);
        if (span.all) {
            for (const RoundEdge& p : a)
                for (const RoundEdge& q : b) contacts.add(p, q);
        } else {
            for (const auto& [i, j] : span.curves) contacts.add(a[static_cast<std::size_t>(i)], b[static_cast<std::size_t>(j)]);
        }
        const auto samples = samples_between(roots, span.lo, span.hi);
        for (std::size_t k = 0; k < samples.size(); ++k) {
            heed_stop();
            const Ratio& u = samples[k];
            // what is at rest is multiplied by the weight that the placed points have
            const Int weight = course.weight(u);
            std::vector<RoundEdge> p, q;
            for (const RoundEdge& c : a) p.push_back({course.placed(c.start, u), course.placed(c.end, u), course.placed(c.center, u), c.turn});
            for (const RoundEdge& c : b) q.push_back({times(weight, c.start), times(weight, c.end), times(weight, c.center), c.turn});
            const int shift = shift_for(p, q);
            if (overlap({A, std::move(p), shift}, {B, std::move(q), shift}, distance * weight))
                return found(span.lo, k == 0 ? nullptr : &roots[k - 1], part, obstacle);
        }
    }

    const ArcScene& scene;
    const NearScene& near;
    const Motion& motion;
    const NearCourse doubles;
    const bool stops;
    std::map<Pair, std::vector<Span>> left;
    std::optional<QuadraticRoot> at;
};

ArcMotionChecker::ArcMotionChecker(std::shared_ptr<const ArcScene> s) : scene(std::move(s)), near(std::make_unique<NearScene>(scene)) {}
ArcMotionChecker::~ArcMotionChecker() = default;

bool ArcMotionChecker::is_free(const Motion& motion) const {
    Run run(*this, motion, true);
    run.run();
    return !run.first;
}

// Parts of the motion, the one that may hold the least distance first.
DistanceBounds ArcMotionChecker::clearance(const Motion& motion, double width) const {
    constexpr int most_parts = 1 << 14;
    const NearCourse course(motion, *near);
    if (!course.is_known) return {0, HUGE_VAL};
    std::vector<NearShape> placed(near->robot.size());
    const auto distance = [&](double u, double most) {
        const auto [x, y, c, s] = course.at(u);
        Gap least{most, most};
        for (std::size_t i = 0; i < placed.size(); ++i) {
            near->place(i, x, y, c, s, placed[i]);
            near->near(placed[i].around, least.high + placed[i].radius, [&](Index j) {
                const auto [low, high] = distance_of(placed[i], near->obstacles[static_cast<std::size_t>(j)], least.high);
                least = {std::min(least.low, low), std::min(least.high, high)};
            });
        }
        return least;
    };
    struct Part {
        double least, lo, hi;
        bool operator<(const Part& other) const { return least > other.least; }
    };
    constexpr double most = 4;
    double best = std::min(distance(0, most).high, distance(1, most).high);
    std::vector<Part> parts{{0, 0, 1}};
    for (int count = 0; count < most_parts && parts.front().least < best - width * near->unit; ++count) {
        heed_stop();
        std::pop_heap(parts.begin(), parts.end());
        const auto [least, lo, hi] = parts.back();
        parts.pop_back();
        const double middle = 0.5 * (lo + hi), way = std::max(course.way(lo, middle), course.way(middle, hi));
        const Gap here = distance(middle, std::min(most, best + way));
        best = std::min(best, here.high);
        for (const auto& [from, to] : {std::pair(lo, middle), std::pair(middle, hi)}) {
            parts.push_back({std::max(least, here.low - way), from, to});
            std::push_heap(parts.begin(), parts.end());
        }
    }
    if (best >= most) return {0, HUGE_VAL};
    return {std::max(0.0, std::min(best, parts.front().least) - 2 * margin) / near->unit, (best + 2 * margin) / near->unit};
}

std::optional<ArcCollision> ArcMotionChecker::first_collision(const Motion& motion) const {
    Run run(*this, motion, false);
    run.run();
    return run.first;
}

}  // namespace cfree
