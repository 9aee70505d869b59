// Rounding error of the doubles that decide the side of a moved point.
#pragma once
#include "cfree/exact/number.hpp"

namespace cfree {

// At most 30 roundings lead to a side: a coefficient of a frame has 20, a moved point 4 more, its product with an edge 5
// more. Coordinates stay below 2^100 and the largest of C, S, W is about 1, so underflow loses less than 2^-850.
inline double error_of(const Approx& f) { return f.m * 0x1p-47 + 0x1p-850; }

}  // namespace cfree
