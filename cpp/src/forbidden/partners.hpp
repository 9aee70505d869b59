// Two sides that are partners on a piece of a line at a critical angle.
#pragma once
#include "forbidden/parts.hpp"
#include "forbidden/side_at_angle.hpp"

namespace cfree {

struct LevelSide {
    Index trapezoid;
    bool is_above;
    const Feature& contact;
};
inline LevelSide level_side(const SideAtAngle& of) { return {of.trapezoid, of.is_above, of.on.contact}; }

// Pair the only two sides on a piece, whose lines have one direction. At is Junction or RoundJunction.
template <class At>
void pair_on_piece(const LevelSide& x, const LevelSide& y, const typename At::Spot& from, const typename At::Spot& to, At& at,
                   Parts& parts) {
    const auto add = [&](const LevelSide& of) {
        const Side side = of.is_above ? Side::first : Side::last;
        return parts.add(of.trapezoid, side, false, at.value(of.contact, is_forwards(side) ? from : to));
    };
    parts.begin_edge();
    const Index first = add(x);
    parts.pair(first, add(y));
}

}  // namespace cfree
