"""Leave a scene: a path to a pose beyond all obstacles, or a proof that no path leads there.

Poses whose reference point is farther from the obstacles than the robot reaches are free, and all of them are joined.
So one of them stands for every place far away, and a separation from it is a proof for all.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from fractions import Fraction

from cfree.collision.arcs import arcs_of, curves_of
from cfree.collision.motion import Translation
from cfree.collision.motion_checker import is_free_motion
from cfree.collision.nearest_free import require_free
from cfree.collision.pose_checker import is_free
from cfree.errors import InvalidPoseError, InvariantError, UnsupportedError
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose, pose_at
from cfree.paths.path import Path
from cfree.planning.plan import plan
from cfree.planning.separation import Separated
from cfree.scene.frame import frame_of
from cfree.scene.scene import Scene, box_of, robot_radius

PIECE = re.compile(r"^obstacle \d+ \((.*)\)$")
"""The name of a polygon in place of a round shape, if its number is another one."""
MOST = 64  # directions in which a straight motion is tried
UNITS: tuple[ExactPoint, ...] = tuple(
    (Fraction(x, n), Fraction(y, n))
    for a, b, n in ((0, 1, 1), (3, 4, 5), (5, 12, 13), (20, 21, 29))
    for p, q in ((a, b), (b, a))
    for x in ((p, -p) if p else (0,))
    for y in ((q, -q) if q else (0,))
)
"""Rational unit vectors all around."""


def reach_of(scene: Scene) -> tuple[ExactPoint, Fraction]:
    """Return a point and a distance: a pose whose reference point is farther from it is free.

    Examples
    --------
    >>> scene = Scene([(0, 0), (1, 0), (0, 1)], [[(2, 0), (4, 0), (4, 2), (2, 2)]])
    >>> reach_of(scene)
    ((Fraction(3, 1), Fraction(1, 1)), Fraction(5, 2))
    """
    boxes = list(zip(*map(box_of, scene.obstacles), strict=True)) or [(0.0,)] * 4
    x0, y0, x1, y1 = min(boxes[0]), min(boxes[1]), max(boxes[2]), max(boxes[3])
    far = 1.001 * (math.hypot(x1 - x0, y1 - y0) / 2 + robot_radius(scene))
    unit = Fraction(2) ** (math.ceil(math.log2(far)) - 4)
    return (Fraction((x0 + x1) / 2), Fraction((y0 + y1) / 2)), math.ceil(Fraction(far) / unit) * unit


def is_outside(scene: Scene, pose: Pose) -> bool:
    """True if a pose is so far from all obstacles that it is joined with every pose as far away."""
    (x, y), far = reach_of(scene)
    return (pose.x - x) ** 2 + (pose.y - y) ** 2 > far**2


def outside(scene: Scene, start: Pose) -> Pose:
    """Return a pose beyond all obstacles, with the orientation of another one."""
    (x, _), far = reach_of(scene)
    return pose_at(x + Fraction(9, 8) * far, start.y, start.tau)


def require_start(scene: Scene, start: Pose) -> None:
    """Check that a start is free; among other curves than arcs, that polygons do not prove it forbidden.

    Raises
    ------
    InvalidPoseError
        If it is forbidden.
    """
    if not scene.curved or arcs_of(scene) is not None:
        require_free(scene, start, "pose")
    elif is_free(scene, start) is False:
        x, y, degrees = float(start.x), float(start.y), math.degrees(start.theta)
        raise InvalidPoseError(
            f"pose ({x:g}, {y:g}, {degrees:g} deg) is forbidden: the robot overlaps an obstacle; move it"
        )


def leave(
    scene: Scene,
    start: Pose,
    *,
    improve: float | None = None,
    max_seconds: float | None = None,
    progress: Callable[[float], object] | None = None,
) -> Path | Separated:
    """Return a path to a pose beyond all obstacles, or a proof that there is none.

    Straight motions are tried first.

    Raises
    ------
    ValueError
        If the scene has bounds or a workspace.
    InvalidPoseError
        If the start is forbidden.
    IncompleteError
        As from `plan`.
    """
    if scene.bounds is not None or scene.workspace is not None:
        kind = "bounds" if scene.workspace is None else "a workspace"
        raise ValueError(f"the scene has {kind}, and nothing gets out of that; leave it out")
    require_start(scene, start)
    for vector in _pulls(scene, start):
        motion = Translation(vector)
        if _is_free(scene, start, motion):
            plain, curved = (None, scene) if scene.curved else (scene, None)
            return Path(start, [motion], scene.units, frame_of(scene), scene=plain, curved=curved)
    answer = plan(scene, start, outside(scene, start), improve=improve, max_seconds=max_seconds, progress=progress)
    if isinstance(answer, Path | Separated):
        return answer
    raise InvariantError(f"an answer of a kind that one pose does not have: {answer}", state=scene)


def holding(scene: Scene, proof: Separated) -> tuple[str, ...]:
    """Return the names of the obstacles whose contacts form a proof, in the order of the scene."""
    polygons = proof.scene if proof.curved is not None and proof.rounded is None else None
    names = (polygons or scene).obstacle_names
    own = {PIECE.sub(r"\1", names[k]) for k in proof.obstacles if k >= 0}
    return tuple(name for name in dict.fromkeys(scene.obstacle_names) if name in own)


def _is_free(scene: Scene, start: Pose, motion: Translation) -> bool:
    try:
        return is_free_motion(scene, start, motion)
    except UnsupportedError:  # round shapes with other curves than arcs
        return False


def _pulls(scene: Scene, start: Pose) -> Iterator[tuple[Fraction, Fraction]]:
    """Yield translations out of a scene: along the axes, along edges, and in directions all around."""
    (x, y), far = reach_of(scene)
    length = Fraction(9, 8) * (far + abs(start.x - x) + abs(start.y - y))
    (c, s, w), seen = start.rotation, set[ExactPoint]()
    edges = [(c * u - s * v, s * u + c * v) for u, v in _edges(scene.robot)] if w else []
    for u, v in (*UNITS[:4], *edges, *_edges(scene.obstacles), *UNITS[4:]):
        size = max(abs(u), abs(v))
        for unit in ((u / size, v / size), (-u / size, -v / size)):
            if unit not in seen and len(seen) < MOST:
                seen.add(unit)
                yield length * unit[0], length * unit[1]


def _edges(shapes: tuple[object, ...]) -> Iterator[ExactPoint]:
    for shape in shapes:
        _, rings = curves_of(shape) or (0, [])  # type: ignore[arg-type]
        for (x0, y0), (x1, y1), _, turn in (curve for ring in rings for curve in ring):
            if not turn and (x0, y0) != (x1, y1):
                yield x1 - x0, y1 - y0
