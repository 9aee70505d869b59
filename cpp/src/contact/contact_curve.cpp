// Intersection curves of two surfaces, and bounds of their derivatives; theory, "Curves".
#include "cfree/contact/contact_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {
using std::numbers::pi;
constexpr double rounding = 1e-14;  // relative size below which a difference is zero

// Solve p.y = r and q.y = s for y.
Complex solve(Complex p, Complex q, double r, double s) { return i_unit * (s * p - r * q) / cross(p, q); }
}  // namespace

Places::Parts Places::parts(const Feature& f) const {
    const ContactLine<double> line(scene, f, *this);
    const Complex edge = complex(line.E);
    const double length = std::abs(edge);
    Complex a = complex(line.a), b = complex(line.b);
    if (scene.is_round) (line.on_edge ? b : a) -= sum_of_radii(scene, f) * scene.unit() * i_unit * edge / length;  // outwards
    return {a, b, edge / length, length};
}

ContactCurve::ContactCurve(const Places& places, const Feature& on, const Feature& other, double from, double to) {
    if (other.kind == Kind::vertex_vertex) c = places.b(other.obstacle), m = -places.a(other.robot);
    else {
        const auto p = places.parts(on), q = places.parts(other);
        const bool turns = on.kind == Kind::edge_vertex;
        if (on.kind == other.kind) meet_parallel(p, q, turns);
        else meet_mixed(turns ? q : p, turns ? p : q, from, to);
    }
    once = std::abs(m) + std::abs(m_back), twice = std::abs(m_twice);
}

// Two surfaces of a kind: lines at a constant angle to one another.
void ContactCurve::meet_parallel(const Places::Parts& p, const Places::Parts& q, bool turning) {
    const Complex np = -i_unit * p.edge, nq = -i_unit * q.edge;
    if (turning) {  // y = (x - b_p) / z: np.y = -np.a_p and nq.y = -nq.a_q + nq.(b_q - b_p) / z
        const Complex v = solve(np, nq, 0, 1), B = q.b - p.b;
        c = p.b + 0.5 * v * std::conj(nq) * B;
        m = solve(np, nq, -dot(np, p.a), -dot(nq, q.a));
        m_twice = 0.5 * v * nq * std::conj(B);
    } else {  // n.x = n.b - n.(z a)
        c = solve(np, nq, dot(np, p.b), dot(nq, q.b));
        const Complex cosine = -solve(np, nq, dot(np, p.a), dot(nq, q.a));
        const Complex sine = -solve(np, nq, dot(np, i_unit * p.a), dot(nq, i_unit * q.a));
        m = 0.5 * (cosine - i_unit * sine), m_back = 0.5 * (cosine + i_unit * sine);
    }
}

// A fixed line, through b - z a, and one that turns about a point: t sin psi = d + B sin psi + C cos psi.
void ContactCurve::meet_mixed(const Places::Parts& still, const Places::Parts& turning, double from, double to) {
    const Complex nu = -i_unit * turning.edge, B = still.b - turning.b;
    const double d = dot(nu, still.a - turning.a), side = cross(still.edge, B);
    e = still.edge, c = still.b - dot(e, B) * e, m = -still.a;
    k = d + side, l = d - side;
    const double size = std::abs(still.a) + std::abs(turning.a) + std::abs(still.b) + std::abs(turning.b);
    if (std::abs(k) <= rounding * size) k = 0;
    if (std::abs(l) <= rounding * size) l = 0;
    phi_0 = std::arg(std::conj(nu) * e) - 0.5 * pi;
    // the poles, psi = 0 of k and psi = pi of l, are outside: take psi from 0 to 2 pi if only k counts, else from -pi to pi
    const double middle = 0.5 * (from + to), psi = middle - phi_0;
    phi_0 = middle - (l == 0 ? psi - 2 * pi * std::floor(psi / (2 * pi)) : std::remainder(psi, 2 * pi));
}

Complex ContactCurve::at(double phi) const {
    const Complex z = std::polar(1.0, phi);
    Complex x = c + z * (m + z * m_twice) + std::conj(z) * m_back;
    if (k != 0) x += 0.5 * k / tangent(half(phi)) * e;
    if (l != 0) x += 0.5 * l * tangent(half(phi)) * e;
    return x;
}

Complex ContactCurve::velocity(double phi) const {
    const Complex z = std::polar(1.0, phi);
    const CosineSine at = cosine_sine(half(phi));
    Complex x = i_unit * (z * (m + 2.0 * z * m_twice) - std::conj(z) * m_back);
    if (k != 0) x -= 0.25 * k / (at.s * at.s) * e;
    if (l != 0) x += 0.25 * l / (at.c * at.c) * e;
    return x;
}

Complex ContactCurve::acceleration(double phi) const {
    const Complex z = std::polar(1.0, phi);
    const CosineSine at = cosine_sine(half(phi));
    Complex x = -z * (m + 4.0 * z * m_twice) - std::conj(z) * m_back;
    if (k != 0) x += 0.25 * k * at.c / (at.s * at.s * at.s) * e;
    if (l != 0) x += 0.25 * l * at.s / (at.c * at.c * at.c) * e;
    return x;
}

// |exp(i phi)| and |cos| grow as exp of the imaginary part at most, and |sin| is no less than that of the real part.
double ContactCurve::reach(Complex origin, double from, double to, double beyond) const {
    const double low = half(from), high = half(to), more = growth(beyond);
    double result = std::abs(c - origin) + more * (once + more * twice);
    const auto add = [&](double of, double shift, double at_low, double at_high) {
        if (of == 0) return;
        const bool pole = std::floor(low / pi + shift) != std::floor(high / pi + shift);
        result += pole ? std::numeric_limits<double>::infinity()
                       : 0.5 * std::abs(of) * more / std::min(std::abs(at_low), std::abs(at_high));
    };
    const CosineSine a = cosine_sine(low), b = cosine_sine(high);
    add(k, 0, a.s, b.s), add(l, 0.5, a.c, b.c);
    return result;
}

// tan and cot of half(phi) and their derivatives grow from the middle of their period on: the ends bound them.
double ContactCurve::speed(double from, double to) const {
    if (k == 0 && l == 0) return once + 2 * twice;
    double tangent = 0, cotangent = 0;
    for (const double phi : {from, to}) {
        const CosineSine at = cosine_sine(half(phi));
        if (l != 0) tangent = std::max(tangent, 1 / (at.c * at.c));
        if (k != 0) cotangent = std::max(cotangent, 1 / (at.s * at.s));
    }
    return once + 2 * twice + 0.25 * (std::abs(k) * cotangent + std::abs(l) * tangent);
}

// Bound from the value in the middle and the third derivative's bound; its terms also grow from the middle of their period
// on.
double ContactCurve::bend_near(double from, double to) const {
    if (m_back == 0.0 && twice == 0 && k == 0 && l == 0) return once;
    double tangent = 0, cotangent = 0;
    for (const double phi : {from, to}) {
        const CosineSine at = cosine_sine(half(phi));
        const double s = at.s * at.s, t = at.c * at.c;
        if (l != 0) tangent = std::max(tangent, (1 + 2 * s) / (t * t));
        if (k != 0) cotangent = std::max(cotangent, (1 + 2 * t) / (s * s));
    }
    const double third = once + 8 * twice + 0.125 * (std::abs(k) * cotangent + std::abs(l) * tangent);
    return std::min(bend(from, to), std::abs(acceleration(0.5 * (from + to))) + 0.5 * (to - from) * third);
}

double ContactCurve::bend(double from, double to) const {
    if (k == 0 && l == 0) return once + 4 * twice;
    double tangent = 0, cotangent = 0;
    for (const double phi : {from, to}) {
        const CosineSine at = cosine_sine(half(phi));
        const double s = std::abs(at.s), t = std::abs(at.c);
        if (l != 0) tangent = std::max(tangent, s / (t * t * t));
        if (k != 0) cotangent = std::max(cotangent, t / (s * s * s));
    }
    return once + 4 * twice + 0.25 * (std::abs(k) * cotangent + std::abs(l) * tangent);
}

}  // namespace cfree
