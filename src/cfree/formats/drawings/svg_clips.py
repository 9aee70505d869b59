"""Clips of SVG: viewports, clip paths and masks. Convex ones are applied to convex straight shapes, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from cfree.curves.drawn import Line, Ring, straight, turn
from cfree.curves.hulls import box_of
from cfree.exact.number import ExactPoint
from cfree.formats.drawings.svg_paths import start_of

Effect = Literal["none", "all", "cut", "unknown"]
_NOISE = 1e-12  # of doubles that curves have, per size of the drawing


@dataclass(frozen=True, slots=True)
class Clip:
    """A clip of an element and of all below it.

    Attributes
    ----------
    what : str
        "viewport", "clip-path" or "mask".
    corners : tuple of points
        Corners of the convex region that stays, counter-clockwise; empty if the region is another one.
    """

    what: str
    corners: tuple[ExactPoint, ...] = ()

    def applied(self, rings: Sequence[Ring], closed: bool = True) -> tuple[Effect, list[Ring]]:
        """Return what the clip leaves of rings: all, nothing, a part; or all rings because it cannot be applied.

        Curves that are not closed stay whole if they are not inside.

        Examples
        --------
        >>> from cfree.curves.drawn import polyline
        >>> square = polyline([(0, 0), (2, 0), (2, 2), (0, 2)])
        >>> effect, (ring,) = Clip("viewport", ((1, 1), (5, 1), (5, 5), (1, 5))).applied([square])
        >>> effect, [str(x + y) for x, y in sorted(line.start for line in ring)]
        ('cut', ['2', '3', '3', '4'])
        """
        whole = [*rings]
        if not self.corners:
            return "unknown", whole
        if self._contains(whole):
            return "none", whole
        if self._misses(whole):
            return "all", []
        if not closed or len(whole) != 1 or not straight(whole[0]):
            return "unknown", whole
        points = convex([segment.start for segment in whole[0] if isinstance(segment, Line)])
        if not points:
            return "unknown", whole
        for k, corner in enumerate(self.corners):
            points = _half(points, corner, self.corners[(k + 1) % len(self.corners)])
        ring: Ring = [Line(a, b) for a, b in zip(points, [*points[1:], *points[:1]], strict=True) if a != b]
        return ("cut", [ring]) if len(ring) > 2 else ("all", [])

    def _contains(self, rings: list[Ring]) -> bool:
        """True if all corners of rings are inside, or the box of curved ones by more than rounding."""
        sides = [*zip(self.corners, [*self.corners[1:], *self.corners[:1]], strict=True)]
        points = [
            p for ring in rings for segment in ring if isinstance(segment, Line) for p in (segment.start, segment.end)
        ]
        noise = 0.0
        if not all(map(straight, rings)):
            x0, y0, x1, y1 = box_of(rings)
            points = [(Fraction(x), Fraction(y)) for x in (x0, x1) for y in (y0, y1)]
            longest = max(float(abs(b[0] - a[0]) + abs(b[1] - a[1])) for a, b in sides)
            noise = _NOISE * longest * max(map(abs, (x0, y0, x1, y1)))
        return all(bool(turn(a, b, p) >= -noise) for p in points for a, b in sides)

    def _misses(self, rings: list[Ring]) -> bool:
        """True if the boxes are apart by more than rounding."""
        x0, y0, x1, y1 = box_of(rings)
        xs, ys = zip(*((float(x), float(y)) for x, y in self.corners), strict=True)
        noise = _NOISE * max(map(abs, (x0, y0, x1, y1, *xs, *ys)))
        return bool(x1 < min(xs) - noise or x0 > max(xs) + noise or y1 < min(ys) - noise or y0 > max(ys) + noise)


def convex(points: Sequence[ExactPoint]) -> tuple[ExactPoint, ...]:
    """Return the corners of a convex polygon counter-clockwise; nothing if it is not convex.

    Examples
    --------
    >>> convex([(0, 0), (0, 2), (2, 2), (2, 0)]), convex([(0, 0), (4, 0), (1, 1), (0, 4)])
    (((2, 0), (2, 2), (0, 2), (0, 0)), ())
    """
    corners = list(points)
    turns = [turn(corners[k - 2], corners[k - 1], corners[k]) for k in range(len(corners))]
    if len(corners) < 3 or not any(turns):
        return ()
    if all(value <= 0 for value in turns):
        corners.reverse()
    elif not all(value >= 0 for value in turns):
        return ()
    rising = [a < b for a, b in zip(corners, [*corners[1:], *corners[:1]], strict=True)]
    changes = sum(rising[k - 1] != rising[k] for k in range(len(rising)))
    return tuple(corners) if changes == 2 else ()  # else it winds more than once


def corners_of(rings: Sequence[Ring]) -> tuple[ExactPoint, ...]:
    """Return the corners of the region of rings if it is convex and straight, else nothing."""
    if len(rings) != 1 or not straight(rings[0]):
        return ()
    return convex([segment.start for segment in rings[0] if isinstance(segment, Line)] or [start_of(rings[0])])


def _half(points: Sequence[ExactPoint], a: ExactPoint, b: ExactPoint) -> tuple[ExactPoint, ...]:
    """Return the part of a convex polygon to the left of a line."""
    left: list[ExactPoint] = []
    for k, p in enumerate(points):
        before = points[k - 1]
        s, t = turn(a, b, before), turn(a, b, p)
        if s * t < 0:
            share = Fraction(s) / (s - t)
            left.append((before[0] + share * (p[0] - before[0]), before[1] + share * (p[1] - before[1])))
        if t >= 0:
            left.append(p)
    return tuple(left)
