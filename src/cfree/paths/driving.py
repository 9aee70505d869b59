"""Paths as a vehicle drives them: gear and curvature of each motion, decided exactly from the motions alone.

A vehicle can do a translation along its forward direction, and a rotation about a pole on its axle line that is at
least its turning radius away from the axle point. Both are signs of rationals.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from cfree.arguments import checked
from cfree.collision.motion import Motion
from cfree.exact.pose import Pose
from cfree.paths.driven import Driven, Gear
from cfree.paths.path import Path
from cfree.vehicles.vehicle import Vehicle, described


@checked
@dataclass(frozen=True)
class Drivable:
    """The answer of `is_drivable`; true if the vehicle can drive the whole path.

    Parameters
    ----------
    motion : int or None
        The first motion that it cannot do.
    why : str
        The reason; empty if it can drive the path.
    """

    motion: int | None = None
    why: str = ""

    def __bool__(self) -> bool:
        return self.motion is None


@checked
def is_drivable(path: Path, vehicle: Vehicle) -> Drivable:
    """Decide exactly if a vehicle can drive a path.

    Parameters
    ----------
    path : Path
    vehicle : Car or DifferentialDrive

    Returns
    -------
    Drivable
        True or false; if false, the first motion that the vehicle cannot do, and why.

    Examples
    --------
    >>> from cfree import Car, Path, Pose, Rotation, Translation
    >>> path = Path(Pose(0, 0), [Translation((3, 0)), Rotation((3, 2), "90deg"), Translation((1, 0))])
    >>> is_drivable(path[:2], Car(2)), bool(is_drivable(path[:2], Car(2)))
    (Drivable(motion=None, why=''), True)
    >>> is_drivable(path[:2], Car(3))
    Drivable(motion=1, why='its radius is 2, and the least to the left is 3')
    >>> is_drivable(path, Car(2))
    Drivable(motion=2, why='it moves the axle point sideways')
    """
    for k, (pose, motion) in enumerate(zip(path.poses, path.motions, strict=False)):
        if why := _fault(vehicle, pose @ vehicle.frame, motion):
            return Drivable(k, why)
    return Drivable()


def driving(path: Path, vehicle: Vehicle) -> tuple[Driven, ...]:
    """Return the parts of a path that the vehicle can drive; motions on one arc or line in one gear are one part."""
    parts = list[Driven]()
    for k, (pose, motion) in enumerate(zip(path.poses, path.motions, strict=False)):
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
