// Search for the farthest place along a path that one motion reaches.
#pragma once
#include <algorithm>
#include <cstddef>

namespace cfree {

// Place of from + 1 to last that is reached, far from `from`: steps double until one fails, then halves follow. The next place
// counts as reached.
template <class Reaches>
std::size_t farthest(std::size_t from, std::size_t last, Reaches&& reaches) {
    std::size_t good = from + 1, bad = last + 1;
    for (std::size_t step = 2; good + 1 < bad; step *= 2) {
        const std::size_t next = bad > last ? std::min(from + step, last) : (good + bad) / 2;
        (reaches(next) ? good : bad) = next;
    }
    return good;
}

}  // namespace cfree
