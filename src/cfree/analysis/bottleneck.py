"""Bottlenecks, where free space opens if the robot gets a little smaller: a search by samples on the closed surfaces.

A sample of the smaller robot's boundary has the same contact, t and theta on the larger robot's. There it bounds a
cell, or it is covered. There is a bottleneck where neighbours bound different cells, or where covered samples connect
two of these.
"""

from __future__ import annotations

import math
from collections import defaultdict, deque
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from cfree.collision.motion import Translation
from cfree.collision.motion_checker import MotionChecker
from cfree.exact.pose import Pose
from cfree.forbidden.columns import Ints
from cfree.libraries import Floats
from cfree.scene.naming import placed
from cfree.scene.scene import default_name

if TYPE_CHECKING:
    from cfree.free.space import FreeSpace

COARSE, FINE = 3, 25  # samples along each side of a trapezoid: on all, and on those at a bottleneck
MOST = 100  # most samples of a bottleneck that are pushed
NUDGE = 1e-9  # first push of a sample off its contact, in robot sizes
COVERED = -1


@dataclass(frozen=True)
class Bottleneck:
    """A narrow place.

    Attributes
    ----------
    pose : Pose or (x, y, theta)
        Near the middle of it.
    obstacles : (int, int)
        The two obstacles that it is between; -1 is the bounds, -2 the workspace.
    names : (str, str), optional
        Their names in words, with size and place.

    Examples
    --------
    >>> print(Bottleneck(Pose(0, 0, "359.99deg"), (1, 0)))
    obstacle 1 and obstacle 0 at 0 deg
    """

    pose: Pose
    obstacles: tuple[int, int]
    names: tuple[str, str] | None = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        pairs = zip(self.obstacles, self.names or map(default_name, self.obstacles), strict=True)
        one, other = (name for _, name in sorted(pairs, reverse=True))
        degrees = float(f"{math.degrees(self.pose.theta):.3g}") % 360  # almost a whole turn is none
        return f"{f'parts of {one}' if one == other else f'{one} and {other}'} at {degrees:g} deg"


@dataclass(frozen=True, eq=False)
class Samples:
    """Points on faces: a grid of n * n on each, row by row along theta, and pairs of neighbours, both ways."""

    face: Ints
    t: Floats
    theta: Floats
    one: Ints
    other: Ints


def bottlenecks(larger: FreeSpace, smaller: FreeSpace, start: Pose, goal: Pose) -> tuple[Bottleneck, ...]:
    """Find bottlenecks between start and goal, separated for the larger robot and joined for the smaller.

    Notes
    -----
    Nothing is proved: samples may miss a bottleneck. The result is () if none is found, or if the robots have different
    numbers of vertices.
    """
    if len(larger.boundary.features.robot.vertices) != len(smaller.boundary.features.robot.vertices):
        return ()
    cells = larger.locate([start, goal]).tolist()
    samples = sampled(smaller, smaller.faces(int(smaller.locate(start))), COARSE)
    label = labels(larger, smaller, samples)
    group = _groups(label, samples)
    checker, result = MotionChecker(smaller.boundary.scene), []
    for number in _route(label, group, samples, cells):
        members = np.flatnonzero(group == number)
        faces = np.unique(samples.face[np.concatenate([members, samples.other[np.isin(samples.one, members)]])])
        closer = sampled(smaller, faces, FINE)
        its_label = labels(larger, smaller, closer)
        its_group = _groups(its_label, closer)
        route = _route(its_label, its_group, closer, cells)
        chosen = np.flatnonzero(np.isin(its_group, route) if route else its_group >= 0)
        some = chosen[:: -(-len(chosen) // MOST) or 1].astype(np.int32)
        bottleneck = _narrowest(smaller, closer, some, checker)
        result += [] if bottleneck is None else [bottleneck]
    return tuple(result)


def sampled(space: FreeSpace, faces: Ints, n: int) -> Samples:
    """Return samples on some faces of a space's surfaces."""
    surfaces, table, cells = space.surfaces, space.surfaces.trapezoids, space.complex
    share = (np.arange(n) + 0.5) / n
    face = np.repeat(faces, n * n).astype(np.int32)
    theta = table.theta_from[face] + np.tile(share, n * len(faces)) * (table.theta_to - table.theta_from)[face]
    lower, upper = surfaces.limits(face, theta)
    t = lower + np.tile(np.repeat(share, n), len(faces)) * (upper - lower)
    first = np.full(len(cells.component), -1, np.int64)
    first[faces] = np.arange(len(faces)) * n * n
    place = np.arange(n * n).reshape(n, n)
    steps = ((place[:-1], place[1:]), (place[:, :-1], place[:, 1:]))
    inner = np.concatenate([np.column_stack([p.ravel(), q.ravel()]) for p, q in steps])
    # every sample along a coedge is a neighbour of every sample along its twin
    at_side = np.stack([place[:, 0], place[-1], place[:, -1], place[0]])
    coedge = np.flatnonzero((first[cells.face] >= 0) & (first[cells.face[cells.twin]] >= 0))
    mine, theirs = (first[cells.face[h]][:, None] + at_side[cells.side[h]] for h in (coedge, cells.twin[coedge]))
    across = np.stack(np.broadcast_arrays(mine[:, :, None], theirs[:, None, :]), axis=-1)
    pairs = np.concatenate([(first[faces][:, None, None] + inner).reshape(-1, 2), across.reshape(-1, 2)])
    one, other = np.concatenate([pairs, pairs[:, ::-1]]).T.astype(np.int32)
    return Samples(face, t, theta, one, other)


def labels(larger: FreeSpace, smaller: FreeSpace, samples: Samples) -> Ints:
    """Return the cell of the larger robot that each sample bounds, or COVERED."""
    ours, theirs = smaller.surfaces, larger.surfaces
    patch = ours.trapezoids.patch[samples.face]
    contacts = [np.stack([b.contact_kind, b.contact_robot, b.contact_obstacle], axis=1) for b in (ours, theirs)]
    number = {contact: k for k, contact in enumerate(map(tuple, contacts[1].tolist()))}
    same = np.array([number.get(contact, -1) for contact in map(tuple, contacts[0].tolist())])[patch]
    count = np.where(same >= 0, theirs.patch_start[same + 1] - theirs.patch_start[same], 0)
    sample = np.repeat(np.arange(len(patch)), count)
    place = np.arange(len(sample)) - np.repeat(np.cumsum(count) - count, count)
    trapezoid = (theirs.patch_start[same[sample]] + place).astype(np.int32)
    table, theta, t = theirs.trapezoids, samples.theta[sample], samples.t[sample]
    there = (table.theta_from[trapezoid] <= theta) & (theta <= table.theta_to[trapezoid])
    sample, trapezoid, theta, t = sample[there], trapezoid[there], theta[there], t[there]
    lower, upper = theirs.limits(trapezoid, theta)
    within = (lower <= t) & (t <= upper)
    label = np.full(len(patch), COVERED, np.int32)
    label[sample[within]] = larger.cell_of[larger.component[trapezoid[within]]]
    return label


def _groups(label: Ints, samples: Samples) -> Ints:
    """Number the candidates: connected covered samples, and samples beside ones that bound another cell."""
    covered = label == COVERED
    number = np.where(covered, np.arange(len(label)), -1).astype(np.int32)
    both = covered[samples.one] & covered[samples.other]
    one, other = samples.one[both], samples.other[both]
    while True:
        before = number.copy()
        np.minimum.at(number, one, number[other])
        number = np.where(covered, number[number], -1).astype(np.int32)
        if np.array_equal(number, before):
            break
    a, b = label[samples.one], label[samples.other]
    beside = (a >= 0) & (b >= 0) & (a != b)
    pair = np.minimum(a, b)[beside] * (int(label.max(initial=0)) + 1) + np.maximum(a, b)[beside]
    number[samples.one[beside]] = len(label) + pair
    return number


def _route(label: Ints, group: Ints, samples: Samples, cells: list[int]) -> list[int]:
    """Return the candidates on the shortest route from one cell to another."""
    links = np.column_stack([group[samples.one], label[samples.other]])
    links = np.concatenate([links, np.column_stack([group, label])])
    around: dict[tuple[str, int], list[tuple[str, int]]] = defaultdict(list)
    for number, cell in np.unique(links[(links >= 0).all(axis=1)], axis=0).tolist():
        around["bottleneck", number].append(("cell", cell))
        around["cell", cell].append(("bottleneck", number))
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
        route += [place[1]] if place[0] == "bottleneck" else []
        place = came[place]
    return route[::-1]


def _narrowest(space: FreeSpace, samples: Samples, chosen: Ints, checker: MotionChecker) -> Bottleneck | None:
    """Return the bottleneck halfway along the shortest push of a sample into the free side, up to a contact."""
    surfaces, theta = space.surfaces, samples.theta[chosen]
    patch = surfaces.trapezoids.patch[samples.face[chosen]]
    xy = surfaces.evaluate(patch, samples.t[chosen], theta)
    u, v = (
        surfaces.evaluate(patch, np.ones(len(patch)), theta) - surfaces.evaluate(patch, np.zeros(len(patch)), theta)
    ).T
    owner = surfaces.features.obstacles.owner_polygon[surfaces.contact_obstacle[patch]]
    best: tuple[float, Bottleneck] | None = None
    push = np.column_stack([v, -u]) * float(np.ptp(surfaces.features.robot.xy, axis=0).max()) / np.hypot(u, v)[:, None]
    rows = zip(xy.tolist(), theta.tolist(), push.tolist(), owner.tolist(), strict=True)
    for (x, y), angle, (dx, dy), obstacle in rows:
        met = checker.first_contact(Pose(x + NUDGE * dx, y + NUDGE * dy, angle), Translation((dx, dy)))
        if met is None or not (share := float(met.at)) > 0:
            continue
        if best is None or share < best[0]:
            both = obstacle, met.obstacle
            names = placed(surfaces.scene, obstacle), placed(surfaces.scene, met.obstacle)
            best = share, Bottleneck(Pose(x + share / 2 * dx, y + share / 2 * dy, angle), both, names)
    return best and best[1]
