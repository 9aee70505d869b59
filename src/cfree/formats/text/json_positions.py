"""Find the place of each value of a JSON text, only when there is an error to report.

The standard decoder is quick and discards positions. `places` walks the same text a second time, token by token and
without recursion, so that neither long nor deep texts exhaust it.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

Path = tuple[str | int, ...]
"""Keys and indices that lead from the whole file to a value: `("obstacles", 1, "outer", 2)`."""

# possessive repeats: a string of ten million characters costs one pass and no memory
_TOKEN = re.compile(r'"(?:[^"\\]++|\\.)*+"?|[\[\]{},:]|[^\s\[\]{},:"]++', re.DOTALL)


@dataclass(frozen=True, slots=True)
class Place:
    """The span of a value in the text, and the start of its key (of the value, if it has none)."""

    start: int
    end: int
    key: int
    repeated: bool


def places(text: str) -> Iterator[tuple[Path, Place]]:
    """Yield path and place of every value, containers after their contents.

    Parameters
    ----------
    text : str
        JSON that the standard decoder accepts.

    Yields
    ------
    tuple of Path and Place
        `Place.repeated` is True if the same object had this key before.

    Notes
    -----
    The time is linear in the length of the text.

    Examples
    --------
    >>> for path, place in places('{"a": [1, true]}'):
    ...     print(path, place.start, place.end, place.key)
    ('a', 0) 7 8 7
    ('a', 1) 10 14 10
    ('a',) 6 15 1
    () 0 16 0
    """
    path: list[str | int] = []
    open_values: list[tuple[int, int, bool]] = []
    keys_seen: list[set[str]] = []
    awaits_key = repeated = False
    key = -1
    for match in _TOKEN.finditer(text):
        start, end = match.span()
        first = text[start]
        if first in "[{":
            open_values.append((start, start if key < 0 else key, repeated))
            awaits_key, repeated, key = first == "{", False, -1
            path.append("" if awaits_key else 0)
            keys_seen.append(set())
        elif first in "]}":
            path.pop()
            keys_seen.pop()
            awaits_key = False
            opened, key_start, was_repeated = open_values.pop()
            yield tuple(path), Place(opened, end, key_start, was_repeated)
        elif first == ",":
            key, repeated = -1, False
            step = path[-1]
            if isinstance(step, int):
                path[-1] = step + 1
            else:
                awaits_key = True
        elif awaits_key and first == '"':
            name = unquoted(match[0])
            path[-1], key, repeated, awaits_key = name, start, name in keys_seen[-1], False
            keys_seen[-1].add(name)
        elif first != ":":
            yield tuple(path), Place(start, end, start if key < 0 else key, repeated)


def unquoted(token: str) -> str:
    """Return the text of a quoted JSON string; a token that is none is unchanged."""
    from json import loads

    try:
        return str(loads(token, strict=False))
    except ValueError:
        return token


def dotted(path: Path) -> str:
    """Return a path in the usual notation.

    Examples
    --------
    >>> dotted(("obstacles", 1, "outer", 2))
    'obstacles[1].outer[2]'
    >>> dotted(("check", "two words"))
    'check["two words"]'
    """
    from json import dumps

    parts: list[str] = []
    for step in path:
        if isinstance(step, int):
            parts.append(f"[{step}]")
        elif step.isidentifier() and step.isascii() and len(step) <= 40:
            parts.append(f".{step}" if parts else step)
        else:
            parts.append(f"[{shortened(dumps(step))}]")
    return "".join(parts)


def shortened(written: str) -> str:
    """Return a piece of a file on one line, cut in the middle.

    Examples
    --------
    >>> shortened("[[0, 0],\\n [1, 0]]")
    '[[0, 0], [1, 0]]'
    >>> shortened("1234567890" * 9)
    '123456789012345678901234567 ... 34567890'
    """
    line = " ".join(written[:200].split())
    line = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in line)
    if len(line) <= 40 and len(written) <= 200:
        return line
    return f"{line[:27]} ... {''.join(c for c in written[-8:] if c.isprintable())}"
