"""Parts, sheets, and parts placed on sheets."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from copy import copy
from dataclasses import dataclass
from fractions import Fraction
from os import PathLike
from typing import Any

from cfree.arguments import checked
from cfree.curves.curved import Curved
from cfree.curves.similar import moved_shape
from cfree.exact.half_angle import Angle, read_angle
from cfree.exact.pose import Pose, PoseLike, to_pose
from cfree.lazy import registered
from cfree.polygons.polygon import Polygon
from cfree.polygons.repair import FARTHEST
from cfree.scene.scene import AnyShape, Scene, largest_of, shapes_in
from cfree.words import counted

ROUND_SHARE = 1000  # of a shape's size: error of the polygons that stand for round shapes


@dataclass(frozen=True, init=False, repr=False)
class Part:
    """A part to cut, once or several times.

    Parameters
    ----------
    shape : shape or sequence of shapes
        Polygons with or without holes, or round shapes, that move together.
    name : str
    quantity : int
    rotations : sequence of Angle, optional
        The orientations that are allowed; None if any is.

    Examples
    --------
    >>> Part([(0, 0), (2, 0), (0, 1)], "bracket", 3)
    <Part 'bracket', 3 times>
    """

    shapes: tuple[AnyShape, ...]
    name: str
    quantity: int
    rotations: tuple[Fraction | None, ...] | None

    @checked
    def __init__(self, shape: Any, name: str = "", quantity: int = 1, rotations: Sequence[Angle] | None = None) -> None:
        shapes = tuple(shapes_in(shape, "shape"))
        if not shapes:
            raise ValueError("shape: there is none; give a polygon or a round shape")
        if quantity < 1:
            raise ValueError(f"quantity: {quantity}; give at least 1")
        require_range(shapes, f"part {name}".strip())
        if rotations is not None and not len(rotations):
            raise ValueError("rotations: there is none; give at least one angle, or None for any")
        values = {"shapes": shapes, "name": name, "quantity": quantity}
        for key, value in values.items():
            object.__setattr__(self, key, value)
        taus = None if rotations is None else tuple(dict.fromkeys(read_angle(angle)[0] for angle in rotations))
        object.__setattr__(self, "rotations", taus)

    def __repr__(self) -> str:
        times = f", {self.quantity} times" if self.quantity > 1 else ""
        return f"<Part {self.name!r}{times}>"

    @property
    def area(self) -> float:
        """Area of one copy; of round shapes within a millionth."""
        return math.fsum(map(_area, self.shapes))

    @property
    def is_round(self) -> bool:
        """True if a shape is round."""
        return any(isinstance(shape, Curved) for shape in self.shapes)


@dataclass(frozen=True, init=False)
class Placed:
    """A part in its place.

    Parameters
    ----------
    part : Part
    pose : Pose or (x, y, theta)
        The part is turned about the origin of its own frame, then moved.
    sheet : int
        Index of the sheet.
    """

    part: Part
    pose: Pose
    sheet: int

    @checked
    def __init__(self, part: Part, pose: PoseLike, sheet: int = 0) -> None:
        values = {"part": part, "pose": to_pose(pose, "pose"), "sheet": sheet}
        for key, value in values.items():
            object.__setattr__(self, key, value)

    @property
    def shapes(self) -> tuple[AnyShape, ...]:
        """The part's shapes in their place, exactly."""
        return tuple(moved_shape(shape, self.pose) for shape in self.part.shapes)

    @checked
    def at(self, pose: PoseLike) -> Placed:
        """Return the same part in another place of its sheet."""
        return Placed(self.part, pose, self.sheet)


@dataclass(frozen=True, init=False, repr=False)
class Nesting:
    """Parts placed on sheets.

    Parameters
    ----------
    sheets : shape or sequence of shapes
        Stock, each a polygon or a round shape; holes are faults that no part may cover. There may be none.
    placed : sequence of Placed
    left : sequence of Part
        Parts that found no place.
    units, name : str

    Examples
    --------
    >>> square = Part([(0, 0), (2, 0), (2, 2), (0, 2)], "square", 2)
    >>> nesting = Nesting([[(0, 0), (4, 0), (4, 2), (0, 2)]], [Placed(square, (0, 0, 0)), Placed(square, (2, 0, 0))])
    >>> nesting, nesting.density
    (<Nesting of 2 parts on 1 sheet, 100.0 % used>, 1.0)
    """

    sheets: tuple[AnyShape, ...]
    placed: tuple[Placed, ...]
    left: tuple[Part, ...]
    units: str
    name: str

    @checked
    def __init__(
        self, sheets: Any, placed: Sequence[Placed], left: Sequence[Part] = (), units: str = "", name: str = ""
    ) -> None:
        shapes = tuple(shapes_in(sheets, "sheets"))
        wrong = next((k for k, one in enumerate(placed) if shapes and not 0 <= one.sheet < len(shapes)), None)
        if wrong is not None:
            raise ValueError(f"placed[{wrong}]: sheet {placed[wrong].sheet} of {len(shapes)}; count from 0")
        values = {"sheets": shapes, "placed": tuple(placed), "left": tuple(left), "units": units, "name": name}
        for key, value in values.items():
            object.__setattr__(self, key, value)

    def __repr__(self) -> str:
        sheets = f" on {counted(len(self.used), 'sheet')}, {100 * self.density:.1f} % used" if self.sheets else ""
        count = sum(part.quantity for part in self.left)
        return f"<Nesting of {counted(len(self.placed), 'part')}{sheets}{f', {count} left' if count else ''}>"

    @property
    def used(self) -> tuple[int, ...]:
        """Indices of the sheets with parts."""
        return tuple(sorted({one.sheet for one in self.placed}))

    @property
    def area(self) -> float:
        """Area of all placed parts."""
        return math.fsum(one.part.area for one in self.placed)

    @property
    def density(self) -> float:
        """Share of the used sheets that the parts cover; 0 without sheets."""
        stock = math.fsum(_area(self.sheets[k]) for k in self.used) if self.sheets else 0.0
        return self.area / stock if stock else 0.0

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Least x, least y, greatest x, greatest y of all placed parts; zeros if there is none."""
        boxes = [shape_box(shape) for one in self.placed for shape in one.shapes]
        if not boxes:
            return 0.0, 0.0, 0.0, 0.0
        x0, y0, x1, y1 = map(float, union(boxes))
        return x0, y0, x1, y1

    @checked
    def scene(self, moving: int) -> Scene:
        """Return the scene of one placed part among the others of its sheet, for all other functions of cfree.

        The robot is the part in its own frame; start is its place.
        """
        one = self.placed[moving]
        others = [k for k, other in enumerate(self.placed) if k != moving and other.sheet == one.sheet]
        shapes = [(label(self, k), shape) for k in others for shape in self.placed[k].shapes]
        return Scene(
            one.part.shapes,
            [shape for _, shape in shapes],
            obstacle_names=[name for name, _ in shapes],
            workspace=self.sheets[one.sheet] if self.sheets else None,
            start=one.pose,
            units=self.units,
            name=self.name,
        )

    def plot(self) -> Any:
        """Draw sheets and parts by matplotlib, one panel a sheet, overlapping parts red; return the figure."""
        return registered("nesting_picture")(self)

    @checked
    def save(self, path: str | PathLike[str]) -> None:
        """Write the layout as ``.svg``, ``.dxf``, ``.geojson`` or ``.json``; see `cfree.nesting.save_nesting`."""
        registered("save_nesting")(self, path)

    def _repr_svg_(self) -> str:
        text: str = registered("nesting_svg")(self)
        return text


def label(nesting: Nesting, k: int) -> str:
    """Return the name of a placed part in messages: its own and its number."""
    name = nesting.placed[k].part.name
    return f"{name} (part {k})" if name else f"part {k}"


def shape_box(shape: AnyShape) -> tuple[Fraction, Fraction, Fraction, Fraction]:
    """Return a box around a shape, exact for polygons."""
    if isinstance(shape, Curved):
        return shape.box
    xs, ys = zip(*shape.exact_vertices, strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def require_range(shapes: Iterable[AnyShape], name: str) -> None:
    """Raise a `ValueError` if a coordinate of shapes is beyond the range of scenes."""
    if any(abs(c) > FARTHEST for shape in shapes for c in shape_box(shape)):
        raise ValueError(f"{name}: a coordinate is larger than 1e150; scale it")


def union(boxes: Iterable[tuple[Any, Any, Any, Any]]) -> tuple[Any, Any, Any, Any]:
    """Return the box around some boxes."""
    x0, y0, x1, y1 = zip(*boxes, strict=True)
    return min(x0), min(y0), max(x1), max(y1)


def around(shapes: Sequence[AnyShape], share: float = ROUND_SHARE) -> list[Polygon]:
    """Return polygons around shapes; those that are polygons stay."""
    scene = Scene(shapes)
    return list(scene.outer(largest_of(scene) / share).robot) if scene.curved else list(scene.robot)


def within(shapes: Sequence[AnyShape], share: float = ROUND_SHARE) -> list[Polygon]:
    """Return polygons inside of shapes; those that are polygons stay."""
    scene = Scene(shapes)
    return list(scene.inner(largest_of(scene) / share).robot) if scene.curved else list(scene.robot)


def with_quantity(part: Part, quantity: int) -> Part:
    """Return a part that is wanted so many times."""
    other = copy(part)
    object.__setattr__(other, "quantity", quantity)
    return other


def all_parts(nesting: Nesting) -> list[Part]:
    """Return all parts of a layout, placed or not, each with its number of copies."""
    counts = Counter(one.part for one in nesting.placed)
    result = {with_quantity(part, 1): (part, count) for part, count in counts.items()}
    for part in nesting.left:
        key = with_quantity(part, 1)
        known, count = result.get(key, (part, 0))
        result[key] = known, count + part.quantity
    return [with_quantity(part, count) for part, count in result.values()]


def _area(shape: AnyShape) -> float:
    if isinstance(shape, Polygon):
        return shape.area
    error = max(shape.size * 1e-6, shape.least_error)
    areas = [sum(polygon.area for polygon in polygons) for polygons in (shape.outer(error), shape.inner(error))]
    return sum(areas) / 2 if not shape.grown else _grown_area(shape)


def _grown_area(shape: Curved) -> float:
    """Area of a shape grown by a disc, up to the error of polygons; its convex pieces overlap."""
    import shapely

    error = max(shape.size * 1e-6, shape.least_error)
    return float(shapely.union_all([polygon.to_shapely() for polygon in shape.outer(error)]).area)
