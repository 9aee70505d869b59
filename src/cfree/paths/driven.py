"""Motions as a vehicle drives them: gear and radius of each, decided exactly from the motions alone.

A vehicle can do a translation along its forward direction, and a rotation about a pole on its axle line that is at
least its turning radius away from the axle point. Both are signs of rationals.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Literal

from cfree.arguments import checked
from cfree.collision.motion import Motion
from cfree.exact.pose import Pose
from cfree.vehicles.vehicle import Vehicle, described

Gear = Literal["forward", "backward", "turning"]


@checked
@dataclass(frozen=True)
class Driven:
    """A part of a path on one line or arc in one gear.

    Parameters
    ----------
    gear : "forward", "backward" or "turning"
        "turning" is a turn in place.
    radius : Fraction or None
        Distance of the pole from the axle point, exactly, in the scene's unit: positive to the left, 0 for a turn in
        place, None on a line.
    length : float
        Travel of the axle point, in the scene's unit; 0 for a turn in place.
    angle : float, radians
        Counter-clockwise if positive.
    first, last : int
        The motions of the path, counted from 0.
    """

    gear: Gear
    radius: Fraction | None
    length: float
    angle: float
    first: int
    last: int

    @property
    def curvature(self) -> float:
        """The reciprocal of the radius, rounded towards 0: 0 on a line, infinite for a turn in place."""
        if self.radius is None:
            return 0.0
        if self.radius == 0:
            return math.inf
        exact = 1 / self.radius
        value = float(exact)
        return math.nextafter(value, 0.0) if abs(Fraction(value)) > abs(exact) else value


def parts_of(vehicle: Vehicle, poses: Sequence[Pose], motions: Sequence[Motion]) -> tuple[Driven, ...]:
    """Return the parts of a path that the vehicle can drive; motions on one arc or line in one gear are one part."""
    parts = list[Driven]()
    for k, (pose, motion) in enumerate(zip(poses, motions, strict=False)):
        axle = pose @ vehicle.frame
        radius, sign = _radius(axle, motion), _sign(axle, motion)
        length = motion.length(axle)
        if radius is None and sign == 0:
            continue  # nothing moves
        gear: Gear = "turning" if radius == 0 else "forward" if sign > 0 else "backward"
        part = Driven(gear, radius, 0.0 if radius == 0 else length, motion.turn, k, k)
        last = parts[-1] if parts else None
        same_turn = last is not None and (radius is None or (last.angle > 0) == (motion.turn > 0))
        if last is not None and (last.gear, last.radius) == (gear, radius) and same_turn:
            parts[-1] = replace(last, length=last.length + part.length, angle=last.angle + part.angle, last=k)
        else:
            parts.append(part)
    return tuple(parts)


def cusps(parts: Iterable[Driven]) -> int:
    """Count the changes between forward and backward.

    Examples
    --------
    >>> ahead, back = Driven("forward", None, 1.0, 0.0, 0, 0), Driven("backward", None, 1.0, 0.0, 1, 1)
    >>> turn = Driven("turning", Fraction(0), 0.0, 1.0, 2, 2)
    >>> cusps([ahead, back, turn, ahead, ahead, turn, ahead])
    2
    """
    gears = [part.gear for part in parts if part.gear != "turning"]
    return sum(one != other for one, other in pairwise(gears))


def first_fault(vehicle: Vehicle, poses: Sequence[Pose], motions: Sequence[Motion]) -> tuple[int, str] | None:
    """Return the first motion that the vehicle cannot do, with the reason; None if it can do all."""
    for k, (pose, motion) in enumerate(zip(poses, motions, strict=False)):
        if why := _fault(vehicle, pose @ vehicle.frame, motion):
            return k, why
    return None


def _fault(vehicle: Vehicle, axle: Pose, motion: Motion) -> str:
    """Return why the vehicle cannot do a motion from a pose of its axle; empty if it can."""
    if motion.contacts:
        return "it is a slide along two contacts"
    radius = _radius(axle, motion)
    if motion.pole is None:
        x, y = motion.vector
        if x * axle.sin != y * axle.cos:
            return "it moves the axle point sideways"
    else:
        if motion.tau == 0:
            return ""
        x, y = motion.pole[0] - axle.x, motion.pole[1] - axle.y
        if x * axle.cos + y * axle.sin != 0:
            return "its pole is off the axle line"
        assert radius is not None
        if vehicle.kind == "car":
            left, right = vehicle.radii
            least, side = (left, "left") if radius > 0 else (right, "right")
            if radius == 0:
                return f"it turns in place, and {described(vehicle)} cannot"
            if abs(radius) < least:
                return f"its radius is {abs(radius)}, and the least to the {side} is {least}"
    if vehicle.gears == "forward" and _sign(axle, motion) < 0:
        return "it goes backward"
    return ""


def _radius(axle: Pose, motion: Motion) -> Fraction | None:
    """Return the signed distance of the pole along the axle line, positive to the left; None for a translation."""
    if motion.pole is None:
        return None
    x, y = motion.pole[0] - axle.x, motion.pole[1] - axle.y
    return axle.cos * y - axle.sin * x


def _sign(axle: Pose, motion: Motion) -> int:
    """Return 1 if a motion that the vehicle can do goes forward, -1 backward, 0 neither."""
    if motion.pole is None:
        x, y = motion.vector or (Fraction(0), Fraction(0))
        ahead = x * axle.cos + y * axle.sin
        return (ahead > 0) - (ahead < 0)
    radius = _radius(axle, motion) or Fraction(0)
    turn = 0 if motion.tau == 0 else 1 if motion.turn > 0 else -1
    return turn * ((radius > 0) - (radius < 0))
