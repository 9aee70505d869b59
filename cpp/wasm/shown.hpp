// Values that a page draws: the scene, the boundary's mesh, slices, contacts.
#pragma once
#include "reply.hpp"
#include "world.hpp"

namespace cfree {

void show_scene(const World& world, Reply& reply);
// The robot's outlines, grown by the clearance.
void show_robot(const Rounds& rounds, const std::string& prefix, Reply& reply);
void show_counts(const World& world, Reply& reply);
// All columns of boundary and cells, as they are.
void show_columns(World& world, Reply& reply);
// Mesh of one error, or a larger one with about `most` triangles. Vertices are those of single patches, with normals of these.
void show_mesh(const World& world, double error, double most, Reply& reply);
// A closed surface of a scene, angles as heights times a length.
void show_surface(const SceneFeatures& features, const CellComplex& cells, double length, Reply& reply);
void show_slice(const World& world, double theta, Reply& reply);
// The contact of a trapezoid at a place on it.
void show_contact(const World& world, Index trapezoid, const Place& at, Reply& reply);
// Size of a cell; is it bounded, by obstacles alone; can the robot turn round in it.
void show_cell(World& world, Index cell, Reply& reply);

// Names of features in the user's polygons, or cores: robot part and vertex, obstacle and vertex. -1: bounds, -2: workspace. A
// kind is 0 for v-e, 1 for e-v, 2 for two arcs, or an arc and a vertex.
struct Named {
    std::vector<std::uint8_t> kind;
    std::vector<Index> robot_part, robot_vertex, obstacle, obstacle_vertex;
    std::vector<double> robot_xy, obstacle_xy;  // each feature's first point and its last, the robot at rest; a disc's center
    std::vector<double> robot_radius, obstacle_radius;  // above 0: a vertex stands for an arc
    void add(const World& world, const Feature& contact);
    void put(const std::string& prefix, Reply& reply) const;
};

}  // namespace cfree
