"""Times along a path: speeds within limits, and the pauses of a vehicle whose wheels turn while it stands."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import accumulate

from cfree.arguments import checked
from cfree.exact.half_angle import Rate, to_rate
from cfree.exact.pose import Poses
from cfree.libraries import ArrayLike, Floats, Ints, np
from cfree.paths.path import Path
from cfree.paths.ramps import Ramp, ramp_length
from cfree.paths.stops import Joint, Stop, Stops, joints, usual_wheelbase
from cfree.scene.scene import Scene, robot_radius
from cfree.scene.smooth import smooth
from cfree.vehicles.vehicle import Vehicle
from cfree.words import counted

TOO_LONG = "the drive would take longer than numbers go; give larger limits"


@checked
@dataclass(frozen=True)
class Limits:
    """Limits of a drive; see `timed`.

    Raises
    ------
    ValueError
        If one of them is not positive and finite.
    """

    speed: float
    acceleration: float | None = None
    steer_rate: float | None = None
    wheelbase: float | None = None
    stops: Stops = "all"

    def __post_init__(self) -> None:
        for name in ("speed", "acceleration", "steer_rate", "wheelbase"):
            value = getattr(self, name)
            if value is not None and not 0 < value < math.inf:
                raise ValueError(f"{name} {value}: give a positive one")

    def fault(self, vehicle: Vehicle | None) -> tuple[tuple[str, ...], str] | None:
        """Return the limits that do not fit a vehicle, with the reason and the remedy; None if they fit."""
        names = [name for name in ("acceleration", "steer_rate", "wheelbase") if getattr(self, name) is not None]
        names += ["stops"] if self.stops != "all" else []
        if vehicle is None:
            return (tuple(names), "of a vehicle's path only; give a vehicle, or leave it out") if names else None
        base = vehicle.wheelbase if self.wheelbase is None else self.wheelbase
        if self.steer_rate is not None and base is None:
            return ("steer_rate",), "the wheelbase is missing; give it as well"
        if vehicle.kind == "differential" and self.steer_rate is None and self.wheelbase is not None:
            return ("wheelbase",), "a differential drive has one if its wheel is steered; give the steer rate as well"
        return None


@dataclass(frozen=True)
class Stretch:
    """A motion in time: it speeds up evenly, keeps its speed, and slows down evenly.

    Attributes
    ----------
    unit : float
        The greatest speed of all; other speeds are multiples of it, so that no square is out of range.
    length : float
        Travel of the axle point; for a turn in place its angle; without a vehicle the travel that `unit` limits.
    first, most, last : float
        Speeds along it.
    rate : float
        Acceleration over the square of the unit; inf if it has no limit.
    turn : float
        Angle turned, with its sign.
    is_turn : bool
        True for a turn in place.
    """

    unit: float
    length: float
    first: float
    most: float
    last: float
    rate: float
    turn: float
    is_turn: bool

    @property
    def ramps(self) -> tuple[float, float]:
        """The lengths of speeding up, and of slowing down."""
        if math.isinf(self.rate):
            return 0.0, 0.0
        up, down = (max(0.0, (self.most**2 - end**2) / (2 * self.rate)) for end in (self.first, self.last))
        return up, down

    @property
    def duration(self) -> float:
        """The time it takes."""
        if self.length == 0:
            return 0.0
        up, down = self.ramps
        level = max(0.0, self.length - up - down) / self.most
        return (2 * up / (self.first + self.most) + level + 2 * down / (self.last + self.most)) / self.unit

    def after(self, shares: Floats) -> tuple[Floats, Floats]:
        """Return times since its beginning, and speeds, at shares of its length."""
        if self.length == 0:
            return np.zeros(len(shares)), np.full(len(shares), self.last * self.unit)
        (up, down), s = self.ramps, shares * self.length
        left = self.length - s
        if math.isinf(self.rate):
            return s / self.most / self.unit, np.where(left > 0, self.most, self.last) * self.unit
        early = np.sqrt(self.first**2 + 2 * self.rate * np.minimum(s, up))
        late = np.sqrt(self.last**2 + 2 * self.rate * np.minimum(left, down))
        with np.errstate(invalid="ignore"):  # 0 / 0 at the ends, where it stands
            rise = np.nan_to_num(2 * np.minimum(s, up) / (self.first + early))
            fall = np.nan_to_num(2 * np.minimum(left, down) / (self.last + late))
        slow = left <= down
        ahead = (rise + np.maximum(0.0, s - up) / self.most) / self.unit
        seconds = np.where(slow, self.duration - fall / self.unit, ahead)
        return seconds, np.minimum(np.where(slow, late, early), self.most) * self.unit

    def share(self, seconds: Floats) -> Floats:
        """Return the share of its length at times since its beginning."""
        if self.length == 0:
            return np.ones(len(seconds))
        up, down = self.ramps
        t, left = seconds * self.unit, (self.duration - seconds) * self.unit
        rise, fall = 2 * up / (self.first + self.most), 2 * down / (self.last + self.most)
        rate = 0.0 if math.isinf(self.rate) else self.rate
        early = (self.first + rate * np.minimum(t, rise) / 2) * np.minimum(t, rise)
        late = (self.last + rate * np.minimum(left, fall) / 2) * np.minimum(left, fall)
        s = np.where(left <= fall, self.length - late, early + np.maximum(0.0, t - rise) * self.most)
        return np.clip(s / self.length, 0.0, 1.0)


@dataclass(frozen=True)
class Rows:
    """Sampled poses in time: the place of each among the poses of `Path.sample`, and its motion.

    At a pause there are two rows for one pose; the second belongs to the motion that follows.
    """

    index: Ints
    motion: Ints
    seconds: Floats
    speeds: Floats
    turn_rates: Floats


@checked
@dataclass(frozen=True, repr=False)
class Timed:
    """A path in time; `timed` makes it.

    Attributes
    ----------
    path : Path
    stops : tuple of Stop
        Where the vehicle stands between start and goal.
    through : tuple of Ramp
        Jumps of curvature that it drives through, with bounds of its error; known with a steer rate only.
    reach : float
        Distance of the robot's farthest vertex from the axle point.
    limits : Limits
    duration : float, seconds

    Examples
    --------
    >>> from cfree import Car, Path, Pose, Rotation, Scene, Translation
    >>> robot = Scene(robot=[(-1, -1), (3, -1), (3, 1), (-1, 1)])
    >>> motions = [Translation((4, 0)), Rotation((4, 4), "90deg"), Translation((0, -3))]
    >>> path = Path(Pose(0, 0), motions, scene=robot, vehicle=Car(4, wheelbase=2))
    >>> drive = timed(path, speed=1, acceleration=0.5, steer_rate=0.2)
    >>> [(stop.why, stop.motion, round(stop.time, 2), round(stop.pause, 2)) for stop in drive.stops]
    [('steering', 1, 6.0, 2.32), ('cusp', 2, 19.48, 2.32)]
    >>> round(drive.duration, 2), drive.sample([3.0]).xy.round(6).tolist(), drive.speeds([3.0]).tolist()
    (26.8, [[2.0, 0.0]], [1.0])
    """

    path: Path
    stops: tuple[Stop, ...]
    through: tuple[Ramp, ...]
    reach: float
    limits: Limits
    stretches: tuple[Stretch, ...]
    begins: tuple[float, ...]  # of the motions, and the end of the last one

    def __repr__(self) -> str:
        return f"Timed({self.duration:.6g} s, {counted(len(self.stops), 'stop')})"

    @property
    def duration(self) -> float:
        """The time of the whole drive, in seconds."""
        return self.begins[-1]

    @property
    def room(self) -> float:
        """The clearance that suffices to drive through all jumps of `through`, one after the other; 0 without any."""
        return max((ramp.room(self.reach) for ramp in self.through), default=0.0)

    @checked
    def places(self, seconds: ArrayLike) -> tuple[Ints, Floats]:
        """Return motions, and the completed share of each, at times; before 0 the start, after the end the goal."""
        t = np.asarray(seconds, np.float64)
        begins = np.array(self.begins[:-1])
        motion = np.maximum(np.searchsorted(begins, t, side="right") - 1, 0)
        share = np.zeros(t.shape)
        for k in np.unique(motion) if len(begins) else ():
            stretch, chosen = self.stretches[k], motion == k
            share[chosen] = stretch.share(np.clip(t[chosen] - begins[k], 0.0, stretch.duration))
        return motion, share

    @checked
    def sample(self, seconds: ArrayLike) -> Poses:
        """Return the poses at times."""
        motion, share = self.places(seconds)
        x, theta = np.empty((len(motion), 2)), np.empty(len(motion))
        x[:], theta[:] = [float(self.path.start.x), float(self.path.start.y)], self.path.start.theta
        for k in np.unique(motion) if self.path.motions else ():
            poses = self.path.motions[k].sample(self.path.poses[k], share[motion == k])
            x[motion == k], theta[motion == k] = poses.xy, poses.theta
        return Poses(x, theta)

    @checked
    def speeds(self, seconds: ArrayLike) -> Floats:
        """Return the speeds of the axle point at times, of the limited travel without a vehicle."""
        t = np.asarray(seconds, np.float64)
        motion, share = self.places(t)
        result = np.zeros(len(t))
        for k in np.unique(motion) if self.stretches else ():
            stretch, chosen = self.stretches[k], motion == k
            if not stretch.is_turn:
                moves = t[chosen] - self.begins[k] < stretch.duration
                result[chosen] = np.where(moves, stretch.after(share[chosen])[1], stretch.last * stretch.unit)
        return result

    @checked
    def rows(self, step: float, turn: float) -> Rows:
        """Return the poses of `Path.sample` in time, with two rows at each pause."""
        paused = {stop.motion for stop in self.stops if stop.pause > 0}
        columns: list[tuple[ArrayLike, ...]] = [([0], [0], [0.0], [0.0], [0.0])]  # it stands at the start
        count = 1
        for k, shares in enumerate(self.path.shares(step, turn)):
            stretch, begin = self.stretches[k], self.begins[k]
            if k in paused:
                columns.append(([count - 1], [k], [begin], [0.0], [0.0]))
            seconds, speeds = stretch.after(shares)
            index = np.arange(count, count + len(shares))
            along = np.zeros(len(shares)) if stretch.is_turn else speeds
            columns.append((index, np.full(len(shares), k), begin + seconds, along, _turn_rate(stretch, speeds)))
            count += len(shares)
        index, motion, times, speeds, rates = (np.concatenate(column) for column in zip(*columns, strict=True))
        return Rows(index.astype(np.int64), motion.astype(np.int64), np.maximum.accumulate(times), speeds, rates)


@checked
def timed(
    path: Path,
    scene: Scene | None = None,
    *,
    speed: float,
    acceleration: float | None = None,
    steer_rate: Rate | None = None,
    wheelbase: float | None = None,
    stops: Stops = "all",
) -> Timed:
    """Return a path in time.

    Without a vehicle, each motion takes the path length of the reference point, plus the turning times the robot's
    radius about that point, over the speed. A vehicle starts, stops and drives within its limits, as fast as they let.

    Parameters
    ----------
    path : Path
    scene : Scene, optional
        The scene of the robot that moves; the path's by default.
    speed : float
        Greatest speed of any point of the robot, in lengths a second; with a vehicle, of its axle point as well.
    acceleration : float, optional
        Greatest change of these speeds along the motion, in lengths a second squared. Without it they change at once.
    steer_rate : float or str, optional
        Greatest rate at which the wheels turn, by the bicycle model: radians a second, or a text such as "30deg".
        Without it they turn at once. A differential drive for which it is given is one with a steered wheel, like a
        forklift.
    wheelbase : float, optional
        Distance of the axles; a car's own by default.
    stops : "all" or "cusps"
        A vehicle stands at cusps, before and after turns in place, and at jumps of curvature while its wheels turn.
        With "cusps" it drives through jumps of curvature: `Timed.through` has bounds of the error. It stops there only
        if the neighbouring motions are too short for the wheels to turn.

    Raises
    ------
    ValueError
        If a limit is not positive, does not fit the vehicle, or the scene is missing.

    Examples
    --------
    >>> from cfree import Path, Pose, Rotation, Scene, Translation
    >>> rod = Scene([(0, -1), (5, -1), (5, 1), (0, 1)])
    >>> path = Path((0, 0, 0), [Translation((2, 0)), Rotation((2, 0), "90deg")], scene=rod)
    >>> round(timed(path, speed=2).duration, 2)
    5.0
    """
    return timed_by(path, scene, Limits(speed, acceleration, to_rate(steer_rate, "steer_rate"), wheelbase, stops))


def timed_by(path: Path, scene: Scene | None, limits: Limits) -> Timed:
    """Return a path in time, by limits as one value."""
    if scene is None or (scene.curved and path.scene is not None):
        scene = path.scene  # it has polygons around round shapes
    scene = scene or path.curved
    if scene is None:
        raise ValueError("no scene; give the one whose robot moves")
    scene = smooth(scene)  # no point of a round robot is farther from the reference point
    if fault := limits.fault(path.vehicle):
        names, why = fault
        raise ValueError(f"{', '.join(names)}: {why}")
    if path.vehicle is None:
        radius = robot_radius(scene)
        travel = [m.length(q) + radius * abs(m.turn) for q, m in zip(path.poses, path.motions, strict=False)]
        turns = [motion.turn for motion in path.motions]
        even = [Stretch(limits.speed, s, 1.0, 1.0, 1.0, math.inf, t, False) for s, t in zip(travel, turns, strict=True)]
        return _drive(path, even, [], (), 0.0, limits)
    return _timed_vehicle(path, path.vehicle, scene, limits)


def _timed_vehicle(path: Path, vehicle: Vehicle, scene: Scene, limits: Limits) -> Timed:
    robot = np.concatenate([part.vertices for part in scene.robot])
    axle = [float(vehicle.axle[0]), float(vehicle.axle[1])]
    turning = {k for part in path.driving if part.gear == "turning" for k in range(part.first, part.last + 1)}
    lengths, most = list[float](), list[float]()  # most: speeds along, if that of all points is at most 1
    for k, (pose, motion) in enumerate(zip(path.poses, path.motions, strict=False)):
        length = abs(motion.turn) if k in turning else motion.length(pose @ vehicle.frame)
        farthest = motion.reach(pose, np.vstack([robot, axle]))
        lengths.append(length)
        most.append(length / max(farthest, 0.0 if k in turning else length) if length > 0 else math.inf)

    base = usual_wheelbase(vehicle) if limits.wheelbase is None else limits.wheelbase
    steered = base if vehicle.kind == "car" or limits.steer_rate is not None else None
    standing, through = list[Joint](), list[Ramp]()
    for joint in joints(path.driving, steered):
        if limits.stops == "all" or joint.why != "steering":
            standing.append(joint)
        elif limits.steer_rate is not None and steered is not None:
            one, other = joint.before.curvature, joint.beyond.curvature
            speed = limits.speed * max(most[joint.before.last], most[joint.beyond.first])
            length = ramp_length(speed, limits.steer_rate, steered, one, other)
            if length <= min(joint.before.length, joint.beyond.length):
                through.append(Ramp(joint.beyond.first, length, abs(other - one)))
            else:
                standing.append(joint)

    rate = math.inf if limits.acceleration is None else limits.acceleration / limits.speed / limits.speed
    ends = _speeds_at_ends(lengths, most, rate, {joint.beyond.first for joint in standing})
    stretches = list[Stretch]()
    for k, motion in enumerate(path.motions):
        first, last, its = ends[k], ends[k + 1], rate * most[k]
        peak = most[k] if math.isinf(its) else min(most[k], math.sqrt(its * lengths[k] + (first**2 + last**2) / 2))
        speeds = first, max(peak, first, last), last
        stretches.append(Stretch(limits.speed, lengths[k], *speeds, its, motion.turn, k in turning))
    pauses = [Stop(j.beyond.first, j.why, j.wheels, 0.0, j.wheels / (limits.steer_rate or math.inf)) for j in standing]
    reach = float(np.hypot(*(robot - axle).T).max())
    return _drive(path, stretches, pauses, tuple(through), reach, limits)


def _speeds_at_ends(lengths: Sequence[float], most: Sequence[float], rate: float, stops: set[int]) -> list[float]:
    """Return the speeds at the begin of each motion, and at the end of the last: 0 where the vehicle stands."""
    count = len(lengths)
    ends = [0.0, *(0.0 if k in stops else min(most[k - 1], most[k]) for k in range(1, count)), 0.0][: count + 1]
    for k in range(count):
        if lengths[k] > 0:
            ends[k + 1] = min(ends[k + 1], math.sqrt(ends[k] ** 2 + 2 * rate * most[k] * lengths[k]))
        else:
            ends[k + 1] = min(ends[k + 1], ends[k])
    for k in range(count)[::-1]:
        if lengths[k] > 0:
            ends[k] = min(ends[k], math.sqrt(ends[k + 1] ** 2 + 2 * rate * most[k] * lengths[k]))
        else:
            ends[k] = min(ends[k], ends[k + 1])
    return ends


def _drive(
    path: Path,
    stretches: Sequence[Stretch],
    stops: Sequence[Stop],
    through: tuple[Ramp, ...],
    reach: float,
    limits: Limits,
) -> Timed:
    pause = {stop.motion: stop.pause for stop in stops}
    if any(stretch.length > 0 and not stretch.most > 0 for stretch in stretches):
        raise ValueError(TOO_LONG)
    steps = ((stretch.duration, pause.get(k + 1, 0.0)) for k, stretch in enumerate(stretches))
    begins = tuple(accumulate(steps, lambda t, step: t + step[0] + step[1], initial=0.0))
    if not math.isfinite(begins[-1]):
        raise ValueError(TOO_LONG)
    marked = tuple(replace(stop, time=begins[stop.motion] - stop.pause) for stop in stops)
    return Timed(path, marked, through, reach, limits, tuple(stretches), begins)


def _turn_rate(stretch: Stretch, speeds: Floats) -> Floats:
    return speeds * (stretch.turn / stretch.length) + 0.0 if stretch.length > 0 else np.zeros(len(speeds))
