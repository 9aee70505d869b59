"""A file of shapes being read: its text, the limits on reading it, and the changes and losses to report."""

from __future__ import annotations

import re
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, NoReturn

from cfree.curves.drawn import Ring
from cfree.curves.hulls import box_of
from cfree.formats.shapes import Shape, Shapes
from cfree.formats.text.findings import Findings, InvalidFileError, Problem, whole

MOST_BYTES = 1 << 26
"""Maximum size of a drawing or a map."""
MOST_STEPS = 1_000_000
"""Maximum number of elements, points and pieces of curves of a file, blocks and references expanded."""
MOST_SECONDS = 60.0
DEEPEST = 100
"""Maximum depth of groups, blocks and references."""
CURVE_SHARE = 1000
"""Default tolerance of curves: the drawing's size divided by this."""
_MARK = re.compile(r"(robot|obstacle|workspace)(?![a-z])", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Reading:
    """Options of reading, see `cfree.load_shapes`."""

    tolerance: float | None = None
    unknown: Literal["obstacle", "free"] = "obstacle"
    roles: Mapping[str, str] = field(default_factory=dict)


class Source:
    """One file while it is read."""

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
        """Count steps; refuse a file that takes too many of them, or too long."""
        self._steps += steps
        if self._steps > MOST_STEPS:
            self.refuse(f"more than {MOST_STEPS:,} elements and points, references expanded; give a smaller file")
        if self._steps % 64 < steps and time.monotonic() > self._end:
            self.refuse(f"not read after {MOST_SECONDS:g} seconds; give a smaller file")

    def refuse(self, message: str, line: int = 1, column: int = 1, place: str = "") -> NoReturn:
        """Refuse the file: its rest cannot be read."""
        raise InvalidFileError(self.findings.file, [Problem(line, column, place, message)])


def tolerance_of(source: Source, rings: Sequence[Ring]) -> float:
    """Return the requested tolerance, or a share of the size of all these rings."""
    if source.reading.tolerance:
        return source.reading.tolerance
    x0, y0, x1, y1 = box_of(rings)
    return max(x1 - x0, y1 - y0) / CURVE_SHARE


def read_bytes(path: str, most: int = MOST_BYTES) -> bytes:
    """Read a whole file of limited size.

    Raises
    ------
    InvalidFileError
        If there is no such file, or it is too large.
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


def shapes_of(source: Source, form: str, shapes: list[Shape], settings: Mapping[str, Any], remedy: str) -> Shapes:
    """Return the shapes that a reader found; raise the problems that it noted."""
    source.findings.fail_if_any()
    return Shapes(
        form,
        tuple(shapes),
        dict(settings),
        _lines(source.changed),
        _lines(source.dropped),
        source.findings.file,
        remedy,
    )


def _lines(counted: Counter[str]) -> tuple[str, ...]:
    return tuple(message if count == 1 else f"{message} ({count:,} times)" for message, count in counted.items())


def role_of(source: Source, *names: str | None) -> tuple[str, str | None]:
    """Return role and name of a shape in groups or on a layer of these names, the innermost first.

    A name that begins with a role, in capital or small letters, gives this role.

    Examples
    --------
    >>> role_of(Source("a.svg"), None, "Robot 2", "walls"), role_of(Source("a.svg"), "wall", "house")
    (('robot', None), ('obstacle', 'wall'))
    """
    named = [name for name in names if name]
    for name in named:
        if wanted := source.reading.roles.get(name):
            return wanted, name
    for name in named:
        if mark := _MARK.match(name):
            role = mark[1].lower()
            if role != "obstacle":
                return role, None
            return role, name if name.lower() != role else next((other for other in named if other != name), None)
    return "obstacle", named[0] if named else None
