// Descartes' rule of signs between 0 and 1.
#pragma once
#include <algorithm>
#include <cstddef>

namespace cfree {

// p(x + 1), from coefficients in ascending order.
template <class Numbers>
void move_by_one(Numbers& p) {
    const auto c = p.begin();
    const std::ptrdiff_t size = p.end() - c;
    for (std::ptrdiff_t first = 0; first + 1 < size; ++first)
        for (std::ptrdiff_t j = size - 1; j-- > first;) c[j] += c[j + 1];
}

// Bernstein coefficients between 0 and 1 times positive numbers, that at 1 first: those of (1 + x)^d p(1 / (1 + x)). There are
// at most as many roots strictly between 0 and 1 as changes of sign among them, and fewer by an even number.
template <class Numbers>
void to_bernstein(Numbers& p) {
    std::reverse(p.begin(), p.end());
    move_by_one(p);
}

}  // namespace cfree
