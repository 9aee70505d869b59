"""Goals: a pose, a place at which any orientation is accepted, or several of these, any one of which is accepted."""

from __future__ import annotations

import math
import reprlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from cfree.arguments import checked
from cfree.errors import InvalidPoseError
from cfree.exact.number import ExactPoint, is_single, to_fraction
from cfree.exact.pose import Pose, to_pose
from cfree.libraries import is_array
from cfree.words import coordinate

Goal = Pose | ExactPoint


@checked
@dataclass(frozen=True)
class Moved:
    """The requested start and goal of an answer, before they were moved to free poses.

    Parameters
    ----------
    start : Pose, optional
        None if the start was not moved.
    goal : Pose, or exact place (x, y), optional
        None if the goal was not moved.

    Examples
    --------
    >>> import cfree
    >>> wall = [(2, 0), (3, 0), (3, 9), (2, 9)]
    >>> scene = cfree.Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], obstacles=[wall])
    >>> path = cfree.plan(scene, ("1.25", 2, 0), (5, 0, 0), nearest_free=True)
    >>> path.start == cfree.Pose(1, 2), path.moved.start == cfree.Pose("1.25", 2), path.moved.goal
    (True, True, None)
    """

    start: Pose | None = None
    goal: Goal | None = None


def text_of(goal: Goal) -> str:
    """Write a pose, or a place, in words.

    Examples
    --------
    >>> text_of(Pose("0.1", 2, "90deg")), text_of(to_goals([(0.5, 3)])[0])
    ('(0.1, 2, 90 deg)', '(0.5, 3, any)')
    """
    if isinstance(goal, Pose):
        return f"({coordinate(float(goal.x))}, {coordinate(float(goal.y))}, {math.degrees(goal.theta):g} deg)"
    return f"({coordinate(float(goal[0]))}, {coordinate(float(goal[1]))}, any)"


def text_of_move(asked: Goal | None, end: Goal) -> str:
    """Write an end in words, and the requested end if it was moved.

    Examples
    --------
    >>> text_of_move(None, Pose(1, 2)), text_of_move(Pose(0, 2), Pose(1, 2))
    ('(1, 2, 0 deg)', '(1, 2, 0 deg) [moved from (0, 2, 0 deg)]')
    """
    return text_of(end) if asked is None else f"{text_of(end)} [moved from {text_of(asked)}]"


def to_goals(value: Any) -> tuple[Goal, ...] | Pose:
    """Convert an argument to one pose, or to several goals; a pair of numbers is a place.

    Raises
    ------
    InvalidPoseError, TypeError
        If it is neither; the message has the number of the goal.

    Examples
    --------
    >>> to_goals((1, 2)), to_goals((1, 2, 0)) == Pose(1, 2), len(to_goals([(1, 2, 0), (1, 2)]))
    (((Fraction(1, 1), Fraction(2, 1)),), True, 2)
    """
    if isinstance(value, Pose) or (_is_row(value) and len(value) == 3):
        return to_pose(value, "goal")
    if _is_row(value) and len(value) == 2:
        return (_place(value, "goal"),)
    are_many = (isinstance(value, Sequence) and not isinstance(value, str)) or is_array(value)
    if not are_many or _is_row(value) or len(value) == 0:
        to_pose(value, "goal")
    return tuple(
        _place(item, f"goal {k}") if _is_row(item) and len(item) == 2 else to_pose(item, f"goal {k}")
        for k, item in enumerate(value)
    )


def _is_row(value: Any) -> bool:
    """True if a value is one goal, not several."""
    return (
        (isinstance(value, Sequence) or is_array(value))
        and not isinstance(value, str)
        and len(value) > 0
        and all(is_single(part) and not isinstance(part, Pose) for part in value)
    )


def _place(value: Any, name: str) -> ExactPoint:
    try:
        x, y = map(to_fraction, value)
    except ValueError as error:
        raise InvalidPoseError(f"{name}: {reprlib.repr(value)}: {error}") from None
    return x, y
