"""The name of the world's frame."""

from __future__ import annotations

from cfree.scene.scene import Scene

WORLD = "world"


def frame_of(scene: Scene) -> str:
    """Return the name that the source of a scene gives to the world's frame, such as "map"; else "world".

    Examples
    --------
    >>> robot = [(0, 0), (1, 0), (0, 1)]
    >>> frame_of(Scene(robot, source={"frame": "map"})), frame_of(Scene(robot))
    ('map', 'world')
    """
    return scene.source.get("frame") or WORLD
