// The arrangement of all contact surfaces: vertices, edges, faces and cells, with their incidence.
//
// Trapezoids of one patch that meet across a curve or an angle at which nothing happens are one face, and so on. Every face has
// two sides, the free one (outer) and the forbidden one (inner) of its pair; a cell is bounded by closed surfaces of sides.
#pragma once
#include "cfree/arrangement/sheets.hpp"
#include "cfree/free/cell_facts.hpp"

namespace cfree {

enum class ArrangementEdge : std::uint8_t { helix, crossing, segment };      // vertex-vertex contact; two surfaces; edge-edge
enum class ArrangementVertex : std::uint8_t { triple, helix_crossing, end };  // three crossings; a helix meets a surface; a segment ends

struct Arrangement {
    Sheets sheets;
    std::vector<Index> face_of;    // of each trapezoid
    std::vector<Index> component;  // of each trapezoid: what is connected by edges
    std::vector<Index> surface;    // of its outer and its inner side: the closed surface
    // faces
    std::vector<Index> face_first;              // one of its trapezoids
    std::vector<Index> face_outer, face_inner;  // cells
    std::vector<Index> face_euler;
    // edges, at each the faces around it, once for every time they meet it
    std::vector<std::uint8_t> edge_kind;
    std::vector<Index> edge_vertices;  // two each; -1 if it is closed
    std::vector<Index> edge_start{0}, edge_face;
    // vertices
    std::vector<std::uint8_t> vertex_kind;
    std::vector<Index> vertex_degree, vertex_pairs;  // edges that end there; pairs whose boundaries meet there
    std::vector<double> xy, theta;                   // in the user's units, from `Scene::frame`
    // cells; 0 is beyond everything
    std::vector<Index> cell_set, cell_euler, cell_surfaces;
    std::shared_ptr<const PointLocation> points;

    Volumes volumes() const;  // infinite for the first
    // What is at a pose: a cell and no trapezoids, or the trapezoids that it is on, and -1.
    struct Place {
        Index cell;
        std::vector<Index> on;
    };
    Place locate(const ExactPose& pose) const;
};

// Throws std::length_error if there are more than so many vertices, std::domain_error if surfaces meet in a way not decided.
std::shared_ptr<const Arrangement> arrange(Sheets&& sheets, int threads, std::int64_t most_vertices);

}  // namespace cfree
