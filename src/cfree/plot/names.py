"""Names on parts: each within its part, where it covers no other one."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely

PLACES = 15  # of a name in its part, along a side
BEYOND = 0.2  # cost of a name's area outside of its part, in that of text below it
SMALL = 12  # pixels: names of smaller parts are beside them


def put_inside(ax: Any, text: Any, part: shapely.Geometry) -> None:
    """Move a name, within its part and in lines if need be, to a place where it covers no other text.

    The name of a part that is too small to be seen, such as a finger that is a point, is above or below it.
    """
    ax.apply_aspect()
    others = shapely.union_all([_box_of(other) for other in ax.texts if other is not text])
    x0, y0, x1, y1 = part.bounds
    xs, ys = np.linspace(x0, x1, PLACES), np.linspace(y0, y1, PLACES)
    grid = shapely.points([(x, y) for x in xs for y in ys])
    inside = [text.get_position(), *shapely.get_coordinates(grid[shapely.contains(part, grid)]).tolist()]
    window, own = shapely.box(*ax.get_window_extent().extents), shapely.transform(part, ax.transData.transform)
    u0, v0, u1, v1 = own.bounds
    if max(u1 - u0, v1 - v0) < SMALL:
        beside = [((u0 + u1) / 2, v1 + SMALL), ((u0 + u1) / 2, v0 - SMALL)]
        inside = ax.transData.inverted().transform(beside).tolist()
    costs = list[tuple[float, str, Any]]()
    for form in dict.fromkeys([text.get_text(), text.get_text().replace(" ", "\n")]):
        text.set_text(form)
        for place in inside:
            text.set_position(place)
            box = _box_of(text)
            costs.append(((box & others).area + (box - window).area + BEYOND * (box - own).area, form, place))
    _, form, place = min(costs, key=lambda cost: cost[0])
    text.set_text(form)
    text.set_position(place)


def _box_of(text: Any) -> shapely.Geometry:
    """Return the box of a text in pixels."""
    return shapely.box(*text.get_window_extent().extents)
