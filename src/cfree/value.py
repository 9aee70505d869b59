"""What values have in common: they are equal if what they are made of is, and are copied and pickled as that; shown."""

from __future__ import annotations

from dataclasses import fields
from importlib import import_module
from typing import Any

import numpy as np


class Value:
    """Base of values that hold arrays, or keep what they compute.

    What is kept, and may not be fit to be compared or pickled, is left behind: a copy computes it again.

    Examples
    --------
    >>> from cfree.exact.pose import Poses
    >>> Poses([[0, 1]], [0.5]) == Poses([[0, 1]], [0.5]), Poses([[0, 1]], [0.5]) == Poses([[0, 1]], [0.6])
    (True, False)
    >>> Poses([[0, 1]], [0.5])
    Poses(float64[1, 2], float64[1])
    """

    __slots__ = ()

    @property
    def _content(self) -> tuple[Any, ...]:
        """What it is made of, as its constructor takes it."""
        return tuple(getattr(self, field.name) for field in fields(self))  # type: ignore[arg-type]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Value) or type(other) is not type(self):
            return NotImplemented
        return self is other or _same(self._content, other._content)

    def __hash__(self) -> int:
        return hash(tuple(part.shape if isinstance(part, np.ndarray) else part for part in self._content))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(map(_shown, self._content))})"

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._content


class Shown:
    """Base of values that a notebook shows: some as the page, where it can be in a cell; all as a picture."""

    __slots__ = ()

    def _repr_mimebundle_(self, **options: Any) -> Any:
        return import_module("cfree.viewer.notebook").live(self, **options)

    def _repr_svg_(self) -> str | None:
        # by name: what draws all kinds of values imports all of them
        found: str | None = import_module("cfree.viewer.pictures").picture(self)
        return found


def _shown(part: Any) -> str:
    """In one line: of an array its type and shape."""
    return f"{part.dtype}{list(part.shape)}" if isinstance(part, np.ndarray) else repr(part)


def _same(one: Any, other: Any) -> bool:
    """Equal; a NaN equals itself."""
    if isinstance(one, tuple) and isinstance(other, tuple):
        return len(one) == len(other) and all(map(_same, one, other))
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return one.dtype == other.dtype and np.array_equal(one, other, equal_nan=one.dtype.kind == "f")
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return False
    return bool(one == other or (one != one and other != other))
