// Each formula gives one word; turned round in time, reflected, and read backwards it gives up to eight; theory,
// "Vehicles".
#include "cfree/vehicles/reeds_shepp.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

using std::numbers::pi;

constexpr double tiny = 1e-12;  // a word that is wrong by rounding only is not left out

double within_a_turn(double angle) {  // to [-pi, pi]
    while (angle > pi) angle -= 2 * pi;
    while (angle < -pi) angle += 2 * pi;
    return angle;
}

double arc_cosine(double x) { return arc_tangent(std::sqrt(std::max(0.0, (1 - x) * (1 + x))), x); }
double arc_sine(double x) { return arc_tangent(x, std::sqrt(std::max(0.0, (1 - x) * (1 + x)))); }

// A goal, and the sine and cosine of its angle.
struct Goal {
    double x, y, phi, s, c;
    // Its place relative to the centre of a circle at the goal.
    double near_x() const { return x - s; }  // of the left circle, less that of the start's left circle
    double near_y() const { return y - 1 + c; }
    double far_x() const { return x + s; }  // of the right circle
    double far_y() const { return y - 1 - c; }
};

struct Lengths {
    double t, u, v;
};
struct Formula {
    std::array<signed char, 5> kind;
    int count;
    bool backwards;  // read backwards it is another word
    // lengths of all pieces, from t, u and v
    void (*pieces)(const Lengths&, std::array<double, 5>&);
    bool (*solve)(const Goal&, Lengths&);
};

// 8.1: L+ S+ L+
bool left_straight_left(const Goal& g, Lengths& l) {
    l.u = norm(g.near_x(), g.near_y()), l.t = arc_tangent(g.near_y(), g.near_x());
    if (l.t < -tiny) return false;
    l.v = within_a_turn(g.phi - l.t);
    return l.v >= -tiny;
}
// 8.2: L+ S+ R+
bool left_straight_right(const Goal& g, Lengths& l) {
    const double xi = g.far_x(), eta = g.far_y(), square = xi * xi + eta * eta;
    if (square < 4) return false;
    l.u = std::sqrt(square - 4);
    l.t = within_a_turn(arc_tangent(eta, xi) + arc_tangent(2, l.u)), l.v = within_a_turn(l.t - g.phi);
    return l.t >= -tiny && l.v >= -tiny;
}
// 8.3 and 8.4: L+ R- L, in either gear
bool left_back_left(const Goal& g, Lengths& l) {
    const double xi = g.near_x(), eta = g.near_y(), apart = norm(xi, eta);
    if (apart > 4) return false;
    l.u = -2 * arc_sine(0.25 * apart), l.t = within_a_turn(arc_tangent(eta, xi) + 0.5 * l.u + pi);
    l.v = within_a_turn(g.phi - l.t + l.u);
    return l.t >= -tiny && l.u <= tiny;
}
// t and v of a word of four arcs whose inner two are u and w
void outer_arcs(double u, double w, const Goal& g, Lengths& l) {
    const double xi = g.far_x(), eta = g.far_y(), delta = within_a_turn(u - w);
    const auto [cu, su] = cosine_sine(u);
    const auto [cd, sd] = cosine_sine(delta);
    const double a = su - sd, b = cu - cd - 1;
    const double first = arc_tangent(eta * a - xi * b, xi * a + eta * b), sign = 2 * (cd - cosine(w) - cu) + 3;
    l.t = within_a_turn(sign < 0 ? first + pi : first), l.v = within_a_turn(l.t - u + w - g.phi);
}
// 8.7: L+ R+ L- R-
bool four_arcs_cusp_between(const Goal& g, Lengths& l) {
    const double r = 0.25 * (2 + norm(g.far_x(), g.far_y()));
    if (r > 1) return false;
    l.u = arc_cosine(r);
    outer_arcs(l.u, -l.u, g, l);
    return l.t >= -tiny && l.v <= tiny;
}
// 8.8: L+ R- L- R+
bool four_arcs_two_cusps(const Goal& g, Lengths& l) {
    const double r = (20 - g.far_x() * g.far_x() - g.far_y() * g.far_y()) / 16;
    if (r < 0 || r > 1) return false;
    l.u = -arc_cosine(r);
    if (l.u < -0.5 * pi) return false;
    outer_arcs(l.u, l.u, g, l);
    return l.t >= -tiny && l.v >= -tiny;
}
// 8.9: L+ R- S- L-
bool right_angle_left(const Goal& g, Lengths& l) {
    const double xi = g.near_x(), eta = g.near_y(), apart = norm(xi, eta);
    if (apart < 2) return false;
    const double r = std::sqrt(apart * apart - 4);
    l.u = 2 - r, l.t = within_a_turn(arc_tangent(eta, xi) + arc_tangent(r, -2)), l.v = within_a_turn(g.phi - 0.5 * pi - l.t);
    return l.t >= -tiny && l.u <= tiny && l.v <= tiny;
}
// 8.10: L+ R- S- R-
bool right_angle_right(const Goal& g, Lengths& l) {
    const double xi = g.far_x(), eta = g.far_y(), apart = norm(xi, eta);
    if (apart < 2) return false;
    l.t = arc_tangent(xi, -eta), l.u = 2 - apart, l.v = within_a_turn(l.t + 0.5 * pi - g.phi);
    return l.t >= -tiny && l.u <= tiny && l.v <= tiny;
}
// 8.11: L+ R- S- L- R+
bool two_right_angles(const Goal& g, Lengths& l) {
    const double xi = g.far_x(), eta = g.far_y(), apart = norm(xi, eta);
    if (apart < 2) return false;
    l.u = 4 - std::sqrt(apart * apart - 4);
    if (l.u > tiny) return false;
    l.t = within_a_turn(arc_tangent((4 - l.u) * xi - 2 * eta, -2 * xi + (l.u - 4) * eta)), l.v = within_a_turn(l.t - g.phi);
    return l.t >= -tiny && l.v >= -tiny;
}

const std::array formulas{
    Formula{{1, 0, 1}, 3, false, [](const Lengths& l, auto& p) { p = {l.t, l.u, l.v}; }, left_straight_left},
    Formula{{1, 0, -1}, 3, false, [](const Lengths& l, auto& p) { p = {l.t, l.u, l.v}; }, left_straight_right},
    Formula{{1, -1, 1}, 3, true, [](const Lengths& l, auto& p) { p = {l.t, l.u, l.v}; }, left_back_left},
    Formula{{1, -1, 1, -1}, 4, false, [](const Lengths& l, auto& p) { p = {l.t, l.u, -l.u, l.v}; }, four_arcs_cusp_between},
    Formula{{1, -1, 1, -1}, 4, false, [](const Lengths& l, auto& p) { p = {l.t, l.u, l.u, l.v}; }, four_arcs_two_cusps},
    Formula{{1, -1, 0, 1}, 4, true, [](const Lengths& l, auto& p) { p = {l.t, -0.5 * pi, l.u, l.v}; }, right_angle_left},
    Formula{{1, -1, 0, -1}, 4, true, [](const Lengths& l, auto& p) { p = {l.t, -0.5 * pi, l.u, l.v}; }, right_angle_right},
    Formula{{1, -1, 0, 1, -1}, 5, false, [](const Lengths& l, auto& p) { p = {l.t, -0.5 * pi, l.u, -0.5 * pi, l.v}; },
            two_right_angles},
};

// Calls use(word) for each.
template <class F>
void each_word(double x, double y, double phi, F&& use) {
    const auto [c, s] = cosine_sine(phi);
    const double bx = x * c + y * s, by = x * s - y * c;  // the start seen from the goal, for words read backwards
    for (const Formula& f : formulas)
        for (int way = 0; way < (f.backwards ? 8 : 4); ++way) {
            const bool in_time = way & 1, reflected = way & 2, backwards = way & 4;
            const double px = backwards ? bx : x, py = backwards ? by : y;
            const bool turned = in_time != reflected;
            const Goal goal{in_time ? -px : px, reflected ? -py : py, turned ? -phi : phi, turned ? -s : s, c};
            Lengths l{};
            if (!f.solve(goal, l)) continue;
            Word word;
            word.count = f.count;
            std::array<double, 5> pieces{};
            f.pieces(l, pieces);
            for (int k = 0; k < f.count; ++k) {
                const auto from = static_cast<std::size_t>(backwards ? f.count - 1 - k : k), to = static_cast<std::size_t>(k);
                word.kind[to] = static_cast<signed char>(reflected ? -f.kind[from] : f.kind[from]);
                word.length[to] = in_time ? -pieces[from] : pieces[from];
            }
            use(word);
        }
}

double positive(double angle) {  // to [0, 2 pi), and 0 for less by rounding
    while (angle < -tiny) angle += 2 * pi;
    while (angle >= 2 * pi - tiny) angle -= 2 * pi;
    return std::max(0.0, angle);
}

}  // namespace

double Word::total() const {
    double sum = 0;
    for (int k = 0; k < count; ++k) sum += std::abs(length[static_cast<std::size_t>(k)]);
    return sum;
}

int Word::cusps() const {
    int found = 0;
    double last = 0;
    for (int k = 0; k < count; ++k) {
        const double l = length[static_cast<std::size_t>(k)];
        if (std::abs(l) < 1e-10) continue;
        if (last * l < 0) ++found;
        last = l;
    }
    return found;
}

void reeds_shepp_words(double x, double y, double phi, std::vector<Word>& out) {
    each_word(x, y, phi, [&](const Word& word) { out.push_back(word); });
}

Word shortest_word(double x, double y, double phi) {
    Word best;
    double least = HUGE_VAL;
    each_word(x, y, phi, [&](const Word& word) {
        if (const double total = word.total(); total < least) least = total, best = word;
    });
    return best;
}

void dubins_words(double x, double y, double phi, std::vector<Word>& out) {
    const auto [c, s] = cosine_sine(phi);
    for (const double side : {1.0, -1.0}) {  // reflected
        const auto kind = static_cast<signed char>(side);
        const auto other = static_cast<signed char>(-kind);
        const double yy = side * y, ss = side * s, turn = side * phi;
        const double nx = x - ss, ny = yy - 1 + c, fx = x + ss, fy = yy - 1 - c;
        const auto put = [&](std::array<signed char, 5> kinds, double t, double u, double v) { out.push_back({3, kinds, {t, u, v}}); };
        {  // the same side
            const double t = positive(arc_tangent(ny, nx));
            put({kind, 0, kind}, t, norm(nx, ny), positive(turn - t));
        }
        if (const double square = fx * fx + fy * fy; square >= 4) {  // to the other side
            const double u = std::sqrt(square - 4), t = positive(arc_tangent(fy, fx) + arc_tangent(2, u));
            put({kind, 0, other}, t, u, positive(t - turn));
        }
        if (const double apart = norm(nx, ny); apart <= 4) {  // three arcs
            const double u = 2 * pi - 2 * arc_sine(0.25 * apart), t = positive(arc_tangent(ny, nx) + 0.5 * u);
            put({kind, other, kind}, t, u, positive(turn - t + u));
        }
    }
}

}  // namespace cfree
