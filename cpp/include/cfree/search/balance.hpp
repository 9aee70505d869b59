// Short paths among those that keep a distance from obstacles where there is room; theory, "Paths".
#pragma once
#include <cmath>

#include "cfree/search/ridge.hpp"

namespace cfree {

struct Balanced {
    Way way;  // requirements on still shorter paths
    Marked path;
};
// Path beside a free one, or past a narrow place of it. The way has no distances yet. If it has a center, and the path
// turns no more than its ends ask for, the result mostly does not either, unless turns make the narrowest place much wider.
// Greater distances than `up_to` count as that.
Balanced balanced(const Way& way, const Route& route, double up_to = HUGE_VAL);

}  // namespace cfree
