// Work of a boundary, estimated before it is computed.
#pragma once
#include "cfree/forbidden/boundary.hpp"

namespace cfree {

// Counts of this many patches of a scene, spread over all of them, or of all if there are fewer. What is trimmed is thrown away.
// Throws Stopped.
Count sampled_count(const Scene& scene, Index samples);

}  // namespace cfree
