"""Exact test that a path keeps its distance from everything."""

from __future__ import annotations

from copy import copy
from fractions import Fraction
from typing import TYPE_CHECKING

from cfree.collision.arcs import arcs_of
from cfree.collision.motion_checker import MotionChecker
from cfree.errors import UnsupportedError
from cfree.paths.path import Path
from cfree.scene.dilation import grown_by_square
from cfree.scene.scene import grown_scene, with_robot

if TYPE_CHECKING:
    from cfree.scene.scene import Bounds, Scene


def keeps_leeway(path: Path, scene: Scene, leeway: Fraction) -> bool:
    """True if a path is free for a robot larger by the square [-leeway, leeway]^2, in bounds smaller by as much.

    Then every pose at which each point of the robot is at most `leeway` from its place on the path is free.

    Examples
    --------
    >>> from cfree import Pose, Scene, Translation
    >>> scene = Scene([(0, 0), (1, 0), (1, 1), (0, 1)], [[(0, 2), (9, 2), (9, 3)]])
    >>> [keeps_leeway(Path(Pose(0, 0), [Translation((9, 0))]), scene, Fraction(k, 4)) for k in (4, 5)]
    [True, False]
    """
    bounds = scene.bounds
    if bounds is not None:
        x0, y0, x1, y1 = bounds
        bounds = x0 + leeway, y0 + leeway, x1 - leeway, y1 - leeway
        if bounds[0] >= bounds[2] or bounds[1] >= bounds[3]:
            return False
    if scene.curved:
        return _keeps_among_arcs(path, scene, leeway, bounds)
    try:
        larger = with_robot(scene, grown_by_square(scene, leeway) if leeway else scene.robot, bounds)
    except UnsupportedError:  # coordinates out of range
        return False
    return path.is_free(MotionChecker(larger))


def _keeps_among_arcs(path: Path, scene: Scene, leeway: Fraction, bounds: Bounds | None) -> bool:
    """Likewise for a robot larger by a disc, within these bounds."""
    larger = grown_scene(scene, leeway) if leeway else copy(scene)
    object.__setattr__(larger, "bounds", bounds)
    arcs = arcs_of(larger)
    motions = zip(path.poses, path.motions, strict=False)
    return arcs is not None and all(arcs.is_motion_free(pose, motion) for pose, motion in motions)
