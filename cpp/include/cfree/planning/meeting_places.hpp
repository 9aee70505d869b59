// MeetingPlaces where parts of the free space meet without width: cells and isolated parts, at rational orientations exactly.
//
// Doubles say where to look; what is there, and what holds it, is computed.
#pragma once
#include <compare>
#include <set>

#include "cfree/planning/boundary_walk.hpp"
#include "cfree/planning/thin_part.hpp"

namespace cfree {

class BoxTree;

inline constexpr double not_told_apart = 0x1p-30;  // of the scene's size, or in an angle: where to look, which decides nothing

// What may hold a pose: a cell, an isolated part, or a closed surface with slits of no width.
struct Holder {
    enum class Of { cell, part, surface } of;
    Index index;
    friend auto operator<=>(const Holder&, const Holder&) = default;
};

// Faces and isolated parts that doubles do not tell apart at some vertex.
struct Encounter {
    std::vector<Index> faces, parts;
    double theta;
};

class MeetingPlaces {
public:
    // Slits: the surfaces of the boundary with slits of no width, where bounds leave such.
    MeetingPlaces(std::shared_ptr<const BoundaryWalker> walker, std::shared_ptr<const CellComplex> slits);
    ~MeetingPlaces();
    MeetingPlaces(const MeetingPlaces&) = delete;
    MeetingPlaces& operator=(const MeetingPlaces&) = delete;

    // What holds a free pose: cells on whose boundary it is, or that it is in, and isolated parts.
    std::vector<Holder> holders(const RationalPose& pose) const;
    // Between two poses that a holder holds; nothing if none was found along an isolated part.
    std::optional<Poses> way(const RationalPose& start, const RationalPose& goal, const Holder& holder) const;
    // Poses that may be where two of them or more meet.
    Poses candidates() const;

    // At vertices that bound several cells, or are on faces of another, or near to ends of isolated parts.
    const std::vector<Encounter>& encounters() const { return met; }

    const std::shared_ptr<const BoundaryWalker> walker;
    const std::unique_ptr<const BoundaryWalker> slits;  // on surfaces with slits, each a cell of its own, or none
    const std::vector<ThinPart> parts;

private:
    std::vector<Encounter> find_encounters() const;
    std::vector<Index> faces_beside(Index vertex, const std::set<Index>& cells) const;
    static Poses corners(const BoundaryWalker& walker, Index face);
    void at_edges(const BoundaryWalker& walker, Poses& found) const;
    void at_part(const ThinPart& part, Poses& found) const;
    void on_surfaces(Poses& found) const;
    std::vector<Index> faces_near(const ThinPart& part) const;
    std::vector<Index> parts_near(const Box& box) const;

    const double size;  // the largest coordinate
    std::vector<Index> face_at, first_at;  // faces by vertex, and where each vertex's begin
    std::vector<Encounter> met;
    std::unique_ptr<const BoxTree> tree, vertices;  // of isolated parts, of vertices
};

}  // namespace cfree
