"""Check arguments of public functions against their type hints, and name the wrong one.

`checked` compares arguments with the annotations before anything is computed. Each function checks the rest itself,
for example that a number is positive.
"""

from __future__ import annotations

import collections.abc
import os
import reprlib
import sys
from collections.abc import Callable, Sequence
from decimal import Decimal
from fractions import Fraction
from functools import cache, update_wrapper
from numbers import Integral, Real
from types import FunctionType, NoneType, UnionType
from typing import Any, Literal, TypeVar, Union, cast, get_args, get_origin, get_type_hints

from cfree.libraries import is_array, is_numpy, np

T = TypeVar("T", bound=Callable[..., Any])
_NUMBER = frozenset({int, float, Fraction, Decimal, str})  # a text is a number as well
_NAMES: dict[Any, str] = {
    NoneType: "None", float: "a number", int: "an int", str: "a str", bool: "True or False",
    os.PathLike: "a path", collections.abc.Callable: "a function", collections.abc.Mapping: "a dict",
}  # fmt: skip
_SEQUENCES = (collections.abc.Sequence, collections.abc.Iterable, list)


def checked(function: T) -> T:
    """Wrap a function or a class so that it refuses arguments of other types than its annotations.

    Raises
    ------
    TypeError
        The message has the argument's name, its value and type, and the expected type.
    ValueError
        If an argument is one of a few words, and another is given.

    Examples
    --------
    >>> @checked
    ... def half(length: float, name: str | None = None) -> float:
    ...     return float(length) / 2
    >>> half(3), half(np.float32(3))
    (1.5, 1.5)
    >>> half("3")
    Traceback (most recent call last):
        ...
    TypeError: length: '3' is a str; give a number
    >>> half(3, name=4)
    Traceback (most recent call last):
        ...
    TypeError: name: 4 is an int; give a str or None
    """
    if isinstance(function, type):
        cast(Any, function).__init__ = checked(cast(Any, function).__init__)
        return function
    code, checks = function.__code__, dict[str, _Check]()
    names, checks_of = code.co_varnames[: code.co_argcount], _checks_of

    def call(*arguments: Any, **named: Any) -> Any:
        if not checks:  # at the first call: some hints name types that are imported late
            checks.update(checks_of(function))
        for name, value in zip(names, arguments):  # noqa: B905 too many are the function's to refuse
            check = checks[name]
            if type(value) not in check.known:
                check(name, value)
        for name, value in named.items():
            if name in checks and type(value) not in checks[name].known:
                checks[name](name, value)
        return function(*arguments, **named)

    # a function of the original module, where doctest looks for it
    at_home = FunctionType(call.__code__, function.__globals__, function.__name__, None, call.__closure__)
    return cast(T, update_wrapper(at_home, function))


def one_of(name: str, value: Any, words: Sequence[Any]) -> None:
    """Refuse all but a few words.

    Raises
    ------
    ValueError
        With the name of the argument, what it is, and the words.

    Examples
    --------
    >>> one_of("unknown", "occupied", ("obstacle", "free"))
    Traceback (most recent call last):
        ...
    ValueError: unknown: 'occupied'; give "obstacle" or "free"
    """
    if value not in words:
        raise ValueError(f"{name}: {reprlib.repr(value)}; give {_listed(words)}")


def _listed(words: Sequence[Any]) -> str:
    *others, last = [f'"{word}"' if isinstance(word, str) else repr(word) for word in words]
    return f"{', '.join(others)} or {last}" if others else last


class _Check:
    """Check of one argument: any value of the types in `known` is good, and of the types of `words` only these are."""

    def __init__(self, hint: Any) -> None:
        self.hint, self.test = hint, _test_of(hint)
        parts = (hint, *get_args(hint))
        self.words = [word for part in parts if get_origin(part) is Literal for word in get_args(part)]
        self.kinds = tuple({type(word) for word in self.words if type(word) not in parts})
        union = get_origin(hint) in (Union, UnionType)
        self.expected = _either([part for part in parts[1:] if part is not NoneType]) if union else expected(hint)
        self.plain = [_test_of(part) for part in parts if _is_plain(part)]
        self.known: set[type] = set()

    def __call__(self, name: str, value: Any) -> None:
        if not self.test(value):
            kind = "None" if value is None else f"{reprlib.repr(value)} is {_article(type(value).__name__)}"
            raise TypeError(f"{name}: {kind}; give {expected(self.hint)}")
        if isinstance(value, self.kinds) and value not in self.words:
            raise ValueError(f"{name}: {reprlib.repr(value)}; give {self.expected}")
        if any(test(value) for test in self.plain):
            self.known.add(type(value))


def _checks_of(function: Any) -> dict[str, _Check]:
    hints = get_type_hints(function)
    code = function.__code__
    names = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
    return {name: _Check(hints.get(name, Any)) for name in names}


def _is_plain(hint: Any) -> bool:
    return hint is Any or (isinstance(hint, type) and not get_args(hint))


def fits(hint: Any, value: Any) -> bool:
    """True if a value matches a type hint. Numbers may be of any kind; unknown hints accept everything.

    Examples
    --------
    >>> from numpy.typing import ArrayLike
    >>> fits(int | None, np.int64(3)), fits(int, True), fits(tuple[int, int], (1, 2, 3)), fits(ArrayLike, [[1, "x"]])
    (True, False, False, False)
    """
    return _test_of(hint)(value)


@cache
def _test_of(hint: Any) -> Callable[[Any], bool]:
    """Return the predicate that tests values against a hint."""
    origin, parts = get_origin(hint), get_args(hint)
    if hint is Any:
        return lambda value: True
    if hint is float or hint is int:
        number = Real if hint is float else Integral
        return lambda value: isinstance(value, number) and not isinstance(value, bool)
    if hint is bool:
        return lambda value: isinstance(value, bool) or is_numpy(value, "bool_")
    if isinstance(hint, type) and not parts:
        return lambda value: isinstance(value, hint)
    if origin is Union or origin is UnionType:
        arrays = _arrays()
        numbers = arrays and arrays <= set(parts)
        tests = [_test_of(part) for part in parts if not (numbers and part in arrays)]
        tests += [_is_numbers] if numbers else []
        return lambda value: any(test(value) for test in tests)
    if origin is Literal:
        return lambda value: any(isinstance(value, type(part)) for part in parts)
    if origin is tuple:
        tests = [_test_of(part) for part in parts if part is not Ellipsis]
        return lambda value: _is_row(value, tests, parts[-1] is Ellipsis)
    if origin in _SEQUENCES:
        test, members = _test_of(parts[0]), get_args(parts[0]) or parts
        by_type = all(_is_plain(one) or get_origin(one) is collections.abc.Mapping for one in members)

        def is_sequence(value: Any) -> bool:
            if not _is_many(value) or not isinstance(value, list | tuple):
                return _is_many(value)
            return all(map(test, {type(item): item for item in value}.values() if by_type else value))

        return is_sequence
    return lambda value: not isinstance(origin, type) or isinstance(value, origin)


def _arrays() -> frozenset[Any]:
    """Members of the union `ArrayLike`; none before numpy is imported, which reading such a hint does."""
    return frozenset(get_args(np.typing.ArrayLike)) if "numpy" in sys.modules else frozenset()


def _is_many(value: Any) -> bool:
    return isinstance(value, collections.abc.Iterable) and not isinstance(value, str | bytes | collections.abc.Mapping)


def _is_row(value: Any, tests: list[Callable[[Any], bool]], endless: bool) -> bool:
    if isinstance(value, str) or not (isinstance(value, tuple | collections.abc.Sequence) or is_array(value)):
        return False
    tests = tests * len(value) if endless else tests
    return len(value) == len(tests) and all(test(part) for test, part in zip(tests, value, strict=True))


def _is_numbers(value: Any) -> bool:
    if isinstance(value, str | bytes) or value is None:
        return False
    if isinstance(value, tuple | list) and all(type(part) is float or type(part) is int for part in value):
        return True
    try:
        return np.asarray(value).dtype.kind in "biuf" or bool(np.asarray(value, dtype=np.float64).shape)
    except (TypeError, ValueError, OverflowError):
        return False


def expected(hint: Any) -> str:
    """Describe a type hint in words.

    Examples
    --------
    >>> from numpy.typing import ArrayLike
    >>> expected(tuple[float, float] | None), expected(list[str] | ArrayLike)
    ('(a number, a number) or None', 'numbers or a sequence of a str')
    >>> expected(int | float | Fraction | Decimal | str | dict)
    'a number or a dict'
    """
    origin, parts = get_origin(hint), get_args(hint)
    if origin is Union or origin is UnionType:
        return _either(parts)
    if origin is Literal:
        return _listed(parts)
    if origin is tuple:
        return f"({', '.join('...' if part is Ellipsis else expected(part) for part in parts)})"
    if origin in _SEQUENCES:
        return f"a sequence of {'these' if parts[0] is Any else expected(parts[0])}"
    kind = origin or hint
    name = getattr(kind, "__name__", str(kind))
    return _NAMES.get(kind) or ("an array" if name == "ndarray" else _article(name))


def _either(parts: Sequence[Any]) -> str:
    """Describe the members of a union in words."""
    words = list[str]()
    for kinds, name in ((_arrays(), "numbers"), (_NUMBER, "a number")):
        if kinds and kinds <= set(parts):
            words.append(name)
            parts = [part for part in parts if part not in kinds]
    return " or ".join(dict.fromkeys([*words, *map(expected, parts)]))


def _article(name: str) -> str:
    return f"{'an' if name[:1].lower() in 'aeiou' else 'a'} {name}"
