"""Paths of cars and differential drives: holonomic paths followed by exact words, and shortened.

In one cell of the free space every two poses that touch nothing are joined by a vehicle that reverses. So a path of the
robot, moving in any direction, decides the question; halved often enough, its parts are driven by words that end
exactly at their goal. Where start or goal touches something, its first motions decide; where the robot fits exactly,
the motions along its contacts. A car without reverse gear has a path if a search gives one, and none if boxes of poses
that hold all it can reach do not hold the goal. docs/theory/vehicles.md has the proofs.
"""

from __future__ import annotations

import math
import os
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache, cached_property
from itertools import chain, count, islice, pairwise
from typing import Any

import cfree._core as _core
from cfree.collision.motion import Motion, joining
from cfree.collision.motion_checker import MotionChecker
from cfree.errors import InvalidPoseError, InvariantError, UndecidedError
from cfree.exact.pose import Pose
from cfree.paths.driving import is_drivable
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import NONE, Dues, Preferences, dues_of, robot_length
from cfree.planning.clearance import plan_at_distance
from cfree.planning.core_ways import end_of, from_numbers
from cfree.planning.first_motions import Touching
from cfree.planning.improving import Improver
from cfree.planning.options import Options
from cfree.planning.pose_planner import PosePlanner
from cfree.planning.rails import Explored, Way, explore, reversed_way
from cfree.planning.reach import Reach
from cfree.planning.round_contacts import tried_ways_out
from cfree.planning.stuck import Stuck
from cfree.planning.unreachable import Unreachable, margin_of
from cfree.scene.frame import frame_of
from cfree.scene.scene import Scene
from cfree.vehicles.vehicle import Car, Vehicle, described

WORDS = 40_000  # most words tried to follow one path, for each share
WORDS_AT_ONCE = (600, 1000, WORDS)  # the same for one path after the other, if none is improved
SHARES: dict[Objective, tuple[float, ...]] = {
    "balanced": (0.5, 0.25, 0.125, 0.0),
    "short": (0.0,),
    "clear": (0.75, 0.5, 0.25, 0.125, 0.0),
}
CAP = 1 / 20  # of the robot's length: the most distance that is asked
ROUNDS = 800  # attempts to shorten each way, before the dearer half of the ways is left out
SEEDS = 3  # random numbers for each path that is followed
IDLE = 400  # attempts without gain that end this
BLOCK = 50  # attempts between two checks of the clock
GUIDED = Preferences(sideways=10, turning=3)  # of a path that is easily driven
GUESSES = 5000  # of a search for another path of the robot
IN_BOXES = 200_000  # motions looked at for a way without reverse gear, at each fineness of the boxes
POSES, SEARCHES = 8000, 3  # of a search for one by two trees
MANY_CUSPS = 4  # a path with more is compared with one that keeps less of the distance,
MOST_DEARER = 1.5  # and left for it if it costs so many times as much
FEW_CUSPS = 1  # a path with no more needs no other guide
ROOMS = (4, 6, 8, 12, 16, 20, 24)  # binary exponents of a clearance that keeps a path off contacts, in robot radii
PLACES = (Fraction(0), Fraction(1, 3), Fraction(1, 2), Fraction(2, 3))  # on a motion, at which contacts are looked for
FAR = 100  # robot's lengths: an axle point farther away is probably a mistake, and so is a greater turning radius
LEAST_RADIUS = Fraction(1, 2**20)  # robot's lengths: a sharper car takes no sharper arcs, which doubles would blur
MOST_PAIRS = 16  # pairs of ways out that are tried to be joined


@dataclass(frozen=True)
class Question:
    """A vehicle in a scene.

    Attributes
    ----------
    planner : PosePlanner
        A planner for the robot that moves in any direction.
    known : KnownScene
        The core's data about its scene.
    vehicle : Vehicle
    options : Options
        Those of the query, without the vehicle.
    enough : Event
        Set by Ctrl-C: the path found so far will do.
    """

    planner: PosePlanner
    known: _core.KnownScene
    vehicle: Vehicle
    options: Options
    enough: threading.Event = field(default_factory=threading.Event)

    @property
    def scene(self) -> Scene:
        """The scene of the planner."""
        return self.planner.scene

    @property
    def checker(self) -> MotionChecker:
        """Checker of motions in the scene."""
        return self.planner.checker

    @cached_property
    def dues(self) -> Dues:
        """The costs of driving."""
        return dues_of(self.options.preferences, self.scene, self.vehicle)

    @cached_property
    def onward(self) -> Touching:
        """Contacts at a start."""
        return Touching(self.scene, self.vehicle, (1,) if self.vehicle.gears == "forward" else (1, -1))

    @cached_property
    def back(self) -> Touching:
        """Contacts at a goal, which is left backwards in time."""
        return Touching(self.scene, self.vehicle, (-1,) if self.vehicle.gears == "forward" else (1, -1))

    def touches(self, pose: Pose) -> bool:
        """True if the robot touches something at a free pose."""
        x0, y0, x1, y1 = self.scene.bounds or (pose.x - 1, pose.y - 1, pose.x + 1, pose.y + 1)
        is_certainly_apart = _driving(self, [pose], 0.0, "short").distance > 0 and x0 < pose.x < x1 and y0 < pose.y < y1
        return not is_certainly_apart and (self.planner.is_among_arcs or bool(self.onward.pairs(pose)))


def drive_along(
    planner: PosePlanner, known: _core.KnownScene, vehicle: Vehicle, options: Options, way: Sequence[Pose]
) -> Path | Stuck | Unreachable:
    """Return a path of a vehicle between the ends of a path of the robot, or a proof that there is none."""
    return joined(Question(planner, known, vehicle, options), way[0], way[-1], way)


def joined(question: Question, start: Pose, goal: Pose, way: Sequence[Pose]) -> Path | Stuck | Unreachable:
    """Return a path of the vehicle between two poses that a path of the robot joins; or a proof that there is none.

    Raises
    ------
    UndecidedError
        If contacts leave the question open, or the path needs too many manoeuvres: then it exists, and the error has it
        as a path of the robot that touches nothing.
    """
    if start == goal:
        return _checked(question, start, ())
    begin = _ways_out(question, start, "start", goal)
    if isinstance(begin, Explored) and goal in begin.rail:
        return _checked(question, start, begin.ways[begin.rail.index(goal)])
    end = _ways_out(question, goal, "goal", start)
    for name, found in (("start", begin), ("goal", end)):
        if isinstance(found, Explored) and not found.exits:
            return _stuck(question, start, goal, name, found)
    outs = begin.exits if isinstance(begin, Explored) else (((), start),)
    ins = end.exits if isinstance(end, Explored) else (((), goal),)
    pairs = [(out, into) for out in outs for into in ins][:MOST_PAIRS]
    undecided: UndecidedError | None = None
    reach = _reach(question, start, goal)
    for (before, first), (after, last) in pairs:
        its = way if not before and not after else question.planner.way(first, last, question.options)
        if not isinstance(its, list):
            continue
        try:
            middle = _at_once(question, its) or _in_room(question, first, last, its, reach)
        except UndecidedError as error:  # another way out may have more room
            undecided = undecided or error
            continue
        if middle is None:
            continue
        if isinstance(middle, Unreachable) or (not before and not after):
            return middle
        return _checked(question, start, (*before, *middle.motions, *reversed_way(after)))
    if undecided is not None:
        raise undecided
    for level in reach.levels() if reach is not None else ():
        if level.proof is not None:
            return level.proof
    if question.vehicle.gears == "both":
        links = _links(question, way)
        for (before, first), (after, last) in pairs:
            if (through := _through_fits(question, first, last, links)) is not None:
                return _checked(question, start, (*before, *through, *reversed_way(after)))
    what = described(question.vehicle)
    raise UndecidedError(f"the robot gets there only along contacts, and no way of {what} along them was found")


def _reach(question: Question, start: Pose, goal: Pose) -> Reach | None:
    """Return the boxes between two poses for a car without reverse gear."""
    car = question.vehicle
    return Reach(question.scene, car, start, goal) if isinstance(car, Car) and car.gears == "forward" else None


def _in_room(
    question: Question, start: Pose, goal: Pose, way: list[Pose], reach: Reach | None
) -> Path | Unreachable | None:
    """Return a path along one of the robot that touches nothing; None if start and goal are in different cells."""
    roomy = _roomy(question, start, goal, way)
    return None if roomy is None else driven(question, roomy, reach)


def _at_once(question: Question, way: list[Pose]) -> Path | None:
    """Return a path that is not improved and keeps no distance; None if none is found soon.

    It is along a first path of the robot, if few words suffice; else along that path pushed away from obstacles, which
    takes longer than few words and saves many; else along a balanced one.
    """
    if question.options.improve != 0 or question.options.objective == "clear":
        return None

    def along(guide: Sequence[Pose], words: int) -> Path | None:
        if not _is_roomy(question, guide):
            return None
        is_whole, _, drive = _driving(question, guide, 0.0, "short").follow(words, 0)
        if not is_whole:
            return None
        drive.join_far()
        return _path(question, drive)

    guides = chain([way], _improver(question, way, NONE).farther(way))
    found = (along(guide, words) for guide, words in zip(guides, WORDS_AT_ONCE, strict=False))
    return next((path for path in found if path is not None), None)


def _ways_out(question: Question, pose: Pose, name: str, other: Pose) -> Explored | None:
    """Return the ways of the vehicle off its contacts at an end; None if it touches nothing there.

    Raises
    ------
    UndecidedError
        If there is none, and some contacts could not be followed.
    """
    if not question.touches(pose):
        return None
    touching = question.onward if name == "start" else question.back
    if not question.planner.is_among_arcs:
        found, why = explore(touching, question.checker, pose, goal=other), "where it could leave is irrational"
    else:
        size, why = robot_length(question.scene, question.vehicle), "no first motion was found that leaves"
        gears, checker = touching.gears, question.checker
        found = tried_ways_out(question.vehicle, gears, checker, pose, other, size, question.touches)
    if not found.exits and not found.is_complete and other not in found.rail:
        raise UndecidedError(f"{name}: the robot touches something there, and {why}")
    return found


def _stuck(question: Question, start: Pose, goal: Pose, name: Any, found: Explored) -> Stuck:
    touching = question.onward if name == "start" else question.back
    pairs = [touching.pairs(pose) or [] for pose in found.rail]
    obstacles = sorted({pair.obstacle for its in pairs for pair in its})
    is_rigid = len(found.rail) == 1 and touching.is_rigid(pairs[0])
    of: Any = "paths" if is_rigid else "pieces"
    scene = question.scene
    context = scene.units, frame_of(scene), scene
    return Stuck(start, goal, question.vehicle, name, of, found.rail, tuple(obstacles), *context)


def _roomy(question: Question, start: Pose, goal: Pose, way: list[Pose]) -> Sequence[Pose] | None:
    """Return a path of the robot that touches nothing; None if start and goal are in different cells.

    Raises
    ------
    UndecidedError
        If it is too narrow for doubles.
    """
    guide = _guide(question, way, NONE)
    if _is_roomy(question, guide):
        return guide
    if question.planner.proof(start, goal, question.options) is not None:
        return None
    for exponent in ROOMS:
        clearance = Fraction(question.planner.angle_scale) / 2**exponent
        options = replace(question.options, clearance=clearance, improve=0.0, objective="balanced", exact_discs=False)
        try:
            answer = plan_at_distance(question.scene, start, goal, options)
        except (UndecidedError, InvalidPoseError):
            continue
        if isinstance(answer, Path) and _is_roomy(question, answer.poses):
            return answer.poses
    raise UndecidedError(
        f"a path of {described(question.vehicle)} exists, as start and goal are in one cell of the free space; "
        "its passages are too narrow to write it down"
    )


def _is_roomy(question: Question, way: Sequence[Pose]) -> bool:
    """True if a path keeps a distance, and its reference point is within the bounds."""
    x0, y0, x1, y1 = question.scene.bounds or (-math.inf, -math.inf, math.inf, math.inf)
    within = all(x0 < pose.x < x1 and y0 < pose.y < y1 for pose in way)
    return within and _driving(question, way, 0.0, "short").distance > 0


def _links(question: Question, way: Sequence[Pose]) -> list[Explored]:
    """Return what the vehicle can do at the touching poses of a path: ways out, into one cell or several."""
    found, seen = list[Explored](), set[Pose]()
    for a, b in pairwise(way):
        motion = joining(a, b)
        for place in PLACES:
            pose = motion.at(a, place)
            if pose in seen or not question.onward.pairs(pose):  # a slide is beside this motion, and may overlap
                continue
            explored = explore(question.onward, question.checker, pose)
            seen |= set(explored.rail)
            if len(explored.exits) > 1:
                found.append(explored)
    return found


def _through_fits(
    question: Question,
    start: Pose,
    goal: Pose,
    links: Sequence[Explored],
) -> Way | None:
    """Return motions between poses that touch nothing, from cell to cell along contacts; None if none is found."""
    cells = [start]

    def cell_of(pose: Pose) -> int:
        for k, known in enumerate(cells):
            if known == pose or question.planner.proof(known, pose, question.options) is None:
                return k
        cells.append(pose)
        return len(cells) - 1

    last = cell_of(goal)
    doors = [(out, into) for link in links for out in link.exits for into in link.exits if out is not into]
    named = [(cell_of(out[1]), cell_of(into[1]), out, into) for out, into in doors]
    chains: dict[int, tuple[Any, ...]] = {0: ()}
    todo = deque([0])
    while todo and last not in chains:
        here = todo.popleft()
        for first, second, out, into in named:
            if first == here and second not in chains:
                chains[second] = (*chains[here], (out, into))
                todo.append(second)
    if last not in chains:
        return None
    motions, at = list[Motion](), start
    for out, into in chains[last]:
        motions += [*_drive(question, at, out[1]), *reversed_way(out[0]), *into[0]]
        at = into[1]
    return (*motions, *_drive(question, at, goal))


def _drive(question: Question, start: Pose, goal: Pose) -> Way:
    """Return motions between poses of one cell that touch nothing."""
    way = [start] if start == goal else question.planner.way(start, goal, question.options)
    roomy = _roomy(question, start, goal, way) if isinstance(way, list) and len(way) > 1 else None
    path = driven(question, roomy) if roomy else None
    return path.motions if isinstance(path, Path) else ()


def _checked(question: Question, start: Pose, motions: Way, poses: Sequence[Pose] | None = None) -> Path:
    """Return the path, with every motion checked again; `poses` are those that the motions join.

    Raises
    ------
    InvariantError
        If a motion is not free, or cannot be driven: a fault of cfree.
    """
    path = _path_of(question, start, motions, question.vehicle)
    if poses is not None:
        path.__dict__["poses"] = tuple(poses)
    if not path.is_free(question.checker):
        raise InvariantError("a path is not free", state=path)
    answer = is_drivable(path, question.vehicle)
    if not answer:
        raise InvariantError(f"motion {answer.motion} of a path cannot be driven: {answer.why}", state=path)
    return path


def _path_of(question: Question, start: Pose, motions: Sequence[Motion], vehicle: Vehicle | None = None) -> Path:
    scene = question.scene
    return Path(start, motions, scene.units, frame_of(scene), scene=scene, vehicle=vehicle)


def driven(question: Question, way: Sequence[Pose], reach: Reach | None = None) -> Path | Unreachable:
    """Return a path of the vehicle near a path of the robot, given by its poses, which touches nothing at its ends.

    A car without reverse gear may have none: then `reach` is what the proof comes from.

    Raises
    ------
    UndecidedError
        If the budget of words does not suffice: the path exists, and the error has an estimate of its manoeuvres. Or if
        neither a path nor a proof was found for a car without reverse gear.
    """
    improve, shares = question.options.improve, SHARES[question.options.objective]
    begin = time.perf_counter()
    end = begin + improve if improve else math.inf
    easily = cache(lambda: _guide(question, way, GUIDED))
    found = _best(question, way, easily, shares, begin, _middle(begin, end), reach)
    if isinstance(found, Unreachable):
        return found
    drive, share = found
    while improve != 0 and drive.cusps > MANY_CUSPS and share > 0 and not question.enough.is_set():
        now = time.perf_counter()
        with suppress(UndecidedError):  # less of the distance may save changes of direction
            nearer = _best(question, way, easily, [s for s in shares if s < share], now, _middle(now, end))
            if not isinstance(nearer, Unreachable) and _cost(drive) > MOST_DEARER * _cost(nearer[0]):
                drive, share = nearer
                continue
        break
    stop = question.options.stop
    with suppress(KeyboardInterrupt):  # there is a path already
        while time.perf_counter() < end < math.inf and not (question.enough.is_set() or stop.is_set()):
            drive.run(BLOCK)
    if stop.is_set():
        raise KeyboardInterrupt
    return _path(question, drive)


def _middle(begin: float, end: float) -> float:
    return begin + (end - begin) / 2


def _best(
    question: Question,
    way: Sequence[Pose],
    easily: Callable[[], Sequence[Pose]],
    shares: Sequence[float],
    begin: float,
    end: float,
    reach: Reach | None = None,
) -> tuple[_core.Drive, float] | Unreachable:
    """Return the cheapest shortened words along a path that keep one of some shares of its distance; and the share.

    They also follow `easily`, a path beside it that is easily driven.

    Raises
    ------
    UndecidedError
        As `driven`.
    """
    improve, objective = question.options.improve, question.options.objective
    drives, guides, shortfalls = list[_core.Drive](), list[tuple[Sequence[Pose], float]](), list[tuple[float, int]]()
    for is_first in (True, False):
        guide = way if is_first else easily()
        drive, share, reached = _followed(question, guide, shares)
        if drive is None:
            shortfalls.append(reached)
            continue
        drives.append(drive)
        guides.append((guide, share))
        if improve == 0 or drive.cusps <= FEW_CUSPS:
            break
    most = max((share for _, share in guides), default=0.0)
    if not drives and reach is not None:
        searched = _searched(question, way, reach)
        if isinstance(searched, Unreachable):
            return searched
        drives.append(searched)
    if not drives:
        raise _too_many(question, way, max(shortfalls))
    if improve == 0:
        for drive in drives:
            drive.join_far()
        return min(drives, key=_cost), most

    def further() -> Iterator[_core.Drive]:
        """Yield further words along the same paths, to be shortened with other random numbers; and along others."""
        for seed in count(1) if improve else range(1, SEEDS):
            if time.perf_counter() > end:
                return
            for guide, share in guides:
                is_whole, _, drive = _driving(question, guide, share, objective).follow(WORDS, seed)
                if is_whole:
                    yield drive
            other = _other_way(question, way, seed) if improve and guides else None
            new = _followed(question, other, shares)[0] if other else None
            if new is not None:
                yield new

    is_simple = max(drive.cusps for drive in drives) == 0
    others = iter(()) if is_simple else further()
    return min(_shortened(question, drives, others, begin, end), key=_cost), most


def _searched(question: Question, way: Sequence[Pose], reach: Reach) -> _core.Drive | Unreachable:
    """Return a way of a car without reverse gear, by searches in finer and finer boxes, then by two trees; or a proof.

    Raises
    ------
    UndecidedError
        If none of them gives one, with what the boxes leave open.
    """
    driving = _driving(question, way, 0.0, "short")
    grid = None
    for level in reach.levels():
        if level.proof is not None:
            return level.proof
        if (drive := driving.search_in_boxes(level.back, IN_BOXES)) is not None:
            return drive
        grid = level.grid
    for seed in range(SEARCHES):
        if (drive := driving.search_forward(seed, POSES)) is not None:
            return drive
    assert grid is not None, "there are boxes"
    margin = margin_of(grid, reach.touching.reach)
    raise UndecidedError(
        f"no path of {described(question.vehicle)} was found, and none is excluded: boxes with sides of "
        f"{float(grid.side):.3g}, in which a robot smaller by up to {margin:.3g} counts, may lead to the goal; with a "
        "reverse gear there is a path: give gears='both', and a high cost of going backward instead",
        margin=margin,
    )


def _shortened(
    question: Question, drives: list[_core.Drive], others: Iterator[_core.Drive], begin: float, end: float
) -> list[_core.Drive]:
    """Shorten ways on all cores, then the cheaper half of them, and so on.

    The result does not depend on the number of cores, unless there is a time at which it ends: then further ways are
    tried in half of it, and the best one has the rest. Ctrl-C ends it early.
    """
    half, stop, enough = begin + (end - begin) / 2, question.options.stop, question.enough
    # several cores only if called in the main thread: other threads share the cores already
    cores = os.cpu_count() or 1 if threading.current_thread() is threading.main_thread() else 1

    def work(drive: _core.Drive, until: float) -> None:
        for _ in range(ROUNDS // BLOCK):
            if stop.is_set():
                raise KeyboardInterrupt
            if enough.is_set() or time.perf_counter() > until or drive.without_gain > IDLE:
                return
            drive.run(BLOCK)

    def run(drive: _core.Drive) -> None:
        drive.join_far()
        work(drive, half)

    with ThreadPoolExecutor(cores) as pool:
        try:
            list(pool.map(run, drives))
            while time.perf_counter() < half and (batch := list(islice(others, cores if end < math.inf else None))):
                list(pool.map(run, batch))
                drives = drives + batch
            while len(drives) > 1:
                drives = sorted(drives, key=_cost)[: len(drives) // 2]
                list(pool.map(lambda drive: work(drive, end), drives))
            while time.perf_counter() < end < math.inf and not stop.is_set():
                drives[0].run(BLOCK)
        except KeyboardInterrupt:  # there is a path already
            enough.set()
    if stop.is_set():
        raise KeyboardInterrupt
    return drives


def _cost(drive: _core.Drive) -> float:
    return float(drive.cost)


def _guide(question: Question, way: Sequence[Pose], preferences: Preferences) -> Sequence[Pose]:
    """Return a balanced path of the robot beside this one, by preferences."""
    return _improver(question, way, preferences).balanced_once(way)


def _improver(question: Question, way: Sequence[Pose], preferences: Preferences) -> Improver:
    """Return an improver of a path of the robot; preferences count at the vehicle's axle."""
    return question.planner.improver(way, replace(question.options, preferences=preferences, vehicle=question.vehicle))


def _other_way(question: Question, way: Sequence[Pose], seed: int) -> Sequence[Pose] | None:
    """Search for another path of the robot that touches nothing; None if none is found soon."""
    searcher = question.planner.improver(way, replace(question.options, preferences=GUIDED)).searcher
    found = searcher.search(end_of(way[0]), end_of(way[-1]), seed).run(GUESSES)
    if not found:
        return None
    guide = _guide(question, [*map(from_numbers, found)], GUIDED)
    return guide if _is_roomy(question, guide) else None


def _followed(
    question: Question, guide: Sequence[Pose], shares: Sequence[float]
) -> tuple[_core.Drive | None, float, tuple[float, int]]:
    """Follow a path with the greatest share of its distance that works; None, and the share of the path done."""
    best = (0.0, 0)
    for share in shares:
        is_whole, reached, drive = _driving(question, guide, share, question.options.objective).follow(WORDS, 0)
        if is_whole:
            return drive, share, (1.0, 0)
        best = max(best, (reached, len(drive.poses)))
    return None, 0.0, best


def _driving(question: Question, guide: Sequence[Pose], share: float, objective: Objective) -> _core.Driving:
    dues = question.dues
    cap = dues.length * CAP if objective == "balanced" else question.planner.angle_scale
    wishes = (dues.backward, dues.cusp, dues.stop, dues.in_place, dues.length, question.planner.angle_scale, share, cap)
    sharp = question.vehicle.kind == "car"
    numbers = numbers_of_vehicle(question.vehicle, LEAST_RADIUS * Fraction(dues.length) if sharp else Fraction(0))
    return _core.Driving(question.known, numbers, [*map(end_of, guide)], wishes)


def _path(question: Question, drive: _core.Drive) -> Path:
    """Return the path of the core's words."""
    poses = [*map(from_numbers, drive.poses)]
    return _checked(question, poses[0], tuple(joining(a, b) for a, b in pairwise(poses)), poses)


def _too_many(question: Question, way: Sequence[Pose], reached: tuple[float, int]) -> UndecidedError:
    share, motions = reached
    vehicle = described(question.vehicle)
    needed = max(1, round(motions / share)) if share > 0 else 0
    about = f"about {needed:,}" if needed else "too many"
    proof = _path_of(question, way[0], [joining(a, b) for a, b in pairwise(way) if a != b])
    away, remedy, far = question.onward.reach, "give the robot more room", FAR * question.dues.length
    if away > far:
        remedy = f"its axle point is {away:.3g} away from the robot, correct it"
    elif max(question.vehicle.radii) > far:
        remedy = f"its turning radius is {float(max(question.vehicle.radii)):.3g}, correct it, or {remedy}"
    return UndecidedError(
        f"a path of {vehicle} exists, as start and goal are in one cell of the free space; it needs {about} "
        f"manoeuvres: {remedy}",
        path=proof,
        manoeuvres=needed,
    )


def numbers_of_vehicle(vehicle: Vehicle, least: Fraction = Fraction(0)) -> tuple[Any, ...]:
    """Convert a vehicle to the core's numbers, with radii of a least length."""
    (left, right), (x, y) = (max(radius, least) for radius in vehicle.radii), vehicle.axle
    q, p = (0, 1) if vehicle.heading is None else (vehicle.heading.denominator, vehicle.heading.numerator)
    ratios = (number.as_integer_ratio() for number in (left, right, x, y))
    return vehicle.kind == "differential", vehicle.gears == "both", *ratios, q, p
