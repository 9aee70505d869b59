"""Boundaries where concave arcs face convex ones, against closed formulas, exact tests of poses and exchanged sides."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from arc_rings import BAY, BRACKET, DROP, HALF, HOOK, LENS, SECTOR, plate, shape
from cfree import Curved, Scene, boundary, free_space, load, save, verify
from cfree.curves import Arc
from cfree.geometry import gauss_bonnet
from cfree.verify.result import PROVED
from facing_arcs import FAMILIES, faults, scene, swapped

NEAR_ONE = 1 - Fraction(1, 2**60)
HALVED = Fraction(1, 2)
BLOCK = [(-9, -9), (9, -9), (9, 9), (-9, 9)]


def lens_area(radius: float, apart: float) -> float:
    """Area of the intersection of two discs of one radius."""
    half = apart / 2
    return 2 * radius**2 * math.acos(half / radius) - apart * math.sqrt(radius**2 - half**2)


def inner_volumes(made: Scene) -> list[float]:
    return [v for v in free_space(boundary(made)).volumes if v != math.inf]


@pytest.mark.parametrize("share", [Fraction(1, 5), Fraction(1, 2), Fraction(9, 10), Fraction(63, 64)])
@pytest.mark.parametrize("is_exchanged", [False, True])
def test_a_half_disc_in_a_round_hole_has_the_volume_of_the_closed_formula(share: Fraction, is_exchanged: bool) -> None:
    """Its corners stay in the hole; where it bulges away from the center, its center stays in a smaller disc."""
    made = Scene(shape(HALF, by=3 * share / 5), [plate()])
    if is_exchanged:
        made = Scene(made.obstacles, made.robot)
    r = 3 * float(share)
    area = math.pi * (3 - r) ** 2 / 2 + lens_area(3, 2 * r) / 2
    (volume,) = inner_volumes(made)
    assert math.isclose(volume, math.tau * area, rel_tol=1e-9)


@pytest.mark.parametrize("by", [Fraction(31, 50), Fraction(7, 10)])
def test_a_lens_of_larger_arcs_than_a_hole_is_in_it_where_its_tips_are(by: Fraction) -> None:
    assert 5 * by > 3
    (volume,) = inner_volumes(Scene(shape(LENS, by=by), [plate()]))
    assert math.isclose(volume, math.tau * lens_area(3, 8 * float(by)), rel_tol=1e-9)


@pytest.mark.parametrize("by", [Fraction(3, 5), Fraction(3, 5) / NEAR_ONE, 1])
def test_a_half_disc_as_large_as_a_hole_is_nowhere_inside(by: Fraction) -> None:
    """Equal radii are an exact fit without width."""
    assert inner_volumes(Scene(shape(HALF, by=by), [plate()])) == []


@pytest.mark.slow
def test_a_half_disc_smaller_than_a_hole_by_a_hair_is_inside() -> None:
    found = free_space(boundary(Scene(shape(HALF, by=3 * NEAR_ONE / 5), [plate()])))
    assert len(found) == 2 and found.locate((0, 0, 0)) != found.locate((20, 0, 0)) >= 0
    assert abs(found.volumes[1]) < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("seed", range(2))
def test_random_scenes_agree_with_exact_tests_of_poses_and_with_exchanged_sides(family: str, seed: int) -> None:
    assert list(faults(scene(family, seed), random.Random(seed))) == []


@pytest.mark.slow
def test_a_corner_of_another_obstacle_may_be_at_the_end_of_a_concave_arc() -> None:
    """A corner of the hook is at the lowest place of the hole, where the hole's arc is cut."""
    drop = shape(DROP, 0, -2, Fraction(1, 2))
    found = boundary(Scene(drop, [shape(HOOK, -2, 1, 2), plate(-2, 0)]))
    assert np.all(found.complex.euler % 2 == 0)


@pytest.mark.slow
def test_curvature_of_closed_surfaces_of_facing_arcs_adds_up() -> None:
    for made in (Scene(shape(HALF, by=Fraction(1, 2)), [shape(BAY)]), Scene([shape(HOOK)], [shape(DROP)])):
        found = boundary(made)
        sums = gauss_bonnet(found)
        assert np.all(abs(sums.euler - found.complex.euler) < 1e-6) and sums.gap < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize(
    "made",
    [
        Scene(shape(LENS, by=Fraction(1, 2)), [shape(BAY)]),
        Scene([shape(BRACKET)], [shape(HALF, by=Fraction(1, 2))]),
        Scene(shape(SECTOR, by=Fraction(1, 3)), [plate()]),
        Scene(Curved.circle((0, 0), 1), [plate(), Curved.circle((0, 0), 1)]),  # both walls everywhere
        scene("channels", 0),  # the disc is too large by 2^-60
        swapped(scene("tears", 11)),  # sides on lines through the origin
    ],
)
def test_verify_boundary_confirms_facing_arcs(made: Scene) -> None:
    result = verify.boundary(boundary(made), made, slices=4)
    assert result.verified, result
    assert {check.name: check.how for check in result.checks}["closed surfaces"] == PROVED


@pytest.mark.parametrize("place", [(0, 0), (1, 0)])
@pytest.mark.parametrize(("room", "cells"), [(0, 3), (Fraction(1, 2**60), 2), (-Fraction(1, 2**60), 3)])
def test_a_disc_in_a_channel_between_two_arcs_about_one_center(place: Any, room: Fraction, cells: int) -> None:
    """A half ring joins two rooms; a disc that fills it slides through, and cells are not joined by a slit."""
    bay = [(4, 0), Arc((-4, 0), center=(0, 0)), (-4, -5), (4, -5)]
    core = Curved([(3, 0), Arc((-3, 0), center=(0, 0)), (-3, -1), (-1, -1), (-1, -5), (1, -5), (1, -1), (3, -1)])
    found = boundary(Scene(Curved.circle(place, HALVED - room / 2), [Curved(BLOCK, [bay]), core]))
    space = free_space(found)
    assert len(space) == cells and np.all(found.complex.euler % 2 == 0)
    if not room:  # two rooms of 2 by 3, and what is beside the core's corners
        assert sorted(space.volumes)[:2] == pytest.approx([math.tau * (6.25 - math.pi / 16)] * 2, rel=1e-9)


@pytest.mark.parametrize("exchanged", [False, True])
@pytest.mark.parametrize(
    "ring",
    [
        [("25/3", 0), (3, 4), Arc((3, -4), center=(0, 0))],  # a drop
        [(0, -5), (5, -5), Arc((0, 0), center=(0, -5))],  # a quarter disc with its corner and its arc on the walls
    ],
)
def test_a_corridor_as_wide_as_an_arc_of_more_than_half_a_turn_parts_rooms(ring: Any, exchanged: bool) -> None:
    top = 0 if ring[0] == (0, -5) else 5
    walls = [[(-9, -30), (9, -30), (9, -5), (-9, -5)], [(-9, top), (9, top), (9, 30), (-9, 30)]]
    one, others = [Curved(ring)], [Curved(wall) for wall in walls]
    bounded = Scene(one, others, bounds=(-40, -19, 40, 19))
    for made in [Scene(others, one)] if exchanged else [Scene(one, others), bounded]:
        found = boundary(made)
        assert np.all(found.complex.euler % 2 == 0) and np.all(found.regularized.complex.euler % 2 == 0)
        assert len(free_space(found)) == (2 if made.bounds else 1)


@pytest.mark.slow
def test_files_and_meshes_have_facing_arcs(tmp_path: Path) -> None:
    """The mesh bounds the sums of the half disc and the plate's square, but for the half disc's room in the hole."""
    made = Scene(shape(HALF, by=Fraction(3, 10)), [plate()])
    found = boundary(made)
    save(found, tmp_path / "half.npz")
    assert load(tmp_path / "half.npz") == found
    mesh = found.mesh(0.05)
    x, y, z = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    normals = np.cross(y - x, z - x) / 2
    volume = ((x + y + z)[:, :2] / 3 * normals[:, :2]).sum() / 2 / mesh.angle_scale
    room = math.pi * 1.5**2 / 2 + lens_area(3, 3) / 2
    sums = math.tau * (100 + math.pi * 1.5**2 / 2) + 40 * (math.pi * 1.5 + 3)
    assert abs(volume - (sums - math.tau * room)) < 0.05 * np.hypot(*normals[:, :2].T).sum() / mesh.angle_scale
