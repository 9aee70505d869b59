"""The record of reading a file: each loss, guess and change between the drawing and the scene, as a `Note`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Literal, get_args

Kind = Literal["lost", "guess", "assumption", "warning", "joined", "near", "mended", "hidden", "paint", "info"]
"""Kinds of notes, the most serious first."""
Effect = Literal["less", "more", "near", "none", "unknown"]
KINDS: tuple[str, ...] = get_args(Kind)
EFFECTS: tuple[str, ...] = get_args(Effect)
LOSSES = ("lost", "guess", "warning")
"""Kinds that are errors for strict readers."""
MOST_ITEMS = 20
"""Maximum number of single places that a note lists."""


@dataclass(frozen=True, slots=True)
class Item:
    """One of the things that a note counts: its handle or line in the file, its place, and its size."""

    handle: str = ""
    at: tuple[float, float] | None = None
    size: float | None = None


@dataclass(frozen=True, slots=True)
class Note:
    """A difference between a file and the scene that was read from it.

    Attributes
    ----------
    kind : str
        "lost": drawn and not in the scene. "guess": the file does not decide. "assumption": an option's statement.
        "warning": probably not meant. "joined": gaps that were closed. "near": within a tolerance. "mended": faults of
        the file. "hidden": layers that are off. "paint": text and dimensions. "info": everything else.
    what : str
        A noun phrase in the singular without a number, such as "open line".
    effect : str
        "less": less is forbidden than drawn; "more"; "near": within `size`; "none"; or "unknown".
    count : int
        Number of things.
    where : str
        Layer, group or id.
    at : pair of float, optional
        Place of the worst, in the scene's frame.
    size : float, optional
        Length, area or gap of the worst, in the scene's unit.
    items : tuple of Item
        Up to 20 of the things, in the file's order.
    remedy : str
        An option of the command line that changes it, literally.
    file : str
        The file, if several were read.
    """

    kind: Kind
    what: str
    effect: Effect = "none"
    count: int = 1
    where: str = ""
    at: tuple[float, float] | None = None
    size: float | None = None
    items: tuple[Item, ...] = ()
    remedy: str = ""
    file: str = ""

    @property
    def severity(self) -> int:
        """Rank of the kind: 0 is the most serious."""
        return KINDS.index(self.kind) if self.kind in KINDS else len(KINDS)


class Notes:
    """Collect notes; those of the same kind, subject, place and effect become one."""

    def __init__(self) -> None:
        self._notes: dict[tuple[str, str, str, str], Note] = {}

    def add(self, note: Note) -> None:
        """Count a note."""
        key = note.kind, note.what, note.where, note.effect
        before = self._notes.get(key)
        self._notes[key] = note if before is None else _merged(before, note)

    def __iter__(self) -> Iterator[Note]:
        return iter(in_order(self._notes.values()))

    def __len__(self) -> int:
        return len(self._notes)


def _merged(before: Note, note: Note) -> Note:
    worse = (note.size or 0) > (before.size or 0)
    return replace(
        note if worse else before,
        count=before.count + note.count,
        items=(before.items + note.items)[:MOST_ITEMS],
        remedy=before.remedy or note.remedy,
    )


def in_order(notes: Iterable[Note]) -> tuple[Note, ...]:
    """Return notes, the most serious first; the order of the file among equals."""
    return tuple(sorted(notes, key=lambda note: note.severity))
