// Sides at critical angles as rows: gluing reads them in the order of angles, in which trapezoids are not.
#pragma once
#include "cfree/forbidden/critical_angle.hpp"

namespace cfree {

struct SideAtAngle {
    Index trapezoid;
    bool is_above;  // the trapezoid begins there
    int place;
    Surface on;
    Feature lower, upper;   // its curves
    Feature first, second;  // the angle's name
    double lo, hi;

    SideAtAngle(const Patches& patches, const Trapezoids& t, Index k, bool begins)
        : trapezoid(k), is_above(begins), place((begins ? t.from_place : t.to_place)[k]), on(surface_of(patches, t, k)),
          lower(unpacked(t.lower[k])), upper(unpacked(t.upper[k])), first(unpacked((begins ? t.from_first : t.to_first)[k])),
          second(unpacked((begins ? t.from_second : t.to_second)[k])), lo((begins ? t.from_lo : t.to_lo)[k]),
          hi((begins ? t.from_hi : t.to_hi)[k]) {}
    CriticalAngle angle() const { return {on, {first, second, lo, hi}, place}; }
};

}  // namespace cfree
