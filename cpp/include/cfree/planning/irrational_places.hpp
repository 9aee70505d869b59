// Ways through places at irrational orientations: slides along two contacts, and turns about a point of contact.
#pragma once
#include "cfree/planning/meeting_places.hpp"

namespace cfree {

// Free ways from one part of the free space to another, as far as they are found.
std::vector<Poses> irrational_ways(const MeetingPlaces& places);

}  // namespace cfree
