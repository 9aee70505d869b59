"""Text that a terminal shows and does not obey: names and notes come from untrusted files."""

from __future__ import annotations

import json
import sys
import threading
import time
import unicodedata
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from textwrap import wrap
from typing import Any

import click

EVERY = 5.0  # seconds between lines about progress, if there is no terminal
OBEYED = {"Cc", "Cs", "Zl", "Zp"}  # Unicode's categories: controls, halves of characters, ends of lines
NO_TERMINAL, LEAST_WIDTH = 120, 6  # columns of output to a file; least columns of a wrapped text
TURNING = {"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"}  # change the direction of what follows


def printable(text: str) -> str:
    """Escape characters of a text that a terminal would obey; ends of lines stay.

    Examples
    --------
    >>> print(printable("bench\\x1b[2J, Stühle"))
    bench\\x1b[2J, Stühle
    """
    return text if text.isprintable() else "".join(c if _is_seen(c) else repr(c)[1:-1] for c in text)


@contextmanager
def status() -> Iterator[Callable[[str], None]]:
    """Yield a function to call with the current task.

    A terminal shows it in one line, which is empty at the end. Otherwise standard error gets a line every few seconds.
    """
    if sys.stderr is None or not sys.stderr.isatty():
        with _lines() as say:
            yield say
        return

    def show(text: str) -> None:
        print(f"\r{text}\x1b[K", end="", file=sys.stderr, flush=True)

    try:
        yield show
    finally:
        show("")


@contextmanager
def _lines() -> Iterator[Callable[[str], None]]:
    """Print a line every few seconds since the command began, from a thread: also during long silent work."""
    context = click.get_current_context(silent=True)
    told = {} if context is None else context.meta  # shared by the whole command: phases may be short
    told.setdefault("told", time.monotonic())
    texts, over = [""], threading.Event()

    def rest() -> float:
        return max(0.0, float(told["told"]) + EVERY - time.monotonic())

    def tell() -> None:
        told["told"] = time.monotonic()
        if texts[0] and sys.stderr is not None:
            print(texts[0], file=sys.stderr, flush=True)

    def tell_often() -> None:
        while not over.wait(rest()):
            tell()

    def say(text: str) -> None:
        texts[0] = text

    thread = threading.Thread(target=tell_often, daemon=True)
    thread.start()
    try:
        yield say
    finally:
        over.set()
        thread.join()
        if not rest():  # the thread did not run in time
            tell()


def columns(rows: Sequence[Sequence[str]], sides: str, width: int = 0) -> list[str]:
    """Format lines of a table; `sides` has "<" or ">" for each column. A width, if given, wraps the last column.

    Examples
    --------
    >>> columns([["robot", "20"], ["Tür", "3"]], "<>")
    [' robot  20', ' Tür     3']
    >>> columns([["by", "one; two; three"]], "<<", 13)
    [' by  one;', '     two;', '     three']
    """
    widths = [max(map(_width, column)) for column in zip(*rows, strict=True)]
    left = max(LEAST_WIDTH, width - sum(each + 2 for each in widths[:-1]) - 2) if width else 0
    lines = []
    for *cells, last in rows:
        first, *more = (wrap(last, left, break_long_words=False, break_on_hyphens=False) if left else [last]) or [""]
        lines.append([*cells, first])
        lines += [[*[""] * len(cells), part] for part in more]
    widths[-1] = max(_width(line[-1]) for line in lines)
    return ["".join(map(_cell, line, widths, sides)).rstrip() for line in lines]


def terminal_width() -> int:
    """Return the columns of the terminal, or of a wide one if there is none."""
    import shutil

    return shutil.get_terminal_size((NO_TERMINAL, 24)).columns


def _cell(text: str, width: int, side: str) -> str:
    blanks = " " * (width - _width(text))
    return f" {text}{blanks} " if side == "<" else f" {blanks}{text} "


def _width(text: str) -> int:
    """Return the width on a terminal, where Chinese letters are two wide."""
    return sum(2 if unicodedata.east_asian_width(c) in "FW" else 1 for c in text)


def json_text(facts: dict[str, Any]) -> str:
    """Format JSON in which characters that a terminal would obey are escaped as well.

    Examples
    --------
    >>> json_text({"name": "\\x9b2J, ö"})
    '{\\n  "name": "\\\\u009b2J, ö"\\n}'
    """
    text = json.dumps(facts, indent=2, ensure_ascii=False)
    return "".join(c if _is_seen(c) else json.dumps(c)[1:-1] for c in text)


def print_json(facts: dict[str, Any]) -> None:
    print(json_text(facts))


def _is_seen(c: str) -> bool:
    if c.isprintable() or c == "\n":
        return True
    return unicodedata.category(c) not in OBEYED and unicodedata.bidirectional(c) not in TURNING
