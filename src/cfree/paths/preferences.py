"""What a machine would rather not do, and where a path does it: go sideways or backward, turn on the spot.

Forward is the x axis of the robot's frame, which turns with the robot. The way of the reference point counts; the robot
sees it in one direction all along a motion.
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
STEPS = 33  # poses of a motion
ASKEW = math.sin(math.radians(10))  # less is not sideways, for a report
LEAST = 0.01  # of the robot's radius, and radians: less is not reported


@checked
@dataclass(frozen=True)
class Preferences:
    """How much dearer than going forward a machine finds what it would rather not do; 1: not at all.

    Parameters
    ----------
    sideways, backward : float, at least 1
        What travel costs in these directions; in between as on an ellipse.
    turning : float, at least 1
        What turning on the spot costs. A radian is as dear as travelling the robot's radius; on an arc at least as wide
        as that this factor does not count.

    Raises
    ------
    ValueError
        If one is less than 1, or not finite.

    Notes
    -----
    They decide which path is found, never whether there is one: where nothing else is found, a path does what is dear,
    and `unwanted` says where.

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
        """Is anything dearer?"""
        return max(self.factors) > 1

    @property
    def factors(self) -> tuple[float, float, float]:
        """In the order of the parameters."""
        return self.sideways, self.backward, self.turning

    @checked
    def cost(self, path: Path, scene: Scene) -> float:
        """Of a path in a scene: its length, plus turning times the robot's radius, with these factors."""
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
    """Some motions, one after the other, that do what a machine would rather not.

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
        """In words.

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
    """Where a path does what a machine would rather not: what it finds dearer than 1.

    Parameters
    ----------
    path : Path
    scene : Scene
        Whose robot moves.
    preferences : Preferences

    Returns
    -------
    tuple of Unwanted
        By kind, in the order of the path. Sideways: more than 10 degrees off ahead and back. Of one motion less than a
        hundredth of the robot's radius, or of a radian, is left out.

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
    found = []
    for (kind, values), factor in zip(amounts.items(), preferences.factors, strict=True):
        counts = np.array(values) > LEAST * (1.0 if kind == "turning" else radius)
        if factor == 1 or not counts.any():
            continue
        edges = np.flatnonzero(np.diff(np.concatenate([[False], counts, [False]])))
        found += [Unwanted(kind, sum(values[i:j]), i, j - 1) for i, j in edges.reshape(-1, 2).tolist()]
    return tuple(found)


def _motions(path: Path) -> Iterator[tuple[np.ndarray, ...]]:
    """Of each motion in steps: the direction of travel as the robot sees it, ahead and across; travel; radians."""
    shares = np.linspace(0.0, 1.0, STEPS)
    for pose, motion in zip(path.poses, path.motions, strict=False):
        dx, dy = np.diff(motion.sample(pose, shares).xy, axis=0).T
        turn = motion.turn / (STEPS - 1)
        heading, chord = pose.theta + turn * (np.arange(STEPS - 1) + 0.5), np.hypot(dx, dy)
        unit = np.where(chord > 0, chord, 1.0)
        ahead = (np.cos(heading) * dx + np.sin(heading) * dy) / unit
        across = (np.cos(heading) * dy - np.sin(heading) * dx) / unit
        yield ahead, across, chord / np.sinc(turn / (2 * np.pi)), np.full(len(chord), abs(turn))
