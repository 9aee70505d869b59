// Arrangement of all contact surfaces: vertices, edges, faces and cells, with their incidence.
//
// Trapezoids of one patch that meet across a curve or an angle without any other surface are one face, and so on. Every face
// has two sides, the free one (outer) and the forbidden one (inner) of its pair; closed surfaces of sides bound a cell.
#pragma once
#include "cfree/arrangement/sheets.hpp"
#include "cfree/free/cell_facts.hpp"

namespace cfree {

enum class ArrangementEdge : std::uint8_t { helix, crossing, segment };      // vertex-vertex contact; two surfaces; edge-edge
enum class ArrangementVertex : std::uint8_t { triple, helix_crossing, end };  // three crossings; a helix meets a surface; a segment ends

struct Arrangement {
    Sheets sheets;
    std::vector<Index> face_of;    // each trapezoid's face
    std::vector<Index> component;  // each trapezoid's component connected by edges
    std::vector<Index> surface;    // closed surface of its outer and its inner side
    // faces
    std::vector<Index> face_first;              // one of its trapezoids
    std::vector<Index> face_outer, face_inner;  // cells
    std::vector<Index> face_euler;
    // edges, each with the faces around it, once for every time they meet it
    std::vector<std::uint8_t> edge_kind;
    std::vector<Index> edge_vertices;  // two each; -1 if it is closed
    std::vector<Index> edge_start{0}, edge_face;
    // vertices
    std::vector<std::uint8_t> vertex_kind;
    std::vector<Index> vertex_degree, vertex_pairs;  // number of edges that end there; of pairs whose boundaries meet there
    std::vector<double> xy, theta;                   // in the user's units, from `Scene::frame`
    // cells; 0 is the unbounded one
    std::vector<Index> cell_set, cell_euler, cell_surfaces;
    std::shared_ptr<const PointLocation> points;

    Volumes volumes() const;  // infinite for the first
    // Location of a pose: its cell and no trapezoids, or -1 and the trapezoids that contain it.
    struct Place {
        Index cell;
        std::vector<Index> on;
    };
    Place locate(const ExactPose& pose) const;
};

// Throws std::length_error if there are more vertices than `most_vertices`, std::domain_error if surfaces meet in an
// undecided way.
std::shared_ptr<const Arrangement> arrange(Sheets&& sheets, int threads, std::int64_t most_vertices);

}  // namespace cfree
