// A route over the places of another that turns less, if its motions are admissible; theory, "Paths".
#pragma once
#include "cfree/search/way.hpp"

namespace cfree {

// The cheapest route over the poses of a path, and over these turned to the orientation of its start, its goal or another of
// its poses, about the reference point or about the way's center. They turn in place, or as the path does.
Marked with_fewer_turns(const Way& way, const Marked& path);

}  // namespace cfree
