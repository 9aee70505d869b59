#include <stdexcept>

#include "form.hpp"

namespace cfree {

namespace {

const Event wall_event(int side) { return {{}, {}, double(side), double(side)}; }

// A direction times a power of two, so that products of two are neither huge nor tiny.
Vec<Approx> of_unit_size(const Vec<Approx>& d) {
    const double scale = power_below(std::max(d.x.m, d.y.m));
    return {{d.x.v * scale, d.x.m * scale}, {d.y.v * scale, d.y.m * scale}};
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

int Predicates::order(const Event& x, const Event& y) {
    if (x.hi < y.lo) return -1;
    if (x.lo > y.hi) return 1;
    if (x.first.kind == Kind::none && y.first.kind == Kind::none) return 0;  // one wall
    const bool parallels = x.first.kind == Kind::edge_edge && y.first.kind == Kind::edge_edge;
    if (parallels && same_feature(scene, x.first, y.first)) return 0;  // a chart holds one such angle
    return order_exactly(x, y);
}

RealRoot Predicates::root_of(const Event& x) const {
    RealRoot root{polynomial(x.first, x.second), Dyadic::from(x.lo), Dyadic::from(x.hi)};
    if (x.fine >= 0) root.lo = fine[x.fine][0], root.hi = fine[x.fine][1];
    // a touch: the sign changes without the multiple factor only
    if (!root.is_dyadic() && cfree::sign_at(root.p, root.lo) == cfree::sign_at(root.p, root.hi)) root.p = squarefree(root.p);
    return root;
}

int Predicates::place(const Event& x) const {
    if (x.fine < 0) return 0;
    return Sturm(squarefree(polynomial(x.first, x.second))).roots_in(Dyadic::from(x.lo), fine[x.fine][1]);
}

Event Predicates::restored(const Event& x, int place) {
    if (place == 0) return x;
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
    const Form f = form(x);
    const auto l = f.at(lo), h = f.at(hi);
    return std::abs(l.v) > l.err && std::abs(h.v) > h.err && (l.v > 0) != (h.v > 0);
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
    const RealRoot root = root_of(x);
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
    const auto alone = [&](const Event& z) { return changes_sign(z, std::min(x.lo, y.lo), std::max(x.hi, y.hi)); };
    if (same_polynomial(x, y) && alone(x)) return ++counters.filter, 0;
    ++counters.exact;
    if (x.first.kind == Kind::edge_edge && y.first.kind == Kind::edge_edge) {
        if (2 * (scene.robot.bits + scene.obstacles.bits + 1) < 126) return parallel_order<Wide>(scene, x.first, y.first);
        return parallel_order<Int>(scene, x.first, y.first);
    }
    if (x.first.kind == Kind::none) return -order_at_wall(y, x);
    if (y.first.kind == Kind::none) return order_at_wall(x, y);
    if ((meets_parallel(x, y) && alone(y)) || (meets_parallel(y, x) && alone(x))) return 0;
    RealRoot p = root_of(x), q = root_of(y);
    return cfree::compare(p, q);
}

int Predicates::order(const Event& x, const Sample& at) {
    if (!at.fine && x.hi < at.tau) return -1;
    if (!at.fine && x.lo > at.tau) return 1;
    ++counters.exact;
    const Dyadic t = at.exact();
    if (x.first.kind == Kind::none) return cfree::compare(Dyadic::from(x.lo), t);
    const RealRoot root = root_of(x);
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
        RealRoot p = root_of(x), q = root_of(y);
        while (cfree::compare(p.hi, q.lo) >= 0) p.halve(), q.halve();
        lo = p.hi.rounded_up(), hi = q.lo.rounded_down();
        if (!(std::nextafter(lo, hi) < hi)) {
            Dyadic below = p.hi, at = Dyadic::middle(p.hi, q.lo);
            for (int steps = 0; steps < static_cast<int>(8 * (1 - part)); ++steps) at = Dyadic::middle(below, at);
            return {at.rounded_down(), at};
        }
    }
    return within(lo, hi, part);
}

Sample Predicates::within(double lo, double hi, double part) {
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
