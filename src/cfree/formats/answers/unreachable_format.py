"""The JSON of `Unreachable`, version 1, as pydantic models; `docs/answer-format.md` describes it.

Import this module inside functions.
"""

from __future__ import annotations

import base64
import binascii
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, model_validator

from cfree.formats.answers.path_format import AnswerModel, Length
from cfree.formats.scenes.json_types import Point, Strict
from cfree.formats.scenes.scene_format import VehicleValue
from cfree.formats.scenes.scene_values import Fault
from cfree.planning.unreachable import BoxGrid, Unreachable
from cfree.vehicles.vehicle import Car

MOST = 2**20  # columns, rows or slices


def _decoded(value: object) -> object:
    try:
        return base64.b64decode(value, validate=True) if isinstance(value, str) else value
    except (binascii.Error, ValueError):
        raise Fault("expected bytes in base64, got {got}") from None


Count = Annotated[int, Field(strict=True, ge=1, le=MOST)]
Bytes = Annotated[bytes, BeforeValidator(_decoded)]


class GridModel(Strict):
    """A grid of boxes."""

    corner: Point
    side: Length
    step: Length
    columns: Count
    rows: Count
    slices: Count

    @property
    def made(self) -> BoxGrid:
        return BoxGrid(self.corner, self.side, self.step, self.columns, self.rows, self.slices)


class UnreachableModel(AnswerModel):
    """Boxes that hold all that a car without reverse gear reaches from one end."""

    answer: Literal["unreachable"]
    vehicle: VehicleValue
    at: Literal["start", "goal"]
    pieces: Annotated[list[Annotated[list[Point], Field(min_length=3)]], Field(min_length=1)]
    grid: GridModel
    boxes: Bytes

    @model_validator(mode="after")
    def _fits(self) -> UnreachableModel:
        if not isinstance(self.vehicle, Car) or self.vehicle.gears != "forward":
            raise Fault('"vehicle" is no car with "gears": "forward"; correct it')
        return self

    @property
    def of(self) -> Literal["paths"]:
        return "paths"

    @property
    def result(self) -> Unreachable:
        start, goal = self.ends
        assert isinstance(self.vehicle, Car)
        return Unreachable(
            start,
            goal,
            self.vehicle,
            self.at,
            tuple(map(tuple, self.pieces)),
            self.grid.made,
            self.boxes,
            scene=self._of_polygons,
            **self.context,
        )
