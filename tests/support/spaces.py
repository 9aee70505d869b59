"""Free spaces that several tests use."""

from __future__ import annotations

from fractions import Fraction

from cfree import FreeSpace, Pose, Scene, boundary, free_space
from compared import scene_of
from shapes import PlainScene, box


def space_of(plain: PlainScene) -> FreeSpace:
    return free_space(boundary(scene_of(plain), threads=1))


def hollow(
    outer: tuple[int, int, int, int], inner: tuple[int, int, int, int]
) -> tuple[list[tuple[int, int]], list[list[tuple[int, int]]]]:
    return box(*outer)[0], [box(*inner)[0][::-1]]


ROD = box(-3, -1, 3, 1)

TIGHT = hollow((-5, -3, 5, 3), (-4, -2, 4, 2))  # the rod turns a little, but not round


def room(opening: Fraction | int | str) -> FreeSpace:
    """Room of width 4 of a unit square, with an opening to the right, and its surroundings."""
    half = Fraction(opening) / 2
    wall = [(-3, -3), (3, -3), (3, -half), (2, -half), (2, -2), (-2, -2), (-2, 2), (2, 2), (2, half), (3, half)]
    return free_space(boundary(Scene(box("-1/2", "-1/2", "1/2", "1/2")[0], [[*wall, (3, 3), (-3, 3)]])))


INSIDE, OUTSIDE = Pose(0, 0), Pose(9, "1/3", "30deg")
