"""Places where a vehicle stands on a path: cusps, ends of turns in place, and jumps of curvature.

A car's wheels are steered. Where the curvature jumps they turn, and the exact path is kept only if it stands meanwhile.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

from cfree.arguments import checked
from cfree.paths.driven import Driven
from cfree.vehicles.vehicle import Vehicle

Why = Literal["cusp", "turning", "steering"]
Stops = Literal["all", "cusps"]
STEADY = math.radians(0.01)  # wheels that turn by less need no stop


@checked
@dataclass(frozen=True)
class Stop:
    """A place where a vehicle stands between two motions.

    Parameters
    ----------
    motion : int
        The motion of the path that begins there.
    why : "cusp", "turning" or "steering"
        A change between forward and backward, the begin or end of a turn in place, or a jump of curvature.
    wheels : float, radians
        The angle by which the steered wheels turn; 0 for a differential drive.
    time, pause : float, seconds
        When it begins to stand, and for how long.
    """

    motion: int
    why: Why
    wheels: float
    time: float = 0.0
    pause: float = 0.0


@dataclass(frozen=True)
class Joint:
    """The joint of two parts of a path at which gear or steering changes."""

    before: Driven
    beyond: Driven
    why: Why
    wheels: float


def joints(parts: Sequence[Driven], wheelbase: float | None) -> list[Joint]:
    """Return the joints at which gear or steering changes; without a wheelbase the machine has no steered wheels.

    Examples
    --------
    >>> from fractions import Fraction
    >>> line, arc = Driven("forward", None, 1.0, 0.0, 0, 0), Driven("forward", Fraction(2), 1.0, 0.5, 1, 1)
    >>> flat = Driven("forward", Fraction(10**6), 1.0, 1e-6, 1, 1)
    >>> [(joint.why, round(math.degrees(joint.wheels))) for joint in joints([line, arc], 2.0)]
    [('steering', 45)]
    >>> joints([line, arc], None), joints([line, flat], 2.0)
    ([], [])
    """
    result = list[Joint]()
    for before, beyond in pairwise(parts):
        wheels = 0.0 if wheelbase is None else _turned(before, beyond, wheelbase)
        if "turning" in (before.gear, beyond.gear):
            result.append(Joint(before, beyond, "turning", wheels))
        elif before.gear != beyond.gear:
            result.append(Joint(before, beyond, "cusp", wheels))
        elif wheels >= STEADY:
            result.append(Joint(before, beyond, "steering", wheels))
    return result


def usual_wheelbase(vehicle: Vehicle) -> float | None:
    """Return a car's wheelbase, its turning radius if it has none; None for a differential drive."""
    if vehicle.kind == "differential":
        return None
    return float(vehicle.turning_radius if vehicle.wheelbase is None else vehicle.wheelbase)


def _turned(before: Driven, beyond: Driven, wheelbase: float) -> float:
    return min(abs(a - b) for a in _steering(before, wheelbase) for b in _steering(beyond, wheelbase))


def _steering(part: Driven, wheelbase: float) -> tuple[float, ...]:
    """Return the steering angle of a part; in place the wheels may stand across to either side."""
    if part.radius is None:
        return (0.0,)
    if part.radius == 0:
        return -math.pi / 2, math.pi / 2
    angle = math.atan2(wheelbase, abs(float(part.radius)))
    return (angle if part.radius > 0 else -angle,)
