"""`is_caged`: a body that no motion leads out of its fingers, with a proof; or a path out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from cfree.analysis.leaving import holding, is_outside, leave
from cfree.arguments import checked
from cfree.caging.fingers import (
    FIRST,
    MOST,
    NEXT,
    Finger,
    Setting,
    is_within,
    radius_of,
    setting,
    to_body,
    to_fingers,
)
from cfree.errors import UndecidedError
from cfree.exact.pose import Pose, PoseLike
from cfree.lazy import registered
from cfree.paths.path import Path
from cfree.planning.separation import Separated
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import AnyShape, Scene, polygons_for
from cfree.value import Value

Progress = Callable[[float], object]


@dataclass(frozen=True, eq=False, repr=False)
class Cage(Value):
    """The answer of `is_caged`: true if the body is caged.

    Attributes
    ----------
    body : tuple of shapes
    fingers : tuple of points and shapes
    pose : Pose
    answer : Separated or Path
        A proof that no motion leads out of the fingers, not even one that touches them all the way; or a path out.
    scene : Scene
        The scene of the answer, with start and goal: `cfree.verify.answer(scene, answer)` checks it. It has triangles
        for fingers that are points, and for a proof then also a body that is a little smaller.
    within : Fraction
        Bound of the size of these triangles, and of the distance of the smaller body from the body's rim; 0 without
        points.
    """

    body: tuple[AnyShape, ...]
    fingers: tuple[Finger, ...]
    pose: Pose
    answer: Path | Separated
    scene: Scene
    within: Fraction = Fraction(0)

    def __bool__(self) -> bool:
        return isinstance(self.answer, Separated)

    def __repr__(self) -> str:
        return f"Cage({'caged' if self else 'not caged'}: {self.answer!r})"

    @property
    def proof(self) -> Separated | None:
        """The proof that the body is caged; None if it is not."""
        return self.answer if isinstance(self.answer, Separated) else None

    @property
    def path(self) -> Path | None:
        """The path on which the body escapes; None if it is caged."""
        return self.answer if isinstance(self.answer, Path) else None

    @cached_property
    def holding(self) -> tuple[int, ...]:
        """The fingers whose contacts form the proof: these alone cage the body. Empty if it is not caged."""
        names = self.scene.obstacle_names
        return () if self.proof is None else tuple(names.index(name) for name in holding(self.scene, self.proof))

    def verified(self) -> bool:
        """True if independent code confirms the answer, and that it holds for fingers that are points.

        Examples
        --------
        >>> is_caged([(0, 0), (2, 0), (2, 2), (0, 2)], [(1, 0), (2, 1), (1, 2), (0, 1)]).verified()
        True
        """
        from cfree.verify.answers import answer as verified_answer

        if not verified_answer(self.scene, self.answer).verified or not is_outside(self.scene, self.answer.goal):
            return False
        points = {k: finger for k, finger in enumerate(self.fingers) if isinstance(finger, tuple)}
        if not points:
            return True
        triangles = {k: self.scene.obstacles[k].exact_rings[0] for k in points}
        if not all(points[k] in triangles[k] for k in points):
            return False
        if isinstance(self.answer, Path):
            return True
        e = self.within
        near = all((x - u) ** 2 + (y - v) ** 2 <= e * e for k, (x, y) in points.items() for u, v in triangles[k])
        return near and all(any(_is_deep(inner, outer, e) for outer in self.body) for inner in self.scene.robot)

    def plot(self) -> Any:
        """Draw the body, the fingers, and the path out; or the poses that the caged body can reach.

        Returns
        -------
        matplotlib figure
        """
        return registered("cage figure")(self)


@checked
def is_caged(
    body: Any,
    fingers: Sequence[Any],
    pose: PoseLike = (0, 0, 0),
    *,
    max_seconds: float | None = None,
    progress: Progress | None = None,
) -> Cage:
    """Decide if fingers cage a body: no rigid motion leads it arbitrarily far away from them.

    Parameters
    ----------
    body : shape or sequence of shapes
        The object that moves, like the robot of a `Scene`.
    fingers : sequence of points and shapes
        Each finger stands still. It is a point (x, y), a disc `Curved.circle`, a polygon, or another `Curved`.
    pose : Pose or (x, y, theta)
        Pose of the body; contact is allowed.
    max_seconds : float, optional
        Time limit of each attempt to decide.
    progress : callable, optional
        Called with the completed share, from 0 to 1.

    Returns
    -------
    Cage
        True with a proof, or false with a path out. The proof excludes motions that touch the fingers as well.

    Raises
    ------
    ForbiddenPoseError, InvalidPoseError
        If the body overlaps a finger at the pose.
    UndecidedError
        If only motions that touch all the way may lead out, or round shapes or points almost do.
    IncompleteError
        If `max_seconds` ran out.

    Notes
    -----
    Points are exact: a tiny triangle with a corner at the point stands for it in a path, and the same triangle with a
    slightly smaller body in a proof. They are made smaller, from 2**-10 of the body's size to 2**-50, until one of both
    answers is found.

    Examples
    --------
    >>> square = [(0, 0), (2, 0), (2, 2), (0, 2)]
    >>> cage = is_caged(square, [(1, 0), (2, 1), (1, 2), (0, 1)])
    >>> bool(cage), cage.proof.of
    (True, 'closed')
    >>> is_caged(square, [(1, 0), (2, 1), (1, 2)]).path
    Path(1 motion, length 7.31346, turning 0)
    """
    shapes, start = to_body(body, pose)
    return cage_of(shapes, to_fingers(fingers), start, max_seconds=max_seconds, progress=progress)


def cage_of(
    body: tuple[AnyShape, ...],
    fingers: tuple[Finger, ...],
    pose: Pose,
    *,
    units: str = "",
    names: Sequence[str] = (),
    improve: float | None = None,
    max_seconds: float | None = None,
    progress: Progress | None = None,
) -> Cage:
    """Decide as `is_caged` does, from exact values."""
    options: dict[str, Any] = {"improve": improve, "max_seconds": max_seconds, "progress": progress}
    for bits in range(FIRST, MOST + 1, NEXT):
        place = setting(body, fingers, pose, bits, units, names)
        answer = _answer(place, pose, options, is_last=bits + NEXT > MOST)
        if answer is not None:
            scene = place.scene if isinstance(answer, Path) else place.smaller
            return Cage(body, fingers, pose, answer, _with_ends(scene, pose, answer.goal), place.within)
    raise UndecidedError(
        f"undecided: a gap between fingers is within 2**-{MOST} of the body's size; move a finger, or give it a size"
    )


def _answer(place: Setting, pose: Pose, options: dict[str, Any], *, is_last: bool) -> Path | Separated | None:
    """Return a path among the triangles, or a proof for the smaller body; None if neither exists."""
    answer = leave(place.scene, pose, **options)
    if isinstance(answer, Separated) and place.smaller is not place.scene:
        answer = leave(place.smaller, pose, **options)
        if isinstance(answer, Path):
            return None
    if isinstance(answer, Separated) and (answer.of != "closed" or (place.within and place.smaller is place.scene)):
        if place.within and not is_last:
            return None
        raise UndecidedError(
            "undecided: the body is caged against every motion that keeps a distance from the fingers; one that "
            "touches them all the way may lead out. Move a finger a little, or change a size"
        )
    return answer


def _is_deep(inner: AnyShape, outer: AnyShape, within: Fraction) -> bool:
    """True if a shape is inside another one, at least so far from its rim."""
    one, other = radius_of(inner), radius_of(outer)
    if one and other:
        return one[0] == other[0] and one[1] + within <= other[1]
    polygons = polygons_for(outer, float(within) / 4, False)
    return isinstance(inner, Polygon) and any(is_within(inner, polygon, within) for polygon in polygons)


def _with_ends(scene: Scene, start: Pose, goal: Pose) -> Scene:
    names, units = scene.obstacle_names, scene.units
    return Scene(scene.robot, scene.obstacles, obstacle_names=names, start=start, goal=goal, units=units)
