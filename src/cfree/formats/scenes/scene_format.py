"""The JSON scene, version 1, as pydantic models; `docs/scene-format.md` describes it.

Numbers become exact fractions, rings become `Polygon`s and configurations become `Pose`s while a file is validated, so
that one pass finds all faults. Pydantic takes a while to import: import this module inside functions.
"""

from __future__ import annotations

from collections.abc import Callable
from difflib import get_close_matches
from typing import TYPE_CHECKING, Annotated, Any, Self, TypeAlias

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    Discriminator,
    Field,
    ModelWrapValidatorHandler,
    PlainValidator,
    PrivateAttr,
    Tag,
    TypeAdapter,
    ValidationError,
    ValidatorFunctionWrapHandler,
    WithJsonSchema,
    WrapValidator,
    model_validator,
)
from pydantic_core import ErrorDetails

from cfree.curves.curved import Curved
from cfree.errors import InvalidPolygonError
from cfree.formats.scenes.curve_format import ROUND_KEYS, TAGS, CurvedModel, keys_of
from cfree.formats.scenes.json_types import ANGLE_SCHEMA, NUMBER_SCHEMA, Angle, Coordinate, Point, Strict
from cfree.formats.scenes.reading_format import ItemModel, NoteModel, notes_of_lists
from cfree.formats.scenes.scene_values import (
    MAX_NAME,
    MAX_TEXT,
    READERS,
    VERSION,
    Fault,
    is_ring,
    known_version,
    list_of,
    not_empty,
    place,
    plain,
    plain_polygon,
    pose,
    vehicle,
)
from cfree.formats.text.findings import Findings
from cfree.formats.text.json_positions import Path, shortened
from cfree.polygons.polygon import Polygon
from cfree.scene.coordinate_range import range_fault
from cfree.scene.reading import Note
from cfree.scene.scene import Scene, explained


def _robot_parts(value: object) -> list[object]:
    if isinstance(value, dict) or is_ring(value):
        return [value]
    if isinstance(value, list) and value:
        return value
    raise Fault(f"expected {_POLYGON} or a list of them, at least one, got {{got}}")


def _one_or_more(value: object) -> object:
    return [value] if is_ring(value) else value


def _or_one(schema: dict[str, Any]) -> None:
    parts = {"type": schema.pop("type"), "items": schema.pop("items"), "minItems": 1}
    schema["anyOf"] = [parts["items"], parts]


def _or_a_ring(schema: dict[str, Any]) -> None:
    shapes = {"type": schema.pop("type"), "items": schema.pop("items")}
    schema["anyOf"] = [_RING_SCHEMA, shapes]


ROUND, STRAIGHT, BARE = "<round>", "<polygon>", "<bare>"
_POLYGON = 'a polygon {"outer": [[x, y], ...], "holes": []} or its ring [[x, y], ...]'
_RING_SCHEMA = TypeAdapter(list[Point]).json_schema()
_EXPECTED = {
    "list_type": "a list",
    "dict_type": "an object {...}",
    "model_type": _POLYGON,
    "string_type": "text in quotes",
    "string_unicode": "text without halves of surrogate pairs",
}
Bounds = Annotated[
    tuple[Coordinate, Coordinate, Coordinate, Coordinate],
    BeforeValidator(list_of(4, "[xmin, ymin, xmax, ymax]")),
    AfterValidator(not_empty),
]
Configuration = Annotated[
    tuple[Coordinate, Coordinate, Angle],
    BeforeValidator(list_of(3, "[x, y, theta]")),
    AfterValidator(pose),
]
Place = Annotated[tuple[Coordinate, Coordinate], AfterValidator(place)]
_A_PLACE = TypeAdapter(Place)


def _place_or(value: Any, handler: ValidatorFunctionWrapHandler) -> Any:
    """Validate a configuration or a place."""
    if isinstance(value, list) and len(value) == 2:
        return _A_PLACE.validate_python(value)
    if isinstance(value, list) and len(value) == 3:
        return handler(value)
    raise Fault("expected [x, y, theta], or [x, y] for any theta, got {got}")


_GOAL_SCHEMA = {"anyOf": [TypeAdapter(Configuration).json_schema(), _A_PLACE.json_schema()]}
Goal = Annotated[Configuration, WrapValidator(_place_or), WithJsonSchema(_GOAL_SCHEMA)]
_TWO_NUMBERS = {"type": "array", "items": NUMBER_SCHEMA, "minItems": 2, "maxItems": 2}
_VEHICLE_SCHEMA: dict[str, Any] = {
    "type": "object",
    "properties": {
        "type": {"enum": ["car", "differential"]},
        "turning_radius": {
            "anyOf": [NUMBER_SCHEMA, {"type": "array", "items": NUMBER_SCHEMA, "minItems": 2, "maxItems": 2}]
        },
        "axle": {"type": "array", "items": NUMBER_SCHEMA, "minItems": 2, "maxItems": 2},
        "heading": ANGLE_SCHEMA,
        "gears": {"enum": ["both", "forward"]},
        "wheelbase": NUMBER_SCHEMA,
    },
    "required": ["type"],
    "additionalProperties": False,
}
VehicleValue = Annotated[Any, PlainValidator(vehicle), WithJsonSchema(_VEHICLE_SCHEMA)]
Version = Annotated[int, PlainValidator(known_version), WithJsonSchema({"const": VERSION})]
Text = Annotated[str, Field(max_length=MAX_TEXT)]
Name = Annotated[str, Field(max_length=MAX_NAME)]
Plain = Annotated[dict[str, Any], AfterValidator(plain)]


class PolygonModel(Strict):
    """A polygon: an outer ring and the holes in it, in any orientation, closing point optional."""

    outer: list[Point]
    holes: list[list[Point]] = Field([])
    _polygon: Polygon = PrivateAttr()

    @model_validator(mode="wrap")
    @classmethod
    def _build(cls, data: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        if polygon := plain_polygon(data, cls.model_fields.keys()):
            model = cls.model_construct(name=data.get("name"))
        else:
            model = handler(data)
            try:
                polygon = Polygon(model.outer, model.holes)
            except InvalidPolygonError as error:
                ring = error.ring
                within: Path = () if ring is None else ("outer",) if ring == 0 else ("holes", ring - 1)
                raise Fault(explained(error), within) from None
        model._polygon = polygon
        return model

    @property
    def polygon(self) -> Polygon:
        return self._polygon


class ObstacleModel(PolygonModel):
    """An obstacle: a polygon, and a name for messages and pictures."""

    name: Name | None = None


def _kind(data: Any) -> str:
    """Return the kind of a shape: a bare ring, a round shape by its keys, or a polygon."""
    if isinstance(data, list):
        return BARE
    return ROUND if isinstance(data, dict) and data.keys() & ROUND_KEYS else STRAIGHT


def _either(polygon: type[PolygonModel], curved: type[CurvedModel]) -> Any:
    """Return the type of a polygon, of its ring alone, or of a round shape."""

    def of_ring(points: list[Any]) -> PolygonModel:
        model = polygon.model_construct()
        try:
            model._polygon = Polygon(points)
        except InvalidPolygonError as error:
            raise Fault(explained(error)) from None
        return model

    bare = Annotated[list[Point], AfterValidator(of_ring), Tag(BARE)]
    union: Any = Annotated[polygon, Tag(STRAIGHT)] | Annotated[curved, Tag(ROUND)] | bare
    return Annotated[union, Discriminator(_kind)]


class RoundObstacleModel(CurvedModel):
    """An obstacle: a round shape, and a name for messages and pictures."""

    name: Name | None = None


if TYPE_CHECKING:
    Shape: TypeAlias = PolygonModel | CurvedModel
    Obstacle: TypeAlias = ObstacleModel | RoundObstacleModel
else:
    Shape, Obstacle = _either(PolygonModel, CurvedModel), _either(ObstacleModel, RoundObstacleModel)


class SceneModel(Strict):
    """A scene: a robot, its obstacles, its workspace and bounds."""

    version: Version = VERSION
    name: Text = ""
    note: Text = ""
    units: Text = ""
    source: Annotated[dict[str, Text], AfterValidator(plain)] = Field({})
    robot: Annotated[list[Shape], BeforeValidator(_robot_parts), Field(json_schema_extra=_or_one)]
    obstacles: Annotated[list[Obstacle], BeforeValidator(_one_or_more)] = Field([], json_schema_extra=_or_a_ring)
    workspace: Shape | None = None
    bounds: Bounds | None = None
    start: Configuration | None = None
    goal: Goal | None = None
    goals: list[Goal] = Field([])
    vehicle: VehicleValue | None = None
    check: Plain = Field({})
    reading: list[NoteModel] = Field([])
    changed: list[Text] = Field([])
    dropped: list[Text] = Field([])

    @property
    def record(self) -> tuple[Note, ...]:
        """The record of reading, with the lists of older files."""
        return *(note.made for note in self.reading), *notes_of_lists(self.changed, self.dropped)


def scene_from_models(findings: Findings, data: object) -> Scene:
    """Read the scene of a decoded JSON value; raise all its problems through `findings`."""
    single = {key for key in ("robot", "obstacles") if isinstance(data, dict) and is_ring(data.get(key))}
    single |= {"robot"} if isinstance(data, dict) and isinstance(data.get("robot"), dict) else set()
    try:
        model = SceneModel.model_validate(data)
    except ValidationError as error:
        for item in error.errors(include_url=False, include_input=False):
            path = tuple(step for step in item["loc"] if step not in TAGS)
            if path[:1] and path[0] in single:
                path = (path[0], *path[2:])
            report(findings, path, item)
    else:
        if model.goal is not None and model.goals:
            findings.under(("goals",), 'there is also a "goal"; give one of them')
    findings.fail_if_any()
    robot, obstacles = ([part.polygon for part in parts] for parts in (model.robot, model.obstacles))
    workspace = model.workspace.polygon if model.workspace else None
    if isinstance(workspace, Curved) and workspace.grown:
        findings.under(("workspace",), "a grown shape is no workspace; give the ring of its lines and arcs")
        findings.fail_if_any()
    shapes = robot, obstacles, [workspace] if workspace else []
    if not any(isinstance(shape, Curved) for kind in shapes for shape in kind):
        out = range_fault(robot, obstacles, workspace, model.bounds)  # type: ignore[arg-type]
        if out:
            path, message = out
            findings.under(path[:1] if path[0] in single else path, message)
            findings.fail_if_any()
    return Scene(
        robot=robot,
        obstacles=obstacles,
        obstacle_names=[part.name for part in model.obstacles],
        workspace=workspace,
        reading=model.record,
        **{key: getattr(model, key) for key in READERS if key != "reading"},
    )


def _keys_at(path: Path) -> list[str]:
    keys = [step for step in path if isinstance(step, str)]
    if keys and (known := keys_of(keys[-1])):
        return known
    models: dict[tuple[str, ...], type[BaseModel]] = {
        (): SceneModel,
        ("obstacles",): ObstacleModel,
        ("reading",): NoteModel,
        ("reading", "items"): ItemModel,
    }
    return list(models.get(tuple(keys), PolygonModel).model_fields)


def report(findings: Findings, path: Path, item: ErrorDetails, keys_at: Callable[[Path], list[str]] = _keys_at) -> None:
    """Report a fault of the validator in our own words: place, value, remedy."""
    kind, context = item["type"], item.get("ctx", {})
    if kind == "missing":
        findings.under(path[:-1], f'key "{path[-1]}" is missing; add it')
    elif kind == "extra_forbidden":
        key, known = str(path[-1]), keys_at(path[:-1])
        guess = get_close_matches(key, known, 1)
        remedy = f'did you mean "{guess[0]}"?' if guess else f"the keys here are {', '.join(known)}"
        findings.under(path, f'unknown key "{shortened(key)}"; {remedy}', key=True)
    elif kind == "value_error":
        findings.under((*path, *getattr(context["error"], "within", ())), str(context["error"]))
    elif kind == "string_too_long":
        findings.under(path, f"{{got}} has more than {context['max_length']} characters; shorten it")
    else:
        expected = _EXPECTED.get(kind, item["msg"])
        if kind == "model_type" and not path:
            expected = 'a scene {"robot": ..., "obstacles": [...]}'
        findings.under(path, f"expected {expected}, got {{got}}")
