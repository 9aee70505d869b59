// Short paths among those that keep a distance from obstacles where there is room; theory, "Paths".
#pragma once
#include "cfree/search/ridge.hpp"

namespace cfree {

struct Balanced {
    Way way;  // requirements on still shorter paths
    Marked path;
};
// Path beside a free one, or past a narrow place of it. The way has no distances yet.
Balanced balanced(const Way& way, const Route& route);

}  // namespace cfree
