// Whether trapezoids from outside can be those of a scene: what all other files rely on, to end and to stay within their arrays.
#pragma once
#include <optional>
#include <string>

#include "cfree/forbidden/boundary.hpp"

namespace cfree {

bool are_patches_of(const Scene& scene, const Patches& patches);

// What cannot be right of a boundary whose indices are in their ranges: "", or a name.
std::string misfit(const Boundary& boundary, int threads);

// The first trapezoid that cannot be: every angle is the only root of its polynomial in its interval, `from` is before `to`, and
// between them 0 <= lower <= upper <= 1.
std::optional<Index> first_impossible(const Scene& scene, const Patches& patches, const Trapezoids& trapezoids, int threads);
// Of isolated parts: their angles and curves are some.
std::optional<Index> first_impossible(const Scene& scene, const Patches& patches, const IsolatedParts& isolated);

}  // namespace cfree
