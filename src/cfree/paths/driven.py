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


@dataclass(frozen=True, slots=True)
class Axle:
    """The axle of a vehicle in integers, which are faster than fractions: one for all motions of a path.

    Attributes
    ----------
    heading : (int, int, int)
        Cosine and sine of forward in the robot's frame times the third.
    place : (int, int, int)
        The axle point, ahead and to the left of the reference point, times the third.
    """

    heading: tuple[int, int, int]
    place: tuple[int, int, int]

    @classmethod
    def of(cls, vehicle: Vehicle) -> Axle:
        frame = vehicle.frame
        (c, s, w), (x, y, unit) = frame.rotation, frame.integers
        return cls((c, s, w), (c * x + s * y, c * y - s * x, unit * w))

    def seen(self, pose: Pose, motion: Motion) -> tuple[int, int, int]:
        """Return how far ahead and to the left of the axle, times the third, the pole or the end of a motion is."""
        if motion.pole is None:
            x, y = motion.vector or (Fraction(0), Fraction(0))
        else:
            x, y = motion.pole[0] - pose.x, motion.pole[1] - pose.y
        (m, i), (n, j) = x.as_integer_ratio(), y.as_integer_ratio()
        (a, b, v), (c, s, w) = pose.rotation, self.heading
        c, s = a * c - b * s, a * s + b * c
        m, n, unit = m * j, n * i, i * j * v * w
        ahead, left = c * m + s * n, c * n - s * m
        if motion.pole is None:
            return ahead, left, unit
        x0, y0, place = self.place
        return ahead * place - x0 * unit, left * place - y0 * unit, unit * place


def parts_of(vehicle: Vehicle, poses: Sequence[Pose], motions: Sequence[Motion]) -> tuple[Driven, ...]:
    """Return the parts of a path that the vehicle can drive; motions on one arc or line in one gear are one part."""
    parts, axle = list[Driven](), Axle.of(vehicle)
    for k, (pose, motion) in enumerate(zip(poses, motions, strict=False)):
        ahead, left, unit = axle.seen(pose, motion)
        radius = None if motion.pole is None else Fraction(left, unit)
        sign = _sign(motion, ahead, left)
        if radius is None and sign == 0:
            continue  # nothing moves
        gear: Gear = "turning" if radius == 0 else "forward" if sign > 0 else "backward"
        length = math.hypot(ahead / unit, left / unit) * (1.0 if radius is None else abs(motion.turn))
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
    axle = Axle.of(vehicle)
    for k, (pose, motion) in enumerate(zip(poses, motions, strict=False)):
        if why := _fault(vehicle, axle, pose, motion):
            return k, why
    return None


def _fault(vehicle: Vehicle, axle: Axle, pose: Pose, motion: Motion) -> str:
    """Return why the vehicle cannot do a motion from a pose of the robot; empty if it can."""
    if motion.contacts:
        return "it is a slide along two contacts"
    ahead, left, unit = axle.seen(pose, motion)
    if motion.pole is None:
        if left != 0:
            return "it moves the axle point sideways"
    elif motion.tau == 0:
        return ""
    elif ahead != 0:
        return "its pole is off the axle line"
    elif vehicle.kind == "car":
        if left == 0:
            return f"it turns in place, and {described(vehicle)} cannot"
        least, side = (vehicle.radii[0], "left") if left > 0 else (vehicle.radii[1], "right")
        if abs(left) * least.denominator < least.numerator * unit:
            return f"its radius is {Fraction(abs(left), unit)}, and the least to the {side} is {least}"
    if vehicle.gears == "forward" and _sign(motion, ahead, left) < 0:
        return "it goes backward"
    return ""


def _sign(motion: Motion, ahead: int, left: int) -> int:
    """Return 1 if a motion that the vehicle can do goes forward, -1 backward, 0 neither."""
    if motion.pole is None:
        return (ahead > 0) - (ahead < 0)
    turn = 0 if motion.tau == 0 else -1 if motion.clockwise else 1
    return turn * ((left > 0) - (left < 0))
