// Names of curves among grown shapes, the same from both surfaces: two codes and the branch as the surface of lesser code has it;
// theory, "Rounded shapes".
#pragma once
#include <compare>

#include "predicates/round_surfaces.hpp"

namespace cfree {

struct CurveName {
    Code first, second;
    int branch;
    auto operator<=>(const CurveName&) const = default;
};

// Where one surface enters another one, that leaves it. A joint, and two lines, have no branch; an end of a quadrant is named by
// its circle.
inline CurveName curve_name(const Scene& scene, const Feature& on, const Feature& curve) {
    const auto surface = [&](Feature f) {
        f.branch = 0;
        return code(scene, f);
    };
    const Code own = surface(on);
    if (curve.kind == Kind::seam) return {own, code(scene, curve), 0};
    const Code other = surface(curve);
    return {std::min(own, other), std::max(own, other), own > other ? -curve.branch : curve.branch};
}

}  // namespace cfree
