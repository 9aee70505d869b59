"""Walls of unfilled lines: a curve of a width becomes convex polygons that contain its stroke.

A segment has one polygon around its rectangle, or around the trapezoid if its width varies. Caps and joins go into it:
the corners of a square cap, the tip of a mitre, or a polygon around the disc of a round one. An arc of a circle has one
polygon for each of its pieces; other curves are chords with round joins. The union is the stroke, and a little more:

        inner ends       the piece of an arc of radius r and half width h has the corners at radius r - h
       /     |     \\     and r + h on both of its rays, and the intersection of the outer tangents
      outer, T, outer

Rectangles along the axes are exact, as are all of a rational direction. Others are larger by a millionth of the width,
so that their corners have short decimals; round parts are polygons around discs, within the tolerance.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Literal

from cfree.curves.drawn import (
    Arc,
    Cubic,
    Line,
    Ring,
    Segment,
    Vector,
    chord_points,
    decimal,
    ends,
    points_along,
)
from cfree.curves.hulls import box_of
from cfree.exact.number import ExactPoint, rational_root
from cfree.formats.drawings.content import Curve
from cfree.formats.drawings.source import CURVE_SHARE, Source
from cfree.polygons.disc import around_disc
from cfree.polygons.hull import convex_hull
from cfree.polygons.polygon import Polygon

Width = float | Fraction
Style = Literal["drawn", "round"]
LONGEST_MITRE = 4.2
"""Length of a mitre per width, beyond which a corner is round: just above the limits of SVG and of AutoCAD."""
MARGIN = 2.0**-20
"""Growth of a rectangle of an irrational direction, per width; it exceeds the rounding of its corners."""
NOISE = 2.0**-44
"""Bound of the rounding of points of curves, per size of their coordinates."""
SIDES = 8, 64
"""Least and greatest number of sides of a polygon around a disc."""
LEAST_SHARE = 1 / math.cos(math.pi / SIDES[1]) - 1 + 2 * MARGIN
"""Error of the polygon with the most sides, as a share of the radius."""
SMOOTH = 1e-6
"""Sine of the turn between two segments that need no join."""
SHARE = 8
"""The error of round parts is at most half the width divided by this,"""
FINEST = 1e-5
"""but not below this share of the curve's size, unless the tolerance is."""
PIECE = 8
"""Steps for the polygon of a piece of a curve."""
CHORD = 150
"""Steps for the polygon around a chord, which is the hull of two discs."""


def walls(source: Source, curves: Sequence[Curve], where: str = "") -> list[Polygon]:
    """Return the walls of unfilled curves, as the option `strokes` of reading has it.

    Parameters
    ----------
    source : Source
        Its option is "ignore": there are no walls, and each curve is noted with its length; "drawn": walls of the
        widths of the curves; or a width for all of them. A curve without a width is noted.
    curves : sequence of Curve
        Closed ones enclose nothing solid.
    where : str
        Layer or group of the curves, for the notes.

    Returns
    -------
    list of Polygon
        Convex polygons that overlap; their union contains the strokes.
    """
    strokes = source.reading.strokes
    polygons: list[Polygon] = []
    width = usual_width(curves)
    for curve in curves:
        if strokes == "ignore":
            note_open(source, curve, where, width)
        elif strokes != "drawn":
            source.note("info", "line read as a wall of the width given", where=where, size=float(strokes))
            polygons += wall(source, curve, [(strokes, strokes)] * len(curve.segments), "round", where)
        elif curve.width > 0:
            source.note("info", "line read as a wall of its width", where=where, size=curve.width)
            polygons += wall(source, curve, [(curve.width, curve.width)] * len(curve.segments), "drawn", where)
        else:
            at, length = ends(curve.segments[0])[0], length_of(curve.segments)
            source.note(
                "lost",
                "line without a width",
                "less",
                where=where,
                at=at,
                size=length,
                handle=curve.handle,
                remedy=f"--strokes {width:g}",
                points=points_along(curve.segments),
            )
    return polygons


def note_open(source: Source, curve: Curve, where: str, width: float) -> None:
    """Note a curve that forbids nothing, with its length; the remedy is to give it a width."""
    source.note(
        "lost",
        "open line",
        "less",
        where=where,
        at=ends(curve.segments[0])[0],
        size=length_of(curve.segments),
        handle=curve.handle,
        remedy="--strokes drawn" if curve.width > 0 else f"--strokes {width:g}",
        points=points_along(curve.segments),
    )


def usual_width(curves: Sequence[Curve]) -> float:
    """Return a width to propose: the power of ten below a hundredth of the size of curves.

    Examples
    --------
    >>> from cfree.curves.drawn import point_of
    >>> usual_width([Curve([Line(point_of(0, 0), point_of(12, 3))])])
    0.1
    """
    x0, y0, x1, y1 = box_of([curve.segments for curve in curves])
    size = max(x1 - x0, y1 - y0)
    return float(f"1e{math.floor(math.log10(size / 100))}") if size > 0 else 1.0


_LEAST_ERROR = 1e-30
"""Least error, as a share of the radius: more sides than any limit allows."""


def length_of(ring: Ring) -> float:
    """Return the length of a curve, by chords."""
    return sum(math.dist(a, b) for a, b in pairwise(points_along(ring, 32)))


def wall(
    source: Source, curve: Curve, widths: Sequence[tuple[Width, Width]], style: Style, where: str = ""
) -> list[Polygon]:
    """Return convex polygons around a curve's stroke.

    Parameters
    ----------
    source : Source
    curve : Curve
    widths : sequence of pairs of numbers
        Width at the start and at the end of each segment.
    style : str
        "drawn": caps and joins of the curve. "round": the Minkowski sum with the disc.
    where : str
        Layer or group, for the notes.
    """
    narrow = min((float(max(pair)) for pair in widths if max(pair) > 0), default=0.0)
    if not narrow:
        return []
    x0, y0, x1, y1 = box_of([curve.segments])
    size = max(x1 - x0, y1 - y0, narrow)
    error = min(source.reading.tolerance or size / CURVE_SHARE, max(narrow / 2 / SHARE, size * FINEST))
    stroke = _Stroke(curve, widths, style, error, source.spend)
    polygons = list(stroke.polygons())
    if stroke.is_near:
        widest = max(float(max(pair)) for pair in widths)
        source.note("near", "wall with round parts", "near", where=where, size=max(error, widest / 2 * LEAST_SHARE))
    return polygons


def sides_around(error: float) -> float:
    """Return the number of sides of a regular polygon around a disc of radius 1 whose corners are so far from it.

    Examples
    --------
    >>> round(sides_around(2**0.5 - 1), 6), round(sides_around(1e-12))
    (4.0, 2221441)
    """
    error = max(error, _LEAST_ERROR)
    return math.pi / math.atan(math.sqrt(error * (2 + error)))


def disc(center: ExactPoint, radius: Fraction, error: float) -> Polygon:
    """Return a polygon around a disc, no farther from it than an error, or with 64 sides.

    Examples
    --------
    >>> len(disc((Fraction(1), Fraction(2)), Fraction(3), 0.1))
    16
    """
    return Polygon(_around(center, radius, error))


def _around(p: ExactPoint, h: Fraction, error: float) -> list[ExactPoint]:
    sides = math.ceil(sides_around(error / float(h)) / 4) * 4
    return [(p[0] + x, p[1] + y) for x, y in around_disc(h, min(max(sides, SIDES[0]), SIDES[1]))]


@dataclass(slots=True)
class _Stroke:
    """A curve with the widths of its segments."""

    curve: Curve
    widths: Sequence[tuple[Width, Width]]
    style: Style
    error: float
    spend: Callable[[int], object]
    is_near: bool = False

    def polygons(self) -> Iterator[Polygon]:
        for k, (segment, (first, last)) in enumerate(zip(self.curve.segments, self.widths, strict=True)):
            half = _exact(first) / 2, _exact(last) / 2
            if max(half) <= 0:
                continue
            self.spend(PIECE)
            if isinstance(segment, Line):
                yield self.around_line(k, segment, half)
            elif isinstance(segment, Arc) and segment.circular and first == last:
                yield from self.around_arc(k, segment, float(half[0]))
            else:
                yield from self.around_chords(segment, half)

    def around_line(self, k: int, line: Line, half: tuple[Fraction, Fraction]) -> Polygon:
        """Return a polygon around the rectangle or trapezoid of a line, its caps and joins."""
        unit, is_exact = _unit(line)
        slope = float(abs(half[0] - half[1])) / math.dist(*ends(line))
        margin = 0.0 if is_exact else float(max(half)) * MARGIN * (1 + slope)
        points: list[ExactPoint] = []
        for end, (p, h) in enumerate(zip((line.start, line.end), half, strict=True)):
            points += self.around_end(k, end, p, unit, h, margin)
        return Polygon(convex_hull(points))

    def around_end(
        self, k: int, end: int, p: ExactPoint, unit: ExactPoint, h: Fraction, margin: float
    ) -> list[ExactPoint]:
        """Return the corners of a segment's end and of its cap or join, moved out by a margin."""
        if not h and not margin:
            return [p]
        grid = _grid(margin / 4) if margin else None
        kind, way = self.end(k, end), 2 * end - 1
        wide, beyond = h + Fraction(margin), Fraction(margin)
        if kind == "square":
            beyond += wide
        points = [_moved(p, unit, way * beyond, side * wide, grid) for side in (-1, 1)]
        if isinstance(kind, tuple):
            side, reach = kind
            points.append(_moved(p, unit, way * (reach * wide + beyond), side * wide, grid))
        return points + (self.disc(p, h) if kind == "round" and h else [])

    def around_arc(self, k: int, arc: Arc, half: float) -> Iterator[Polygon]:
        """Yield polygons around the pieces of a ring's sector, and its caps and joins."""
        self.is_near = True
        r = math.hypot(*arc.u)
        sweep = arc.last - arc.first
        step = min(math.pi / 8, 2 * math.acos(1 / (1 + self.error / (r + half))))
        count = max(1, math.ceil(min(abs(sweep) / step, 1e9))) if step else 10**9
        self.spend(PIECE * count)
        margin = half * MARGIN + NOISE * (r + abs(arc.center[0]) + abs(arc.center[1]))
        way = math.copysign(margin / r, sweep)
        out, into, far = (r + half + margin) / r, (r - half - margin) / r, math.cos(sweep / count / 2)
        for j in range(count):
            first, last = arc.first + sweep * j / count, arc.first + sweep * (j + 1) / count
            rays = [(first, share, -way) for share in (into, out)] + [(last, share, way) for share in (into, out)]
            rays.append(((first + last) / 2, out / far, 0.0))
            if into < 0:  # beyond the center
                rays.append(((first + last) / 2, into / far, 0.0))
            yield Polygon(convex_hull([_rounded(_on(arc, *ray), margin / 4) for ray in rays]))
        for end in (0, 1):
            if not arc.closed and self.end(k, end) != "butt":
                p = _rounded((arc.at(arc.first), arc.at(arc.last))[end], margin / 4)
                x, y = map(Fraction, _tangent(arc, end))
                points = self.around_end(k, end, p, (x, y), Fraction(half), 2 * margin)
                back, wide = (1 - 2 * end) * 2 * Fraction(margin), Fraction(half) + 2 * Fraction(margin)
                points += [_moved(p, (x, y), back, side * wide, _grid(margin)) for side in (-1, 1)]
                yield Polygon(convex_hull(points))

    def around_chords(self, segment: Segment, half: tuple[Fraction, Fraction]) -> Iterator[Polygon]:
        """Yield polygons around chords of a curve, with round ends."""
        self.is_near = True
        step = self.error / 5
        points = _chords(segment, step, self.spend)
        extra = Fraction(1.25 * step + NOISE * max(abs(c) for p in points for c in p))
        for j, (a, b) in enumerate(pairwise(points)):
            h = [half[0] + (half[1] - half[0]) * Fraction(i, len(points) - 1) for i in (j, j + 1)]
            ring = [q for p, w in zip((a, b), h, strict=True) for q in self.disc(_rounded(p, step / 8), w + extra)]
            yield Polygon(convex_hull(ring))

    def disc(self, p: ExactPoint, h: Fraction) -> list[ExactPoint]:
        """Return the corners of a polygon around a disc."""
        self.is_near = True
        return _around(p, h, self.error / 2)

    def end(self, k: int, end: int) -> str | tuple[int, Fraction]:
        """Return the form of an end: a cap, or the side of a mitre and its length per half width."""
        ring = self.curve.segments
        other = k - 1 if end == 0 else k + 1
        if self.curve.closed:
            other %= len(ring)
        if not 0 <= other < len(ring) or len(ring) == 1:
            return "round" if self.style == "round" else self.curve.cap
        a, b = _tangent(ring[k], end), _tangent(ring[other], 1 - end)
        sine, cosine = a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]
        is_even = self.widths[k][end] == self.widths[other][1 - end]
        if abs(sine) <= SMOOTH and cosine > 0 and is_even:
            return "butt"
        if self.style == "round" or self.curve.join != "miter" or not is_even:
            return "round"
        if cosine <= -1 or (1 + cosine) * LONGEST_MITRE**2 < 2:  # the length of a mitre is sqrt(2 / (1 + cosine))
            return "round"
        side = (1 if sine < 0 else -1) * (1 if end else -1)
        reach = abs(sine) / (1 + cosine)
        return side, Fraction(1) if cosine == 0 else Fraction(math.ceil(reach / MARGIN) + 1) * Fraction(MARGIN)


def _exact(width: Width) -> Fraction:
    """Return a width; a double as its decimal."""
    return width if isinstance(width, Fraction) else decimal(width)


def _unit(line: Line) -> tuple[ExactPoint, bool]:
    """Return the direction of a line, and True if it is exact; else its doubles."""
    x, y = line.end[0] - line.start[0], line.end[1] - line.start[1]
    if (length := rational_root(x * x + y * y)) is not None:
        return (x / length, y / length), True
    scale = max(abs(x), abs(y))
    u, v = float(x / scale), float(y / scale)
    size = math.hypot(u, v)
    return (Fraction(u / size), Fraction(v / size)), False


def _moved(p: ExactPoint, unit: ExactPoint, along: Fraction, beside: Fraction, grid: Fraction | None) -> ExactPoint:
    """Return a point moved along a direction and to its left; the move is rounded to a grid."""
    x, y = along * unit[0] - beside * unit[1], along * unit[1] + beside * unit[0]
    if grid is not None:
        x, y = round(x / grid) * grid, round(y / grid) * grid
    return p[0] + x, p[1] + y


def _grid(step: float) -> Fraction:
    """Return the power of ten below a step."""
    return Fraction(10) ** math.floor(math.log10(step))


def _rounded(p: Vector, step: float) -> ExactPoint:
    grid = _grid(step)
    return round(Fraction(p[0]) / grid) * grid, round(Fraction(p[1]) / grid) * grid


def _on(arc: Arc, t: float, share: float, beside: float) -> Vector:
    """Return the point on the ray of t at a share of the radius from the center, moved across by another share."""
    c, s = math.cos(t), math.sin(t)
    along, across = share * c - beside * s, share * s + beside * c
    return arc.center[0] + arc.u[0] * along + arc.v[0] * across, arc.center[1] + arc.u[1] * along + arc.v[1] * across


def _tangent(segment: Segment, end: int) -> Vector:
    """Return the direction of a segment at its start (0) or its end (1), of length 1."""
    match segment:
        case Line(start, last):
            x, y = last[0] - start[0], last[1] - start[1]
            scale = max(abs(x), abs(y))
            u, v = float(x / scale), float(y / scale)
        case Arc():
            t, way = (segment.first, segment.last)[end], math.copysign(1.0, segment.last - segment.first)
            u, v = (way * (b * math.cos(t) - a * math.sin(t)) for a, b in zip(segment.u, segment.v, strict=True))
        case Cubic(points, _):
            row = points if end == 0 else points[::-1]
            q = next((p for p in row[1:] if p != row[0]), row[0])
            u, v = ((b - a) * (1 - 2 * end) for a, b in zip(row[0], q, strict=True))
    size = math.hypot(u, v) or 1.0
    return u / size, v / size


def _chords(segment: Segment, error: float, spend: Callable[[int], object]) -> list[Vector]:
    """Return points of a curve whose chords are within an error of it."""
    match segment:
        case Arc(_, u, v, first, last):
            bend = math.hypot(*u, *v) * (last - first) ** 2
        case Cubic((a, b, c, d), _):
            bend = 6 * max(math.dist((a[0] + c[0], a[1] + c[1]), (2 * b[0], 2 * b[1])),
                           math.dist((b[0] + d[0], b[1] + d[1]), (2 * c[0], 2 * c[1])))  # fmt: skip
        case _:
            bend = 0.0
    # a chord is within h^2 / 8 times the second derivative
    count = max(1, math.ceil(min(math.sqrt(bend / 8 / error), 1e9)))
    spend(CHORD * count)
    return [*chord_points(segment, count), ends(segment)[1]]
