// Landings on the boundary of a cell: straight ways from a pose to it, motions from a free pose onto trapezoids along which
// it can go on, and free segments that link a cell's closed surfaces.
#pragma once
#include <map>

#include "cfree/free/free_space.hpp"
#include "cfree/planning/face_graph.hpp"
#include "cfree/planning/free_motions.hpp"

namespace cfree {

inline constexpr int most_halvings = 4096;  // halvings of a way or an interval: more than any scene needs

// A free way to a pose on a face, strictly between its first and last orientation, or far away.
struct Landing {
    Index face;
    Poses way;
    const RationalPose& pose() const { return way.back(); }
    Mark mark() const { return {face, pose().place()}; }
};
// Link from one landing to another: the first one's way backwards, then the second one's.
struct Link {
    Landing first, second;
};

// Sizes of the scene: no point of the robot is farther than `reach` from its reference point; `length` exceeds every finite
// free straight way, and `far` is x to the left of everything.
struct Extent {
    Ratio reach, length, far;
    Extent(const CellComplex& cells, const Ratio& reach);
};

class Landings {
public:
    // Keeps references to all arguments.
    Landings(const FreeSpace& space, const Extent& extent, const FreeMotions& motions);

    Sheet sheet(Index face) const { return Sheet::of(*space.boundary, space.points(), face); }
    // Pose half-way from the contact at (t, tau) to the next contact.
    RationalPose off(const Sheet& sheet, const Ratio& t, const Ratio& tau) const;
    // Ways from a pose, in a cell or on its boundary, to the boundary.
    std::vector<Landing> of(const RationalPose& pose, Index cell) const;
    // Free segments that link all closed surfaces of a cell, and the far left if it is unbounded: all segments on one ray
    // towards -x, for each surface except the outer one. The ray leaves the cell and comes back over the same surface, as no
    // other surface bounds that part of the forbidden space there: so they link its ends.
    std::vector<Link> links(Index cell) const;

private:
    std::vector<Landing> departures(const RationalPose& pose, Index cell) const;
    std::vector<Landing> straight(const RationalPose& pose, int x, int y, Index cell) const;
    void link(Index widest, Index cell, std::vector<Link>& found) const;
    std::optional<Ratio> crossing(Index face, const RationalPose& pose) const;
    Poses inwards(const Sheet& sheet, const RationalPose& pose, int end) const;

    const FreeSpace& space;
    const Extent& extent;
    const FreeMotions& motions;
};

}  // namespace cfree
