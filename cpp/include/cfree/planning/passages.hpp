// Paths through exact fits: contact motions between cells, and from poses in no cell, where free space has no clearance.
//
// C_free is closed. Its cells may touch, and its isolated parts are free without being in any cell. Every motion is checked:
// a path that is found is a proof. Finding none proves nothing.
#pragma once
#include <set>
#include <tuple>

#include "cfree/planning/meeting_places.hpp"

namespace cfree {

class Passages {
public:
    Passages(std::shared_ptr<const BoundaryWalker> walker, std::shared_ptr<const CellComplex> slits);

    // Poses from start to goal, both free: the fewest places first. Nothing if no path is found. Places at irrational
    // orientations are used only if `irrational` is set: they take long. Throws std::logic_error if there is no path within a
    // cell. Calls from several threads wait for each other.
    std::optional<Poses> path(const RationalPose& start, const RationalPose& goal, bool irrational);

    const MeetingPlaces places;

private:
    // Poses and their holders; one motion joins some of them.
    struct Spots {
        Poses poses;
        std::vector<std::vector<Holder>> holders;
        std::vector<std::vector<Index>> joined;
        std::map<RationalPose::Key, Index> number;
        Index add(const RationalPose& pose, std::vector<Holder> of);
    };
    using Leg = std::tuple<RationalPose::Key, Holder, RationalPose::Key>;
    const Spots& spots(bool irrational);
    // Step from one pose to the next through a holder of both; without one, a single motion joins them.
    struct Step {
        std::optional<Holder> by;
        Index to;
    };
    std::optional<std::vector<Step>> fewest(const Spots& all, Index start, Index goal) const;
    std::optional<Poses> along(const Spots& all, Index start, const std::vector<Step>& steps);

    std::mutex lock;
    std::optional<Spots> rational, every;
    std::set<Leg> broken;  // isolated parts without motions along them
};

}  // namespace cfree
