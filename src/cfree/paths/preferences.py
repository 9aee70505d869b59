"""Preferences of a machine: cost factors of going sideways or backward and turning on the spot; costly motions.

Forward is the x axis of the robot's frame, which turns with the robot. The travel of the reference point counts; in the
robot's frame its direction is constant during a motion.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from cfree.arguments import checked
from cfree.paths.path import Path
from cfree.scene.scene import Scene, robot_radius

Kind = Literal["sideways", "backward", "turning"]
STEPS = 33  # poses sampled on a motion
ASKEW = math.sin(math.radians(10))  # least sine of the direction that a report calls sideways
LEAST = 0.01  # least amount in a report, in robot radii or radians


@checked
@dataclass(frozen=True)
class Preferences:
    """Cost factors of a machine's motions, relative to going forward; 1 is no preference.

    Parameters
    ----------
    sideways, backward : float, at least 1
        Cost of travel in these directions; in between as on an ellipse.
    turning : float, at least 1
        Cost of turning on the spot. A radian costs as much as travelling the robot's radius; on an arc of at least that
        radius this factor does not count.

    Raises
    ------
    ValueError
        If one is less than 1, or not finite.

    Notes
    -----
    They influence which path is found, never if there is one. If no other path is found, it has costly motions, and
    `unwanted` lists them.

    Examples
    --------
    >>> Preferences(sideways=5, turning=2)
    Preferences(sideways=5, backward=1.0, turning=2)
    """

    sideways: float = 1.0
    backward: float = 1.0
    turning: float = 1.0

    def __post_init__(self) -> None:
        for name in get_args(Kind):
            if not 1 <= getattr(self, name) < math.inf:
                raise ValueError(f"{name}={getattr(self, name)}: give a factor of 1 or more")

    @property
    def matter(self) -> bool:
        """True if any factor is more than 1."""
        return max(self.factors) > 1

    @property
    def factors(self) -> tuple[float, float, float]:
        """The factors in the order of the parameters."""
        return self.sideways, self.backward, self.turning

    @checked
    def cost(self, path: Path, scene: Scene) -> float:
        """Return the cost of a path: its length plus its turning times the robot's radius, with these factors."""
        radius, cost = robot_radius(scene), 0.0
        if not self.matter:
            return path.length + radius * path.turning
        for ahead, across, travel, turn in _motions(path):
            back = np.where(ahead < 0, self.backward, 1.0)
            dear = np.maximum(0.0, radius * turn - travel)
            factor = np.hypot(back * ahead, self.sideways * across)
            cost += float((factor * travel + radius * turn + (self.turning - 1) * dear).sum())
        return cost


NONE = Preferences()


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
    for pose, motion in zip(path.poses, path.motions, strict=False):
        dx, dy = np.diff(motion.sample(pose, shares).xy, axis=0).T
        turn = motion.turn / (STEPS - 1)
        heading, chord = pose.theta + turn * (np.arange(STEPS - 1) + 0.5), np.hypot(dx, dy)
        unit = np.where(chord > 0, chord, 1.0)
        ahead = (np.cos(heading) * dx + np.sin(heading) * dy) / unit
        across = (np.cos(heading) * dy - np.sin(heading) * dx) / unit
        yield ahead, across, chord / np.sinc(turn / (2 * np.pi)), np.full(len(chord), abs(turn))
