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
// its circle. A joint is named by the circle about the end of its edge.
inline CurveName curve_name(const Scene& scene, const Feature& on, const Feature& curve) {
    const auto surface = [&](Feature f) {
        f.branch = 0;
        return code(scene, f);
    };
    for (const auto& [line, circle] : {std::pair{&on, &curve}, std::pair{&curve, &on}})
        if (const int end = smooth_end(scene, *line, *circle); end >= 0) {
            const Code first = surface(*line), second = code(scene, circle_at_end(scene, *line, end));
            return {std::min(first, second), std::max(first, second), 0};
        }
    const Code own = surface(on);
    if (curve.kind == Kind::seam) return {own, code(scene, curve), 0};
    const Code other = surface(curve);
    return {std::min(own, other), std::max(own, other), own > other ? -curve.branch : curve.branch};
}

}  // namespace cfree
