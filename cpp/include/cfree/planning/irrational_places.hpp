// Paths through places at irrational orientations: slides along two contacts, and turns about a point of contact.
#pragma once
#include "cfree/planning/meeting_places.hpp"

namespace cfree {

// Free paths from one part of the free space to another; not all are found.
std::vector<Poses> irrational_ways(const MeetingPlaces& places);

}  // namespace cfree
