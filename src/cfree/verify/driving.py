"""Check that a vehicle can drive a path, by fractions alone: from the start, the motions and the vehicle's numbers.

A motion moves the axle point along forward if the vector is parallel to forward, or the pole on the line across it.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import TYPE_CHECKING

from cfree.verify.result import Finding

if TYPE_CHECKING:
    from cfree.paths.path import Path

DRIVABLE = "drivable"

Complex = tuple[Fraction, Fraction]  # a place or a direction


def driving_findings(path: Path) -> Iterator[Finding]:
    """Findings for motions that the path's vehicle cannot do."""
    vehicle = path.vehicle
    if vehicle is None:
        return
    place, half = (path.start.x, path.start.y), _half(path.start.tau)
    of_heading = _half(vehicle.heading)
    for k, motion in enumerate(path.motions):
        turned = _times(half, half)
        arm = _times(turned, vehicle.axle)
        size = half[0] ** 2 + half[1] ** 2
        axle = place[0] + arm[0] / size, place[1] + arm[1] / size
        ahead = _times(turned, _times(of_heading, of_heading))
        if why := _fault(path, k, axle, ahead):
            yield Finding(DRIVABLE, f"motion {k}", why)
        if motion.pole is None:
            x, y = motion.vector if motion.vector is not None else (Fraction(0), Fraction(0))
            place = place[0] + x, place[1] + y
            if motion.contacts:
                return
        else:
            by = _half(motion.tau)
            around = _times(_times(by, by), (place[0] - motion.pole[0], place[1] - motion.pole[1]))
            whole = by[0] ** 2 + by[1] ** 2
            place = motion.pole[0] + around[0] / whole, motion.pole[1] + around[1] / whole
            half = _reduced(_times(half, by))


def _fault(path: Path, k: int, axle: Complex, ahead: Complex) -> str:
    """Return why the vehicle cannot do a motion; `axle` is where its axle point is, `ahead` along forward."""
    vehicle, motion = path.vehicle, path.motions[k]
    assert vehicle is not None
    if motion.contacts:
        return "it is a slide, which no vehicle drives"
    if motion.pole is None:
        x, y = motion.vector
        if ahead[0] * y != ahead[1] * x:
            return "its vector is not along the vehicle's forward direction"
        sense = ahead[0] * x + ahead[1] * y
    else:
        x, y = motion.pole[0] - axle[0], motion.pole[1] - axle[1]
        if ahead[0] * x + ahead[1] * y != 0 and motion.tau != 0:
            return "its pole is not on the vehicle's axle line"
        left = ahead[0] * y - ahead[1] * x  # positive if the pole is to the left
        if vehicle.kind == "car" and motion.tau != 0:
            least = vehicle.radii[0 if left > 0 else 1]
            if x * x + y * y < least * least:
                return f"its pole is nearer to the axle point than {least}"
        clockwise = motion.clockwise if motion.tau is None else motion.tau < 0
        sense = Fraction(0) if motion.tau == 0 else -left if clockwise else left
    return "it goes backward" if vehicle.gears == "forward" and sense < 0 else ""


def _half(tau: Fraction | None) -> Complex:
    """Return a direction of half an angle."""
    return (Fraction(0), Fraction(1)) if tau is None else (Fraction(tau.denominator), Fraction(tau.numerator))


def _times(a: Complex, b: Complex) -> Complex:
    return a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]


def _reduced(a: Complex) -> Complex:
    """Return the same direction in short numbers."""
    return (Fraction(1), a[1] / a[0]) if a[0] else (Fraction(0), Fraction(1))
