"""The record of reading in JSON as pydantic models; `docs/scene-format.md` describes it.

Import this module inside functions.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, PlainValidator, TypeAdapter, ValidationError, WithJsonSchema

from cfree.formats.scenes.json_types import Strict
from cfree.formats.scenes.scene_values import MAX_TEXT, Fault, list_of, plain
from cfree.scene.reading import Item, Note


def _finite(value: object) -> float:
    number = plain(value)
    if isinstance(number, (int, float)) and not isinstance(number, bool):
        try:
            return float(number)
        except OverflowError:
            pass
    raise Fault("expected a number, got {got}")


def _count(value: object) -> int:
    number = plain(value)
    if type(number) is int and 0 <= number < 2**63:
        return number
    raise Fault("expected a whole number, 0 or more, got {got}")


Number = Annotated[float, PlainValidator(_finite), WithJsonSchema({"type": "number"})]
Count = Annotated[int, PlainValidator(_count), WithJsonSchema({"type": "integer", "minimum": 0})]
Word = Annotated[str, Field(max_length=MAX_TEXT)]
Pair = Annotated[tuple[Number, Number], BeforeValidator(list_of(2, "a place [x, y]"))]


class ItemModel(Strict):
    """One of the things that a note counts."""

    handle: Word = ""
    at: Pair | None = None
    size: Number | None = None
    points: list[Pair] = Field([])

    @property
    def made(self) -> Item:
        return Item(self.handle, self.at, self.size, tuple(self.points))


class NoteModel(Strict):
    """A difference between a file and the scene that was read from it."""

    kind: Word
    effect: Word = "none"
    count: Count = 1
    what: Word
    where: Word = ""
    at: Pair | None = None
    size: Number | None = None
    remedy: Word = ""
    items: list[ItemModel] = Field([])
    file: Word = ""

    @property
    def made(self) -> Note:
        items = tuple(item.made for item in self.items)
        return Note(
            self.kind, self.what, self.effect, self.count, self.where, self.at, self.size, items, self.remedy, self.file
        )


_NOTES: TypeAdapter[list[NoteModel]] = TypeAdapter(list[NoteModel])


def read_notes(value: Any) -> tuple[Note, ...]:
    """Read the notes of a decoded JSON value.

    Raises
    ------
    Fault
        If there is any fault; `scene_format.py` finds all of them and their places.
    """
    try:
        return tuple(model.made for model in _NOTES.validate_python(plain(value)))
    except ValidationError:
        raise Fault("no record of reading") from None


def notes_of_lists(changed: Sequence[str], dropped: Sequence[str]) -> tuple[Note, ...]:
    """Return the notes for the lines about changes and losses that older programs kept."""
    return *(Note("info", line) for line in changed), *(Note("info", line, "unknown") for line in dropped)
