"""Ways of a touching vehicle until it touches nothing: at once, or along its contacts.

A motion that keeps touching is straight along an edge, or a pivot about a touching point on the axle line. So a vehicle
runs on a finite graph of such motions, its *rail*, until some pose on it has a first motion that leaves.
docs/theory/vehicles.md, "Contacts", has the proofs.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from cfree.collision.motion import Motion, Rotation, Translation
from cfree.collision.motion_checker import MotionChecker
from cfree.exact.pose import Pose
from cfree.planning.first_motions import ONE, Control, Ring, Touching, area

MOST_POSES = 400  # looked at; with more, the question is left open
FIRST, LAST = 3, 400  # halvings of the first piece that leaves
PIVOTS = (6, 12, 24)  # halvings of a pivot

Way = tuple[Motion, ...]
Between = Literal["", "line", "pivot"]  # a pose between two events on a line, or on a pivot


@dataclass(frozen=True)
class Explored:
    """The poses that a vehicle reaches while it touches, and its ways out.

    Attributes
    ----------
    exits : tuple of (Way, Pose)
        Ways to poses that touch nothing.
    rail : tuple of Pose
        Poses at which it touches; the first is the one asked about.
    ways : tuple of Way
        The way to each of them.
    is_complete : bool
        True if there is no other way out.
    """

    exits: tuple[tuple[Way, Pose], ...]
    rail: tuple[Pose, ...]
    ways: tuple[Way, ...]
    is_complete: bool


def explore(touching: Touching, checker: MotionChecker, pose: Pose, *, goal: Pose | None = None) -> Explored:
    """Follow all contacts from a free pose, until the ways out are known, or `goal` is reached along them."""
    seen, todo = {pose}, deque[tuple[Pose, Way, Between]]([(pose, (), "")])
    exits, rail, ways, is_complete = list[tuple[Way, Pose]](), list[Pose](), list[Way](), True
    while todo:
        here, way, between = todo.popleft()
        if len(rail) >= MOST_POSES:
            is_complete = False
            break
        pairs = touching.pairs(here)
        assert pairs is not None, "the pose is free"
        if not pairs:
            exits.append((way, here))
            continue
        rail.append(here)
        ways.append(way)
        if here == goal:
            break
        signs = touching.signs(pairs)
        for k, (control, sign) in enumerate(signs):
            if sign > 0:
                before, its = signs[k - 1] if k else (control, -1)
                if its > 0 and before.v == control.v != 0:
                    continue  # the same interval of controls leads to the same cell
                if (left := _left(touching, checker, here, control)) is None:
                    is_complete = False
                else:
                    exits.append(((*way, left[0]), left[1]))
            elif sign == 0 and (not between or (between == "line" and control.w != 0)):
                found = [*_along(touching, checker, here, control, goal)]
                is_complete = is_complete and bool(found)
                for motion, end, kind in found:
                    if end not in seen:
                        seen.add(end)
                        todo.append((end, (*way, motion), kind))
    return Explored(tuple(exits), tuple(rail), tuple(ways), is_complete)


def reversed_way(way: Way) -> Way:
    """Return the way back."""
    return tuple(motion.reversed() for motion in reversed(way))


def motion_of(axle: Pose, control: Control, size: Fraction) -> Motion:
    """Return the motion of a control: of a length, or by twice the angle of a tangent."""
    if control.w == 0:
        by = control.v * size
        return Translation((axle.cos * by, axle.sin * by))
    radius = control.v / control.w
    pole = axle.x - axle.sin * radius, axle.y + axle.cos * radius
    return Rotation(pole, {"tau": size if control.w > 0 else -size})


def _left(touching: Touching, checker: MotionChecker, pose: Pose, control: Control) -> tuple[Motion, Pose] | None:
    """Return a motion that leaves by a control, and its end, which touches nothing."""
    axle = pose @ touching.vehicle.frame
    for halvings in range(FIRST, LAST):
        motion = motion_of(axle, control, Fraction(1, 1 << halvings))
        if checker.is_free(pose, motion):
            end = motion.apply(pose)
            if touching.pairs(end) == []:
                return motion, end
    return None


def _along(
    touching: Touching, checker: MotionChecker, pose: Pose, control: Control, goal: Pose | None
) -> Iterator[tuple[Motion, Pose, Between]]:
    """Yield motions that keep touching, to the next place where anything changes and to the middle of the way there.

    None, if the place cannot be named in rationals.
    """
    axle = pose @ touching.vehicle.frame
    if control.w == 0:
        length = _next_event(touching, axle, control)
        at_goal = None if goal is None else ahead(axle, goal @ touching.vehicle.frame, control)
        if at_goal is not None and (length is None or at_goal < length):
            motion = motion_of(axle, control, at_goal)
            if checker.is_free(pose, motion):
                yield motion, motion.apply(pose), "line"
        halves: tuple[tuple[Fraction, Between], ...] = ((Fraction(1, 2), "line"), (ONE, ""))
        for share, between in halves:
            motion = motion_of(axle, control, (ONE if length is None else length) * share)
            if checker.is_free(pose, motion):
                yield motion, motion.apply(pose), between
        return
    for halvings in PIVOTS:
        motion = motion_of(axle, control, Fraction(1, 1 << halvings))
        if checker.is_free(pose, motion):
            end = motion.apply(pose)
            others = touching.pairs(end)
            if others is not None and (not others or any(sign > 0 for _, sign in touching.signs(others))):
                yield motion, end, "pivot"
            return


def ahead(axle: Pose, goal: Pose, control: Control) -> Fraction | None:
    """Return the length of a straight motion to a pose; None if it does not lead there."""
    x, y = goal.x - axle.x, goal.y - axle.y
    length = control.v * (axle.cos * x + axle.sin * y)
    on_line = axle.cos * y == axle.sin * x
    return length if axle.tau == goal.tau and on_line and length > 0 else None


def _next_event(touching: Touching, axle: Pose, control: Control) -> Fraction | None:
    """Return the least length of a straight motion at which a sign that matters changes."""
    gear = control.v
    events = list[Fraction]()

    def at(value: Fraction, rate: Fraction) -> None:
        if rate and (length := -value / rate) > 0:
            events.append(length)

    within = 4 * touching.reach
    while True:
        others: list[Ring] = [ring for _, ring in touching.near(axle, within)]
        for other in others:
            for x, _ in other:
                at(x, -gear)  # a vertex passes the axle line
            for ring in touching.robot:
                for one, points, side in ((other, ring, 1), (ring, other, -1)):
                    for a, b in zip(one, (*one[1:], one[0]), strict=True):
                        for point in points:
                            at(area(a, b, point), -side * gear * (b[1] - a[1]))
        for n, room in touching._rooms(axle):
            at(room, n[0] * gear)
        nearest = min(events, default=None)
        if nearest is not None and nearest <= within:
            return nearest
        if within > 2**20 * touching.reach or len(others) == 0:
            return nearest
        within *= 4
