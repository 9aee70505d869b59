"""The JSON of `Stuck`, version 1, as a pydantic model, and its text; `docs/answer-format.md` describes it.

Import this module inside functions.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from cfree.formats.answers.path_format import AnswerModel
from cfree.formats.scenes.scene_format import Configuration, VehicleValue
from cfree.formats.scenes.scene_values import Fault
from cfree.planning.stuck import Stuck


class StuckModel(AnswerModel):
    """A vehicle that contacts at one end hold."""

    answer: Literal["stuck"]
    vehicle: VehicleValue
    at: Literal["start", "goal"]
    of: Literal["pieces", "paths"]
    obstacles: list[Annotated[int, Field(strict=True, ge=-2, lt=2**31)]]
    rail: Annotated[list[Configuration], Field(min_length=1)]

    @model_validator(mode="after")
    def _fits(self) -> StuckModel:
        first: object = self.rail[0]
        if first != self.ends[0 if self.at == "start" else 1]:
            raise Fault(f'"rail" does not begin at the {self.at}; correct one of them')
        return self

    @property
    def result(self) -> Stuck:
        start, goal = self.ends
        return Stuck(
            start,
            goal,
            self.vehicle,
            self.at,
            self.of,
            tuple(self.rail),  # type: ignore[arg-type]
            tuple(self.obstacles),
            **self.context,
        )
