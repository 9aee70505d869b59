// A short name for a curve in C, whoever names it: its point at one fixed orientation, in integers modulo a prime.
//
// Equal curves have equal hashes. Different ones differ but for a chance of 2^-60, or by an unlucky choice of numbers:
// whoever finds two equal ones asks `is_same_curve`.
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

// A curve as a surface names it: where `other`, a surface or a helix, meets it.
struct NamedCurve {
    Feature on, other;
};

// Of `count` curves, modulo the first prime of a fixed sequence for which all have a point. Both numbers are below 2^62.
class CurveHashes {
public:
    CurveHashes(const Scene& scene, std::size_t count, const std::function<NamedCurve(std::size_t)>& curve, int threads);
    CurveHashes(const CurveHashes&) = delete;
    const CurveHash& operator[](std::size_t k) const { return hashes[k]; }
    // Whether the curve may lie on a surface; if not, it does not.
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
    std::optional<CurveHash> of(const NamedCurve& curve) const;
    Line line(const Feature& surface) const;

    const Scene& scene;
    Residues in{3};
    Reduced reduced;
    Rotation<Residue> turn;
    std::vector<CurveHash> hashes;
};

// Whether a curve lies on a surface, and whether two names are of one curve, exactly.
bool lies_on(const Scene& scene, const NamedCurve& curve, const Feature& surface);
bool is_same_curve(const Scene& scene, const NamedCurve& x, const NamedCurve& y);

}  // namespace cfree
