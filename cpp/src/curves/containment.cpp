// Decide the sides of parts of curves against a ring: signs of double-double intervals first, then of exact integers.
#include "cfree/curves/containment.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <span>

#include "cfree/exact/ball.hpp"

namespace cfree {

namespace {

constexpr int deepest = 48;  // most halvings of a piece
enum Side { outside = -1, on_ring = 0, inside = 1 };

// The point (x / w, y / w), w > 0.
template <class T>
struct Corner {
    T x, y, w;
};

template <class T>
Corner<T> operator*(const T& factor, const Corner<T>& p) { return {factor * p.x, factor * p.y, factor * p.w}; }
template <class T>
Corner<T> operator+(const Corner<T>& p, const Corner<T>& q) { return {p.x + q.x, p.y + q.y, p.w + q.w}; }

template <class T>
T determinant(const Corner<T>& p, const Corner<T>& q, const Corner<T>& r) {
    return (p.x * q.y - p.y * q.x) * r.w + (q.x * r.y - q.y * r.x) * p.w + (r.x * p.y - r.y * p.x) * q.w;
}

int power_of(const Int& n) { return n.is_zero() ? 0 : static_cast<int>(msb(abs(n))); }

Corner<Ball> rounded(const Corner<Int>& p) {
    const int k = power_of(p.w);
    return {ball(p.x, k), ball(p.y, k), ball(p.w, k)};
}

// Numbers of a piece; all its points have the same w. An arc has its start instead of its center.
template <class T>
struct Form {
    std::vector<Corner<T>> points;
    T n, d;  // an arc's last parameter
};
struct Piece {
    Form<Int> exact;
    Form<Ball> about;
    std::optional<std::array<Corner<Int>, 2>> line;  // the extreme ends, if all of the piece is on one line
};

// Hull of a piece from `first` to `last` of its parameter, out of `whole`.
template <class T>
void hull_of(const Form<T>& form, const T& first, const T& last, const T& whole, Corner<T>* hull) {
    const auto& p = form.points;
    if (p.size() == 2) {
        hull[0] = p[0], hull[1] = p[1];
        return;
    }
    if (p.size() == 3) {
        const T s = form.n * first, t = form.n * last, q = form.d * whole;
        // start + 2 s (q v - s u) / (q^2 + s^2): near the start nothing cancels, however far the center is
        const auto at = [&](const T& square, const T& twice, const T& w) {
            return Corner<T>{w * p[0].x + twice * p[2].x - square * p[1].x, w * p[0].y + twice * p[2].y - square * p[1].y, w * p[0].w};
        };
        const T square = q * q;
        hull[0] = at(s * s + s * s, q * s + q * s, square + s * s);
        hull[1] = at(s * t + s * t, q * s + q * t, square + s * t);  // intersection of the end tangents
        hull[2] = at(t * t + t * t, q * t + q * t, square + t * t);
        return;
    }
    for (int j = 0; j < 4; ++j) {  // the blossom at `first` and j times `last`
        std::array<Corner<T>, 4> row{p[0], p[1], p[2], p[3]};
        for (int level = 0; level < 3; ++level) {
            const T& t = level < 3 - j ? first : last;
            for (int i = 0; i < 3 - level; ++i) row[i] = (whole - t) * row[i] + t * row[i + 1];
        }
        hull[j] = row[0];
    }
}

// A piece from k / 2^m to (k + 1) / 2^m of its parameter; its integer hull is computed when needed.
struct Part {
    const Piece* piece;
    std::int64_t k;
    int m, count;
    std::array<Corner<Ball>, 4> hull;

    Part(const Piece& whole, std::int64_t number, int depth) : piece(&whole), k(number), m(depth) {
        count = static_cast<int>(whole.about.points.size());
        const double size = std::ldexp(1.0, -m);
        hull_of<Ball>(whole.about, static_cast<double>(k) * size, static_cast<double>(k + 1) * size, 1.0, hull.data());
    }
    std::span<const Corner<Ball>> corners() const { return {hull.data(), static_cast<std::size_t>(count)}; }
    std::array<Corner<Int>, 4> exact() const {
        std::array<Corner<Int>, 4> corners;
        hull_of<Int>(piece->exact, k, k + 1, Int(1) << static_cast<unsigned>(m), corners.data());
        return corners;
    }
};

struct Box {
    double x0, y0, x1, y1;
    bool meets(const Box& other) const { return x0 <= other.x1 && other.x0 <= x1 && y0 <= other.y1 && other.y0 <= y1; }
};

class Check {
public:
    Check(const Polygon& polygon, Index ring_number, const ClosedCurve& curve) {
        for (Index k = polygon.offsets[ring_number]; k < polygon.offsets[ring_number + 1]; ++k) {
            ring.push_back({polygon.vertices.X(k), polygon.vertices.Y(k), polygon.denominator});
            about.push_back(rounded(ring.back()));
        }
        for (const CurvePiece& given : curve) pieces.push_back(prepared(given));
        for (const auto& p : about) widen(p);
        for (const Piece& piece : pieces) {
            const Part whole(piece, 0, 0);
            for (const auto& p : whole.corners()) widen(p);
        }
        for (Index k = 0; k < size(); ++k) boxes.push_back(box_of(std::array{about[k], about[next(k)]}));
        edges.resize(ring.size());
        std::iota(edges.begin(), edges.end(), 0);
    }

    // True if all parts of the curve are on this side of the ring, or on the ring.
    bool is_on(Side wanted) {
        if (!is_closed()) return false;
        side = on_ring;
        return std::all_of(pieces.begin(), pieces.end(),
                           [&](const Piece& piece) { return piece.line ? line_is_on(piece, wanted) : part_is_on({piece, 0, 0}, edges, wanted); });
    }

    // True if the chords of the parts go around a point inside the ring.
    bool goes_around() const {
        const Corner<Int> p = point_inside();
        int turns = 0;
        const Corner<Ball> point = rounded(p);
        for (std::size_t k = 0; k < starts.size(); ++k) {
            const Part &a = starts[k], &b = starts[k + 1 < starts.size() ? k + 1 : 0];
            const bool is_up = !is_above(a, point, p);
            if (is_above(b, point, p) != is_up) continue;
            const auto known = certain_sign(determinant(a.hull[0], b.hull[0], point));
            const int turn = known ? *known : determinant(a.exact()[0], b.exact()[0], p).sign();
            if (is_up ? turn > 0 : turn < 0) turns += is_up ? 1 : -1;
        }
        return turns != 0;
    }

private:
    using Edges = std::vector<Index>;
    using Exact = std::optional<std::array<Corner<Int>, 4>>;
    std::vector<Corner<Int>> ring;
    std::vector<Corner<Ball>> about;
    std::vector<Piece> pieces;
    std::vector<Box> boxes;
    std::vector<Part> starts;  // the hull of each begins at its start
    Edges edges;
    double largest = 0;  // coordinate
    Side side = on_ring;  // side of the next part; `on_ring` if unknown

    Index size() const { return static_cast<Index>(ring.size()); }
    Index next(Index k) const { return k + 1 < size() ? k + 1 : 0; }

    static Piece prepared(const CurvePiece& given) {
        Piece piece;
        auto& points = piece.exact.points;
        Int w = 1;
        for (const RatioPoint& p : given.points) w = lcm(w, lcm(p.x.d, p.y.d));
        for (const RatioPoint& p : given.points) points.push_back({p.x.n * (w / p.x.d), p.y.n * (w / p.y.d), w});
        if (points.size() == 3) points[0].x += points[1].x, points[0].y += points[1].y;  // start of the arc
        if (points.size() != 3 && are_on_a_line(points)) piece.line = ends_of(points);
        piece.exact.n = given.last.n, piece.exact.d = given.last.d;
        for (const auto& p : points) piece.about.points.push_back(rounded(p));
        const int k = power_of(given.last.d);
        piece.about.n = ball(given.last.n, k), piece.about.d = ball(given.last.d, k);
        return piece;
    }

    static bool are_on_a_line(const std::vector<Corner<Int>>& points) {
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                for (std::size_t h = 0; h < j; ++h)
                    if (!determinant(points[i], points[j], points[h]).is_zero()) return false;
        return true;
    }
    // Least and greatest point by x and then by y.
    static std::array<Corner<Int>, 2> ends_of(const std::vector<Corner<Int>>& points) {
        const auto [low, high] = std::minmax_element(points.begin(), points.end(), [](const Corner<Int>& p, const Corner<Int>& q) {
            return p.x != q.x ? p.x < q.x : p.y < q.y;
        });
        return {*low, *high};
    }

    static bool are_equal(const Corner<Int>& p, const Corner<Int>& q) { return p.x * q.w == q.x * p.w && p.y * q.w == q.y * p.w; }
    // Sign of p.y - q.y.
    static int level(const Corner<Int>& p, const Corner<Int>& q) { return Int(p.y * q.w - q.y * p.w).sign(); }
    static bool is_above(const Part& part, const Corner<Ball>& point, const Corner<Int>& p) {
        const auto known = certain_sign(part.hull[0].y * point.w - point.y * part.hull[0].w);
        return (known ? *known : level(part.exact()[0], p)) > 0;
    }

    // --- boxes in doubles, wide enough for what they round ---

    void widen(const Corner<Ball>& p) {
        if (std::abs(p.w.hi) > 0) largest = std::max({largest, std::abs(p.x.hi / p.w.hi), std::abs(p.y.hi / p.w.hi)});
    }
    Box box_of(std::span<const Corner<Ball>> points) const {
        Box box{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        for (const auto& p : points) {
            const double x = p.x.hi / p.w.hi, y = p.y.hi / p.w.hi;
            box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x), std::max(box.y1, y)};
        }
        const double margin = 0x1p-40 * largest;  // numerators and denominators are right to 2^-45 of their summands
        return {box.x0 - margin, box.y0 - margin, box.x1 + margin, box.y1 + margin};
    }
    Edges near(const Box& box, const Edges& among) const {
        Edges found;
        for (const Index k : among)
            if (box.meets(boxes[k])) found.push_back(k);
        return found;
    }

    // --- curves ---

    bool part_is_on(const Part& part, const Edges& among, Side wanted) {
        const Edges met = near(box_of(part.corners()), among);
        Exact exact;
        if (std::any_of(met.begin(), met.end(), [&](Index e) { return meets_interior(part, exact, e); })) {
            if (part.m == deepest) return false;
            return part_is_on({*part.piece, 2 * part.k, part.m + 1}, met, wanted) &&
                   part_is_on({*part.piece, 2 * part.k + 1, part.m + 1}, met, wanted);
        }
        if (side == on_ring) side = side_of(middle_of(part.exact(), part.count));
        starts.push_back(part);
        const bool is_right = side == wanted;
        const auto last = static_cast<std::size_t>(part.count) - 1;
        const auto ends_on = [&](Index e) {
            const auto known = certain_sign(determinant(about[e], about[next(e)], part.hull[last]));
            return known.value_or(0) == 0 && is_between(part.exact()[last], e);
        };
        if (std::any_of(met.begin(), met.end(), ends_on)) side = on_ring;
        return is_right;
    }

    // True if no line has the hull on one side and the edge on the other; the line may touch both.
    bool meets_interior(const Part& part, Exact& exact, Index e) const {
        const std::array<Index, 2> ends{e, next(e)};
        const auto sign = [&](const auto& of_balls, const auto& of_integers) {
            if (const auto known = certain_sign(of_balls())) return *known;
            if (!exact) exact = part.exact();
            return static_cast<int>(of_integers().sign());
        };
        const auto beside_edge = [&](int i) {
            const auto k = static_cast<std::size_t>(i);
            return sign([&] { return determinant(about[ends[0]], about[ends[1]], part.hull[k]); },
                        [&] { return determinant(ring[ends[0]], ring[ends[1]], (*exact)[k]); });
        };
        int least = 1, most = -1;
        for (int i = 0; i < part.count; ++i) least = std::min(least, beside_edge(i)), most = std::max(most, beside_edge(i));
        if (least >= 0 || most <= 0) return false;
        for (std::size_t i = 0; i < static_cast<std::size_t>(part.count); ++i)
            for (std::size_t j = i + 1; j < static_cast<std::size_t>(part.count); ++j) {
                int low = 1, high = -1;
                for (std::size_t h = 0; h < static_cast<std::size_t>(part.count); ++h) {
                    if (h == i || h == j) continue;
                    const int s = sign([&] { return determinant(part.hull[i], part.hull[j], part.hull[h]); },
                                       [&] { return determinant((*exact)[i], (*exact)[j], (*exact)[h]); });
                    low = std::min(low, s), high = std::max(high, s);
                }
                if (low < 0 && high > 0) continue;
                const auto beside = [&](Index v) {
                    return sign([&] { return determinant(part.hull[i], part.hull[j], about[v]); },
                                [&] { return determinant((*exact)[i], (*exact)[j], ring[v]); });
                };
                const int a = beside(ends[0]), b = beside(ends[1]);
                if ((high > 0 && a <= 0 && b <= 0) || (low < 0 && a >= 0 && b >= 0)) return false;
            }
        return true;
    }

    // Mean of the corners of a hull.
    static Corner<Int> middle_of(const std::array<Corner<Int>, 4>& hull, int count) {
        Corner<Int> sum = hull[0];
        for (int i = 1; i < count; ++i) {
            const auto& p = hull[static_cast<std::size_t>(i)];
            sum = {sum.x * p.w + p.x * sum.w, sum.y * p.w + p.y * sum.w, sum.w * p.w};
        }
        sum.w *= count;
        return sum;
    }

    // --- lines ---

    // Test a line, cut at the edges that it meets: each part is on one side.
    bool line_is_on(const Piece& piece, Side wanted) {
        const Corner<Int>&p = (*piece.line)[0], &q = (*piece.line)[1];
        starts.emplace_back(piece, 0, 0);
        const Edges met = near(box_of(piece.about.points), edges);
        if (std::any_of(met.begin(), met.end(), [&](Index e) { return is_between(p, e) && is_between(q, e); })) {
            side = on_ring;
            return true;
        }
        // places along the line as quotients, from 0 to 1
        std::vector<Ratio> places;
        const Ratio length = are_equal(p, q) ? Ratio{1, 1} : along(p, q, q);
        for (const Index e : met) {
            const Corner<Int>&a = ring[e], &b = ring[next(e)];
            const Int one = determinant(p, q, a), other = determinant(p, q, b);
            if (one.sign() * other.sign() > 0) continue;
            if (one.is_zero() || other.is_zero()) {
                for (const auto& [value, end] : {std::pair(&one, &a), std::pair(&other, &b)})
                    if (value->is_zero()) places.push_back(along(p, q, *end) / length);
            } else {
                const Int w = one * b.w - other * a.w;
                const Corner<Int> crossing{(one * b.x - other * a.x) * w.sign(), (one * b.y - other * a.y) * w.sign(), abs(w)};
                places.push_back(along(p, q, crossing) / length);
            }
        }
        std::erase_if(places, [](const Ratio& place) { return place < Ratio{0, 1} || place > Ratio{1, 1}; });
        if (places.empty()) {
            if (side == on_ring) side = side_of(p);
            return side == wanted;
        }
        places.push_back({0, 1}), places.push_back({1, 1});
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
        side = on_ring;
        for (std::size_t k = 0; k + 1 < places.size(); ++k) {
            const Ratio t = (places[k] + places[k + 1]) * Ratio{1, 2};
            const Side here = side_of({(t.d - t.n) * p.x * q.w + t.n * q.x * p.w, (t.d - t.n) * p.y * q.w + t.n * q.y * p.w, t.d * p.w * q.w});
            if (here != wanted && here != on_ring) return false;
        }
        return true;
    }

    // Inner product of the vectors from p to q and to r.
    static Ratio along(const Corner<Int>& p, const Corner<Int>& q, const Corner<Int>& r) {
        const auto difference = [&](const Corner<Int>& to) { return Vec<Int>{to.x * p.w - p.x * to.w, to.y * p.w - p.y * to.w}; };
        return reduced(dot(difference(q), difference(r)), p.w * q.w * p.w * r.w);
    }

    // --- points ---

    bool is_between(const Corner<Int>& p, Index e) const {
        const Corner<Int>&a = ring[e], &b = ring[next(e)];
        if (!determinant(a, b, p).is_zero()) return false;
        const auto within = [&](Int Corner<Int>::* axis) {
            const int low = Int(p.*axis * a.w - a.*axis * p.w).sign(), high = Int(p.*axis * b.w - b.*axis * p.w).sign();
            return low * high <= 0;
        };
        return within(&Corner<Int>::x) && within(&Corner<Int>::y);
    }

    // Side by crossings of the ray to the right; an edge contains its lower end.
    Side side_of(const Corner<Int>& p) const {
        bool is_odd = false;
        const Corner<Ball> point = rounded(p);
        for (Index k = 0; k < size(); ++k) {
            const int low = level_of(k, point, p), high = level_of(next(k), point, p);
            if (low == 0 && high == 0 ? is_between(p, k) : low * high <= 0 && crossing(k, point, p) == 0) return on_ring;
            if ((low <= 0) != (high <= 0) && (crossing(k, point, p) > 0) == (high > 0)) is_odd = !is_odd;
        }
        return is_odd ? inside : outside;
    }
    int level_of(Index k, const Corner<Ball>& point, const Corner<Int>& p) const {
        const auto known = certain_sign(about[k].y * point.w - point.y * about[k].w);
        return known ? *known : level(ring[k], p);
    }
    int crossing(Index k, const Corner<Ball>& point, const Corner<Int>& p) const {
        const auto known = certain_sign(determinant(about[k], about[next(k)], point));
        return known ? *known : static_cast<int>(determinant(ring[k], ring[next(k)], p).sign());
    }

    // Point between the first two crossings of a horizontal line between the two lowest levels of vertices.
    Corner<Int> point_inside() const {
        std::vector<Int> levels;
        for (const auto& p : ring) levels.push_back(p.y);
        std::sort(levels.begin(), levels.end());
        levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
        const Int y = levels[0] + levels[1], w = ring[0].w;  // twice the level
        std::vector<Ratio> xs;
        for (Index k = 0; k < size(); ++k) {
            const Corner<Int>&a = ring[k], &b = ring[next(k)];
            if ((2 * a.y < y) == (2 * b.y < y)) continue;
            xs.push_back(Ratio{a.x, 1} + reduced((b.x - a.x) * (y - 2 * a.y), 2 * (b.y - a.y)));
        }
        std::sort(xs.begin(), xs.end());
        const Ratio x = xs[0] + xs[1];
        return {x.n, y * x.d, 2 * x.d * w};
    }

    bool is_closed() const {
        for (std::size_t k = 0; k < pieces.size(); ++k)
            if (!are_equal(end_of(pieces[k], true), end_of(pieces[k + 1 < pieces.size() ? k + 1 : 0], false))) return false;
        return !pieces.empty();
    }
    static Corner<Int> end_of(const Piece& piece, bool last) {
        return Part(piece, 0, 0).exact()[last ? piece.exact.points.size() - 1 : 0];
    }
};

}  // namespace

bool is_around(const Polygon& polygon, Index ring, const ClosedCurve& curve) { return Check(polygon, ring, curve).is_on(inside); }

bool is_within(const Polygon& polygon, Index ring, const ClosedCurve& curve) {
    Check check(polygon, ring, curve);
    return check.is_on(outside) && check.goes_around();
}

}  // namespace cfree
