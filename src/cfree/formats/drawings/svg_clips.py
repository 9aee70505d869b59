"""Clips of SVG: viewports and clip paths are applied exactly, masks are not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from cfree.curves.drawn import Line, Ring, polyline, straight, turn
from cfree.curves.hulls import Outline, box_of
from cfree.exact.number import ExactPoint
from cfree.formats.drawings.regions import clipped, filled_outlines
from cfree.formats.drawings.source import Source

Effect = Literal["none", "all", "cut", "unknown"]
_NOISE = 1e-12  # of doubles that curves have, per size of the drawing


@dataclass(frozen=True, slots=True)
class Clip:
    """A clip of an element and of all below it.

    Attributes
    ----------
    what : str
        "viewport", "clip-path" or "mask".
    region : tuple of Outline, optional
        The union of these outlines stays; None if it is not known.
    """

    what: str
    region: tuple[Outline, ...] | None = None

    def effect(self, rings: Sequence[Ring]) -> Effect:
        """Return "none" if all of the rings is inside, "all" if nothing is, "cut" if neither is certain.

        Examples
        --------
        >>> def box(x, y, size):
        ...     return polyline([(x, y), (x + size, y), (x + size, y + size), (x, y + size)])
        >>> clip = Clip("viewport", (Outline(box(0, 0, 5)),))
        >>> [clip.effect([box(x, 1, 2)]) for x in (1, 4, 8)], Clip("mask").effect([box(0, 0, 1)])
        (['none', 'cut', 'all'], 'unknown')
        """
        if self.region is None:
            return "unknown"
        if not self.region or self._misses(rings):
            return "all"
        corners = _corners(self.region)
        return "none" if corners and _contains(corners, rings) else "cut"

    def _misses(self, rings: Sequence[Ring]) -> bool:
        """True if the boxes are apart by more than rounding."""
        x0, y0, x1, y1 = box_of(rings)
        left, low, right, high = box_of([outline.outer for outline in self.region or ()])
        noise = _NOISE * max(map(abs, (x0, y0, x1, y1, left, low, right, high)))
        return bool(x1 < left - noise or x0 > right + noise or y1 < low - noise or y0 > high + noise)

    def cut(self, source: Source, rings: Sequence[Ring], even_odd: bool) -> list[Ring]:
        """Return the rings of the part inside of the region, to be filled by the even-odd rule.

        Examples
        --------
        >>> square = [polyline([(0, 0), (2, 0), (2, 2), (0, 2)])]
        >>> clip = Clip("viewport", (Outline(polyline([(1, 1), (5, 1), (5, 5), (1, 5)])),))
        >>> (ring,) = clip.cut(Source("a.svg"), square, True)
        >>> [str(x + y) for x, y in sorted(line.start for line in ring)]
        ['2', '3', '3', '4']
        """
        outlines = filled_outlines(source, rings, even_odd)
        return [ring for outline in clipped(source, outlines, self.region or ()) for ring in outline.rings]


def convex_clip(what: str, corners: Sequence[ExactPoint]) -> Clip:
    """Return the clip of a convex polygon."""
    return Clip(what, (Outline(polyline(list(corners))),))


def _corners(region: Sequence[Outline]) -> tuple[ExactPoint, ...]:
    """Return the corners of a region counter-clockwise, if it is a convex quadrilateral or triangle, else nothing."""
    if len(region) != 1 or region[0].holes or len(region[0].outer) > 4 or not straight(region[0].outer):
        return ()
    corners = [segment.start for segment in region[0].outer if isinstance(segment, Line)]
    turns = [turn(corners[k - 2], corners[k - 1], corners[k]) for k in range(len(corners))]
    if all(value < 0 for value in turns):
        return tuple(corners[::-1])
    return tuple(corners) if all(value > 0 for value in turns) else ()


def _contains(corners: Sequence[ExactPoint], rings: Sequence[Ring]) -> bool:
    """True if all corners of rings are inside of a convex polygon; of curved ones their box, up to rounding."""
    sides = [*zip(corners, [*corners[1:], *corners[:1]], strict=True)]
    lines = [segment for ring in rings for segment in ring if isinstance(segment, Line)]
    points = [p for line in lines for p in (line.start, line.end)]
    noise = 0.0
    if not all(map(straight, rings)):
        x0, y0, x1, y1 = box_of(rings)
        points = [(Fraction(x), Fraction(y)) for x in (x0, x1) for y in (y0, y1)]
        longest = max(float(abs(b[0] - a[0]) + abs(b[1] - a[1])) for a, b in sides)
        noise = _NOISE * longest * max(map(abs, (x0, y0, x1, y1)))
    return all(bool(turn(a, b, p) >= -noise) for p in points for a, b in sides)
