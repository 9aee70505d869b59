// Vectors of exact integers and of doubles.
#pragma once
#include "cfree/exact/number.hpp"

namespace cfree {

inline Int square(const Vec<Int>& v) { return v.x * v.x + v.y * v.y; }
inline Vec<Int> turned(const Vec<Int>& v) { return {-v.y, v.x}; }
inline Vec<Int> times(const Int& k, const Vec<Int>& p) { return {k * p.x, k * p.y}; }
inline int bits_of(const Int& n) { return n.is_zero() ? 0 : static_cast<int>(msb(abs(n))) + 1; }

}  // namespace cfree
