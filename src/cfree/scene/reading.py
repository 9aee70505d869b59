"""The record of reading a file: each loss, guess and change between the drawing and the scene, as a `Note`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import Literal, get_args

from cfree.words import counted, noun_and_rest

Kind = Literal["lost", "guess", "assumption", "warning", "joined", "near", "mended", "hidden", "paint", "info"]
"""Kinds of notes, the most serious first."""
Effect = Literal["less", "more", "near", "none", "unknown"]
KINDS: tuple[str, ...] = get_args(Kind)
EFFECTS: tuple[str, ...] = get_args(Effect)
LOSSES = ("lost", "guess", "warning")
"""Kinds that are errors for strict readers."""
MOST_ITEMS = 1000
"""Maximum number of single places that a note lists; files hold fewer."""
MOST_POINTS = 100
"""Maximum number of points of one of these."""
MOST_LETTERS = 80
"""Maximum length of the name of a layer in a line."""
NOISE = 1e-13
"""Coordinates up to this are written as 0."""
Place = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Item:
    """One of the things that a note counts: its handle or line in the file, its place, and its size.

    Its `points` are for pictures: a line, or the outline of a shape, whose last point is then the first one.
    """

    handle: str = ""
    at: Place | None = None
    size: float | None = None
    points: tuple[Place, ...] = ()


@dataclass(frozen=True, slots=True)
class Note:
    """A difference between a file and the scene that was read from it.

    Attributes
    ----------
    kind : str
        "lost": drawn and not in the scene. "guess": the file does not decide. "assumption": an option's statement.
        "warning": probably not meant. "joined": gaps that were closed. "near": within a tolerance. "mended": faults of
        the file. "hidden": layers that are off. "paint": text and dimensions. "info": everything else. Files may have
        other kinds, which are kept.
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
        Up to 1,000 of the things, in the file's order; a scene file holds 20 of them.
    remedy : str
        An option of the command line that changes it, literally.
    file : str
        The file, if it was not a scene's.

    Examples
    --------
    >>> print(Note("lost", "open line", "less", 39, "A-WALL", (12.2, -2.3), 140.0, remedy="--join 0.0004"))
    LOST      39 open lines of A-WALL (the largest 140 at 12.2, -2.3): --join 0.0004
    """

    kind: str
    what: str
    effect: str = "none"
    count: int = 1
    where: str = ""
    at: Place | None = None
    size: float | None = None
    items: tuple[Item, ...] = ()
    remedy: str = ""
    file: str = ""

    @property
    def severity(self) -> int:
        """Rank of the kind: 0 is the most serious."""
        return KINDS.index(self.kind) if self.kind in KINDS else len(KINDS)

    @property
    def label(self) -> str:
        """The word with which its line begins."""
        return _LABELS.get(self.kind, self.kind)

    @property
    def things(self) -> str:
        """What it counts, with the number and the layer, group or id; one of mere information has no number."""
        return self._things(self.where)

    @property
    def bare_things(self) -> str:
        """What it counts, with the number alone."""
        return self._things("")

    def _things(self, where: str) -> str:
        is_single = self.count == 1 and self.kind not in _COUNTED
        text = self.what if is_single else counted(self.count, self.what)
        if not where:
            return text
        noun, rest = noun_and_rest(text)
        return f"{text} of {_named(where)}" if rest.startswith(" of") else f"{noun} of {_named(where)}{rest}"

    @property
    def worst(self) -> str:
        """Size and place of the worst of the things, as an attribute of them."""
        size = None if self.size is None else f"{self.size:.3g}"
        place = f" at {', '.join(map(_short, self.at))}" if self.at else ""
        if self.kind == "joined" and size:
            return f", the widest gap {size}{place}"
        if self.effect == "near" and size:
            return f" within {size}{place}"
        if size:
            return f" ({'the largest ' if self.count > 1 else ''}{size}{place})"
        return f" ({'one' if self.count > 1 else 'it is'}{place})" if place else ""

    @property
    def subject(self) -> str:
        """Its line without label and remedy."""
        return f"{self.things}{self.worst}"

    @property
    def text(self) -> str:
        """Its line without the label."""
        return f"{self.subject}: {self.remedy}" if self.remedy else self.subject

    def __str__(self) -> str:
        """Write its line, as the commands print it."""
        return f"{self.label:<9} {self.text}"


_LABELS = {"lost": "LOST", "assumption": "assumed", "hidden": "left out", "paint": "left out"}
_COUNTED = ("lost", "guess", "assumption", "joined", "hidden", "paint")
"""Kinds whose notes begin with their count also if it is 1."""


def _short(coordinate: float) -> str:
    """Write a coordinate with six digits; noise around 0 is 0."""
    return f"{coordinate if abs(coordinate) > NOISE else 0:.6g}"


def _named(where: str) -> str:
    """Quote a name that is more than one plain word; cut a long one."""
    name = where if len(where) <= MOST_LETTERS else f"{where[:MOST_LETTERS]}..."
    return name if re.fullmatch(r"[\w.:#$/-]+", name) else f'"{name}"'


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
    """Return notes, the most serious first; among losses the largest, else the order of the file."""
    return tuple(sorted(notes, key=lambda note: (note.severity, -(note.size or 0) if note.kind == "lost" else 0)))


def together(*records: Iterable[Note]) -> tuple[Note, ...]:
    """Return the notes of several records in order, each once; notes that differ in their items alone are one."""
    notes: dict[Note, Note] = {}
    for record in records:
        for note in record:
            notes.setdefault(replace(note, items=()), note)
    return in_order(notes.values())


def of_file(notes: Iterable[Note], file: str) -> tuple[Note, ...]:
    """Return notes with the name of their file; those that have one keep it."""
    name = PurePath(file).name
    return tuple(note if note.file else replace(note, file=name) for note in notes)


def without_places(notes: Iterable[Note]) -> tuple[Note, ...]:
    """Return notes whose items have no places, so that no picture shows them in another frame."""
    return tuple(replace(note, items=tuple(replace(item, at=None, points=()) for item in note.items)) for note in notes)


def thinned(points: Sequence[Place]) -> tuple[Place, ...]:
    """Return at most `MOST_POINTS` of the points of a line, with both ends.

    Examples
    --------
    >>> line = thinned([(k, 0) for k in range(1000)])
    >>> len(line), line[0], line[-1]
    (100, (0, 0), (999, 0))
    """
    last = len(points) - 1
    if last < MOST_POINTS:
        return tuple(points)
    return tuple(points[round(k * last / (MOST_POINTS - 1))] for k in range(MOST_POINTS))
