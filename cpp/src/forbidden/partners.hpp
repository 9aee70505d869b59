// Two sides that are partners on a piece of a line at a critical angle.
#pragma once
#include <optional>
#include <type_traits>

#include "cfree/predicates/junction.hpp"
#include "forbidden/parts.hpp"
#include "forbidden/side_at_angle.hpp"

namespace cfree {

struct LevelSide {
    Index trapezoid;
    bool is_above;
    const Feature& contact;
};
inline LevelSide level_side(const SideAtAngle& of) { return {of.trapezoid, of.is_above, of.on.contact}; }

// Place at which curves arrive on a line or a circle, read once on one surface. At is Junction or RoundJunction.
template <class At>
struct LinePlace {
    typename At::Spot spot;
    Feature on;                  // the surface
    Interval t;                  // on that
    std::optional<double> near;  // the same, if doubles suffice

    static LinePlace read(const Feature& on, const typename At::Spot& spot, const At& at) {
        if constexpr (std::is_same_v<At, Junction>) {
            const auto [t, near] = at.reading(on, spot);
            return {spot, on, t, near};
        } else {
            return {spot, on, at.range(on, spot), {}};
        }
    }
    double value(const Feature& contact, At& at) const { return near && contact == on ? *near : at.value(contact, spot); }
};

// Pair the only two sides on a piece, whose lines have one direction.
template <class At>
void pair_on_piece(const LevelSide& x, const LevelSide& y, const LinePlace<At>& from, const LinePlace<At>& to, At& at, Parts& parts) {
    const auto add = [&](const LevelSide& of) {
        const Side side = of.is_above ? Side::first : Side::last;
        return parts.add(of.trapezoid, side, false, (is_forwards(side) ? from : to).value(of.contact, at));
    };
    parts.begin_edge();
    const Index first = add(x);
    parts.pair(first, add(y));
}

}  // namespace cfree
