#include "cfree/predicates.hpp"

#include <algorithm>
#include <stdexcept>

namespace cfree {

namespace {

constexpr double u = 0x1p-53;
// Coefficients are one cross or dot product of differences: at most 6 roundings in a row. The polar form adds 5 and at
// most doubles the magnitude: 22 u would do.
constexpr double coefficient_error = 32 * u;
constexpr double product_error = 8 * u;
// More than any underflow loses: coefficients are far above it or zero.
constexpr double tiny = 0x1p-1000;

const Event wall_event(int side) { return {{}, {}, double(side), double(side)}; }

// A direction times a power of two, so that products of two are neither huge nor tiny.
Vec<Approx> of_unit_size(const Vec<Approx>& d) {
    const double scale = power_below(std::max(d.x.m, d.y.m));
    return {{d.x.v * scale, d.x.m * scale}, {d.y.v * scale, d.y.m * scale}};
}

// k f - l g for constants k, l that are themselves within ek, el of the truth
Filtered combination(double k, double ek, const Filtered& f, double l, double el, const Filtered& g) {
    const double mf = 2 * (std::abs(f.a) + std::abs(f.b) + std::abs(f.c));
    const double mg = 2 * (std::abs(g.a) + std::abs(g.b) + std::abs(g.c));
    const double err = (std::abs(k) + ek) * f.err + (std::abs(l) + el) * g.err + mf * (ek + product_error * std::abs(k)) +
                       mg * (el + product_error * std::abs(l));
    return {k * f.a - l * g.a, k * f.b - l * g.b, k * f.c - l * g.c, err * (1 + 8 * u) + tiny};
}

// Signs of products of differences, in machine integers where they fit.
int dot_sign(const Scene& s, Index g, Index f) {
    if (s.robot.is_narrow() && s.obstacles.is_narrow()) return sign_of(dot(edge<Wide>(s.robot, g), edge<Wide>(s.obstacles, f)));
    return sign_of(dot(edge<Int>(s.robot, g), edge<Int>(s.obstacles, f)));
}
bool is_parallel(const Shape& s, Index e, Index p, Index q) {  // edge e and the line through two vertices
    if (s.is_narrow()) return cross(edge<Wide>(s, e), difference<Wide>(s, p, q)) == 0;
    return cross(edge<Int>(s, e), difference<Int>(s, p, q)).is_zero();
}
// Order of the angles of two pairs of edges, as directions (G.F, G x F) turned to the right half-plane.
template <class T>
int parallel_order(const Scene& s, const Feature& x, const Feature& y) {
    const auto direction = [&](const Feature& f) {
        const auto G = edge<T>(s.robot, f.robot), F = edge<T>(s.obstacles, f.obstacle);
        const Vec<T> d{dot(G, F), cross(G, F)};
        return sign_of(d.x) < 0 ? -d : d;
    };
    return sign_of(cross(direction(y), direction(x)));
}

bool same_feature(const Scene& s, const Feature& x, const Feature& y) { return code(s, x) == code(s, y); }

}  // namespace

Code code(const Scene& scene, const Feature& f) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    Index i = 0, j = 0;
    switch (f.kind) {
        case Kind::none: return 0;
        case Kind::vertex_edge: i = A.point[f.robot], j = O.line[f.obstacle]; break;
        case Kind::edge_vertex: i = A.line[f.robot], j = O.point[f.obstacle]; break;
        case Kind::vertex_vertex: i = A.point[f.robot], j = O.point[f.obstacle]; break;
        case Kind::edge_edge: i = A.direction[f.robot], j = O.direction[f.obstacle]; break;
    }
    return static_cast<Code>(f.kind) << 61 | static_cast<Code>(i) << 31 | static_cast<Code>(j);
}

// --- the quadratics, one formula for every number type ---------------------------------------------------------------

template <class T>
Trig<T> Predicates::offset_trig(Index s, Index v) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const Index i = surface.contact.robot, j = surface.contact.obstacle;
    if (surface.contact.kind == Kind::vertex_edge) {  // E_j x (b_v - b_j - R (a_s - a_i))
        const auto E = edge<T>(O, j), w = difference<T>(O, v, O.v[j]), d = difference<T>(A, s, i);
        return {cross(E, w), -cross(E, d), -dot(E, d)};
    }
    // -R E_i x (b_v - b_j - R (a_s - a_i))
    const auto E = edge<T>(A, i), w = difference<T>(O, v, j), d = difference<T>(A, s, A.v[i]);
    return {cross(E, d), -cross(E, w), dot(E, w)};
}

template <class T>
Trig<T> Predicates::parallel_trig(Index g, Index f) const {
    const auto G = edge<T>(scene.robot, g), F = edge<T>(scene.obstacles, f);
    return {T{}, cross(G, F), -dot(G, F)};
}

// The half-plane of a pillar's edge e cuts the surface's line P + t U, P = b_j - R a_i, where e's direction V and point Q give
// V x (P - Q) + t (V x U) = 0, so t = N / D with N = -V x (P - Q), D = V x U.
template <class T>
std::array<Trig<T>, 2> Predicates::curve_trig(const Feature& f) const {
    const Shape &A = scene.robot, &O = scene.obstacles;
    const bool on_edge = surface.contact.kind == Kind::vertex_edge;
    const Index i = surface.contact.robot, j = surface.contact.obstacle;
    const Index a0 = on_edge ? i : A.v[i], b0 = on_edge ? O.v[j] : j;
    const auto E = on_edge ? edge<T>(O, j) : edge<T>(A, i);
    if (f.kind == Kind::vertex_vertex) {  // t is where the vertex lies on the edge
        const auto w = on_edge ? difference<T>(O, f.obstacle, b0) : difference<T>(A, f.robot, a0);
        return {Trig<T>{dot(w, E), T{}, T{}}, Trig<T>{dot(E, E), T{}, T{}}};
    }
    if (f.kind == Kind::vertex_edge) {  // V = F, Q = b_f - R a_s
        const auto F = edge<T>(O, f.obstacle), w = difference<T>(O, O.v[f.obstacle], b0), d = difference<T>(A, a0, f.robot);
        const Trig<T> N{cross(F, w), cross(F, d), dot(F, d)};
        if (on_edge) return {N, Trig<T>{cross(F, E), T{}, T{}}};
        return {N, Trig<T>{T{}, -cross(F, E), -dot(F, E)}};
    }
    // V = -R G, Q = b_v - R a_g
    const auto G = edge<T>(A, f.robot), w = difference<T>(O, b0, f.obstacle), d = difference<T>(A, A.v[f.robot], a0);
    const Trig<T> N{cross(G, d), cross(G, w), -dot(G, w)};
    if (on_edge) return {N, Trig<T>{T{}, -cross(G, E), dot(G, E)}};
    return {N, Trig<T>{cross(G, E), T{}, T{}}};
}

Filtered Predicates::filtered(const Trig<Approx>& f) const {
    return {f.a.v, kappa * f.b.v, kappa * f.c.v, coefficient_error * (f.a.m + f.b.m + f.c.m) + tiny};
}
Filtered Predicates::offset(Index s, Index v) const { return filtered(offset_trig<Approx>(s, v)); }
Filtered Predicates::parallel(Index g, Index f) const { return filtered(parallel_trig<Approx>(g, f)); }
Curve Predicates::curve(const Feature& f) const {
    const auto [N, D] = curve_trig<Approx>(f);
    const bool constant = f.kind == Kind::vertex_vertex;
    return {f, code(scene, f), constant, constant || f.kind == surface.contact.kind, false, filtered(N), filtered(D)};
}

// --- signs -----------------------------------------------------------------------------------------------------------

int Predicates::sign_on(const Filtered& f, double lo, double hi) {
    const double p = f.polar(lo, lo), q = f.polar(lo, hi), r = f.polar(hi, hi);
    if (p > f.err && q > f.err && r > f.err) return 1;
    if (p < -f.err && q < -f.err && r < -f.err) return -1;
    return 0;
}

Poly Predicates::polynomial(const Trig<Int>& f) const {
    if (kappa > 0) return {f.a + f.b, 2 * f.c, f.a - f.b};
    return {f.a - f.b, -2 * f.c, f.a + f.b};
}

// What an event's features define; see Event. Two curves: N1 D2 - N2 D1.
Poly Predicates::polynomial(const Feature& first, const Feature& second) const {
    if (second.kind == Kind::none) {
        if (first.kind == Kind::edge_edge) return polynomial(parallel_trig<Int>(first.robot, first.obstacle));
        return polynomial(offset_trig<Int>(first.robot, first.obstacle));
    }
    const auto [N1, D1] = curve_trig<Int>(first);
    const auto [N2, D2] = curve_trig<Int>(second);
    return difference(product(polynomial(N1), polynomial(D2)), product(polynomial(N2), polynomial(D1)));
}

int Predicates::sign_at(const Filtered& f, const Feature& feature, const Sample& at) {
    const double value = f.polar(at.tau, at.tau);
    if (!at.fine && std::abs(value) > f.err) return ++counters.filter, value > 0 ? 1 : -1;
    ++counters.exact;
    return cfree::sign_at(polynomial(feature, {}), at.exact());
}
int Predicates::offset_sign(Index s, Index v, const Filtered& f, const Sample& at) {
    return sign_at(f, {Kind::vertex_vertex, s, v}, at);
}
int Predicates::parallel_sign(Index g, Index f, const Filtered& value, const Sample& at) {
    return sign_at(value, {Kind::edge_edge, g, f}, at);
}

int Predicates::cross_sign(const Shape& shape, Index e, Index f) {
    if (shape.direction[e] == shape.direction[f]) return 0;
    const Approx value = cross(edge<Approx>(shape, e), edge<Approx>(shape, f));
    if (std::abs(value.v) > coefficient_error * value.m + tiny) return ++counters.filter, value.v > 0 ? 1 : -1;
    ++counters.exact;
    return cross(edge<Int>(shape, e), edge<Int>(shape, f)).sign();
}

// --- roots -----------------------------------------------------------------------------------------------------------

// A quadratic p, or the quartic p q - r s.
struct Predicates::Form {
    int degree;
    Filtered p, q, r, s;

    struct Value {
        double v, err;
    };
    Value at(double t) const {
        const double x = p.polar(t, t);
        if (degree == 2) return {x, p.err};
        const double y = q.polar(t, t), z = r.polar(t, t), w = s.polar(t, t);
        return {x * y - z * w, std::abs(x) * q.err + std::abs(y) * p.err + std::abs(z) * s.err + std::abs(w) * r.err +
                                   p.err * q.err + r.err * s.err + product_error * (std::abs(x * y) + std::abs(z * w)) + tiny};
    }
    // Bernstein coefficients on [lo, hi], all within the error returned
    double bernstein(double lo, double hi, double* c) const {
        const double p0 = p.polar(lo, lo), p1 = p.polar(lo, hi), p2 = p.polar(hi, hi);
        if (degree == 2) {
            c[0] = p0, c[1] = p1, c[2] = p2;
            return p.err;
        }
        const double q0 = q.polar(lo, lo), q1 = q.polar(lo, hi), q2 = q.polar(hi, hi);
        const double r0 = r.polar(lo, lo), r1 = r.polar(lo, hi), r2 = r.polar(hi, hi);
        const double s0 = s.polar(lo, lo), s1 = s.polar(lo, hi), s2 = s.polar(hi, hi);
        c[0] = p0 * q0 - r0 * s0;
        c[1] = 0.5 * ((p0 * q1 + p1 * q0) - (r0 * s1 + r1 * s0));
        c[2] = ((p0 * q2 + 4 * (p1 * q1) + p2 * q0) - (r0 * s2 + 4 * (r1 * s1) + r2 * s0)) / 6;
        c[3] = 0.5 * ((p1 * q2 + p2 * q1) - (r1 * s2 + r2 * s1));
        c[4] = p2 * q2 - r2 * s2;
        const auto largest = [](double x, double y, double z) { return std::max({std::abs(x), std::abs(y), std::abs(z)}); };
        const double P = largest(p0, p1, p2), Q = largest(q0, q1, q2), R = largest(r0, r1, r2), S = largest(s0, s1, s2);
        return P * q.err + Q * p.err + R * s.err + S * r.err + p.err * q.err + r.err * s.err +
               2 * product_error * (P * Q + R * S) + tiny;
    }
};

namespace {

enum class Found { none, one, unclear, hopeless };

// How many roots inside: by the variations of certain signs, uncertain ones allowed only where they cannot add any.
Found roots_inside(const double* c, int degree, double err) {
    int changes = 0, last = 0, gap = 0;
    bool ends = true;
    for (int i = 0; i <= degree; ++i) {
        const int s = c[i] > err ? 1 : c[i] < -err ? -1 : 0;
        if (s == 0) {
            if (i == 0 || i == degree) ends = false;
            gap = 1;
            continue;
        }
        if (last != 0) {
            if (s != last) ++changes;
            else if (gap) ends = false;
        }
        last = s, gap = 0;
    }
    if (last == 0) return Found::hopeless;
    if (!ends) return Found::unclear;
    return changes == 0 ? Found::none : changes == 1 ? Found::one : Found::unclear;
}

// Illinois method: false position that halves the value of an end that stays twice.
template <class Form>
double false_position(const Form& form, double a, double b, double fa, double fb) {
    double t = a;
    int stayed = 0;
    for (int k = 0; k < 60 && b - a > 4e-16; ++k) {
        t = (a * fb - b * fa) / (fb - fa);
        if (!(t > a && t < b)) t = 0.5 * (a + b);
        const auto value = form.at(t);
        if (std::abs(value.v) <= value.err) break;
        if ((value.v > 0) == (fb > 0)) {
            b = t, fb = value.v;
            if (stayed == 1) fa *= 0.5;
            stayed = 1;
        } else {
            a = t, fa = value.v;
            if (stayed == 2) fb *= 0.5;
            stayed = 2;
        }
    }
    return t;
}

// Shrink an interval with certain, opposite signs at its ends and one root inside.
template <class Form>
std::array<double, 2> refine(const Form& form, double lo, double hi) {
    const double flo = form.at(lo).v, fhi = form.at(hi).v;
    double t = lo, width;
    if (form.degree == 2) {  // (a - b) tau^2 + 2 c tau + (a + b)
        const double A = form.p.a - form.p.b, B = form.p.c, C = form.p.a + form.p.b;
        const double s = std::sqrt(std::max(0.0, B * B - A * C)), q = B > 0 ? -(B + s) : s - B;
        t = q / A;
        if (!(t >= lo && t <= hi)) t = C / q;
        if (!(t >= lo && t <= hi)) t = 0.5 * (lo + hi);
        width = form.p.err / s;
    } else {
        t = false_position(form, lo, hi, flo, fhi);
        const double l = std::max(lo, t - 1e-9), r = std::min(hi, t + 1e-9);
        width = 2 * form.at(t).err * (r - l) / std::abs(form.at(r).v - form.at(l).v);
    }
    // certain signs on both sides: widen until they are
    double delta = width + 2.3e-16;
    if (!(delta < hi - lo)) delta = hi - lo;
    for (int k = 0; k < 64; ++k, delta *= 2) {
        const double x = std::max(lo, t - delta), y = std::min(hi, t + delta);
        const auto vx = form.at(x), vy = form.at(y);
        const bool left = x == lo || (std::abs(vx.v) > vx.err && (vx.v > 0) == (flo > 0));
        const bool right = y == hi || (std::abs(vy.v) > vy.err && (vy.v > 0) == (fhi > 0));
        if (left && right) return {x, y};
    }
    return {lo, hi};
}

constexpr int enough = 8;

template <class Form>
bool isolate_by_filter(const Form& form, double lo, double hi, double (*found)[2], int& count) {
    struct Span {
        double lo, hi;
    };
    Span stack[64];
    int top = 0;
    stack[top++] = {lo, hi};
    int budget = 60;
    while (top > 0) {
        const Span s = stack[--top];
        double c[5];
        const double err = form.bernstein(s.lo, s.hi, c);
        const Found inside = roots_inside(c, form.degree, err);
        if (inside == Found::none) continue;
        if (inside == Found::hopeless) return false;
        if (inside == Found::one) {
            const auto bracket = refine(form, s.lo, s.hi);
            found[count][0] = bracket[0], found[count][1] = bracket[1];
            if (++count == enough) return false;
            continue;
        }
        if (--budget == 0 || s.hi - s.lo < 1e-14 || top > 60) return false;
        double mid = 0.5 * (s.lo + s.hi);
        const auto value = form.at(mid);
        if (std::abs(value.v) <= value.err) mid = s.lo + 0.4375 * (s.hi - s.lo);
        stack[top++] = {mid, s.hi};
        stack[top++] = {s.lo, mid};
    }
    return true;
}

}  // namespace

Predicates::Form Predicates::form(const Curve& p, const Curve& q) const {
    if (p.constant_D && q.constant_D)
        return {2, combination(q.D.a, q.D.err, p.N, p.D.a, p.D.err, q.N), {}, {}, {}};
    if (p.constant)
        return {2, combination(p.N.a, p.N.err, q.D, p.D.a, p.D.err, q.N), {}, {}, {}};
    if (q.constant)
        return {2, combination(q.D.a, q.D.err, p.N, q.N.a, q.N.err, p.D), {}, {}, {}};
    return {4, p.N, q.D, q.N, p.D};
}

Predicates::Form Predicates::form(const Event& x) const {
    if (x.second.kind != Kind::none) return form(curve(x.first), curve(x.second));
    if (x.first.kind == Kind::edge_edge) return {2, parallel(x.first.robot, x.first.obstacle), {}, {}, {}};
    return {2, offset(x.first.robot, x.first.obstacle), {}, {}, {}};
}

Predicates::Roots Predicates::roots(const Form& f, const Feature& first, const Feature& second, const Event& from,
                                    const Event& to) {
    Roots result;
    const auto keep = [&](const Event& x) {
        if (order(from, x) >= 0 || order(x, to) >= 0) return;
        if (result.count == 4) throw std::logic_error("more roots than the degree");
        result.at[result.count++] = x;
    };
    // A root may be one of the two ends: look a little beyond them, then compare.
    double found[enough][2];
    int count = 0;
    bool decided = false;
    for (double margin = 1e-12; margin < 1e-10 && !decided; margin *= 7)
        count = 0, decided = isolate_by_filter(f, from.lo - margin, to.hi + margin, found, count);
    if (decided) {
        ++counters.filter;
        for (int k = 0; k < count; ++k) keep({first, second, found[k][0], found[k][1]});
        return result;
    }
    ++counters.exact;
    const Poly p = polynomial(first, second);
    result.all_zero = p.empty();
    if (p.empty() || (p.size() == 3 && p[1] * p[1] <= 4 * p[0] * p[2])) return result;  // at most a touch
    const Sturm sturm(squarefree(p));
    const Dyadic lowest = Dyadic::from(std::nextafter(from.lo, -2)), highest = Dyadic::from(std::nextafter(to.hi, 2));
    for (auto [below, above] : isolate(sturm, lowest, highest, 56)) {
        const auto sign = [&](const Dyadic& t) { return cfree::sign_at(sturm.polynomial(), t); };
        while (sign(below) == 0) {  // the root before this one
            const Dyadic mid = Dyadic::middle(below, above);
            (sturm.roots_in(mid, above) == 1 ? below : above) = mid;
        }
        double l = below.rounded_down(), h = above.rounded_up();
        if (sign(above) == 0) below = above;
        else if (cfree::sign_at(p, below) == cfree::sign_at(p, above)) continue;  // a touch changes no sign
        // doubles around it, with no root at their ends; a finer interval if there is a second one between them
        while (sign(Dyadic::from(l)) == 0) l = std::nextafter(l, -2);
        while (sign(Dyadic::from(h)) == 0) h = std::nextafter(h, 2);
        Event x{first, second, l, h};
        if (sturm.roots_in(Dyadic::from(l), Dyadic::from(h)) != 1) {
            x.fine = static_cast<Index>(fine.size());
            fine.push_back({below, above});
        } else if (cfree::sign_at(p, Dyadic::from(l)) == cfree::sign_at(p, Dyadic::from(h))) {
            continue;
        }
        keep(x);
    }
    return result;
}

Predicates::Roots Predicates::offset_roots(Index s, Index v, const Filtered& f, const Event& from, const Event& to) {
    return roots(Form{2, f, {}, {}, {}}, {Kind::vertex_vertex, s, v}, {}, from, to);
}

namespace {

// The angle at which two edges are parallel, as that of the direction d = (G.F, G x F) turned to the right half-plane:
// tau = y / (|d| + |x|) moves by at most 2 (dx + dy) / |d| for errors dx, dy of 6 u times the magnitudes.
struct ParallelAngle {
    int side;  // sign of G.F before turning; 0 for a right angle
    bool up;   // sign of G x F before turning
    double tau, half;
};

ParallelAngle parallel_angle(const Scene& scene, Index g, Index f, Counters& counters) {
    const auto G = of_unit_size(edge<Approx>(scene.robot, g)), F = of_unit_size(edge<Approx>(scene.obstacles, f));
    const Approx c = dot(G, F), n = cross(G, F);
    const auto angle = [](double x, double y, double error) {
        const double length = std::hypot(x, y), sign = x < 0 ? -1 : 1;
        return ParallelAngle{x > 0 ? 1 : -1, y > 0, sign * y / (length + sign * x), 16 * u * error / length + 4 * u};
    };
    const ParallelAngle guess = angle(c.v, n.v, c.m + n.m);
    if (std::abs(c.v) > coefficient_error * c.m && guess.half < 64 * u) return ++counters.filter, guess;
    ++counters.exact;
    if (guess.half < 64 * u && dot_sign(scene, g, f) == 0) return {0, n.v > 0, 0, 0};
    // the direction itself, exactly, and then rounded
    const auto E = edge<Int>(scene.robot, g), H = edge<Int>(scene.obstacles, f);
    Vec<Int> d{dot(E, H), cross(E, H)};
    if (d.x.is_zero()) return {0, d.y.sign() > 0, 0, 0};
    const auto bits = [](const Int& z) { return z.is_zero() ? 0 : static_cast<int>(msb(abs(z))); };
    const int excess = std::max(bits(d.x), bits(d.y)) - 500;
    if (excess > 0) d.x /= Int(1) << static_cast<unsigned>(excess), d.y /= Int(1) << static_cast<unsigned>(excess);
    const int side = dot_sign(scene, g, f);
    ParallelAngle result = angle(std::abs(d.x.convert_to<double>()) * side, d.y.convert_to<double>(), 2);
    result.half = 16 * u;
    result.side = side;
    if (d.x.is_zero()) result.tau = side * (d.y.sign() > 0 ? 1 : -1);
    return result;
}

}  // namespace

Predicates::Roots Predicates::parallel_roots(Index g, Index f, const Event& from, const Event& to) {
    // one in the chart, or two at its walls
    Roots result;
    const ParallelAngle p = parallel_angle(scene, g, f, counters);
    if (p.side == 0) return result;
    const Event x{{Kind::edge_edge, g, f}, {}, p.tau - p.half, p.tau + p.half};
    if (order(from, x) < 0 && order(x, to) < 0) result.at[result.count++] = x;
    return result;
}

// Surfaces that share a helix cross where the helix meets the line, and where their own lines are parallel.
Predicates::Roots Predicates::crossings(const Form& f, const Feature& p, const Feature& q, const Event& from,
                                        const Event& to) {
    const Shape &A = scene.robot, &O = scene.obstacles;
    if (p.kind == Kind::vertex_vertex || q.kind == Kind::vertex_vertex) return roots(f, p, q, from, to);
    if (p.kind == Kind::edge_vertex && q.kind == Kind::vertex_edge) return crossings(f, q, p, from, to);
    const auto end_of = [](const Shape& s, Index vertex, Index e) {
        return s.point[vertex] == s.point[s.v[e]] || s.point[vertex] == s.point[s.w[e]];
    };
    const auto shared_end = [&](const Shape& s, Index e, Index g) {
        return end_of(s, s.v[e], g) ? s.v[e] : end_of(s, s.w[e], g) ? s.w[e] : -1;
    };
    Index a = -1, b = -1;
    if (p.kind != q.kind) {  // v-e and e-v
        if (end_of(A, p.robot, q.robot) && end_of(O, q.obstacle, p.obstacle)) a = p.robot, b = q.obstacle;
    } else if (p.kind == Kind::vertex_edge) {
        if (A.point[p.robot] == A.point[q.robot]) a = p.robot, b = shared_end(O, p.obstacle, q.obstacle);
    } else if (O.point[p.obstacle] == O.point[q.obstacle]) {
        a = shared_end(A, p.robot, q.robot), b = p.obstacle;
    }
    if (a < 0 || b < 0) return roots(f, p, q, from, to);
    Roots result = offset_roots(a, b, offset(a, b), from, to);
    if (result.all_zero || p.kind == q.kind) return result;
    const Roots parallel = parallel_roots(q.robot, p.obstacle, from, to);
    for (int k = 0; k < parallel.count; ++k) {
        int at = result.count;
        while (at > 0 && order(parallel.at[k], result.at[at - 1]) < 0) --at;
        if (at > 0 && order(parallel.at[k], result.at[at - 1]) == 0) continue;
        for (int m = result.count++; m > at; --m) result.at[m] = result.at[m - 1];
        result.at[at] = parallel.at[k];
    }
    return result;
}

Predicates::Order Predicates::compare(const Curve& p, const Curve& q, const Event& from, const Event& to) {
    Order result;
    const auto constant = [&](int s) {
        result.sign[0] = s;
        return result;
    };
    if (p.code == q.code) return constant(0);
    const Form f = form(p, q);
    double c[5];
    const double err = f.bernstein(from.lo, to.hi, c);
    int positive = 0, negative = 0;
    for (int i = 0; i <= f.degree; ++i) positive += c[i] > err, negative += c[i] < -err;
    if (positive == f.degree + 1) return ++counters.filter, constant(1);
    if (negative == f.degree + 1) return ++counters.filter, constant(-1);
    const Roots r = crossings(f, p.feature, q.feature, from, to);
    if (r.all_zero) return constant(0);
    const int flip = p.flipped != q.flipped ? -1 : 1;
    result.count = r.count;
    for (int k = 0; k <= r.count; ++k) {
        if (k < r.count) result.at[k] = r.at[k];
        const Event &before = k == 0 ? from : r.at[k - 1], &after = k == r.count ? to : r.at[k];
        result.sign[k] = 0;
        for (int attempt = 0; result.sign[k] == 0; ++attempt) {  // a sample may be where the curves touch
            if (attempt == 20) throw std::logic_error("two different curves are equal at twenty samples");
            const Sample at = between(before, after, (attempt + 10) / 30.0 + (attempt == 0 ? 1 / 6.0 : 0));
            const auto value = f.at(at.tau);
            if (!at.fine && std::abs(value.v) > value.err) {
                ++counters.filter;
                result.sign[k] = value.v > 0 ? 1 : -1;
            } else {
                ++counters.exact;
                result.sign[k] = flip * cfree::sign_at(polynomial(p.feature, q.feature), at.exact());
            }
        }
    }
    return result;
}

// --- angles ----------------------------------------------------------------------------------------------------------

int Predicates::order(const Event& x, const Event& y) {
    if (x.hi < y.lo) return -1;
    if (x.lo > y.hi) return 1;
    if (x.first.kind == Kind::none && y.first.kind == Kind::none) return 0;  // one wall
    const bool parallels = x.first.kind == Kind::edge_edge && y.first.kind == Kind::edge_edge;
    if (parallels && same_feature(scene, x.first, y.first)) return 0;  // a chart holds one such angle
    return order_exactly(x, y);
}

// The only root of a polynomial in [lo, hi]: its sign changes between the ends, unless they are one.
struct Predicates::Root {
    Poly p;
    Dyadic lo, hi;
    void halve() {
        if (cfree::compare(lo, hi) == 0) return;
        const Dyadic mid = Dyadic::middle(lo, hi);
        const int s = cfree::sign_at(p, mid);
        if (s == 0) lo = hi = mid;
        else if (s == cfree::sign_at(p, lo)) lo = mid;
        else hi = mid;
    }
};

Predicates::Root Predicates::root_of(const Event& x) const {
    if (x.fine >= 0) return {polynomial(x.first, x.second), fine[x.fine][0], fine[x.fine][1]};
    return {polynomial(x.first, x.second), Dyadic::from(x.lo), Dyadic::from(x.hi)};
}

void Predicates::halve(Root& p, Root& q, int steps) {
    if (steps == 1000000) throw std::logic_error("two critical angles that differ do not part");
    p.halve(), q.halve();
}

int Predicates::place(const Event& x) const {
    if (x.fine < 0) return 0;
    return Sturm(squarefree(polynomial(x.first, x.second))).roots_in(Dyadic::from(x.lo), fine[x.fine][1]);
}

// Whether two angles are roots of one polynomial for a reason of identity.
bool Predicates::same_polynomial(const Event& x, const Event& y) const {
    if (x.first.kind == Kind::none || y.first.kind == Kind::none) return false;
    const auto same = [&](const Feature& p, const Feature& q) { return same_feature(scene, p, q); };
    if (same(x.first, y.first) && same(x.second, y.second)) return true;
    if (x.second.kind != Kind::none) return same(x.first, y.second) && same(x.second, y.first);
    if (x.first.kind != Kind::vertex_vertex || y.first.kind != Kind::vertex_vertex || y.second.kind != Kind::none)
        return false;
    // helices at one height above the surface's edge
    const Shape &A = scene.robot, &O = scene.obstacles;
    if (surface.contact.kind == Kind::vertex_edge)
        return A.point[x.first.robot] == A.point[y.first.robot] &&
               is_parallel(O, surface.contact.obstacle, x.first.obstacle, y.first.obstacle);
    return O.point[x.first.obstacle] == O.point[y.first.obstacle] &&
           is_parallel(A, surface.contact.robot, x.first.robot, y.first.robot);
}

int Predicates::order_at_wall(const Event& x, const Event& wall) const {
    const Root root = root_of(x);
    const Dyadic at = Dyadic::from(wall.lo);
    if (cfree::compare(at, root.lo) < 0) return 1;
    if (cfree::compare(root.hi, at) < 0) return -1;
    const int s = cfree::sign_at(root.p, at);
    if (s == 0) return 0;
    return cfree::sign_at(root.p, root.lo) == s ? 1 : -1;
}

// Whether a root of a + b cos + c sin is the angle at which two edges are parallel: that of the direction d = (G.F, G x F),
// so that a |d| = -(b, c).d.
bool Predicates::meets_parallel(const Event& parallel, const Event& x) const {
    if (parallel.first.kind != Kind::edge_edge) return false;
    Trig<Int> f;
    if (x.first.kind == Kind::vertex_vertex && x.second.kind == Kind::none) {
        f = offset_trig<Int>(x.first.robot, x.first.obstacle);
    } else if (x.first.kind == Kind::vertex_vertex || x.second.kind == Kind::vertex_vertex) {
        const bool first = x.first.kind == Kind::vertex_vertex;
        const auto [n, d] = curve_trig<Int>(first ? x.first : x.second);
        const auto [N, D] = curve_trig<Int>(first ? x.second : x.first);
        f = {n.a * D.a - d.a * N.a, n.a * D.b - d.a * N.b, n.a * D.c - d.a * N.c};
    } else {
        return false;
    }
    const auto G = edge<Int>(scene.robot, parallel.first.robot), F = edge<Int>(scene.obstacles, parallel.first.obstacle);
    const Vec<Int> d{dot(G, F), cross(G, F)};
    // in the right half-plane of the chart
    const Int along = d.x.sign() * (kappa > 0 ? 1 : -1) * (f.b * d.x + f.c * d.y);
    return along.sign() == -f.a.sign() && along * along == f.a * f.a * dot(d, d);
}

int Predicates::order_exactly(const Event& x, const Event& y) {
    // One root in each of two overlapping intervals: of one polynomial, opposite signs around both mean one root in all.
    const auto alone = [&](const Event& z) {
        const Form f = form(z);
        const auto l = f.at(std::min(x.lo, y.lo)), h = f.at(std::max(x.hi, y.hi));
        return std::abs(l.v) > l.err && std::abs(h.v) > h.err && (l.v > 0) != (h.v > 0);
    };
    if (same_polynomial(x, y) && alone(x)) return ++counters.filter, 0;
    ++counters.exact;
    if (x.first.kind == Kind::edge_edge && y.first.kind == Kind::edge_edge) {
        if (2 * (scene.robot.bits + scene.obstacles.bits + 1) < 126) return parallel_order<Wide>(scene, x.first, y.first);
        return parallel_order<Int>(scene, x.first, y.first);
    }
    if (x.first.kind == Kind::none) return -order_at_wall(y, x);
    if (y.first.kind == Kind::none) return order_at_wall(x, y);
    if ((meets_parallel(x, y) && alone(y)) || (meets_parallel(y, x) && alone(x))) return 0;
    Root p = root_of(x), q = root_of(y);
    if (cfree::compare(p.hi, q.lo) < 0) return -1;
    if (cfree::compare(q.hi, p.lo) < 0) return 1;
    const Dyadic lo = cfree::compare(p.lo, q.lo) < 0 ? q.lo : p.lo, hi = cfree::compare(p.hi, q.hi) < 0 ? p.hi : q.hi;
    const Poly g = greatest_common_divisor(p.p, q.p);
    if (g.size() > 1) {
        const int l = cfree::sign_at(g, lo), h = cfree::sign_at(g, hi);
        if (l == 0 || h == 0 || l != h || (g.size() > 2 && Sturm(squarefree(g)).roots_in(lo, hi) > 0)) return 0;
    }
    for (int k = 0;; ++k) {  // different roots: halve both intervals until they part
        if (cfree::compare(p.hi, q.lo) < 0) return -1;
        if (cfree::compare(q.hi, p.lo) < 0) return 1;
        halve(p, q, k);
    }
}

int Predicates::order(const Event& x, const Sample& at) {
    if (!at.fine && x.hi < at.tau) return -1;
    if (!at.fine && x.lo > at.tau) return 1;
    ++counters.exact;
    const Root root = root_of(x);
    const Dyadic t = at.exact();
    if (cfree::compare(t, root.lo) < 0) return 1;
    if (cfree::compare(root.hi, t) < 0) return -1;
    const int sign = cfree::sign_at(root.p, t);
    if (sign == 0) return 0;
    return sign == cfree::sign_at(root.p, root.lo) ? 1 : -1;
}

Sample Predicates::between(const Event& x, const Event& y, double part) {
    double lo = x.hi, hi = y.lo;
    if (!(lo < hi)) {  // intervals that overlap: halve them until they part
        ++counters.exact;
        Root p = root_of(x), q = root_of(y);
        for (int k = 0; cfree::compare(p.hi, q.lo) >= 0; ++k) halve(p, q, k);
        lo = p.hi.rounded_up(), hi = q.lo.rounded_down();
        if (!(std::nextafter(lo, hi) < hi)) {
            Dyadic below = p.hi, at = Dyadic::middle(p.hi, q.lo);
            for (int steps = 0; steps < static_cast<int>(8 * (1 - part)); ++steps) at = Dyadic::middle(below, at);
            return {at.rounded_down(), at};
        }
    }
    const double mid = lo + part * (hi - lo);
    if (!(lo < mid && mid < hi)) {  // neighbouring doubles
        const Dyadic at = Dyadic::middle(Dyadic::from(lo), Dyadic::from(hi));
        return {lo, at};
    }
    // |mid| is below 2^53 (hi - lo), so that its leading digits fit a machine integer
    const double scale = 32 * power_below(hi - lo), few = static_cast<double>(static_cast<std::int64_t>(mid * scale)) / scale;
    return {lo < few && few < hi ? few : mid, {}};
}

Predicates::RangeEnd Predicates::range_end(const Scene& scene, Index g, Index f, bool is_start, Counters& counters) {
    const ParallelAngle p = parallel_angle(scene, g, f, counters);  // antiparallel is half a turn further
    if (p.side == 0) {
        const bool quarter = !p.up;  // theta = pi/2, else -pi/2
        if (is_start) return {quarter ? 1 : 0, wall_event(-1)};
        return {quarter ? 0 : 1, wall_event(1)};
    }
    return {p.side < 0 ? 0 : 1, {{Kind::edge_edge, g, f}, {}, p.tau - p.half, p.tau + p.half}};
}

}  // namespace cfree
