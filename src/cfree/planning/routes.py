"""Routes across many obstacles: from room to room through portals, then exact motions in each room alone.

A route is a guess: a room may not lead from one portal to the next. Then the search goes on without that step. Motions
are planned among all obstacles that the robot can touch in a room, with the room as bounds. So they are free among all.
"""

from __future__ import annotations

import heapq
import math
import os
import threading
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeVar

import numpy as np

from cfree.collision.motion import Motion
from cfree.collision.motion_checker import MotionChecker
from cfree.errors import InvariantError
from cfree.exact.pose import Pose
from cfree.paths.numbering import renumbered
from cfree.paths.path import Path
from cfree.planning.atlas import Atlas
from cfree.planning.options import Options
from cfree.planning.portals import THETAS, Ground, Key, Portal
from cfree.planning.rooms import Box, Ints
from cfree.planning.separation import Separated
from cfree.planning.steps import step_planner
from cfree.scene.frame import frame_of

START, GOAL = (-1, -1, 0), (-1, -1, 1)  # ends of a route, beside the keys of portals
HASTE = 1.2  # factor of the straight distance to the goal: a route is at most this much longer than the shortest
WINDOW = 3  # steps improved together
KEPT = 10_000  # steps whose motions are kept between queries
FAILURES = 30  # most steps that rooms refuse, before routes are given up
MANY = 2_000  # portals settled before the search looks if the goal can be left at all
DISTANT = 40  # radii of the robot
POLL = 0.1  # seconds

Result = TypeVar("Result")


@dataclass(frozen=True, eq=False)
class Step:
    """A part of a route, between two portals of a room, or to an end.

    Attributes
    ----------
    ends : two keys
    start, goal : Pose
    room : int
    box : four floats
        The reference point stays in it.
    obstacles : array of int
        All that the robot may touch there.
    """

    ends: tuple[Key, Key]
    start: Pose
    goal: Pose
    room: int
    box: Box
    obstacles: Ints


@dataclass(frozen=True, eq=False)
class Leg:
    """A part of a path.

    Attributes
    ----------
    box : four floats
        The reference point stays in it.
    obstacles : array of int
        All that the robot may touch there.
    motions : tuple of motions
    """

    box: Box
    obstacles: Ints
    motions: tuple[Motion, ...]


class Router:
    """Routes from one pose to another.

    Parameters
    ----------
    atlas : Atlas
    start, goal : Pose
    options : Options
    """

    def __init__(self, atlas: Atlas, start: Pose, goal: Pose, options: Options) -> None:
        self.atlas, self.options = atlas, options
        self._ends = {START: start, GOAL: goal}
        self._places = {key: (float(pose.x), float(pose.y), pose.theta) for key, pose in self._ends.items()}
        self._rooms = {key: atlas.rooms.meeting((x, y, x, y)) for key, (x, y, _) in self._places.items()}
        self._banned: set[tuple[Key, Key]] = set()
        self._own: dict[tuple[Key, Key, int], tuple[Motion, ...]] = {}  # motions from the start, and to the goal

    @property
    def is_far(self) -> bool:
        """True if both ends are in rooms, and the goal is not near the start."""
        if not all(self._rooms.values()):
            return False
        x0, y0, x1, y1 = self._area(START)
        x, y, _ = self._places[GOAL]
        return not (x0 <= x <= x1 and y0 <= y <= y1)

    def legs(self, prove: Callable[[], Separated | None]) -> list[Leg] | Separated | None:
        """Legs of a path that are free among all obstacles; None if no route, or none of the first, gives one.

        Parameters
        ----------
        prove : callable
            Called once, after a room of an end has refused a step: returns a proof that the ends are separated, which
            is the result then, or None.
        """
        refused, is_tried = 0, False
        if len(self.atlas.ways) > KEPT:
            self.atlas.ways.clear()
        while refused <= FAILURES:
            steps = self.route()
            if steps is None:
                return None
            at_ends = [step for step in steps if START in step.ends or GOAL in step.ends]
            if self._refused(at_ends):
                refused += 1
                if not is_tried and (proof := prove()) is not None:
                    return proof
                is_tried = True
                continue
            count = self._refused(steps)
            refused += count
            if not count:
                return [Leg(step.box, step.obstacles, self._known(step) or ()) for step in steps]
        return None

    def _refused(self, steps: Sequence[Step]) -> int:
        """Plan the motions of steps, and ban those that their rooms refuse; return their number."""
        waiting = [step for step in steps if self._known(step) is None]
        done = in_threads([partial(self._motions, step) for step in waiting], self.options)
        for step, motions in zip(waiting, done, strict=True):
            if motions is None:
                self._banned |= {step.ends, step.ends[::-1]}
            else:
                known = self._own if START in step.ends or GOAL in step.ends else self.atlas.ways
                known[*step.ends, step.room] = motions
        return sum(motions is None for motions in done)

    def route(self) -> list[Step] | None:
        """Steps of a short route; None if there is none."""
        best: dict[Key, float] = {START: 0.0}
        before: dict[Key, tuple[Key, int]] = {}
        portals: dict[Key, Portal] = {}
        goal = self._places[GOAL]
        waiting: list[tuple[float, Key]] = [(0.0, START)]
        settled: set[Key] = set()
        limit = MANY
        while waiting:
            _, key = heapq.heappop(waiting)
            if key == GOAL:
                return self._steps(before, portals)
            if key in settled:
                continue
            settled.add(key)
            if len(settled) > limit:
                if self._is_shut(limit):
                    return None
                limit *= 2
            here = self._places[START] if key == START else _place(portals[key])
            for room in self._rooms[START] if key == START else key[:2]:
                entry = self.atlas.entry(room)
                for portal in entry.portals if key == START else entry.beside(key):
                    portals.setdefault(portal.key, portal)
                    self._consider(best, before, waiting, key, here, portal.key, _place(portal), room)
                if room in self._rooms[GOAL] and key != START:
                    self._consider(best, before, waiting, key, here, GOAL, goal, room)
        return None

    def _is_shut(self, most: int) -> bool:
        """True if at most so many portals lead to the goal, and not from the start."""
        reached, waiting = set[Key](), [GOAL]
        while waiting:
            key = waiting.pop()
            for room in self._rooms[GOAL] if key == GOAL else key[:2]:
                if room in self._rooms[START]:
                    return False
                entry = self.atlas.entry(room)
                for portal in entry.portals if key == GOAL else entry.beside(key):
                    if portal.key not in reached and (key, portal.key) not in self._banned:
                        reached.add(portal.key)
                        waiting.append(portal.key)
            if len(reached) > most:
                return False
        return True

    def _consider(
        self,
        best: dict[Key, float],
        before: dict[Key, tuple[Key, int]],
        waiting: list[tuple[float, Key]],
        key: Key,
        here: tuple[float, float, float],
        other: Key,
        there: tuple[float, float, float],
        room: int,
    ) -> None:
        cost = best[key] + self._cost(here, there)
        if cost < best.get(other, math.inf) and (key, other) not in self._banned:
            best[other], before[other] = cost, (key, room)
            goal = self._places[GOAL]
            heapq.heappush(waiting, (cost + HASTE * math.hypot(there[0] - goal[0], there[1] - goal[1]), other))

    def _cost(self, here: tuple[float, float, float], there: tuple[float, float, float]) -> float:
        """Distance, with the turn as travel of the robot's radius; one radius more for each step."""
        turn = abs(here[2] - there[2])
        radius = self.atlas.ground.radius
        return math.hypot(here[0] - there[0], here[1] - there[1]) + radius * (1 + min(turn, 2 * math.pi - turn))

    def _steps(self, before: dict[Key, tuple[Key, int]], portals: dict[Key, Portal]) -> list[Step]:
        poses = {key: portal.pose for key, portal in portals.items() if key in before} | self._ends
        steps: list[Step] = []
        key = GOAL
        while key != START:
            previous, room = before[key]
            is_end = key == GOAL or previous == START
            box = self._area(GOAL if key == GOAL else START) if is_end else self.atlas.rooms.box(room)
            near = self.atlas.ground.near(box)
            steps.append(Step((previous, key), poses[previous], poses[key], room, box, near))
            key = previous
        return steps[::-1]

    def _area(self, end: Key) -> Box:
        """Box around the rooms of an end, with half as much around them."""
        boxes = [self.atlas.rooms.box(room) for room in self._rooms[end]]
        x0, y0 = (min(box[k] for box in boxes) for k in (0, 1))
        x1, y1 = (max(box[k] for box in boxes) for k in (2, 3))
        rim = max(x1 - x0, y1 - y0) / 2
        return x0 - rim, y0 - rim, x1 + rim, y1 + rim

    def _known(self, step: Step) -> tuple[Motion, ...] | None:
        key = (*step.ends, step.room)
        return self._own.get(key) or self.atlas.ways.get(key)

    def _motions(self, step: Step, options: Options) -> tuple[Motion, ...] | None:
        """Motions of a step; None if its room does not allow it, or that is not decided in a few patches."""
        planner = step_planner(self.atlas.ground.part(step.obstacles, step.box))
        path = planner.path(step.start, step.goal, options)
        return None if path is None else renumbered(path, step.obstacles.tolist()).motions


def legs_along(
    atlas: Atlas, start: Pose, goal: Pose, options: Options, prove: Callable[[], Separated | None]
) -> list[Leg] | Separated | None:
    """Legs of a route, improved if there is no vehicle, or a proof; None without either, or if the goal is near."""
    router = Router(atlas, start, goal, replace(options, vehicle=None))
    legs = router.legs(prove) if router.is_far else None
    if not isinstance(legs, list) or options.vehicle is not None:
        return legs
    return improved(start, legs, atlas.ground, options)


def _place(portal: Portal) -> tuple[float, float, float]:
    return portal.x, portal.y, float(THETAS[portal.turn])


def improved(start: Pose, legs: Sequence[Leg], ground: Ground, options: Options) -> list[Leg]:
    """Improve a path, some legs at a time among their own obstacles: in groups, then across their ends, then in pairs.

    Ctrl-C ends it without a result, or with a result if there is a limit of time.
    """
    done, rounds = list(legs), (_in_groups, _across, _in_pairs)
    if options.improve == 0:
        return done
    count = -(-len(legs) // WINDOW)
    share = options.improve and options.improve * (os.cpu_count() or 1) / (len(rounds) * count)
    with options.phase("shorter paths"):
        for group in rounds:
            done, is_over = _improved(start, group(done), ground, replace(options, improve=share), options)
            if is_over:
                break
    return done


def _in_groups(legs: Sequence[Leg]) -> list[Sequence[Leg]]:
    return [legs[k : k + WINDOW] for k in range(0, len(legs), WINDOW)]


def _in_pairs(legs: Sequence[Leg]) -> list[Sequence[Leg]]:
    return [legs[k : k + 2] for k in range(0, len(legs), 2)]


def _across(legs: Sequence[Leg]) -> list[Sequence[Leg]]:
    """Second half of each leg with the first of the next."""
    halves = [half for leg in legs for half in _halves(leg)]
    return [halves[:1], *_in_pairs(halves[1:])]


def _halves(leg: Leg) -> tuple[Leg, Leg]:
    middle = len(leg.motions) // 2
    return replace(leg, motions=leg.motions[:middle]), replace(leg, motions=leg.motions[middle:])


def _improved(
    start: Pose, groups: Sequence[Sequence[Leg]], ground: Ground, own: Options, options: Options
) -> tuple[list[Leg], bool]:
    """One leg for each group, improved; True if Ctrl-C has ended that."""
    joined, paths = list[Leg](), list[Path]()
    for group in groups:
        lows, highs = ([leg.box[k : k + 2] for leg in group] for k in (0, 2))
        box = (*map(min, zip(*lows, strict=True)), *map(max, zip(*highs, strict=True)))
        joined.append(Leg(box, ground.near(box), tuple(motion for leg in group for motion in leg.motions)))
        paths.append(Path(start, joined[-1].motions))
        start = paths[-1].goal
    done = list(joined)

    def improve(k: int, options: Options) -> None:
        planner = step_planner(ground.part(joined[k].obstacles, joined[k].box))
        done[k] = replace(joined[k], motions=planner.improved(paths[k], options).motions)

    try:
        in_threads([partial(improve, k) for k in range(len(joined)) if joined[k].motions], own)
    except KeyboardInterrupt:
        if not options.improve or options.stop.is_set():
            raise
        return done, True
    return done, False


def is_distant(start: Pose, goal: Pose, radius: float) -> bool:
    """True if a route may be of use: the goal is many radii of the robot away from the start."""
    return math.hypot(start.x - goal.x, start.y - goal.y) > DISTANT * radius


def joined(start: Pose, legs: Sequence[Leg], ground: Ground) -> tuple[Path, list[int]]:
    """Path of legs, checked as a whole among all obstacles that the robot may touch on them, and their numbers.

    Its scene has these obstacles, in this order.

    Raises
    ------
    InvariantError
        If it is not free: a fault of cfree.
    """
    numbers = np.unique(np.concatenate([leg.obstacles for leg in legs]))
    scene, place = ground.part(numbers, None), {number: k for k, number in enumerate(numbers.tolist())}
    motions = [motion for leg in legs for motion in leg.motions]
    plain, curved = (None, scene) if scene.curved else (scene, None)
    path = renumbered(Path(start, motions, scene.units, frame_of(scene), scene=plain, curved=curved), place)
    if not path.is_free(MotionChecker(scene)):
        raise InvariantError("a path from room to room is not free", state=path)
    return path, numbers.tolist()


def in_threads(tasks: Sequence[Callable[[Options], Result]], options: Options) -> list[Result]:
    """Results of tasks, on all cores, in their order; Ctrl-C ends them all."""
    if len(tasks) < 2:
        return [task(options) for task in tasks]
    own = replace(options, stop=threading.Event(), phase=nullcontext, progress=None)

    def ran(task: Callable[[Options], Result]) -> Result:
        if own.stop.is_set():
            raise KeyboardInterrupt
        return task(own)

    from concurrent.futures import ThreadPoolExecutor, wait

    with ThreadPoolExecutor(min(len(tasks), os.cpu_count() or 1)) as pool:
        futures = [pool.submit(ran, task) for task in tasks]
        try:
            while wait(futures, POLL).not_done:
                if options.stop.is_set():
                    raise KeyboardInterrupt
        except KeyboardInterrupt:
            own.stop.set()
            raise
    return [future.result() for future in futures]
