#include "cfree/fingerprint.hpp"

namespace cfree {

namespace {

using Word = std::uint64_t;
constexpr Word prime = (Word(1) << 61) - 1;

Word plus(Word x, Word y) { return x + y >= prime ? x + y - prime : x + y; }
Word minus(Word x, Word y) { return x >= y ? x - y : x + prime - y; }
Word times(Word x, Word y) {
    const Wide z = static_cast<Wide>(x) * y;
    return plus(static_cast<Word>(z & prime), static_cast<Word>(z >> 61));
}
Word inverse(Word x) {  // x^(prime - 2)
    Word result = 1;
    for (Word e = prime - 2; e != 0; e >>= 1, x = times(x, x))
        if (e & 1) result = times(result, x);
    return result;
}

}  // namespace

Fingerprints::Fingerprints(const Scene& sc) : scene(sc), robot(reduced(sc.robot)), obstacles(reduced(sc.obstacles)) {
    const Word tau = 1234567891011121314u % prime, q = times(tau, tau), w = inverse(plus(1, q));
    c = times(minus(1, q), w), s = times(plus(tau, tau), w);
}

std::vector<Fingerprints::Point> Fingerprints::reduced(const Shape& shape) {
    const Int p = prime;
    const auto word = [&](const Int& n) {
        const Int r = n % p;
        return static_cast<Word>(r.sign() < 0 ? Int(r + p) : r);
    };
    std::vector<Point> result;
    for (std::size_t k = 0; k < shape.X.size(); ++k) result.push_back({word(shape.X[k]), word(shape.Y[k])});
    return result;
}

Fingerprints::Point Fingerprints::placed(Index a, Index b) const {
    const Point &A = robot[a], &B = obstacles[b];
    return {minus(B.x, minus(times(c, A.x), times(s, A.y))), minus(B.y, plus(times(s, A.x), times(c, A.y)))};
}

std::array<Fingerprints::Point, 2> Fingerprints::line(const Feature& f) const {
    const Feature first = end_helix(scene, f, 0), last = end_helix(scene, f, 1);
    const Point p = placed(first.robot, first.obstacle), q = placed(last.robot, last.obstacle);
    return {p, {minus(q.x, p.x), minus(q.y, p.y)}};
}

Fingerprint Fingerprints::of(const NamedCurve& curve) const {
    if (curve.other.kind == Kind::vertex_vertex) {
        const Point p = placed(curve.other.robot, curve.other.obstacle);
        return {p.x, p.y};
    }
    const auto [P, U] = line(curve.on);
    const auto [Q, V] = line(curve.other);
    const auto product = [](const Point& u, const Point& v) { return minus(times(u.x, v.y), times(u.y, v.x)); };
    const Word t = times(product({minus(Q.x, P.x), minus(Q.y, P.y)}, V), inverse(product(U, V)));
    return {plus(P.x, times(t, U.x)), plus(P.y, times(t, U.y))};
}

bool Fingerprints::may_lie_on(const Feature& surface, const Fingerprint& curve) const {
    const auto [P, U] = line(surface);
    return times(U.x, minus(curve.y, P.y)) == times(U.y, minus(curve.x, P.x));
}

bool lies_on(const Scene& scene, const NamedCurve& curve, const Feature& surface) {
    if (curve.other.kind == Kind::vertex_vertex) return Predicates(scene, {surface, 0}).vanishes(curve.other, {});
    const Code own = code(scene, surface);
    return own == code(scene, curve.on) || own == code(scene, curve.other) ||
           Predicates(scene, {curve.on, 0}).vanishes(curve.other, surface);
}

bool is_same_curve(const Scene& scene, const NamedCurve& x, const NamedCurve& y) {
    const bool helix = x.other.kind == Kind::vertex_vertex;
    if (helix && y.other.kind == Kind::vertex_vertex) return code(scene, x.other) == code(scene, y.other);
    if (y.other.kind == Kind::vertex_vertex) return is_same_curve(scene, y, x);
    return lies_on(scene, x, y.on) && lies_on(scene, x, y.other);
}

}  // namespace cfree
