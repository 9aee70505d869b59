"""Slices: the forbidden positions of the reference point at one orientation, read from a boundary."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from cfree.exact.half_angle import Angle, place_of
from cfree.forbidden.kinds import PatchKind
from cfree.forbidden.record import BoundaryRecord
from cfree.libraries import Floats, NDArray, np
from cfree.value import Shown, Value
from cfree.words import counted

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry
else:
    BaseGeometry = Any  # shapely is imported where it is used

CHORD = 0.02
"""Greatest angle of a chord of an arc, in radians; the core's is the same."""


class Slice(Value, Shown):
    """Contact segments at one orientation.

    Attributes
    ----------
    boundary : Boundary
    theta : float, radians
    segments : (k, 2, 2) float64
        Positions of the reference point in contact, from one end to the other; the forbidden side is on the left. On
        an arc-arc patch only the ends are on the boundary; see `lines`.
    patches, trapezoids : (k,) int32
        The patch and the trapezoid of each segment.
    """

    def __init__(self, boundary: BoundaryRecord, theta: Angle) -> None:
        self.theta, chart, tau = place_of(theta)
        self.boundary, self._asked = boundary, theta
        self._place = chart, tau
        self.segments: NDArray[np.float64]
        self.trapezoids: NDArray[np.int32]
        xy, self.trapezoids = boundary._slicer.segments(chart, tau)
        self.segments = xy.reshape(-1, 2, 2)

    @property
    def _content(self) -> tuple[Any, ...]:
        return self.boundary, self.theta, *self._place

    def __reduce__(self) -> tuple[Any, ...]:
        return Slice, (self.boundary, self._asked)

    @property
    def patches(self) -> NDArray[np.int32]:
        patches: NDArray[np.int32] = self.boundary.trapezoids.patch[self.trapezoids]
        return patches

    def __repr__(self) -> str:
        return f"Slice(theta={self.theta:.6g}, {counted(len(self.segments), 'segment')})"

    @cached_property
    def lines(self) -> list[NDArray[np.float64]]:
        """The contact segments as lines to draw, (n, 2) each; arcs have a point every `CHORD` radians or less."""
        boundary, patch = self.boundary, self.patches
        lines: list[NDArray[np.float64]] = list(self.segments)
        arcs = np.flatnonzero(boundary.patch_kind[patch] == PatchKind.ARC_ARC)
        for k, first, last in zip(arcs.tolist(), *self._angles(arcs), strict=True):
            psi = np.linspace(first, last, 2 + max(0, int((last - first) / CHORD)))  # of tiny circles rounded
            lines[k] = boundary.evaluate(np.full(len(psi), patch[k]), np.tan(psi / 2), np.full(len(psi), self.theta))
            lines[k][[0, -1]] = self.segments[k]
        return lines

    @property
    def lengths(self) -> NDArray[np.float64]:
        """Lengths of the contact segments, (k,); along the arc where they are arcs."""
        result: NDArray[np.float64] = np.hypot(*(self.segments[:, 1] - self.segments[:, 0]).T)
        arcs = np.flatnonzero(self.boundary.patch_kind[self.patches] == PatchKind.ARC_ARC)
        lower, upper = self._angles(arcs)
        result[arcs] = np.abs(self.boundary.patch_radius[self.patches[arcs]]) * (upper - lower)
        return result

    def _angles(self, arcs: NDArray[np.int64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Angles between which arcs extend, from the beginnings of their quadrants."""
        lower, upper = self.boundary.limits(self.trapezoids[arcs], np.full(len(arcs), self.theta))
        return 2 * np.arctan(lower), 2 * np.arctan(upper)

    @property
    def error(self) -> float:
        """Greatest distance of `forbidden` and `lines` from the arcs that they replace by chords; 0 among polygons.

        Examples
        --------
        >>> import cfree
        >>> discs = cfree.Scene(cfree.Curved.circle((0, 0), 1), [cfree.Curved.circle((3, 0), 1)])
        >>> cut = cfree.boundary(discs).slice(0)
        >>> 4 * math.pi - 1e-3 < cut.forbidden.area < 4 * math.pi, cut.error < 1e-3
        (True, True)
        """
        radius = float(np.abs(self.boundary.patch_radius[self.patches]).max(initial=0.0))
        return radius * (1 - math.cos(CHORD / 2))

    @cached_property
    def forbidden(self) -> BaseGeometry:
        """Forbidden positions of the reference point as a valid shapely polygon or multipolygon.

        With `bounds` or `workspace` the forbidden region is unbounded: it is cut off at ``features.rim``, a rectangle
        around everything.

        Notes
        -----
        The segments are chained by the names of their end points; coordinates are doubles. Thin free
        parts (a slot as wide as the robot) are missing. Arcs are replaced by chords from inside; see `error`.
        """
        return regions(self.boundary, [self._place])[0]


def regions(boundary: BoundaryRecord, places: Sequence[tuple[int, float]]) -> list[BaseGeometry]:
    """Return the forbidden positions at many orientations, charts and coordinates; see `Slice.forbidden`."""
    import shapely

    points, start, shell, first = outlines(boundary, places)
    rim = boundary.features.rim
    frame = None if rim is None else len(shell)
    order, part, number = list[int](), list[int](), [0]  # rings, the part of each, and parts so far
    shells = shell.tolist()
    for i, j in pairwise(first.tolist()):
        parts: dict[int, list[int]] = {} if frame is None else {frame: [frame]}
        for ring in range(i, j):
            around = shells[ring] if shells[ring] >= 0 else frame
            if around is not None:  # else no ring encloses it: a sliver of rounding
                holes = parts.setdefault(around, [around])
                if ring != around:
                    holes.append(ring)
        for k, rings in enumerate(parts.values()):
            order += rings
            part += [number[-1] + k] * len(rings)
        number.append(number[-1] + len(parts))
    if not order:
        return [shapely.MultiPolygon()] * len(places)
    made = shapely.linearrings(points, indices=np.repeat(np.arange(len(shell)), np.diff(start)))
    if rim is not None:
        made = np.append(made, shapely.box(*rim).exterior)
    polygons = shapely.polygons(made[order], indices=part)
    result = [polygons[i] if j == i + 1 else shapely.MultiPolygon(polygons[i:j]) for i, j in pairwise(number)]
    for k in np.flatnonzero(~shapely.is_valid(result)).tolist():
        result[k] = shapely.union_all(shapely.make_valid(polygons[number[k] : number[k + 1]]))
    return result


def outlines(
    boundary: BoundaryRecord, places: Sequence[tuple[int, float]]
) -> tuple[Floats, NDArray[np.int32], NDArray[np.int32], NDArray[np.int32]]:
    """Rings of the forbidden positions at many orientations, forbidden on the left.

    Returns
    -------
    points : (p, 2) float64
    start : (r + 1,) int32
        First point of each ring, and the end.
    shell : (r,) int32
        The ring around a hole, -1 if there is none; a part's own number.
    first : (n + 1,) int32
        First ring of each orientation, and the end.
    """
    charts, taus = np.array(places, np.float64).reshape(-1, 2).T
    xy, start, shell, first = boundary._slicer.rings(charts.astype(np.int32), np.ascontiguousarray(taus))
    return xy.reshape(-1, 2), start, shell, first
