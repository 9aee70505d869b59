"""Shapes whose pieces cross or touch are refused with the names of the pieces and the place."""

from __future__ import annotations

import math
import re
from fractions import Fraction
from typing import Any

import pytest

import cfree
from cfree import Curved
from cfree.curves import Arc, Bezier, Circle, Spline

CROSSING: dict[str, tuple[Any, str, str, tuple[float, float]]] = {
    "an arc through a side": (
        lambda: Curved([(-2, 0), (2, 0), (2, 1), Arc((-2, 1), through=(0, -1))]),
        "outer ring: item 1 and item 3",
        "cross",
        (-math.sqrt(3), 0),
    ),
    "an arc through the closing line": (
        lambda: Curved([(3, -1), (3, 1), (2, 1), Arc((-2, 1), through=(0, "-3/2")), (-3, 1), (-3, -1)]),
        "outer ring: item 3 and the closing line",
        "cross",
        (math.sqrt(1.8), -1),
    ),
    "a circle through a circle": (
        lambda: Curved(Circle((0, 0), 2), [Circle((2, 0), 1)]),
        "the circle of outer ring and the circle of hole 0",
        "cross",
        (1.75, math.sqrt(15) / 4),
    ),
    "a path that goes around twice": (
        lambda: Curved([(1, 0), Arc((1, 0), center=(0, 0)), Arc((1, 0), center=(0, 0))]),
        "outer ring: item 1 and item 2",
        "touch",
        (1, 0),
    ),
    "a circle and back": (
        lambda: Curved([(0, 0), Arc((0, 0), center=(1, 0)), Arc((0, 0), center=(-1, 0), clockwise=True)]),
        "outer ring: item 1 and item 2",
        "touch",
        (0, 0),
    ),
    "a loop": (
        lambda: Curved([(0, 0), Bezier([(9, 6), (-5, 6), (4, 0)]), (4, -2), (0, -2)]),
        "outer ring: item 1",
        "crosses itself",
        (2, 1.565),
    ),
    "a spline through a line": (
        lambda: Curved([(0, 0), Spline([(2, -3), (4, 5), (6, 0)]), (6, 4), (0, 4), (3, 0)]),
        "outer ring: item 1 and item 4",
        "cross",
        (2.68, 0.43),
    ),
}


@pytest.mark.parametrize("name", CROSSING)
def test_pieces_that_cross_are_named_with_their_place(name: str) -> None:
    make, names, what, (x, y) = CROSSING[name]
    with pytest.raises(cfree.InvalidPolygonError) as caught:
        make()
    message = rf"{names} {what} at about \((\S+), (\S+)\); divide the shape there, or move them apart"
    place = re.fullmatch(message, str(caught.value))
    assert place, str(caught.value)
    assert math.hypot(abs(float(place[1])) - abs(x), abs(float(place[2])) - abs(y)) < 0.1, str(caught.value)


@pytest.mark.parametrize("radius", [Fraction(1, 10**400), "1e-330"])
def test_a_shape_below_the_range_of_doubles_is_refused(radius: Any) -> None:
    with pytest.raises(cfree.InvalidPolygonError, match="smaller than doubles can tell; scale the shape"):
        Curved.circle((0, 0), radius)
