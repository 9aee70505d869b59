// Index type of features, trapezoids and all other counted things.
#pragma once
#include <cstdint>

namespace cfree {

using Index = std::int32_t;

}  // namespace cfree
