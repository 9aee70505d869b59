"""When a robot is where on a path, if no point of it is to be faster than a speed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.paths.path import Path
from cfree.scene.scene import Scene, robot_radius


@checked
def times(path: Path, scene: Scene, speed: float, step: float, turn: float) -> NDArray[np.float64]:
    """Seconds since the start at each of the poses of `Path.sample`.

    Parameters
    ----------
    path : Path
    scene : Scene
        Whose robot moves.
    speed : float
        Lengths a second, which no point of the robot is faster than: a motion takes the way of the reference point plus
        the turning times the robot's radius about that point, over the speed. Within it time goes with its share.
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
