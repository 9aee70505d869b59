"""What figures 21 to 23 show of arcs is true: patches are contacts, their sides meet, colours are curvatures."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
import shapely

from arc_shapes import placed
from cfree import Curved, palette
from cfree.contact import ArcArcSurface, arc_contacts, arc_surface
from cfree.contact.arcs import Shape
from cfree.curves import Arc
from cfree.figures import arcs
from cfree.figures.surfaces import OTHER
from cfree.geometry import arc_geometry, parabolic_angles, zero_mean_angles
from drawn import axes, outlines

CONVEX = [(arcs.DISC, obstacle) for obstacle in arcs.AMONG] + [(arcs.ROUND, OTHER)]


def polygon(shape: Shape) -> shapely.Polygon:
    return shapely.Polygon(arcs.outline(shape))


@pytest.mark.slow
@pytest.mark.parametrize("k", range(4))
def test_every_drawn_point_of_a_patch_is_a_contact(k: int) -> None:
    robot, obstacle = CONVEX[k]
    a, o = polygon(robot), polygon(obstacle)
    for contact in arc_contacts(robot, obstacle):
        for grid in arcs.patch_grids(robot, obstacle, contact):
            assert grid[..., 2].min() > -1e-9 and grid[..., 2].max() < math.tau + 1e-9
            for pose in grid[::7, ::4].reshape(-1, 3):
                here = placed(a, pose)
                assert here.distance(o) < 2e-3 and here.intersection(o).area < 2e-3


@pytest.mark.slow
@pytest.mark.parametrize(("robot", "obstacle"), [*product(range(4), range(4))])
def test_drawn_patches_have_the_area_of_their_parallelograms(robot: int, obstacle: int) -> None:
    """No part is left out, also of arcs of more than half a turn and of whole circles."""
    key = Curved([(1, "-1/2"), (3, "-1/2"), (3, "1/2"), (1, "1/2"), Arc((1, "-1/2"), center=(0, 0))])
    shapes: list[Shape] = [key, arcs.ROUND, arcs.DISC, OTHER]
    x, weights = np.polynomial.legendre.leggauss(40)
    for contact in arc_contacts(shapes[robot], shapes[obstacle]):
        S = arc_surface(shapes[robot], shapes[obstacle], contact)
        if not isinstance(S, ArcArcSurface):
            continue
        drawn = 0.0
        for grid in arcs.patch_grids(shapes[robot], shapes[obstacle], contact):
            assert grid[..., 2].min() > -1e-9 and grid[..., 2].max() < math.tau + 1e-9
            one, other = grid[1:, 1:] - grid[:-1, :-1], grid[1:, :-1] - grid[:-1, 1:]
            drawn += float(np.linalg.norm(np.cross(one, other), axis=-1).sum()) / 2
        nu = S.robot.first + S.robot.width * (x + 1) / 2
        v = arc_geometry(S.circular, 0.0, math.pi - nu).v  # depends on psi - phi alone
        assert drawn == pytest.approx(float(v @ weights) / 2 * S.robot.width * S.obstacle.width, rel=0.02)


@pytest.mark.parametrize("k", range(4))
def test_drawn_segments_are_contacts_of_edges(k: int) -> None:
    robot, obstacle = CONVEX[k]
    a, o = polygon(robot), polygon(obstacle)
    drawn = list(arcs.segments(robot, obstacle))
    assert len(drawn) == (12 if robot is arcs.ROUND else 0)
    for start, stop in drawn:
        for share in (0.01, 0.5, 0.99):
            here = placed(a, start + share * (stop - start))
            assert here.distance(o) < 2e-3 and here.intersection(o).area < 2e-3
            overlap = shapely.intersection(here.buffer(1e-6), o.buffer(1e-6))
            assert share != 0.5 or overlap.length > 1  # edges along each other


def test_figure_21_has_the_contacts_of_its_caption() -> None:
    ax = axes(21)
    robots, obstacles = outlines(ax, palette.ROBOT), outlines(ax, palette.OBSTACLE)
    assert (len(robots), len(obstacles)) == (2, 3)
    for robot, (_, k, _) in zip(robots, arcs.TOUCHING, strict=True):
        distances = [shapely.Polygon(robot).distance(shapely.Polygon(obstacle)) for obstacle in obstacles]
        assert distances[k] < 2e-3 < 0.1 < min(distance for j, distance in enumerate(distances) if j != k)
    for contact, k, place in arcs.TOUCHING:
        point = shapely.Point(arcs.contact_point(contact, k, place))
        assert polygon(arcs.AMONG[k]).boundary.distance(point) < 1e-12
        assert min(shapely.Polygon(robot).boundary.distance(point) for robot in robots) < 2e-3


def test_pillars_of_figure_21_do_not_meet() -> None:
    grown = [polygon(obstacle).buffer(float(arcs.RADIUS)) for obstacle in arcs.AMONG]
    assert all(one.distance(other) > 0.1 for one, other in product(grown, grown) if one is not other)


def test_figure_23_has_both_signs_and_both_kinds_of_curves_on_its_patch() -> None:
    S = arcs.PAIR
    assert len(parabolic_angles(S)) == len(zero_mean_angles(S)) == 2
    nu = S.robot.first + S.robot.width * np.linspace(0, 1, 50)
    at = arc_geometry(S.circular, 0.0, math.pi - nu)
    assert at.gaussian_curvature.min() < 0 < at.gaussian_curvature.max() < arcs.MOST
    assert at.mean_curvature.min() < 0 < at.mean_curvature.max()
