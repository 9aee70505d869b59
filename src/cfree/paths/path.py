"""Paths: sequences of motions from an exact pose to an exact pose.

Each motion begins at the end of the one before it, so every path is continuous. `docs/answer-format.md` describes the
files.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, fields, replace
from fractions import Fraction
from functools import cached_property
from typing import Literal, overload

from cfree.arguments import checked
from cfree.collision.motion import Motion, Translation
from cfree.collision.motion_checker import MotionChecker
from cfree.exact.number import ExactPoint, Number, to_fraction
from cfree.exact.pose import Pose, PoseLike, Poses, to_pose
from cfree.libraries import Floats, np
from cfree.paths.driven import Driven, cusps, first_fault, parts_of
from cfree.paths.stops import joints, usual_wheelbase
from cfree.scene.digest import Stamp, Whole
from cfree.scene.goals import Moved
from cfree.scene.scene import Scene
from cfree.value import Answer, Shown
from cfree.vehicles.vehicle import Vehicle
from cfree.words import counted

STILL = Translation((0, 0))  # stands for the motion of a path that has none
Objective = Literal["balanced", "short", "clear"]


@checked
@dataclass(frozen=True, repr=False)
class Path(Shown, Answer):
    """A start pose and motions.

    A path is a sequence of its motions: it has a length, can be iterated over, and ``path[2]`` is a motion. A slice
    such as ``path[2:5]`` is a path from ``path.poses[2]`` to ``path.poses[5]``. A path is always true, even without
    motions.

    Parameters
    ----------
    start : Pose or (x, y, theta)
    motions : sequence of Translation, Rotation or Slide
        In world coordinates, applied one after the other.
    units : str, optional
        Unit of length, for display only.
    frame : str, optional
        Name of the world's frame, for files.
    scene : Scene, optional
        The scene of the path; None if it was read from a file.
    stamp : Stamp, optional
        The scene's stamp in the file.
    clearance : Fraction, optional
        Distance that it claims to keep from obstacles and workspace; 0 without a claim.
    disc : tuple of exact points, optional
        A convex polygon around a disc of that radius, in the robot's frame: the path is free for the robot's Minkowski
        sum with it.
    curved : Scene, optional
        The scene with round shapes, if it is a path among these; `scene` has polygons around them.
    moved : Moved, optional
        The requested start and goal, if they were moved to free poses.
    whole : Whole, optional
        The scene of which `scene` has only some obstacles, if a folder was asked.
    vehicle : Car or DifferentialDrive, optional
        The vehicle that drives the path; None for a robot that moves in any direction.

    Examples
    --------
    >>> from cfree.collision.motion import Rotation
    >>> path = Path(Pose(0, 0), [Translation((2, 0)), Rotation((2, 1), "90deg")])
    >>> path.goal == Pose(3, 1, "90deg"), path.turning == math.pi / 2, path.length == 2 + math.pi / 2
    (True, True, True)
    >>> len(path), path[-1].turn == math.pi / 2, path[1:].start == path[:1].goal == Pose(2, 0)
    (2, True, True)
    """

    start: Pose
    motions: tuple[Motion, ...]
    units: str = field(default="", compare=False)
    frame: str = field(default="world", compare=False)
    scene: Scene | None = field(default=None, compare=False)
    stamp: Stamp | None = field(default=None, compare=False)
    clearance: Fraction = Fraction(0)
    disc: tuple[ExactPoint, ...] = ()
    curved: Scene | None = field(default=None, compare=False)
    moved: Moved | None = None
    whole: Whole | None = field(default=None, compare=False)
    vehicle: Vehicle | None = None

    def __init__(
        self,
        start: PoseLike,
        motions: Iterable[Motion],
        units: str = "",
        frame: str = "world",
        scene: Scene | None = None,
        stamp: Stamp | None = None,
        clearance: Fraction = Fraction(0),
        disc: tuple[ExactPoint, ...] = (),
        curved: Scene | None = None,
        moved: Moved | None = None,
        whole: Whole | None = None,
        vehicle: Vehicle | None = None,
    ) -> None:
        given = (units, frame, scene, stamp, clearance, disc, curved, moved, whole, vehicle)
        values = (to_pose(start, "start"), tuple(motions), *given)
        for item, value in zip(fields(self), values, strict=True):
            object.__setattr__(self, item.name, value)

    def __repr__(self) -> str:
        n = len(self.motions)
        return f"Path({counted(n, 'motion')}, length {self.length:.6g}, turning {self.turning:.6g})"

    def __bool__(self) -> Literal[True]:
        return True

    def __len__(self) -> int:
        return len(self.motions)

    def __iter__(self) -> Iterator[Motion]:
        return iter(self.motions)

    @overload
    def __getitem__(self, index: int) -> Motion: ...
    @overload
    def __getitem__(self, index: slice) -> Path: ...
    @checked
    def __getitem__(self, index: int | slice) -> Motion | Path:
        """Return the motion at an index, or the part of the path in a slice.

        Raises
        ------
        IndexError
            If there is no such motion.
        ValueError
            If the slice has a step other than 1: its motions do not follow each other.

        Examples
        --------
        >>> path = Path(Pose(0, 0), [Translation((2, 0)), Translation((0, 3)), Translation((1, 1))])
        >>> path[1].vector == (0, 3), path[1:].start == Pose(2, 0), path[:-1].goal == Pose(2, 3), len(path[1:1])
        (True, True, True, 0)
        """
        count = len(self.motions)
        if isinstance(index, slice):
            start, stop, step = index.indices(count)
            if step != 1:
                raise ValueError(f"step {step}: only motions that follow each other are a path; give no step")
            return replace(self, start=self.poses[start], motions=self.motions[start:stop])
        if not -count <= index < count:
            give = f"{count}; give {-count} to {count - 1}" if count else "none"
            raise IndexError(f"motion {index}: the number of motions is {give}")
        return self.motions[index]

    @cached_property
    def poses(self) -> tuple[Pose, ...]:
        """The start, and the end of each motion; exact."""
        poses = [self.start]
        for motion in self.motions:
            poses.append(motion.apply(poses[-1]))
        return tuple(poses)

    @property
    def goal(self) -> Pose:
        """The end of the last motion, exact."""
        return self.poses[-1]

    @property
    def length(self) -> float:
        """Path length of the reference point."""
        return math.fsum(motion.length(pose) for pose, motion in zip(self.poses, self.motions, strict=False))

    @property
    def turning(self) -> float:
        """Total rotation: the sum of all angles turned, without signs, in radians."""
        return math.fsum(abs(motion.turn) for motion in self.motions)

    @cached_property
    def driving(self) -> tuple[Driven, ...]:
        """Gear, radius, length and angle of its parts: motions on one arc or line in one gear are one part.

        It is empty for a robot that moves in any direction. Lengths are in the scene's unit, angles in radians.

        Raises
        ------
        ValueError
            If its vehicle cannot drive it.

        Examples
        --------
        >>> from cfree import Car, Rotation
        >>> motions = [Translation((3, 0)), Rotation((3, 2), "90deg"), Rotation((3, 2), "-10deg")]
        >>> path = Path(Pose(0, 0), motions, vehicle=Car(2))
        >>> [(part.gear, part.curvature, round(part.length, 2)) for part in path.driving], path.cusps
        ([('forward', 0.0, 3.0), ('forward', 0.5, 3.14), ('backward', 0.5, 0.35)], 1)
        """
        if self.vehicle is None:
            return ()
        if fault := first_fault(self.vehicle, self.poses, self.motions):
            raise ValueError("motion {}: {}".format(*fault))
        return parts_of(self.vehicle, self.poses, self.motions)

    @property
    def cusps(self) -> int:
        """Number of changes between forward and backward; `driving` lists the parts.

        Raises
        ------
        ValueError
            If its vehicle cannot drive it.
        """
        return cusps(self.driving)

    @property
    def stops(self) -> int:
        """Number of places at which its vehicle stands between start and goal.

        They are cusps, the begin and end of turns in place, and for a car jumps of curvature, where its wheels turn.
        Wheels that turn by less than a hundredth of a degree need no stop.

        Examples
        --------
        >>> from cfree import Car, Rotation
        >>> motions = [Translation((3, 0)), Rotation((3, 2), "90deg"), Rotation((3, 2), "-10deg")]
        >>> Path(Pose(0, 0), motions, vehicle=Car(2)).stops
        2
        """
        return len(joints(self.driving, usual_wheelbase(self.vehicle))) if self.vehicle else 0

    @checked
    def at(self, position: Number) -> Pose:
        """Return the exact pose at a position: k + u is the parameter u of motion k, k alone is ``poses[k]``.

        Examples
        --------
        >>> path = Path(Pose(0, 0), [Translation((2, 0)), Translation((0, 3))])
        >>> path.at("4/3") == Pose(2, 1)
        True
        """
        exact = to_fraction(position)
        if not 0 <= exact <= len(self.motions):
            raise ValueError(f"position {position} is not on the path; give one from 0 to {len(self.motions)}")
        k = min(math.floor(exact), max(len(self.motions) - 1, 0))
        return self.motions[k].at(self.poses[k], exact - k) if self.motions else self.start

    @checked
    def after(self, distance: float, angle_scale: float = 1.0) -> Pose:
        """Return a pose at a distance along the path: travel of the reference point, plus turning times `angle_scale`.

        It is exactly on the path; the distance is correct up to rounding.

        Raises
        ------
        ValueError
            If the distance is negative, or longer than the path.

        Examples
        --------
        >>> path = Path(Pose(0, 0), [Translation((2, 0)), Translation((0, 3))])
        >>> path.after(3.5) == Pose(2, "3/2")
        True
        """
        lengths = [m.length(q) + angle_scale * abs(m.turn) for q, m in zip(self.poses, self.motions, strict=False)]
        until = np.cumsum([0.0, *lengths])
        if not 0 <= distance <= until[-1] * (1 + 2**-40):  # sums are rounded
            raise ValueError(f"distance {distance} is not on the path; give one from 0 to {until[-1]:g}")
        if distance >= until[-1] * (1 - 2**-40):
            return self.goal
        k = int(np.searchsorted(until, distance, side="right")) - 1
        share = (distance - float(until[k])) / lengths[k]
        return self.motions[k].at(self.poses[k], self.motions[k].parameter(share))

    @checked
    def sample(self, step: float, turn: float = math.radians(5)) -> Poses:
        """Return poses along the path, including the ends of all motions.

        Parameters
        ----------
        step : float
            Greatest path length of the reference point from one pose to the next.
        turn : float, radians
            Greatest turn from one pose to the next.

        Returns
        -------
        Poses

        Raises
        ------
        ValueError
            If step or turn is not positive.
        """
        parts = [Poses.from_poses([self.start])]
        for pose, motion, shares in zip(self.poses, self.motions, self.shares(step, turn), strict=False):
            parts.append(motion.sample(pose, shares))
        return Poses(np.concatenate([p.xy for p in parts]), np.concatenate([p.theta for p in parts]))

    @checked
    def angles(self, step: float, turn: float = math.radians(5)) -> Floats:
        """Return theta of the poses of `sample`, continued from the start's and not wrapped.

        Examples
        --------
        >>> from cfree.collision.motion import Rotation
        >>> path = Path(Pose(0, 0), [Rotation((0, 0), "-90deg"), Rotation((0, 0), "180deg")])
        >>> np.degrees(path.angles(1, math.pi))
        array([  0., -90.,  90.])
        """
        parts, before = [np.array([self.start.theta])], self.start.theta
        for k, (motion, shares) in enumerate(zip(self.motions, self.shares(step, turn), strict=True)):
            end = self.poses[k + 1].theta
            end += math.tau * round((before + motion.turn - end) / math.tau)
            parts.append(np.append(before + shares[:-1] * motion.turn, end))
            before = end
        return np.concatenate(parts)

    @checked
    def shares(self, step: float, turn: float = math.radians(5)) -> list[Floats]:
        """Return for each motion its shares, above 0 and up to 1, at which `sample` takes poses."""
        if not (step > 0 and turn > 0):
            raise ValueError(f"step {step}, turn {turn}: give positive ones")
        shares = []
        for pose, motion in zip(self.poses, self.motions, strict=False):
            count = max(1, math.ceil(motion.length(pose) / step), math.ceil(abs(motion.turn) / turn))
            shares.append(np.arange(1, count + 1) / count)
        return shares

    @checked
    def is_free(self, checker: MotionChecker) -> bool:
        """True if every pose on the path is free, decided exactly.

        Examples
        --------
        >>> from cfree.scene.scene import Scene
        >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
        >>> checker = MotionChecker(Scene(robot=square, obstacles=[[(2, 0), (3, 0), (3, 3)]]))
        >>> Path(Pose(0, 0), [Translation((1, 0)), Translation((0, 4))]).is_free(checker)
        True
        """
        motions = self.motions or (STILL,)
        return all(checker.is_free(pose, motion) for pose, motion in zip(self.poses, motions, strict=False))
