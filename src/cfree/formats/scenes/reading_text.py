"""Write the record of reading as JSON; `docs/scene-format.md` describes it, `reading_format.py` reads it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields
from math import isfinite
from typing import Any

from cfree.scene.reading import Item, Note

MOST_WRITTEN = 20
"""Maximum number of single places of a note in a file."""
_ALWAYS = ("kind", "effect", "count", "what")
_ORDER = (*_ALWAYS, "where", "at", "size", "remedy", "items", "file")


def records(notes: Iterable[Note], *, with_points: bool = False) -> list[dict[str, Any]]:
    """Return notes as JSON objects; members that say nothing are left out, and points unless they are wanted.

    Examples
    --------
    >>> records([Note("lost", "open line", "less", 39, at=(0.5, 2), size=float("inf"))])
    [{'kind': 'lost', 'effect': 'less', 'count': 39, 'what': 'open line', 'at': [0.5, 2.0]}]
    """
    return [_record(note, with_points) for note in notes]


def _record(note: Note, with_points: bool) -> dict[str, Any]:
    values = {key: _plain(getattr(note, key)) for key in _ORDER if key != "items"}
    values["count"] = int(note.count)
    values["items"] = [_item(item, with_points) for item in note.items[:MOST_WRITTEN]]
    return {key: values[key] for key in _ORDER if key in _ALWAYS or values[key] not in (None, "", [])}


def _item(item: Item, with_points: bool) -> dict[str, Any]:
    names = [field.name for field in fields(item) if with_points or field.name != "points"]
    values = {name: _plain(getattr(item, name)) for name in names}
    return {key: value for key, value in values.items() if value not in (None, "", [])}


def _plain(value: Any) -> Any:
    """Return a text that can be encoded, a finite number, or a list of these; None for any other."""
    if isinstance(value, str):
        return value.encode("utf-8", "backslashreplace").decode("utf-8")
    if isinstance(value, tuple):
        parts = [_plain(part) for part in value]
        return None if None in parts else parts
    return None if value is None or not isfinite(value) else float(value)
