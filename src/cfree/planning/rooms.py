"""Rooms: the plane around many obstacles divided into rectangles of few edges each, for routes from room to room.

Halves of halves, each cut where few edges cross it and much room is around it: in a city, in the middle of a street.
Any division will do: it decides how fast a route is found, never if there is one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]
Box = tuple[float, float, float, float]

EDGES = 200  # most edges in a room that is large enough to be divided
LEAST = 8  # least side of a room, in radii of the robot
RIM = 16  # width of the rim around all obstacles, in radii
FEWER = 0.9  # a cut leaves at most this share of the edges on either side
UNIT = 64  # corners of rooms are multiples of a power of two, about this part of the radius


@dataclass(frozen=True)
class Rooms:
    """A division of a rectangle, as a tree of cuts.

    Attributes
    ----------
    boxes : (n, 4) float64
        The rooms: xmin, ymin, xmax, ymax; neighbours in the tree are neighbours in this order.
    cuts : (k, 2) float64
        Each cut's axis, 0 or 1, and place.
    halves : (k, 2) int64
        The cut that divides either half further, or ~r for room r.
    """

    boxes: Floats
    cuts: Floats
    halves: Ints

    def __len__(self) -> int:
        return len(self.boxes)

    def box(self, room: int) -> Box:
        x0, y0, x1, y1 = self.boxes[room].tolist()
        return x0, y0, x1, y1

    def meeting(self, box: Box) -> list[int]:
        """Rooms that a box meets, also if it only touches them."""
        result, waiting = [], [0 if len(self.cuts) else ~0]
        while waiting:
            place = waiting.pop()
            if place < 0:
                x0, y0, x1, y1 = self.box(~place)
                if box[0] <= x1 and box[2] >= x0 and box[1] <= y1 and box[3] >= y0:
                    result.append(~place)
                continue
            axis, cut = int(self.cuts[place, 0]), self.cuts[place, 1]
            low, high = self.halves[place].tolist()
            if box[axis + 2] >= cut:
                waiting.append(high)
            if box[axis] <= cut:
                waiting.append(low)
        return result

    def around(self, x: float, y: float) -> int | None:
        """First room that holds a point; None if it is outside."""
        return min(self.meeting((x, y, x, y)), default=None)

    def borders(self, room: int) -> Iterator[tuple[int, Box]]:
        """Yield each neighbour of a room, and the common border, a box without width."""
        own = self.box(room)
        for other in self.meeting(own):
            if other == room:
                continue
            x0, y0, x1, y1 = self.box(other)
            x0, y0, x1, y1 = max(x0, own[0]), max(y0, own[1]), min(x1, own[2]), min(y1, own[3])
            if x0 < x1 or y0 < y1:
                yield other, (x0, y0, x1, y1)


def divided(edges: Floats, radius: float, bounds: Sequence[Fraction | float] | None = None, most: int = EDGES) -> Rooms:
    """Divide the plane around edges into rooms.

    Parameters
    ----------
    edges : (n, 4) float64
        The box around each edge.
    radius : float
        The robot's radius.
    bounds : four numbers, optional
        The rectangle of the reference point; else the box around all edges, and a rim. Rooms are within it.
    most : int
        Largest number of edges in a room that can be divided.

    Examples
    --------
    >>> walls = np.array([(0, 0, 9, 0), (0, 9, 9, 9), (20, 0, 29, 0), (20, 9, 29, 9)], float)
    >>> rooms = divided(walls, 0.5, (0, 0, 30, 9), most=2)
    >>> rooms.boxes.tolist(), rooms.around(3, 3), [*rooms.borders(0)]
    ([[0.0, 0.0, 14.5, 9.0], [14.5, 0.0, 30.0, 9.0]], 0, [(1, (14.5, 0.0, 14.5, 9.0))])
    """
    unit = 2.0 ** math.floor(math.log2(radius / UNIT))
    whole = np.array(_around(edges, RIM * radius, unit) if bounds is None else _within(bounds), np.float64)
    boxes: list[Floats] = []
    cuts: list[tuple[int, float]] = []
    halves: list[list[int]] = []
    waiting: list[tuple[Floats, Ints, tuple[int, int] | None]] = [(whole, np.arange(len(edges)), None)]
    while waiting:
        box, inside, place = waiting.pop()
        choice = _cut(box, edges[inside], LEAST * radius, unit) if len(inside) > most else None
        if choice is None:
            number = ~len(boxes)
            boxes.append(box)
        else:
            axis, cut = choice
            number = len(cuts)
            cuts.append(choice)
            halves.append([0, 0])
            low, high = box.copy(), box.copy()
            low[axis + 2] = high[axis] = cut
            waiting.append((high, inside[edges[inside, axis + 2] > cut], (number, 1)))
            waiting.append((low, inside[edges[inside, axis] < cut], (number, 0)))
        if place is not None:
            halves[place[0]][place[1]] = number
    tree = np.array(cuts, np.float64).reshape(-1, 2), np.array(halves, np.int64).reshape(-1, 2)
    return Rooms(np.array(boxes), *tree)


def _around(edges: Floats, rim: float, unit: float) -> list[float]:
    if not len(edges):
        return [-rim, -rim, rim, rim]
    low, high = edges[:, :2].min(axis=0) - rim, edges[:, 2:].max(axis=0) + rim
    return [*(np.floor(low / unit) * unit), *(np.ceil(high / unit) * unit)]


def _within(bounds: Sequence[Fraction | float]) -> list[float]:
    """Doubles that are within bounds."""
    box = [float(value) for value in bounds]
    is_out = [box[k] < bounds[k] if k < 2 else box[k] > bounds[k] for k in range(4)]
    inward = (math.inf, math.inf, -math.inf, -math.inf)
    return [math.nextafter(x, to) if out else x for x, to, out in zip(box, inward, is_out, strict=True)]


def _cut(box: Floats, edges: Floats, least: float, unit: float) -> tuple[int, float] | None:
    """The best cut of a room: few edges cross it, much room is around it, and the room is long; None without one."""
    choice, most = None, 0.0
    for axis in (0, 1):
        side = box[axis + 2] - box[axis]
        rim = max(least, side / 4)
        low, high = np.sort(edges[:, axis]), np.sort(edges[:, axis + 2])
        ends = np.unique(np.clip(np.concatenate([low, high]), box[axis] + rim, box[axis + 2] - rim))
        if side < 2 * rim or len(ends) < 2:
            continue
        places = np.round((ends[1:] + ends[:-1]) / 2 / unit) * unit
        before, after = np.searchsorted(low, places), len(high) - np.searchsorted(high, places, side="right")
        crossed = np.maximum(0, before + after - len(edges))  # some lie on it
        value = np.diff(ends) / (1 + crossed) * side
        value[np.maximum(before, after) > FEWER * len(edges)] = 0
        best = int(value.argmax())
        if value[best] > most and box[axis] < places[best] < box[axis + 2]:
            choice, most = (axis, float(places[best])), float(value[best])
    return choice
