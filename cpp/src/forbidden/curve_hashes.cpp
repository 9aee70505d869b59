// Curves at one orientation, modulo a prime; theory, "Closed surfaces".
#include "cfree/forbidden/curve_hashes.hpp"

#include <boost/multiprecision/miller_rabin.hpp>
#include <stdexcept>

#include "support/parallel.hpp"

namespace cfree {

namespace {

constexpr std::size_t at_once = 64;  // curves that share an inverse

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
        for_each_block_in_parallel(threads, (count + at_once - 1) / at_once, [&](std::size_t k) {
            if (!unlucky && !hash(k * at_once, std::min(count, (k + 1) * at_once), curve)) unlucky = true;
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

// Hash some curves, with one inverse for all; false if two lines are parallel modulo the prime.
bool CurveHashes::hash(std::size_t begin, std::size_t end, const std::function<NamedCurve(std::size_t)>& curve) {
    struct Meeting {  // of P + t U and Q + s V, t = along / across
        std::size_t curve;
        Line line;
        Residue along, across, before;  // product of all `across` before
    };
    std::vector<Meeting> meetings;
    Residue product = turn.w;
    for (std::size_t k = begin; k < end; ++k) {
        const auto [on, other] = curve(k);
        if (other.kind == Kind::vertex_vertex) {
            const auto p = reduced.obstacles[other.obstacle] - turn(reduced.robot[other.robot]);
            hashes[k] = {p.x.x, p.y.x};
            continue;
        }
        const auto [P, U] = line(on);
        const auto [Q, V] = line(other);
        const Residue across = cross(U, V);
        if (across.x == 0) {
            if (are_parallel(scene, on, other)) throw std::logic_error("a curve of two parallel surfaces");
            return false;
        }
        meetings.push_back({k, {P, U}, cross(Q - P, V), across, product});
        product = product * across;
    }
    Residue inverse{in.inverse(product.x), &in};
    for (auto m = meetings.rbegin(); m != meetings.rend(); ++m) {
        const auto& [P, U] = m->line;
        const Residue t = m->along * (inverse * m->before);
        hashes[m->curve] = {(P.x + t * U.x).x, (P.y + t * U.y).x};
        inverse = inverse * m->across;
    }
    return true;
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
