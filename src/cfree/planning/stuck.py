"""`Stuck`: a proof that a vehicle cannot leave its start, or arrive at its goal, because of contacts there."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import Literal, NoReturn

from cfree.arguments import checked
from cfree.exact.pose import Pose
from cfree.planning.separation import NO_TRUTH_VALUE
from cfree.scene.digest import Stamp, Whole
from cfree.scene.goals import Moved
from cfree.scene.scene import Scene
from cfree.value import Answer, Shown
from cfree.vehicles.vehicle import Vehicle, described
from cfree.words import counted, listed


@checked
@dataclass(frozen=True, repr=False)
class Stuck(Shown, Answer):
    """A proof that no motion of a vehicle leads away from its start, or to its goal.

    It has no truth value: ``if cfree.plan(scene):`` raises a `TypeError` where a vehicle is stuck.
    ``isinstance(answer, cfree.Path)`` tells paths from proofs.

    Attributes
    ----------
    start, goal : Pose
    vehicle : Car or DifferentialDrive
    at : "start" or "goal"
        The end at which the robot touches something, and is stuck.
    of : "pieces" or "paths"
        "pieces": no path of finitely many lines and arcs of the vehicle leads away from its contacts there. "paths":
        no path of finite length does, of any vehicle with this axle, whatever its radius.
    rail : tuple of Pose
        All poses, up to those between them on one line, that the vehicle reaches while it keeps touching; the end
        itself is the first. None of them has a motion that leaves.
    obstacles : tuple of int
        The obstacles that it touches; -1 is the bounds, -2 the workspace.
    units, frame : str
        Unit of length, and name of the world's frame, for files.
    scene : Scene, optional
        The scene of the proof; None if it was read from a file.
    stamp : Stamp, optional
        The scene's stamp in the file.
    curved : Scene, optional
        The scene with round shapes, if it is a proof for these.
    moved : Moved, optional
        The requested start and goal, if they were moved to free poses.
    whole : Whole, optional
        The scene of which `scene` has only some obstacles, if a folder was asked.

    Examples
    --------
    >>> from cfree import Car, Scene, plan
    >>> ahead, behind = [(2, -3), (3, -3), (3, 3), (2, 3)], [(-3, -3), (-2, -3), (-2, 3), (-3, 3)]
    >>> scene = Scene([(-2, -1), (2, -1), (2, 1), (-2, 1)], [ahead, behind])
    >>> proof = plan(scene, (0, 0, 0), (0, 9, 0), vehicle=Car(4))
    >>> proof, proof.pose == proof.start
    (Stuck(at='start', of='paths', 1 pose touching (0, 1)), True)
    >>> proof.sentence()
    'no path of finite length lets a vehicle with this axle leave its start, whatever its turning radius'
    """

    start: Pose
    goal: Pose
    vehicle: Vehicle
    at: Literal["start", "goal"]
    of: Literal["pieces", "paths"]
    rail: tuple[Pose, ...]
    obstacles: tuple[int, ...]
    units: str = field(default="", compare=False)
    frame: str = field(default="world", compare=False)
    scene: Scene | None = field(default=None, compare=False)
    stamp: Stamp | None = field(default=None, compare=False)
    curved: Scene | None = field(default=None, compare=False)
    moved: Moved | None = None
    whole: Whole | None = field(default=None, compare=False)

    @property
    def clearance(self) -> Fraction:
        """0: it is about contacts."""
        return Fraction(0)

    @property
    def pose(self) -> Pose:
        """The end at which it is stuck."""
        return self.start if self.at == "start" else self.goal

    def __bool__(self) -> NoReturn:
        raise TypeError(f"{type(self).__name__}: {NO_TRUTH_VALUE}")

    def __repr__(self) -> str:
        obstacles = listed([str(k) for k in self.obstacles], ", ")
        return f"Stuck(at={self.at!r}, of={self.of!r}, {counted(len(self.rail), 'pose')} touching ({obstacles}))"

    def said(self) -> str:
        """Return the sentence with the end that it is about."""
        return f"{self.at}: {self.sentence()}"

    def sentence(self) -> str:
        """Write the proof in a sentence."""
        way = f"leave its {self.at}" if self.at == "start" else f"arrive at its {self.at}"
        if self.of == "paths":
            return f"no path of finite length lets a vehicle with this axle {way}, whatever its turning radius"
        return f"no path of finitely many lines and arcs lets {described(self.vehicle, self.units)} {way}"
