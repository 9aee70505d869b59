// Vectors of rationals.
#pragma once
#include <optional>

#include "cfree/exact/ratio.hpp"
#include "cfree/polygons/polygon.hpp"

namespace cfree::rational {

inline const Ratio zero{0, 1}, one{1, 1};
inline RatioPoint operator-(const RatioPoint& p, const RatioPoint& q) { return {p.x - q.x, p.y - q.y}; }
inline RatioPoint operator+(const RatioPoint& p, const RatioPoint& q) { return {p.x + q.x, p.y + q.y}; }
inline RatioPoint times(const RatioPoint& p, const Ratio& by) { return {p.x * by, p.y * by}; }
inline Ratio cross(const RatioPoint& p, const RatioPoint& q) { return p.x * q.y - p.y * q.x; }
inline Ratio dot(const RatioPoint& p, const RatioPoint& q) { return p.x * q.x + p.y * q.y; }
inline RatioPoint to_left(const RatioPoint& p) { return {-p.y, p.x}; }
// The square root of a number whose root is rational.
inline std::optional<Ratio> rational_root(const Ratio& square) {
    const Int n = sqrt(square.n), d = sqrt(square.d);
    return n * n == square.n && d * d == square.d ? std::optional(Ratio{n, d}) : std::nullopt;
}
inline double near(const Ratio& x) { return nearest(x.n, x.d); }

}  // namespace cfree::rational
