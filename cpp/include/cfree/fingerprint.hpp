// A short name for a curve in C, whoever names it: its point at one fixed orientation, in integers modulo a prime.
//
// Equal curves have equal fingerprints. Different ones differ but for a chance of 2^-61, and that is checked where it matters.
#pragma once
#include <compare>
#include <vector>

#include "cfree/predicates.hpp"

namespace cfree {

struct Fingerprint {
    std::uint64_t x, y;
    auto operator<=>(const Fingerprint&) const = default;
};

// A curve as a surface names it: where `other`, a surface or a helix, meets it.
struct NamedCurve {
    Feature on, other;
};

class Fingerprints {
public:
    explicit Fingerprints(const Scene& scene);
    Fingerprint of(const NamedCurve& curve) const;
    // Whether the curve may lie on a surface; if not, it does not.
    bool may_lie_on(const Feature& surface, const Fingerprint& curve) const;

private:
    using Word = std::uint64_t;
    struct Point {
        Word x, y;
    };
    static std::vector<Point> reduced(const Shape& shape);
    Point placed(Index a, Index b) const;                 // b_b - R a_a
    std::array<Point, 2> line(const Feature& surface) const;  // a point and the direction

    const Scene& scene;
    std::vector<Point> robot, obstacles;
    Word c, s;  // of the orientation
};

// Whether a curve lies on a surface, and whether two names are of one curve, exactly.
bool lies_on(const Scene& scene, const NamedCurve& curve, const Feature& surface);
bool is_same_curve(const Scene& scene, const NamedCurve& x, const NamedCurve& y);

}  // namespace cfree
