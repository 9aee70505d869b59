// Numbers of features, trapezoids and whatever else is counted.
#pragma once
#include <cstdint>

namespace cfree {

using Index = std::int32_t;

}  // namespace cfree
