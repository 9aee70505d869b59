"""The JSON separation, version 1, as pydantic models; `docs/answer-format.md` describes it.

Import this module inside functions.
"""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from itertools import pairwise
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field, PlainValidator, model_validator

from cfree.forbidden.columns import CODED, COLUMNS, Trapezoids
from cfree.formats.answers.contact_format import PieceContactModel
from cfree.formats.answers.path_format import AnswerModel, Length
from cfree.formats.answers.separation_text import KINDS, QUADRANT
from cfree.formats.answers.stuck_format import StuckModel
from cfree.formats.answers.unreachable_format import UnreachableModel
from cfree.formats.scenes.json_types import Coordinate, Point, Strict
from cfree.formats.scenes.scene_format import Bounds, PolygonModel, Version
from cfree.formats.scenes.scene_values import Fault
from cfree.planning.goals import AllSeparated
from cfree.planning.separation import Auxiliary, Pieces, Separated
from cfree.polygons.polygon import Polygon
from cfree.scene.features import MOST_OBSTACLE_FEATURES, MOST_ROBOT_FEATURES
from cfree.scene.grown_cores import CoreArc, Cores, Rounded, is_arc


def _code(value: Any) -> int:
    """Return a packed pair of features."""
    if isinstance(value, list) and len(value) in (3, 4) and all(type(part) is int for part in value):
        kind, i, j, branch = [*value, 0][:4]
        if not (1 <= kind <= 5 and 0 <= branch <= 3):
            pass
        elif 0 <= i < MOST_ROBOT_FEATURES and 0 <= j < MOST_OBSTACLE_FEATURES:
            return int(kind << 61 | branch << 59 | i << 31 | j)
    raise Fault("expected [kind, robot feature, obstacle feature], kind from 1 to 5, and perhaps a branch, got {got}")


def _interval(value: Any) -> tuple[float, float]:
    if isinstance(value, list) and len(value) == 2 and all(type(c) is int or _is_finite(c) for c in value):
        lo, hi = (float(max(-3, min(c, 3))) for c in value)
        if -2 <= lo <= hi <= 2:
            return lo, hi
    raise Fault("expected an interval [lo, hi] with -2 <= lo <= hi <= 2, got {got}")


def _is_finite(value: Any) -> bool:
    return isinstance(value, Decimal) and value.is_finite()


def _whole(value: Any) -> Any:
    """Return an int unchanged, and None for anything else, such as 0.0 and true."""
    return value if type(value) is int else None


Code = Annotated[int, PlainValidator(_code)]


class AngleModel(Strict):
    """A critical angle: its names, and an interval of tau that isolates it."""

    names: Annotated[list[Code], Field(max_length=2)]
    tau: Annotated[tuple[float, float], PlainValidator(_interval)]
    place: Annotated[int, Field(strict=True, ge=0, le=4)] = 0


class PieceModel(Strict):
    """A trapezoid of a contact surface."""

    contact: PieceContactModel
    chart: Annotated[Literal[0, 1], BeforeValidator(_whole)]
    from_: Annotated[AngleModel, Field(alias="from")]
    to: AngleModel
    lower: Code
    upper: Code

    @property
    def row(self) -> list[Any]:
        """The values of all `COLUMNS` but the first, in their order."""
        row: list[Any] = [self.chart, self.lower, self.upper]
        for angle in (self.from_, self.to):
            first, second, *_ = *angle.names, 0, 0
            row += [first, second, *angle.tau, angle.place]
        return row


class AuxiliaryModel(Strict):
    """A point or a line that names refer to and the scene lacks."""

    of: Literal["robot", "obstacles"]
    kind: Literal["vertex", "edge"]
    number: Annotated[int, Field(strict=True, ge=0, lt=MOST_OBSTACLE_FEATURES)]
    points: list[Point]

    @model_validator(mode="after")
    def _fits(self) -> AuxiliaryModel:
        if not len(set(self.points)) == len(self.points) == {"vertex": 1, "edge": 2}[self.kind]:
            raise Fault("expected one point of a vertex, two of an edge, got {got}")
        return self

    @property
    def result(self) -> Auxiliary:
        return Auxiliary(self.of, self.kind, self.number, tuple(self.points))


class ArcModel(Strict):
    """An arc in place of a side of a core; a concave one has two points beyond it, the first a vertex of the core."""

    start: Point
    end: Point
    center: Point
    radius: Coordinate
    beyond: tuple[Point, Point] | None = None

    @model_validator(mode="after")
    def _fits(self) -> ArcModel:
        if not is_arc(self.result):
            way = 'clockwise, as it has "beyond"' if self.beyond else "counter-clockwise"
            raise Fault(f"expected an arc of a radius above 0, {way}, at most a quarter circle, got {{got}}")
        return self

    @property
    def result(self) -> CoreArc:
        return CoreArc(self.start, self.end, self.center, self.radius, self.beyond)


class RoundedModel(Strict):
    """A grown core: a polygon, some of whose sides may be arcs, or one or two points."""

    outer: list[Point] | None = None
    holes: Annotated[list[list[Point]], Field(default_factory=list)]
    points: Annotated[list[Point], Field(max_length=2)] | None = None
    radius: Coordinate
    arcs: Annotated[list[ArcModel], Field(default_factory=list)]

    @model_validator(mode="after")
    def _fits(self) -> RoundedModel:
        if (self.outer is None) == (not self.points):
            raise Fault('expected "outer" with or without "holes", or "points", one or two, got {got}')
        if self.radius < 0:
            raise Fault("expected a radius of 0 or more, got {got}")
        rings = [] if self.outer is None else [self.outer, *self.holes]
        sides = {side for ring in rings for side in zip(ring, [*ring[1:], *ring[:1]], strict=True)}
        places = [(arc.start, *(arc.beyond or ())[:1], arc.end) for arc in self.arcs]
        if not all(set(pairwise(points)) <= sides for points in places):
            raise Fault('expected arcs from each a vertex to the next one, past that of "beyond", got {got}')
        return self

    @property
    def result(self) -> Rounded:
        core = tuple(self.points) if self.points else Polygon(self.outer or [], self.holes)
        return Rounded(core, self.radius, tuple(arc.result for arc in self.arcs))


class CoresModel(Strict):
    """The grown cores of a proof among rounded shapes."""

    robot: Annotated[list[RoundedModel], Field(min_length=1)]
    obstacles: list[RoundedModel]
    frames: Annotated[int, Field(strict=True, ge=0)] = 0

    @model_validator(mode="after")
    def _fits(self) -> CoresModel:
        if self.frames > len(self.obstacles):
            raise Fault(f'expected "frames" up to {len(self.obstacles)}, the number of obstacles, got {{got}}')
        return self

    @property
    def result(self) -> Cores:
        robot, obstacles = (tuple(part.result for part in parts) for parts in (self.robot, self.obstacles))
        return Cores(robot, obstacles, self.frames)


class SeparationModel(AnswerModel):
    """A separation: two poses, and a closed surface that separates them."""

    answer: Literal["separated"]
    of: Literal["closed", "interior"]
    obstacles: list[Annotated[int, Field(strict=True, ge=-2, lt=2**31)]]
    smaller_robot: Annotated[list[PolygonModel], Field(default_factory=list)]
    larger_bounds: Bounds | None = None
    clearance: Length | None = None
    cores: Annotated[list[PolygonModel], Field(default_factory=list)]
    rounded: CoresModel | None = None
    auxiliary: Annotated[list[AuxiliaryModel], Field(default_factory=list)]
    surface: list[PieceModel]

    @model_validator(mode="after")
    def _fits(self) -> SeparationModel:
        if (self.of == "closed") != bool(self.smaller_robot or self.rounded) or (self.smaller_robot and self.rounded):
            raise Fault('either "smaller_robot" or "rounded" belongs to "of": "closed" only; correct one of them')
        if self.of == "interior" and (self.larger_bounds or self.clearance):
            raise Fault('"larger_bounds" and "clearance" belong to "of": "closed"; leave them out')
        if len(self.cores) != (len(self.smaller_robot) if self.clearance and not self.rounded else 0):
            raise Fault('"clearance" belongs to as many "cores" as "smaller_robot" has polygons; correct one of them')
        if sorted(set(self.obstacles)) != sorted({piece.contact.obstacle[0] for piece in self.surface}):
            raise Fault('"obstacles" are not those of the surface; correct one of them')
        if len({(item.of, item.kind, item.number) for item in self.auxiliary}) < len(self.auxiliary):
            raise Fault("one of the auxiliary features is there twice; keep one")
        return self

    @property
    def result(self) -> Separated:
        start, goal = self.ends
        return Separated(
            start=start,
            goal=goal,
            of=self.of,
            pieces=_pieces(self.surface, tuple(item.result for item in self.auxiliary)),
            robot=tuple(part.polygon for part in self.smaller_robot),
            bounds=self.larger_bounds,
            clearance=self.clearance or Fraction(0),
            cores=tuple(part.polygon for part in self.cores),
            rounded=None if self.rounded is None else self.rounded.result,
            scene=self._of_polygons,
            **self.context,
        )


ProofModel = Annotated[SeparationModel | StuckModel | UnreachableModel, Field(discriminator="answer")]


class AllSeparatedModel(Strict):
    """Separations of one start from all goals."""

    version: Version = 1
    answer: Literal["all separated"]
    of: Literal["closed", "interior", "pieces"]
    places: Annotated[list[Point], Field(default_factory=list)]
    proofs: Annotated[list[ProofModel], Field(min_length=1)]

    @model_validator(mode="after")
    def _fits(self) -> AllSeparatedModel:
        if any((p.ends[0], p.scene) != (self.proofs[0].ends[0], self.proofs[0].scene) for p in self.proofs):
            raise Fault("not all proofs have the same start and scene; correct them")
        if self.of == "closed" and any(proof.of != "closed" for proof in self.proofs):
            raise Fault('a proof is of "interior", but all of them of "closed"; correct one of them')
        if self.of == "pieces" and any(proof.of == "interior" for proof in self.proofs):
            raise Fault('a proof is of "interior", but all of them of "pieces"; correct one of them')
        if not set(self.places) <= {(proof.ends[1].x, proof.ends[1].y) for proof in self.proofs}:
            raise Fault("there is no proof for one of the places; add it")
        return self

    @property
    def result(self) -> AllSeparated:
        return AllSeparated(tuple(proof.result for proof in self.proofs), tuple(self.places), self.of)


def _pieces(models: list[PieceModel], auxiliary: tuple[Auxiliary, ...]) -> Pieces:
    of_kind = {name: kind for kind, name in KINDS.items()}
    kind = np.array([of_kind[m.contact.kind] | m.contact.quadrant << QUADRANT for m in models], np.uint8)
    robot, obstacle = (
        np.array([getattr(m.contact, name) for m in models], np.int32).reshape(-1, 2) for name in ("robot", "obstacle")
    )
    columns: dict[str, Any] = {"patch": np.arange(len(models), dtype=np.int32)}
    rows = zip(*(model.row for model in models), strict=True) if models else [[]] * (len(COLUMNS) - 1)
    for name, values in zip(COLUMNS[1:], rows, strict=True):
        dtype = np.uint64 if name in CODED else np.float64 if name.endswith(("lo", "hi")) else np.uint8
        columns[name] = np.array(values, dtype)
    return Pieces(kind, robot, obstacle, Trapezoids(**columns), auxiliary)
