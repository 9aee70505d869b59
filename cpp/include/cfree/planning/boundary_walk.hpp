// Paths on the boundary of a cell, made of translations and rotations that are proved free.
//
// A trapezoid's lines of constant theta are translations, its lines of constant t are rotations about the point of contact;
// steps along them are free because the trapezoid is part of the boundary. They are the last resort: poses off the contact,
// by half of the room there, are joined by one motion if that is free.
#pragma once
#include <map>
#include <mutex>

#include "cfree/planning/landing.hpp"

namespace cfree {

class BoundaryWalker {
public:
    // Lengths are travel plus angle_scale, the robot's radius, times total rotation. Slides on paths are added to `slides`.
    BoundaryWalker(std::shared_ptr<const FreeSpace> space, std::shared_ptr<const CellComplex> cells,
                   std::shared_ptr<const MotionChecker> checker, double angle_scale, std::shared_ptr<FoundSlides> slides);

    // Poses from the start to the goal, both in the cell or on its boundary; the motions between them are free. Places are the
    // same in doubles. Throws std::logic_error if no path is found. Several threads may call this.
    struct End {
        RationalPose pose;
        Place place;
    };
    Poses walk(const End& start, const End& goal, Index cell) const;

    // Poses from the middle of one face to the middle of another, over their last or first angles, closer and closer to these.
    // Nothing if none are found.
    struct EndOfFace {
        Index face;
        bool is_last;
    };
    std::optional<Poses> turn(const EndOfFace& from, const EndOfFace& to, int attempts) const;

    Sheet sheet(Index face) const { return Sheet::of(*space->boundary, space->points(), face); }
    Index cell_at(Index face) const { return space->cell_of[space->surfaces.component[face]]; }
    FreeMotions motions() const { return {*space->boundary->scene, *checker, *slides}; }

    const std::shared_ptr<const FreeSpace> space;
    const std::shared_ptr<const CellComplex> cells;
    const std::shared_ptr<const MotionChecker> checker;
    const std::shared_ptr<FoundSlides> slides;
    const double angle_scale;

private:
    class Run;
    std::shared_ptr<const std::vector<Link>> links(const Landings& landings, Index cell) const;

    const FaceGraph graph;
    const Extent extent;
    mutable std::mutex lock;  // guards the cache
    mutable std::map<Index, std::shared_ptr<const std::vector<Link>>> known;
};

}  // namespace cfree
