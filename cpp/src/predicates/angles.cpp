// Order critical angles, and find samples between them; theory, "Degrees".
#include <stdexcept>

#include "cfree/support/elementary.hpp"
#include "predicates/close_angles.hpp"
#include "predicates/round_orders.hpp"

namespace cfree {

namespace {

const Event chart_end(int side) { return {{}, {}, double(side), double(side)}; }

// Direction times a power of two, so that products of two are neither huge nor tiny.
Vec<Approx> of_unit_size(const Vec<Approx>& d) {
    const double scale = power_below(std::max(d.x.m, d.y.m));
    return {{d.x.v * scale, d.x.m * scale}, {d.y.v * scale, d.y.m * scale}};
}

// True if edge e of a shape is parallel to the line through two of its vertices.
bool is_parallel(const Shape& s, Index e, Index p, Index q, Counters& counters) {
    return settled(counters, [&]<class T>() { return certain_sign(cross(edge<T>(s, e), difference<T>(s, p, q))); }) == 0;
}
// Order of the angles of two pairs of edges, as directions (G.F, G x F) turned to the right half-plane.
template <class T>
std::optional<int> parallel_order(const Scene& s, const Feature& x, const Feature& y) {
    const auto direction = [&](const Feature& f) {
        const auto G = edge<T>(s.robot, f.robot), F = edge<T>(s.obstacles, f.obstacle);
        return Vec<T>{dot(G, F), cross(G, F)};
    };
    const auto d = direction(x), e = direction(y);
    const auto right = certain_sign(d.x), left = certain_sign(e.x), turn = certain_sign(cross(e, d));
    if (!right || !left || !turn) return {};
    return (*right < 0) != (*left < 0) ? -*turn : *turn;
}

bool same_feature(const Scene& s, const Feature& x, const Feature& y) { return code(s, x) == code(s, y); }


// The angle at which two edges are parallel, as that of the direction d = (G.F, G x F) turned to the right half-plane:
// tau = y / (|d| + |x|) moves by at most 2 (dx + dy) / |d| for errors dx, dy.
struct ParallelAngle {
    int side;  // sign of G.F before turning; 0 for a right angle
    bool up;   // sign of G x F before turning
    double tau, half;
};

// Angle of a direction whose coordinates are together within 8 u times `error` of the truth, with x on the given side.
ParallelAngle angle_of(double x, double y, int side, double error) {
    const double length = norm(x, y);
    return {side, y > 0, side * y / (length + std::abs(x)), 16 * u * error / length + 4 * u};
}

Vec<Ball> as_balls(const Vec<Ball>& d) { return d; }
Vec<Ball> as_balls(Vec<Int> d) {  // up to a factor, so that digits do not depend on the common denominator
    if (const Int divisor = gcd(d.x, d.y); divisor > 1) d.x /= divisor, d.y /= divisor;
    const auto bits = [](const Int& z) { return z.is_zero() ? 0 : static_cast<int>(msb(abs(z))); };
    const int excess = std::max(bits(d.x), bits(d.y)) - 500;
    return {ball(d.x, std::max(excess, 0)), ball(d.y, std::max(excess, 0))};
}

ParallelAngle parallel_angle(const Scene& scene, Index g, Index f, Counters& counters) {
    const auto G = of_unit_size(edge<Approx>(scene.robot, g)), F = of_unit_size(edge<Approx>(scene.obstacles, f));
    const Approx c = dot(G, F), n = cross(G, F);
    const ParallelAngle guess = angle_of(c.v, n.v, (c.v > 0) - (c.v < 0), c.m + n.m);
    if (double_only || (std::abs(c.v) > coefficient_error * c.m && guess.half < 64 * u)) return ++counters.filter, guess;
    return settled(counters, [&]<class T>() -> std::optional<ParallelAngle> {
        const auto E = edge<T>(scene.robot, g), H = edge<T>(scene.obstacles, f);
        const Vec<T> exact{dot(E, H), cross(E, H)};
        const auto side = certain_sign(exact.x);
        if (!side) return {};
        const Vec<Ball> d = as_balls(exact);
        const double length = norm(d.x.hi, d.y.hi);
        if (!(d.x.radius + d.y.radius < u * length)) return {};
        return angle_of(d.x.hi, d.y.hi, *side, 0.75 * length);  // less than 3 u times the length
    });
}

}  // namespace

Predicates::Roots Predicates::parallel_roots(Index g, Index f, const Event& from, const Event& to) {
    // one in the chart, or two at its ends
    Roots result;
    const ParallelAngle p = parallel_angle(scene, g, f, counters);
    if (p.side == 0) return result;
    const Event x{{Kind::edge_edge, g, f}, {}, p.tau - p.half, p.tau + p.half};
    if (order(from, x) < 0 && order(x, to) < 0) result.at.push_back(x);
    return result;
}

int Predicates::order(const Event& x, const Event& y) {
    if (x.hi < y.lo) return -1;
    if (x.lo > y.hi) return 1;
    if (x.first.kind == Kind::none && y.first.kind == Kind::none) return ++counters.identity, 0;  // one end
    const bool parallels = x.first.kind == Kind::edge_edge && y.first.kind == Kind::edge_edge;
    if (parallels && same_feature(scene, x.first, y.first)) return ++counters.identity, 0;  // a chart holds one such angle
    return order_of_close(x, y);
}

RealRoot Predicates::root_of(const Event& x, const std::optional<Bracket>& within) const {
    RealRoot root{polynomial(x.first, x.second), Dyadic::from(x.lo), Dyadic::from(x.hi)};
    if (x.fine >= 0) root.lo = fine[x.fine][0], root.hi = fine[x.fine][1];
    else if (within) root.lo = Dyadic::from((*within)[0]), root.hi = Dyadic::from((*within)[1]);
    // a touch: the sign changes without the multiple factor only
    if (!root.is_dyadic() && cfree::sign_at(root.p, root.lo) == cfree::sign_at(root.p, root.hi)) root.p = squarefree(root.p);
    return root;
}

int Predicates::place(const Event& x) const {
    if (x.fine < 0) return 0;
    if (scene.is_round) return place_round(x);
    return Sturm(squarefree(polynomial(x.first, x.second))).roots_in(Dyadic::from(x.lo), fine[x.fine][1]);
}

Event Predicates::restored(const Event& x, int place) {
    if (place == 0) return x;
    if (scene.is_round) return restored_round(x, place);
    const Sturm sturm(squarefree(polynomial(x.first, x.second)));
    const Dyadic first = Dyadic::from(x.lo);
    Dyadic below = first, above = Dyadic::from(x.hi);
    while (sturm.roots_in(first, below) != place - 1 || sturm.roots_in(below, above) != 1) {
        const Dyadic mid = Dyadic::middle(below, above);
        (sturm.roots_in(first, mid) < place ? below : above) = mid;
    }
    if (cfree::sign_at(sturm.polynomial(), above) == 0) below = above;
    while (cfree::sign_at(sturm.polynomial(), below) == 0 && cfree::compare(below, above) < 0) {  // the root before this one
        const Dyadic mid = Dyadic::middle(below, above);
        (sturm.roots_in(mid, above) == 1 ? below : above) = mid;
    }
    Event result = x;
    result.fine = static_cast<Index>(fine.size());
    fine.push_back({below, above});
    return result;
}

bool Predicates::changes_sign(const Event& x, double lo, double hi) const {
    if (scene.is_round) {
        const RoundForm f = round_orders().form(x.first, x.second);
        if (f.sign(lo) * f.sign(hi) < 0) return true;
        const auto p = coefficients<Ball>(x.first, x.second);
        return cfree::sign_at(p, lo).value_or(0) * cfree::sign_at(p, hi).value_or(0) < 0;
    }
    const Form f = form(x);
    return f.sign(lo) * f.sign(hi) < 0;
}

// True if two polynomials are equal, up to a factor.
bool are_proportional(const Poly& p, const Poly& q) {
    if (p.size() != q.size()) return false;
    for (int i = 0; i < p.size(); ++i)
        if (p[i] * q.back() != q[i] * p.back()) return false;
    return true;
}

// True if the angle at which edges g and f are parallel is a root of another one's polynomial by identity of features. There a helix
// (a, b) meets a surface: that of robot vertex s and obstacle edge F, of which b is an end. The polynomial is F x R (a - s), and a and
// s are the ends of g, F has the direction of f. Surfaces of the other kind are alike.
bool Predicates::is_of_parallel(const Feature& parallel, const Event& x) const {
    const Index g = parallel.robot, f = parallel.obstacle;
    const auto [helix, on] = x.second.kind == Kind::none ? std::array{x.first, surface.contact}
                             : x.first.kind == Kind::vertex_vertex ? std::array{x.first, x.second} : std::array{x.second, x.first};
    if (helix.kind != Kind::vertex_vertex) return false;
    const auto is_that = [](const Shape& s, Index through, Index vertex, Index parallel_to) {
        const Index p = s.point[vertex];
        return s.direction[through] == s.direction[parallel_to] && (s.point[s.v[through]] == p || s.point[s.w[through]] == p);
    };
    const auto joins = [](const Shape& s, Index edge, Index x, Index y) {
        const Index v = s.point[s.v[edge]], w = s.point[s.w[edge]], p = s.point[x], q = s.point[y];
        return (v == p && w == q) || (v == q && w == p);
    };
    const Shape &A = scene.robot, &O = scene.obstacles;
    if (on.kind == Kind::vertex_edge) return is_that(O, on.obstacle, helix.obstacle, f) && joins(A, g, helix.robot, on.robot);
    return on.kind == Kind::edge_vertex && is_that(A, on.robot, helix.robot, g) && joins(O, f, helix.obstacle, on.obstacle);
}

// True if two angles are roots of one polynomial by identity of features.
bool Predicates::same_polynomial(const Event& x, const Event& y) {
    if (x.first.kind == Kind::none || y.first.kind == Kind::none) return false;
    if (scene.is_round) return is_same_round(x, y);
    if (x.first.kind == Kind::edge_edge) return is_of_parallel(x.first, y);
    if (y.first.kind == Kind::edge_edge) return is_of_parallel(y.first, x);
    const auto same = [&](const Feature& p, const Feature& q) { return same_feature(scene, p, q); };
    if (same(x.first, y.first) && same(x.second, y.second)) return true;
    if (x.second.kind != Kind::none) return same(x.first, y.second) && same(x.second, y.first);
    if (x.first.kind != Kind::vertex_vertex || y.first.kind != Kind::vertex_vertex || y.second.kind != Kind::none)
        return false;
    // helices at one height above the surface's edge
    const Shape &A = scene.robot, &O = scene.obstacles;
    if (surface.contact.kind == Kind::vertex_edge)
        return A.point[x.first.robot] == A.point[y.first.robot] &&
               is_parallel(O, surface.contact.obstacle, x.first.obstacle, y.first.obstacle, counters);
    return O.point[x.first.obstacle] == O.point[y.first.obstacle] &&
           is_parallel(A, surface.contact.robot, x.first.robot, y.first.robot, counters);
}

// True if a root of a + b cos + c sin is the angle at which two edges are parallel: that of the direction d = (G.F, G x F),
// so that a |d| = -(b, c).d.
template <class T>
std::optional<bool> Predicates::meets_parallel(const Event& parallel, const Event& x) const {
    Trig<T> f;
    if (parallel.first.kind != Kind::edge_edge) return false;
    if (x.first.kind == Kind::vertex_vertex && x.second.kind == Kind::none) {
        f = offset_trig<T>(scene, surface.contact, x.first.robot, x.first.obstacle);
    } else if (x.first.kind == Kind::vertex_vertex || x.second.kind == Kind::vertex_vertex) {
        const bool first = x.first.kind == Kind::vertex_vertex;
        const auto [n, d] = curve_trig<T>(scene, surface.contact, first ? x.first : x.second);
        const auto [N, D] = curve_trig<T>(scene, surface.contact, first ? x.second : x.first);
        f = combination(n, D, d, N);
    } else {
        return false;
    }
    const auto G = edge<T>(scene.robot, parallel.first.robot), F = edge<T>(scene.obstacles, parallel.first.obstacle);
    const Vec<T> d{dot(G, F), cross(G, F)};
    const T along = f.b * d.x + f.c * d.y;
    // in the right half-plane of the chart
    const auto half = certain_sign(d.x), sign = certain_sign(along), constant = certain_sign(f.a);
    if (!half || !sign || !constant) return {};
    if (*half * (kappa > 0 ? 1 : -1) * *sign != -*constant) return false;
    if (*constant == 0) return true;
    const auto difference = certain_sign(along * along - f.a * f.a * dot(d, d));
    if (!difference) return {};
    return *difference == 0;
}

bool Predicates::is_touch_of_quadratic(const Event& x) const {
    const auto p = coefficients<Ball>(x.first, x.second);
    const auto below = cfree::sign_at(p, x.lo), above = cfree::sign_at(p, x.hi);
    return x.fine < 0 && p.count == 3 && below && above && *below == *above;
}

// Polynomial that changes sign at the root and nowhere else in its interval; for a touch, the quadratic's derivative.
static std::optional<Coefficients<Ball>> simple(const Event& x, const Coefficients<Ball>& p) {
    if (x.fine >= 0) return {};
    const auto below = cfree::sign_at(p, x.lo), above = cfree::sign_at(p, x.hi);
    if (!below || !above) return {};
    if (*below != *above) return p;
    if (p.count > 3) return {};
    return derivative(p);
}

const Predicates::Narrowed& Predicates::narrow_place(const Event& x) {
    constexpr std::size_t least = 16, most = 4096;  // most patches have few such angles
    const auto empty_of = [this](std::size_t size) { recent.assign(size, {{{}, {}, 2, 2}, {}, {}}), misses = 0; };
    if (recent.empty()) empty_of(least);
    const auto is_known = [&](const Event& y) { return same_angle(x, y) && x.fine == y.fine; };
    const auto place = [&] { return spread(mixed(x)) & (recent.size() - 1); };
    if (const Narrowed& known = recent[place()]; is_known(known.x)) return known;
    if (++misses > recent.size() && recent.size() < most) empty_of(4 * recent.size());
    Narrowed& next = recent[place()];
    if (x.first.kind == Kind::none) return next = {x, bracket(x), {}};
    const auto p = coefficients<Ball>(x.first, x.second);
    return next = {x, bracket_of(x, p), as_few_digits(x, p)};
}

std::optional<Predicates::Bracket> Predicates::bracket(const Event& x) const {
    if (x.first.kind == Kind::none) return Bracket{Ball(x.lo), Ball(x.hi)};
    return bracket_of(x, coefficients<Ball>(x.first, x.second));
}

// Bracket of the one root in the interval of an angle, if the polynomial is certainly monotone there: two steps of Newton's method.
// By the mean value theorem a step from t errs by as much as the slope changes between t and the root.
static std::optional<Predicates::Bracket> steep_bracket(const Event& x, const Coefficients<Ball>& p) {
    const double width = x.hi - x.lo, t = 0.5 * (x.lo + x.hi);
    double slope = 0, size = 0, bend = 0, slip = 0;  // |tau| < 1.1: a factor of 2 covers its powers in bounds
    for (int i = p.count - 1; i > 0; --i) {
        const double c = std::abs(p.c[i].hi);
        slope = slope * t + i * p.c[i].hi;
        size += i * c, bend += i * (i - 1) * (c + p.c[i].radius), slip += i * p.c[i].radius;
    }
    const double change = 2 * (0x1p-47 * size + slip + bend * width), share = change / std::abs(slope);
    if (!(share < 0.25)) return {};
    const Ball first = value_at(p, t);
    const double step = -first.hi / slope;
    const auto [s, e] = two_sum(t, step);
    if (!(x.lo < s && s < x.hi)) return {};
    const Ball near(s, e, 0), rest = value_at(p, near);
    const double last = -rest.hi / slope;
    const double error = 2 * ((share + 4 * u) * std::abs(last) + (rest.radius + std::abs(rest.lo)) / std::abs(slope)) + 0x1p-102;
    const Ball root = near + Ball(last);
    Predicates::Bracket b{root - Ball(error), root + Ball(error)};
    b[0].radius = b[1].radius = 0;
    if (!is_below(x.lo, b[0]) || !is_below(b[1], x.hi)) return {};
    return b;
}

std::optional<Predicates::Bracket> Predicates::bracket_of(const Event& x, const Coefficients<Ball>& of) {
    if (x.fine < 0)
        if (const auto found = steep_bracket(x, of)) return found;
    const auto factor = simple(x, of);
    if (!factor) return {};
    const auto& p = *factor;
    Ball t = 0.5 * (x.lo + x.hi);
    double value = 0, slope = 1;
    for (int k = 0; k < 3; ++k) {  // Newton's method; the signs decide whether it succeeds
        Ball v = p.c[p.count - 1];
        slope = 0;
        for (int i = p.count - 1; i-- > 0;) slope = slope * t.hi + v.hi, v = v * t + p.c[i];
        value = std::abs(v.hi) + v.radius;
        if (k < 2) t = t - Ball(v.hi / slope), t.radius = 0;
    }
    double delta = 2 * value / std::abs(slope) + 0x1p-102;
    for (int k = 0; k < 4 && delta < x.hi - x.lo; ++k, delta *= 256) {
        Bracket b{t - Ball(delta), t + Ball(delta)};
        b[0].radius = b[1].radius = 0;
        if (is_below(b[0], x.lo)) b[0] = x.lo;
        if (is_below(x.hi, b[1])) b[1] = x.hi;
        const auto below = cfree::sign_at(p, b[0]), above = cfree::sign_at(p, b[1]);
        // Newton's method may have left for another root, beside which the signs are opposite, too
        if (is_below(b[0], b[1]) && below && above && *below * *above < 0) return b;
    }
    return {};
}

bool Predicates::are_one(const Event& x, const Predicates& other, const Event& y) const {
    const auto p = coefficients<Ball>(x.first, x.second), q = other.coefficients<Ball>(y.first, y.second);
    if (const auto t = as_few_digits(x, p); t && t == as_few_digits(y, q)) return true;
    // opposite signs around both: one of a quadratic's two roots is there
    if (scene.is_round || p.count != 3 || !changes_sign(x, std::min(x.lo, y.lo), std::max(x.hi, y.hi))) return false;
    if (const auto known = are_proportional(p, q)) return *known;
    return *are_proportional(coefficients<Int>(x.first, x.second), other.coefficients<Int>(y.first, y.second));
}

std::optional<double> Predicates::as_few_digits(const Event& x, const Coefficients<Ball>& p) {
    const double t = of_few_digits_near(x.lo);
    if (x.fine >= 0 || t < x.lo || t > x.hi) return {};
    return cfree::sign_at(p, t) == 0 ? std::optional(t) : std::nullopt;
}

Predicates::Predicates(const Scene& s, const Surface& on) : scene(s), surface(on), kappa(on.chart ? -1 : 1) {}
Predicates::~Predicates() = default;

// Order of two angles whose intervals overlap. Where there are many such questions, most are asked again and again.
int Predicates::order_of_close(const Event& x, const Event& y) {
    constexpr int few = 32;
    if (!close && ++close_questions > few) close = std::make_unique<CloseAngles>();
    if (!close || x.fine >= 0 || y.fine >= 0) return decided_order(x, y);
    if (const auto apart = order_of_brackets(x, y)) return ++counters.interval, *apart;
    if (const int* known_order = close->order(x, y)) return ++counters.identity, *known_order;
    const int order = decided_order(x, y);
    close->keep(x, y, order);
    return order;
}

RealRoot Predicates::narrow_root_of(const Event& x) {
    if (x.first.kind == Kind::none) return root_of(x);
    const auto& [_, bracket, few_digits] = narrow_place(x);
    if (!few_digits) return root_of(x, bracket);
    return {polynomial(x.first, x.second), Dyadic::from(*few_digits), Dyadic::from(*few_digits)};
}

// The same of an angle that is alone in its interval, as narrow as any question has made it.
RealRoot& Predicates::kept_root(const Event& x) {
    return close->root(x, [&] { return narrow_root_of(x); });
}

std::optional<int> Predicates::order_of_brackets(const Event& x, const Event& y) {
    const auto [_, p, few] = narrow_place(x);
    const auto& [__, q, few_of_y] = narrow_place(y);
    if (few && few == few_of_y) return 0;
    if (p && q && is_below((*p)[1], (*q)[0])) return -1;
    if (p && q && is_below((*q)[1], (*p)[0])) return 1;
    return {};
}

int Predicates::decided_order(const Event& x, const Event& y) {
    const auto sign = [](double d) { return (d > 0) - (d < 0); };
    if (double_only) return ++counters.filter, sign((x.lo + x.hi) - (y.lo + y.hi));
    // One root in each of two overlapping intervals: of one polynomial, opposite signs around both mean one root in all.
    // So does a touch of a quadratic, its only root.
    const auto alone = [&](const Event& z) {
        return changes_sign(z, std::min(x.lo, y.lo), std::max(x.hi, y.hi)) || is_touch_of_quadratic(z);
    };
    if (x.first.kind == Kind::edge_edge && y.first.kind == Kind::edge_edge)
        return settled(counters, [&]<class T>() { return parallel_order<T>(scene, x.first, y.first); });
    const bool are_narrow = x.fine < 0 && y.fine < 0;  // else there may be other roots between them
    if (are_narrow && same_polynomial(x, y) && alone(x)) return ++counters.identity, 0;
    if (x.first.kind == Kind::none) return -order(y, Sample{x.lo, {}});
    if (y.first.kind == Kind::none) return order(x, Sample{y.lo, {}});
    return settled(counters, [&]<class T>() -> std::optional<int> {
        if constexpr (std::is_same_v<T, Ball>)
            if (const auto apart = order_of_brackets(x, y)) return apart;
        const bool may_keep = std::is_same_v<T, Int> && close && are_narrow && !scene.is_round;
        if (!may_keep && !scene.is_round && x.is_touch == y.is_touch && alone(x) &&
            are_proportional(coefficients<T>(x.first, x.second), coefficients<T>(y.first, y.second)).value_or(false))
            return 0;
        if (scene.is_round) {
            if constexpr (std::is_same_v<T, Ball>) return {};
            LongRoot p = long_root_of(x), q = long_root_of(y);
            return cfree::compare(p, q);
        }
        const auto first = meets_parallel<T>(x, y), second = meets_parallel<T>(y, x);
        if (!first || !second) return {};
        if ((*first && alone(y)) || (*second && alone(x))) return 0;
        if constexpr (std::is_same_v<T, Ball>) return {};
        if (!may_keep) {
            RealRoot p = root_of(x), q = root_of(y);
            return cfree::compare(p, q);
        }
        close->trim();
        RealRoot &p = kept_root(x), &q = kept_root(y);
        if (&p == &q || (x.is_touch == y.is_touch && are_proportional(p.p, q.p) && alone(x))) return 0;
        return cfree::compare(p, q);
    });
}

int Predicates::order(const Event& x, const Sample& at) {
    if (!at.fine && x.hi < at.tau) return -1;
    if (!at.fine && x.lo > at.tau) return 1;
    if (x.first.kind == Kind::none) return ++counters.exact, cfree::compare(Dyadic::from(x.lo), at.exact());
    const auto sign = [](double d) { return (d > 0) - (d < 0); };
    if (double_only) return ++counters.filter, sign(x.lo + x.hi - 2 * at.tau);
    return settled(counters, [&]<class T>() -> std::optional<int> {
        std::optional<int> here, below;
        if constexpr (std::is_same_v<T, Ball>) {
            if (at.fine && (at.tau < x.lo || at.tau >= x.hi)) return {};  // the sample is just above tau
            const auto p = simple(x, coefficients<Ball>(x.first, x.second));
            if (!p) return {};
            here = cfree::sign_at(*p, at.ball()), below = cfree::sign_at(*p, x.lo);
        } else if (scene.is_round) {
            LongRoot root = long_root_of(x);
            return cfree::compare(root, at.exact());
        } else {
            const RealRoot root = root_of(x);
            const Dyadic t = at.exact();
            if (cfree::compare(t, root.lo) < 0) return 1;
            if (cfree::compare(root.hi, t) < 0) return -1;
            here = cfree::sign_at(root.p, t), below = cfree::sign_at(root.p, root.lo);
        }
        if (!here || !below) return {};
        return *here == 0 ? 0 : *here == *below ? 1 : -1;
    });
}

namespace {

// Share of an interval before a sample, over 2^16: 1/2, then the golden section again and again.
unsigned part(int attempt) { return (32768u + 40503u * static_cast<unsigned>(attempt)) & 0xffffu; }

// Sample with just enough digits to distinguish 2^17 parts of the interval.
Sample finely(const Dyadic& lo, const Dyadic& hi, int attempt) {
    const unsigned k = std::max(lo.k, hi.k);
    const Int from = lo.n << (k - lo.k), width = (hi.n << (k - hi.k)) - from;
    const unsigned bits = width.is_zero() ? 0 : static_cast<unsigned>(msb(width)), extra = std::min(k + 16, bits > 0 ? bits - 1 : 0);
    const Dyadic at{((from << 16) + width * part(attempt)) >> extra, k + 16 - extra};
    return {at.rounded_down(), at};
}

}  // namespace

Sample Predicates::between(const Event& x, const Event& y, int attempt) {
    if (x.hi < y.lo) return within(x.hi, y.lo, attempt);
    // intervals that overlap: narrow them until they part
    if (double_only) return {0.25 * (x.lo + x.hi + y.lo + y.hi), {}};
    const auto [below, above] = settled(counters, [&]<class T>() -> std::optional<std::array<Dyadic, 2>> {
        if constexpr (std::is_same_v<T, Ball>) {
            const std::optional<Bracket> p = narrowed(x), q = narrowed(y);
            if (!p || !q || !is_below((*p)[1], (*q)[0])) return {};
            return {{Dyadic::from((*p)[1]), Dyadic::from((*q)[0])}};
        } else {
            const auto apart = [](auto p, auto q) -> std::array<Dyadic, 2> {
                while (cfree::compare(p.hi, q.lo) >= 0) {
                    const bool is_p_wider = q.is_dyadic() || (!p.is_dyadic() && p.digits() < q.digits());
                    (is_p_wider ? p : q).narrow();
                }
                return {p.hi, q.lo};
            };
            if (scene.is_round) return apart(long_root_of(x), long_root_of(y));
            return apart(narrow_root_of(x), narrow_root_of(y));
        }
    });
    const double lo = below.rounded_up(), hi = above.rounded_down();
    return lo < hi ? within(lo, hi, attempt) : finely(below, above, attempt);
}

Sample Predicates::within(double lo, double hi, int attempt) {
    if (!(hi - lo > std::max(0x1p-36 * std::max(std::abs(lo), std::abs(hi)), tiny))) {  // few doubles, or none
        if (const double mid = 0.5 * (lo + hi); attempt == 0 && lo < mid && mid < hi) return {mid, {}};
        return finely(Dyadic::from(lo), Dyadic::from(hi), attempt);
    }
    const double at = lo + part(attempt) * 0x1p-16 * (hi - lo);
    if (attempt > 0) return {at, {}};
    // |at| is below 2^36 (hi - lo), so that its leading digits fit a machine integer
    const double scale = 32 * power_below(hi - lo), few = static_cast<double>(static_cast<std::int64_t>(at * scale)) / scale;
    return {lo < few && few < hi ? few : at, {}};
}

Predicates::RangeEnd Predicates::range_end(const Scene& scene, Index g, Index f, bool is_start, Counters& counters) {
    const ParallelAngle p = parallel_angle(scene, g, f, counters);  // antiparallel is half a turn further
    if (p.side == 0) {
        const bool quarter = !p.up;  // theta = pi/2, else -pi/2
        if (is_start) return {quarter ? 1 : 0, chart_end(-1)};
        return {quarter ? 0 : 1, chart_end(1)};
    }
    return {p.side < 0 ? 0 : 1, {{Kind::edge_edge, g, f}, {}, p.tau - p.half, p.tau + p.half}};
}

}  // namespace cfree
