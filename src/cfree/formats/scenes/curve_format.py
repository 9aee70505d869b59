"""Round shapes in JSON scenes, as pydantic models; `docs/scene-format.md` describes them.

Import this module inside functions.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from pydantic import Discriminator, Field, PrivateAttr, Tag, model_validator

from cfree.curves.curved import Curved
from cfree.curves.rings import Arc, Bezier, Circle, Ellipse, Spline
from cfree.errors import CfreeError
from cfree.exact.number import ExactPoint
from cfree.formats.scenes.json_types import Angle, Coordinate, Point, Strict
from cfree.formats.scenes.scene_values import Fault

RINGS, ITEMS = ("circle", "ellipse", "path"), ("arc", "bezier", "spline")
ROUND_KEYS = {*RINGS, "grown"}
TAGS = ("<round>", "<polygon>", "<point>", "<segment>", "<points>", "<ring>", "<bare>")


def _made(make: Callable[..., Any], *values: Any, **named: Any) -> Any:
    try:
        return make(*values, **named)
    except (CfreeError, ValueError) as error:
        raise Fault(str(error)) from None


def _one_of(model: Strict, names: tuple[str, ...]) -> Any:
    """Return the one member of a model that is present."""
    present = [name for name in names if getattr(model, name) is not None]
    if len(present) != 1:
        listed = ", ".join(f'"{name}"' for name in names)
        raise Fault(f"expected one of {listed}, got {{got}}")
    return getattr(model, present[0])


class CircleModel(Strict):
    """A whole circle."""

    center: Point
    radius: Coordinate

    @property
    def made(self) -> Circle:
        return Circle(self.center, self.radius)


class EllipseModel(Strict):
    """A whole ellipse; the angle turns its first radius from the x-axis."""

    center: Point
    radii: list[Coordinate]
    angle: Angle = 0

    @property
    def made(self) -> Ellipse:
        return Ellipse(self.center, self.radii, self.angle)


class ArcModel(Strict):
    """An arc from the point before it to a point: through another point, or about a center."""

    to: Point
    through: Point | None = None
    center: Point | None = None
    clockwise: bool = False
    conjugate: Point | None = None

    @property
    def made(self) -> Arc:
        return Arc(self.to, self.through, self.center, self.clockwise, self.conjugate)


class SegmentModel(Strict):
    """A segment after a point: an arc; a Bézier curve or a clamped uniform cubic B-spline, by control points."""

    arc: ArcModel | None = None
    bezier: list[Point] | None = None
    spline: list[Point] | None = None
    _made: Arc | Bezier | Spline = PrivateAttr()

    @model_validator(mode="after")
    def _is_one(self) -> SegmentModel:
        _one_of(self, ITEMS)
        if self.arc:
            self._made = _made(lambda: self.arc and self.arc.made)
        else:
            self._made = _made(Bezier, self.bezier) if self.bezier is not None else _made(Spline, self.spline)
        return self


def _kind_of_item(data: Any) -> str:
    return "<segment>" if isinstance(data, dict) else "<point>"


def _kind_of_ring(data: Any) -> str:
    return "<ring>" if isinstance(data, dict) else "<points>"


if TYPE_CHECKING:
    Item: TypeAlias = ExactPoint | SegmentModel
else:
    Item = Annotated[
        Annotated[Point, Tag("<point>")] | Annotated[SegmentModel, Tag("<segment>")], Discriminator(_kind_of_item)
    ]


def _ring_of(items: list[Item]) -> list[Any]:
    return [item._made if isinstance(item, SegmentModel) else item for item in items]


class RingModel(Strict):
    """A ring of any kind."""

    circle: CircleModel | None = None
    ellipse: EllipseModel | None = None
    path: list[Item] | None = None
    _ring: Any = PrivateAttr()

    @model_validator(mode="after")
    def _is_ring(self) -> RingModel:
        member = _one_of(self, RINGS)
        self._ring = _ring_of(member) if isinstance(member, list) else _made(lambda: member.made)
        return self


if TYPE_CHECKING:
    Hole: TypeAlias = list[Item] | RingModel
else:
    Hole = Annotated[
        Annotated[list[Item], Tag("<points>")] | Annotated[RingModel, Tag("<ring>")], Discriminator(_kind_of_ring)
    ]


class CurvedModel(Strict):
    """A round shape: a circle, an ellipse, or a path of points, arcs and splines; or one grown by a disc."""

    circle: CircleModel | None = None
    ellipse: EllipseModel | None = None
    path: list[Item] | None = None
    outer: list[Point] | None = None
    holes: list[Hole] = Field([])
    grown: Coordinate | None = None
    _shape: Curved = PrivateAttr()

    @model_validator(mode="after")
    def _is_shape(self) -> CurvedModel:
        member = _one_of(self, (*RINGS, "outer"))
        ring = _made(lambda: member.made) if not isinstance(member, list) else _ring_of(member)
        holes = [hole._ring if isinstance(hole, RingModel) else _ring_of(hole) for hole in self.holes]
        self._shape = _made(Curved, ring, holes, grown=self.grown or 0)
        return self

    @property
    def polygon(self) -> Curved:
        return self._shape


def curved_of(data: Any) -> Curved:
    """Return a round shape from its plain value; raise ValueError if it is none."""
    return CurvedModel.model_validate(data).polygon


_MODELS: dict[str, type[Strict]] = {
    "circle": CircleModel, "ellipse": EllipseModel, "arc": ArcModel, "path": SegmentModel, "holes": RingModel
}  # fmt: skip


def keys_of(name: str) -> list[str] | None:
    """Return the keys of an object in a round shape, by the last name in its place."""
    return list(_MODELS[name].model_fields) if name in _MODELS else None
