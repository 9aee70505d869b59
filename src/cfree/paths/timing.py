"""Times at the poses of a path, if no point of the robot may be faster than a speed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.paths.path import Path
from cfree.scene.scene import Scene, robot_radius


@checked
def times(path: Path, scene: Scene, speed: float, step: float, turn: float) -> NDArray[np.float64]:
    """Return the seconds since the start at each of the poses of `Path.sample`.

    Parameters
    ----------
    path : Path
    scene : Scene
        The scene of the robot that moves.
    speed : float
        Greatest speed of any point of the robot, in lengths a second. A motion takes the path length of the reference
        point, plus the turning times the robot's radius about that point, over the speed. Within it time is
        proportional to its share.
    step, turn : float
        As in `Path.sample`.

    Raises
    ------
    ValueError
        If the speed is not positive.

    Examples
    --------
    >>> from cfree.collision.motion import Rotation, Translation
    >>> rod = Scene([(0, -1), (5, -1), (5, 1), (0, 1)])
    >>> path = Path((0, 0, 0), [Translation((2, 0)), Rotation((2, 0), "90deg")])
    >>> times(path, rod, 2, 1, 1).round(2).tolist()
    [0.0, 0.5, 1.0, 3.0, 5.0]
    """
    if not speed > 0:
        raise ValueError(f"speed {speed}: give a positive one")
    radius, parts = robot_radius(scene), [np.zeros(1)]
    for pose, motion, shares in zip(path.poses, path.motions, path.shares(step, turn), strict=False):
        parts.append(parts[-1][-1] + shares * (motion.length(pose) + radius * abs(motion.turn)) / speed)
    return np.concatenate(parts)
