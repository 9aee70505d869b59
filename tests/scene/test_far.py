"""Scenes far from the origin, and robots far from their reference points, are as near ones."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import numpy as np
import pytest

from cfree import FreeSpace, Path, Polygon, Pose, Scene, UnsupportedError, boundary, free_space, plan
from cfree.geometry.integrals import trapezoid_areas

OFFSETS = [(10**9, 3 * 10**9 + 1), (Fraction(10**9, 3), Fraction(-1, 7)), (2**40, -(2**41)), (2**70 + 1, 5)]
AWAY = [
    *((offset, (0, 0)) for offset in OFFSETS),
    *(((0, 0), point) for point in OFFSETS[:3]),
    ((10**9, 0), (7, 10**8)),
]


def room(offset: tuple[Fraction | int, ...], point: tuple[Fraction | int, ...]) -> Scene:
    """A room with a slot, and a robot that fits in it."""

    def ring(points: list[tuple[int, int]], by: tuple[Fraction | int, ...]) -> list[tuple[Fraction | int, ...]]:
        return [(x + by[0], y + by[1]) for x, y in points]

    walls = [(-6, -6), (6, -6), (6, 6), (-6, 6)]
    inside = [(-5, -5), (-5, 5), (-1, 5), (-1, 0), (1, 0), (1, 5), (5, 5), (5, -5)]
    robot = ring([(-1, -1), (1, -1), (1, 2), (-1, 2)], point)
    return Scene([robot], [Polygon(ring(walls, offset), [ring(inside, offset)])])


@cache
def space(offset: tuple[Fraction | int, ...], point: tuple[Fraction | int, ...]) -> FreeSpace:
    return free_space(boundary(room(offset, point), threads=1))


def near() -> FreeSpace:
    return space((0, 0), (0, 0))


@pytest.mark.parametrize(("offset", "point"), AWAY)
def test_volumes_areas_and_surfaces_do_not_depend_on_the_place(offset, point) -> None:
    here, far = near(), space(offset, point)
    assert [cell.volume for cell in far.cells] == pytest.approx([cell.volume for cell in here.cells], rel=1e-12)
    for name in ("patch", "chart", "lower", "upper"):
        assert np.array_equal(getattr(far.surfaces.trapezoids, name), getattr(here.surfaces.trapezoids, name))
    assert np.array_equal(far.complex.twin, here.complex.twin)
    if point == (0, 0):
        assert trapezoid_areas(far.boundary) == pytest.approx(trapezoid_areas(here.boundary), rel=1e-11)


@pytest.mark.parametrize(("offset", "point"), AWAY)
def test_slices_are_right_to_the_digits_that_doubles_have(offset, point) -> None:
    here, far = near().boundary, space(offset, point).boundary
    last = 4 * float(np.spacing(max(abs(float(v)) for v in (*offset, *point, 1))))
    for theta in (0.3, 2.0, 4.0):
        given, found = here.slice(theta).segments, far.slice(theta).segments
        c, s = np.cos(theta), np.sin(theta)
        (x, y), (a, b) = (tuple(map(float, v)) for v in (offset, point))
        by = np.array([x - (c * a - s * b), y - (s * a + c * b)])
        assert np.abs(found - (given + by)).max() <= last
        assert np.isclose(far.slice(theta).forbidden.area, here.slice(theta).forbidden.area, atol=100 * last)


@pytest.mark.parametrize("offset", [(10**9, 3 * 10**9 + 4), *OFFSETS[:3]])
def test_meshes_far_away_are_those_near_by(offset) -> None:
    here, far = near().boundary.mesh(0.05), space(offset, (0, 0)).boundary.mesh(0.05)
    assert len(here.triangles) == len(far.triangles)
    if all(v % 4 == 0 for v in offset):  # of the grid of origins: else doubles differ from those near by
        assert np.array_equal(far.vertices, here.vertices + np.array([*map(float, offset), 0]))
    with pytest.raises(UnsupportedError, match="no less than"):
        space(OFFSETS[3], (0, 0)).boundary.mesh(0.05)


@pytest.mark.slow
@pytest.mark.parametrize(("offset", "point"), AWAY)
def test_poses_are_located_and_paths_found_anywhere(offset, point) -> None:
    far, here = space(offset, point), near()

    def pose(x: int, y: int, turned: bool) -> Pose:
        a, b = (-point[1], point[0]) if turned else point
        return Pose(offset[0] + x - a, offset[1] + y - b, {"tau": 1 if turned else 0})

    for x, y, turned in ((0, -3, False), (0, -3, True), (3, 0, True), (0, 3, False), (100, 0, False)):
        expected = here.locate(Pose(x, y, {"tau": 1 if turned else 0}))
        assert far.locate(pose(x, y, turned)) == expected
    assert isinstance(plan(far.boundary.scene, pose(-3, 2, False), pose(3, 2, True), improve=0), Path)
