// Checks that trapezoids from outside can be those of a scene. All other files rely on this to terminate and to stay within
// their arrays.
#pragma once
#include <optional>
#include <string>

#include "cfree/forbidden/boundary.hpp"

namespace cfree {

bool are_patches_of(const Scene& scene, const Patches& patches);

// Name of an impossible part of a boundary whose indices are in their ranges, or "".
std::string misfit(const Boundary& boundary, int threads);

// First impossible trapezoid. Possible ones satisfy: every angle is the only root of its polynomial in its interval, `from`
// is before `to`, and between them 0 <= lower <= upper <= 1.
std::optional<Index> first_impossible(const Scene& scene, const Patches& patches, const Trapezoids& trapezoids, int threads);
// First impossible isolated part, by its angles and curves.
std::optional<Index> first_impossible(const Scene& scene, const Patches& patches, const IsolatedParts& isolated);

}  // namespace cfree
