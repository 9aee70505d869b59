"""Text that a terminal shows, and does not obey: names and notes come from files that anybody may have written."""

from __future__ import annotations

import json
import shutil
import sys
import threading
import time
import unicodedata
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from textwrap import wrap
from typing import Any

import click

EVERY = 5.0  # seconds from one line about progress to the next, where there is no terminal
OBEYED = {"Cc", "Cs", "Zl", "Zp"}  # Unicode's categories: controls, halves of characters, ends of lines
NO_TERMINAL, LEAST_WIDTH = 120, 6  # columns where output goes to a file; of a wrapped text
TURNING = {"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"}  # change the direction of what follows


def printable(text: str) -> str:
    """Text with escapes for characters that would do something else than be seen; ends of lines stay.

    Examples
    --------
    >>> print(printable("bench\\x1b[2J, Stühle"))
    bench\\x1b[2J, Stühle
    """
    return text if text.isprintable() else "".join(c if _is_seen(c) else repr(c)[1:-1] for c in text)


@contextmanager
def status() -> Iterator[Callable[[str], None]]:
    """Yield a function to call with what is being done.

    On a terminal one line shows it, and is empty at the end. Elsewhere standard error gets a line every few seconds.
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
    """A line every few seconds since the command began, also where nothing is told for long: from a thread."""
    context = click.get_current_context(silent=True)
    told = {} if context is None else context.meta  # of the whole command: phases may be short
    told.setdefault("told", time.monotonic())
    texts, over = [""], threading.Event()

    def tell() -> None:
        while not over.wait(max(0.0, told["told"] + EVERY - time.monotonic())):
            told["told"] = time.monotonic()
            if texts[0] and sys.stderr is not None:
                print(texts[0], file=sys.stderr, flush=True)

    def say(text: str) -> None:
        texts[0] = text

    thread = threading.Thread(target=tell, daemon=True)
    thread.start()
    try:
        yield say
    finally:
        over.set()
        thread.join()


def columns(rows: Sequence[Sequence[str]], sides: str, width: int = 0) -> list[str]:
    """Lines of a table; `sides` has "<" or ">" for each column. The last column is wrapped at the width, if given.

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
    """Columns of the terminal; where there is none, those of a wide one."""
    return shutil.get_terminal_size((NO_TERMINAL, 24)).columns


def _cell(text: str, width: int, side: str) -> str:
    blanks = " " * (width - _width(text))
    return f" {text}{blanks} " if side == "<" else f" {blanks}{text} "


def _width(text: str) -> int:
    """On a terminal, where letters of Chinese are two wide."""
    return sum(2 if unicodedata.east_asian_width(c) in "FW" else 1 for c in text)


def json_text(facts: dict[str, Any]) -> str:
    """JSON in which such characters are escaped as well.

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
