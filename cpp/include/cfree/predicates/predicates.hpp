// This class (predicates.cpp, roots.cpp, angles.cpp) decides every sign and every order of the boundary, and no other code
// does; point_location.cpp compares with poses, motion_checker.cpp decides along motions.
//
// At an orientation theta a contact surface is a line, a pillar is a convex polygon, and decisions are signs of
//   f(theta) = a + b cos(theta) + c sin(theta)                  (Trig: offsets, parallels, numerators, denominators)
// and of N1 D2 - N2 D1 (two curves on a surface). In a chart, tau = tan(theta'/2) in [-1, 1] with theta = theta' or
// theta' + pi. In tau, f times 1 + tau^2 is a quadratic, and the order of two curves is a quartic.
//
// Rungs: identity of features; doubles with a proven bound; balls of twice the precision; exact integers of any size.
// No tolerance decides anything.
#pragma once
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "cfree/exact/algebraic.hpp"
#include "cfree/exact/surd_polynomial.hpp"
#include "cfree/scene/scene.hpp"
#include "cfree/support/few.hpp"

namespace cfree {

// Kind of a feature pair (robot feature, obstacle feature), which names a curve on a surface, or a critical angle.
// A `seam` is an end of a quadrant of a circle, `branch` times a quarter turn from the x axis.
enum class Kind : std::uint8_t { none, vertex_edge, edge_vertex, vertex_vertex, edge_edge, seam };
struct Feature {
    Kind kind = Kind::none;
    // Where shapes are grown: as a curve, the branch on which a surface meets another, see round_surfaces.hpp; as a patch of a
    // circle, its quadrant.
    std::int8_t branch = 0;
    Index robot = 0, obstacle = 0;

    constexpr Feature() = default;
    constexpr Feature(Kind k, Index r, Index o, int b = 0) : kind(k), branch(static_cast<std::int8_t>(b)), robot(r), obstacle(o) {}
    bool operator==(const Feature&) const = default;
};
// Equal features have equal codes: vertices by point, edges by line (parallels: by direction).
using Code = std::uint64_t;
inline Code code(const Scene& scene, const Feature& f) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    Index i = 0, j = 0;
    switch (f.kind) {
        case Kind::none: return 0;
        case Kind::vertex_edge: i = A.point[f.robot], j = O.line[f.obstacle]; break;
        case Kind::edge_vertex: i = A.line[f.robot], j = O.point[f.obstacle]; break;
        case Kind::vertex_vertex: i = A.point[f.robot], j = O.point[f.obstacle]; break;
        case Kind::edge_edge: i = A.direction[f.robot], j = O.direction[f.obstacle]; break;
        case Kind::seam: i = A.point[f.robot], j = O.point[f.obstacle]; break;
    }
    return static_cast<Code>(f.kind) << 61 | static_cast<Code>(f.branch & 3) << 59 | static_cast<Code>(i) << 31 | static_cast<Code>(j);
}

// True if a surface is that of a concave arc.
inline bool is_concave(const Scene& scene, const Feature& f) {
    return f.kind == Kind::vertex_vertex && (scene.robot.is_concave(f.robot) || scene.obstacles.is_concave(f.obstacle));
}
// Helix of a surface at t = 0 or t = 1.
inline Feature end_helix(const Scene& scene, const Feature& contact, int end) {
    const Index i = contact.robot, j = contact.obstacle;
    if (contact.kind == Kind::vertex_edge) return {Kind::vertex_vertex, i, end ? scene.obstacles.last_of(j) : scene.obstacles.first_of(j)};
    return {Kind::vertex_vertex, end ? scene.robot.last_of(i) : scene.robot.first_of(i), j};
}

// The contact surface under study, in one chart.
struct Surface {
    Feature contact;  // vertex_edge or edge_vertex, with ring features; where shapes are grown also a circle
    int chart = 0;    // base rotation 0 or pi
};

// a + b cos + c sin in chart coordinates; every value below is within err of the truth.
template <class T>
struct Trig {
    T a, b, c;
};
struct Filtered {
    double a = 0, b = 0, c = 0, err = 0;
    // Polar form: f(t, t) is the quadratic's value, f(p, p), f(p, q), f(q, q) its Bernstein coefficients on [p, q].
    double polar(double p, double q) const { return a * (1 + p * q) + b * (1 - p * q) + c * (p + q); }
    Filtered operator-() const { return {-a, -b, -c, err}; }
};

// A critical angle: the only root in [lo, hi] of the polynomial that its features define on the surface:
//   none: an end of the chart (lo = hi = -1 or 1);  edge_edge: the two edges parallel;
//   vertex_vertex alone: the helix meets the surface;  otherwise the two curves cross.
// Where shapes are grown:  a line or circle alone: it touches the surface, on the side of its branch (round_surfaces.hpp);
//   a line and a circle at its end: their joint is on the surface, or, with branch 2 of the circle, the foot of the surface's centre
//   on the line is the circle's centre;  two circles, branch 2 of the second: their centres have one foot on the surface's line, or
//   the three centres are on one line;  a surface and a seam: they meet.
// If doubles cannot separate two roots, `fine` is the place of a finer interval, stored by the Predicates that found it.
struct Event {
    Feature first, second;
    double lo, hi;
    Index fine = -1;
    bool is_touch = false;  // the polynomial does not change sign there; as part of an order, the order does not change
};

// A curve t(theta) = N / D on the surface, used where D > 0.
struct Curve {
    Feature feature;
    Code code;
    bool constant, constant_D;  // true for a kind whose t, or only D, does not depend on theta
    bool flipped;               // N and D have been negated
    Filtered N, D;
};

// A rational sample: a double, taken exactly, or a finer dyadic if no double lies between two angles.
struct Sample {
    double tau;
    std::optional<Dyadic> fine;
    Dyadic exact() const { return fine ? *fine : Dyadic::from(tau); }
    Ball ball() const { return fine ? cfree::ball(fine->n, static_cast<int>(fine->k)) : Ball(tau); }
};

// Numbers of decisions by rung, and the time of the slowest.
struct Counters {
    std::int64_t identity = 0, filter = 0, interval = 0, exact = 0;
    double exact_seconds = 0;
    void operator+=(const Counters& o) {
        identity += o.identity, filter += o.filter, interval += o.interval, exact += o.exact;
        exact_seconds += o.exact_seconds;
    }
};

class RoundOrders;

class Predicates {
public:
    Predicates(const Scene& s, const Surface& on);
    ~Predicates();

    // The quadratics. offset: of vertex b_v - R a_s from the surface's line, positive on its left (forbidden) side.
    Filtered offset(Index s, Index v) const;
    // parallel: R(robot edge g) x (obstacle edge f)
    Filtered parallel(Index g, Index f) const;
    Curve curve(const Feature& f) const;

    // Sign on the whole closed interval, 0 if not certain.
    static int sign_on(const Filtered& f, double lo, double hi);
    // The same on the open interval between roots of f at one end, or at both.
    static int sign_between(const Filtered& f, double lo, double hi, bool root_at_lo, bool root_at_hi);
    // Sign at a sample, exact; 0 means zero.
    int offset_sign(Index s, Index v, const Filtered& f, const Sample& at);
    int parallel_sign(Index g, Index f, const Filtered& value, const Sample& at);
    // Constants: sign of E_g x E_f for two edges of one shape.
    int cross_sign(const Shape& shape, Index e, Index f);

    // Sign of x - y: 0 if they are one angle.
    int order(const Event& x, const Event& y);
    int order(const Event& x, const Sample& at);
    // A sample strictly between two angles: the first is about half-way with few digits; further attempts give others.
    static constexpr int most_attempts = 1000;
    Sample between(const Event& x, const Event& y, int attempt = 0);
    static Sample within(double lo, double hi, int attempt = 0);

    // Roots strictly between two angles, in order, those without a change of sign among them.
    // all_zero: the polynomial vanishes identically.
    // alternates: the sign changes at each root that is no touch, and nowhere else.
    // outside: a place a little before the first angle; the sign changes `passed` times from there to just after that angle.
    struct Roots {
        Few<Event, 6> at;
        bool all_zero = false, alternates = true;
        std::optional<double> outside;
        int passed = 0;
    };
    Roots offset_roots(Index s, Index v, const Filtered& f, const Event& from, const Event& to);
    Roots parallel_roots(Index g, Index f, const Event& from, const Event& to);
    // Order of two curves between two angles: the angles at which it may change, and the sign of p - q before, between and
    // after.
    struct Order {
        Few<Event, 6> at;
        int sign[7]{};        // all 0 if the curves are one
        bool strict = false;  // the same sign also at the two ends
        bool is(int everywhere) const { return at.empty() && sign[0] == everywhere; }
    };
    Order compare(const Curve& p, const Curve& q, const Event& from, const Event& to);
    // Order of two curves on a closed interval, 0 if not certain.
    int order_on(const Curve& p, const Curve& q, double lo, double hi) const;

    // Sign at a sample, and roots, of the polynomial of an event's features.
    int event_sign(const Feature& first, const Feature& second, const Sample& at);
    Roots event_roots(const Feature& first, const Feature& second, const Event& from, const Event& to);
    // Sign on the whole closed interval, 0 if not certain.
    int event_sign_on(const Feature& first, const Feature& second, double lo, double hi) const;

    // True if the polynomial that two curves, or a helix alone, define on the surface is zero at every angle.
    bool vanishes(const Feature& first, const Feature& second) const { return polynomial(first, second).empty(); }

    // Order at a sample of two curves on the surface, also outside the patch.
    int order_at(const Feature& p, const Feature& q, const Sample& at) const;
    // Sign of a curve's D at a sample.
    int denominator_sign(const Feature& f, const Sample& at) const;

    // Place of an angle: 0 if it is the only root in its interval of doubles, else its number among the roots there, from 1.
    int place(const Event& x) const;
    // Angle of that place, for decisions of this object.
    Event restored(const Event& x, int place);
    // True if the polynomial of an angle has certain, opposite signs at lo and hi.
    bool changes_sign(const Event& x, double lo, double hi) const;
    // True if the line through vertices v and w of the robot, or else of the obstacles, certainly becomes parallel to an edge
    // of the other shape between lo and hi.
    bool turns_parallel(bool robot, Index v, Index w, Index edge, double lo, double hi) const;
    // True if an angle of that place is the only root of its polynomial there.
    bool isolates(const Event& x, int place) const;
    // True if 0 <= lower <= upper <= 1 for two curves everywhere between two angles.
    bool are_limits(const Feature& lower, const Feature& upper, const Event& from, const Event& to);
    // True if an angle and one of another surface, each alone in its interval, are proved to be one: a number of few digits, as
    // thousands are in axis-parallel scenes, or a root of one quadratic.
    bool are_one(const Event& x, const Predicates& other, const Event& y) const;
    static std::optional<double> as_few_digits(const Event& x, const Coefficients<Ball>& p);
    static double of_few_digits_near(double tau) { return std::nearbyint(16 * tau) / 16; }
    LongRoot long_root_of(const Event& x) const;  // where shapes are grown
    // Interval of an angle shrunk to about the precision of balls, if possible: between certain, opposite signs.
    using Bracket = std::array<Ball, 2>;
    std::optional<Bracket> bracket(const Event& x) const;
    static std::optional<Bracket> bracket_of(const Event& x, const Coefficients<Ball>& p);
    struct Narrowed {
        Event x;
        std::optional<Bracket> bracket;
        std::optional<double> few_digits;  // the angle, if it is a number of few digits
    };
    const Narrowed& narrow_place(const Event& x);  // cached
    const std::optional<Bracket>& narrowed(const Event& x) { return narrow_place(x).bracket; }
    // Angle as an exact number, in a bracket of it if there is one.
    RealRoot root_of(const Event& x, const std::optional<Bracket>& within = {}) const;
    RealRoot narrow_root_of(const Event& x);

    // Begin or end of a patch's range: the angle(-E_f) - angle(E_g) of the paper's phi_min and phi_max, and its chart.
    struct RangeEnd {
        int chart;
        Event event;
    };
    static RangeEnd range_end(const Scene& scene, Index g, Index f, bool is_start, Counters& counters);

    // Orders of curves on the surface, where shapes are grown.
    const RoundOrders& round_orders() const;

    Counters counters;

private:
    friend class Junction;  // the same polynomials, at critical angles
    friend class PointLocation;  // the same at rational angles
    friend class RoundOrders;    // the same where shapes are grown
    template <class T>
    static Trig<T> offset_trig(const Scene& scene, const Feature& contact, Index s, Index v);
    template <class T>
    Trig<T> parallel_trig(Index g, Index f) const;
    template <class T>
    static Trig<T> parallel_trig(const Vec<T>& G, const Vec<T>& F) {
        return {T{}, cross(G, F), -dot(G, F)};
    }
    template <class T>
    static std::array<Trig<T>, 2> curve_trig(const Scene& scene, const Feature& contact, const Feature& f);  // N and D
    Filtered filtered(const Trig<Approx>& f) const;
    // Polynomial of an event's features; see Event. Two curves: N1 D2 - N2 D1.
    template <class T>
    Coefficients<T> coefficients(const Trig<T>& f) const;
    template <class T>
    Coefficients<T> coefficients(const Feature& first, const Feature& second) const;
    template <class T>
    Coefficients<T> computed(const Feature& first, const Feature& second) const;
    Poly polynomial(const Trig<Int>& f) const { return Poly(coefficients(f)); }
    Poly polynomial(const Feature& first, const Feature& second) const;
    struct Form;
    Form form(const Curve& p, const Curve& q) const;
    Form form(const Event& x) const;
    struct Candidates;
    std::optional<Candidates> roots_by_balls(const Feature& first, const Feature& second, double lo, double hi) const;
    Candidates roots_exactly(const Feature& first, const Feature& second, double lo, double hi);
    Roots roots(const Form& f, const Feature& first, const Feature& second, const Event& from, const Event& to);
    Roots crossings(const Form& f, const Feature& p, const Feature& q, const Event& from, const Event& to);
    // The same where shapes are grown (round_predicates.cpp).
    Order compare_round(const Feature& p, const Feature& q, const Event& from, const Event& to);
    std::vector<Event> changes_of_branch(const Feature& p, const Feature& q, const Event& from, const Event& to);
    Candidates roots_exactly_round(const Feature& first, const Feature& second, double lo, double hi);
    bool is_same_round(const Event& x, const Event& y) const;
    bool meet_at(const Feature& p, const Feature& q, const Event& x) const;
    std::vector<SurdRoot> roots_around(const Event& x) const;
    int place_round(const Event& x) const;
    Event restored_round(Event x, int place);
    int sign_at(double value, double err, const Feature& first, const Feature& second, const Sample& at);
    bool is_touch_of_quadratic(const Event& x) const;
    bool is_of_parallel(const Feature& parallel, const Event& x) const;
    bool same_polynomial(const Event& x, const Event& y);
    template <class T>
    std::optional<bool> meets_parallel(const Event& parallel, const Event& x) const;
    int order_of_close(const Event& x, const Event& y);
    std::optional<int> order_of_brackets(const Event& x, const Event& y);
    int decided_order(const Event& x, const Event& y);
    RealRoot& kept_root(const Event& x);

    const Scene& scene;
    Surface surface;
    double kappa;
    std::vector<std::array<Dyadic, 2>> fine;
    struct Known {
        Feature first, second;
        Coefficients<Ball> p;
    };
    mutable std::vector<Known> polynomials;  // table by features; of one entry at first
    mutable std::size_t unknown = 0;         // misses since the last resize
    std::vector<Narrowed> recent;  // table by features, as one angle is compared with many; empty at first
    std::size_t misses = 0;        // misses since the last resize
    mutable std::unique_ptr<const RoundOrders> made_orders;  // none until asked for
    struct CloseAngles;
    std::unique_ptr<CloseAngles> close;  // none until there are many
    int close_questions = 0;
};

// --- the most frequent quadratics, one formula for every number type; the others are in predicates.cpp ---

// Coefficients are one cross or dot product of differences: at most 6 roundings in a row. The polar form adds 5 and at
// most doubles the magnitude: 22 times 2^-53 would suffice.
inline constexpr double coefficient_error = 0x1p-48;
// Exceeds any loss by underflow: coefficients are far above it or zero.
inline constexpr double tiny = 0x1p-900;

template <class T>
Trig<T> Predicates::offset_trig(const Scene& scene, const Feature& contact, Index s, Index v) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = contact.robot, j = contact.obstacle;
    if (contact.kind == Kind::vertex_edge) {  // E_j x (b_v - b_j - R (a_s - a_i))
        const auto E = edge<T>(O, j), w = difference<T>(O, v, O.v[j]), d = difference<T>(A, s, i);
        return {cross(E, w), -cross(E, d), -dot(E, d)};
    }
    // -R E_i x (b_v - b_j - R (a_s - a_i))
    const auto E = edge<T>(A, i), w = difference<T>(O, v, j), d = difference<T>(A, s, A.v[i]);
    return {cross(E, d), -cross(E, w), dot(E, w)};
}

template <class T>
Trig<T> Predicates::parallel_trig(Index g, Index f) const {
    return parallel_trig(edge<T>(scene.robot, g), edge<T>(scene.obstacles, f));
}

inline Filtered Predicates::filtered(const Trig<Approx>& f) const {
    return {f.a.v, kappa * f.b.v, kappa * f.c.v, double_only ? 0 : coefficient_error * (f.a.m + f.b.m + f.c.m) + tiny};
}
inline Filtered Predicates::offset(Index s, Index v) const { return filtered(offset_trig<Approx>(scene, surface.contact, s, v)); }
inline Filtered Predicates::parallel(Index g, Index f) const { return filtered(parallel_trig<Approx>(g, f)); }

[[gnu::always_inline]] inline int Predicates::sign_on(const Filtered& f, double lo, double hi) {
    const double p = f.polar(lo, lo), q = f.polar(lo, hi), r = f.polar(hi, hi);
    if (p > f.err && q > f.err && r > f.err) return 1;
    if (p < -f.err && q < -f.err && r < -f.err) return -1;
    return 0;
}

}  // namespace cfree
