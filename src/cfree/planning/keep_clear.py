"""Paths that keep away from obstacles: paths of a robot grown by a margin, as far along a path as it fits.

Where a grown robot is free, the robot has the margin around it. Paths of the grown robot are searched, never decided.
So the margin is proved, but not that it is the largest.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import cache
from itertools import pairwise

from cfree.collision.motion import joining
from cfree.collision.motion_checker import MotionChecker
from cfree.collision.pose_checker import PoseChecker, are_free, is_free_at
from cfree.errors import UnsupportedError
from cfree.exact.pose import Pose, pose_at
from cfree.libraries import np
from cfree.scene.dilation import grown
from cfree.scene.scene import Scene, with_robot

WayOf = Callable[[Scene, Pose, Pose], Sequence[Pose] | None]
HALVINGS = 10  # halvings of the margin, which begins with the robot's radius
GRID_BITS = 40  # bits of the places where the grown robot begins and ends, and of their tangents: short numbers
PLACES = 16  # places on a motion at which the grown robot may begin and end


def clear(scene: Scene, checker: MotionChecker, poses: Sequence[Pose], radius: float, way_of: WayOf) -> Sequence[Pose]:
    """Return a path with margins: the largest in its middle, smaller ones towards its ends.

    Parameters
    ----------
    scene : Scene
    checker : MotionChecker
        A checker of the scene.
    poses : sequence of Pose
        Poses of a free path.
    radius : float
        The largest margin tried; each one after it is half as large.
    way_of : callable
        Returns poses of a path from one pose to another in a scene, or None if it finds none.
    """
    grid = Fraction(2) ** (GRID_BITS - math.frexp(radius)[1])

    @cache
    def larger(level: int) -> tuple[Scene, PoseChecker] | None:
        try:
            grown_scene = with_robot(scene, grown(scene, Fraction(radius) / 2**level), scene.bounds)
        except UnsupportedError:  # coordinates out of range
            return None
        return grown_scene, PoseChecker(grown_scene)

    def cleared(poses: Sequence[Pose], level: int) -> Sequence[Pose]:
        if level == HALVINGS or len(poses) < 2:
            return poses
        way = None
        if grown_robot := larger(level):
            larger_scene, larger_checker = grown_robot
            places = list(_places(poses))
            rows = np.array([(float(pose.x), float(pose.y), pose.theta) for _, pose in places])
            free = np.flatnonzero(are_free(larger_checker, rows))
            if len(free) > 1:
                (i, begin), (j, end) = places[free[0]], places[free[-1]]
                first = begin if begin in poses else short(begin, poses[i])
                last = end if end in poses else short(end, poses[j + 1])
                # the poses of the table were rounded
                if first and last and all(is_free_at(larger_checker, pose) for pose in (first, last)):
                    way = way_of(larger_scene, first, last)
        if way is not None and not checker.joins(way):  # among round shapes the scene is of polygons inside of them
            way = None
        if way is None:
            return cleared(poses, level + 1)
        assert first and last
        return [*cleared([*poses[: i + 1], first], level + 1), *way, *cleared([last, *poses[j + 1 :]], level + 1)]

    def short(place: Pose, end: Pose) -> Pose | None:
        """Round a pose on a motion to few bits, else they double each time; None if no free motion leads to an end."""
        x, y = (round(c * grid) / grid for c in (place.x, place.y))
        rounded = pose_at(x, y, place.tau and place.tau.limit_denominator(2**GRID_BITS))
        return rounded if checker.joins([end, rounded]) else None

    return cleared(poses, 0)


def _places(poses: Sequence[Pose]) -> Iterator[tuple[int, Pose]]:
    """Yield exact poses along a path, each with the number of the path's pose before it."""
    for k, (a, b) in enumerate(pairwise(poses)):
        if a != b:
            motion = joining(a, b)
            yield from ((k, motion.at(a, Fraction(share, PLACES))) for share in range(PLACES))
    yield len(poses) - 1, poses[-1]
