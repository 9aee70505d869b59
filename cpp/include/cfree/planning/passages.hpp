// Ways through exact fits: contact motions between cells, and from poses in no cell, where free space is too thin for any
// clearance.
//
// C_free is closed. Its cells may touch, and its isolated parts are free without being in any cell. Every motion is checked: a
// way that is found is a proof. That none is found says nothing.
#pragma once
#include <set>
#include <tuple>

#include "cfree/planning/meeting_places.hpp"

namespace cfree {

class Passages {
public:
    Passages(std::shared_ptr<const BoundaryWalker> walker, std::shared_ptr<const CellComplex> slits);

    // Poses from start to goal, both free: the fewest places first. Nothing if no way was found. MeetingPlaces at irrational
    // orientations are left out unless asked for: they take long. Throws std::logic_error if a cell cannot be walked in. Calls
    // from several threads wait for each other.
    std::optional<Poses> path(const RationalPose& start, const RationalPose& goal, bool irrational);

    const MeetingPlaces places;

private:
    // Poses, and what holds them; some are joined by one motion besides.
    struct Spots {
        Poses poses;
        std::vector<std::vector<Holder>> holders;
        std::vector<std::vector<Index>> joined;
        std::map<RationalPose::Key, Index> number;
        Index add(const RationalPose& pose, std::vector<Holder> of);
    };
    using Leg = std::tuple<RationalPose::Key, Holder, RationalPose::Key>;
    const Spots& spots(bool irrational);
    // From one pose to the next, by what holds both; nothing where one motion joins them.
    struct Step {
        std::optional<Holder> by;
        Index to;
    };
    std::optional<std::vector<Step>> fewest(const Spots& all, Index start, Index goal) const;
    std::optional<Poses> along(const Spots& all, Index start, const std::vector<Step>& steps);

    std::mutex lock;
    std::optional<Spots> rational, every;
    std::set<Leg> broken;  // isolated parts along which no motions were found
};

}  // namespace cfree
