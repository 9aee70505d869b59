// Arcs along which the robot can slide at one orientation only: there a concave arc's circle, free inside, is that of two convex
// features, free outside. Theory, "Exact fits".
#pragma once
#include "cfree/forbidden/columns.hpp"
#include "forbidden/open_covers.hpp"

namespace cfree {

// A quadrant of a concave arc's circle in one chart, the cones of its two vertices (first and last edge), and what may cover it.
struct HollowQuadrant {
    Surface on;
    std::vector<std::array<Feature, 2>> cones;
    const std::vector<OpenCover>& near;
};

// Add the free parts of a patch that is a quadrant at the angles at which it is on a circle, as parts without width.
void add_sliding_arcs(const Scene& scene, const HollowQuadrant& quadrant, const Feature& circle, Index patch, std::vector<Trapezoid>& out);

// Pairs of convex vertices whose circle may be that of a concave arc's pair at one angle, near enough to that.
std::vector<Feature> opposite_circles(const Scene& scene, const Feature& pair, double reach);

// True if the outward normal at a place, from it to the circle's centre, is in all cones.
bool has_normal(RoundJunction& at, const std::vector<std::array<Feature, 2>>& cones, const Feature& pair, const RoundSpot& p);

}  // namespace cfree
