"""Ways of a vehicle off contacts with round shapes: some first motions are tried; none proves nothing."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction

from cfree.collision.motion import Motion
from cfree.collision.motion_checker import MotionChecker
from cfree.exact.pose import Pose
from cfree.planning.first_motions import Control
from cfree.planning.rails import Explored, ahead, motion_of
from cfree.vehicles.vehicle import Vehicle

SHARES = (Fraction(1), Fraction(-1), Fraction(1, 2), Fraction(-1, 2), Fraction(1, 8), Fraction(-1, 8), Fraction(0))
HALVINGS = 24  # of the lengths tried


def tried_ways_out(
    vehicle: Vehicle,
    gears: Sequence[int],
    checker: MotionChecker,
    pose: Pose,
    goal: Pose,
    size: float,
    touches: Callable[[Pose], bool],
) -> Explored:
    """Return first motions from a pose to others that are apart from everything, and the straight way to `goal`.

    Parameters
    ----------
    vehicle : Car or DifferentialDrive
    gears : sequence of 1 and -1
    checker : MotionChecker
        A checker of the round shapes.
    pose, goal : Pose
    size : float
        The longest motion tried.
    touches : callable
        True for a pose that touches something, or may.
    """
    axle, end = pose @ vehicle.frame, goal @ vehicle.frame
    exits, rail, ways = list[tuple[tuple[Motion, ...], Pose]](), [pose], list[tuple[Motion, ...]]([()])
    for control in _controls(vehicle, gears, size):
        if control.w == 0 and (length := ahead(axle, end, control)) is not None:
            motion = motion_of(axle, control, length)
            if motion.apply(pose) == goal and checker.is_free(pose, motion):
                rail.append(goal)
                ways.append((motion,))
        for halvings in range(HALVINGS):
            motion = motion_of(axle, control, Fraction(size).limit_denominator(1 << 10) / 2**halvings)
            if checker.is_free(pose, motion) and not touches(motion.apply(pose)):
                exits.append(((motion,), motion.apply(pose)))
                break
    return Explored(tuple(exits), tuple(rail), tuple(ways), is_complete=False)


def _controls(vehicle: Vehicle, gears: Sequence[int], size: float) -> Iterator[Control]:
    """Yield straight controls and arcs in each gear, and turns in place."""
    if vehicle.kind == "car":
        left, right = vehicle.radii
    else:
        left = right = Fraction(size).limit_denominator(1 << 10)
    for gear in gears:
        for share in SHARES:
            curvature = share / (left if share > 0 else right)
            yield Control(Fraction(gear), gear * curvature)
    if vehicle.kind == "differential":
        yield Control(Fraction(0), Fraction(1))
        yield Control(Fraction(0), Fraction(-1))
