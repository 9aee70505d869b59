"""Shapes painted upon others: a white disc upon a black plate is no hole, and this is said."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from cfree.curves.hulls import area, in_range, rough
from cfree.formats.drawings.content import Drawn
from cfree.formats.drawings.source import Source

MOST = 1_000_000
"""Maximum number of pairs that are compared; a hint is not worth more."""


@dataclass(frozen=True, slots=True)
class Painted:
    """A filled element, its role and its colour."""

    drawn: Drawn
    role: str
    colour: str


def note_painted(source: Source, elements: Sequence[Painted]) -> None:
    """Note elements inside of others of another colour, which may be meant as holes."""
    if len({(item.role, item.colour) for item in elements}) < 2:
        return
    import shapely

    bodies = [_body(item.drawn) for item in elements]
    tree, pairs = shapely.STRtree(bodies), 0
    for k, item in enumerate(elements):
        around = tree.query(bodies[k], predicate="covered_by").tolist()
        pairs += len(around)
        if pairs > MOST:
            return
        if any(j < k and elements[j].role == item.role and elements[j].colour != item.colour for j in around):
            x0, y0, x1, y1 = bodies[k].bounds
            source.note(
                "info",
                "shape painted upon another of another colour: solid as well, since holes must be subpaths",
                at=((x0 + x1) / 2, (y0 + y1) / 2),
                handle=f"line {item.drawn.line}",
            )


def _body(drawn: Drawn) -> Any:
    """Return the largest ring in doubles; an empty polygon if it crosses itself."""
    import shapely

    points = max(map(rough, drawn.rings), key=lambda part: abs(area(part))) if in_range(drawn.rings) else []
    body = shapely.Polygon(points) if len(points) > 2 else shapely.Polygon()
    return body if body.is_valid else shapely.Polygon()
