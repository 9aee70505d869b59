// Decide motions in integers, after boxes and halving in doubles have narrowed them; theory, "Motions".
#include "cfree/collision/motion_checker.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "cfree/exact/descartes.hpp"
#include "collision/rounding.hpp"
#include "collision/shape_boxes.hpp"

namespace cfree {

namespace {

// Halvings of [0, 1] in doubles before a pair of pieces is decided exactly.
constexpr int most_halvings = 6;

// Coefficients of a polynomial of degree N.
template <class T, int N>
using Terms = std::array<T, N + 1>;

// A moving frame: a point a is at (C a.x - S a.y + X, S a.x + C a.y + Y) / W. Integers are coefficients of powers of u,
// doubles are Bernstein coefficients on some interval.
template <class T, int N>
struct Frame {
    Terms<T, N> C, S, X, Y, W;
};
template <class T, int N>
struct Point {  // in homogeneous coordinates
    Terms<T, N> x, y;
};

template <class T, int N>
Point<T, N> moved(const Frame<T, N>& f, const T& x, const T& y) {
    Point<T, N> r;
    for (int k = 0; k <= N; ++k) {
        r.x[k] = f.C[k] * x - f.S[k] * y + f.X[k];
        r.y[k] = f.S[k] * x + f.C[k] * y + f.Y[k];
    }
    return r;
}

// Function that is positive while the moving point is on the left of the edge d that starts at (x, y).
template <class T, int N>
T side(const Vec<T>& d, const T& x, const T& y, const Point<T, N>& point, const Frame<T, N>& f, int k) {
    return d.x * (point.y[k] - f.W[k] * y) - d.y * (point.x[k] - f.W[k] * x);
}

template <class T>
T x_of(const Shape& s, Index v);
template <class T>
T y_of(const Shape& s, Index v);
template <>
Approx x_of(const Shape& s, Index v) { return {s.x[v], std::abs(s.x[v])}; }
template <>
Approx y_of(const Shape& s, Index v) { return {s.y[v], std::abs(s.y[v])}; }

bool is_negative(const Approx& f) { return f.v < -error_of(f); }
bool is_positive(const Approx& f) { return f.v > error_of(f); }

template <int N>
struct Frames {
    Frame<Int, N> robot, obstacles;  // the robot in the world's frame, the obstacles in the robot's frame
};

Frames<2> frames_of(const Motion& m) {
    Frames<2> f{};
    auto &r = f.robot, &o = f.obstacles;
    if (!m.turns) {
        const Int tx[2] = {m.x, m.vx}, ty[2] = {m.y, m.vy};
        for (int k = 0; k < 2; ++k) {
            r.X[k] = m.w * tx[k], r.Y[k] = m.w * ty[k];
            o.X[k] = -(m.c * tx[k] + m.s * ty[k]), o.Y[k] = m.s * tx[k] - m.c * ty[k];
        }
        r.C[0] = o.C[0] = m.c * m.unit, r.S[0] = m.s * m.unit, o.S[0] = -r.S[0];
        r.W[0] = o.W[0] = m.w * m.unit;
        return f;
    }
    // the turning's cosine, sine and their denominator, from (q0 + q1 u, p1 u)
    const Int &q0 = m.start, q1 = m.q - m.start, &p1 = m.p;
    const Int c[3] = {q0 * q0, 2 * q0 * q1, q1 * q1 - p1 * p1}, s[3] = {0, 2 * q0 * p1, 2 * q1 * p1};
    const Int w[3] = {c[0], c[1], q1 * q1 + p1 * p1};
    const Int dx = m.x - m.vx, dy = m.y - m.vy;
    for (int k = 0; k < 3; ++k) {
        r.W[k] = o.W[k] = w[k] * m.w * m.unit;
        r.C[k] = o.C[k] = (c[k] * m.c - s[k] * m.s) * m.unit;
        r.S[k] = (s[k] * m.c + c[k] * m.s) * m.unit, o.S[k] = -r.S[k];
        r.X[k] = m.w * (w[k] * m.vx + c[k] * dx - s[k] * dy), r.Y[k] = m.w * (w[k] * m.vy + s[k] * dx + c[k] * dy);
        const Int tx = c[k] * m.vx + s[k] * m.vy + w[k] * dx, ty = c[k] * m.vy - s[k] * m.vx + w[k] * dy;
        o.X[k] = -(m.c * tx + m.s * ty), o.Y[k] = m.s * tx - m.c * ty;
    }
    return f;
}

Frames<6> frames_of(const Slide& m) {
    Frames<6> f{};
    auto &r = f.robot, &o = f.obstacles;
    // half of the angle turned is that of (q, p u)
    const Int qq = m.q * m.q, qp = 2 * m.q * m.p, pp = m.p * m.p;
    const Int c[3] = {m.c * qq, -m.s * qp, -m.c * pp}, s[3] = {m.s * qq, m.c * qp, -m.s * pp};
    const Int w[3] = {m.w * qq, 0, m.w * pp};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 5; ++k) {
            r.C[i + k] += c[i] * m.d[k], r.S[i + k] += s[i] * m.d[k], r.W[i + k] += w[i] * m.d[k];
            r.X[i + k] += w[i] * m.x[k], r.Y[i + k] += w[i] * m.y[k];
            o.X[i + k] -= c[i] * m.x[k] + s[i] * m.y[k], o.Y[i + k] += s[i] * m.x[k] - c[i] * m.y[k];
        }
    o.C = r.C, o.W = r.W;
    for (int k = 0; k <= 6; ++k) o.S[k] = -r.S[k];
    return f;
}

int bits_of(const Int& n) { return n.is_zero() ? 0 : static_cast<int>(msb(abs(n))) + 1; }

// Powers of u in doubles; C, S, W times 2^-scale, X and Y times 2^-(scale + shift).
template <int N>
Frame<double, N> rounded(const Frame<Int, N>& f, int shift) {
    int scale = 0;
    for (const auto* q : {&f.C, &f.S, &f.W})
        for (const Int& c : *q) scale = std::max(scale, bits_of(c));
    const auto convert = [](const Terms<Int, N>& q, int by) {
        Terms<double, N> r;
        for (int k = 0; k <= N; ++k) r[k] = ball(q[k], by).hi;
        return r;
    };
    return {convert(f.C, scale), convert(f.S, scale), convert(f.X, scale + shift), convert(f.Y, scale + shift),
            convert(f.W, scale)};
}

// Bernstein coefficients on [lo, hi], lo >= 0, by the polar form: a power of u becomes the mean of the products of that many
// of N numbers, some of them lo and the others hi.
template <int N>
Frame<Approx, N> on(const Frame<double, N>& f, double lo, double hi) {
    double mean[N + 1][N + 1];
    for (int i = 0; i <= N; ++i) {
        double e[N + 1] = {1};
        for (int k = 0; k < N; ++k)
            for (int j = k + 1; j > 0; --j) e[j] += e[j - 1] * (k < i ? hi : lo);
        double binomial = 1;
        for (int j = 0; j <= N; ++j) {
            mean[i][j] = e[j] / binomial;
            binomial = binomial * (N - j) / (j + 1);
        }
    }
    const auto convert = [&](const Terms<double, N>& q) {
        Terms<Approx, N> r;
        for (int i = 0; i <= N; ++i) {
            r[i] = {q[0], std::abs(q[0])};
            for (int j = 1; j <= N; ++j) {
                const double term = q[j] * mean[i][j];
                r[i].v += term, r[i].m += std::abs(term);
            }
        }
        return r;
    };
    return {convert(f.C), convert(f.S), convert(f.X), convert(f.Y), convert(f.W)};
}

// True if a polynomial certainly has no root strictly between 0 and 1 after which it is positive: by Descartes' rule, for the
// signs of its Bernstein coefficients do not change, or once from positive to negative.
bool never_becomes_positive(Poly f) {
    to_bernstein(f);
    bool is_positive = false;
    for (const Int& x : f) {  // from 1 towards 0
        if (is_positive && x.sign() < 0) return false;
        is_positive |= x.sign() > 0;
    }
    return true;
}

// First root between another and 1 after which a polynomial is positive.
std::optional<RealRoot> crossing(const Poly& f, RealRoot& after) {
    if (f.size() < 2 || never_becomes_positive(f)) return {};
    if (f.size() == 3 && f[1] * f[1] <= 4 * f[0] * f[2]) return {};  // no root, or a double one
    const Sturm sturm(f.size() > 3 ? squarefree(f) : f);
    for (const auto& [from, to] : isolate(sturm, {0, 0}, {1, 0}, 0)) {
        RealRoot x{sturm.polynomial(), from, to};
        if (sign_at(x.p, x.hi) == 0) x.lo = x.hi;
        while (!x.is_dyadic() && sign_at(x.p, x.lo) == 0) {  // x.lo is another root
            const Dyadic mid = Dyadic::middle(x.lo, x.hi);
            (sturm.roots_in(mid, x.hi) > 0 ? x.lo : x.hi) = mid;
            if (sign_at(x.p, x.hi) == 0) x.lo = x.hi;
        }
        const bool ends = x.is_dyadic() && compare(x.hi, {1, 0}) == 0;
        if (!ends && (x.is_dyadic() ? sign_after(f, x) : sign_at(f, x.hi)) > 0 && compare(x, after) > 0) return x;
    }
    return {};
}

}  // namespace

// The check of one motion.
template <int N>
class MotionChecker::Run {
public:
    Run(const MotionChecker& on_checker, const Frames<N>& frames, bool only_whether)
        : checker(on_checker), A(on_checker.scene->robot), O(on_checker.scene->obstacles), stops(only_whether),
          exact(frames), shift(on_checker.scene->shift), robot(rounded(exact.robot, shift)),
          obstacles(rounded(exact.obstacles, shift)) {}

    void run() {
        for (piece = 0; piece < A.pieces() && !(stops && collides); ++piece) {
            decided.clear();
            halve(0, 1, 0, nullptr);
        }
    }

    bool collides = false;
    std::optional<Collision> first;

private:
    // Halve [lo, hi] for a robot piece as long as doubles cannot decide, and then decide exactly.
    void halve(double lo, double hi, int depth, const std::vector<Index>* parents) {
        if (lo >= horizon) return;
        const Frame<Approx, N> frame = on(robot, lo, hi);
        std::vector<Point<Approx, N>> points;
        for (Index v = A.piece[piece]; v < A.piece[piece + 1]; ++v)
            points.push_back(moved(frame, x_of<Approx>(A, A.piece_vertex[v]), y_of<Approx>(A, A.piece_vertex[v])));
        std::vector<Index> left;
        const Frame<Approx, N> back = on(obstacles, lo, hi);
        const auto keep = [&](Index k) {
            if (O.piece_layer[k] != A.piece_layer[piece] || is_decided(k)) return;
            if (!are_apart(frame, back, points, k)) left.push_back(k);
        };
        const auto box = swept(frame, points);
        if (parents) {
            for (const Index k : *parents)
                if (!box || checker.boxes[k].meets(*box)) keep(k);
        } else if (box) {
            checker.tree->query(*box, keep);
        } else {
            if (depth < most_halvings) return halves(lo, hi, depth, nullptr);
            for (Index k = 0; k < O.pieces(); ++k) keep(k);
        }
        if (left.empty()) return;
        const double mid = 0.5 * (lo + hi);
        for (const Index k : left)
            if (lo < horizon && overlap(mid, k)) {
                collides = true;
                if (stops) {
                    horizon = 0;
                    return;
                }
                decide(k);
            }
        if (depth < most_halvings) return halves(lo, hi, depth, &left);
        for (const Index k : left)
            if (lo < horizon && !is_decided(k)) decide(k);
    }
    void halves(double lo, double hi, int depth, const std::vector<Index>* candidates) {
        const double mid = 0.5 * (lo + hi);
        halve(lo, mid, depth + 1, candidates);
        halve(mid, hi, depth + 1, candidates);
    }
    bool is_decided(Index k) const { return std::find(decided.begin(), decided.end(), k) != decided.end(); }

    // Box of a piece over the interval of a frame: around its control points, if their weights are positive.
    std::optional<Box> swept(const Frame<Approx, N>& frame, const std::vector<Point<Approx, N>>& points) const {
        Box box;
        for (int k = 0; k <= N; ++k) {
            const Approx& W = frame.W[k];
            if (!(W.v > W.m * 0x1p-4)) return {};
            for (const Point<Approx, N>& p : points) {
                if (!std::isfinite(p.x[k].m + p.y[k].m)) return {};
                const double dx = error_of(p.x[k]), dy = error_of(p.y[k]);
                box.add((p.x[k].v - dx) / W.v, (p.y[k].v - dy) / W.v);
                box.add((p.x[k].v + dx) / W.v, (p.y[k].v + dy) / W.v);
            }
        }
        return grown(box);
    }

    // True if one edge certainly separates two pieces on the whole interval of the frames.
    bool are_apart(const Frame<Approx, N>& frame, const Frame<Approx, N>& back, const std::vector<Point<Approx, N>>& points,
                   Index k) const {
        const auto parts = [](const Shape& s, Index e, const Point<Approx, N>& point, const Frame<Approx, N>& f) {
            const Vec<Approx> d = edge<Approx>(s, e);
            const Approx x = x_of<Approx>(s, s.v[e]), y = y_of<Approx>(s, s.v[e]);
            for (int i = 0; i <= N; ++i)
                if (!is_negative(side(d, x, y, point, f, i))) return false;
            return true;
        };
        for (Index e = O.piece[k]; e < O.piece[k + 1]; ++e)
            if (std::all_of(points.begin(), points.end(), [&](const auto& p) { return parts(O, O.piece_edge[e], p, frame); }))
                return true;
        std::vector<Point<Approx, N>> seen;
        for (Index v = O.piece[k]; v < O.piece[k + 1]; ++v)
            seen.push_back(moved(back, x_of<Approx>(O, O.piece_vertex[v]), y_of<Approx>(O, O.piece_vertex[v])));
        for (Index e = A.piece[piece]; e < A.piece[piece + 1]; ++e)
            if (A.has_extent(A.piece_edge[e]) &&
                std::all_of(seen.begin(), seen.end(), [&](const auto& p) { return parts(A, A.piece_edge[e], p, back); }))
                return true;
        return false;
    }

    // True if the interiors certainly meet at a parameter.
    bool overlap(double at, Index k) const {
        return reaches_in(O, k, A, piece, on(robot, at, at)) && reaches_in(A, piece, O, k, on(obstacles, at, at));
    }
    // True if each edge of a piece has a vertex of a moving piece on its inner side.
    static bool reaches_in(const Shape& s, Index k, const Shape& moving, Index j, const Frame<Approx, N>& f) {
        for (Index e = s.piece[k]; e < s.piece[k + 1]; ++e) {
            const Index d = s.piece_edge[e];
            bool inside = !s.has_extent(d);
            for (Index v = moving.piece[j]; v < moving.piece[j + 1] && !inside; ++v) {
                const Index a = moving.piece_vertex[v];
                const auto point = moved(f, x_of<Approx>(moving, a), y_of<Approx>(moving, a));
                inside = is_positive(side(edge<Approx>(s, d), x_of<Approx>(s, s.v[d]), y_of<Approx>(s, s.v[d]), point, f, 0));
            }
            if (!inside) return false;
        }
        return true;
    }

    // --- exactly ---

    // A piece at rest and the vertices of one that moves past it.
    struct View {
        const Shape& still;
        Index piece;
        const Frame<Int, N>& frame;
        int kind;
        std::vector<Index> vertices;
        std::vector<Point<Int, N>> points;

        View(const Shape& s, Index k, const Shape& moving, Index j, const Frame<Int, N>& f, int kind_of_contact)
            : still(s), piece(k), frame(f), kind(kind_of_contact) {
            for (Index v = moving.piece[j]; v < moving.piece[j + 1]; ++v) {
                vertices.push_back(moving.piece_vertex[v]);
                points.push_back(moved(f, moving.X[vertices.back()], moving.Y[vertices.back()]));
            }
        }
        // Positions of the vertices beside an edge, if just after a parameter none is on its inner side.
        std::optional<std::vector<Poly>> parted(Index e, RealRoot& from) const {
            const auto direction = edge<Int>(still, e);
            std::vector<Poly> sides;
            for (const auto& p : points) {
                const auto at = [&](int i) {
                    return side(direction, still.X[still.v[e]], still.Y[still.v[e]], p, frame, i);
                };
                sides.emplace_back();
                for (int i = 0; i <= N; ++i) sides.back().push_back(at(i));
                sides.back().trim();
                if (!sides.back().empty() && sign_after(sides.back(), from) > 0) return {};
            }
            return sides;
        }
    };

    // Go from one edge that separates the two pieces to the next, as far as each does. The pieces are apart on a closed set, so
    // it is enough to test just after each end.
    void decide(Index k) {
        decided.push_back(k);
        const View views[2] = {{O, k, A, piece, exact.robot, 1}, {A, piece, O, k, exact.obstacles, 2}};
        Collision now{{Poly{0, 1}, {0, 0}, {0, 0}}, piece, k};
        for (;;) {
            std::optional<Collision> next;
            for (const View& view : views)
                for (Index e = view.still.piece[view.piece]; e < view.still.piece[view.piece + 1]; ++e) {
                    const Index d = view.still.piece_edge[e];
                    if (!view.still.has_extent(d)) continue;
                    const auto sides = view.parted(d, now.at);
                    if (!sides) continue;
                    std::optional<Collision> end;
                    for (std::size_t i = 0; i < sides->size(); ++i) {
                        auto x = crossing((*sides)[i], now.at);
                        if (!x || (end && compare(*x, end->at) >= 0)) continue;
                        end = Collision{*x, piece, k, view.kind, view.vertices[i], d};
                        if (view.kind == 2) std::swap(end->robot, end->obstacle);
                    }
                    if (!end) return;  // separates them to the end of the motion
                    if (!next || compare(end->at, next->at) > 0) next = end;
                }
            if (!next) break;
            now = *next;
        }
        collides = true;
        if (!first || compare(now.at, first->at) < 0) first = now;
        for (int i = 0; i < most_halvings; ++i) now.at.halve();
        horizon = stops ? 0 : std::min(horizon, now.at.hi.rounded_up());
    }

    const MotionChecker& checker;
    const Shape &A, &O;
    const bool stops;
    const Frames<N> exact;
    const int shift;
    const Frame<double, N> robot, obstacles;  // powers of u
    Index piece = 0;
    std::vector<Index> decided;  // pieces of obstacles
    double horizon = 1;          // nothing after it matters
};

MotionChecker::MotionChecker(std::shared_ptr<const Scene> s, std::shared_ptr<const MotionTest> true_shapes)
    : scene(std::move(s)), boxes(piece_boxes(scene->obstacles)), tree(std::make_unique<BoxTree>(boxes)), round(std::move(true_shapes)) {
    const Shape& o = scene->obstacles;
    std::array<bool, 2> has_frame{false, true};
    for (Index v = 0; v < o.ring_vertices; ++v)
        if (!o.emit[v]) has_frame[0] = true;  // it is on the rim of the frame around the workspace
    for (Index k = 0; k < o.pieces(); ++k) {
        const Index layer = o.piece_layer[k];
        if (!has_frame[layer]) continue;
        for (Index m = o.piece[k]; m < o.piece[k + 1]; ++m) {
            const Int &x = o.X[o.piece_vertex[m]], &y = o.Y[o.piece_vertex[m]];
            auto& rim = rims[layer];
            if (!rim) rim = Rim{x, y, x, y, {}};
            rim->x0 = std::min(rim->x0, x), rim->y0 = std::min(rim->y0, y), rim->x1 = std::max(rim->x1, x), rim->y1 = std::max(rim->y1, y);
        }
    }
    for (auto& rim : rims) {
        if (!rim) continue;
        const auto rounded = [&](const Int& c) { return std::ldexp(ratio(c, Int(1)), -scene->shift); };
        const double x0 = rounded(rim->x0), y0 = rounded(rim->y0), x1 = rounded(rim->x1), y1 = rounded(rim->y1), reach = reach_of(scene->robot);
        const double slack = reach + 0x1p-40 * (reach + std::abs(x0) + std::abs(y0) + std::abs(x1) + std::abs(y1));
        rim->inner = {x0 + slack, y0 + slack, x1 - slack, y1 - slack};
    }
}
MotionChecker::~MotionChecker() = default;

// A point of each piece is enough, as no piece overlaps the frame. Mostly doubles tell that all of the robot is within.
bool MotionChecker::begins_outside(const Motion& m) const {
    if (round || (!rims[0] && !rims[1])) return false;
    const Shape& a = scene->robot;
    const double x = std::ldexp(nearest(m.x, m.unit), -scene->shift), y = std::ldexp(nearest(m.y, m.unit), -scene->shift);
    for (Index layer = 0; layer < 2; ++layer) {
        if (!rims[layer]) continue;
        const auto& [x0, y0, x1, y1, inner] = *rims[layer];
        if (inner[0] < x && x < inner[2] && inner[1] < y && y < inner[3]) continue;
        const Int whole = m.w * m.unit, left = x0 * whole, right = x1 * whole, low = y0 * whole, high = y1 * whole;
        for (Index k = 0; k < a.pieces(); ++k) {
            if (a.piece_layer[k] != layer) continue;
            const Int &vx = a.X[a.piece_vertex[a.piece[k]]], &vy = a.Y[a.piece_vertex[a.piece[k]]];
            const Int px = (m.c * vx - m.s * vy) * m.unit + m.x * m.w, py = (m.s * vx + m.c * vy) * m.unit + m.y * m.w;
            if (!(left < px && px < right && low < py && py < high)) return true;
        }
    }
    return false;
}

bool MotionChecker::is_free(const Motion& motion) const {
    if (round) {
        Motion moved = motion;
        moved.unit *= scene->scale;
        return round->is_free(moved);
    }
    Run<2> run(*this, frames_of(motion), true);
    run.run();
    return !run.collides;
}

bool MotionChecker::is_free(const Slide& slide) const {
    Run<6> run(*this, frames_of(slide), true);
    run.run();
    return !run.collides;
}

std::optional<Collision> MotionChecker::first_collision(const Motion& motion) const {
    Run<2> run(*this, frames_of(motion), false);
    run.run();
    return run.first;
}

}  // namespace cfree
