"""Gears, changes of direction and wheels of a vehicle, for pictures and films of the path that it drives."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.exact.pose import Pose, Poses
from cfree.palette import AHEAD, BACK, GREY, IN_PLACE, INK
from cfree.paths.driven import Driven, Gear
from cfree.paths.path import Path
from cfree.paths.travel import Travel
from cfree.plot.boundary import plain
from cfree.plot.workspace import draw_robot, path_of, rings_of
from cfree.scene.scene import Scene, robot_radius
from cfree.vehicles.vehicle import Vehicle, described

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

GEARS: dict[Gear, tuple[str, str]] = {
    "forward": (AHEAD, "ahead"),
    "backward": (BACK, "back"),
    "turning": (IN_PLACE, "turns in place"),
}
"""Colour and name of each gear."""
CHANGE = "change of direction"
FINE = math.radians(2)  # of a turn from point to point of a track
WHEEL, TYRE = 0.15, 0.4  # length of a wheel in lengths of the robot; its width in its own lengths
TRACK = 0.82  # distance of the wheels' outsides in widths of the robot
SHOWN, APART = 6, 0.5  # most poses between start and goal at which the robot is drawn; their least distance in radii
VISIBLE = 0.05  # robot's radii: front wheels have the angle of the next part that is longer
NEAR = 3.0  # robot's radii: a picture shows axle points within this distance
MANY = 40  # changes of direction from which on their dots are smaller
BELOW = 0.52  # inches from axes to the legend below them
_DOT: dict[str, Any] = {"markersize": 5, "color": "white", "markeredgecolor": INK, "markeredgewidth": 1.2}
_SPOT: dict[str, Any] = {"markersize": 8, "color": IN_PLACE, "markeredgecolor": "white", "markeredgewidth": 1.2}


@dataclass(frozen=True, eq=False)
class Wheels:
    """Wheels of a vehicle in its own frame: the axle point is the origin, and forward the x axis.

    Attributes
    ----------
    vehicle : Car or DifferentialDrive
    half : float
        Distance of the middle of a wheel from the axle point.
    size : float
        Length of a wheel.
    front : float
        The foremost point of the robot.

    A car with a wheelbase has a steered axle as well.
    """

    vehicle: Vehicle
    half: float
    size: float
    front: float

    @classmethod
    def of(cls, scene: Scene, vehicle: Vehicle) -> Wheels:
        """Return wheels that fit below the robot of a scene."""
        own = vehicle.frame.inverse()
        corners = np.concatenate([own.apply(part.vertices) for part in scene.robot])
        (back, right), (front, left) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
        size = WHEEL * (front - back)
        beside = min(left, -right) if right < 0 < left else (left - right) / 2
        size = min(size, 1.5 * beside)
        return cls(vehicle, TRACK * beside - TYRE * size / 2, size, front)

    @property
    def wheelbase(self) -> float | None:
        """Distance of the steered axle from the other one, if it is known."""
        return None if self.vehicle.wheelbase is None else float(self.vehicle.wheelbase)

    def axles(self, pose: Pose) -> Floats:
        """Return the ends of each axle, (axles, 2, 2), in a pose of the robot."""
        places = [0.0] if self.wheelbase is None else [0.0, self.wheelbase]
        ends = [[(x, side * self.half) for side in (-1, 1)] for x in places]
        return np.stack([self._placed(pose, end) for end in ends])

    def rings(self, pose: Pose, curvature: float) -> list[Floats]:
        """Return the outline of each wheel in a pose of the robot, the front wheels steered to a curvature."""
        x, y = self.size / 2, TYRE * self.size / 2
        tyre = np.array([(-x, -y), (x, -y), (x, y), (-x, y)])
        rings = [tyre + np.array((0.0, side * self.half)) for side in (-1, 1)]
        if self.wheelbase is not None:
            for side in (-1, 1):
                angle = steered(curvature, self.wheelbase, side * self.half)
                c, s = math.cos(angle), math.sin(angle)
                turned = tyre @ np.array([(c, s), (-s, c)])
                rings.append(turned + np.array((self.wheelbase, side * self.half)))
        return [self._placed(pose, ring) for ring in rings]

    def nose(self, pose: Pose) -> Floats:
        """Return a triangle that points forward, at the front of the robot."""
        x, y = self.front - 0.3 * self.size, 0.35 * self.size
        return self._placed(pose, [(x - 0.5 * self.size, -y), (x, 0.0), (x - 0.5 * self.size, y)])

    def _placed(self, pose: Pose, points: Any) -> Floats:
        return np.asarray(pose.apply(self.vehicle.frame.apply(points)))


def steered(curvature: float, wheelbase: float, beside: float) -> float:
    """Return the angle of a front wheel, in radians, at this distance to the left of the middle.

    Its axis points to the pole of the motion, at which the axis of the other axle points.

    Examples
    --------
    >>> [round(math.degrees(steered(1 / 4, 2, side)), 1) for side in (-1, 0, 1)]
    [21.8, 26.6, 33.7]
    >>> steered(0.0, 2, 1), round(math.degrees(steered(math.inf, 2, 0)))
    (0.0, 90)
    """
    if math.isinf(curvature):
        return math.atan2(wheelbase, -beside)
    along = 1 - curvature * beside
    angle = math.atan2(curvature * wheelbase, along)
    return angle if abs(angle) <= math.pi / 2 else angle - math.copysign(math.pi, angle)


@dataclass(frozen=True, eq=False)
class Gears:
    """A path as its vehicle drives it.

    Attributes
    ----------
    path : Path
        A path with a vehicle.
    scene : Scene
    travel : Travel
        Places on the path.
    wheels : Wheels
    """

    path: Path
    scene: Scene
    travel: Travel
    wheels: Wheels

    @classmethod
    def of(cls, path: Path, scene: Scene, travel: Travel) -> Gears | None:
        """Return the gears of a path; None if it has no vehicle.

        Raises
        ------
        ValueError
            If the vehicle cannot drive the path.
        """
        return None if path.vehicle is None else cls(path, scene, travel, Wheels.of(scene, path.vehicle))

    @cached_property
    def parts(self) -> tuple[Driven, ...]:
        """Parts of the path on one line or arc in one gear."""
        return self.path.driving

    @cached_property
    def tracks(self) -> list[Floats]:
        """The track of the axle point in each part, (n, 2)."""
        return [self._track(part.first, part.last + 1) for part in self.parts]

    @cached_property
    def changes(self) -> list[int]:
        """The parts before which the direction changes; turns in place have none."""
        moving = [k for k, part in enumerate(self.parts) if part.gear != "turning"]
        return [k for last, k in pairwise(moving) if self.parts[last].gear != self.parts[k].gear]

    @cached_property
    def dots(self) -> Floats:
        """The axle point at each change of direction, (changes, 2)."""
        return np.reshape([self.tracks[k][0] for k in self.changes], (-1, 2))

    @cached_property
    def spots(self) -> Floats:
        """The axle point at each turn in place, (turns, 2)."""
        places = [track[0] for track, part in zip(self.tracks, self.parts, strict=True) if part.gear == "turning"]
        return np.reshape(places, (-1, 2))

    @cached_property
    def stands(self) -> list[tuple[Pose, float]]:
        """Poses at changes of direction, some way from each other, with the curvature that follows."""
        poses = [self.path.poses[self.parts[k].first] for k in self.changes]
        chosen = far_apart(poses, (self.path.start, self.path.goal), robot_radius(self.scene))
        return [(poses[k], self._follows(self.parts[self.changes[k] :])) for k in chosen]

    def driver(self) -> str:
        """Name the vehicle with its turning radius, for a figure."""
        return plain(described(self.wheels.vehicle, self.scene.units))

    def part_at(self, travel: Floats) -> Ints:
        """Return the part in which the robot is after some travel (n,)."""
        ends = [self.travel.until[part.last + 1] for part in self.parts]
        return np.clip(np.searchsorted(ends, travel, side="right"), 0, max(0, len(ends) - 1))

    def word(self, travel: float) -> tuple[str, str]:
        """Return the gear after some travel in a word, and its colour."""
        if not self.parts:
            return "", INK
        colour, word = GEARS[self.parts[int(self.part_at(np.array([travel]))[0])].gear]
        return word, colour

    def tracks_until(self, travel: float) -> list[Floats]:
        """Return the tracks of the axle point up to some travel, each (n, 2)."""
        if not self.parts:
            return []
        k = int(self.part_at(np.array([travel]))[0])
        part, (motions, shares) = self.parts[k], self.travel.places([travel])
        motion, share = min(int(motions[0]), part.last), float(shares[0])
        if motion < part.first:
            return self.tracks[:k]
        return [*self.tracks[:k], self._track(part.first, motion + 1, share if motion == motions[0] else 1.0)]

    def colours(self, travel: Floats) -> Floats:
        """Return the colours (n, 4) of the gears after some travel (n,)."""
        from matplotlib.colors import to_rgba_array

        colours = to_rgba_array([GEARS[part.gear][0] for part in self.parts] or [AHEAD])
        return np.asarray(colours[self.part_at(travel)])

    def curvature(self, end: str) -> float:
        """Return the curvature of the part that begins at the start, or ends at the goal."""
        return self._follows(self.parts if end == "start" else self.parts[::-1])

    def _follows(self, parts: Sequence[Driven]) -> float:
        """Return the curvature of the first part that is long enough to be visible."""
        least = VISIBLE * robot_radius(self.scene)
        longer = (part for part in parts if part.length > least or part.gear == "turning")
        return next(longer, parts[0]).curvature if parts else 0.0

    def axle(self, rows: Floats) -> Floats:
        """Return the axle point (n, 2) in poses x, y, theta (n, 3)."""
        return np.asarray(Poses(rows[:, :2], rows[:, 2]).apply([self._axle]))[:, 0]

    def near(self, rows: Floats) -> Floats:
        """Return the axle point in poses (n, 3) if it is near the robot; else nothing, (0, 2)."""
        beside = math.hypot(*self._axle)
        return self.axle(rows if beside < NEAR * robot_radius(self.scene) else rows[:0])

    @property
    def _axle(self) -> list[float]:
        return [float(value) for value in self.wheels.vehicle.axle]

    def _track(self, first: int, end: int, last: float = 1.0) -> Floats:
        """Return the track of the axle point from motion to motion, of the last one up to a share."""
        points = []
        for k in range(first, end):
            motion = self.path.motions[k]
            shares = np.linspace(0, last if k == end - 1 else 1.0, 2 + int(abs(motion.turn) / FINE))
            points.append(motion.sample(self.path.poses[k], shares).apply([self._axle])[:, 0])
        return np.concatenate(points)


def far_apart(poses: Sequence[Pose], drawn: Sequence[Pose], radius: float, least: float = APART) -> list[int]:
    """Choose few of some poses, in their order, that are far from each other and from those drawn already.

    They are apart by `least` radii, and a radian is as long as a radius.

    Examples
    --------
    >>> far_apart([Pose(x / 10, 0) for x in range(41)], [Pose(0, 0)], radius=1.9)
    [10, 20, 30, 40]
    """
    chosen = list[int]()
    apart = np.array([min(_apart(pose, other, radius) for other in drawn) for pose in poses])
    while len(chosen) < SHOWN and apart.max(initial=0.0) > least * radius:  # the farthest from all others is next
        chosen.append(int(apart.argmax()))
        apart = np.minimum(apart, [_apart(pose, poses[chosen[-1]], radius) for pose in poses])
    return sorted(chosen)


def _apart(one: Pose, other: Pose, radius: float) -> float:
    """Return a distance of two poses, a radian as long as the radius."""
    turn = math.remainder(one.theta - other.theta, math.tau)
    return math.hypot(float(one.x - other.x), float(one.y - other.y), radius * turn)


# on axes of the plane


def draw_axle_track(ax: Any, gears: Gears) -> None:
    """Draw the track of the axle point, coloured by gear, with turns in place and changes of direction."""
    from matplotlib.collections import LineCollection

    colours = [GEARS[part.gear][0] for part in gears.parts]
    for colour, width in (("white", 4.2), (colours, 2.6)):
        line = LineCollection(gears.tracks, colors=colour, linewidths=width, capstyle="round", zorder=4)
        ax.add_collection(line, autolim=False)
    ax.collections[-1].set_label("axle's track")
    draw_marks(ax, gears)


def draw_marks(ax: Any, gears: Gears) -> tuple[Any, Any]:
    """Draw turns in place and changes of direction; return the two lines of markers."""
    (spots,) = ax.plot(*gears.spots.T, "o", zorder=4.6, label=GEARS["turning"][1], **_SPOT)
    size = {} if len(gears.dots) <= MANY else {"markersize": 3.2, "markeredgewidth": 0.7}
    (dots,) = ax.plot(*gears.dots.T, "o", zorder=4.8, label=CHANGE, **_DOT | size)
    return spots, dots


def draw_stands(ax: Any, scene: Scene, gears: Gears) -> None:
    """Draw the robot and its wheels at changes of direction."""
    from matplotlib.collections import PathCollection

    rings = rings_of(scene.robot)
    shapes = [path_of(pose.apply(ring) for ring in rings) for pose, _ in gears.stands]
    style: Any = {"facecolors": "none", "edgecolors": GREY, "linewidths": 0.9, "zorder": 2.8, "label": "stands"}
    ax.add_collection(PathCollection(shapes, **style), autolim=False)
    for pose, curvature in gears.stands:
        DrawnWheels(ax, gears.wheels, 2.9, GREY).place(pose, curvature)


def draw_vehicle(ax: Any, scene: Scene, pose: Pose, wheels: Wheels, curvature: float, *, faint: bool) -> None:
    """Draw the robot in a pose with its wheels and a triangle at its front."""
    draw_robot(ax, scene, pose, faint=faint, mark=False)
    DrawnWheels(ax, wheels, 3.2).place(pose, curvature)


class DrawnWheels:
    """Artists of axles, wheels and the triangle at the front, on axes of the plane."""

    def __init__(self, ax: Any, wheels: Wheels, zorder: float, colour: str = INK) -> None:
        from matplotlib.collections import LineCollection
        from matplotlib.patches import PathPatch

        self._wheels = wheels
        lines = LineCollection([], colors=colour, linewidths=1.3, zorder=zorder, label="axles")
        self.axles = ax.add_collection(lines, autolim=False)
        self.shapes = ax.add_patch(PathPatch(path_of([]), facecolor=colour, linewidth=0, zorder=zorder, label="wheels"))

    def place(self, pose: Pose, curvature: float) -> None:
        """Put the wheels where they are in a pose of the robot, and steer them."""
        self.axles.set_segments(list(self._wheels.axles(pose)))
        self.shapes.set_path(path_of([*self._wheels.rings(pose, curvature), self._wheels.nose(pose)]))


def gear_handles(gears: Gears) -> list[Any]:
    """Return entries of a legend: the gears that the path has, and the dot of a change of direction."""
    from matplotlib.lines import Line2D

    driven = {part.gear for part in gears.parts}
    handles = [
        Line2D([], [], linewidth=0, marker="o", label=name, **_SPOT)
        if gear == "turning"
        else Line2D([], [], color=colour, linewidth=2.6, label=name)
        for gear, (colour, name) in GEARS.items()
        if gear in driven
    ]
    if gears.changes:
        handles.append(Line2D([], [], linewidth=0, marker="o", label=CHANGE, **_DOT))
    return handles


def draw_legend(ax: Any, gears: Gears) -> None:
    """Explain colours and dots below the axes."""
    from matplotlib.transforms import ScaledTranslation

    handles = gear_handles(gears)
    below = ax.transAxes + ScaledTranslation(0, -BELOW, ax.figure.dpi_scale_trans)
    ax.legend(
        handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), bbox_transform=below, frameon=False, fontsize=9,
        handlelength=1.6, ncols=max(1, len(handles)), columnspacing=1.4, borderaxespad=0,
    )  # fmt: skip
