"""Portals: free poses on the borders between rooms, one for each part of a border that the robot can cross.

Borders are sampled at steps of the robot's radius, in the middle between walls, and in 16 orientations. So a passage
may have no portal: a route along portals is a path, once its motions are proved free; no route proves nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from cfree.collision.pose_checker import FREE, PoseChecker, is_free_at
from cfree.contact.features import shape_features
from cfree.exact.half_angle import theta_from
from cfree.exact.pose import Pose, pose_at
from cfree.planning.rooms import UNIT, Box, Floats, Ints, Rooms
from cfree.planning.steps import step_planner
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import AnyShape, Scene

_QUARTER = [Fraction(0), Fraction(1, 5), Fraction(5, 12), Fraction(2, 3), Fraction(1), Fraction(3, 2), Fraction(12, 5)]
TAUS: tuple[Fraction | None, ...] = (*_QUARTER, Fraction(5), None, Fraction(-5), *(-tau for tau in _QUARTER[:0:-1]))
"""Half-angle tangents of about every 16th of a turn."""
THETAS = np.array([theta_from(tau) % (2 * math.pi) for tau in TAUS])
QUARTER = 4  # orientations in a right angle
SPACING = 16  # most samples of a border for one portal
MOST = 400  # most samples of a border
CHORDS = 16  # of an arc, where walls are looked for
GUESSES = 2_000  # motions guessed by a search that joins two portals

Key = tuple[int, int, int]
"""A portal: the rooms on both sides, the lower number first, and its number on their border."""


@dataclass(frozen=True, slots=True)
class Portal:
    """A free pose on the border of two rooms.

    Attributes
    ----------
    key : three int
    x, y : float
        Exactly.
    turn : int
        Its orientation, in `TAUS`.
    """

    key: Key
    x: float
    y: float
    turn: int

    @property
    def pose(self) -> Pose:
        return pose_at(Fraction(self.x), Fraction(self.y), TAUS[self.turn])

    def beyond(self, room: int) -> int:
        """The room on the other side."""
        return self.key[1] if self.key[0] == room else self.key[0]


class Ground(Protocol):
    """Obstacles of a scene, too many for one plan."""

    radius: float  # of the robot about its reference point

    def near(self, box: Box) -> Ints:
        """Obstacles that the robot may touch with its reference point in a box, in order; perhaps others."""

    def part(self, numbers: Ints, bounds: Box | None) -> Scene:
        """Scene with some of the obstacles, whose bounds are those of the whole, or these."""


Borders = dict[tuple[int, int], list[Portal]]
"""Portals by the rooms on both sides, the lower number first."""


def portals_of(rooms: Rooms, room: int, checker: PoseChecker, radius: float, known: Borders) -> list[Portal]:
    """Portals on all borders of a room, by a checker of the obstacles near it; `known` gets them by border."""
    result, walls = [], _walls(checker.scene)
    for other, line in rooms.borders(room):
        border = min(room, other), max(room, other)
        if border not in known:  # the same from both sides: verdicts are exact
            known[border] = [*_portals(border, line, walls, checker, radius)]
        result += known[border]
    return result


def _portals(
    border: tuple[int, int], line: Box, walls: Floats, checker: PoseChecker, radius: float
) -> Iterator[Portal]:
    x0, y0, x1, _ = line
    is_upright = x0 == x1
    places = _places(line, walls, radius)
    table = np.empty((len(places), len(TAUS), 3))
    table[:, :, 1 if is_upright else 0] = places[:, None]
    table[:, :, 0 if is_upright else 1] = x0 if is_upright else y0
    table[:, :, 2] = THETAS
    free = checker.verdicts(table.reshape(-1, 3), 1).reshape(table.shape[:2]) == FREE
    number = 0
    for place, turn in _chosen(free, 0 if is_upright else QUARTER):
        x, y, _ = table[place, turn].tolist()
        portal = Portal((*border, number), x, y, turn)
        if is_free_at(checker, portal.pose):  # its tangent is not that of the table
            yield portal
            number += 1


def _places(line: Box, walls: Floats, radius: float) -> Floats:
    """Places along a border: at even steps, and in the middle between walls that cross it near each other."""
    along = int(line[0] == line[2])
    begin, end, across = line[along], line[along + 2], line[1 - along]
    count = min(MOST, max(3, math.ceil((end - begin) / radius)))
    step = (end - begin) / count
    unit = 2.0 ** math.floor(math.log2(min(radius, step) / UNIT))
    even = begin + np.round((np.arange(count) + 0.5) * step / unit) * unit
    a, b = walls[:, 1 - along], walls[:, 3 - along]
    crossing = walls[(a < across) != (b < across)]
    a, b = crossing[:, 1 - along], crossing[:, 3 - along]
    met = np.sort(crossing[:, along] + (crossing[:, along + 2] - crossing[:, along]) * (across - a) / (b - a))
    fine = unit / UNIT
    middle = np.round((met[1:] + met[:-1])[np.diff(met) < 4 * radius] / 2 / fine) * fine
    return np.unique(np.concatenate([even, middle[(middle > begin) & (middle < end)]]))


def _walls(scene: Scene) -> Floats:
    """Edges of the obstacles and the workspace, (n, 4), rounded; of arcs chords."""
    shapes = [*scene.obstacles, *([] if scene.workspace is None else [scene.workspace])]
    rings = (ring for shape in shapes for ring in _rims(shape))
    return np.concatenate(
        [np.zeros((0, 4)), *(np.concatenate([ring, np.roll(ring, -1, axis=0)], axis=1) for ring in rings)]
    )


def _rims(shape: AnyShape) -> Sequence[Floats]:
    return shape.rings if isinstance(shape, Polygon) else shape_features(shape).rims(CHORDS)


def _chosen(free: NDArray[np.bool_], across: int) -> Iterator[tuple[int, int]]:
    """Place and orientation for each connected part of the free samples of a border, and for each piece of a long one.

    Examples
    --------
    >>> free = np.zeros((7, 16), bool)
    >>> free[1:4, 3:6] = free[5] = True
    >>> [*_chosen(free, 0)]
    [(2, 4), (5, 0)]
    """
    for part in _parts(free):
        places = np.flatnonzero(part.any(axis=1))
        pieces = -(-len(places) // SPACING)
        for piece in np.array_split(places, pieces):
            place = int(piece[len(piece) // 2])
            yield place, _middle(part[place], across)


def _parts(free: NDArray[np.bool_]) -> Iterator[NDArray[np.bool_]]:
    """Connected parts: neighbours are the next places, and the next orientations all around."""
    before = np.zeros_like(free)
    before[1:] = free[:-1]
    run = np.cumsum((free & ~before).T).reshape(free.T.shape).T * free  # numbers of runs of places, from 1 on
    left = free.copy()
    while left.any():
        held = np.zeros(int(run.max()) + 1, np.bool_)
        held[run.flat[int(left.argmax())]] = True
        count = 0
        while (now := int(held.sum())) != count:
            count, part = now, held[run]
            held[run[free & (np.roll(part, 1, axis=1) | np.roll(part, -1, axis=1))]] = True
        left &= ~part
        yield part


def _middle(row: NDArray[np.bool_], across: int) -> int:
    """Middle of the longest run of orientations; the one across the border if all are free."""
    if row.all():
        return across
    begin = int(np.argmin(row))
    best, run = (0, 0), 0
    for k in range(1, len(row) + 1):
        run = run + 1 if row[(begin + k) % len(row)] else 0
        best = max(best, (run, (begin + k - run // 2) % len(row)))
    return best[1]


def parts_of(scene: Scene, portals: list[Portal]) -> Ints:
    """Part of a room that each portal leads to: those of one part are joined within the room, and no others.

    A search joins most of them; the free space of the room decides about the rest. Where it is not known, all count as
    joined.
    """
    poses = [portal.pose for portal in portals]
    planner = step_planner(scene)
    joined: list[list[int]] = []
    for k, pose in enumerate(poses):
        for part in joined:
            if planner.joins(poses[part[-1]], pose, GUESSES):
                part.append(k)
                break
        else:
            joined.append([k])
    result = np.zeros(len(poses), np.int64)
    if len(joined) > 1 and (space := planner.space) is not None:
        cells = space.locate([poses[part[0]] for part in joined])
        for part, cell in zip(joined, cells.tolist(), strict=True):
            result[part] = cell
    return result
