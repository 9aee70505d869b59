#include "cfree/scene.hpp"

#include <algorithm>

namespace cfree {

void Shape::set_coordinates(std::vector<Int> exact_x, std::vector<Int> exact_y, int shift) {
    X = std::move(exact_x), Y = std::move(exact_y);
    int widest = 1;
    rounded = false;
    const auto convert = [&](const std::vector<Int>& exact, std::vector<double>& out) {
        out.clear();
        for (const Int& c : exact) {
            const int width = c.is_zero() ? 0 : static_cast<int>(msb(abs(c))) + 1, below = std::max(0, width - 64);
            const double leading = Int(c >> static_cast<unsigned>(below)).convert_to<double>();  // of 64 bits: always finite
            const double nearest = std::ldexp(leading, below);
            out.push_back(std::ldexp(leading, below - shift));
            rounded |= !std::isfinite(nearest) || Int(nearest) != c;
            widest = std::max(widest, width);
        }
    };
    convert(X, x), convert(Y, y);
    bits = widest + 1;
    nx.clear(), ny.clear();
    if (widest > 62) return;
    for (const Int& c : X) nx.push_back(static_cast<std::int64_t>(c));
    for (const Int& c : Y) ny.push_back(static_cast<std::int64_t>(c));
}

}  // namespace cfree
