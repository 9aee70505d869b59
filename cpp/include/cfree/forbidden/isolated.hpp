// Isolated free contacts, which are on no trapezoid: free space there is only a curve, a segment at one angle, or a point.
//
// Trimming leaves parts without width on each patch. Most of them lie on trapezoids of other patches; the rest is isolated,
// and is listed once.
#pragma once
#include <atomic>

#include "cfree/forbidden/columns.hpp"

namespace cfree {

IsolatedParts isolated_parts(const Scene& scene, const Patches& patches, const Trapezoids& live, const Trapezoids& thin,
                             int threads, std::atomic<bool>& stop);
// The same among grown shapes.
IsolatedParts isolated_round_parts(const Scene& scene, const Patches& patches, const Trapezoids& live, const Trapezoids& thin, int threads);

}  // namespace cfree
