"""A file being read: its text, what the reader may spend on it, and what it changes and drops."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal, NoReturn

from cfree.curves.drawn import Ring
from cfree.curves.hulls import box_of
from cfree.formats.findings import Findings, InvalidFileError, Problem, whole

MOST_BYTES = 1 << 26
"""Of a drawing or a map; what is larger is refused."""
MOST_STEPS = 1_000_000
"""Elements, points and pieces of curves that one file may come to, blocks and references expanded."""
MOST_SECONDS = 60.0
DEEPEST = 100
"""Levels of groups, blocks and references."""
CURVE_SHARE = 1000
"""A curve is met within this part of the drawing's size, if no tolerance is given."""


@dataclass(frozen=True, slots=True)
class Reading:
    """How to read: see `cfree.load_shapes`."""

    tolerance: float | None = None
    unknown: Literal["obstacle", "free"] = "obstacle"
    roles: Mapping[str, str] = field(default_factory=dict)


class Source:
    """One file, while it is read."""

    def __init__(self, file: str, text: str = "", reading: Reading | None = None) -> None:
        self.findings = Findings(file, text)
        self.reading = reading or Reading()
        self.changed: Counter[str] = Counter()
        self.dropped: Counter[str] = Counter()
        self._steps = 0
        self._end = time.monotonic() + MOST_SECONDS

    @property
    def folder(self) -> Path:
        return Path(self.findings.file).parent

    def spend(self, steps: int = 1) -> None:
        """Count what is done; refuse a file that comes to too much."""
        self._steps += steps
        if self._steps > MOST_STEPS:
            self.refuse(f"more than {MOST_STEPS:,} elements and points, references expanded; give a smaller file")
        if self._steps % 64 < steps and time.monotonic() > self._end:
            self.refuse(f"not read after {MOST_SECONDS:g} seconds; give a smaller file")

    def refuse(self, message: str, line: int = 1, column: int = 1, place: str = "") -> NoReturn:
        """The rest of the file cannot be understood."""
        raise InvalidFileError(self.findings.file, [Problem(line, column, place, message)])


def tolerance_of(source: Source, rings: Sequence[Ring]) -> float:
    """The one that is asked for, or else a part of the size of all these rings."""
    if source.reading.tolerance:
        return source.reading.tolerance
    x0, y0, x1, y1 = box_of(rings)
    return max(x1 - x0, y1 - y0) / CURVE_SHARE


def read_bytes(path: str, most: int = MOST_BYTES) -> bytes:
    """All of a file that is not too large.

    Raises
    ------
    InvalidFileError
        If there is no such file, or it is larger.
    """
    try:
        with open(path, "rb") as stream:
            raw = stream.read(most + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        message = f"{reason}; give the path of a file that can be read"
    else:
        if len(raw) <= most:
            return raw
        message = f"more than {most >> 10:,} KiB; give a smaller file"
    raise InvalidFileError(path, [whole(message)])
