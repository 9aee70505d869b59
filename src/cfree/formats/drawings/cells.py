"""Turn the cells of a map into shapes: obstacles traced along the sides of cells, and the map's edge as workspace."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from cfree.exact.pose import Pose
from cfree.formats.drawings.grid import Mask, outlines, specks
from cfree.formats.drawings.source import Source
from cfree.formats.shapes import Shape
from cfree.polygons.polygon import Polygon

States = NDArray[np.int8]
KEPT_POLYGONS, KEPT_VERTICES = 1024, 1024  # number of polygons that are kept, and the most vertices of one
UNKNOWN, FREE, OCCUPIED, BETWEEN = -1, 0, 1, 2
"""States of cells; those in between free and occupied are obstacles."""


class Place:
    """The place of a grid in the world: the side of its cells, and the pose of its lower left corner."""

    def __init__(self, resolution: Fraction | int, origin: Pose) -> None:
        self.resolution, self.origin = resolution, origin

    def ring(self, ring: list[tuple[int, int]]) -> list[Any]:
        """Return the exact points of corners of cells, as (column, row)."""
        return list(self.origin.apply_exact([(x * self.resolution, y * self.resolution) for x, y in ring]))

    def polygon(self, rings: list[list[tuple[int, int]]]) -> Polygon:
        """Return the polygon of some rings, the outer one first."""
        traced = _polygon_before if sum(map(len, rings)) <= KEPT_VERTICES else _polygon
        return traced(self.resolution, self.origin, tuple(map(tuple, rings)))

    def middle(self, row: int, column: int) -> tuple[float, float]:
        """Return the middle of a cell."""
        half = Fraction(self.resolution) / 2
        ((x, y),) = self.origin.apply_exact([((2 * column + 1) * half, (2 * row + 1) * half)])
        return float(x), float(y)


def _polygon(resolution: Fraction | int, origin: Pose, rings: tuple[tuple[tuple[int, int], ...], ...]) -> Polygon:
    place = Place(resolution, origin)
    outer, *holes = (place.ring(list(ring)) for ring in rings)
    return Polygon(outer, holes)


_polygon_before = lru_cache(KEPT_POLYGONS)(_polygon)  # a map that changes keeps most of its polygons


def cell_shapes(
    source: Source, states: States, resolution: Fraction | int, origin: Pose, edge: Literal["always", "unknown"]
) -> list[Shape]:
    """Return the shapes of cells, and note the meaning of unknown ones.

    Parameters
    ----------
    source : Source
    states : (rows, columns) array of int
        The first row is the lowest.
    resolution : Fraction or int
        Side of a cell.
    origin : Pose
        Pose of the lower left corner.
    edge : "always" or "unknown"
        The map's edge is the workspace, always or if unknown cells are obstacles.
    """
    place, unknown_forbids = Place(resolution, origin), source.reading.unknown == "obstacle"
    rows, columns = states.shape
    if origin.theta_error:
        off = origin.theta_error * float(resolution) * (rows + columns)
        source.note("near", "cell of a turned map", "near", count=rows * columns, size=off)
    if source.reading.despeckle:
        states = _despeckled(source, states, place)
    marked: Mask = states > 0
    if unknown := int((states == UNKNOWN).sum()):
        if unknown_forbids:
            marked |= states == UNKNOWN
            source.note("info", "unknown cell: forbidden", "more", count=unknown, remedy="--unknown free")
        else:
            source.note("assumption", "unknown cell: free", "less", count=unknown, remedy="--unknown obstacle")
    shapes = [Shape("obstacle", None, place.polygon(rings)) for rings in outlines(marked, source.spend)]
    if not shapes:
        source.note("info", "map without an obstacle", where=source.findings.file)
    if edge == "always" or unknown_forbids:
        corners = place.ring([(0, 0), (columns, 0), (columns, rows), (0, rows)])
        shapes.append(Shape("workspace", None, Polygon(corners)))
        source.note("info", "map's edge as the workspace", "more")
    return shapes


def _despeckled(source: Source, states: States, place: Place) -> States:
    """Return the states with small parts of occupied cells freed; note each."""
    states = states.copy()
    area = place.resolution**2
    for cells, size in specks(states == OCCUPIED, states == FREE, source.reading.despeckle, source.spend):
        states[cells] = FREE
        middle = place.middle(int(cells[0][size // 2]), int(cells[1][size // 2]))
        where = f"fewer than {source.reading.despeckle} cells"
        remedy = "--despeckle 0"
        source.note("assumption", "speck", "less", where=where, at=middle, size=float(size * area), remedy=remedy)
        source.note("assumption", "occupied cell in a speck", "less", count=size, remedy=remedy)
    return states
