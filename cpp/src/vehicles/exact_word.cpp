// Headings first, then two multiples from a linear system, then exact tests of gears and radii; theory, "Vehicles".
#include "cfree/vehicles/exact_word.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"

namespace cfree {

namespace {

using std::numbers::pi;

constexpr double finest = 0x1p-48;      // headings from doubles
constexpr double of_turn = 0x1p-20;     // tolerance of a heading, as a share of the turns beside it
constexpr double coarsest = 0x1p-30;    // tolerance of a heading
constexpr int place_bits = 40;          // of free multiples, relative to the word
constexpr double negligible = 0x1p-16;  // length of a piece that is left out, in radii, if the others make up for it
constexpr double nothing_at_all = 0x1p-33; // and anyway
constexpr double parallel = 0x1p-36;      // sine of the angle between two directions that count as parallel

Int determinant(const Half& a, const Half& b) { return a.x * b.y - a.y * b.x; }
Int square(const Half& a) { return a.x * a.x + a.y * a.y; }
bool is_same(const Half& a, const Half& b) { return a.x == b.x && a.y == b.y; }
Half negative(const Half& a) { return {-a.x, -a.y}; }

// Sign of `next` changed if needed so that the turn from `last` is the one of less than half a turn.
Half onward(const Half& last, const Half& next) {
    return Int(last.x * next.x + last.y * next.y).sign() < 0 ? negative(next) : next;
}

// What becomes a word: headings at all joints, and for each piece a multiple of w.
struct Draft {
    const Vehicle& vehicle;
    int shift;
    const Configuration &from, &to;
    std::vector<Half> heading;      // one more than pieces
    std::vector<double> chord;      // signed distance of the ends, in the doubles of shapes; 0 for a turn in place
    std::size_t first = 0, second = 0;  // the two pieces to be solved for
    bool keeps_gears = true;        // true if the solved chords keep their signs

    std::size_t size() const { return chord.size(); }
};

// Radius and gear of a piece with the multiple m / unit of h g, exactly; false if the vehicle cannot do it.
bool can_do(const Vehicle& v, const Half& h, const Half& g, const Int& m, const Int& unit, Piece& piece, int shift) {
    const Half turn = conjugate(h) * g;
    if (turn.x.sign() <= 0) return false;  // half a turn, or more
    const Int w = square(h) * square(g);   // the square of |h g|
    if (turn.y.is_zero()) {
        const double length = ratio(m, unit) * std::sqrt(ratio(w, 1));
        piece = {std::ldexp(length, -shift), 0};
        return v.reverses || m.sign() > 0;
    }
    const double angle = angle_of(turn);
    if (m.is_zero()) {
        piece = {0, angle};
        return v.turns_in_place;
    }
    if (!v.reverses && m.sign() < 0) return false;
    // the signed radius is m w / (2 p unit) with p = turn.y
    const Int below = 2 * turn.y * unit, above = m * w;
    const double radius = std::ldexp(ratio(above, below), -shift);
    piece = {radius * angle, angle};
    if (v.turns_in_place) return true;
    const Ratio& least = (above.sign() < 0) == (below.sign() < 0) ? v.left : v.right;
    return abs(above) * least.d >= abs(below) * least.n;
}

std::optional<ExactWord> finished(const Draft& d) {
    const std::size_t n = d.size();
    std::vector<Half> w(n);
    for (std::size_t k = 0; k < n; ++k) w[k] = d.heading[k] * d.heading[k + 1];
    // grid of the free multiples
    double greatest = 0, all = 0;
    bool any_free = false;
    std::vector<double> size(n);
    for (std::size_t k = 0; k < n; ++k) {
        size[k] = std::sqrt(ratio(square(w[k]), 1)), greatest = std::max(greatest, size[k]);
        all += std::abs(d.chord[k]), any_free = any_free || (k != d.first && k != d.second && d.chord[k] != 0);
    }
    const double extent = std::ldexp(all, d.shift);
    int up = 0;
    if (any_free && extent > 0) up = std::max(0, place_bits + std::ilogb(greatest) - std::ilogb(extent));
    if (up > 900) return {};
    const Int unit = common_multiple(d.from.unit, d.to.unit), a = unit / d.from.unit, b = unit / d.to.unit;
    std::vector<Int> m(n);
    Int sx = 0, sy = 0;
    for (std::size_t k = 0; k < n; ++k) {
        if (k == d.first || k == d.second || d.chord[k] == 0) continue;
        m[k] = Int(std::nearbyint(std::ldexp(d.chord[k] / size[k], d.shift + up)));
        if (m[k].is_zero()) return {};
        sx += m[k] * w[k].x, sy += m[k] * w[k].y;
    }
    const auto grid = static_cast<unsigned>(up);
    const Half rest{((d.to.x * b - d.from.x * a) << grid) - unit * sx, ((d.to.y * b - d.from.y * a) << grid) - unit * sy};
    Int whole = determinant(w[d.first], w[d.second]);
    if (whole.is_zero()) return {};
    Int one = determinant(rest, w[d.second]), two = determinant(w[d.first], rest);
    if (whole.sign() < 0) whole = -whole, one = -one, two = -two;
    for (std::size_t k = 0; k < n; ++k) m[k] *= unit * whole;
    m[d.first] = one, m[d.second] = two;
    const Int common = unit * (whole << grid);
    ExactWord result;
    result.joints.reserve(n + 1), result.pieces.reserve(n);
    const Int more = whole << grid;
    Configuration q = d.from;
    q.x = d.from.x * a * more, q.y = d.from.y * a * more, q.unit = common;
    result.joints.push_back(q);
    for (std::size_t k = 0; k < n; ++k) {
        if (d.keeps_gears && (m[k].sign() < 0) != (d.chord[k] < 0) && !m[k].is_zero()) return {};
        Piece piece{};
        if (m[k].is_zero() && is_same(d.heading[k], d.heading[k + 1])) continue;  // nothing moves
        if (!can_do(d.vehicle, d.heading[k], d.heading[k + 1], m[k], common, piece, d.shift)) return {};
        q.x += m[k] * w[k].x, q.y += m[k] * w[k].y;
        const Half& h = d.heading[k + 1];
        q.hx = h.x, q.hy = h.y;
        q.px = std::ldexp(ratio(q.x, common), -d.shift), q.py = std::ldexp(ratio(q.y, common), -d.shift);
        q.theta = angle_of(h);
        result.joints.push_back(q), result.pieces.push_back(piece);
    }
    if (result.pieces.empty()) return {};
    Configuration& last = result.joints.back();  // the goal itself, with its doubles
    last.px = d.to.px, last.py = d.to.py, last.theta = d.to.theta;
    return result;
}

// A heading near one in doubles: by itself, or from another one where the turn is tiny.
Half near_heading(const Configuration& from, double turn, double tolerance) {
    if (tolerance >= finest) return simplest_half(wrapped(from.theta + turn), tolerance);
    return half_of(from) * simplest_half(turn, std::max(tolerance, finest * std::abs(turn)));
}

// Turn in place from one heading to another, in two pieces if it is nearly half a turn.
void turn_to(Draft& d, const Half& to) {
    const Half last = d.heading.back(), next = onward(last, to), turn = conjugate(last) * next;
    if (turn.y.is_zero() && turn.x.sign() > 0) return;
    const double angle = angle_of(turn);
    if (std::abs(angle) > most_turn_of_piece) {
        d.heading.push_back(onward(last, last * simplest_half(0.5 * angle, 0x1p-4))), d.chord.push_back(0);
        return turn_to(d, to);
    }
    d.heading.push_back(next), d.chord.push_back(0);
}

// A word of turns in place and drives from the start's place to the goal's: no system is to be solved.
struct Driven {
    const Vehicle& vehicle;
    int shift;
    ExactWord word;
    Int unit;

    Driven(const Vehicle& v, int s, const Configuration& from, const Configuration& to)
        : vehicle(v), shift(s), unit(common_multiple(from.unit, to.unit)) {
        word.joints.push_back(at(from));
    }
    Configuration at(const Configuration& q) const {
        Configuration p = q;
        const Int by = unit / q.unit;
        p.x *= by, p.y *= by, p.unit = unit;
        return p;
    }
    void join(const Half& h, const Configuration* place, const Piece& piece) {
        Configuration q = place ? at(*place) : word.joints.back();
        q.hx = h.x, q.hy = h.y, q.theta = angle_of(h);
        word.joints.push_back(q), word.pieces.push_back(piece);
    }
    void turn(const Half& to) {
        const Half last = half_of(word.joints.back()), next = onward(last, to), by = conjugate(last) * next;
        if (by.y.is_zero()) return;
        const double angle = angle_of(by);
        if (std::abs(angle) <= most_turn_of_piece) return join(next, nullptr, {0, angle});
        join(onward(last, simple(last * simplest_half(0.5 * angle, 0x1p-4))), nullptr, {0, 0.5 * angle});
        turn(to);
    }
    // One arc to a place and heading, which it reaches in exactly one gear; false if it turns too far.
    bool arc(const Half& to, const Configuration& goal) {
        const Configuration& q = word.joints.back();
        const Half last = half_of(q), next = onward(last, to), by = conjugate(last) * next, w = last * next;
        const double angle = angle_of(by);
        if (std::abs(angle) > most_turn_of_piece) return false;
        const Configuration end = at(goal);
        const Int dx = end.x - q.x, dy = end.y - q.y;
        const int gear = Int(dx * w.x + dy * w.y).sign();
        const double chord = std::ldexp(std::sqrt(ratio(dx * dx + dy * dy, unit * unit)), -shift);
        const double half = 0.5 * std::abs(angle);
        join(next, &goal, {gear * (half > 0x1p-30 ? chord * half / sine(half) : chord), angle});
        return gear != 0;
    }
    std::optional<ExactWord> finished(const Configuration& to) {
        turn(half_of(to));
        if (word.pieces.empty()) return {};
        Configuration& last = word.joints.back();
        last.px = to.px, last.py = to.py, last.theta = to.theta, last.hx = to.hx, last.hy = to.hy;
        return std::move(word);
    }
};

// Integers along the way from one pose to another, in lowest terms.
Half direction(const Configuration& from, const Configuration& to) {
    const Int unit = common_multiple(from.unit, to.unit), a = unit / from.unit, b = unit / to.unit;
    return simple({to.x * b - from.x * a, to.y * b - from.y * a});
}

bool is_nothing(const Half& a) { return a.x.is_zero() && a.y.is_zero(); }

// The straight way, if the goal is on it.
std::optional<ExactWord> straight(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to) {
    const Half h = half_of(from), way = direction(from, to);
    if (is_nothing(way) || !Int(determinant(h, half_of(to))).is_zero() || !Int(determinant(h * h, way)).is_zero()) return {};
    Driven word(vehicle, shift, from, to);
    if (!word.arc(h, to)) return {};
    if (!vehicle.reverses && word.word.pieces[0].travel < 0) return {};
    return word.finished(to);
}

// The rational form of a word without the pieces that are shorter than `nothing`, in radii.
std::optional<ExactWord> without_short_pieces(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to,
                                              const Word& word, double radius, double nothing) {
    Draft d{vehicle, shift, from, to, {half_of(from)}, {}};
    int arcs = 0;
    for (int k = 0; k < word.count; ++k)
        arcs += word.kind[static_cast<std::size_t>(k)] != 0 && std::abs(word.length[static_cast<std::size_t>(k)]) >= nothing;
    struct Part {
        double turn, length;  // length of a straight piece, or the turn with the gear's sign times the radius
        bool straight;
    };
    std::vector<Part> parts;
    for (int k = 0; k < word.count; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const double l = word.length[at];
        if (std::abs(l) < nothing) continue;
        if (word.kind[at] == 0) {
            parts.push_back({0, l * radius, true});
            continue;
        }
        const int pieces = std::max(arcs == 1 ? 2 : 1, static_cast<int>(std::ceil(std::abs(l) / most_turn_of_piece)));
        for (int m = 0; m < pieces; ++m) parts.push_back({word.kind[at] * l / pieces, l / pieces * radius, false});
    }
    const std::size_t n = parts.size();
    if (n == 0) return {};
    // headings: those of straight pieces at the ends are given
    std::vector<double> turned{0};
    for (const Part& p : parts) turned.push_back(turned.back() + p.turn);
    if (n == 1 && parts[0].straight) return straight(vehicle, shift, from, to);
    for (std::size_t k = 1; k <= n; ++k) {
        const Half before = d.heading.back();
        if (parts[k - 1].straight) d.heading.push_back(before);
        else if (k >= n || (k == n - 1 && parts[n - 1].straight)) d.heading.push_back(onward(before, half_of(to)));
        else {
            double least = std::abs(parts[k - 1].turn);
            for (std::size_t m = k; m < n; ++m)
                if (!parts[m].straight) {
                    least = std::min(least, std::abs(parts[m].turn));
                    break;
                }
            d.heading.push_back(onward(before, near_heading(from, turned[k], std::min(coarsest, of_turn * least))));
        }
    }
    if (parts[n - 1].straight && !Int(determinant(d.heading[n], half_of(to))).is_zero()) return {};
    // chords with the angles of these headings
    std::vector<double> direct(n);
    for (std::size_t k = 0; k < n; ++k) {
        direct[k] = from.theta + 0.5 * (turned[k] + turned[k + 1]);
        const double half = 0.5 * std::abs(parts[k].turn);
        d.chord.push_back(parts[k].straight ? parts[k].length : std::copysign(2 * radius * sine(half), parts[k].length));
    }
    double best = parallel;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j)
            if (const double across = std::abs(sine(direct[j] - direct[i])); across > best) best = across, d.first = i, d.second = j;
    if (best == parallel) return {};
    return finished(d);
}

}  // namespace

std::optional<ExactWord> exact_word(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to,
                                    const Word& word, double radius) {
    const auto is_short = [&](double l) { return nothing_at_all <= std::abs(l) && std::abs(l) < negligible; };
    if (std::any_of(word.length.begin(), word.length.begin() + word.count, is_short))
        if (auto found = without_short_pieces(vehicle, shift, from, to, word, radius, negligible)) return found;
    return without_short_pieces(vehicle, shift, from, to, word, radius, nothing_at_all);
}

std::optional<ExactWord> biarc(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to) {
    const Half h = half_of(from), goal = onward(h, half_of(to)), way = direction(from, to);
    if (is_nothing(way)) return {};
    const Half local = simple(conjugate(h * h) * way);  // the way in the frame of the start
    if (local.x.is_zero()) return {};
    const double beside = ratio(local.y, local.x), turn = angle_of(conjugate(h) * goal);
    if (std::abs(beside) > 1 || std::abs(turn) > 1.5) return {};
    const int gear = local.x.sign();
    if (gear < 0 && !vehicle.reverses) return {};
    Draft d{vehicle, shift, from, to, {h}, {1.0 * gear, 1.0 * gear}};
    d.first = 0, d.second = 1;
    if (turn == 0) {
        // equal arcs to both sides over the middle of the way: h g is along it
        if (local.y.is_zero()) return straight(vehicle, shift, from, to);
        const Half middle = onward(h, simple(conjugate(h) * way));
        Configuration at = from;
        const Int unit = common_multiple(from.unit, to.unit), a = unit / from.unit, b = unit / to.unit;
        at.x = from.x * a + to.x * b, at.y = from.y * a + to.y * b, at.unit = 2 * unit;
        at.px = 0.5 * (from.px + to.px), at.py = 0.5 * (from.py + to.py);
        Driven word(vehicle, shift, from, to);
        word.unit = 2 * unit, word.word.joints.front() = word.at(from);
        if (!word.arc(middle, at)) return {};
        if (!word.arc(goal, to)) return {};
        for (std::size_t k = 0; k < 2; ++k) {
            const Configuration &p = word.word.joints[k], &q = word.word.joints[k + 1];
            // the multiple of w that leads from p to q
            const Half w = half_of(p) * half_of(q);
            const Int m = (q.x - p.x) * w.x + (q.y - p.y) * w.y;
            Piece piece{};
            if (!can_do(vehicle, half_of(p), half_of(q), m, word.unit * square(w), piece, shift)) return {};
            word.word.pieces[k] = piece;
        }
        return word.finished(to);
    }
    // the tangent of a quarter of the turn is a free choice; half of the middle heading is then that of the way less this
    const Half by = simplest_half(0.5 * turn, 0x1p-24 * std::abs(turn));
    const Half middle = simple(Half{abs(local.x), gear < 0 ? -local.y : local.y} * conjugate(by));
    d.heading.push_back(onward(h, h * middle));
    d.heading.push_back(onward(d.heading.back(), goal));
    return finished(d);
}

std::optional<ExactWord> steer(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to) {
    if (!vehicle.reverses) return {};
    const Half h = half_of(from), goal = onward(h, half_of(to)), turn = conjugate(h) * goal;
    if (turn.x.sign() <= 0) return {};
    const double radius = vehicle.radius;  // rounded: some slack below
    if (!(radius > 0)) return {};
    const Ratio& least = vehicle.left < vehicle.right ? vehicle.right : vehicle.left;
    std::vector<Configuration> joints{from};
    std::vector<Piece> pieces;
    const auto add = [&](const Half& next, const Half& w, const Int& m, const Int& unit) {  // moves by m w / unit
        Configuration q = joints.back();
        Piece piece{};
        if (!can_do(vehicle, half_of(q), next, m, unit, piece, shift)) return false;
        q.x = q.x * unit + m * w.x * q.unit, q.y = q.y * unit + m * w.y * q.unit, q.unit *= unit;
        const Int common = gcd(gcd(q.x, q.y), q.unit);
        q.x /= common, q.y /= common, q.unit /= common;
        q.hx = next.x, q.hy = next.y, q.theta = angle_of(next);
        q.px = std::ldexp(ratio(q.x, q.unit), -shift), q.py = std::ldexp(ratio(q.y, q.unit), -shift);
        joints.push_back(q), pieces.push_back(piece);
        return true;
    };
    if (!turn.y.is_zero()) {  // ahead to one side, back to the other, each about half of the turn
        const double angle = angle_of(turn);
        if (std::abs(angle) > 3) return {};
        Half first = h * simplest_half(0.5 * angle, 0x1p-9 * std::abs(angle));
        first = onward(h, simple(first));
        const auto chord = [&](const Half& a, const Half& b, int gear) {  // exactly the least radius
            const Half by = conjugate(a) * b;
            return add(b, a * b, gear * 2 * abs(by.y) * least.n, square(a) * square(b) * least.d);
        };
        if (!chord(h, first, 1) || !chord(first, onward(first, goal), -1)) return {};
    }
    const Configuration q = joints.back();
    const Half g = half_of(q);
    const Place rest = seen_from(q, to);
    const double y = std::ldexp(rest.y, -shift), x = std::ldexp(rest.x, -shift);
    if (y != 0) {  // sideways: tau^2 <= m / (2 - m), m = |y| / 2 rho
        const double m = std::abs(y) / (2 * radius);
        if (m > 1) return {};
        const double tau = std::sqrt(m / (2 - m)) * (1 - 0x1p-9);
        const int exponent = std::ilogb(tau) - 8;
        const Int bits(std::floor(std::ldexp(tau, -exponent)));
        const Half bend = exponent < 0 ? Half{Int(1) << static_cast<unsigned>(-exponent), bits} : Half{1, bits << static_cast<unsigned>(exponent)};
        const Half side = onward(g, simple(g * (y > 0 ? bend : conjugate(bend)))), w = g * side, ahead = g * g;
        // the way left is 2 m w + n ahead
        const Int unit = common_multiple(q.unit, to.unit), a = unit / q.unit, b = unit / to.unit;
        const Half left{to.x * b - q.x * a, to.y * b - q.y * a};
        Int whole = 2 * determinant(w, ahead), one = determinant(left, ahead);
        if (whole.is_zero()) return {};
        if (whole.sign() < 0) whole = -whole, one = -one;
        if (!add(side, w, one, unit * whole) || !add(g, w, one, unit * whole)) return {};
    } else if (x == 0) {
        if (pieces.empty()) return {};
    }
    // straight on
    const Configuration& p = joints.back();
    const Int unit = common_multiple(p.unit, to.unit), a = unit / p.unit, b = unit / to.unit;
    const Half left{to.x * b - p.x * a, to.y * b - p.y * a}, ahead = g * g;
    if (!is_nothing(left)) {
        if (!Int(determinant(left, ahead)).is_zero()) return {};
        const Int m = left.x * ahead.x + left.y * ahead.y;
        if (!add(g, ahead, m, unit * square(ahead))) return {};
    }
    Configuration& last = joints.back();
    last.px = to.px, last.py = to.py, last.theta = to.theta;
    return ExactWord{std::move(joints), std::move(pieces)};
}

std::optional<ExactWord> turn_drive_turn(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to,
                                         bool back) {
    Driven word(vehicle, shift, from, to);
    const Half way = direction(from, to);
    if (!is_nothing(way)) {
        // h g is along the way: from a heading near it, an arc of enormous radius
        const Half local = back ? negative(way) : way;
        const Half first = simplest_half(0.5 * angle_of(local), 0x1p-24), second = simple(conjugate(first) * local);
        word.turn(first);
        if (!word.arc(second, to)) return {};
    }
    return word.finished(to);
}

std::optional<ExactWord> arc_and_turn(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to,
                                      bool turn_first) {
    const Half way = direction(from, to);
    if (is_nothing(way)) return {};
    Driven word(vehicle, shift, from, to);
    const Half other = simple(conjugate(half_of(turn_first ? to : from)) * way);
    if (turn_first) word.turn(other);
    if (!word.arc(turn_first ? half_of(to) : other, to)) return {};
    return word.finished(to);
}

std::optional<ExactWord> zigzag(const Vehicle& vehicle, int shift, const Configuration& from, const Configuration& to, double angle) {
    const Half h = half_of(from), goal = onward(h, half_of(to));
    const double middle = 0.5 * angle_of(conjugate(h) * goal), tolerance = std::min(0x1p-24, 0x1p-8 * angle);
    Draft d{vehicle, shift, from, to, {h}, {}};
    d.keeps_gears = false;
    turn_to(d, near_heading(from, middle + angle, tolerance));
    d.first = d.size(), d.chord.push_back(1), d.heading.push_back(d.heading.back());
    turn_to(d, near_heading(from, middle - angle, tolerance));
    d.second = d.size(), d.chord.push_back(1), d.heading.push_back(d.heading.back());
    turn_to(d, half_of(to));
    return finished(d);
}

}  // namespace cfree
