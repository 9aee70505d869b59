// Line of a contact of a turning robot, as polynomials in t: positions P + s U after a further rotation by 2 atan(t).
#pragma once
#include "cfree/contact/contact_line.hpp"

namespace cfree {

// All times w (1 + t^2).
struct MovingLine {
    std::array<Poly, 2> P, U;
    MovingLine(const ContactLine<Int>& line, const Rotation<Int>& from) {
        const auto less_turned = [&](const Vec<Int>& fixed, const Vec<Int>& v) {
            const Vec<Int> r = from(v);
            const Int x = from.w * fixed.x, y = from.w * fixed.y;
            return std::array{Poly{x - r.x, 2 * r.y, x + r.x}, Poly{y - r.y, -2 * r.x, y + r.y}};
        };
        const Vec<Int> none{0, 0};
        P = less_turned(line.b, line.a);
        U = line.on_edge ? less_turned(line.E, none) : less_turned(none, line.E);
    }
};

inline std::array<Poly, 2> difference(const std::array<Poly, 2>& u, const std::array<Poly, 2>& v) {
    return {difference(u[0], v[0]), difference(u[1], v[1])};
}
inline Poly cross(const std::array<Poly, 2>& u, const std::array<Poly, 2>& v) {
    return difference(product(u[0], v[1]), product(u[1], v[0]));
}

}  // namespace cfree
