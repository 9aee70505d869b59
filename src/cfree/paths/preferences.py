"""Preferences of a machine: cost factors of going sideways or backward and turning on the spot; costly motions.

Forward is the x axis of the robot's frame, which turns with the robot. The travel of the reference point counts; in the
robot's frame its direction is constant during a motion. A vehicle has its own forward, and its axle point counts.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, get_args

from cfree.arguments import checked
from cfree.libraries import np
from cfree.paths.path import Path
from cfree.paths.stops import joints, usual_wheelbase
from cfree.scene.scene import Scene, polygons_around, robot_radius
from cfree.vehicles.vehicle import Vehicle

Kind = Literal["sideways", "backward", "turning"]
BACKWARD = 1.5  # default factor for vehicles
STEPS = 33  # poses sampled on a motion
ASKEW = math.sin(math.radians(10))  # least sine of the direction that a report calls sideways
LEAST = 0.01  # least amount in a report, in robot radii or radians


@checked
@dataclass(frozen=True)
class Dues:
    """Costs of driving: the factor of going backward; a cusp, another stop, a radian in place; the robot's length."""

    backward: float
    cusp: float
    stop: float
    in_place: float
    length: float


@checked
@dataclass(frozen=True)
class Preferences:
    """Cost factors of a machine's motions, relative to going forward; 1 is no preference.

    Parameters
    ----------
    sideways, backward : float, at least 1
        Cost of travel in these directions; in between as on an ellipse.
        By default 1; for a path of a vehicle 1.5 backward, and it has no way sideways.
    turning : float, at least 1
        Cost of turning on the spot. A radian costs as much as travelling the robot's radius; on an arc of at least that
        radius this factor does not count.
    cusp : float, at least 0, optional
        Cost of a change between forward and backward, as a length in the scene's unit; of vehicles only. By default the
        robot's length.
    stop : float, at least 0, optional
        Cost of another stop, as a length: where the wheels of a car turn, and for a turn in place; of vehicles only. A
        quarter of a cusp's cost by default.

    Raises
    ------
    ValueError
        If a factor is less than 1, the cost of a cusp or a stop negative, or one of them not finite.

    Notes
    -----
    They influence which path is found, never if there is one. If no other path is found, it has costly motions, and
    `unwanted` lists them.

    Examples
    --------
    >>> Preferences(sideways=5, turning=2)
    Preferences(sideways=5, backward=None, turning=2, cusp=None, stop=None)
    """

    sideways: float = 1.0
    backward: float | None = None
    turning: float = 1.0
    cusp: float | None = None
    stop: float | None = None

    def __post_init__(self) -> None:
        for name, factor in zip(get_args(Kind), self.factors, strict=True):
            if not 1 <= factor < math.inf:
                raise ValueError(f"{name}={factor}: give a factor of 1 or more")
        for name, length in (("cusp", self.cusp), ("stop", self.stop)):
            if length is not None and not 0 <= length < math.inf:
                raise ValueError(f"{name}={length}: give a length of 0 or more")

    @property
    def matter(self) -> bool:
        """True if any factor is more than 1."""
        return max(self.factors) > 1

    @property
    def factors(self) -> tuple[float, float, float]:
        """The factors in the order of the parameters."""
        return self.sideways, 1.0 if self.backward is None else self.backward, self.turning

    @checked
    def cost(self, path: Path, scene: Scene) -> float:
        """Return the cost of a path: its length plus its turning times the robot's radius, with these factors.

        The cost of a vehicle's path is that of its travel, of its turns in place, and of its cusps and other stops.
        """
        radius, cost = robot_radius(scene), 0.0
        if path.vehicle is not None:
            dues = dues_of(self, scene, path.vehicle)
            for part in path.driving:
                factor = dues.backward if part.gear == "backward" else 1.0
                cost += factor * part.length + (dues.in_place * abs(part.angle) if part.gear == "turning" else 0.0)
            kinds = [joint.why for joint in joints(path.driving, usual_wheelbase(path.vehicle))]
            in_place = sum(part.gear == "turning" for part in path.driving)
            return cost + dues.cusp * path.cusps + dues.stop * (kinds.count("steering") + in_place)
        if not self.matter:
            return path.length + radius * path.turning
        for ahead, across, travel, turn in _motions(path):
            back = np.where(ahead < 0, self.factors[1], 1.0)
            dear = np.maximum(0.0, radius * turn - travel)
            factor = np.hypot(back * ahead, self.sideways * across)
            cost += float((factor * travel + radius * turn + (self.turning - 1) * dear).sum())
        return cost


NONE = Preferences()


def robot_length(scene: Scene, vehicle: Vehicle) -> float:
    """Return the longer side of the box around the robot along the vehicle's forward direction.

    Examples
    --------
    >>> from cfree import Car
    >>> robot_length(Scene(robot=[(-1, -1), (3, -1), (3, 1), (-1, 1)]), Car(4, heading="90deg"))
    4.0
    """
    points = np.concatenate([polygon.vertices for part in scene.robot for polygon in polygons_around(part)])
    extents = np.ptp(vehicle.frame.inverse().apply(points), axis=0)
    return float(extents.max())


def dues_of(preferences: Preferences, scene: Scene, vehicle: Vehicle) -> Dues:
    """Return the costs of a vehicle, with their defaults."""
    length = robot_length(scene, vehicle)
    cusp = length if preferences.cusp is None else preferences.cusp
    return Dues(
        backward=BACKWARD if preferences.backward is None else preferences.backward,
        cusp=cusp,
        stop=cusp / 4 if preferences.stop is None else preferences.stop,
        in_place=preferences.turning * robot_radius(scene),
        length=length,
    )


@checked
@dataclass(frozen=True)
class Unwanted:
    """A run of costly motions on a path.

    Parameters
    ----------
    kind : "sideways", "backward" or "turning"
    amount : float
        A length, or radians turned on the spot.
    first, last : int
        The motions of the path.
    """

    kind: Kind
    amount: float
    first: int
    last: int

    @checked
    def text(self, units: str = "") -> str:
        """Write it in words.

        Examples
        --------
        >>> Unwanted("sideways", 0.25, 3, 5).text("m"), Unwanted("turning", 1.5, 2, 2).text()
        ('0.25 m sideways in motions 3 to 5', '85.9 degrees on the spot in motion 2')
        """
        where = f"motion {self.first}" if self.first == self.last else f"motions {self.first} to {self.last}"
        if self.kind == "turning":
            return f"{math.degrees(self.amount):.3g} degrees on the spot in {where}"
        return f"{self.amount:.3g}{units and ' '}{units} {self.kind} in {where}"


@checked
def unwanted(path: Path, scene: Scene, preferences: Preferences) -> tuple[Unwanted, ...]:
    """Return the costly motions of a path: those with a cost factor of more than 1.

    Parameters
    ----------
    path : Path
    scene : Scene
        The scene of the robot that moves.
    preferences : Preferences

    Returns
    -------
    tuple of Unwanted
        By kind, in the order of the path. Sideways means more than 10 degrees off the forward and backward directions.
        Amounts of less than a hundredth of the robot's radius, or of a radian, in one motion are left out.

    Examples
    --------
    >>> from cfree import Path, Pose, Rotation, Scene, Translation
    >>> fork = Scene(robot=[(-1, -1), (1, -1), (1, 1), (-1, 1)])
    >>> turn = Rotation((3, 2), "90deg")
    >>> path = Path(Pose(0, 0), [Translation((3, 0)), Translation((0, 2)), turn, Translation((0, 1))])
    >>> [(part.kind, round(part.amount, 2), part.first) for part in unwanted(path, fork, Preferences(5, 5, 5))]
    [('sideways', 2.0, 1), ('turning', 1.57, 2)]
    """
    radius = robot_radius(scene)
    amounts: dict[Kind, list[float]] = {"sideways": [], "backward": [], "turning": []}
    for ahead, across, travel, turn in _motions(path):
        amounts["sideways"].append(float((travel * np.abs(across))[np.abs(across) > ASKEW].sum()))
        amounts["backward"].append(float(-(travel * ahead)[ahead < -ASKEW].sum()))
        amounts["turning"].append(float(np.maximum(0.0, turn - travel / radius).sum()))
    runs = []
    for (kind, values), factor in zip(amounts.items(), preferences.factors, strict=True):
        counts = np.array(values) > LEAST * (1.0 if kind == "turning" else radius)
        if factor == 1 or not counts.any():
            continue
        edges = np.flatnonzero(np.diff(np.concatenate([[False], counts, [False]])))
        runs += [Unwanted(kind, sum(values[i:j]), i, j - 1) for i, j in edges.reshape(-1, 2).tolist()]
    return tuple(runs)


def _motions(path: Path) -> Iterator[tuple[np.ndarray, ...]]:
    """Yield each motion in steps: direction of travel in the robot's frame, ahead and across; travel; radians."""
    shares = np.linspace(0.0, 1.0, STEPS)
    for robot, motion in zip(path.poses, path.motions, strict=False):
        pose = robot @ path.vehicle.frame if path.vehicle else robot
        dx, dy = np.diff(motion.sample(pose, shares).xy, axis=0).T
        turn = motion.turn / (STEPS - 1)
        heading, chord = pose.theta + turn * (np.arange(STEPS - 1) + 0.5), np.hypot(dx, dy)
        unit = np.where(chord > 0, chord, 1.0)
        ahead = (np.cos(heading) * dx + np.sin(heading) * dy) / unit
        across = (np.cos(heading) * dy - np.sin(heading) * dx) / unit
        yield ahead, across, chord / np.sinc(turn / (2 * np.pi)), np.full(len(chord), abs(turn))
