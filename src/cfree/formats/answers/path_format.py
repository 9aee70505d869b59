"""The JSON path, version 1, as pydantic models; `docs/answer-format.md` describes it.

The `exact` numbers count where they are present; `answer_rules.py` checks the decimals beside them. Import this module
inside functions.
"""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, BeforeValidator, Field, PlainValidator, PrivateAttr, model_validator

from cfree.collision.motion import Motion, Rotation, Translation, rotations
from cfree.collision.slide import Slide, Touch
from cfree.errors import CfreeError, InvalidPoseError
from cfree.exact.pose import Pose
from cfree.formats.answers.contact_format import ContactModel
from cfree.formats.scenes.json_types import Coordinate, Point, Strict
from cfree.formats.scenes.reading_format import NoteModel
from cfree.formats.scenes.scene_format import Bounds, Configuration, Goal, PolygonModel, Text, VehicleValue, Version
from cfree.formats.scenes.scene_values import Fault, list_of
from cfree.paths.path import Path
from cfree.scene.digest import Stamp, Whole
from cfree.scene.goals import Moved
from cfree.scene.scene import Scene


def _turning(value: Any) -> Any:
    """Return an angle that `rotations` accepts."""
    try:
        rotations((0, 0), value)
        return value
    except (ValueError, OverflowError):
        raise Fault('expected radians or "90deg", got {got}') from None


def _half_tangent(value: Any) -> Any:
    try:
        Rotation((0, 0), {"tau": value})
        return value
    except InvalidPoseError:
        raise Fault('expected the tangent of half the angle, "p/q", "inf" or "-inf", got {got}') from None


def _digest(value: str) -> str:
    if re.fullmatch("[0-9a-f]{64}", value):
        return value
    raise Fault("expected 64 digits 0-9 and a-f, got {got}")


Arrival = Annotated[
    tuple[Coordinate, Coordinate, Coordinate], BeforeValidator(list_of(3, "[x, y, theta] in three numbers"))
]


def _length(value: Fraction) -> Fraction:
    if value > 0:
        return value
    raise Fault("expected a length above 0, got {got}")


Length = Annotated[Coordinate, AfterValidator(_length)]


class ExactTranslation(Strict):
    """The exact vector."""

    vector: Point


class TranslationModel(Strict):
    """A straight motion."""

    type: Literal["translation"]
    vector: Point
    to: Arrival | None = None
    exact: ExactTranslation | None = None

    @property
    def motions(self) -> tuple[Motion, ...]:
        return (Translation((self.exact or self).vector),)


class ExactRotation(Strict):
    """The exact pole and half-angle tangent."""

    pole: Point
    tau: Annotated[Any, PlainValidator(_half_tangent)]


class RotationModel(Strict):
    """A rotation about a pole."""

    type: Literal["rotation"]
    pole: Point
    angle: Annotated[Any, PlainValidator(_turning)]
    to: Arrival | None = None
    exact: ExactRotation | None = None

    @property
    def motions(self) -> tuple[Motion, ...]:
        if self.exact:
            return (Rotation(self.exact.pole, {"tau": self.exact.tau}),)
        return rotations(self.pole, self.angle)


class ExactSlide(Strict):
    """Coefficients of the curve, and the half-angle tangent."""

    x: list[Coordinate]
    y: list[Coordinate]
    d: list[Coordinate]
    tau: Coordinate


class SlideModel(Strict):
    """A turn along two contacts."""

    type: Literal["slide"]
    contacts: Annotated[list[ContactModel], Field(min_length=2, max_length=2)]
    vector: Point
    angle: Annotated[Any, PlainValidator(_turning)]
    to: Arrival | None = None
    exact: ExactSlide
    _slide: Slide = PrivateAttr()

    @model_validator(mode="after")
    def _is_one(self) -> SlideModel:
        first, last = (Touch(contact.kind, contact.robot, contact.obstacle) for contact in self.contacts)
        try:
            self._slide = Slide((first, last), self.exact.x, self.exact.y, self.exact.d, self.exact.tau)
        except InvalidPoseError as error:
            raise Fault(str(error)) from None
        return self

    @property
    def motions(self) -> tuple[Motion, ...]:
        return (self._slide,)


class ExactEnds(Strict):
    """The exact start and goal."""

    start: Configuration
    goal: Configuration


class MovedModel(Strict):
    """The requested start and goal, if they were moved."""

    start: Configuration | None = None
    goal: Goal | None = None

    @model_validator(mode="after")
    def _is_one(self) -> Self:
        if self.start is None and self.goal is None:
            raise Fault("expected a start, a goal, or both, got {got}")
        return self

    @property
    def made(self) -> Moved:
        ends: Any = self
        return Moved(ends.start, ends.goal)


class StampModel(Strict):
    """The stamp of the scene of an answer."""

    sha256: Annotated[str, AfterValidator(_digest)]
    robot: Bounds
    reading: list[NoteModel] = Field([])

    @property
    def made(self) -> Stamp:
        return Stamp(self.sha256, self.robot, tuple(note.made for note in self.reading))


class WholeModel(Strict):
    """The scene of which the scene of an answer has some obstacles."""

    sha256: Annotated[str, AfterValidator(_digest)]
    obstacles: list[Annotated[int, Field(strict=True, ge=0, lt=2**31)]]

    @model_validator(mode="after")
    def _is_in_order(self) -> Self:
        if any(a >= b for a, b in pairwise(self.obstacles)):
            raise Fault('"obstacles" are not in increasing order; correct them')
        return self

    @property
    def made(self) -> Whole:
        return Whole(self.sha256, tuple(self.obstacles))


class PolygonsModel(Strict):
    """The scene of polygons that replaces one with round shapes."""

    robot: Annotated[list[PolygonModel], Field(min_length=1)]
    obstacles: Annotated[list[PolygonModel], Field(default_factory=list)]
    workspace: PolygonModel | None = None
    bounds: Bounds | None = None

    @property
    def made(self) -> Scene:
        robot, obstacles = ([part.polygon for part in parts] for parts in (self.robot, self.obstacles))
        return Scene(robot, obstacles, workspace=self.workspace and self.workspace.polygon, bounds=self.bounds)


class AnswerModel(Strict):
    """The members of every answer: its query."""

    version: Version = 1
    units: Text = ""
    frame: Text = "world"
    answer: str
    scene: StampModel | None = None
    whole: WholeModel | None = None
    polygons: PolygonsModel | None = None
    _of_polygons: Scene | None = PrivateAttr(None)
    start: Configuration
    goal: Configuration
    exact: ExactEnds | None = None
    moved: MovedModel | None = None

    @model_validator(mode="after")
    def _has_a_scene(self) -> Self:
        if self.exact and not self.scene:
            raise Fault('key "scene" is missing, and needed beside "exact"; add it')
        if self.polygons:
            try:
                self._of_polygons = self.polygons.made
            except CfreeError as error:
                raise Fault(f'"polygons": {error}') from None
        return self

    @property
    def ends(self) -> tuple[Pose, Pose]:
        """Start and goal; exact, if the file has exact ones."""
        ends: Any = self.exact or self
        return ends.start, ends.goal

    @property
    def part_of(self) -> Whole | None:
        return None if self.whole is None else self.whole.made

    @property
    def stamp(self) -> Stamp | None:
        return None if self.scene is None else self.scene.made

    @property
    def context(self) -> dict[str, Any]:
        """Arguments that every kind of answer takes."""
        moved = self.moved.made if self.moved else None
        return {"units": self.units, "frame": self.frame, "stamp": self.stamp, "moved": moved, "whole": self.part_of}


class PathModel(AnswerModel):
    """A path: a start, motions, and the goal they lead to."""

    answer: Literal["path"]
    decimals: Literal["free", "approximate"] | None = None
    vehicle: VehicleValue | None = None
    clearance: Length | None = None
    disc: Annotated[list[Point], Field(default_factory=list)]
    motions: list[Annotated[TranslationModel | RotationModel | SlideModel, Field(discriminator="type")]]

    @model_validator(mode="after")
    def _has_a_disc(self) -> Self:
        if self.disc and not (self.clearance and len(self.disc) > 2):
            raise Fault('"disc" is a polygon around a disc of the radius "clearance"; give both, or leave out the disc')
        return self

    @cached_property
    def driven(self) -> Path:
        """The path of the motions from the start."""
        motions = (m for model in self.motions for m in model.motions)
        room: Any = {"clearance": self.clearance or Fraction(0), "disc": tuple(self.disc)}
        return Path(self.ends[0], motions, scene=self._of_polygons, vehicle=self.vehicle, **room, **self.context)
