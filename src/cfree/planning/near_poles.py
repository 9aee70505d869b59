"""Rotations about far poles, replaced by motions with nearer poles wherever these are proved free.

A small turn over a long distance has its pole far outside the scene. Its coordinates need more digits than most
programs have.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING

from cfree.collision.motion import Rotation, joining
from cfree.collision.motion_checker import MotionChecker
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose, pose_at

if TYPE_CHECKING:
    from cfree.scene.scene import Scene

FAR = 1000  # distance of a far pole, in sizes of the scene
PARTS = (1, 2, 4)  # parts of a motion, each replaced by a turn and a translation


def near_poles(scene: Scene, checker: MotionChecker, poses: Sequence[Pose]) -> list[Pose]:
    """Replace each motion about a far pole by at most eight motions with nearer poles, if these are free."""
    far, centres = (FAR * _size(scene, poses)) ** 2, list(dict.fromkeys(_centres(scene)))
    result = [poses[0]]
    for a, b in pairwise(poses):
        motion = joining(a, b)
        way: Sequence[Pose] | None = None
        if motion.pole and (motion.pole[0] - a.x) ** 2 + (motion.pole[1] - a.y) ** 2 > far:
            way = checker.first_free(_ways(a, motion, centres))
        result += way[1:] if way else [b]
    return result


def _ways(pose: Pose, motion: Rotation, centres: Sequence[ExactPoint]) -> Iterator[list[Pose]]:
    """Yield turns about points of the robot with translations between them, few parts first."""
    for count in PARTS:
        ends = [motion.at(pose, Fraction(k, count)) for k in range(count + 1)]
        for centre in centres:
            for turns_first in (True, False):
                way = [pose]
                for a, b in pairwise(ends):
                    way += [_turned(a, b, centre) if turns_first else _turned(b, a, centre), b]
                yield way


def _turned(a: Pose, b: Pose, centre: ExactPoint) -> Pose:
    """Return a pose turned to the orientation of another, about a point of the robot."""
    turned = pose_at(Fraction(0), Fraction(0), b.tau)
    ((x, y),), ((u, v),) = a.apply_exact([centre]), turned.apply_exact([centre])
    return pose_at(x - u, y - v, b.tau)


def _centres(scene: Scene) -> Iterator[ExactPoint]:
    """Yield the middle of the robot, its reference point, and its vertices, which may slide on something."""
    vertices = [point for part in scene.robot for point in part.exact_vertices]
    (x0, x1), (y0, y1) = ((min(axis), max(axis)) for axis in zip(*vertices, strict=True))
    yield (x0 + x1) / 2, (y0 + y1) / 2
    yield Fraction(0), Fraction(0)
    yield from vertices


def _size(scene: Scene, poses: Sequence[Pose]) -> Fraction:
    """Return the longer side, about, of the box around the world and the ends of a path, or around the robot."""
    world = [polygon.bounds for polygon in (*scene.obstacles, *([scene.workspace] if scene.workspace else []))]
    world += [(float(q.x), float(q.y)) * 2 for q in (poses[0], poses[-1])]
    if scene.bounds is not None:
        x0, y0, x1, y1 = map(float, scene.bounds)
        world.append((x0, y0, x1, y1))
    return Fraction(max(_side(world), _side([part.bounds for part in scene.robot])))


def _side(boxes: Sequence[tuple[float, float, float, float]]) -> float:
    """Return the longer side of the box around some."""
    x0, y0, x1, y1 = zip(*boxes, strict=True)
    return float(max(max(x1) - min(x0), max(y1) - min(y0)))
