// Positions of curves on lines and circles, and intervals of their derivatives; theory, "Meshes among rounded shapes".
#include "cfree/contact/round_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cfree/support/elementary.hpp"
#include "predicates/round_surfaces.hpp"

namespace cfree {

namespace {
using std::numbers::pi;
constexpr double equal_share = 1e-13;  // lengths that differ by less of them are equal
constexpr double unbounded = std::numeric_limits<double>::infinity();

struct Range {
    double lo, hi;
    double most() const { return std::max(std::abs(lo), std::abs(hi)); }
    double width() const { return hi - lo; }
};
Range operator+(Range x, Range y) { return {x.lo + y.lo, x.hi + y.hi}; }
Range operator-(Range x, Range y) { return {x.lo - y.hi, x.hi - y.lo}; }
Range operator*(Range x, Range y) {
    const auto [lo, hi] = std::minmax({x.lo * y.lo, x.lo * y.hi, x.hi * y.lo, x.hi * y.hi});
    return {lo, hi};
}
Range operator*(double k, Range x) { return Range{k, k} * x; }
Range squared(Range x) {
    const double least = x.lo <= 0 && x.hi >= 0 ? 0 : std::min(std::abs(x.lo), std::abs(x.hi));
    return {least * least, x.most() * x.most()};
}
// Of a range above 0; unbounded for others.
Range inverse(Range x) { return x.lo > 0 ? Range{1 / x.hi, 1 / x.lo} : Range{0, unbounded}; }
Range root(Range x) { return {std::sqrt(std::max(0.0, x.lo)), std::sqrt(std::max(0.0, x.hi))}; }
Range both(Range x, Range y) {
    const Range result{std::max(x.lo, y.lo), std::min(x.hi, y.hi)};
    return result.lo <= result.hi ? result : x;  // they differ by rounding
}

// Values of a function and of its two derivatives over an interval of angles.
struct Jet {
    Range f, d, dd;
};
Jet operator*(const Jet& x, const Jet& y) { return {x.f * y.f, x.d * y.f + x.f * y.d, x.dd * y.f + 2 * (x.d * y.d) + x.f * y.dd}; }
Jet operator-(const Jet& x, const Jet& y) { return {x.f - y.f, x.d - y.d, x.dd - y.dd}; }
Jet constant(double x) { return {{x, x}, {0, 0}, {0, 0}}; }
Jet inverse(const Jet& x) {
    const Range y = inverse(x.f), yy = squared(y);
    return {y, -1 * (x.d * yy), 2 * (squared(x.d) * (y * yy)) - x.dd * yy};
}
Jet root(const Jet& x) {
    const Range y = root(x.f), half = 0.5 * inverse(y);
    const Range d = x.d * half;
    return {y, d, (x.dd - 2 * squared(d)) * half};
}

Harmonic dot_with_turned(Complex p, Complex q) {  // p . (z q)
    const Complex v = std::conj(p) * q;
    return {0, v.real(), -v.imag()};
}
Harmonic cross_with_turned(Complex p, Complex q) {  // p x (z q)
    const Complex v = std::conj(p) * q;
    return {0, v.imag(), v.real()};
}
Harmonic operator+(Harmonic x, double k) { return {x.a + k, x.b, x.c}; }
Harmonic operator*(double k, Harmonic x) { return {k * x.a, k * x.b, k * x.c}; }

Range range_of(const Harmonic& f, double from, double to) {
    const double at_from = f.at(from), at_to = f.at(to), size = norm(f.b, f.c), peak = arc_tangent(f.c, f.b);
    Range result{std::min(at_from, at_to), std::max(at_from, at_to)};
    const auto has = [&](double phi) { return phi + 2 * pi * std::ceil((from - phi) / (2 * pi)) <= to; };
    if (has(peak)) result.hi = f.a + size;
    if (has(peak + pi)) result.lo = f.a - size;
    return result;
}
Jet jet_of(const Harmonic& f, double from, double to) {
    return {range_of(f, from, to), range_of({0, f.c, -f.b}, from, to), range_of({0, -f.b, -f.c}, from, to)};
}

Jet arc_cosine(const Jet& q) {
    const auto arc = [](double x) { return arc_tangent(std::sqrt(std::max(0.0, (1 - x) * (1 + x))), x); };
    const Range left{std::min(1 - q.f.hi * q.f.hi, 1 - q.f.lo * q.f.lo), 1}, over = inverse(root(left));
    const Range bend = -1 * (q.dd * over + q.f * (squared(q.d) * (over * squared(over))));
    return {{arc(q.f.hi), arc(q.f.lo)}, -1 * (q.d * over), left.lo > 0 ? bend : Range{-unbounded, unbounded}};
}

// Bound of a function's distance from its chord: by its second derivative, or by all its values.
double bow_of(const Jet& x, double step) {
    const double bent = x.dd.most() * step * step / 8;
    return std::min(std::isfinite(bent) ? bent : unbounded, x.f.width());
}

}  // namespace

double Harmonic::at(double phi) const {
    const CosineSine z = cosine_sine(phi);
    return a + b * z.c + c * z.s;
}

namespace {
using Values = RoundCurve::Motion;  // of a function and its derivatives at an angle

Values values(const Harmonic& f, double phi, double scale = 1) {
    const CosineSine z = cosine_sine(scale * phi);
    const double turned = f.b * z.c + f.c * z.s;
    return {f.a + turned, scale * (f.c * z.c - f.b * z.s), -scale * scale * turned};
}
Values operator*(const Values& x, const Values& y) {
    return {x.s * y.s, x.velocity * y.s + x.s * y.velocity, x.acceleration * y.s + 2 * x.velocity * y.velocity + x.s * y.acceleration};
}
Values quotient(const Values& x, const Values& y) {
    const double f = x.s / y.s, d = (x.velocity - f * y.velocity) / y.s;
    return {f, d, (x.acceleration - 2 * d * y.velocity - f * y.acceleration) / y.s};
}
Values root(const Values& x) {
    constexpr double least = 1e-16;
    const double f = std::max(std::sqrt(std::max(0.0, x.s)), least), d = 0.5 * x.velocity / f;
    return {f, d, (0.5 * x.acceleration - d * d) / f};
}

// Root of level - f. If the two touch, that is a sine of half the angle, positive at the angle `inside`.
Values root_below(const Harmonic& f, double level, double phi, double inside) {
    const double size = norm(f.b, f.c), rest = level - f.a - size, peak = arc_tangent(f.c, f.b);
    const CosineSine half = cosine_sine(0.5 * (phi - peak));
    if (std::abs(rest) <= equal_share * (std::abs(level) + std::abs(f.a) + size)) {
        const double k = std::copysign(std::sqrt(2 * size), sine(0.5 * (inside - peak)));
        return {k * half.s, 0.5 * k * half.c, -0.25 * k * half.s};
    }
    return root(Values{rest + 2 * size * half.s * half.s, 2 * size * half.s * half.c, size * (half.c * half.c - half.s * half.s)});
}
}  // namespace

RoundCurve::Motion RoundCurve::root_at(double phi) const {
    const auto both = [&](const Harmonic& f, double lo, double hi) {
        return root_below(f, hi, phi, inside) * root_below(-1 * f, -lo, phi, inside);
    };
    if (form == Form::on_line) return both(height, -radius, radius);
    if (meets_line) return Motion{1 / radius, 0, 0} * both(delta, -radius, radius);
    const double sum = radius + other_radius, difference = radius - other_radius;
    const Motion length = root(values(square, phi));
    return quotient(Motion{0.5 / radius, 0, 0} * both(square, difference * difference, sum * sum), length);
}

RoundCurve::RoundCurve(const Places& places, const Feature& on, const Feature& other, double from, double to) {
    inside = 0.5 * (from + to);
    if (is_circle(on) || is_circle(other)) {
        if (is_circle(on)) meet_on_circle(places, on, other, from, to);
        else meet_on_line(places, on, other);
        join_branches();
        return;
    }
    form = Form::line;
    const auto parts = places.parts(on);
    curve = ContactCurve(places, on, other, from, to);
    is_saddle = on.kind == Kind::edge_vertex, direction = parts.edge, origin = is_saddle ? parts.b : 0;
}

// Two surfaces that touch at every angle have one curve, with no branch.
void RoundCurve::join_branches() {
    const auto is_still = [](const Harmonic& f) { return norm(f.b, f.c) <= equal_share * (std::abs(f.a) + norm(f.b, f.c)); };
    if (form == Form::on_line && is_still(height) && std::abs(std::abs(height.a) - radius) <= equal_share * radius) branch = 0;
    if (form != Form::on_circle || is_equal || !is_still(square) || !is_still(delta)) return;
    const double most = radius * std::sqrt(square.a);
    if (std::abs(std::abs(delta.a) - most) <= equal_share * most) branch = 0;
}

void RoundCurve::meet_on_line(const Places& places, const Feature& on, const Feature& other) {
    const auto parts = places.parts(on);
    const Complex a2 = places.a(other.robot), b2 = places.b(other.obstacle), e = parts.edge;
    radius = std::abs(sum_of_radii(places.scene, other)) * places.scene.unit();
    branch = is_smooth(places.scene, on, other) || radius == 0 ? 0 : other.branch;
    form = Form::on_line;
    if (on.kind == Kind::vertex_edge) {
        middle = -1 * dot_with_turned(e, a2) + dot(e, b2);
        height = -1 * cross_with_turned(e, a2 - parts.a) + cross(e, b2 - parts.b);
    } else {  // (z e) . v = v . (z e), (z e) x v = -v x (z e)
        middle = -1 * dot_with_turned(b2 - parts.b, e) + dot(e, a2);
        height = cross_with_turned(b2 - parts.b, e) + cross(e, a2 - parts.a);
    }
}

void RoundCurve::meet_on_circle(const Places& places, const Feature& on, const Feature& other, double from, double to) {
    const double rho = sum_of_radii(places.scene, on) * places.scene.unit();
    radius = std::abs(rho), begin = begin_of(on.branch, rho), side = rho < 0 ? -1 : 1;
    if (other.kind == Kind::seam) {
        start = (other.branch == on.branch) == (side > 0) ? 0 : 0.5 * pi;
        return;
    }
    const Complex a = places.a(on.robot), b = places.b(on.obstacle);
    branch = other.branch;
    if (is_line(other)) {
        const auto parts = places.parts(other);
        const bool turns = other.kind == Kind::edge_vertex;
        const Complex inwards = i_unit * (turns ? -parts.edge : parts.edge);  // n = JV, of length 1
        if (is_smooth(places.scene, other, on)) {
            form = turns ? Form::turning : Form::still;
            start = side * (std::arg(-side * inwards) - begin);
            return;
        }
        form = Form::on_circle, square = {1, 0, 0}, meets_line = true;
        (turns ? moving : still) = inwards;
        // delta = -V x (C - Q), Q on the moved line
        if (turns) delta = -1 * cross_with_turned(b - parts.b, parts.edge) + cross(-i_unit * inwards, a - parts.a);
        else delta = cross_with_turned(parts.edge, a - parts.a) + -cross(parts.edge, b - parts.b);
        if (turns) turn = {1, 0, 0};
        return;
    }
    const Complex db = places.b(other.obstacle) - b, da = places.a(other.robot) - a;
    const double r = std::abs(sum_of_radii(places.scene, other)) * places.scene.unit();
    form = Form::on_circle, still = db, moving = -da, other_radius = r;
    if (radius == r && std::abs(std::abs(db) - std::abs(da)) <= equal_share * std::abs(da)) {
        // n = -2 i sin((phi - meeting) / 2) exp(i (phi + meeting) / 2) da, and |n| / (2 radius) is the cosine
        is_equal = true, meeting = std::arg(db * std::conj(da));
        const double middle_angle = 0.5 * (from + to);
        meeting = middle_angle + std::remainder(meeting - middle_angle, 2 * pi);
        return;
    }
    square = -2 * dot_with_turned(db, da) + (std::norm(db) + std::norm(da));
    delta = 0.5 * (square + (radius - r) * (radius + r));
    turn = -1 * dot_with_turned(db, da) + std::norm(da);
}

double RoundCurve::position(double phi) const {
    switch (form) {
        case Form::still: return in_quadrant(start);
        case Form::turning: return in_quadrant(start + side * phi);
        case Form::line: {
            const Complex x = curve.at(phi) - origin;
            return is_saddle ? -dot(x, std::polar(1.0, phi) * direction) : dot(x, direction);
        }
        case Form::on_line: {
            return middle.at(phi) + (branch == 0 ? 0 : branch * root_at(phi).s);
        }
        case Form::on_circle: break;
    }
    Complex n = still + std::polar(1.0, phi) * moving;
    double q = delta.at(phi) / (radius * std::abs(n));
    if (is_equal) {
        const double half = sine(0.5 * (phi - meeting));
        n = (half < 0 ? 1.0 : -1.0) * i_unit * std::polar(1.0, 0.5 * (phi + meeting)) * -moving;
        q = std::abs(half * moving) / radius;
    }
    q = std::clamp(q, -1.0, 1.0);
    const double root = is_equal ? std::sqrt((1 - q) * (1 + q)) : root_at(phi).s;
    return in_quadrant(side * (std::arg(n * Complex{q, branch * root}) - begin));
}

RoundCurve::Motion RoundCurve::motion(double phi) const {
    const double s = position(phi);
    if (form == Form::still) return {s, 0, 0};
    if (form == Form::turning) return {s, side, 0};
    if (form == Form::line) {
        const Complex x = curve.at(phi) - origin, v = curve.velocity(phi), w = curve.acceleration(phi);
        if (!is_saddle) return {s, dot(v, direction), dot(w, direction)};
        const Complex z = std::polar(1.0, phi) * direction;
        return {s, -dot(v - i_unit * x, z), -dot(w - 2.0 * i_unit * v - x, z)};
    }
    if (form == Form::on_line) {
        const Motion m = values(middle, phi);
        if (branch == 0) return {s, m.velocity, m.acceleration};
        const Motion half = root_at(phi);
        return {s, m.velocity + branch * half.velocity, m.acceleration + branch * half.acceleration};
    }
    Motion turned{0, 0.5, 0}, q{};  // arg n, and the cosine
    if (is_equal) {
        q = values((std::abs(moving) / radius) * Harmonic{0, -sine(0.5 * meeting), cosine(0.5 * meeting)}, phi, 0.5);
        if (q.s < 0) q = {-q.s, -q.velocity, -q.acceleration};
    } else {
        const Motion n = values(square, phi), rate = quotient(values(turn, phi), n);
        turned = {0, rate.s, rate.velocity};
        q = quotient(values((1 / radius) * delta, phi), root(n));
    }
    if (branch == 0) return {s, side * turned.velocity, side * turned.acceleration};
    const Motion w = is_equal ? root(Motion{(1 - q.s) * (1 + q.s), -2 * q.s * q.velocity, -2 * (q.velocity * q.velocity + q.s * q.acceleration)})
                              : root_at(phi);
    // derivative of arccos q: w' / q or -q' / w
    const Motion slope = std::abs(q.s) > 0.5 ? quotient({w.velocity, w.acceleration, 0}, q) : quotient({-q.velocity, -q.acceleration, 0}, w);
    return {s, side * (turned.velocity + branch * slope.s), side * (turned.acceleration + branch * slope.velocity)};
}

double RoundCurve::bow_of_line(double from, double to) const {
    const double step = to - from, bend = curve.bend_near(from, to);
    if (!is_saddle) return bend * step * step / 8;
    // s = -(x - b) . (z e): s'' has the parts x'', 2 x' and x - b
    const double speed = curve.speed(from, to), reach = std::min(std::abs(curve.at(from) - origin), std::abs(curve.at(to) - origin)) + speed * step;
    return (bend + 2 * speed + reach) * step * step / 8;
}

double RoundCurve::bow(double from, double to) const {
    const double step = to - from;
    if (form == Form::still || form == Form::turning) return 0;
    if (form == Form::line) return bow_of_line(from, to);
    if (form == Form::on_line) {
        const Jet m = jet_of(middle, from, to);
        if (branch == 0) return m.dd.most() * step * step / 8;
        const Jet k = jet_of(height, from, to), half = root(constant(radius * radius) - k * k);
        // the line's middle and the half chord apart: only the second begins like a root
        return m.dd.most() * step * step / 8 + bow_of(half, step);
    }
    // psi = arg n + branch arccos q, q = delta / (radius |n|)
    if (is_equal) {
        Jet q = jet_of((std::abs(moving) / radius) * Harmonic{0, -sine(0.5 * meeting), cosine(0.5 * meeting)}, 0.5 * from, 0.5 * to);
        if (q.f.hi <= 0) q = constant(0) - q;
        q.d = 0.5 * q.d, q.dd = 0.25 * q.dd;
        return bow_of(arc_cosine(q), step);  // arg n is linear
    }
    const Jet n = jet_of(square, from, to), t = jet_of(turn, from, to);
    if (!(n.f.lo > 0)) return unbounded;
    const Jet rate = t * inverse(n);  // of arg n
    double result = std::min(rate.d.most() * step / 8, rate.f.most()) * step;
    if (branch == 0) return result;
    Jet q = jet_of((1 / radius) * delta, from, to) * inverse(root(n));
    const double at_middle = delta.at(0.5 * (from + to)) / (radius * std::sqrt(square.at(0.5 * (from + to))));
    q.f = both(q.f, Range{at_middle, at_middle} + 0.5 * step * Range{-q.d.most(), q.d.most()});
    return result + bow_of(arc_cosine(q), step);
}

}  // namespace cfree
