// Meeting places of parts of the free space without width: cells and isolated parts, at rational orientations exactly.
//
// Doubles propose candidates; poses and their holders are then computed exactly.
#pragma once
#include <compare>
#include <set>

#include "cfree/planning/boundary_walk.hpp"
#include "cfree/planning/thin_part.hpp"

namespace cfree {

class BoxTree;

inline constexpr double not_told_apart = 0x1p-30;  // per size of the scene, or as an angle; only for proposals

// Holder of poses: a cell, an isolated part, or a closed surface with slits of no width.
struct Holder {
    enum class Of { cell, part, surface } of;
    Index index;
    friend auto operator<=>(const Holder&, const Holder&) = default;
};

// Faces and isolated parts that doubles cannot distinguish at some vertex.
struct Encounter {
    std::vector<Index> faces, parts;
    double theta;
};

class MeetingPlaces {
public:
    // slits: the surfaces of the boundary with slits of no width, if bounds leave such.
    MeetingPlaces(std::shared_ptr<const BoundaryWalker> walker, std::shared_ptr<const CellComplex> slits);
    ~MeetingPlaces();
    MeetingPlaces(const MeetingPlaces&) = delete;
    MeetingPlaces& operator=(const MeetingPlaces&) = delete;

    // Holders of a free pose: cells whose closure contains it, and isolated parts.
    std::vector<Holder> holders(const RationalPose& pose) const;
    // Path between two poses of a holder; nothing if none is found along an isolated part.
    std::optional<Poses> way(const RationalPose& start, const RationalPose& goal, const Holder& holder) const;
    // Candidates for poses at which two or more holders meet.
    Poses candidates() const;

    // Encounters at vertices that bound several cells, or are on faces of another, or near ends of isolated parts. If there are
    // slits, surfaces take the place of cells: each face is on one.
    const std::vector<Encounter>& encounters() const { return met; }
    // Walker along the faces of encounters: on surfaces if there are slits, else on cells.
    const BoundaryWalker& on_faces() const { return slits ? *slits : *walker; }
    // Cell or surface with a face of an encounter.
    Holder holder_of(Index face) const { return {slits ? Holder::Of::surface : Holder::Of::cell, on_faces().cell_at(face)}; }

    const std::shared_ptr<const BoundaryWalker> walker;
    const std::unique_ptr<const BoundaryWalker> slits;  // walker on surfaces with slits, each a cell of its own, or null
    const std::vector<ThinPart> parts;

private:
    std::vector<Encounter> find_encounters() const;
    std::vector<Index> faces_beside(Index vertex, const std::set<Index>& cells) const;
    static Poses corners(const BoundaryWalker& walker, Index face);
    void at_edges(const BoundaryWalker& walker, Poses& found) const;
    void at_touches(const BoundaryWalker& walker, Poses& found) const;
    void at_part(const ThinPart& part, Poses& found) const;
    void on_surfaces(Poses& found) const;
    std::vector<Index> faces_near(const ThinPart& part) const;
    std::vector<Index> parts_near(const Box& box) const;

    const double size;  // the largest coordinate
    std::vector<Index> face_at, first_at;  // faces by vertex, and the start of each vertex's list
    std::vector<Encounter> met;
    std::unique_ptr<const BoxTree> tree, vertices;  // trees of isolated parts and of vertices
};

}  // namespace cfree
