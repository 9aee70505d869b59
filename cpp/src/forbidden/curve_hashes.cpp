// Curves at one orientation, modulo a prime; theory, "Closed surfaces".
#include "cfree/forbidden/curve_hashes.hpp"

#include <boost/multiprecision/miller_rabin.hpp>
#include <stdexcept>

#include "support/parallel.hpp"

namespace cfree {

namespace {

// True if two lines are parallel at every orientation: there is no curve then.
bool are_parallel(const Scene& scene, const Feature& x, const Feature& y) {
    const auto direction = [&](const Feature& f) {
        return f.kind == Kind::vertex_edge ? edge<Int>(scene.obstacles, f.obstacle) : edge<Int>(scene.robot, f.robot);
    };
    const auto is_point = [](const Vec<Int>& d) { return d.x.is_zero() && d.y.is_zero(); };
    const auto d = direction(x), e = direction(y);
    return x.kind == y.kind ? cross(d, e).is_zero() : is_point(d) || is_point(e);
}

}  // namespace

CurveHashes::CurveHashes(const Scene& sc, std::size_t count, const std::function<NamedCurve(std::size_t)>& curve, int threads)
    : scene(sc), reduced{&sc, {}, {}}, hashes(count) {
    std::atomic<bool> unlucky = count > 0;
    for (unsigned attempt = 0; unlucky; ++attempt) {
        choose(attempt);
        unlucky = false;
        for_each_block_in_parallel(threads, count, [&](std::size_t k) {
            if (unlucky) return;
            const NamedCurve next = curve(k);
            const auto hash = of(next);
            if (!hash && are_parallel(scene, next.on, next.other)) throw std::logic_error("a curve of two parallel surfaces");
            if (hash) hashes[k] = *hash;
            else unlucky = true;
        });
    }
}

// Primes and orientations without any pattern: coordinates have patterns, and are short modulo 2^61 - 1.
void CurveHashes::choose(unsigned attempt) {
    using Word = Residues::Word;
    Word seed = attempt;
    const auto next = [&] {  // splitmix64
        Word z = seed += 0x9e3779b97f4a7c15u;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u, z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        return z ^ z >> 31;
    };
    Word prime = next() >> 3 | Word(1) << 61 | 1;
    while (!boost::multiprecision::miller_rabin_test(Int(prime), 25)) prime += 2;
    in = Residues(prime);
    const auto table = [&](const Shape& shape) {
        std::vector<Vec<Residue>> result;
        for (std::size_t k = 0; k < shape.X.size(); ++k) result.push_back({{in.of(shape.X[k]), &in}, {in.of(shape.Y[k]), &in}});
        return result;
    };
    reduced.robot = table(scene.robot), reduced.obstacles = table(scene.obstacles);
    const Residue one{in.of(1), &in}, tau{in.of(next() >> 3), &in}, square = tau * tau, inverse{in.inverse((one + square).x), &in};
    turn = {(one - square) * inverse, (tau + tau) * inverse, one};
}

CurveHashes::Line CurveHashes::line(const Feature& f) const {
    const ContactLine<Residue> l(scene, f, reduced);
    return {l.start(turn), l.direction(turn)};
}

// Hash of a curve; nothing if the two lines are parallel modulo the prime.
std::optional<CurveHash> CurveHashes::of(const NamedCurve& curve) const {
    if (curve.other.kind == Kind::vertex_vertex) {
        const auto p = reduced.obstacles[curve.other.obstacle] - turn(reduced.robot[curve.other.robot]);
        return CurveHash{p.x.x, p.y.x};
    }
    const auto [P, U] = line(curve.on);
    const auto [Q, V] = line(curve.other);
    const Residue inverse{in.inverse(cross(U, V).x), &in};
    if (inverse.x == 0) return {};
    const Residue t = cross(Q - P, V) * inverse;
    return CurveHash{(P.x + t * U.x).x, (P.y + t * U.y).x};
}

bool CurveHashes::may_lie_on(const Feature& surface, const CurveHash& curve) const {
    const auto [P, U] = line(surface);
    return cross(U, Vec<Residue>{{curve.x, &in}, {curve.y, &in}} - P).x == 0;
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
