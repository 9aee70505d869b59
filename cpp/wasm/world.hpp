// One scene and what has been computed of it.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <variant>

#include "cfree/forbidden/slice.hpp"
#include "cfree/free/free_space.hpp"
#include "cfree/planning/contact_slide.hpp"
#include "cfree/planning/driving.hpp"
#include "cfree/planning/planner.hpp"
#include "cfree/scene/features.hpp"
#include "round_cells.hpp"
#include "rounds.hpp"

namespace cfree {

class World {
public:
    explicit World(SceneShapes given);
    // Rounded shapes and polygons around others, for the eye, or polygons inside of shapes: then the shapes themselves decide.
    World(std::shared_ptr<const Rounds> given, NearShapes shapes, bool is_drawn);
    // Compute the boundary, and with it slices; patches that are those of another boundary are taken from it.
    void trim(const std::function<void(double)>& share, const SharedBoundary& reuse);
    // Compute closed surfaces and cells of the boundary.
    void compute_cells(const std::function<void(double)>& share);

    const SceneShapes shapes;
    const std::shared_ptr<const Rounds> rounds;  // null without round shapes
    const std::optional<NearShapes> near;        // the cores or polygons in place of these
    const std::shared_ptr<KnownScene> known;
    const SceneFeatures& features;
    const std::shared_ptr<const Scene> scene;
    const std::shared_ptr<const MotionChecker> checker;
    const double radius;  // the robot's, about its reference point

    SharedBoundary boundary;
    std::shared_ptr<const CellComplex> cells;
    std::shared_ptr<const FreeSpace> space;
    std::unique_ptr<const Slicer> slicer;
    std::unique_ptr<Planner> planner;
    struct Answer {
        RationalPose start, goal;
        std::variant<Poses, Separation> found;
        std::vector<ContactSlide> slides;
        std::optional<GivenVehicle> vehicle;  // that drives the path
    };
    std::optional<Answer> answer;  // the last one
    std::optional<NearShapes> proved;  // the polygons of the last proof among round shapes, or smaller rounded shapes
    std::unique_ptr<const RoundCells> by_cells;  // among rounded shapes, once they are needed
    std::vector<double> volumes;  // volumes of cells, once they are needed
    std::optional<Turns> turns;   // the same

    void need_boundary() const;
    void need_space() const;
    const Turns& found_turns() {
        if (!turns) turns = turns_of(*cells);
        return *turns;
    }
    // False if there are polygons in place of round shapes.
    bool is_exact() const { return !near || near->inexact.empty(); }
    // The user's number of an obstacle among the polygons of the last proof.
    Index obstacle(Index polygon) const { return near && polygon >= 0 ? (proved ? *proved : *near).obstacle_of[static_cast<std::size_t>(polygon)] : polygon; }
    // Distance of the robot from obstacles, about: 0 where it touches them; infinite without any.
    double clearance(const Place& at) const;
};

// The slide from one pose to another, and whether it is taken backwards.
std::pair<const ContactSlide*, bool> slide_between(const std::vector<ContactSlide>& slides, const RationalPose& a, const RationalPose& b);

}  // namespace cfree
