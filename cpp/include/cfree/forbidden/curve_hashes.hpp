// Short name of a curve in C, the same on every surface: its point at one fixed orientation, in integers modulo a prime.
//
// Equal curves have equal hashes. Hashes of different curves are equal with a chance of 2^-60, or by an unlucky choice of
// numbers: `is_same_curve` decides equal hashes.
#pragma once
#include <compare>
#include <functional>
#include <vector>

#include "cfree/contact/contact_line.hpp"
#include "cfree/exact/residues.hpp"

namespace cfree {

struct CurveHash {
    std::uint64_t x, y;
    auto operator<=>(const CurveHash&) const = default;
};

// A curve named on a surface: its intersection with `other`, a surface or a helix.
struct NamedCurve {
    Feature on, other;
};

// Hashes of `count` curves, modulo the first prime of a fixed sequence for which all have a point. Both numbers are below 2^62.
class CurveHashes {
public:
    CurveHashes(const Scene& scene, std::size_t count, const std::function<NamedCurve(std::size_t)>& curve, int threads);
    CurveHashes(const CurveHashes&) = delete;
    const CurveHash& operator[](std::size_t k) const { return hashes[k]; }
    // False if the curve certainly does not lie on a surface.
    bool may_lie_on(const Feature& surface, const CurveHash& curve) const;

private:
    struct Reduced {  // coordinates modulo the prime
        const Scene* scene;
        std::vector<Vec<Residue>> robot, obstacles;
        const Vec<Residue>& vertex(const Shape& s, Index v) const { return (&s == &scene->robot ? robot : obstacles)[v]; }
        Vec<Residue> edge(const Shape& s, Index e) const { return vertex(s, s.w[e]) - vertex(s, s.v[e]); }
    };
    struct Line {
        Vec<Residue> P, U;
    };
    void choose(unsigned attempt);
    bool hash(std::size_t begin, std::size_t end, const std::function<NamedCurve(std::size_t)>& curve);
    Line line(const Feature& surface) const;

    const Scene& scene;
    Residues in{3};
    Reduced reduced;
    Rotation<Residue> turn;
    std::vector<CurveHash> hashes;
};

// Exact tests: a curve lies on a surface; two names are of one curve.
bool lies_on(const Scene& scene, const NamedCurve& curve, const Feature& surface);
bool is_same_curve(const Scene& scene, const NamedCurve& x, const NamedCurve& y);

}  // namespace cfree
