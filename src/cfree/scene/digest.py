"""Which scene an answer is for: a hash of all of it that decides whether a pose is free, and the robot's box.

`docs/answer-format.md`, "The scene", has the text that is hashed.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from cfree.polygons.polygon import Polygon
    from cfree.scene.scene import Bounds, Scene


@dataclass(frozen=True, slots=True)
class Stamp:
    """What an answer in a file says of its scene.

    Attributes
    ----------
    sha256 : str
        Of the scene's text: no names, units, start or goal are in it.
    robot : four numbers
        Least x and y, greatest x and y of the robot's vertices, in its own frame.
    """

    sha256: str
    robot: Bounds

    @property
    def size(self) -> Fraction:
        """The longer side of the robot's box."""
        x0, y0, x1, y1 = self.robot
        return max(x1 - x0, y1 - y0)

    @property
    def reach(self) -> Fraction:
        """No point of the robot is farther from its reference point."""
        x0, y0, x1, y1 = map(abs, self.robot)
        return max(x0, x1) + max(y0, y1)


def stamp_of(scene: Scene) -> Stamp:
    """The stamp of answers for a scene.

    Examples
    --------
    >>> from cfree.scene.scene import Scene
    >>> stamp = stamp_of(Scene([(0, 0), (0, 1), ("1/3", 0)]))
    >>> stamp.sha256[:8], *map(str, stamp.robot)
    ('240feabd', '0', '0', '1/3', '1')
    """
    text = "".join(f"{line}\n" for line in _lines(scene))
    x, y = zip(*chain.from_iterable(part.exact_vertices for part in scene.robot), strict=True)
    return Stamp(hashlib.sha256(text.encode("ascii")).hexdigest(), (min(x), min(y), max(x), max(y)))


def stamp_for(file: object, scene: Scene | None, stamp: Stamp | None) -> Stamp:
    """Of the scene, or what a file said of it.

    Raises
    ------
    ValueError
        If there is none.
    """
    if scene is not None:
        return stamp_of(scene)
    if stamp is None:
        raise ValueError(f"{file}: no scene; give the one that it is an answer for")
    return stamp


def _lines(scene: Scene) -> Iterator[str]:
    yield "cfree scene 1"
    for polygon in scene.robot:
        yield from _shape("robot", polygon)
    for polygon in scene.obstacles:
        yield from _shape("obstacle", polygon)
    if scene.workspace is not None:
        yield from _shape("workspace", scene.workspace)
    if scene.bounds is not None:
        yield f"bounds {' '.join(map(str, scene.bounds))}"


def _shape(word: str, polygon: Polygon) -> Iterator[str]:
    yield word
    for k, ring in enumerate(polygon.exact_rings):
        numbers = map(str, chain.from_iterable(ring))
        yield f"{'hole' if k else 'outer'} {' '.join(numbers)}"
