"""Report all faults of a file at once: place, value, remedy.

A reader collects `Problem`s while it reads on, and raises one `InvalidFileError` at its end.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path as FilePath

from cfree.errors import FormatError
from cfree.formats.text.json_positions import Path, Place, dotted, places, shortened
from cfree.words import counted

SHOWN = 50
"""Maximum number of problems in the message; `InvalidFileError.problems` has all of them."""
LARGEST = 1 << 29
"""Maximum size of a text in bytes; endless files exceed it."""


@dataclass(frozen=True, slots=True, order=True)
class Problem:
    """One fault: line and column from 1, or 0 for the whole file; place inside the file, value and remedy."""

    line: int
    column: int
    place: str
    message: str

    def __str__(self) -> str:
        where = f"{self.line}:{self.column}" if self.line else ""
        return f"{where} {self.place}{self.place and ': '}{self.message}"


def whole(message: str) -> Problem:
    """Return a fault of the whole file, which has no place in it."""
    return Problem(0, 0, "", message)


class InvalidFileError(FormatError):
    """A file that cannot be read, with all its problems in the order of the file.

    Examples
    --------
    >>> print(InvalidFileError("a.json", [Problem(3, 21, "bounds[0]", "expected a number, got true")]))
    a.json:3:21 bounds[0]: expected a number, got true
    >>> print(InvalidFileError("b.json", [whole("No such file or directory")]))
    b.json: No such file or directory
    """

    def __init__(self, file: str, problems: Sequence[Problem]) -> None:
        self.problems = tuple(sorted(problems))
        first = self.problems[0]
        lines = [f"{file}:{problem}" for problem in self.problems[:SHOWN]]
        if len(self.problems) > SHOWN:
            lines.append(f"{file}: and {counted(len(self.problems) - SHOWN, 'more problem')}")
        super().__init__("\n".join(lines), path=file, line=first.line or None, column=first.column or None)

    def __reduce__(self) -> tuple[type[InvalidFileError], tuple[str | None, tuple[Problem, ...]]]:
        return InvalidFileError, (self.path, self.problems)


class Findings:
    """The problems of one text."""

    def __init__(self, file: str, text: str) -> None:
        self.file = file
        self.text = text
        self._problems: list[Problem] = []
        self._pending: dict[Path, list[tuple[str, bool]]] = {}
        self._said: set[Path] = set()

    @cached_property
    def _line_starts(self) -> list[int]:
        return [0, *(match.end() for match in re.finditer("\n", self.text))]

    def __len__(self) -> int:
        return len(self._problems) + len(self._pending)

    def at(self, offset: int, place: str, message: str) -> None:
        """Note a problem of the character at `offset`."""
        line = bisect_right(self._line_starts, offset)
        self._problems.append(Problem(line, offset - self._line_starts[line - 1] + 1, place, message))

    def under(self, path: Path, message: str, *, key: bool = False) -> None:
        """Note a problem of a JSON value, or of its key; ``{got}`` becomes the text there."""
        if path not in self._said:
            self._pending.setdefault(path, []).append((message, key))

    def irregular_json(self) -> None:
        """Note faults that the decoder accepts: NaN, infinities, repeated keys."""
        for path, place in places(self.text):
            if place.repeated:
                key = shortened(str(path[-1]))
                self._note(path, place, f'key "{key}" is there twice; keep one', True)
            if self.text[place.start : place.end].strip("-") in ("NaN", "Infinity"):
                self._said.add(path)
                self._note(path, place, "{got} is not finite; give a finite number", False)

    def fail_if_any(self) -> None:
        """Raise all problems, if there are any."""
        if self._pending:
            for path, place in places(self.text):
                for message, key in self._pending.pop(path, ()):
                    self._note(path, place, message, key)
            for path, messages in self._pending.items():
                for message, _ in messages:
                    self.at(0, dotted(path), message)
        if self._problems:
            raise InvalidFileError(self.file, self._problems)

    def _note(self, path: Path, place: Place, message: str, key: bool) -> None:
        got = shortened(self.text[place.start : place.end])
        self.at(place.key if key else place.start, dotted(path), message.replace("{got}", got))


def read_text(file: FilePath, most: int | None = None) -> str:
    """Read a text file in UTF-8, with or without a byte order mark.

    Raises
    ------
    InvalidFileError
        If there is no such file, or it is not text.
    """
    most = LARGEST if most is None else most
    try:
        with file.open("rb") as stream:
            raw = stream.read(most + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        fault = f"{reason}; give the path of a file that can be read"
        raise InvalidFileError(str(file), [whole(fault)]) from None
    if len(raw) > most:
        fault = f"more than {_size(most)}; give a file of a scene or an answer"
        raise InvalidFileError(str(file), [whole(fault)])
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        readable = raw[: error.start].decode("utf-8", errors="replace")
        message = f"byte 0x{raw[error.start]:02x} is not UTF-8; save the file as UTF-8 text"
        line, column = readable.count("\n") + 1, len(readable) - readable.rfind("\n")
        raise InvalidFileError(str(file), [Problem(line, column, "", message)]) from None


def _size(count: int) -> str:
    return f"{count >> 20} MiB" if count >> 20 else f"{count >> 10} KiB"
