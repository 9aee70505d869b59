"""What a goal may be: a pose, a place at which any orientation will do, or several, any one of which will do."""

from __future__ import annotations

import reprlib
from collections.abc import Sequence
from typing import Any

import numpy as np

from cfree.errors import InvalidPoseError
from cfree.exact.number import ExactPoint, to_fraction
from cfree.exact.pose import Pose, to_pose

Goal = Pose | ExactPoint


def to_goals(value: Any) -> tuple[Goal, ...] | Pose:
    """One pose, or several goals; a pair is a place.

    Raises
    ------
    InvalidPoseError, TypeError
        If it is neither, with the number of the goal.

    Examples
    --------
    >>> to_goals((1, 2)), to_goals((1, 2, 0)) == Pose(1, 2), len(to_goals([(1, 2, 0), (1, 2)]))
    (((Fraction(1, 1), Fraction(2, 1)),), True, 2)
    """
    if isinstance(value, Pose) or (_is_row(value) and len(value) == 3):
        return to_pose(value, "goal")
    if _is_row(value) and len(value) == 2:
        return (_place(value, "goal"),)
    if not isinstance(value, Sequence | np.ndarray) or isinstance(value, str) or _is_row(value) or len(value) == 0:
        to_pose(value, "goal")
    return tuple(
        _place(item, f"goal {k}") if _is_row(item) and len(item) == 2 else to_pose(item, f"goal {k}")
        for k, item in enumerate(value)
    )


def _is_row(value: Any) -> bool:
    """Is it one goal, and not many?"""
    return (
        isinstance(value, Sequence | np.ndarray)
        and not isinstance(value, str)
        and len(value) > 0
        and all(np.ndim(part) == 0 and not isinstance(part, Pose) for part in value)
    )


def _place(value: Any, name: str) -> ExactPoint:
    try:
        x, y = map(to_fraction, value)
    except ValueError as error:
        raise InvalidPoseError(f"{name}: {reprlib.repr(value)}: {error}") from None
    return x, y
