"""The smallest scene that still shows a fault, for a report."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import suppress

from cfree.errors import CfreeError
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene


def smallest_scene(scene: Scene, fails: Callable[[Scene], bool], *, seconds: float = 20.0) -> Scene:
    """Remove obstacles, parts of the robot, bounds, holes and vertices as long as the fault stays.

    Parameters
    ----------
    scene : Scene
        A scene that fails.
    fails : callable
    seconds : float
        Time limit; the smallest scene found by then is returned.

    Examples
    --------
    >>> triangle, square = [(0, 0), (1, 0), (0, 1)], [(4, 0), (5, 0), (5, 1), (4, 1)]
    >>> small = smallest_scene(Scene([square, triangle], [triangle, square]), lambda scene: len(scene.obstacles) > 0)
    >>> small
    Scene(robot: 3 vertices; 1 obstacle: 3 vertices)
    """
    until = time.monotonic() + seconds
    is_smaller = True
    while is_smaller:
        is_smaller = False
        for smaller in _smaller(scene):
            if time.monotonic() > until:
                return scene
            try:
                is_smaller = fails(smaller)
            except CfreeError:
                continue
            if is_smaller:
                scene = smaller
                break
    return scene


def _smaller(scene: Scene) -> Iterator[Scene]:
    """Yield scenes with something removed, large parts first."""
    robot, obstacles = scene.robot, scene.obstacles
    share = len(obstacles)
    while share >= 1:
        for k in range(0, len(obstacles), share):
            yield _made(scene, robot, obstacles[:k] + obstacles[k + share :])
        share //= 2
    if len(robot) > 1:
        for k in range(len(robot)):
            yield _made(scene, robot[:k] + robot[k + 1 :], obstacles)
    if scene.workspace is not None:
        yield Scene(robot, obstacles, bounds=scene.bounds)
    if scene.bounds is not None:
        yield Scene(robot, obstacles, workspace=scene.workspace)
    for shapes, is_robot in ((robot, True), (obstacles, False)):
        for k, polygon in enumerate(shapes):
            for simpler in _simpler(polygon):
                changed = (*shapes[:k], simpler, *shapes[k + 1 :])
                yield _made(scene, changed if is_robot else robot, obstacles if is_robot else changed)


def _made(scene: Scene, robot: tuple[Polygon, ...], obstacles: tuple[Polygon, ...]) -> Scene:
    return Scene(robot, obstacles, bounds=scene.bounds, workspace=scene.workspace)


def _simpler(polygon: Polygon) -> Iterator[Polygon]:
    """Yield the polygon without one hole, and without one vertex where the rest is a polygon."""
    outer, *holes = map(list, polygon.exact_rings)
    for k in range(len(holes)):
        yield Polygon(outer, holes[:k] + holes[k + 1 :])
    for ring in (outer, *holes):
        for k in range(len(ring) if len(ring) > 3 else 0):
            point = ring.pop(k)
            with suppress(CfreeError):
                yield Polygon(outer, holes)
            ring.insert(k, point)
