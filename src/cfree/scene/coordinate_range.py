"""The documented range of a scene's coordinates, checked once, where a scene is made.

Coordinates become integers over one common denominator. If they have at most `MAX_BITS` the core's doubles neither
overflow nor underflow, and its exact integers stay fast: lengths from 1e-150 to 1e150 may meet in one scene.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import chain
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from cfree.polygons.polygon import Polygon

Path = tuple[str | int, ...]  # as in a scene file

MAX_BITS = 1110  # with the frame around it and `LARGEST_BITS` no double is below 2^-1022
LARGEST = 10**150


def range_fault(
    robot: Sequence[Polygon],
    obstacles: Sequence[Polygon],
    workspace: Polygon | None,
    bounds: Sequence[Fraction] | None,
) -> tuple[Path, str] | None:
    """What lies outside the range: its place and a message, or nothing.

    Examples
    --------
    >>> from cfree import Polygon
    >>> far = Polygon([(0, 0), ("1e200", 0), (0, 1)])
    >>> range_fault([far], [], None, None)  # doctest: +ELLIPSIS
    (('robot', 0), 'the coordinate 1e200 is larger than 1e150; scale the scene')
    """
    widest: tuple[Fraction, Path] = Fraction(0), ()
    finest: tuple[int, Path] = 1, ()
    scale = 1
    for path, denominator, numerators in _numbers(robot, obstacles, workspace, bounds):
        value = max(numerators, key=abs)
        if abs(value) > LARGEST * denominator:
            return path, f"the coordinate {_shown(value // denominator)} is larger than 1e150; scale the scene"
        widest = max(widest, (abs(Fraction(value, denominator)), path))
        finest = max(finest, (denominator, path))
        scale = math.lcm(scale, denominator)
        if scale.bit_length() > MAX_BITS:
            break
    bits = int(widest[0] * scale).bit_length()
    if bits <= MAX_BITS and scale.bit_length() <= MAX_BITS:
        return None
    return finest[1], (
        f"with its denominator {_shown(finest[0])} the scene's coordinates, over one common denominator, are "
        f"integers of {max(bits, scale.bit_length()):,} bits or more, and {MAX_BITS:,} are allowed; "
        "keep lengths between 1e-150 and 1e150, in decimals or in few denominators"
    )


def _numbers(
    robot: Sequence[Polygon],
    obstacles: Sequence[Polygon],
    workspace: Polygon | None,
    bounds: Sequence[Fraction] | None,
) -> Iterator[tuple[Path, int, list[int]]]:
    for name, polygons in (("robot", robot), ("obstacles", obstacles)):
        for k, polygon in enumerate(polygons):
            yield (name, k), polygon.denominator, list(chain.from_iterable(polygon.numerators))
    if workspace is not None:
        yield ("workspace",), workspace.denominator, list(chain.from_iterable(workspace.numerators))
    for k, bound in enumerate(bounds or ()):
        yield ("bounds", k), bound.denominator, [bound.numerator]


def _shown(value: int) -> str:
    """About this number, however long it is."""
    power = max(0, value.bit_length() * 30103 // 100000 - 6)  # leaves six digits or seven
    digits, exponent = f"{value // 10**power:e}".split("e")
    return f"{float(digits):.6g}e{int(exponent) + power}" if power > 6 else str(value)
