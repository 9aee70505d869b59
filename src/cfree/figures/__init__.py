"""The paper's figures 1 to 10 drawn from computed data, in coordinates of our own, and thirteen more.

Indices count from 1 in the figures, as in the paper. `draw_all` writes them, as ``cfree figures`` does. The other
functions draw a part of one on given axes.
"""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.figures.arcs import arc_curvature as arc_curvature
    from cfree.figures.arcs import arc_curvature_around as arc_curvature_around
    from cfree.figures.arcs import disc_among_polygons as disc_among_polygons
    from cfree.figures.arcs import disc_pillars as disc_pillars
    from cfree.figures.arcs import rounded_pillar as rounded_pillar
    from cfree.figures.arcs import rounded_workspace as rounded_workspace
    from cfree.figures.curvature import curvature_along as curvature_along
    from cfree.figures.curvature import directions as directions
    from cfree.figures.curvature import gaussian_curvature as gaussian_curvature
    from cfree.figures.curvature import indicatrix as indicatrix
    from cfree.figures.curvature_sum import gauss_and_bonnet as gauss_and_bonnet
    from cfree.figures.curves import edge_edge as edge_edge
    from cfree.figures.curves import vertex_vertex as vertex_vertex
    from cfree.figures.depth import depth_in_a_slice as depth_in_a_slice
    from cfree.figures.depth import three_obstacles as three_obstacles
    from cfree.figures.gallery import FIGURES as FIGURES
    from cfree.figures.gallery import draw as draw
    from cfree.figures.gallery import draw_all as draw_all
    from cfree.figures.helices import helices_through_a_pose as helices_through_a_pose
    from cfree.figures.helices import turns_about_points as turns_about_points
    from cfree.figures.lines import asymptotic_lines as asymptotic_lines
    from cfree.figures.lines import lines_of_curvature as lines_of_curvature
    from cfree.figures.minimal import edge_beside as edge_beside
    from cfree.figures.minimal import edge_through as edge_through
    from cfree.figures.minimal import generic as generic
    from cfree.figures.minimal import helicoid as helicoid
    from cfree.figures.pillars import congruent_kite as congruent_kite
    from cfree.figures.pillars import congruent_squares as congruent_squares
    from cfree.figures.pillars import kite_and_square as kite_and_square
    from cfree.figures.pillars import pillar as pillar
    from cfree.figures.pillars import pillar_from_behind as pillar_from_behind
    from cfree.figures.pillars import pillar_workspace as pillar_workspace
    from cfree.figures.pillars import squares as squares
    from cfree.figures.poses import contacts as contacts
    from cfree.figures.poses import rest_and_moved as rest_and_moved
    from cfree.figures.ranges import edge_vertex_range as edge_vertex_range
    from cfree.figures.ranges import vertex_edge_range as vertex_edge_range
    from cfree.figures.rounded import disc_boundary as disc_boundary
    from cfree.figures.rounded import rounded_triangles as rounded_triangles
    from cfree.figures.rounded import shapes_in_the_plane as shapes_in_the_plane
    from cfree.figures.scenes import five_obstacles as five_obstacles
    from cfree.figures.scenes import five_pillars as five_pillars
    from cfree.figures.scenes import slice_source as slice_source
    from cfree.figures.scenes import slice_stack as slice_stack
    from cfree.figures.surfaces import edge_vertex_surface as edge_vertex_surface
    from cfree.figures.surfaces import vertex_edge_surface as vertex_edge_surface
    from cfree.figures.unrolled import patch_in_space as patch_in_space
    from cfree.figures.unrolled import patch_unrolled as patch_unrolled

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "gallery": "FIGURES draw draw_all",
        "arcs": "arc_curvature arc_curvature_around disc_among_polygons disc_pillars rounded_pillar rounded_workspace",
        "curvature": "directions indicatrix gaussian_curvature curvature_along",
        "curvature_sum": "gauss_and_bonnet",
        "curves": "vertex_vertex edge_edge",
        "depth": "three_obstacles depth_in_a_slice",
        "helices": "turns_about_points helices_through_a_pose",
        "lines": "lines_of_curvature asymptotic_lines",
        "minimal": "edge_through edge_beside helicoid generic",
        "pillars": "pillar pillar_workspace pillar_from_behind squares "
        "kite_and_square congruent_squares congruent_kite",
        "poses": "rest_and_moved contacts",
        "ranges": "vertex_edge_range edge_vertex_range",
        "rounded": "shapes_in_the_plane rounded_triangles disc_boundary",
        "scenes": "five_obstacles five_pillars slice_stack slice_source",
        "surfaces": "vertex_edge_surface edge_vertex_surface",
        "unrolled": "patch_in_space patch_unrolled",
    },
)
