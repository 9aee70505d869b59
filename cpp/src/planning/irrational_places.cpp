// Join curves that end at the start of others; theory, "Paths", "Exact fits".
#include "cfree/planning/irrational_places.hpp"

#include <cmath>
#include <numbers>

#include "cfree/support/elementary.hpp"
#include "cfree/support/lookout.hpp"

namespace cfree {

namespace {

constexpr int most_turns = 256;              // attempts per turn, closer and closer to the critical angle
constexpr unsigned halvings[] = {4, 16, 64}; // halvings towards the end: nearness of a slide to it

bool are_near(double theta, double other) { return std::abs(std::remainder(theta - other, 2 * std::numbers::pi)) <= not_told_apart; }

// One of the curves of a sheet near its first or last orientation, and its holder.
struct Tail {
    Sheet sheet;
    std::size_t side;
    bool is_last;
    Holder holder;
    std::vector<Int> name;

    // Pose on it, closer and closer to its end.
    RationalPose pose(unsigned nearer) const {
        const Ratio &low = sheet.low, &high = sheet.high;
        const Ratio share = (high - low) / Ratio{Int(1) << nearer};
        const Ratio tau = is_last ? simple_middle(high - share, high) : simple_middle(low, low + share);
        const auto [lower, upper] = sheet.limits(tau);
        return sheet.pose(side ? upper : lower, tau);
    }
};

// True if an angle of a member of the encounter is rational, and there.
bool is_rational(const MeetingPlaces& places, const Encounter& encounter) {
    const Boundary& boundary = *places.on_faces().space->boundary;
    for (const Index face : encounter.faces)
        for (const bool last : {false, true}) {
            const auto tau = rational_angle(boundary, face, last);
            if (tau && are_near(HalfAngle::of(boundary.trapezoids.chart[face], *tau).theta(), encounter.theta)) return true;
        }
    for (const Index k : encounter.parts)
        for (const auto& end : places.parts[k].ends)
            if (end && are_near(end->half.theta(), encounter.theta)) return true;
    return false;
}

// Tails that begin or end at an encounter, if its orientation is irrational.
std::vector<Tail> tails(const MeetingPlaces& places, const Encounter& encounter) {
    std::vector<Tail> found;
    if (is_rational(places, encounter)) return found;
    const auto add = [&](const Sheet& sheet, const Holder& holder) {
        if (!(sheet.low < sheet.high)) return;
        for (const bool is_last : {false, true})
            for (const std::size_t side : {0u, 1u}) {
                const Ratio& end = is_last ? sheet.high : sheet.low;
                const double theta = theta_of(sheet.chart, nearest(end.n, end.d));
                if (!are_near(theta, encounter.theta) || (holder.of == Holder::Of::part && side)) continue;
                auto name = sheet.trace(side);
                name.push_back(sheet.chart);
                found.push_back({sheet, side, is_last, holder, std::move(name)});
            }
    };
    for (const Index k : encounter.parts)
        if (places.parts[k].is_curve) add(places.parts[k].sheet, {Holder::Of::part, k});
    for (const Index face : encounter.faces) add(places.on_faces().sheet(face), places.holder_of(face));
    return found;
}

// Find slides through vertices at irrational orientations at which several parts seem to meet.
void find_slides(const MeetingPlaces& places, std::vector<Poses>& found) {
    const FreeMotions motions = places.walker->motions();
    for (const Encounter& encounter : places.encounters()) {
        heed_stop();
        const auto curves = tails(places, encounter);
        for (const Tail& one : curves)
            for (const Tail& other : curves) {
                if (&one == &other || one.holder == other.holder || one.name != other.name) continue;
                for (const unsigned nearer : halvings) {
                    heed_stop();
                    const RationalPose from = one.pose(nearer), to = other.pose(nearer);
                    if (!motions.along_curve(from, to, one.sheet, one.side)) continue;
                    found.push_back({from, to});
                    break;
                }
            }
    }
}

// Find turns about a place within critical angles along which cells or surfaces with slits touch.
void find_turns(const BoundaryWalker& walker, std::vector<Poses>& found) {
    const CellComplex& cells = *walker.cells;
    const auto end = [&](Index h) {
        return BoundaryWalker::EndOfFace{cells.face[h], static_cast<Side>(cells.side[h]) == Side::last};
    };
    for (const auto& coedges : pinched(cells)) {
        const auto side = static_cast<Side>(cells.side[coedges[0]]);
        if (side == Side::lower || side == Side::upper) continue;
        for (auto h = coedges.begin(); h != coedges.end(); ++h)
            for (auto k = h + 1; k != coedges.end(); ++k)
                if (walker.cell_at(cells.face[*h]) != walker.cell_at(cells.face[*k]))
                    if (auto way = walker.turn(end(*h), end(*k), most_turns)) found.push_back(std::move(*way));
    }
}

}  // namespace

std::vector<Poses> irrational_ways(const MeetingPlaces& places) {
    std::vector<Poses> found;
    find_slides(places, found);
    find_turns(*places.walker, found);
    if (places.slits) find_turns(*places.slits, found);
    return found;
}

}  // namespace cfree
