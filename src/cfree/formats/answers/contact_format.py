"""A contact in an answer, as a pydantic model. Import this module inside functions."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, PlainValidator

from cfree.formats.scenes.json_types import Strict
from cfree.formats.scenes.scene_values import Fault


def _feature(value: Any) -> tuple[int, int]:
    if isinstance(value, list) and len(value) == 2 and all(type(part) is int for part in value):
        polygon, vertex = value
        if -2 <= polygon < 2**31 and 0 <= vertex < 2**31:
            return polygon, vertex
    raise Fault("expected [polygon, vertex], polygon -1 for the bounds and -2 for the workspace, got {got}")


class ContactModel(Strict):
    """The two features that touch."""

    kind: Literal["vertex-edge", "edge-vertex"]
    robot: Annotated[tuple[int, int], PlainValidator(_feature)]
    obstacle: Annotated[tuple[int, int], PlainValidator(_feature)]


class PieceContactModel(Strict):
    """The two features whose contacts are a piece of a surface; among grown cores perhaps discs about two vertices."""

    kind: Literal["vertex-edge", "edge-vertex", "vertex-vertex"]
    robot: Annotated[tuple[int, int], PlainValidator(_feature)]
    obstacle: Annotated[tuple[int, int], PlainValidator(_feature)]
    quadrant: Annotated[int, Field(strict=True, ge=0, le=3)] = 0
