#include "cfree/scene/scene.hpp"

namespace cfree {

void Shape::set_coordinates(std::vector<Int> exact_x, std::vector<Int> exact_y, int shift) {
    X = std::move(exact_x), Y = std::move(exact_y);
    rounded = rounded_twice = false;
    const auto convert = [&](const std::vector<Int>& exact, std::vector<double>& high, std::vector<double>& low) {
        high.clear(), low.clear();
        for (const Int& c : exact) {
            const Ball b = ball(c, shift);
            high.push_back(b.hi), low.push_back(b.lo);
            rounded |= b.lo != 0 || b.radius != 0;
            rounded_twice |= b.radius != 0;
        }
    };
    convert(X, x, x_low), convert(Y, y, y_low);
}

}  // namespace cfree
