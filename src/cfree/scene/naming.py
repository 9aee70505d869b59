"""Names of obstacles in messages, tables and pictures: the number, the size and the place."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from typing import TYPE_CHECKING

from cfree.scene.features import NAMES
from cfree.scene.scene import box_of, default_name
from cfree.words import listed

if TYPE_CHECKING:
    from cfree.scene.scene import Scene

DIGITS = 2  # digits of a size and a place, after the first digit of the size


def numbered(scene: Scene, obstacle: int) -> str:
    """Return the number of an obstacle, and its name if it has one; or the name of bounds and workspace.

    Examples
    --------
    >>> from cfree.scene.scene import Scene
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> scene = Scene(square, [square, square], obstacle_names=[None, "desk"])
    >>> numbered(scene, 0), numbered(scene, 1), numbered(scene, -1)
    ('obstacle 0', 'obstacle 1 (desk)', 'the bounds')
    """
    if obstacle in NAMES:
        return f"the {NAMES[obstacle]}"
    name = scene.obstacle_names[obstacle]
    # obstacles of a part of a scene, and pieces of a round shape, keep their numbers in the whole scene as names
    return name if re.fullmatch(r"obstacle \d+( \(.*\))?", name) else f"{default_name(obstacle)} ({name})"


def placed(scene: Scene, obstacle: int) -> str:
    """Return the number and name of an obstacle, with the sides of its box and the middle of it.

    Examples
    --------
    >>> from cfree.scene.scene import Scene
    >>> pin = [("3.175", "-1.425"), ("3.225", "-1.425"), ("3.225", "-1.375"), ("3.175", "-1.375")]
    >>> placed(Scene([(0, 0), (1, 0), (1, 1), (0, 1)], [pin]), 0)
    'obstacle 0, 0.05 x 0.05 at (3.2, -1.4)'
    """
    if obstacle in NAMES:
        return numbered(scene, obstacle)
    x0, y0, x1, y1 = box_of(scene.obstacles[obstacle])
    width, height, place = x1 - x0, y1 - y0, ((x0 + x1) / 2, (y0 + y1) / 2)
    digits = max(0, DIGITS - math.floor(math.log10(max(width, height))))
    x, y = (f"{round(c, digits) + 0.0:.12g}" for c in place)
    return f"{numbered(scene, obstacle)}, {_length(width)} x {_length(height)} at ({x}, {y})"


def _length(value: float) -> str:
    return f"{value:.0f}" if 1000 <= value < 1e6 else f"{value:.3g}"


def all_placed(scene: Scene, obstacles: Iterable[int]) -> str:
    """Return the same of several obstacles; of many, only the first few.

    Examples
    --------
    >>> from cfree.scene.scene import Scene
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> all_placed(Scene(square, [square]), [-1, 0])
    'the bounds; obstacle 0, 1 x 1 at (0.5, 0.5)'
    """
    # pieces of one shape have one name
    numbers = list(obstacles)
    first = {numbered(scene, k): k for k in reversed(numbers)}
    return listed([placed(scene, k) for k in numbers if first[numbered(scene, k)] == k])
