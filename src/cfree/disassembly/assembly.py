"""Parts at their places, and the scene of one of them among the others."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from fractions import Fraction
from typing import Any

from cfree.analysis.leaving import outside
from cfree.arguments import checked
from cfree.curves.similar import moved_shape
from cfree.exact.pose import Pose
from cfree.nesting.layout import require_range, shape_box, union
from cfree.scene.scene import AnyShape, Scene, shapes_in
from cfree.words import counted, listed


@checked
@dataclass(frozen=True, init=False, repr=False)
class Assembly:
    """Parts at their places, some of which do not move.

    Parameters
    ----------
    parts : dict of str to shape or sequence of shapes
        Each part by its name, in world coordinates: polygons and round shapes as in a `Scene`. Parts may touch, and
        must not overlap.
    fixed : sequence of str
        Names of parts that are not taken out, such as a frame.
    units : str, optional
        Unit of length.

    Attributes
    ----------
    names : tuple of str
    shapes : tuple of tuples of shapes
    fixed : tuple of str

    Raises
    ------
    ValueError
        If there is no part, or a fixed one is none of them, or a coordinate is larger than 1e150.

    Examples
    --------
    >>> frame = [(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)]
    >>> Assembly({"frame": frame, "peg": [(1, 1), (3, 1), (3, 2), (1, 2)]}, fixed=["frame"])
    Assembly(2 parts: frame (fixed), peg)
    """

    names: tuple[str, ...]
    shapes: tuple[tuple[AnyShape, ...], ...]
    fixed: tuple[str, ...]
    units: str

    def __init__(self, parts: Mapping[str, Any], fixed: Sequence[str] = (), units: str = "") -> None:
        if not parts:
            raise ValueError("parts: there are none; give at least one")
        object.__setattr__(self, "names", tuple(parts))
        object.__setattr__(self, "shapes", tuple(tuple(shapes_in(shape, name)) for name, shape in parts.items()))
        for name, shapes in zip(self.names, self.shapes, strict=True):
            require_range(shapes, f"part {name}")
        object.__setattr__(self, "fixed", tuple(self.names[self.index(name, "fixed")] for name in fixed))
        object.__setattr__(self, "units", units)

    def __repr__(self) -> str:
        names = [f"{name} (fixed)" if name in self.fixed else name for name in self.names]
        return f"Assembly({counted(len(names), 'part')}: {listed(names, ', ')})"

    @property
    def movable(self) -> tuple[str, ...]:
        """The parts that are not fixed."""
        return tuple(name for name in self.names if name not in self.fixed)

    @checked
    def index(self, name: str, what: str = "part") -> int:
        """Return the number of a part.

        Raises
        ------
        ValueError
            If no part has this name.
        """
        if name in self.names:
            return self.names.index(name)
        similar = get_close_matches(name, self.names, 1)
        remedy = f"did you mean {similar[0]!r}?" if similar else f"the parts are {listed(list(self.names), ', ')}"
        raise ValueError(f"{what}: {name!r} is the name of no part; {remedy}")

    @checked
    def scene(self, name: str, gone: Iterable[str] = ()) -> Scene:
        """Return the scene of one part among the others, from its place to one beyond all of them.

        Parameters
        ----------
        name : str
            The part that moves: the robot of the scene. Its reference point is about the middle of its box, so that
            paths are as short far from the origin as near it.
        gone : iterable of str
            Parts that are already taken out.

        Examples
        --------
        >>> lid = [(100, 3), (104, 3), (104, 4), (100, 4)]
        >>> Assembly({"lid": lid, "box": [(100, 0), (104, 0), (104, 3), (100, 3)]}).scene("lid").start.x
        Fraction(102, 1)
        """
        shapes_of_part, away = self.shapes[self.index(name)], set(gone)
        start = middle_of(shapes_of_part)
        part = [moved_shape(shape, Pose(-start.x, -start.y)) for shape in shapes_of_part]
        others = [
            (other, shape)
            for other, shapes in zip(self.names, self.shapes, strict=True)
            if other != name and other not in away
            for shape in shapes
        ]
        shapes = [shape for _, shape in others]
        names = [other for other, _ in others]
        alone = Scene(part, shapes, obstacle_names=names, units=self.units)
        goal = outside(alone, start)
        return Scene(part, shapes, obstacle_names=names, start=start, goal=goal, units=self.units, name=name)


def middle_of(shapes: Sequence[AnyShape]) -> Pose:
    """Return a pose in the middle of shapes, within a tenth of their size, in few binary digits.

    Examples
    --------
    >>> from cfree.polygons.polygon import Polygon
    >>> middle_of([Polygon([("1/3", 0), (8, 0), (8, 2)])]).x
    Fraction(17, 4)
    """
    x0, y0, x1, y1 = union(map(shape_box, shapes))
    unit = Fraction(2) ** (math.floor(math.log2(max(x1 - x0, y1 - y0))) - 4)
    return Pose(*(round((low + high) / 2 / unit) * unit for low, high in ((x0, x1), (y0, y1))))
