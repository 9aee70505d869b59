"""Lines about the record of reading: one for each kind and place, and the claims of answers that notes harm.

A note harms a claim by its effect alone: where less is forbidden than drawn, a path may lead through walls; where more
is, a path may exist although none is found.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import Literal

from cfree.scene.reading import EFFECTS, LOSSES, Note, in_order
from cfree.words import counted

Claim = Literal["path", "no path", "scene"]
"""The claim of an answer: "path" also stands for lower bounds of clearances, "no path" for upper ones."""
HARMFUL: dict[Claim, tuple[str, ...]] = {
    "path": ("less", "unknown"),
    "no path": ("more", "unknown"),
    "scene": ("less", "more", "unknown"),
}
"""Effects that harm a claim."""
_LEFT_OUT = ("hidden", "paint")
_NOUNS = {"lost": "loss"}


def lines(notes: Iterable[Note]) -> list[str]:
    """Return the lines of a record, the most serious first.

    Notes of one kind and place share a line; those of hidden things and of text share one a file.

    Examples
    --------
    >>> notes = [Note("info", "unit is 1 mm"), Note("lost", "open line", "less", 2, "walls"), Note("paint", "text")]
    >>> lines([*notes, Note("lost", "point", "less", 1, "walls")])
    ['LOST      2 open lines of walls; 1 point', 'left out  1 text', 'info      unit is 1 mm']
    """
    ordered = in_order(notes)
    files = {note.file for note in ordered}
    groups: dict[tuple[str, str, str], list[Note]] = {}
    for note in ordered:
        groups.setdefault((note.label, "" if note.kind in _LEFT_OUT else note.where, note.file), []).append(note)
    return [_in_one(_line(group, file if len(files) > 1 else "")) for (_, _, file), group in groups.items()]


def _in_one(text: str) -> str:
    """Return a text without ends of lines, which names in a file may have."""
    return text.replace("\n", "\\n").replace("\r", "\\r")


def _line(group: Sequence[Note], file: str) -> str:
    first, before = group[0], f"{file}: " if file else ""
    if len(group) == 1:
        return f"{first.label:<9} {before}{first.text}"
    own = first.kind in _LEFT_OUT
    texts = [f"{note.things if own or note is first else note.bare_things}{note.worst}" for note in group]
    remedies = dict.fromkeys(note.remedy for note in group if note.remedy)
    return f"{first.label:<9} {before}{'; '.join(texts)}" + (f": {'; '.join(remedies)}" if remedies else "")


def losses(notes: Iterable[Note]) -> tuple[Note, ...]:
    """Return the notes that a strict reader refuses."""
    return tuple(note for note in in_order(notes) if note.kind in LOSSES)


def counts(notes: Iterable[Note]) -> str:
    """Count the things of each kind, such as "39 losses, 1 guess"."""
    kinds = groupby(in_order(notes), key=lambda note: note.kind)
    return ", ".join(counted(sum(note.count for note in group), _NOUNS.get(kind, kind)) for kind, group in kinds)


def as_read(notes: Iterable[Note], claim: Claim = "scene") -> str:
    """Return the worst harm that a record does to a claim; empty if it does none.

    Examples
    --------
    >>> notes = [Note("lost", "open line", "less", 39, "A-WALL")]
    >>> as_read(notes, "path")
    'in the scene as read: 39 open lines of A-WALL are not in it'
    >>> as_read(notes, "no path")
    ''
    """
    harmful = harms(notes, claim)
    return _in_one(f"in the scene as read: {_harm(harmful[0])}") if harmful else ""


def harms(notes: Iterable[Note], claim: Claim) -> tuple[Note, ...]:
    """Return the notes that harm a claim, the worst first; if there are none, those about tolerances.

    A note that forbids less than drawn is worse than one that forbids more.
    """
    ordered = in_order(notes)
    harmful = [note for note in ordered if note.effect in HARMFUL[claim] or note.effect not in EFFECTS]
    return tuple(sorted(harmful, key=lambda note: note.effect == "more")) or tuple(
        note for note in ordered if note.effect == "near"
    )


def qualified(statement: str, notes: Sequence[Note], claim: Claim) -> str:
    """Return the statement of an answer with the harm that a record does to it; empty if there is none to tell.

    Examples
    --------
    >>> qualified("no path, proved", [Note("lost", "open line", "less", 39)], "no path")
    'no path, proved; what was left out could only forbid more'
    """
    if harm := as_read(notes, claim):
        return f"{statement}, {harm}"
    if claim == "no path" and any(note.effect == "less" for note in notes):
        return f"{statement}; what was left out could only forbid more"
    return ""


def _harm(note: Note) -> str:
    things, are = note.things, "is" if note.count == 1 else "are"
    if note.effect == "near":
        return f"{things} {are} " + ("near the drawn" if note.size is None else f"within {note.size:.3g} of the drawn")
    if note.kind in ("lost", *_LEFT_OUT):
        return f"{things} {are} not in it"
    if note.kind == "assumption":
        return f"by assumption ({things})"
    amount = {"less": "less", "more": "more"}.get(note.effect, "less or more")
    return f"{amount} may be forbidden than drawn ({things})"
