"""Stamps of scenes in answers: a hash of everything that decides whether a pose is free, and the robot's box.

`docs/answer-format.md`, "The scene", defines the hashed text.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import chain
from typing import TYPE_CHECKING

from cfree.curves.curved import Curved
from cfree.curves.drawn import Line
from cfree.curves.rings import Cubic, Piece
from cfree.exact.number import ExactPoint
from cfree.polygons.polygon import Polygon
from cfree.scene.reading import Note

if TYPE_CHECKING:
    from cfree.scene.scene import AnyShape, Bounds, Scene


@dataclass(frozen=True, slots=True)
class Stamp:
    """The identity of its scene that an answer in a file carries.

    Attributes
    ----------
    sha256 : str
        Hash of the scene's text, which has no names, units, start or goal.
    robot : four numbers
        Least x and y, greatest x and y of the robot's vertices, in its own frame.
    reading : tuple of Note
        The scene's record of reading; no part of the identity.
    """

    sha256: str
    robot: Bounds
    reading: tuple[Note, ...] = field(default=(), compare=False)

    @property
    def size(self) -> Fraction:
        """The longer side of the robot's box."""
        x0, y0, x1, y1 = self.robot
        return max(x1 - x0, y1 - y0)

    @property
    def reach(self) -> Fraction:
        """A bound of the distance of the robot's points from its reference point."""
        x0, y0, x1, y1 = map(abs, self.robot)
        return max(x0, x1) + max(y0, y1)


@dataclass(frozen=True, slots=True)
class Whole:
    """The scene of which the scene of an answer has some obstacles, and all else.

    Attributes
    ----------
    sha256 : str
        As of `Stamp`.
    obstacles : tuple of int
        The numbers of these obstacles in it, in increasing order.
    """

    sha256: str
    obstacles: tuple[int, ...]


def stamp_of(scene: Scene) -> Stamp:
    """Return the stamp of answers for a scene.

    Examples
    --------
    >>> from cfree.scene.scene import Scene
    >>> stamp = stamp_of(Scene([(0, 0), (0, 1), ("1/3", 0)]))
    >>> stamp.sha256[:8], *map(str, stamp.robot)
    ('240feabd', '0', '0', '1/3', '1')
    """
    digest = SceneDigest(scene)
    for shape in scene.obstacles:
        digest.add(shape)
    x, y = zip(*chain.from_iterable(map(_corners, scene.robot)), strict=True)
    return Stamp(digest.sha256, (min(x), min(y), max(x), max(y)), scene.reading)


def _corners(shape: AnyShape) -> Sequence[ExactPoint]:
    """Return the vertices of a polygon, or two corners of the box around a round shape."""
    if isinstance(shape, Polygon):
        return shape.exact_vertices
    x0, y0, x1, y1 = shape.box
    return (x0, y0), (x1, y1)


def stamp_for(file: object, scene: Scene | None, stamp: Stamp | None) -> Stamp:
    """Return the stamp of the scene, or else the one read from a file.

    Raises
    ------
    ValueError
        If there is neither.
    """
    if scene is not None:
        return stamp_of(scene)
    if stamp is None:
        raise ValueError(f"{file}: no scene; give the one that it is an answer for")
    return stamp


class SceneDigest:
    """The hash of a scene to which obstacles are added one after the other; those of `scene` do not count.

    Examples
    --------
    >>> from cfree.scene.scene import Scene
    >>> triangle = [(0, 0), (1, 0), (0, 1)]
    >>> digest, whole = SceneDigest(Scene(triangle)), Scene(triangle, [triangle])
    >>> digest.add(whole.obstacles[0])
    >>> digest.sha256 == stamp_of(whole).sha256
    True
    """

    def __init__(self, scene: Scene) -> None:
        import hashlib

        self._scene, self._hash = scene, hashlib.sha256(b"cfree scene 1\n")
        for shape in scene.robot:
            self._hash.update(_text(_shape("robot", shape)))

    def add(self, obstacle: AnyShape) -> None:
        self._hash.update(_text(_shape("obstacle", obstacle)))

    @property
    def sha256(self) -> str:
        """Digest of all that was added."""
        found, scene = self._hash.copy(), self._scene
        if scene.workspace is not None:
            found.update(_text(_shape("workspace", scene.workspace)))
        if scene.bounds is not None:
            found.update(_text([f"bounds {' '.join(map(str, scene.bounds))}"]))
        return found.hexdigest()


def _text(lines: Iterable[str]) -> bytes:
    return "".join(f"{line}\n" for line in lines).encode("ascii")


def _shape(word: str, shape: AnyShape) -> Iterator[str]:
    yield word
    if isinstance(shape, Curved):
        for k, pieces in enumerate(shape.curves):
            yield f"{'hole' if k else 'outer'} {' '.join(map(_piece, pieces))}"
        if shape.grown:
            yield f"grown {shape.grown}"
        return
    for k, ring in enumerate(shape.exact_rings):
        numbers = map(str, chain.from_iterable(ring))
        yield f"{'hole' if k else 'outer'} {' '.join(numbers)}"


def _piece(piece: Piece) -> str:
    """Write a line by its end; an ellipse by center, radii, right angles and half-angle tangent of the rest."""
    match piece:
        case Line(_, end):
            numbers: list[object] = ["line", *end]
        case Cubic((_, *points)):
            numbers = ["cubic", *chain.from_iterable(points)]
        case _:
            numbers = ["arc", *piece.center, *piece.u, *piece.v, piece.quarters, piece.rest]
    return " ".join(map(str, numbers))
