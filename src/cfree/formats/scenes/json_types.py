"""Numbers, points and angles in JSON as pydantic types. Import this module inside functions."""

from __future__ import annotations

from fractions import Fraction
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, PlainValidator, WithJsonSchema

from cfree.formats.scenes.scene_values import angle, coordinate, list_of

NUMBER_SCHEMA = {"type": ["number", "string"], "examples": [0.1, "1/3"]}
ANGLE_SCHEMA = {
    "anyOf": [
        {"type": "number", "title": "radians"},
        {"type": "string", "examples": ["90deg"]},
        {
            "type": "object",
            "properties": {"tau": NUMBER_SCHEMA},
            "required": ["tau"],
            "additionalProperties": False,
        },
    ]
}
Coordinate = Annotated[Fraction, PlainValidator(coordinate), WithJsonSchema(NUMBER_SCHEMA)]
Point = Annotated[tuple[Coordinate, Coordinate], BeforeValidator(list_of(2, "a point [x, y]"))]
Angle = Annotated[Any, PlainValidator(angle), WithJsonSchema(ANGLE_SCHEMA)]


class Strict(BaseModel):
    """A model whose unknown keys are faults."""

    model_config = ConfigDict(extra="forbid")
