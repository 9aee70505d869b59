"""No-fit polygons of two parts at all orientations: computed once, cut at any angle, with all angles of change."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from cfree.arguments import checked
from cfree.exact.angle_interval import AlgebraicAngle
from cfree.exact.half_angle import Angle, place_of
from cfree.exact.pose import Pose
from cfree.forbidden.boundary import Boundary, boundary
from cfree.forbidden.critical_angle import critical_angle
from cfree.forbidden.isolated import isolated_at
from cfree.forbidden.slice import Slice, outlines, regions
from cfree.libraries import Floats
from cfree.nesting.nofit import NFP, nfp
from cfree.nesting.rounded import RoundedFit
from cfree.scene.scene import AnyShape, Scene, shapes_in
from cfree.value import Value
from cfree.words import counted

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry
else:
    BaseGeometry = Any  # shapely is imported where it is used

BITS = 60  # of orientations beside an event


@dataclass(frozen=True)
class TopologyChange:
    """An angle at which the no-fit polygon changes its topology.

    Attributes
    ----------
    angle : AlgebraicAngle
        The exact orientation of the moving part.
    before, after : (int, int)
        Outer rings and holes just before and just after it, counter-clockwise.
    exact_fits : int
        Exact fits of no width that begin, end or exist at this angle.
    """

    angle: AlgebraicAngle
    before: tuple[int, int]
    after: tuple[int, int]
    exact_fits: int


class RotationalNFP(Value):
    """The no-fit polygons of a fixed and a moving part at all orientations of the moving one.

    Parameters
    ----------
    fixed, moving : shape or sequence of shapes
        As for `nfp`.

    Notes
    -----
    The contact surfaces are trimmed once, exactly; a slice then takes a few hundredths of a millisecond.

    Examples
    --------
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> slot = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (3, 2), (3, 3), (0, 3)]
    >>> turning = RotationalNFP(slot, square)
    >>> len(turning.slice("30deg").segments), turning.nfp("90deg").segments != ()
    (11, True)
    >>> [round(math.degrees(change.angle.theta)) for change in turning.topology_changes]
    [0, 90, 180, 270]
    """

    @checked
    def __init__(self, fixed: Any, moving: Any) -> None:
        self.fixed: tuple[AnyShape, ...] = tuple(shapes_in(fixed, "fixed"))
        self.moving: tuple[AnyShape, ...] = tuple(shapes_in(moving, "moving"))

    @property
    def _content(self) -> tuple[Any, ...]:
        return self.fixed, self.moving

    def __repr__(self) -> str:
        return f"<RotationalNFP of {counted(len(self.events), 'event')}>"

    @cached_property
    def boundary(self) -> Boundary:
        """The boundary of the forbidden space, computed at first use."""
        return boundary(Scene(self.moving, self.fixed), max_seconds=math.inf)

    @checked
    def slice(self, theta: Angle) -> Slice:
        """Return the contact segments at one orientation: exact topology, coordinates rounded.

        At an event it is the slice just after it, without exact fits of no width; `nfp` has them.
        """
        return self.boundary.slice(theta)

    @checked
    def polygons(self, angles: Sequence[Angle]) -> list[BaseGeometry]:
        """Return the no-fit polygons at many orientations as valid shapely geometries, rounded to doubles.

        Parameters
        ----------
        angles : sequence of Angle
            At an event the polygon is that just after it. Exact fits of no width are left out; `nfp` has them.

        Returns
        -------
        list of Polygon and MultiPolygon
            As ``[self.slice(theta).forbidden for theta in angles]``, in about half of the time.

        Examples
        --------
        >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
        >>> [round(region.area, 6) for region in RotationalNFP(square, square).polygons([0, "45deg"])]
        [4.0, 4.828427]
        """
        return regions(self.boundary, [place_of(theta)[1:] for theta in angles])

    @checked
    def nfp(self, theta: Angle) -> NFP | RoundedFit:
        """Return the exact no-fit polygon at one orientation; see `cfree.nesting.nfp`."""
        return nfp(self.fixed, self.moving, theta)

    @checked
    def exact_fits(self, theta: float) -> list[Floats]:
        """Return the exact fits of no width near an orientation: points (1, 2), segments (2, 2) and arcs (n, 2)."""
        return isolated_at(self.boundary, theta)

    @cached_property
    def events(self) -> tuple[AlgebraicAngle, ...]:
        """The exact angles in [0, 2 pi) at which edges of the no-fit polygon appear, vanish or change partners.

        Among them may be 90 and 270 degrees, and, where edges are arcs, angles at which an end of one is just above,
        below or beside its center. Exact fits of no width are those of `Boundary.isolated`.
        """
        named: dict[int, AlgebraicAngle] = {}
        faces, (first, last, _, whole) = len(self.boundary.trapezoids), self.boundary._handle.angle_ranks()
        for is_last, ranks in ((False, first), (True, last)):
            for k in np.unique(ranks, return_index=True)[1].tolist():
                rank = int(ranks[k])
                if rank not in named and rank != whole:
                    table, row = (self.boundary.trapezoids, k) if k < faces else (self.boundary.isolated, k - faces)
                    root = critical_angle(self.boundary, table, row, is_last)
                    named[rank] = AlgebraicAngle(int(table.chart[row]), root)
        return tuple(sorted(dict.fromkeys(named.values()), key=lambda angle: angle.theta))

    @cached_property
    def topology_changes(self) -> tuple[TopologyChange, ...]:
        """The events at which rings of the no-fit polygon appear, vanish, join or part, or exact fits begin or end."""
        return tuple(self._changes())

    def _changes(self) -> Iterator[TopologyChange]:
        events = self.events
        if not events:
            return
        sides = [angle.neighbours(BITS) for angle in events]
        between = [self._topology(start, end) for (_, start), (end, _) in pairwise(sides)]
        around = self._topology(sides[-1][1], sides[0][0])
        parts = self.boundary.isolated
        ends = np.concatenate([parts.theta_from, parts.theta_to]) % math.tau
        own = np.tile(np.arange(len(parts)), 2)
        for angle, before, after in zip(events, [around, *between], [*between, around], strict=True):
            near = np.abs((ends - angle.theta + 1) % math.tau - 1) < 1e-9
            fits = len(set(own[near].tolist()))
            if before != after or fits:
                yield TopologyChange(angle, before, after, fits)

    def _topology(self, start: Fraction | None, end: Fraction | None) -> tuple[int, int]:
        """Return the numbers of outer rings and holes at an orientation counter-clockwise between two others."""
        first, last = Pose(0, 0, {"tau": start}).theta, Pose(0, 0, {"tau": end}).theta
        middle = first + (last - first) % math.tau / 2
        _, _, shell, _ = outlines(self.boundary, [place_of(middle)[1:]])
        outer = sum(k == around for k, around in enumerate(shell.tolist()))
        return outer, len(shell) - outer
