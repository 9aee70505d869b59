"""`audit`: the doors of a floor plan that a machine cannot pass, each with a proof and the width that is missing.

Doors are the openings of the floor (`openings.py`) or those that the caller gives. Bars across all of them part the
floor into rooms. A door is passable if it joins poses in one room with poses in the other that are apart while it is
shut. If they are joined while it is shut, by another way, all other doors are shut as well.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import Any, Literal

from cfree.analysis.aisles import least_width
from cfree.analysis.margins import Interval, bisected, bracket, deepest, nearest_miss
from cfree.analysis.openings import Segment, bar, beside, middle_of, openings_of, to_walls
from cfree.analysis.reach_map import free_parts, refuse_forward_only
from cfree.arguments import checked
from cfree.collision.motion_checker import is_free_motion
from cfree.errors import UndecidedError
from cfree.exact.number import Number, to_fraction
from cfree.exact.pose import Pose
from cfree.forbidden.boundary import boundary
from cfree.free.space import FreeSpace, free_space
from cfree.libraries import np, shapely
from cfree.paths.path import Path
from cfree.planning.plan import plan
from cfree.planning.separation import Insets, Separated
from cfree.polygons.offset import inset
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene, box_of, polygons_around, shapes_in, with_robot, with_shapes
from cfree.scene.smooth import smooth
from cfree.words import counted, ends, near

Result = Literal["passes", "blocked", "around", "no room"]
Progress = Callable[[float], object]
ORIENTATIONS = 72  # at which poses in a room are looked for
SMALLEST = 0.5  # share of a machine's least width: narrower openings are gaps between furniture
FIRST_INSET = 8  # halvings of the scene's size
TINY = 1e-9  # share of the floor's area


@dataclass(frozen=True)
class Door:
    """An opening of a floor plan, and a machine that passes it or does not.

    Attributes
    ----------
    name : str
    machine : str
    ends : ((x, y), (x, y))
        On the walls, rounded.
    width : float
    rooms : (str, str)
        On both sides.
    result : "passes", "blocked", "around" or "no room"
        "blocked": no motion of any kind leads from one room to the other, proved. "around": it gets there by another
        way, and does not pass here while all other doors are shut. "no room": it has no pose wholly in one of the
        rooms.
    missing : Interval or None
        By how much the machine is too wide for this door, if it is blocked: while all other doors are shut, some motion
        exists if all its sides move inwards by half of `hi`, none if they do by half of `lo`. None if it is not
        blocked, or no smaller machine gets there.
    start, goal : Pose or None
        A pose in each room, if it has some.
    proofs : tuple of Separated
        For each pair of poses in different cells, if it is blocked. They hold in the scene of the audit with this
        machine.
    """

    name: str
    machine: str
    ends: Segment
    width: float
    rooms: tuple[str, str]
    result: Result
    missing: Interval | None = None
    start: Pose | None = None
    goal: Pose | None = None
    proofs: tuple[Separated, ...] = field(default=(), repr=False)

    def __str__(self) -> str:
        where = ", ".join(near(value, self.width) for value in self.middle)
        place = f"{self.name}, {near(self.width, self.width)} wide at ({where}), {self.rooms[0]} - {self.rooms[1]}"
        missing = ""
        if self.missing:
            size = " to ".join(ends(self.missing.lo, self.missing.hi, 3))
            missing = f", {size if self.missing.exact is None else f'exactly {self.missing.exact}'} too wide"
        return f"{place}: {self.machine} {WORDS[self.result]}{missing}"

    @property
    def middle(self) -> tuple[float, float]:
        """The middle of the opening."""
        return middle_of(self.ends)


WORDS: dict[Result, str] = {
    "passes": "passes",
    "blocked": "cannot pass, proved",
    "around": "gets there by another way only",
    "no room": "has no room on one side",
}


@dataclass(frozen=True)
class Audit:
    """The doors of a floor plan, for each machine; see `audit`.

    Attributes
    ----------
    scene : Scene
        The plan, with the first machine as its robot.
    machines : mapping of str to Scene
        The plan with each of the machines.
    rooms : mapping of str to shapely geometry
        Parts of the floor between the doors.
    doors : tuple of Door
        By machine, then from the narrowest.
    """

    scene: Scene
    machines: Mapping[str, Scene] = field(hash=False)
    rooms: Mapping[str, Any] = field(hash=False)
    doors: tuple[Door, ...]

    def __repr__(self) -> str:
        number = len(self.doors) // max(1, len(self.machines))
        sizes = (len(self.machines), "machine"), (len(self.rooms), "room"), (number, "door")
        return f"Audit({', '.join(counted(*size) for size in sizes)}, {len(self.blocked)} blocked)"

    @property
    def blocked(self) -> tuple[Door, ...]:
        """The doors that a machine cannot pass, proved."""
        return tuple(door for door in self.doors if door.result == "blocked")


@checked
def audit(
    scene: Scene,
    machines: Mapping[str, Any] | None = None,
    *,
    openings: Mapping[str, Any] | None = None,
    places: Mapping[str, Sequence[Number]] | None = None,
    widest: float | None = None,
    missing: bool = True,
    tolerance: float = 0.01,
    progress: Progress | None = None,
) -> Audit:
    """Audit a floor plan: find the doors that machines cannot pass, with proofs and missing widths.

    Parameters
    ----------
    scene : Scene
        The plan: its obstacles are walls and furniture. Its bounds are ignored.
    machines : mapping of str to shape or sequence of shapes, optional
        By name; by default the scene's robot, named "robot". Each is turned and moved like the robot of a scene.
    openings : mapping of str to ((x, y), (x, y)), optional
        The doors by name, each a segment from wall to wall. By default they are found: narrow places of the floor
        between wider parts, from half as wide as the slimmest machine up to `widest`.
    places : mapping of str to (x, y), optional
        Names of rooms, each with a point in its room.
    widest : float, optional
        Width of the widest door, by default the diameter of the largest machine.
    missing : bool
        Find the missing widths, which takes most of the time.
    tolerance : float
        Greatest width of their intervals, relative to their ends.
    progress : callable, optional
        Called with the completed share, from 0 to 1.

    Returns
    -------
    Audit

    Raises
    ------
    ValueError
        If there is no wall, a place is in a wall or two are in one room, or an opening is not between two walls.
    UnsupportedError
        If the scene's vehicle has no reverse gear, or a shape has curves other than circles and grown polygons.

    Notes
    -----
    A vehicle with both gears passes wherever a robot does that may move sideways, as it may manoeuvre; what that robot
    cannot pass, no vehicle can. A door with the same room on both sides is left out. Poses in a room are looked for at
    72 orientations; a machine that fits at none of these counts as one that has no room.

    Examples
    --------
    >>> walls = [[(4, 0), ("4.2", 0), ("4.2", 1), (4, 1)], [(4, "1.8"), ("4.2", "1.8"), ("4.2", 5), (4, 5)]]
    >>> bed = [(-1, "-0.45"), (1, "-0.45"), (1, "0.45"), (-1, "0.45")]
    >>> chair = [("-0.6", "-0.35"), ("0.6", "-0.35"), ("0.6", "0.35"), ("-0.6", "0.35")]
    >>> two_rooms = Scene(bed, walls, workspace=[(0, 0), (9, 0), (9, 5), (0, 5)])
    >>> result = audit(two_rooms, {"bed": bed, "chair": chair}, places={"ward": (1, 1), "hall": (8, 1)})
    >>> result
    Audit(2 machines, 2 rooms, 1 door, 1 blocked)
    >>> for door in result.doors:
    ...     print(door)
    door 1, 0.8 wide at (4, 1.4), hall - ward: bed cannot pass, proved, 0.0996 to 0.1 too wide
    door 1, 0.8 wide at (4, 1.4), hall - ward: chair passes
    """
    refuse_forward_only(scene.vehicle)
    shapes = {"robot": scene.robot} if machines is None else machines
    if not shapes:
        raise ValueError("machines: none; give at least one")
    plain = _plan_of(scene)
    scenes = {name: with_shapes(plain, shapes_in(shape, f"machines: {name}")) for name, shape in shapes.items()}
    floor = _floor(plain, max(map(_diameter, scenes.values())))
    if widest is None:
        widest = max(map(_diameter, scenes.values()))
    least = SMALLEST * min(least_width(one) for one in scenes.values())
    narrow = openings_of(floor, widest)
    if openings is None:
        wide = [segment for segment in narrow if math.dist(*segment) >= least]
        segments = {f"door {k + 1}": segment for k, segment in enumerate(wide)}
    else:
        segments = {name: _given(floor, name, segment) for name, segment in openings.items()}
    gaps = [segment for segment in narrow if math.dist(*segment) < least]
    rooms = _rooms(floor, [*segments.values(), *gaps], least, plain.workspace is None, places or {})
    sides = {name: _sides(segment, rooms) for name, segment in segments.items()}
    doors = list[Door]()
    for name, segment in segments.items():
        if len(between := sides[name]) == 2:
            name = f"door {len(doors) + 1}" if openings is None else name
            doors.append(Door(name, "", segment, math.dist(*segment), (between[0], between[1]), "passes"))
    bars = [Polygon.from_shapely(bar(door.ends)) for door in doors]
    results = list[Door]()
    for machine, one in scenes.items():
        auditor = _Auditor(one, rooms, bars)
        for k, door in enumerate(doors):
            results.append(auditor.audited(replace(door, machine=machine), k, tolerance if missing else None))
            if progress is not None:
                progress(len(results) / (len(scenes) * len(doors)))
    return Audit(next(iter(scenes.values())), scenes, rooms, tuple(results))


class _Auditor:
    """A plan with one machine, its rooms, and a bar for each door."""

    def __init__(self, scene: Scene, rooms: Mapping[str, Any], bars: Sequence[Polygon]) -> None:
        self.scene, self.rooms, self.bars = scene, rooms, bars
        self.open = boundary(scene)
        self.space = free_space(self.open)
        part = polygons_around(scene.robot[0])[0].to_shapely().representative_point()
        self.inner = part.x, part.y  # a point of the machine, in its frame
        self._smaller_spaces = dict[tuple[Any, ...], FreeSpace]()
        self.least = TINY * sum(room.area for room in rooms.values())

    def audited(self, door: Door, k: int, tolerance: float | None) -> Door:
        """Return a door with its result; with a tolerance also the missing width."""
        here, there = self._poses(self._shut([k]), door.rooms)
        if not here or not there:
            return replace(door, result="no room")
        door = replace(door, start=next(iter(here.values())), goal=next(iter(there.values())))
        if here.keys() & there.keys():
            return replace(door, result="passes" if self._passes_alone(door, k) else "around")
        cells = [{self.space.locate(pose): pose for pose in poses.values()} for poses in (here, there)]
        if cells[0].keys() & cells[1].keys():
            return door
        pairs = [*product(cells[0].values(), cells[1].values())]
        answers = [plan(self.scene, start, goal) for start, goal in pairs]
        touching = [answer for answer in answers if isinstance(answer, Path)]  # they slide through exact fits
        if touching:
            shut = self._with_bars([k])
            around = all(
                is_free_motion(shut, pose, motion)
                for path in touching
                for pose, motion in zip(path.poses, path.motions, strict=False)
            )
            return replace(door, result="around") if around else door
        proofs, too_wide = tuple(answer for answer in answers if isinstance(answer, Separated)), None
        with suppress(UndecidedError):  # among round shapes
            too_wide = None if tolerance is None else self._missing(door, k, tolerance)
        return replace(door, result="blocked", missing=too_wide, proofs=proofs)

    def _missing(self, door: Door, k: int, tolerance: float) -> Interval | None:
        """Return twice the least inset with which the machine passes a door while all others are shut."""
        others = [j for j in range(len(self.bars)) if j != k]
        pairs = [*product(*(poses.values() for poses in self._poses(self._all_shut, door.rooms)))]
        if self.scene.curved:
            shut = self._with_bars(others)
            misses = [nearest_miss(shut, start, goal, tolerance) for start, goal in pairs]
            known = [miss for miss in misses if miss is not None]
            if not known:
                return None
            exact = [2 * miss.exact for miss in known if miss.exact is not None]
            if len(exact) == len(known):
                return Interval(*min(exact).floats_around, exact=min(exact))
            return Interval(*(2 * min(getattr(miss, end) for miss in known) for end in ("lo", "hi")))
        size = Fraction(2) ** Insets(self.scene).size
        most = deepest(self._smaller, size)

        def is_apart(by: Fraction, shut: Sequence[int] = others) -> bool:
            space = self._smaller_space(min(by, most), shut)
            return all(space.common_cell(start, goal) is None for start, goal in pairs)

        def is_apart_anyway(by: Fraction) -> bool:
            return is_apart(by, ())

        if not most or not pairs or is_apart(most):
            return None
        lo, hi = bracket(is_apart_anyway, size / 2**FIRST_INSET)  # other doors share these free spaces
        if lo:
            lo, hi = bisected(is_apart_anyway, lo, hi, tolerance, None)
        if is_apart(hi):  # a smaller machine gets there by another way first
            lo, hi = bisected(is_apart, *bracket(is_apart, hi), tolerance, None)
        return Interval(2 * float(lo), 2 * float(hi))

    def _smaller(self, by: Fraction) -> list[Polygon]:
        return [smaller for part in self.scene.robot for smaller in inset(part, by)]

    def _smaller_space(self, by: Fraction, shut: Sequence[int]) -> FreeSpace:
        """Return the free space of the machine with an inset, and some doors shut; doors ask for the same ones."""
        key = by, *shut
        if key not in self._smaller_spaces:
            self._smaller_spaces[key] = free_space(boundary(with_robot(self._with_bars(shut), self._smaller(by), None)))
        return self._smaller_spaces[key]

    def _passes_alone(self, door: Door, k: int) -> bool:
        """True if the machine passes a door while all others are shut."""
        space = self._shut([j for j in range(len(self.bars)) if j != k])
        here, there = (
            {space.locate(pose) for pose in poses.values()} for poses in self._poses(self._all_shut, door.rooms)
        )
        return bool(here & there)

    @cached_property
    def _all_shut(self) -> FreeSpace:
        return self._shut(range(len(self.bars)))

    def _shut(self, doors: Sequence[int]) -> FreeSpace:
        """Return the free space with some of the doors shut."""
        return free_space(boundary(self._with_bars(doors), reuse=self.open))

    def _with_bars(self, doors: Sequence[int]) -> Scene:
        """Return the plan with some of the doors shut."""
        scene = self.scene
        for k in doors:
            scene = scene.with_obstacle(self.bars[k])
        return scene

    def _poses(self, space: FreeSpace, rooms: tuple[str, str]) -> tuple[dict[int, Pose], dict[int, Pose]]:
        """Return poses with the machine's inner point in each room, one for each cell: with most room around it."""
        best: tuple[dict[int, tuple[float, Pose]], ...] = ({}, {})
        for k in range(ORIENTATIONS):
            angle = f"{360 * k / ORIENTATIONS!r}deg"
            (x, y) = Pose(0, 0, angle).apply([self.inner])[0].tolist()
            for region, cell in free_parts(space, angle):
                moved = shapely.affinity.translate(region, x, y)
                for room, poses in zip(rooms, best, strict=True):
                    for part in shapely.get_parts(moved & self.rooms[room]).tolist():
                        if part.area > poses.get(cell, (self.least,))[0]:
                            point = part.representative_point()
                            pose = Pose(point.x - x, point.y - y, angle)
                            if space.locate(pose) == cell:
                                poses[cell] = part.area, pose
        here, there = ({cell: pose for cell, (_, pose) in poses.items()} for poses in best)
        return here, there


def _plan_of(scene: Scene) -> Scene:
    """Return a scene without bounds, start and goals."""
    other = copy(scene)
    for name, value in {"bounds": None, "start": None, "goal": None, "goals": ()}.items():
        object.__setattr__(other, name, value)
    return other


def _diameter(scene: Scene) -> float:
    """Return the greatest distance of two points of the machine, of a round one a little more."""
    points = np.array([p for part in scene.robot for polygon in polygons_around(part) for p in polygon.doubles])
    hull = shapely.get_coordinates(shapely.convex_hull(shapely.multipoints(points)))
    return float(max(np.hypot(*(hull - p).T).max() for p in hull))


def _floor(scene: Scene, far: float) -> Any:
    """Return the floor: the workspace, or a box beyond the walls, without obstacles."""
    scene = smooth(scene)
    solid = shapely.union_all([polygon.to_shapely() for polygon in scene.obstacles])
    if scene.workspace is not None:
        return scene.workspace.to_shapely().difference(solid)
    if not scene.obstacles:
        raise ValueError("scene: no walls; give obstacles or a workspace")
    boxes = np.array([box_of(shape) for shape in scene.obstacles])
    frame = shapely.box(*(boxes[:, :2].min(axis=0) - 3 * far), *(boxes[:, 2:].max(axis=0) + 3 * far))
    return frame.difference(solid)


def _given(floor: Any, name: str, ends: Any) -> Segment:
    """Return the segment of an opening, moved to the walls."""
    try:
        (x, y), (u, v) = ((float(to_fraction(p)), float(to_fraction(q))) for p, q in ends)
    except (TypeError, ValueError):
        raise ValueError(f"openings: {name}: {ends!r}; give two points, as in ((1, 2), (1, 2.9))") from None
    segment = to_walls(floor, ((x, y), (u, v)))
    if segment is None:
        raise ValueError(
            f"openings: {name}: ({x:.10g}, {y:.10g}) to ({u:.10g}, {v:.10g}) does not end near walls; give their ends"
        )
    return segment


def _rooms(
    floor: Any, segments: Sequence[Segment], least: float, is_open: bool, places: Mapping[str, Sequence[Number]]
) -> dict[str, Any]:
    """Return the parts of the floor between openings, by name, the largest first; nooks are left out."""
    parts = shapely.get_parts(floor.difference(shapely.union_all([bar(segment) for segment in segments]))).tolist()
    parts = sorted((part for part in parts if not part.buffer(-least / 2).is_empty), key=lambda part: -part.area)
    names: dict[int, str] = {}
    for name, place in places.items():
        try:
            x, y = (float(to_fraction(c)) for c in place)
        except (TypeError, ValueError):
            raise ValueError(f"places: {name}: {place!r}; give a point, as in (1, 2.5)") from None
        k = next((k for k, part in enumerate(parts) if part.intersects(shapely.Point(x, y))), None)
        if k is None:
            raise ValueError(f"places: {name}: ({x:.10g}, {y:.10g}) is in a wall or outside; give a point of the floor")
        if k in names:
            raise ValueError(f"places: {name} and {names[k]} are in one room; leave one out, or name the door between")
        names[k] = name
    low = shapely.bounds(floor)
    if is_open:
        outer = next(k for k, part in enumerate(parts) if math.dist(part.bounds[:2], low[:2]) == 0)
        names.setdefault(outer, "outside")
    free = (name for name in _numbered() if name not in places)
    return {names[k] if k in names else next(free): part for k, part in enumerate(parts)}


def _numbered() -> Iterator[str]:
    k = 0
    while True:
        k += 1
        yield f"room {k}"


def _sides(segment: Segment, rooms: Mapping[str, Any]) -> list[str]:
    """Return the rooms on both sides of a segment, by name."""
    points = beside(segment)
    return sorted(name for name, room in rooms.items() if any(room.intersects(point) for point in points))
