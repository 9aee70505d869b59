"""Curves of drawings for tests of regions, and regions that can be compared."""

import random
from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import pairwise

from cfree.curves.drawn import Arc, Line, Ring, Segment, ends
from cfree.curves.hulls import Outline, polygon_of
from cfree.formats.drawings.content import Curve
from cfree.formats.drawings.regions import layer_outlines
from cfree.formats.drawings.source import Reading, Source
from cfree.polygons.polygon import Polygon

Point = tuple[Fraction, Fraction]


def point(x: float | str, y: float | str) -> Point:
    return Fraction(str(x)), Fraction(str(y))


def ring(*points: tuple[float | str, float | str]) -> Ring:
    corners = [point(*p) for p in points]
    return [Line(a, b) for a, b in zip(corners, [*corners[1:], *corners[:1]], strict=True) if a != b]


def box(x: float, y: float, w: float, h: float) -> Ring:
    right, top = round(x + w, 6), round(y + h, 6)
    return ring((x, y), (right, y), (right, top), (x, top))


def closed(*rings: Ring) -> list[Curve]:
    return [Curve(segments, True, f"ring {k}") for k, segments in enumerate(rings)]


def pieces(*rings: Ring) -> list[Curve]:
    """Return each segment as a curve of its own."""
    return [Curve([segment], False, f"line {k}") for k, segment in enumerate(s for one in rings for s in one)]


def lines(*segments: tuple[float | str, float | str, float | str, float | str]) -> list[Curve]:
    return [Curve([Line(point(x, y), point(z, w))], False, f"line {k}") for k, (x, y, z, w) in enumerate(segments)]


def outlines(curves: Sequence[Curve], **options: object) -> tuple[list[Outline], Source]:
    workspace = bool(options.pop("workspace", False))
    hatched = bool(options.pop("hatched", False))
    source = Source("a.dxf", reading=Reading(**options))  # type: ignore[arg-type]
    return layer_outlines(source, "A", curves, hatched, workspace=workspace), source


def region(curves: Sequence[Curve], **options: object) -> list[Polygon]:
    return [polygon_of(outline, 0.01) for outline in outlines(curves, **options)[0]]


def notes(source: Source) -> dict[str, int]:
    """Numbers of notes by their kind and subject."""
    return {f"{note.kind} {note.what}": note.count for note in source.notes}


def edges(polygons: Iterable[Polygon]) -> set[frozenset[Point]]:
    """Return all edges: two lists of polygons are the same region if, and only if, these are equal."""
    every = [one for polygon in polygons for one in polygon.exact_rings]
    return {frozenset(edge) for one in every for edge in zip(one, (*one[1:], one[0]), strict=True)}


def area(polygons: Iterable[Polygon]) -> float:
    return float(sum(polygon.exact_area for polygon in polygons))


def is_in(polygons: Iterable[Polygon], p: tuple[float, float]) -> bool:
    """True if a point that is near no edge is in one of the polygons."""
    odd = False
    for polygon in polygons:
        inside = False
        for one in polygon.rings:
            for (x0, y0), (x1, y1) in zip(one.tolist(), [*one.tolist()[1:], one.tolist()[0]], strict=True):
                if (y0 > p[1]) != (y1 > p[1]) and p[0] < x0 + (p[1] - y0) * (x1 - x0) / (y1 - y0):
                    inside = not inside
        odd |= inside
    return odd


def changed(rng: random.Random, curves: Sequence[Curve]) -> list[Curve]:
    """Draw open lines in another way: shuffled, reversed, split at rational points, and drawn again."""
    result = []
    for curve in curves:
        (segment,) = curve.segments
        assert isinstance(segment, Line)
        for _ in range(rng.choice((1, 1, 2))):
            cuts = sorted({Fraction(rng.randrange(1, 97), 97) for _ in range(rng.randrange(3))})
            places = [segment.start, *(_between(segment, t) for t in cuts), segment.end]
            for a, b in pairwise(places):
                result.append(Curve([Line(b, a) if rng.random() < 0.5 else Line(a, b)]))
    rng.shuffle(result)
    return result


def _between(line: Line, t: Fraction) -> Point:
    (x, y), (z, w) = line.start, line.end
    return x + (z - x) * t, y + (w - y) * t


def sweep(segments: Sequence[Segment]) -> float:
    """Total angle of the arcs."""
    return sum(abs(segment.last - segment.first) for segment in segments if isinstance(segment, Arc))


def is_connected(segments: Sequence[Segment]) -> bool:
    """True if each segment begins where the one before ends, up to rounding."""
    pairs = zip(segments, [*segments[1:], segments[0]], strict=True)
    return all(abs(ends(a)[1][k] - ends(b)[0][k]) < 1e-9 for a, b in pairs for k in (0, 1))
