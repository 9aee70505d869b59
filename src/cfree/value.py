"""Base classes for values: equality, copying and pickling by content; display in notebooks; prepared data kept."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from typing import Any, TypeVar

from cfree.lazy import registered
from cfree.libraries import is_array, np

V = TypeVar("V", bound="Keeping")
T = TypeVar("T")


class Value:
    """Base of values that hold arrays or cache computed results.

    Caches are neither compared nor pickled: a copy computes them again.

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
        """Content of the value: the arguments of its constructor."""
        return tuple(getattr(self, field.name) for field in fields(self))  # type: ignore[arg-type]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Value) or type(other) is not type(self):
            return NotImplemented
        return self is other or _same(self._content, other._content)

    def __hash__(self) -> int:
        return hash(tuple(part.shape if is_array(part) else part for part in self._content))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(map(_shown, self._content))})"

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._content


class Shown:
    """Base of values with a display in notebooks: a picture, and for some kinds the interactive page."""

    __slots__ = ()

    def _repr_mimebundle_(self, **options: Any) -> Any:
        return registered("page")(self, **options)

    def _repr_svg_(self) -> str | None:
        text: str | None = registered("picture")(self)
        return text


class Answer:
    """Base of answers to a question about a scene, which are drawn among its obstacles."""

    __slots__ = ()

    def plot(self, scene: Any = None, boundary: Any = None, *, preferences: Any = None) -> Any:
        """Draw the answer with `cfree.plot.picture`, which says what is drawn; return the matplotlib figure.

        Parameters
        ----------
        scene : Scene, optional
            The answer's own unless given. An answer that was read from a file knows none.
        boundary : Boundary, optional
            Of that scene: a path is then drawn in the configuration space as well.
        preferences : Preferences, optional
            Where a path does what these find dear is marked.
        """
        return registered("figure")(self, scene, boundary, preferences=preferences)


class Keeping:
    """Base of values that keep what functions make of them: no part of the value, not compared, copied or pickled."""

    __slots__ = ("_kept",)
    _kept: dict[Any, Any]


def kept(value: V, make: Callable[[V], T]) -> T:
    """Return what a function makes of a value: at the first call it is made, and kept as long as the value.

    It must not refer to the value, or the two would outlive their last use.

    Examples
    --------
    >>> value = Keeping()
    >>> kept(value, repr) is kept(value, repr)
    True
    """
    try:
        return value._kept[make]  # type: ignore[no-any-return]
    except AttributeError:
        object.__setattr__(value, "_kept", {})
    except KeyError:
        pass
    return value._kept.setdefault(make, make(value))  # type: ignore[no-any-return]


def _shown(part: Any) -> str:
    """Text of a part in one line; an array is shown by its type and shape."""
    return f"{part.dtype}{list(part.shape)}" if is_array(part) else repr(part)


def _same(one: Any, other: Any) -> bool:
    """True if two parts are equal; a NaN equals itself."""
    if isinstance(one, tuple) and isinstance(other, tuple):
        return len(one) == len(other) and all(map(_same, one, other))
    if is_array(one) and is_array(other):
        return one.dtype == other.dtype and np.array_equal(one, other, equal_nan=one.dtype.kind == "f")
    if is_array(one) or is_array(other):
        return False
    return bool(one == other or (one != one and other != other))
