"""Where does free space open when the robot gets a little smaller? A search by samples on the closed surfaces.

Sheets of the smaller robot's boundary that bound a narrow gap are in the larger robot's forbidden space, however far
they are pushed into their free side. What is connected of such samples and has neighbours that bound two cells of the
larger robot is a pinch.
"""

from __future__ import annotations

import math
from collections import defaultdict, deque
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cfree.features import BOUNDS, WORKSPACE
from cfree.free import is_free
from cfree.pose import Pose, Poses
from cfree.trapezoids import Floats, Ints

if TYPE_CHECKING:
    from cfree.cells import FreeSpace

GRID = 3  # samples along each side of a trapezoid
PUSH = 6  # times the difference of the insets: more than mitred corners move
MOST = 1000  # samples of a pinch that are compared
NAMES = {BOUNDS: "the bounds", WORKSPACE: "the workspace"}


@dataclass(frozen=True)
class Pinch:
    """A narrow place.

    Attributes
    ----------
    pose : Pose
        In the middle of it.
    obstacles : (int, int)
        What it is between; -1 is the bounds, -2 the workspace.
    """

    pose: Pose
    obstacles: tuple[int, int]

    def __str__(self) -> str:
        one, other = (NAMES.get(k, f"obstacle {k}") for k in sorted(self.obstacles, reverse=True))
        return f"{one} and {other} at {math.degrees(self.pose.theta):.3g} deg"


def pinches(larger: FreeSpace, smaller: FreeSpace, start: Pose, goal: Pose, difference: float) -> tuple[Pinch, ...]:
    """Pinches on a way from start to goal, apart for the larger robot and joined for the smaller; () if not found."""
    cells = larger.locate([start, goal]).tolist()
    faces = smaller.faces(int(smaller.locate(start)))
    xy, theta, normal, owner = _samples(smaller, faces)
    pushed = Poses(xy + PUSH * difference * normal, theta)
    is_new = ~np.asarray(is_free(larger.boundary, pushed))
    one, other = _adjacent(smaller, faces)
    part = _connected(is_new, one, other)
    beside = is_new[one] & ~is_new[other]
    group, outside = part[one[beside]], other[beside]
    edge_samples = np.unique(outside)
    labels = np.full(len(theta), -1, np.int32)
    labels[edge_samples] = larger.locate(Poses(pushed.xy[edge_samples], theta[edge_samples]))
    links = {(int(g), int(c)) for g, c in zip(group, labels[outside], strict=True) if c >= 0}
    found = [
        _narrowest(np.flatnonzero(part == g).astype(np.int32), xy, theta, normal, owner) for g in _route(links, cells)
    ]
    return tuple(pinch for pinch in found if pinch is not None)


def _samples(space: FreeSpace, faces: Ints) -> tuple[Floats, Floats, Floats, Ints]:
    """Of every face GRID * GRID: positions, orientations, normals to the free side, obstacles."""
    walls, table = space.walls, space.walls.trapezoids
    share = (np.arange(GRID) + 0.5) / GRID
    face = np.repeat(faces, GRID * GRID)
    across, along = (np.tile(values, len(faces)) for values in (np.tile(share, GRID), np.repeat(share, GRID)))
    theta = table.theta_from[face] + across * (table.theta_to - table.theta_from)[face]
    lower, upper = walls.limits(face, theta)
    patch = table.patch[face]
    xy = walls.evaluate(patch, lower + along * (upper - lower), theta)
    u, v = (walls.evaluate(patch, np.ones(len(face)), theta) - walls.evaluate(patch, np.zeros(len(face)), theta)).T
    length = np.hypot(u, v)
    owner = walls.features.obstacles.owner_polygon[walls.contact_obstacle[patch]]
    return xy, theta, np.column_stack([v / length, -u / length]), owner


def _adjacent(space: FreeSpace, faces: Ints) -> tuple[Ints, Ints]:
    """Pairs of neighbouring samples, both ways: in a face, and all at a coedge with all at its twin."""
    cells = space.complex
    first = np.full(len(cells.component), -1, np.int64)
    first[faces] = np.arange(len(faces)) * GRID * GRID
    place = np.arange(GRID * GRID).reshape(GRID, GRID)  # rows: along t; columns: along theta
    steps = ((place[:-1], place[1:]), (place[:, :-1], place[:, 1:]))
    inner = np.concatenate([np.column_stack([p.ravel(), q.ravel()]) for p, q in steps])
    pairs = [(first[faces][:, None, None] + inner).reshape(-1, 2)]
    at_side = np.stack([place[:, 0], place[-1], place[:, -1], place[0]])
    coedges = np.flatnonzero(first[cells.face] >= 0)
    twins = cells.twin[coedges]
    mine, theirs = (first[cells.face[h]][:, None] + at_side[cells.side[h]] for h in (coedges, twins))
    pairs.append(np.stack(np.broadcast_arrays(mine[:, :, None], theirs[:, None, :]), axis=-1).reshape(-1, 2))
    both = np.concatenate(pairs)
    both = np.concatenate([both, both[:, ::-1]])
    return both[:, 0].astype(np.int32), both[:, 1].astype(np.int32)


def _connected(chosen: NDArray[np.bool_], one: Ints, other: Ints) -> Ints:
    """A number for each connected part of the chosen samples; -1 for the others."""
    number = np.where(chosen, np.arange(len(chosen)), -1).astype(np.int32)
    inside = chosen[one] & chosen[other]
    a, b = one[inside], other[inside]
    while True:
        before = number.copy()
        np.minimum.at(number, a, number[b])
        number = np.where(chosen, number[number], -1).astype(np.int32)
        if np.array_equal(number, before):
            return number


def _route(links: set[tuple[int, int]], cells: list[int]) -> list[int]:
    """Pinches on the shortest way from one cell to another."""
    around: dict[tuple[str, int], list[tuple[str, int]]] = defaultdict(list)
    for pinch, cell in sorted(links):
        around["pinch", pinch].append(("cell", cell))
        around["cell", cell].append(("pinch", pinch))
    first, last = ("cell", cells[0]), ("cell", cells[1])
    came, todo = {first: first}, deque([first])
    while todo and last not in came:
        place = todo.popleft()
        for following in around[place]:
            if following not in came:
                came[following] = place
                todo.append(following)
    route, place = [], last if last in came else first
    while place != first:
        route += [place[1]] if place[0] == "pinch" else []
        place = came[place]
    return route[::-1]


def _narrowest(samples: Ints, xy: Floats, theta: Floats, normal: Floats, owner: Ints) -> Pinch | None:
    """Between the two closest samples that face each other."""
    k = samples[:: -(-len(samples) // MOST)]
    step = xy[None, k] - xy[k, None]
    turned = np.abs(np.mod(theta[None, k] - theta[k, None] + math.pi, math.tau) - math.pi)
    size = np.ptp(xy[k], axis=0).max()
    distance = np.hypot(step[..., 0], step[..., 1]) + size * turned
    facing = normal[k] @ normal[k].T < -0.5
    distance[~facing] = np.inf
    i, j = np.unravel_index(int(distance.argmin()), distance.shape)
    if not np.isfinite(distance[i, j]):
        return None
    x, y = ((xy[k[i]] + xy[k[j]]) / 2).tolist()
    return Pinch(Pose(x, y, float(theta[k[i]])), (int(owner[k[i]]), int(owner[k[j]])))
