// Paths that keep a distance from obstacles where there is room, and are short among those; theory, "Paths".
#pragma once
#include "cfree/search/ridge.hpp"

namespace cfree {

struct Balanced {
    Way way;  // what is asked of shorter paths still
    Marked path;
};
// A path beside a free one, or past a narrow place of it. The way has no distances yet.
Balanced balanced(const Way& way, const Route& route);

}  // namespace cfree
