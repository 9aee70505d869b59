"""Read rings into the core. Faults of points are reported here, faults of rings by the core."""

from __future__ import annotations

import reprlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

import cfree._core as _core
from cfree.errors import InvalidPolygonError
from cfree.exact.number import ExactPoint, Number, to_fraction
from cfree.libraries import Array, is_array
from cfree.words import counted

Points = Sequence[Sequence[Number]] | Array


@dataclass(frozen=True, slots=True)
class Removed:
    """A point of the input that is not a vertex: `reason` is "repeated" or "collinear".

    `ring` is 0 for the outer ring and k + 1 for hole k; `index` counts the ring's points in the input.
    """

    ring: int
    index: int
    reason: str


def read_rings(outer: Points, holes: Sequence[Points]) -> _core.Polygon:
    """Check and normalise the rings of one polygon; `cfree.Polygon` lists the accepted forms.

    Examples
    --------
    >>> read_rings([(0, 0), (0, "1/2"), (1, 0)], []).numerators
    ((0, 0), (2, 0), (0, 1))
    """
    if isinstance(holes, str | bytes | Mapping) or not isinstance(holes, Iterable):
        raise InvalidPolygonError(f"holes: {type(holes).__name__} is no list of rings; give one, or nothing")
    rings = [points.tolist() if is_array(points) else points for points in (outer, *holes)]
    read = _core.Polygon.of(rings)
    if read is None:  # rare or wrong input
        read = _core.Polygon.of([plain_ring(r, points) for r, points in enumerate(rings)])
        assert read is not None  # pairs of fractions
    return read


def plain_ring(ring: int, rows: Any) -> list[ExactPoint]:
    """Convert points to pairs of fractions."""
    if isinstance(rows, str) or not isinstance(rows, Iterable):
        raise _fault(ring, f"{reprlib.repr(rows)} is no ring; give a sequence of points (x, y)")
    points = []
    for k, row in enumerate(rows):
        if isinstance(row, str) or not isinstance(row, Iterable) or len(pair := tuple(row)) != 2:
            raise _fault(ring, f"point {k} = {reprlib.repr(row)} is no point; give a pair (x, y)")
        try:
            x, y = map(to_fraction, pair)
        except ValueError as error:
            raise _fault(ring, f"point {k}: {error}") from None
        if max(value.numerator.bit_length() - value.denominator.bit_length() for value in (x, y)) >= 1023:
            raise _fault(ring, f"point {k} lies beyond 4e307; scale the coordinates")  # the core's message
        points.append((x, y))
    closed = len(points) > 1 and points[0] == points[-1]
    if len(points) - closed < 3:
        raise _fault(ring, f"{counted(len(points) - closed, 'point')}; give at least 3")
    return points


def restored(numerators: Iterable[tuple[int, int]], denominator: int, offsets: Sequence[int]) -> _core.Polygon:
    """Read rings again that the core has accepted before."""
    points = [(Fraction(x, denominator), Fraction(y, denominator)) for x, y in numerators]
    read = _core.Polygon.of([points[i:j] for i, j in pairwise(offsets)])
    assert read is not None  # pairs of fractions
    return read


def _fault(ring: int, message: str) -> InvalidPolygonError:
    return InvalidPolygonError(f"{f'hole {ring - 1}' if ring else 'outer ring'}: {message}", ring=ring)
